#include "jobs/rotary_table/rotary_table_study.h"
#include "jobs/job_reader.h"
#include "jobs/rotary_table/rotary_table_fields.h"
#include "text/numbers.h"
#include "text/visible_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace gumcert::jobs {

namespace {

using gum::k_micrometre;
using gum::k_millimetre;

constexpr double k_most_candidates = 100'000.0;
constexpr std::array<std::string_view, 3> k_coordinate_keys{"x_mm", "y_mm", "z_mm"};

void read_counts(const JsonObject& object, std::vector<std::size_t>& counts) {
    const nlohmann::json* array = object.optional_array("angle_counts");
    if (array == nullptr) {
        return;
    }
    const auto numbers = object.required_numbers("angle_counts", array->size(), k_angle_count.range);
    for (const double number : numbers.value_or(std::vector<double>{})) {
        if (number != std::floor(number)) {
            object.refuse(k_not_an_integer, "angle_counts", text::shortest_plain(number), "must be whole numbers",
                          "write numbers without fraction");
            return;
        }
        counts.push_back(static_cast<std::size_t>(number));
    }
}

void read_angles(const JsonObject& plan, std::vector<double>& angles) {
    const nlohmann::json* value = plan.find("angles_deg");
    if (value == nullptr) {
        return;
    }
    if (value->is_object()) {
        const auto object = plan.optional_object("angles_deg", keys_of<AngleSteps>());
        AngleSteps steps;
        JobReader reader(*object);
        reader.read(steps);
        if (!reader.accepted("first") || !reader.accepted("step") || !reader.accepted("count")) {
            return;
        }
        const double last = steps.first + steps.step * static_cast<double>(steps.count - 1);
        if (last > k_angle.high) {
            object->refuse(k_number_out_of_range, "count", "the last angle is " + text::shortest_plain(last) + "°",
                           k_angle.rule(), "state fewer angles");
            return;
        }
        for (std::size_t i = 0; i < steps.count; ++i) {
            angles.push_back(steps.first + steps.step * static_cast<double>(i));
        }
        return;
    }
    if (!value->is_array()) {
        plan.refuse(k_wrong_type, "angles_deg", described(*value), "must be an array of angles or an object",
                    "write [0, 10, 20] or {\"first\": 0, \"step\": 10, \"count\": 36}");
        return;
    }
    if (value->empty() || static_cast<double>(value->size()) > k_most_planned_angles) {
        plan.refuse(k_wrong_size, "angles_deg", "an array of " + std::to_string(value->size()) + " elements",
                    "must have 1 to " + text::shortest_plain(k_most_planned_angles) + " angles", "correct the array");
        return;
    }
    auto numbers = plan.required_numbers("angles_deg", value->size(), k_angle);
    if (!numbers) {
        return;
    }
    std::sort(numbers->begin(), numbers->end());
    for (std::size_t i = 1; i < numbers->size(); ++i) {
        if ((*numbers)[i] - (*numbers)[i - 1] <= k_same_angle_deg) {
            plan.refuse(k_repeated_angle, "angles_deg",
                        "the angle " + text::shortest_plain((*numbers)[i]) + "° occurs twice",
                        "every angle is stated once", "remove one of the two");
            return;
        }
    }
    angles = std::move(*numbers);
}

void read_region(const JsonObject& plan, gum::PlanRequest& request) {
    const auto region = plan.optional_object("station_region", keys_of<RegionStatement>());
    if (!region) {
        return;
    }
    RegionStatement stated;
    JobReader reader(*region);
    const std::array<const LimitsMm*, 3> limits_of{&stated.x, &stated.y, &stated.z};
    std::array<Eigen::Vector3d, 2> corners{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    bool is_whole = true;
    for (std::size_t k = 0; k < k_coordinate_keys.size(); ++k) {
        const LimitsMm& limits = *limits_of[k];
        reader.read(stated, {k_coordinate_keys[k]});
        if (limits[0] > limits[1]) {
            region->refuse(
                k_limits_reversed, k_coordinate_keys[k],
                "from " + text::shortest_plain(limits[0]) + " mm to " + text::shortest_plain(limits[1]) + " mm",
                "the lower limit stands first", "exchange the two");
        }
        is_whole = is_whole && reader.accepted(k_coordinate_keys[k]) && limits[0] <= limits[1];
        for (std::size_t c = 0; is_whole && c < 2; ++c) {
            corners[c](static_cast<Eigen::Index>(k)) = limits[c] * k_millimetre;
        }
    }
    reader.read(stated, {"step_mm"});
    request.station_step = stated.step.value_or(request.station_step);
    if (!is_whole || (region->has("step_mm") && !stated.step)) {
        return;
    }
    double candidates = 1.0;
    for (Eigen::Index k = 0; k < 3; ++k) {
        candidates *= std::floor((corners[1](k) - corners[0](k)) / request.station_step + 1e-9) + 1.0;
    }
    if (candidates > k_most_candidates) {
        region->refuse(k_layout_too_large, "step_mm",
                       text::shortest_plain(candidates) + " positions in steps of " +
                           text::shortest_plain(request.station_step / k_millimetre) + " mm",
                       "at most " + text::shortest_plain(k_most_candidates) + " positions are tried",
                       "state a larger step or a smaller region");
        return;
    }
    request.station_region = corners;
}

/// Reads lower and upper limit of a solid.
/// \param limits  the member of `stated` that is read, [mm]
/// \return the limits, [m]
template <class Solid>
std::optional<std::array<double, 2>> read_extent(const JsonObject& object, JobReader& reader, Solid& stated,
                                                 std::string_view key, const LimitsMm& limits) {
    reader.read(stated, {key});
    if (!reader.accepted(key)) {
        return std::nullopt;
    }
    if (!(limits[0] < limits[1])) {
        object.refuse(k_limits_reversed, key,
                      "from " + text::shortest_plain(limits[0]) + " mm to " + text::shortest_plain(limits[1]) + " mm",
                      "an obstacle has an extent, and its lower limit stands first", "correct the two");
        return std::nullopt;
    }
    return std::array<double, 2>{limits[0] * k_millimetre, limits[1] * k_millimetre};
}

/// Every object of a list, with what reads it.
template <class Statement, class Read>
void read_list(const JsonDocument& document, const JsonObject& object, std::string_view key, ProblemList& problems,
               const Read& read) {
    const nlohmann::json* entries = object.optional_array(key);
    for (std::size_t i = 0; entries != nullptr && i < entries->size(); ++i) {
        const std::string pointer = child_pointer(object.pointer(key), i);
        if (!(*entries)[i].is_object()) {
            problems.refuse(k_wrong_type, document.where(pointer), described((*entries)[i]), "must be an object",
                            "write { … } for each of the list");
            continue;
        }
        read(JsonObject(document, pointer, keys_of<Statement>(), problems));
    }
}

void read_cylinder(const JsonObject& object, gum::SightStatement& sight) {
    CylinderStatement stated;
    JobReader reader(object);
    reader.read(stated, {"name", "radius_mm"});
    const auto along = read_extent(object, reader, stated, "along_axis_mm", stated.along_axis);
    if (reader.accepted("name") && reader.accepted("radius_mm") && along) {
        engine::Obstacle obstacle;
        obstacle.name = stated.name;
        obstacle.radius = stated.radius;
        obstacle.low.setConstant((*along)[0]);
        obstacle.high.setConstant((*along)[1]);
        sight.obstacles.push_back(std::move(obstacle));
        sight.obstacles_where.push_back(object.where());
    }
}

void read_box(const JsonObject& object, gum::SightStatement& sight) {
    engine::Obstacle obstacle;
    BoxStatement stated;
    JobReader reader(object);
    reader.read(stated, {"name"});
    bool is_whole = reader.accepted("name");
    const std::array<const LimitsMm*, 3> limits{&stated.x, &stated.y, &stated.z};
    for (std::size_t k = 0; k < k_coordinate_keys.size(); ++k) {
        const auto extent = read_extent(object, reader, stated, k_coordinate_keys[k], *limits[k]);
        is_whole = is_whole && extent;
        if (extent) {
            obstacle.low(static_cast<Eigen::Index>(k)) = (*extent)[0];
            obstacle.high(static_cast<Eigen::Index>(k)) = (*extent)[1];
        }
    }
    reader.read(stated, {"turns"});
    obstacle.turns = stated.turns;
    if (is_whole) {
        obstacle.name = stated.name;
        sight.obstacles.push_back(std::move(obstacle));
        sight.obstacles_where.push_back(object.where());
    }
}

void read_facing(const JsonObject& object, gum::SightStatement& sight) {
    FacingStatement stated;
    JobReader reader(object);
    reader.read(stated);
    if (!reader.accepted("reflector") || !reader.accepted("direction")) {
        return;
    }
    const Eigen::Vector3d vector(stated.direction[0], stated.direction[1], stated.direction[2]);
    constexpr double k_shortest = 1e-6;
    if (vector.norm() < k_shortest) {
        object.refuse(k_number_out_of_range, "direction", "[0, 0, 0]", "a direction has a length",
                      "state where the reflector looks, such as [0, 0, 1]");
        return;
    }
    sight.facing.push_back({stated.reflector, object.where("reflector"), vector.normalized()});
}

void read_sight(const JsonDocument& document, const JsonObject& plan, gum::SightStatement& sight,
                ProblemList& problems) {
    const auto object = plan.optional_object("sight", keys_of<SightKeys>());
    if (!object) {
        return;
    }
    read_list<CylinderStatement>(document, *object, "cylinders", problems,
                                 [&](const JsonObject& cylinder) { read_cylinder(cylinder, sight); });
    read_list<BoxStatement>(document, *object, "boxes", problems, [&](const JsonObject& box) { read_box(box, sight); });
    SightKeys stated;
    JobReader(*object).read(stated);
    sight.reflector_diameter = stated.reflector_diameter.value_or(sight.reflector_diameter);
    sight.acceptance_angle = stated.acceptance_angle;
    read_list<FacingStatement>(document, *object, "facing", problems,
                               [&](const JsonObject& facing) { read_facing(facing, sight); });
    const bool has_facing = object->has("facing");
    if (object->has("acceptance_angle_deg") != has_facing) {
        problems.warn(
            k_warn_unused_value, object->where(has_facing ? "facing" : "acceptance_angle_deg"),
            std::string(has_facing ? "facing" : "acceptance_angle_deg") + " is not used",
            "whether a reflector accepts a beam follows from the angle that it accepts and from where it looks",
            has_facing ? "add acceptance_angle_deg" : "add facing, or remove it");
    }
}

}  // namespace

void check_facing(const gum::PlanRequest& plan, const std::vector<std::string>& reflectors, ProblemList& problems) {
    std::vector<std::string_view> seen;
    for (const gum::SightStatement::Facing& facing : plan.sight.facing) {
        if (std::find(reflectors.begin(), reflectors.end(), facing.reflector) == reflectors.end()) {
            problems.refuse(k_unknown_reflector, facing.where, "the reflector " + text::in_quotes(facing.reflector),
                            "is not in the coordinates file", "correct the name");
        } else if (std::find(seen.begin(), seen.end(), facing.reflector) != seen.end()) {
            problems.refuse(k_repeated_name, facing.where, "the reflector " + text::in_quotes(facing.reflector),
                            "looks in one direction", "remove one of the two");
        }
        seen.emplace_back(facing.reflector);
    }
}

void warn_of_same_positions(const std::vector<double>& angles_deg, const std::string& where, ProblemList& problems) {
    constexpr double k_turn = 360.0;  // [°]
    for (std::size_t i = 1; i < angles_deg.size(); ++i) {
        for (double below = angles_deg[i] - k_turn; below >= angles_deg.front() - k_same_angle_deg; below -= k_turn) {
            const auto found = std::lower_bound(angles_deg.begin(), angles_deg.end(), below - k_same_angle_deg);
            if (found != angles_deg.end() && std::abs(*found - below) <= k_same_angle_deg) {
                problems.warn(k_warn_same_position, where,
                              "the angles " + text::shortest_plain(*found) + "° and " +
                                  text::shortest_plain(angles_deg[i]) + "° are one position of the table",
                              "each has error motions of its own, and means over the angles count the position twice",
                              "leave one of them out unless the turn is to be compared with itself");
                return;
            }
        }
    }
}

std::optional<gum::SimulationRequest> read_simulation(const JsonObject& root, ProblemList& problems) {
    const auto object = root.optional_object("simulation", keys_of<SimulationStatement>());
    if (!object) {
        return std::nullopt;
    }
    SimulationStatement stated;
    gum::SimulationRequest& request = stated.request;
    JobReader reader(*object);
    reader.read(stated, {"runs", "seed", "set_up_offset_um", "set_up_tilt_arcsec", "error_linear_um",
                         "error_angular_arcsec", "table_repeatability"});
    if (const auto outliers = object->optional_object("outliers", keys_of<PlantedOutliers>())) {
        JobReader of_outliers(*outliers);
        of_outliers.read(stated.outliers);
        request.outliers = stated.outliers.count;
        request.outlier_size = stated.outliers.size.value_or(request.outlier_size);
        if (const auto size = of_outliers.number("size_um"); size && request.outliers == 0) {
            problems.warn(k_warn_unused_value, outliers->where("size_um"),
                          "size_um " + text::shortest_plain(*size) + " µm" + " is not used",
                          "no outliers are asked for", "remove it, or state their count");
        }
    }
    read_counts(*object, request.angle_counts);
    return std::move(request);
}

std::optional<gum::PlanRequest> read_plan(const JsonDocument& document, const JsonObject& root, ProblemList& problems) {
    const auto object = root.optional_object("plan", keys_of<PlanStatement>());
    if (!object) {
        return std::nullopt;
    }
    PlanStatement stated;
    gum::PlanRequest& request = stated.request;
    JobReader reader(*object);
    read_angles(*object, request.angles_deg);
    warn_of_same_positions(request.angles_deg, object->where("angles_deg"), problems);
    reader.read(stated, {"senses", "dead_paths", "targets"});
    read_region(*object, request);
    const auto warn_without_region = [&](std::string_view key, const std::string& what) {
        if (!object->has("station_region")) {
            problems.warn(k_warn_unused_value, object->where(key), what + " is not used",
                          "it belongs to station_region: without one, stations are not moved",
                          "remove it, or state a region");
        }
    };
    reader.read(stated, {"least_distance_mm"});
    request.least_distance = stated.least_distance.value_or(request.least_distance);
    reader.read(stated, {"keep_met_targets"});
    if (request.keep_met_targets) {
        warn_without_region("keep_met_targets", "keep_met_targets");
    }
    read_sight(document, *object, request.sight, problems);
    return std::move(request);
}

}  // namespace gumcert::jobs
