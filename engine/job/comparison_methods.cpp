#include "engine/job/comparison_methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "engine/job/budget_fit_statement.h"
#include "engine/job/comparison_keys.h"

namespace gumcert::engine {

namespace {

using nlohmann::json;

constexpr std::size_t k_most_points = 2000;  // their covariance is dense
constexpr std::size_t k_most_named = 10;     // points in a message
constexpr double k_same_number = 1e-9;       // of matrices that another program wrote with fewer digits
constexpr double k_same_variance = 1e-6;

constexpr std::array<std::string_view, 1> k_required_columns{"point"};
constexpr std::array<std::string_view, 9> k_optional_columns{"direction", "position", "value",    "u",          "U",
                                                             "k",         "nu",       "u_common", "uncertainty"};
enum Column : std::size_t { c_point, c_direction, c_position, c_value, c_u, c_U, c_k, c_nu, c_common, c_bare };

/// What a side states of one point.
struct SidePoint {
    MethodPoint point;
    double value = 0.0;
    std::optional<ResultUncertainty> uncertainty;
    std::optional<double> u_common;
    std::string where;
};

/// One side while it is read: its points in its own order.
struct SideReading {
    std::string key;  ///< "lab" or "reference"
    ComparisonSide side;
    std::vector<SidePoint> points;
    ProblemList* problems = nullptr;  ///< of the file with the points
    std::optional<std::string> covariance_name;
    bool has_points = false;  ///< stated, and not only those of a budget
    bool is_whole = true;
};

using PointKey = std::pair<std::string, std::string>;
PointKey key_of(const MethodPoint& point) {
    return {point.name, point.direction};
}
/// The name of a point of a budget that stands for a point of the comparison.
std::string name_in_budget(const MethodPoint& point) {
    return point.direction.empty() ? point.name : point.name + "." + point.direction;
}
std::string description(const MethodPoint& point) {
    return point.direction.empty() ? point.name : point.name + " " + point.direction;
}

class MethodsReader {
public:
    MethodsReader(const ComparisonReading& reading, const JsonObject& root) : reading_(reading), root_(root) {}

    void read() {
        request_ = &reading_.job.methods.emplace();
        read_unit_and_position();
        SideReading laboratory = read_side("lab", "laboratory");
        SideReading reference = read_side("reference", "reference");
        read_correlation(laboratory, reference);
        read_bias_line();
        request_->tolerance = read_tolerance();
        const bool is_matched = match(laboratory, reference);
        if (is_matched) {
            check_directions(laboratory);
            check_positions(laboratory);
            finish(laboratory, request_->laboratory);
            finish(reference, request_->reference);
        }
    }

private:
    // ---- keys of the job --------------------------------------------------------------------------------------------

    void read_unit_and_position() {
        if (root_.has("unit")) {
            if (auto unit = read_unit(root_, "unit", reading_.problems)) {
                request_->unit = std::move(*unit);
            }
        }
        if (const auto position = root_.optional_object("position", k_position_keys)) {
            request_->position_name = position->required_name("name").value_or("");
            if (position->has("unit")) {
                request_->position_unit = read_unit(*position, "unit", reading_.problems);
            }
        }
    }

    void read_correlation(const SideReading& laboratory, const SideReading& reference) {
        const bool have_budgets = laboratory.side.budget && reference.side.budget;
        request_->correlation = have_budgets ? MethodCorrelation::shared_sources : MethodCorrelation::unknown;
        const json* value = root_.has("correlation") ? root_.find("correlation") : nullptr;
        if (value == nullptr) {
            return;
        }
        if (value->is_number()) {
            const auto r = root_.optional_number(
                "correlation",
                {.low = -1.0, .high = 1.0, .hint = "a correlation coefficient is at least -1 and at most 1"});
            request_->correlation = MethodCorrelation::given;
            request_->r = r.value_or(0.0);
            return;
        }
        constexpr std::array<std::pair<std::string_view, MethodCorrelation>, 3> k_words{
            {{"none", MethodCorrelation::none},
             {"unknown", MethodCorrelation::unknown},
             {"shared_sources", MethodCorrelation::shared_sources}}};
        const auto word = root_.optional_choice("correlation", k_words);
        request_->correlation = word.value_or(request_->correlation);
        if (word == MethodCorrelation::shared_sources && !have_budgets && laboratory.is_whole && reference.is_whole) {
            root_.refuse(k_no_shared_sources, "correlation", "\"shared_sources\" where not both sides have a budget",
                         "sources that are shared are found in two budgets",
                         "add the budgets, state r as a number, or write \"unknown\"");
        }
    }

    void read_bias_line() {
        constexpr std::array<std::pair<std::string_view, bool>, 2> k_words{
            {{"reference_value", false}, {"position", true}}};
        request_->bias_against_position = root_.optional_choice("bias_line", k_words).value_or(false);
    }

    std::optional<double> read_tolerance() {
        const auto tolerance = root_.optional_number("tolerance", {.low = 0.0, .low_open = true});
        return tolerance ? root_.optional_number("tolerance", {.low = k_least_compared_u, .high = k_largest_compared})
                         : std::nullopt;
    }

    // ---- one side ---------------------------------------------------------------------------------------------------

    SideReading read_side(const std::string& key, const std::string& default_name) {
        SideReading side;
        side.key = key;
        side.side.name = default_name;
        side.problems = &reading_.problems;
        const std::size_t refused = reading_.problems.refusals();
        if (!root_.require(key)) {
            side.is_whole = false;
            return side;
        }
        const json* value = root_.find(key);
        if (value == nullptr) {
            side.is_whole = false;
        } else if (value->is_string()) {
            read_points_file(root_, key, side);
        } else if (!value->is_object()) {
            root_.refuse(k_wrong_type, key, described(*value), "must be the name of a CSV file or an object",
                         "write {\"points\": \"" + key + ".csv\"}");
        } else {
            read_side_object(*root_.optional_object(key, k_side_keys), side);
        }
        side.is_whole = side.is_whole && reading_.problems.refusals() == refused;
        return side;
    }

    void read_side_object(const JsonObject& object, SideReading& side) {
        side.side.name = object.optional_name("name", 1000).value_or(side.side.name);
        side.side.cmc_U = object.optional_number("cmc_U", compared_uncertainty());
        if (const auto audited = object.optional_object("audited", k_audited_factor_keys)) {
            const auto factor = audited->required_number(
                "factor", {.low = 0.0,
                           .high = 1e6,
                           .low_open = true,
                           .hint = "state what every uncertainty is multiplied by, such as 0.577"});
            side.side.audited_factor = factor.value_or(1.0);
            side.side.audit_finding = audited->required_name("finding", 1000).value_or("");
        }
        if (object.has("budget")) {
            read_budget(object, side);
        }
        side.covariance_name = JobFiles::file_name(object, "covariance", false);
        if (object.has("covariance") && object.has("budget")) {
            object.refuse(k_stated_beside_budget, "covariance", "a covariance beside a budget",
                          "the covariance of the points is that of the budget", "remove one of the two");
        }
        const json* points = object.has("points") ? object.find("points") : nullptr;
        if (points == nullptr) {
            if (!object.has("points") && !object.has("budget")) {
                object.refuse(k_missing_key, "", "a side without \"points\" and without \"budget\"",
                              "the values of a side are in a table, in an array or in a budget", "add one of them");
            }
        } else if (points->is_string()) {
            read_points_file(object, "points", side);
        } else if (points->is_array()) {
            side.has_points = true;
            if (points->empty()) {
                object.refuse(k_wrong_size, "points", "an empty list of points", "there must be at least one",
                              "list the points with their values");
                return;
            }
            if (points->size() > k_most_points) {
                refuse_too_many(points->size(), object.where("points"), reading_.problems);
                side.is_whole = false;
                return;
            }
            for_each_object(reading_, *points, object.pointer("points"), k_point_keys, k_point_keys_and_bare,
                            [&](const JsonObject& point) { read_point(point, side); });
        } else {
            object.refuse(k_wrong_type, "points", described(*points), "must be the name of a CSV file or an array",
                          "correct the value");
        }
    }

    static void refuse_too_many(std::size_t count, const std::string& where, ProblemList& problems) {
        problems.refuse(k_too_many_quantities, where, std::to_string(count) + " points",
                        "a comparison has at most " + std::to_string(k_most_points) + " points", "split the data");
    }

    void read_budget(const JsonObject& object, SideReading& side) {
        const auto name = JobFiles::file_name(object, "budget", true);
        side.side.budget = name ? reading_.budgets.read(*name) : nullptr;
        if (!side.side.budget) {
            side.is_whole = false;
            return;
        }
        side.side.budget_file = *name;
        if (side.side.budget->points.size() > k_most_points) {
            refuse_too_many(side.side.budget->points.size(), object.where("budget"), reading_.problems);
            side.is_whole = false;
        }
        (void)reading_.budgets.has_output_of(*side.side.budget, request_->unit, object.where("budget"),
                                             reading_.problems);
    }

    // ---- points -----------------------------------------------------------------------------------------------------

    void read_point(const JsonObject& object, SideReading& side) {
        SidePoint read;
        read.where = object.where();
        const auto name = required_label(object, "point", reading_.problems);
        read.point.name = name.value_or("");
        read.point.direction = optional_label(object, "direction", reading_.problems).value_or("");
        read.point.position = object.optional_number("position", compared_value());
        if (side.side.budget || side.side.budget_file != "") {
            for (const std::string_view key : {"value", "u", "U", "k", "nu", "u_common"}) {
                if (object.has(key)) {
                    object.refuse(k_stated_beside_budget, key, in_quotes(key) + " beside a budget",
                                  "values and uncertainties are those of the budget", "remove the key, or the budget");
                }
            }
        } else {
            const json* value = object.find("value");
            if (value != nullptr && value->is_string() && is_censored(value->get_ref<const std::string&>())) {
                refuse_censored(value->get_ref<const std::string&>(), object.where("value"), reading_.problems);
            } else {
                read.value = object.required_number("value", compared_value()).value_or(0.0);
            }
            read.uncertainty = read_uncertainty(reading_, object, true);
            read.u_common = object.optional_number("u_common", between(0.0, k_largest_compared, ""));
            check_point(side, read, object.has("u") || object.has("U") || object.has("k"), object.where(),
                        reading_.problems);
        }
        if (name) {
            side.points.push_back(std::move(read));
        }
    }

    void check_point(SideReading& side, const SidePoint& read, bool states_uncertainty, const std::string& where,
                     ProblemList& problems) {
        if (!states_uncertainty && !side.covariance_name) {
            problems.refuse(k_bare_uncertainty, where,
                            "the point " + in_quotes(read.point.name) + " has no uncertainty",
                            "every point has u, or U with k, unless a covariance states it", "add the uncertainty");
            side.is_whole = false;
        }
        if (read.u_common && side.covariance_name) {
            problems.refuse(k_stated_beside_budget, where, "u_common beside a covariance",
                            "what the points share is in the covariance", "remove one of the two");
        } else if (read.u_common && read.uncertainty && *read.u_common > read.uncertainty->u * (1.0 + k_same_number)) {
            problems.refuse(
                k_parts_exceed_uncertainty, where,
                "u_common is " + shortest(*read.u_common) + ", and u of the point is " + shortest(read.uncertainty->u),
                "what all points share is a part of the standard uncertainty of each",
                "state u_common as a standard uncertainty, not larger than u");
        }
    }

    void read_points_file(const JsonObject& object, std::string_view key, SideReading& side) {
        side.has_points = true;
        const auto name = JobFiles::file_name(object, key, true);
        auto file = name ? reading_.files.open(*name) : std::nullopt;
        if (!file) {
            side.is_whole = false;
            return;
        }
        ProblemList& problems = *file->problems;
        side.problems = &problems;
        const auto table = read_csv_table(std::move(file->bytes), k_required_columns, k_optional_columns, problems);
        const UncertaintyColumns columns{.u = c_u, .U = c_U, .k = c_k, .nu = c_nu, .bare = c_bare};
        if (!table || !check_uncertainty_columns(*table, columns, problems)) {
            side.is_whole = false;
            return;
        }
        if (table->rows() > k_most_points) {
            refuse_too_many(table->rows(), printable(problems.file()), problems);
            side.is_whole = false;
            return;
        }
        const bool has_budget = !side.side.budget_file.empty() || side.side.budget;
        if (has_budget && (table->has_column(c_value) || table->has_column(c_u) || table->has_column(c_U))) {
            problems.refuse(k_stated_beside_budget, table->where(table->cell(0, c_point)),
                            "values or uncertainties beside a budget",
                            "values and uncertainties are those of the budget; the table may name the points",
                            "keep the columns point, direction and position, or remove the budget");
            side.is_whole = false;
            return;
        }
        if (!has_budget && !table->has_column(c_value)) {
            problems.refuse(k_csv_missing_column, table->where(table->cell(0, c_point)),
                            "the column \"value\" is missing", "every point has a value", "add the column");
            side.is_whole = false;
            return;
        }
        if (side.covariance_name && table->has_column(c_common)) {
            problems.refuse(k_stated_beside_budget, table->where(table->cell(0, c_common)),
                            "a column u_common beside a covariance", "what the points share is in the covariance",
                            "remove one of the two");
            side.is_whole = false;
            return;
        }
        for (std::size_t row = 0; row < table->rows(); ++row) {
            read_row(*table, row, columns, has_budget, side, problems);
        }
        side.is_whole = side.is_whole && problems.refusals() == 0;
    }

    void read_row(const CsvTable& table, std::size_t row, const UncertaintyColumns& columns, bool has_budget,
                  SideReading& side, ProblemList& problems) {
        SidePoint read;
        read.where = table.where(table.cell(row, c_point));
        const auto name = table.name(row, c_point);
        read.point.name = std::string(name.value_or(""));
        if (table.has_column(c_direction) && !table.cell(row, c_direction).text.empty()) {
            read.point.direction = std::string(table.name(row, c_direction).value_or(""));
        }
        read.point.position = table.number_if_any(row, c_position, compared_value());
        if (!has_budget) {
            const CsvCell& cell = table.cell(row, c_value);
            if (is_censored(cell.text)) {
                refuse_censored(cell.text, table.where(cell), problems);
            } else {
                read.value = table.number(row, c_value, compared_value()).value_or(0.0);
            }
            read.uncertainty = read_uncertainty(table, row, columns, reading_.job.coverage_probability, problems);
            read.u_common = table.number_if_any(row, c_common, between(0.0, k_largest_compared, ""));
            const auto is_stated = [&](std::size_t column) {
                return table.has_column(column) && !table.cell(row, column).text.empty();
            };
            check_point(side, read, is_stated(c_u) || is_stated(c_U) || is_stated(c_k), read.where, problems);
        }
        if (name) {
            side.points.push_back(std::move(read));
        }
    }

    // ---- both sides together ----------------------------------------------------------------------------------------

    /// The points of the comparison: those of the laboratory, or of the reference where only it lists them, or those
    /// of the budget of the laboratory. Brings both sides into this order.
    bool match(SideReading& laboratory, SideReading& reference) {
        bool is_whole = laboratory.is_whole && reference.is_whole;
        for (SideReading* side : {&laboratory, &reference}) {
            // A number that is none was told while the text was read: then there may be neither points nor a budget.
            is_whole = are_distinct(*side) && (side->has_points || side->side.budget) && is_whole;
        }
        if (!is_whole) {
            return false;
        }
        if (!laboratory.has_points && reference.has_points) {
            name_points_of_budget(laboratory, reference.points);
        } else if (!laboratory.has_points) {
            name_points_of_budget(laboratory, {});
        }
        if (!reference.has_points) {
            name_points_of_budget(reference, laboratory.points);
        }
        if (!is_same(laboratory, reference)) {
            return false;
        }
        std::map<PointKey, std::size_t> places;
        for (std::size_t i = 0; i < laboratory.points.size(); ++i) {
            places.emplace(key_of(laboratory.points[i].point), i);
        }
        // The order of the file of the reference is needed for its covariance.
        reference_order_.clear();
        std::vector<SidePoint> ordered(laboratory.points.size());
        for (SidePoint& point : reference.points) {
            const std::size_t at = places.at(key_of(point.point));
            reference_order_.push_back(at);
            ordered[at] = std::move(point);
        }
        reference.points = std::move(ordered);
        for (std::size_t i = 0; i < laboratory.points.size(); ++i) {
            std::optional<double>& position = laboratory.points[i].point.position;
            const std::optional<double>& other = reference.points[i].point.position;
            if (position && other && *position != *other) {
                reference.problems->refuse(k_points_differ, reference.points[i].where,
                                           "the point " + in_quotes(description(reference.points[i].point)) +
                                               " is at " + shortest(*other) +
                                               ", and on the side of the laboratory at " + shortest(*position),
                                           "both methods measured the same points", "correct the position");
            }
            position = position ? position : other;
            request_->points.push_back(laboratory.points[i].point);
        }
        return true;
    }

    bool are_distinct(const SideReading& side) {
        std::map<PointKey, const SidePoint*> seen;
        bool are = true;
        for (const SidePoint& point : side.points) {
            const auto [entry, is_new] = seen.try_emplace(key_of(point.point), &point);
            if (!is_new) {
                are = false;
                side.problems->refuse(
                    k_repeated_comparison_point, point.where,
                    "the point " + in_quotes(point.point.name) +
                        (point.point.direction.empty() ? "" : " in the direction " + in_quotes(point.point.direction)) +
                        " occurs twice, before at " + entry->second->where,
                    "point and direction occur together once",
                    "remove one of the two, or tell them apart by a direction");
            }
        }
        return are;
    }

    /// The points of a side that has a budget only. A point of the budget stands for the point of the other side with
    /// its name and direction; without one it is a point of its own, which is then told.
    static void name_points_of_budget(SideReading& side, const std::vector<SidePoint>& others) {
        std::map<std::string, const MethodPoint*> known;
        for (const SidePoint& other : others) {
            known.emplace(name_in_budget(other.point), &other.point);
        }
        const std::vector<BudgetPoint>& points = side.side.budget->points;
        const std::size_t count = std::max<std::size_t>(points.size(), 1);
        for (std::size_t i = 0; i < count; ++i) {
            SidePoint read;
            read.where = printable(side.side.budget_file) + "#/points";
            // A budget without points has one result, which is that of the only point.
            const std::string name = !points.empty()      ? points[i].name
                                     : others.size() == 1 ? name_in_budget(others.front().point)
                                                          : "1";
            const auto found = known.find(name);
            if (found == known.end()) {
                read.point.name = name;
            } else {
                read.point.name = found->second->name;
                read.point.direction = found->second->direction;
            }
            side.points.push_back(std::move(read));
        }
    }

    bool is_same(const SideReading& laboratory, const SideReading& reference) {
        const bool lab_has_more = !tell_missing(laboratory, reference, "reference");
        const bool reference_has_more = !tell_missing(reference, laboratory, "laboratory");
        return !lab_has_more && !reference_has_more;
    }

    /// Refuses the points of one side that the other one does not have. \return true when there are none
    static bool tell_missing(const SideReading& side, const SideReading& other, const std::string& name_of_other) {
        std::map<PointKey, bool> known;
        for (const SidePoint& point : other.points) {
            known.emplace(key_of(point.point), true);
        }
        std::vector<std::string> missing;
        std::string where;
        for (const SidePoint& point : side.points) {
            if (!known.contains(key_of(point.point))) {
                where = missing.empty() ? point.where : where;
                missing.push_back(description(point.point));
            }
        }
        if (!missing.empty()) {
            side.problems->refuse(k_points_differ, where,
                                  (missing.size() == 1 ? "the point " : "the points ") +
                                      list_of(missing, k_most_named) + (missing.size() == 1 ? " has" : " have") +
                                      " no counterpart on the side of the " + name_of_other,
                                  "both methods have the same points, by name and direction, letter by letter",
                                  "add the points to the other side, or remove them from this one");
        }
        return missing.empty();
    }

    /// The summary of all directions together is named so in the record.
    void check_directions(const SideReading& laboratory) {
        for (const SidePoint& point : laboratory.points) {
            if (point.point.direction == "all") {
                laboratory.problems->refuse(k_reserved_direction, point.where, "a direction \"all\"",
                                            "\"all\" stands for all directions together",
                                            "give the direction another name");
                return;
            }
        }
    }

    void check_positions(const SideReading& laboratory) {
        if (!request_->bias_against_position) {
            return;
        }
        std::vector<std::string> without;
        for (const MethodPoint& point : request_->points) {
            if (!point.position) {
                without.push_back(description(point));
            }
        }
        if (!without.empty()) {
            laboratory.problems->refuse(k_no_position, root_.where("bias_line"),
                                        list_of(without) + (without.size() == 1 ? " has" : " have") + " no position",
                                        "a bias line against the position needs the position of every point",
                                        "add the column position, or write \"bias_line\": \"reference_value\"");
        }
    }

    // ---- what the application gets ----------------------------------------------------------------------------------

    void finish(SideReading& read, ComparisonSide& side) {
        side = std::move(read.side);
        if (side.budget) {
            find_points_of_budget(read, side);
            return;
        }
        const auto n = static_cast<Eigen::Index>(read.points.size());
        if (read.covariance_name) {
            read_covariance(read, side);
        }
        for (const SidePoint& point : read.points) {
            side.value.push_back(point.value);
        }
        if (side.covariance.size() > 0 || read.covariance_name) {
            return;
        }
        if (std::any_of(read.points.begin(), read.points.end(), [](const auto& point) { return !point.uncertainty; })) {
            return;  // refused while the text was read
        }
        side.covariance = Eigen::MatrixXd::Zero(n, n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const SidePoint& first = read.points[static_cast<std::size_t>(i)];
            side.uncertainty.push_back(*first.uncertainty);
            for (Eigen::Index j = 0; j < i; ++j) {
                const SidePoint& second = read.points[static_cast<std::size_t>(j)];
                side.covariance(i, j) = side.covariance(j, i) =
                    first.u_common.value_or(0.0) * second.u_common.value_or(0.0);
            }
            side.covariance(i, i) = first.uncertainty->u * first.uncertainty->u;
        }
    }

    void find_points_of_budget(const SideReading& read, ComparisonSide& side) {
        std::map<std::string, std::size_t> places;
        for (std::size_t i = 0; i < side.budget->points.size(); ++i) {
            places.emplace(side.budget->points[i].name, i);
        }
        std::vector<std::string> missing;
        for (const MethodPoint& point : request_->points) {
            const auto found = places.find(name_in_budget(point));
            if (side.budget->points.empty() && request_->points.size() == 1) {
                side.budget_points.push_back(0);
            } else if (found == places.end()) {
                missing.push_back(name_in_budget(point));
            } else {
                side.budget_points.push_back(found->second);
            }
        }
        if (!missing.empty()) {
            read.problems->refuse(k_comparison_budget, reading_.document.where("/" + read.key),
                                  "the budget " + in_quotes(side.budget_file) + " has no point " + list_of(missing),
                                  "a point of the comparison is the point of the budget with its name, or with its "
                                  "name, a dot and its direction",
                                  "correct the names of the points");
        }
    }

    /// The covariance file has the order of the side's own points.
    void read_covariance(SideReading& read, ComparisonSide& side) {
        const auto file = reading_.files.open(*read.covariance_name);
        const std::size_t n = read.points.size();
        const auto matrix = file && n > 0
                                ? read_csv_matrix(file->bytes, n, reading_.job.methods->unit.text(), *file->problems)
                                : std::nullopt;
        if (!matrix) {
            return;
        }
        const bool is_reference = read.key == "reference";
        const auto place = [&](Eigen::Index row) {
            const auto i = static_cast<std::size_t>(row);
            return static_cast<Eigen::Index>(is_reference ? reference_order_[i] : i);
        };
        Eigen::MatrixXd ordered(matrix->rows(), matrix->cols());
        for (Eigen::Index i = 0; i < matrix->rows(); ++i) {
            for (Eigen::Index j = 0; j < matrix->cols(); ++j) {
                ordered(place(i), place(j)) = (*matrix)(i, j);
            }
        }
        if (is_covariance(ordered, read, *file->problems)) {
            take_covariance(std::move(ordered), read, side, *file->problems);
        }
    }

    [[nodiscard]] std::string name_of(Eigen::Index i) const {
        return in_quotes(description(request_->points[static_cast<std::size_t>(i)]));
    }

    bool is_covariance(const Eigen::MatrixXd& matrix, const SideReading& read, ProblemList& problems) {
        const std::string where = printable(problems.file());
        const NumberRange range =
            between(k_least_compared_u * k_least_compared_u, k_largest_compared * k_largest_compared, "");
        for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
            if (!range.contains(matrix(i, i))) {
                problems.refuse(k_number_out_of_range, where,
                                "the variance of the point " + name_of(i) + " is " + shortest(matrix(i, i)),
                                "a variance is u², from 1e-120 to 1e120", "correct the matrix, or choose another unit");
                return false;
            }
            const auto& stated = read.points[static_cast<std::size_t>(i)].uncertainty;
            const double variance = stated ? stated->u * stated->u : matrix(i, i);
            if (std::abs(matrix(i, i) - variance) > k_same_variance * variance) {
                problems.refuse(k_comparison_covariance_diagonal, where,
                                "the variance of the point " + name_of(i) + " is " + shortest(matrix(i, i)) +
                                    ", and u² of the point is " + shortest(variance),
                                "they must agree within 1e-6", "state the uncertainty in one place only");
                return false;
            }
            for (Eigen::Index j = 0; j < i; ++j) {
                const double scale = std::sqrt(matrix(i, i)) * std::sqrt(matrix(j, j));
                if (!(std::abs(matrix(i, j) - matrix(j, i)) <= k_same_number * scale)) {
                    problems.refuse(k_comparison_covariance_asymmetric, where,
                                    "the covariance of the points " + name_of(i) + " and " + name_of(j) + " is " +
                                        shortest(matrix(i, j)) + " in one place and " + shortest(matrix(j, i)) +
                                        " in the other",
                                    "a covariance matrix is symmetric", "correct the matrix");
                    return false;
                }
            }
        }
        return is_positive(matrix, where, problems);
    }

    bool is_positive(const Eigen::MatrixXd& matrix, const std::string& where, ProblemList& problems) {
        const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::MatrixXd correlation = scale.asDiagonal() * matrix * scale.asDiagonal();
        const auto negative = negative_eigenvalue(correlation);
        if (!negative) {
            return true;
        }
        std::vector<std::string> culprits;
        for (const std::size_t i : negative->culprits) {
            culprits.push_back(description(request_->points[i]));
        }
        problems.refuse(k_comparison_covariance, where,
                        "the covariances of the points " + list_of(culprits) +
                            " cannot hold together: the smallest eigenvalue of their correlation matrix is " +
                            eigenvalue_text(negative->eigenvalue),
                        "a covariance matrix is positive semi-definite", "correct the matrix");
        return false;
    }

    void take_covariance(Eigen::MatrixXd matrix, const SideReading& read, ComparisonSide& side, ProblemList& problems) {
        for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
            const SidePoint& point = read.points[static_cast<std::size_t>(i)];
            std::optional<ResultUncertainty> uncertainty = point.uncertainty;
            if (!uncertainty) {
                const StatedUncertainty stated{.u = std::sqrt(matrix(i, i)), .has_u = true};
                uncertainty = evaluate(stated, reading_.job.coverage_probability);
            }
            if (!uncertainty) {
                problems.refuse(k_not_representable, printable(problems.file()),
                                "no expanded uncertainty of the point " + name_of(i), "the variance must be moderate",
                                "choose another unit");
                return;
            }
            // A diagonal with fewer digits than u would not give u back.
            matrix(i, i) = uncertainty->u * uncertainty->u;
            for (Eigen::Index j = 0; j < i; ++j) {
                matrix(j, i) = matrix(i, j);
            }
            side.uncertainty.push_back(*uncertainty);
        }
        side.covariance = std::move(matrix);
    }

    const ComparisonReading& reading_;
    const JsonObject& root_;
    MethodComparisonRequest* request_ = nullptr;
    std::vector<std::size_t> reference_order_;  ///< place among the points of each row of the reference's own table
};

}  // namespace

void read_methods(const ComparisonReading& reading, const JsonObject& root) {
    MethodsReader(reading, root).read();
}

}  // namespace gumcert::engine
