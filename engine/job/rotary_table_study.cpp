#include "engine/job/rotary_table_study.h"
#include "engine/job/monte_carlo_request.h"
#include "engine/job/rotary_table_limits.h"
#include "text/numbers.h"
#include "text/visible_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace gumcert::engine {

namespace {

using gum::k_arcsecond;
using gum::k_micrometre;
using gum::k_millimetre;

constexpr std::array<std::string_view, 9> k_simulation_keys{"runs",
                                                            "seed",
                                                            "set_up_offset_um",
                                                            "set_up_tilt_arcsec",
                                                            "error_linear_um",
                                                            "error_angular_arcsec",
                                                            "table_repeatability",
                                                            "outliers",
                                                            "angle_counts"};
constexpr std::array<std::string_view, 3> k_coordinate_keys{"x_mm", "y_mm", "z_mm"};
constexpr std::array<std::string_view, 3> k_simulated_table_keys{"u_linear_um", "u_axial_arcsec", "u_tilt_arcsec"};
constexpr std::array<std::string_view, 2> k_simulated_outliers_keys{"count", "size_um"};
constexpr std::array<std::string_view, 8> k_plan_keys{"angles_deg",       "senses",         "dead_paths",
                                                      "targets",          "station_region", "least_distance_mm",
                                                      "keep_met_targets", "sight"};
constexpr std::array<std::string_view, 3> k_angles_keys{"first", "step", "count"};
constexpr std::array<std::string_view, 9> k_targets_keys{
    "linear_um", "angular_arcsec", "range_linear_um", "range_angular_arcsec", "location_um", "location_arcsec",
    "E_arcsec",  "R_arcsec",       "A_arcsec"};
constexpr std::array<std::string_view, 5> k_sight_keys{"cylinders", "boxes", "reflector_diameter_mm",
                                                       "acceptance_angle_deg", "facing"};
constexpr std::array<std::string_view, 3> k_cylinder_keys{"name", "radius_mm", "along_axis_mm"};
constexpr std::array<std::string_view, 5> k_box_keys{"name", "x_mm", "y_mm", "z_mm", "turns"};
constexpr std::array<std::string_view, 2> k_facing_keys{"reflector", "direction"};
constexpr std::array<std::string_view, 4> k_region_keys{"x_mm", "y_mm", "z_mm", "step_mm"};

const std::array<JobKeys, 11> k_all_keys{{{"/simulation", k_simulation_keys},
                                          {"/simulation/table_repeatability", k_simulated_table_keys},
                                          {"/simulation/outliers", k_simulated_outliers_keys},
                                          {"/plan", k_plan_keys},
                                          {"/plan/angles_deg", k_angles_keys},
                                          {"/plan/targets", k_targets_keys},
                                          {"/plan/station_region", k_region_keys},
                                          {"/plan/sight", k_sight_keys},
                                          {"/plan/sight/cylinders/*", k_cylinder_keys},
                                          {"/plan/sight/boxes/*", k_box_keys},
                                          {"/plan/sight/facing/*", k_facing_keys}}};

constexpr double k_most_runs = 1e6;
constexpr double k_most_angles = 100'000.0;
constexpr double k_most_candidates = 100'000.0;
// Beyond a centimetre and ten degrees it is not a set-up error and not an error motion.
constexpr NumberRange k_small_linear{
    .low = 0.0, .high = 10'000.0, .unit = "µm", .hint = "check the unit: it is stated in micrometres"};
constexpr NumberRange k_small_angular{
    .low = 0.0, .high = 36'000.0, .unit = "″", .hint = "check the unit: it is stated in seconds of arc"};

void read_counts(const JsonObject& object, std::vector<std::size_t>& counts) {
    const nlohmann::json* array = object.optional_array("angle_counts");
    if (array == nullptr) {
        return;
    }
    NumberRange range = between(3.0, 36'000.0, "");
    range.hint = "state numbers of angles over a full turn, such as 36";
    const auto numbers = object.required_numbers("angle_counts", array->size(), range);
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
        const auto steps = plan.optional_object("angles_deg", k_angles_keys);
        const auto first = steps->required_number("first", k_angle);
        NumberRange nonzero = k_angle;
        nonzero.low = 0.0;
        nonzero.low_open = true;
        const auto step = steps->required_number("step", nonzero);
        const auto count = steps->required_integer("count", between(1.0, k_most_angles, ""));
        if (!first || !step || !count) {
            return;
        }
        const double last = *first + *step * static_cast<double>(*count - 1);
        if (last > k_angle.high) {
            steps->refuse(k_number_out_of_range, "count", "the last angle is " + text::shortest_plain(last) + "°",
                          k_angle.rule(), "state fewer angles");
            return;
        }
        for (std::int64_t i = 0; i < *count; ++i) {
            angles.push_back(*first + *step * static_cast<double>(i));
        }
        return;
    }
    if (!value->is_array()) {
        plan.refuse(k_wrong_type, "angles_deg", described(*value), "must be an array of angles or an object",
                    "write [0, 10, 20] or {\"first\": 0, \"step\": 10, \"count\": 36}");
        return;
    }
    if (value->empty() || static_cast<double>(value->size()) > k_most_angles) {
        plan.refuse(k_wrong_size, "angles_deg", "an array of " + std::to_string(value->size()) + " elements",
                    "must have 1 to " + text::shortest_plain(k_most_angles) + " angles", "correct the array");
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
    const auto region = plan.optional_object("station_region", k_region_keys);
    if (!region) {
        return;
    }
    std::array<Eigen::Vector3d, 2> corners{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    bool is_whole = true;
    for (std::size_t k = 0; k < k_coordinate_keys.size(); ++k) {
        const auto limits = region->required_numbers(k_coordinate_keys[k], 2, k_station_coordinate);
        if (limits && (*limits)[0] > (*limits)[1]) {
            region->refuse(
                k_limits_reversed, k_coordinate_keys[k],
                "from " + text::shortest_plain((*limits)[0]) + " mm to " + text::shortest_plain((*limits)[1]) + " mm",
                "the lower limit stands first", "exchange the two");
        }
        is_whole = is_whole && limits && (*limits)[0] <= (*limits)[1];
        for (std::size_t c = 0; is_whole && c < 2; ++c) {
            corners[c](static_cast<Eigen::Index>(k)) = (*limits)[c] * k_millimetre;
        }
    }
    NumberRange step_range = k_station_coordinate;
    step_range.low = 0.0;
    step_range.low_open = true;
    const auto step = region->optional_number("step_mm", step_range);
    if (step) {
        request.station_step = *step * k_millimetre;
    }
    if (!is_whole || (region->has("step_mm") && !step)) {
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

/// Lower and upper limit of a solid, [m].
std::optional<std::array<double, 2>> read_extent(const JsonObject& solid, std::string_view key) {
    const auto limits = solid.required_numbers(key, 2, k_station_coordinate);
    if (!limits) {
        return std::nullopt;
    }
    if (!((*limits)[0] < (*limits)[1])) {
        solid.refuse(
            k_limits_reversed, key,
            "from " + text::shortest_plain((*limits)[0]) + " mm to " + text::shortest_plain((*limits)[1]) + " mm",
            "an obstacle has an extent, and its lower limit stands first", "correct the two");
        return std::nullopt;
    }
    return std::array<double, 2>{(*limits)[0] * k_millimetre, (*limits)[1] * k_millimetre};
}

/// Every object of a list, with what reads it.
template <class Read>
void read_list(const JsonDocument& document, const JsonObject& object, std::string_view key,
               std::span<const std::string_view> keys, ProblemList& problems, const Read& read) {
    const nlohmann::json* entries = object.optional_array(key);
    for (std::size_t i = 0; entries != nullptr && i < entries->size(); ++i) {
        const std::string pointer = child_pointer(object.pointer(key), i);
        if (!(*entries)[i].is_object()) {
            problems.refuse(k_wrong_type, document.where(pointer), described((*entries)[i]), "must be an object",
                            "write { … } for each of the list");
            continue;
        }
        read(JsonObject(document, pointer, keys, problems));
    }
}

void read_cylinder(const JsonObject& object, gum::SightStatement& sight) {
    NumberRange radius_range = k_station_coordinate;
    radius_range.low = 0.0;
    radius_range.low_open = true;
    const auto name = object.required_name("name");
    const auto radius = object.required_number("radius_mm", radius_range);
    const auto along = read_extent(object, "along_axis_mm");
    if (name && radius && along) {
        Obstacle obstacle;
        obstacle.name = *name;
        obstacle.radius = *radius * k_millimetre;
        obstacle.low.setConstant((*along)[0]);
        obstacle.high.setConstant((*along)[1]);
        sight.obstacles.push_back(std::move(obstacle));
        sight.obstacles_where.push_back(object.where());
    }
}

void read_box(const JsonObject& object, gum::SightStatement& sight) {
    Obstacle obstacle;
    const auto name = object.required_name("name");
    bool is_whole = name.has_value();
    for (std::size_t k = 0; k < k_coordinate_keys.size(); ++k) {
        const auto extent = read_extent(object, k_coordinate_keys[k]);
        is_whole = is_whole && extent;
        if (extent) {
            obstacle.low(static_cast<Eigen::Index>(k)) = (*extent)[0];
            obstacle.high(static_cast<Eigen::Index>(k)) = (*extent)[1];
        }
    }
    obstacle.turns = object.optional_boolean("turns").value_or(true);
    if (is_whole) {
        obstacle.name = *name;
        sight.obstacles.push_back(std::move(obstacle));
        sight.obstacles_where.push_back(object.where());
    }
}

void read_facing(const JsonObject& object, gum::SightStatement& sight) {
    const auto reflector = object.required_name("reflector");
    const auto direction = object.required_numbers("direction", 3, between(-1e6, 1e6, ""));
    if (!reflector || !direction) {
        return;
    }
    const Eigen::Vector3d vector((*direction)[0], (*direction)[1], (*direction)[2]);
    constexpr double k_shortest = 1e-6;
    if (vector.norm() < k_shortest) {
        object.refuse(k_number_out_of_range, "direction", "[0, 0, 0]", "a direction has a length",
                      "state where the reflector looks, such as [0, 0, 1]");
        return;
    }
    sight.facing.push_back({*reflector, object.where("reflector"), vector.normalized()});
}

void read_sight(const JsonDocument& document, const JsonObject& plan, gum::SightStatement& sight,
                ProblemList& problems) {
    const auto object = plan.optional_object("sight", k_sight_keys);
    if (!object) {
        return;
    }
    read_list(document, *object, "cylinders", k_cylinder_keys, problems,
              [&](const JsonObject& cylinder) { read_cylinder(cylinder, sight); });
    read_list(document, *object, "boxes", k_box_keys, problems, [&](const JsonObject& box) { read_box(box, sight); });
    NumberRange diameter = between(0.0, 1000.0, "mm");
    diameter.low_open = true;
    if (const auto stated = object->optional_number("reflector_diameter_mm", diameter)) {
        sight.reflector_diameter = *stated * k_millimetre;
    }
    NumberRange acceptance = between(0.0, 180.0, "°");
    acceptance.low_open = true;
    if (const auto stated = object->optional_number("acceptance_angle_deg", acceptance)) {
        sight.acceptance_angle = *stated * gum::k_degree;
    }
    read_list(document, *object, "facing", k_facing_keys, problems,
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

void read_targets(const JsonObject& plan, gum::PlanRequest& request) {
    const auto targets = plan.optional_object("targets", k_targets_keys);
    if (!targets) {
        return;
    }
    const auto read = [&](std::string_view key, bool angular) -> std::optional<double> {
        const auto stated = targets->optional_number(key, between(1e-6, 1e6, angular ? "″" : "µm"));
        return stated ? std::optional(*stated * (angular ? k_arcsecond : k_micrometre)) : std::nullopt;
    };
    request.target_linear = read("linear_um", false).value_or(request.target_linear);
    request.target_angular = read("angular_arcsec", true).value_or(request.target_angular);
    gum::ParameterTargets& parameters = request.parameter_targets;
    parameters.range_linear = read("range_linear_um", false);
    parameters.range_angular = read("range_angular_arcsec", true);
    parameters.location_linear = read("location_um", false);
    parameters.location_angular = read("location_arcsec", true);
    parameters.systematic = read("E_arcsec", true);
    parameters.repeatability = read("R_arcsec", true);
    parameters.accuracy = read("A_arcsec", true);
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
    const auto object = root.optional_object("simulation", k_simulation_keys);
    if (!object) {
        return std::nullopt;
    }
    gum::SimulationRequest request;
    const auto length = [](const std::optional<double>& stated, double otherwise) {
        return stated ? *stated * k_micrometre : otherwise;
    };
    const auto angle = [](const std::optional<double>& stated, double otherwise) {
        return stated ? *stated * k_arcsecond : otherwise;
    };
    request.runs = static_cast<std::size_t>(object->optional_integer("runs", between(1.0, k_most_runs, ""))
                                                .value_or(static_cast<std::int64_t>(request.runs)));
    request.seed =
        static_cast<std::uint64_t>(object->optional_integer("seed", between(0.0, k_largest_seed, "")).value_or(1));
    request.set_up_offset = length(object->optional_number("set_up_offset_um", k_small_linear), request.set_up_offset);
    request.set_up_tilt = angle(object->optional_number("set_up_tilt_arcsec", k_small_angular), request.set_up_tilt);
    request.error_linear = length(object->optional_number("error_linear_um", k_small_linear), request.error_linear);
    request.error_angular =
        angle(object->optional_number("error_angular_arcsec", k_small_angular), request.error_angular);
    if (const auto table = object->optional_object("table_repeatability", k_simulated_table_keys)) {
        TableRepeatability& repeatability = request.table_repeatability.emplace();
        repeatability.mode = RepeatabilityMode::given;
        repeatability.u_linear = length(table->required_number("u_linear_um", k_small_linear), 0.0);
        repeatability.u_axial = angle(table->required_number("u_axial_arcsec", k_small_angular), 0.0);
        repeatability.u_tilt = angle(table->required_number("u_tilt_arcsec", k_small_angular), 0.0);
    }
    if (const auto outliers = object->optional_object("outliers", k_simulated_outliers_keys)) {
        request.outliers =
            static_cast<std::size_t>(outliers->required_integer("count", between(0.0, 1e6, "")).value_or(0));
        NumberRange size = above_zero("µm");
        size.high = 1e8;
        size.hint = "check the unit: it is stated in micrometres";
        const auto stated = outliers->optional_number("size_um", size);
        request.outlier_size = length(stated, request.outlier_size);
        if (stated && request.outliers == 0) {
            problems.warn(k_warn_unused_value, outliers->where("size_um"),
                          "size_um " + text::shortest_plain(*stated) + " µm is not used", "no outliers are asked for",
                          "remove it, or state their count");
        }
    }
    read_counts(*object, request.angle_counts);
    return request;
}

std::optional<gum::PlanRequest> read_plan(const JsonDocument& document, const JsonObject& root, ProblemList& problems) {
    const auto object = root.optional_object("plan", k_plan_keys);
    if (!object) {
        return std::nullopt;
    }
    constexpr std::array<std::pair<std::string_view, bool>, 2> k_senses{{{"one", false}, {"both", true}}};
    constexpr std::array<std::pair<std::string_view, bool>, 2> k_dead_paths{{{"station", false}, {"reflector", true}}};
    gum::PlanRequest request;
    read_angles(*object, request.angles_deg);
    warn_of_same_positions(request.angles_deg, object->where("angles_deg"), problems);
    request.both_senses = object->optional_choice("senses", k_senses).value_or(false);
    request.dead_path_per_reflector = object->optional_choice("dead_paths", k_dead_paths).value_or(false);
    read_targets(*object, request);
    read_region(*object, request);
    if (const auto distance = object->optional_number("least_distance_mm", between(0.0, 100'000.0, "mm"))) {
        request.least_distance = *distance * k_millimetre;
        if (!object->has("station_region")) {
            problems.warn(k_warn_unused_value, object->where("least_distance_mm"),
                          "least_distance_mm " + text::shortest_plain(*distance) + " mm is not used",
                          "it belongs to station_region: without one, stations are not moved",
                          "remove it, or state a region");
        }
    }
    request.keep_met_targets = object->optional_boolean("keep_met_targets").value_or(false);
    if (request.keep_met_targets && !object->has("station_region")) {
        problems.warn(k_warn_unused_value, object->where("keep_met_targets"), "keep_met_targets is not used",
                      "it belongs to station_region: without one, stations are not moved",
                      "remove it, or state a region");
    }
    read_sight(document, *object, request.sight, problems);
    return request;
}

std::span<const JobKeys> rotary_table_study_keys() {
    return k_all_keys;
}

}  // namespace gumcert::engine
