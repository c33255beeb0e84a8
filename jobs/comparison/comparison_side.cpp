#include "jobs/comparison/comparison_side.h"

#include <array>
#include <utility>

#include "jobs/comparison/comparison_compared_job.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_reader.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

constexpr std::string_view k_if_no_value = "remove the point from both sides";

constexpr std::array<std::string_view, 1> k_required_side_columns{"point"};
constexpr std::array<std::string_view, 10> k_optional_side_columns{
    "direction", "position", "value", "u", "U", "k", "nu", "u_common", "uncertainty", "unit"};
enum Column : std::size_t { c_point, c_direction, c_position, c_value, c_u, c_U, c_k, c_nu, c_common, c_bare, c_unit };
constexpr UncertaintyColumns k_uncertainty_columns{.u = c_u, .U = c_U, .k = c_k, .nu = c_nu, .bare = c_bare};
// A budget states them, and a table beside it may name points only.
constexpr std::array<std::string_view, 5> k_columns_of_budget{"value", "nu", "u_common", "uncertainty", "unit"};

bool are_too_many_points(std::size_t points, const std::string& where, ProblemList& problems) {
    if (points <= k_most_side_points) {
        return false;
    }
    problems.refuse(k_too_many_quantities, where, text::count_of(points, "point"),
                    "a comparison has at most " + std::to_string(k_most_side_points) + " points", "split the data");
    return true;
}

class SideReader {
public:
    SideReader(const ComparisonReading& reading, const JsonObject& root, const std::optional<gum::Unit>& unit)
        : reading_(reading), root_(root), unit_(unit) {}

    SideReading read(const std::string& key, const std::string& default_name) {
        side_.key = key;
        side_.side.name = default_name;
        side_.problems = &reading_.problems;
        const std::size_t refused = reading_.problems.refusals();
        const json* value = root_.require(key) ? root_.find(key) : nullptr;
        if (value == nullptr) {
            side_.is_whole = false;
        } else if (value->is_string()) {
            read_table(root_, key);
        } else if (!value->is_object()) {
            root_.refuse(k_wrong_type, key, described(*value), "must be the name of a CSV file or an object",
                         "write {\"points\": \"" + key + ".csv\"}");
        } else {
            read_object(*root_.optional_object(key, keys_of<SideReading>()));
        }
        side_.is_whole = side_.is_whole && reading_.problems.refusals() == refused;
        return std::move(side_);
    }

private:
    void read_object(const JsonObject& object) {
        JobReader reader(object);
        reader.read(side_, {"name", "cmc_U", "audited"});
        if (object.has("job")) {
            side_.has_job = true;
            side_.has_points = true;
            read_compared_job(reading_, object, unit_, side_);
            return;
        }
        if (object.has("of")) {
            object.refuse(k_compared_job, "of", "\"of\" without \"job\"",
                          "\"of\" says which result of a job of kind \"circle_closure\" is compared",
                          "remove it, or add \"job\"");
        }
        if (object.has("budget")) {
            read_budget(object);
        }
        reader.read(side_, {"covariance"});
        if (object.has("covariance") && object.has("budget")) {
            object.refuse(k_stated_beside_budget, "covariance", "a covariance beside a budget",
                          "the covariance of the points is that of the budget", "remove one of the two");
        }
        if (object.has("points")) {
            read_points(object);
        } else if (!object.has("budget")) {
            object.refuse(k_missing_key, "", "a side without \"points\" and without \"budget\"",
                          "the values of a side are in a table, in an array or in a budget", "add one of them");
        }
    }

    void read_budget(const JsonObject& object) {
        side_.has_budget = true;
        const auto name = JobFiles::file_name(object, "budget", true);
        side_.side.budget = name ? reading_.budgets.read(*name) : nullptr;
        if (!side_.side.budget) {
            side_.is_whole = false;
            return;
        }
        side_.side.budget_file = *name;
        (void)are_too_many_points(side_.side.budget->points.size(), object.where("budget"), reading_.problems);
        if (unit_) {
            refuse_other_results(*side_.side.budget, *unit_, object.where("budget"), reading_.problems);
        }
    }

    // ---- points in the job ------------------------------------------------------------------------------------------

    void read_points(const JsonObject& object) {
        const json* points = object.find("points");
        if (points == nullptr) {
            return;  // refused while the text was read
        }
        if (points->is_string()) {
            read_table(object, "points");
            return;
        }
        if (!points->is_array()) {
            object.refuse(k_wrong_type, "points", described(*points), "must be the name of a CSV file or an array",
                          "correct the value");
            return;
        }
        side_.has_points = true;
        if (points->empty()) {
            object.refuse(k_wrong_size, "points", "an empty list of points", "there must be at least one",
                          "list the points with their values");
        }
        if (!are_too_many_points(points->size(), object.where("points"), reading_.problems)) {
            for_each_object(reading_, *points, object.pointer("points"), keys_of<SidePoint>(),
                            keys_and_bare_of<SidePoint>(), [&](const JsonObject& point) { read_point(point); });
        }
    }

    void read_point(const JsonObject& object) {
        SidePoint read;
        read.where = object.where();
        JobReader reader(object);
        reader.read(read, {"point", "direction", "position"});
        if (side_.has_budget) {
            for (const std::string_view key : {"value", "u", "U", "k", "nu", "u_common"}) {
                if (object.has(key)) {
                    object.refuse(k_stated_beside_budget, key, text::in_quotes(key) + " beside a budget",
                                  "values and uncertainties are those of the budget", "remove the key, or the budget");
                }
            }
        } else {
            object.require("value");
            read.value = read_value(reading_, object, k_if_no_value).value_or(0.0);
            read.uncertainty = read_uncertainty(reading_, object);
            reader.read(read, {"u_common"});
            check_point(read, states_uncertainty(object), reading_.problems);
        }
        if (reader.accepted("point")) {
            side_.points.push_back(std::move(read));
        }
    }

    void check_point(const SidePoint& read, bool states_uncertainty, ProblemList& problems) const {
        if (!states_uncertainty && !side_.covariance_name) {
            problems.refuse(k_bare_uncertainty, read.where,
                            "the point " + text::in_quotes(read.point.name) + " has no uncertainty",
                            "every point has u, or U with k, unless a covariance states it", "add the uncertainty");
        }
        if (read.u_common && side_.covariance_name) {
            problems.refuse(k_stated_beside_budget, read.where, "u_common beside a covariance",
                            "what the points share is in the covariance", "remove one of the two");
        } else if (read.u_common && read.uncertainty && *read.u_common > read.uncertainty->u * (1.0 + k_same_number)) {
            problems.refuse(k_parts_exceed_uncertainty, read.where,
                            "u_common is " + text::shortest_plain(*read.u_common) + ", and u of the point is " +
                                text::shortest_plain(read.uncertainty->u),
                            "what all points share is a part of the standard uncertainty of each",
                            "state u_common as a standard uncertainty, not larger than u");
        }
    }

    // ---- points in a table ------------------------------------------------------------------------------------------

    void read_table(const JsonObject& object, std::string_view key) {
        side_.has_points = true;
        const auto name = JobFiles::file_name(object, key, true);
        auto file = name ? reading_.files.open(*name) : std::nullopt;
        if (!file) {
            side_.is_whole = false;
            return;
        }
        ProblemList& problems = *file->problems;
        side_.problems = &problems;
        const auto table =
            read_csv_table(std::move(file->bytes), k_required_side_columns, k_optional_side_columns, problems);
        UncertaintyColumns columns = k_uncertainty_columns;
        if (side_.has_budget) {
            columns.idle = k_columns_of_budget;
        }
        if (!table ||
            !check_uncertainty_columns(*table, columns, problems,
                                       side_.has_budget || side_.covariance_name.has_value()) ||
            are_too_many_points(table->rows(), text::visible(problems.file()), problems) ||
            !check_columns(*table, problems)) {
            side_.is_whole = false;
            return;
        }
        for (std::size_t row = 0; row < table->rows(); ++row) {
            read_row(*table, row, problems);
        }
        side_.is_whole = side_.is_whole && problems.refusals() == 0;
    }

    /// Columns that no row can use, or that every row needs.
    /// \return true when there was nothing to refuse
    [[nodiscard]] bool check_columns(const CsvTable& table, ProblemList& problems) const {
        const auto refuse = [&](const InputCode& code, Column column, const std::string& what, const std::string& rule,
                                const std::string& action) {
            problems.refuse(code, table.where(table.cell(0, column)), what, rule, action);
            return false;
        };
        const bool has_uncertainty = table.has_column(c_u) || table.has_column(c_U);
        if (side_.has_budget) {
            return (!table.has_column(c_value) && !has_uncertainty) ||
                   refuse(k_stated_beside_budget, c_point, "values or uncertainties beside a budget",
                          "values and uncertainties are those of the budget; the table may name the points",
                          "keep the columns point, direction and position, or remove the budget");
        }
        if (!table.has_column(c_value)) {
            return refuse(k_csv_missing_column, c_point, "the column \"value\" is missing", "every point has a value",
                          "add the column");
        }
        if (!has_uncertainty && !side_.covariance_name) {
            return refuse(k_bare_uncertainty, c_point, "a table without uncertainties",
                          "every point has u, or U with k, unless a covariance states it",
                          "add a column u, or columns U and k");
        }
        if (side_.covariance_name && table.has_column(c_common)) {
            return refuse(k_stated_beside_budget, c_common, "a column u_common beside a covariance",
                          "what the points share is in the covariance", "remove one of the two");
        }
        return true;
    }

    void read_row(const CsvTable& table, std::size_t row, ProblemList& problems) {
        SidePoint read;
        read.where = table.where(table.cell(row, c_point));
        const auto name = table.name(row, c_point);
        read.point.name = std::string(name.value_or(""));
        if (is_stated(table, row, c_direction)) {
            read.point.direction = std::string(table.name(row, c_direction).value_or(""));
        }
        read.point.position = table.number_if_any(row, c_position, k_compared_value);
        if (!side_.has_budget) {
            if (unit_) {
                check_unit_of_row(table, row, c_unit, *unit_, "the comparison", problems);
            }
            read.value = read_value(table, row, c_value, k_if_no_value, problems).value_or(0.0);
            read.uncertainty =
                read_uncertainty(table, row, k_uncertainty_columns, reading_.job.coverage_probability, problems);
            read.u_common = table.number_if_any(row, c_common, k_deviation);
            const bool states_uncertainty =
                is_stated(table, row, c_u) || is_stated(table, row, c_U) || is_stated(table, row, c_k);
            check_point(read, states_uncertainty, problems);
        }
        if (name) {
            side_.points.push_back(std::move(read));
        }
    }

    const ComparisonReading& reading_;
    const JsonObject& root_;
    const std::optional<gum::Unit>& unit_;
    SideReading side_;
};

}  // namespace

SideReading read_side(const ComparisonReading& reading, const JsonObject& root, const std::string& key,
                      const std::string& default_name, const std::optional<gum::Unit>& unit) {
    return SideReader(reading, root, unit).read(key, default_name);
}

}  // namespace gumcert::jobs
