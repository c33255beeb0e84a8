#include "engine/job/rotary_table_study.h"

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
constexpr std::array<std::string_view, 3> k_simulated_table_keys{"u_linear_um", "u_axial_arcsec", "u_tilt_arcsec"};
constexpr std::array<std::string_view, 2> k_simulated_outliers_keys{"count", "size_um"};
constexpr std::array<std::string_view, 6> k_plan_keys{"angles_deg", "senses",         "dead_paths",
                                                      "targets",    "station_region", "least_distance_mm"};
constexpr std::array<std::string_view, 3> k_angles_keys{"first", "step", "count"};
constexpr std::array<std::string_view, 2> k_targets_keys{"linear_um", "angular_arcsec"};
constexpr std::array<std::string_view, 4> k_region_keys{"x_mm", "y_mm", "z_mm", "step_mm"};

const std::array<JobKeys, 7> k_all_keys{{{"/simulation", k_simulation_keys},
                                         {"/simulation/table_repeatability", k_simulated_table_keys},
                                         {"/simulation/outliers", k_simulated_outliers_keys},
                                         {"/plan", k_plan_keys},
                                         {"/plan/angles_deg", k_angles_keys},
                                         {"/plan/targets", k_targets_keys},
                                         {"/plan/station_region", k_region_keys}}};

constexpr double k_most_runs = 1e6;
constexpr double k_most_angles = 100'000.0;
constexpr double k_most_candidates = 100'000.0;
constexpr double k_same_angle_deg = 1e-9;
constexpr NumberRange k_angle{
    .low = -3600.0, .high = 3600.0, .unit = "°", .hint = "check the unit: angles are in degrees"};
constexpr NumberRange k_station_coordinate{
    .low = -100'000.0, .high = 100'000.0, .unit = "mm", .hint = "check the unit: coordinates are in millimetres"};
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
            object.refuse(k_not_an_integer, "angle_counts", shortest(number), "must be whole numbers",
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
            steps->refuse(k_number_out_of_range, "count", "the last angle is " + shortest(last) + "°", k_angle.rule(),
                          "state fewer angles");
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
                    "must have 1 to " + shortest(k_most_angles) + " angles", "correct the array");
        return;
    }
    auto numbers = plan.required_numbers("angles_deg", value->size(), k_angle);
    if (!numbers) {
        return;
    }
    std::sort(numbers->begin(), numbers->end());
    for (std::size_t i = 1; i < numbers->size(); ++i) {
        if ((*numbers)[i] - (*numbers)[i - 1] <= k_same_angle_deg) {
            plan.refuse(k_repeated_angle, "angles_deg", "the angle " + shortest((*numbers)[i]) + "° occurs twice",
                        "every angle is stated once", "remove one of the two");
            return;
        }
    }
    angles = std::move(*numbers);
}

void read_region(const JsonObject& plan, PlanRequest& request) {
    const auto region = plan.optional_object("station_region", k_region_keys);
    if (!region) {
        return;
    }
    static constexpr std::array<std::string_view, 3> k_axes{"x_mm", "y_mm", "z_mm"};
    std::array<Eigen::Vector3d, 2> corners{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    bool is_whole = true;
    for (std::size_t k = 0; k < k_axes.size(); ++k) {
        const auto limits = region->required_numbers(k_axes[k], 2, k_station_coordinate);
        if (limits && (*limits)[0] > (*limits)[1]) {
            region->refuse(k_limits_reversed, k_axes[k],
                           "from " + shortest((*limits)[0]) + " mm to " + shortest((*limits)[1]) + " mm",
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
        region->refuse(
            k_layout_too_large, "step_mm",
            shortest(candidates) + " positions in steps of " + shortest(request.station_step / k_millimetre) + " mm",
            "at most " + shortest(k_most_candidates) + " positions are tried",
            "state a larger step or a smaller region");
        return;
    }
    request.station_region = corners;
}

}  // namespace

void warn_of_same_positions(const std::vector<double>& angles_deg, const std::string& where, ProblemList& problems) {
    constexpr double k_turn = 360.0;  // [°]
    for (std::size_t i = 1; i < angles_deg.size(); ++i) {
        for (double below = angles_deg[i] - k_turn; below >= angles_deg.front() - k_same_angle_deg; below -= k_turn) {
            const auto found = std::lower_bound(angles_deg.begin(), angles_deg.end(), below - k_same_angle_deg);
            if (found != angles_deg.end() && std::abs(*found - below) <= k_same_angle_deg) {
                problems.warn(k_warn_same_position, where,
                              "the angles " + shortest(*found) + "° and " + shortest(angles_deg[i]) +
                                  "° are one position of the table",
                              "each has error motions of its own, and means over the angles count the position twice",
                              "leave one of them out unless the turn is to be compared with itself");
                return;
            }
        }
    }
}

std::optional<SimulationRequest> read_simulation(const JsonObject& root, ProblemList& problems) {
    const auto object = root.optional_object("simulation", k_simulation_keys);
    if (!object) {
        return std::nullopt;
    }
    SimulationRequest request;
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
                          "size_um " + shortest(*stated) + " µm is not used", "no outliers are asked for",
                          "remove it, or state their count");
        }
    }
    read_counts(*object, request.angle_counts);
    return request;
}

std::optional<PlanRequest> read_plan(const JsonObject& root, ProblemList& problems) {
    const auto object = root.optional_object("plan", k_plan_keys);
    if (!object) {
        return std::nullopt;
    }
    constexpr std::array<std::pair<std::string_view, bool>, 2> k_senses{{{"one", false}, {"both", true}}};
    constexpr std::array<std::pair<std::string_view, bool>, 2> k_dead_paths{{{"station", false}, {"reflector", true}}};
    PlanRequest request;
    read_angles(*object, request.angles_deg);
    warn_of_same_positions(request.angles_deg, object->where("angles_deg"), problems);
    request.both_senses = object->optional_choice("senses", k_senses).value_or(false);
    request.dead_path_per_reflector = object->optional_choice("dead_paths", k_dead_paths).value_or(false);
    if (const auto targets = object->optional_object("targets", k_targets_keys)) {
        if (const auto linear = targets->optional_number("linear_um", between(1e-6, 1e6, "µm"))) {
            request.target_linear = *linear * k_micrometre;
        }
        if (const auto angular = targets->optional_number("angular_arcsec", between(1e-6, 1e6, "″"))) {
            request.target_angular = *angular * k_arcsecond;
        }
    }
    read_region(*object, request);
    if (const auto distance = object->optional_number("least_distance_mm", between(0.0, 100'000.0, "mm"))) {
        request.least_distance = *distance * k_millimetre;
        if (!object->has("station_region")) {
            problems.warn(k_warn_unused_value, object->where("least_distance_mm"),
                          "least_distance_mm " + shortest(*distance) + " mm is not used",
                          "it belongs to station_region: without one, stations are not moved",
                          "remove it, or state a region");
        }
    }
    return request;
}

std::span<const JobKeys> rotary_table_study_keys() {
    return k_all_keys;
}

}  // namespace gumcert::engine
