#include "jobs/comparison/comparison_methods.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "jobs/budget/budget_fit_statement.h"
#include "jobs/comparison/comparison_covariance.h"
#include "jobs/comparison/comparison_side.h"
#include "jobs/comparison/comparison_statement.h"
#include "jobs/job_reader.h"
#include "text/counts.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

using PointKey = std::pair<std::string, std::string>;
PointKey key_of_point(const MethodPoint& point) {
    return {point.name, point.direction};
}
/// The name of a point of a budget that stands for a point of the comparison.
std::string name_in_budget(const MethodPoint& point) {
    return point.direction.empty() ? point.name : point.name + "." + point.direction;
}

/// The keys of the job, and both sides together: which point of one is which of the other.
class MethodsReader {
public:
    MethodsReader(const ComparisonReading& reading, const JsonObject& root) : reading_(reading), root_(root) {}

    void read() {
        request_ = &reading_.job.methods.emplace();
        read_unit_and_position();
        SideReading laboratory = read_side(reading_, root_, "lab", "laboratory", unit_);
        SideReading reference = read_side(reading_, root_, "reference", "reference", unit_);
        read_correlation(laboratory, reference);
        JobReader(root_).read(*request_, {"bias_line", "tolerance"});
        if (match(laboratory, reference)) {
            check_directions(laboratory);
            check_positions();
            finish(laboratory, laboratory_order_, request_->laboratory);
            finish(reference, reference_order_, request_->reference);
        }
    }

private:
    // ---- keys of the job --------------------------------------------------------------------------------------------

    void read_unit_and_position() {
        if (root_.has("unit")) {
            unit_ = read_unit(root_, "unit", reading_.problems);
        }
        request_->unit = unit_.value_or(gum::Unit{});
        if (const auto position = root_.optional_object("position", keys_of<MethodComparisonRequest, PositionKeys>())) {
            JobReader(*position).read(*request_, PositionKeys());
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
            request_->correlation = MethodCorrelation::given;
            request_->r = root_.optional_number("correlation", k_correlation_coefficient).value_or(0.0);
            return;
        }
        const auto word = root_.optional_choice("correlation", k_method_correlations);
        request_->correlation = word.value_or(request_->correlation);
        if (word == MethodCorrelation::shared_sources && !have_budgets && laboratory.is_whole && reference.is_whole) {
            root_.refuse(k_no_shared_sources, "correlation", "\"shared_sources\" where not both sides have a budget",
                         "sources that are shared are found in two budgets",
                         "add the budgets, state r as a number, or write \"unknown\"");
        }
    }

    // ---- both sides together ----------------------------------------------------------------------------------------

    static constexpr std::size_t k_least_angles = 3;

    /// The points of the comparison: those of the laboratory, or of the reference where only it lists them, or those
    /// of the budget of the laboratory. Brings the reference into this order.
    bool match(SideReading& laboratory, SideReading& reference) {
        bool is_whole = laboratory.is_whole && reference.is_whole;
        for (SideReading* side : {&laboratory, &reference}) {
            // A faulty number was reported while the text was read: then there may be neither points nor a budget.
            is_whole = are_distinct(*side) && (side->has_points || side->side.budget) && is_whole;
        }
        if (!is_whole) {
            return false;
        }
        // The points of a side without a list are known by those of the other one.
        for (auto [side, other] : {std::pair(&laboratory, &reference), std::pair(&reference, &laboratory)}) {
            if (!side->has_points) {
                name_points_of_budget(*side, other->points);
            }
        }
        drop_angles_without_counterpart(laboratory, reference);
        drop_angles_without_counterpart(reference, laboratory);
        const bool has_reference = has_counterparts(laboratory, reference, "reference");
        const bool has_laboratory = has_counterparts(reference, laboratory, "laboratory");
        if (!has_reference || !has_laboratory) {
            return false;
        }
        std::map<PointKey, std::size_t> places;
        for (std::size_t i = 0; i < laboratory.points.size(); ++i) {
            places.emplace(key_of_point(laboratory.points[i].point), i);
        }
        std::vector<SidePoint> ordered(laboratory.points.size());
        for (SidePoint& point : reference.points) {
            const std::size_t at = places.at(key_of_point(point.point));
            reference_order_.push_back(at);
            ordered[at] = std::move(point);
        }
        reference.points = std::move(ordered);
        for (std::size_t i = 0; i < laboratory.points.size(); ++i) {
            laboratory_order_.push_back(i);
            const SidePoint& of_reference = reference.points[i];
            std::optional<double>& position = laboratory.points[i].point.position;
            const std::optional<double>& other = of_reference.point.position;
            if (position && other && *position != *other) {
                reference.problems->refuse(k_points_differ, of_reference.where,
                                           "the point " + text::in_quotes(description(of_reference.point)) + " is at " +
                                               text::shortest_plain(*other) +
                                               ", and on the side of the laboratory at " +
                                               text::shortest_plain(*position),
                                           "both methods measured the same points", "correct the position");
            }
            position = position ? position : other;
            request_->points.push_back(laboratory.points[i].point);
        }
        return true;
    }

    static bool are_distinct(const SideReading& side) {
        std::map<PointKey, const SidePoint*> seen;
        bool are = true;
        for (const SidePoint& point : side.points) {
            const auto [entry, is_new] = seen.try_emplace(key_of_point(point.point), &point);
            if (!is_new) {
                are = false;
                side.problems->refuse(k_repeated_comparison_point, point.where,
                                      "the point " + text::in_quotes(point.point.name) +
                                          (point.point.direction.empty()
                                               ? ""
                                               : " in the direction " + text::in_quotes(point.point.direction)) +
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
        const std::vector<gum::BudgetPoint>& points = side.side.budget->points;
        const std::size_t count = std::max<std::size_t>(points.size(), 1);
        for (std::size_t i = 0; i < count; ++i) {
            SidePoint read;
            read.where = text::visible(side.side.budget_file) + "#/points";
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

    /// A job has angles that the other method did not measure: they are left out.
    void drop_angles_without_counterpart(SideReading& side, const SideReading& other) {
        if (!side.has_job) {
            return;
        }
        std::set<PointKey> known;
        for (const SidePoint& point : other.points) {
            known.insert(key_of_point(point.point));
        }
        std::vector<SidePoint> kept;
        std::vector<std::size_t> angles;
        for (std::size_t i = 0; i < side.points.size(); ++i) {
            if (known.contains(key_of_point(side.points[i].point))) {
                kept.push_back(std::move(side.points[i]));
                angles.push_back(side.side.job_angles[i]);
            }
        }
        if (kept.size() < k_least_angles) {
            root_.refuse(k_compared_job, side.key,
                         text::count_of(kept.size(), "angle") + " of the job " + text::in_quotes(side.side.job_file) +
                             " were measured on the other side",
                         "deviations of an angle are compared at 3 angles at least, because their mean is taken off",
                         "measure common angles; points of a table are named by the angle in degrees, \"30\"");
        }
        side.points = std::move(kept);
        side.side.job_angles = std::move(angles);
    }

    /// Refuses the points of one side that the other one does not have.
    /// \return true when there are none
    static bool has_counterparts(const SideReading& side, const SideReading& other, const std::string& name_of_other) {
        std::set<PointKey> known;
        for (const SidePoint& point : other.points) {
            known.insert(key_of_point(point.point));
        }
        std::vector<std::string> missing;
        std::string where;
        for (const SidePoint& point : side.points) {
            if (!known.contains(key_of_point(point.point))) {
                where = missing.empty() ? point.where : where;
                missing.push_back(description(point.point));
            }
        }
        if (!missing.empty()) {
            side.problems->refuse(k_points_differ, where,
                                  (missing.size() == 1 ? "the point " : "the points ") + list_of(missing) +
                                      (missing.size() == 1 ? " has" : " have") + " no counterpart on the side of the " +
                                      name_of_other,
                                  "both methods have the same points, by name and direction, letter by letter",
                                  "add the points to the other side, or remove them from this one");
        }
        return missing.empty();
    }

    /// The summary of all directions together is named so in the record.
    static void check_directions(const SideReading& laboratory) {
        for (const SidePoint& point : laboratory.points) {
            if (point.point.direction == "all") {
                laboratory.problems->refuse(k_reserved_direction, point.where, "a direction \"all\"",
                                            "\"all\" stands for all directions together",
                                            "give the direction another name");
                return;
            }
        }
    }

    void check_positions() {
        std::vector<std::string> without;
        for (const MethodPoint& point : request_->points) {
            if (!point.position) {
                without.push_back(description(point));
            }
        }
        if (request_->bias_against_position && !without.empty()) {
            root_.refuse(k_no_position, "bias_line",
                         list_of(without) + (without.size() == 1 ? " has" : " have") + " no position",
                         "a bias line against the position needs the position of every point",
                         "add the column position, or write \"bias_line\": \"reference_value\"");
        }
    }

    // ---- what the application gets ----------------------------------------------------------------------------------

    void finish(SideReading& read, std::span<const std::size_t> order, ComparisonSide& side) {
        side = std::move(read.side);
        if (side.has_job()) {
            std::vector<std::size_t> angles(order.size());
            for (std::size_t i = 0; i < order.size(); ++i) {
                angles[order[i]] = side.job_angles[i];
            }
            side.job_angles = std::move(angles);
            return;
        }
        if (side.budget) {
            find_points_of_budget(read.key, side);
            return;
        }
        for (const SidePoint& point : read.points) {
            side.value.push_back(point.value);
        }
        if (read.covariance_name) {
            read_point_covariance(reading_, read, order, side);
        } else {
            covariance_of_points(read.points, side);
        }
    }

    void find_points_of_budget(const std::string& key, ComparisonSide& side) {
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
            root_.refuse(k_comparison_budget, key,
                         "the budget " + text::in_quotes(side.budget_file) + " has no point " + list_of(missing),
                         "a point of the comparison is the point of the budget with its name, or with its "
                         "name, a dot and its direction",
                         "correct the names of the points");
        }
    }

    const ComparisonReading& reading_;
    const JsonObject& root_;
    MethodComparisonRequest* request_ = nullptr;
    std::optional<gum::Unit> unit_ = gum::Unit{};  ///< nothing: refused
    // Place among the points of the comparison of each row of a side's own table.
    std::vector<std::size_t> laboratory_order_, reference_order_;
};

}  // namespace

void read_methods(const ComparisonReading& reading, const JsonObject& root) {
    MethodsReader(reading, root).read();
}

}  // namespace gumcert::jobs
