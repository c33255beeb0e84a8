#include "jobs/rotary_table/rotary_table_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "gum/quantity/units.h"
#include "jobs/job_limits.h"
#include "jobs/rotary_table/rotary_table_limits.h"
#include "jobs/rotary_table/rotary_table_study.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using gum::k_degree;

/// Digits after the decimal point that all of them have, at most 6.
int decimals_of(const std::vector<double>& values) {
    constexpr int k_most = 6;
    double scale = 1.0;
    for (int decimals = 0; decimals < k_most; ++decimals, scale *= 10.0) {
        if (std::all_of(values.begin(), values.end(), [&](double value) {
                return std::abs(value * scale - std::round(value * scale)) < 1e-6 * scale;
            })) {
            return decimals;
        }
    }
    return k_most;
}

/// Angles that are radians by mistake are no multiples of 0.1 as they stand, and once they are converted multiples of half a
/// degree, or of five degrees where they were rounded to a hundredth: all of them, which chance hardly brings about.
/// \param angles  ascending, each once, as the file states them
/// \return what they are multiples of, [°]
std::optional<double> step_as_radians(const std::vector<double>& angles) {
    constexpr double k_exact = 0.01;  // [°]
    constexpr double k_by_chance = 1e-4;
    const double span = angles.back() - angles.front();
    const auto off_multiple = [](double value, double step) {
        return std::abs(value - step * std::round(value / step));
    };
    if (angles.empty() || span <= 3.1 || span > 6.2832 ||
        std::all_of(angles.begin(), angles.end(), [&](double angle) { return off_multiple(angle, 0.1) <= 1e-6; })) {
        return std::nullopt;
    }
    const double off = k_exact + 0.5 * std::pow(10.0, -decimals_of(angles)) / k_degree;
    for (const double step : {0.5, 5.0}) {
        const double by_chance = std::pow(2.0 * off / step, static_cast<double>(angles.size() - 1));
        if (by_chance < k_by_chance && std::all_of(angles.begin(), angles.end(), [&](double angle) {
                return off_multiple(angle / k_degree, step) <= off;
            })) {
            return step;
        }
    }
    return std::nullopt;
}

std::string home_angle(const RotaryTableReading& reading) {
    return "the home angle " + text::shortest_plain(*reading.stated.home_angle_deg) + "°" +
           (reading.root.has("home_angle_deg") ? "" : " (the default)");
}

}  // namespace

void read_layout(const RotaryTableReading& reading, const JsonObject& observations, const FixtureNames& fixture,
                 MeasuredPlaces& places) {
    const RotaryTableJob& job = reading.job();
    const JsonObject& root = reading.root;
    const char* rule = "a layout that was not measured is described by the stations file and plan.angles_deg";
    if (!observations.has("stations")) {
        observations.refuse(k_layout_incomplete, "stations", "neither lengths nor stations are given", rule,
                            "add \"stations\", or \"lengths\" if there are some");
    }
    if (!job.plan || job.plan->angles_deg.empty()) {
        // Angles that were refused are told already.
        const nlohmann::json* plan = root.find("plan");
        if (plan == nullptr || (plan->is_object() && !plan->contains("angles_deg"))) {
            root.refuse(k_layout_incomplete, "plan", "neither lengths nor planned angles are given", rule,
                        "add \"plan\": {\"angles_deg\": {\"first\": 0, \"step\": 10, \"count\": 36}}");
        }
        return;
    }
    places.angles_deg = job.plan->angles_deg;
    places.is_whole = true;
    store_angles(reading, places);
    check_angles(reading, places, root.where("plan"), root.where("plan"), reading.problems);
    if (!places.table || !fixture.is_whole) {
        return;
    }
    const std::size_t at_angle = places.stations.size() * fixture.reflectors.size();
    if (at_angle < k_least_at_angle) {
        root.refuse(
            k_too_few_at_angle, "observations",
            counted(places.stations.size(), "station") + " and " + counted(fixture.reflectors.size(), "reflector"),
            "a pose has six unknowns: every angle needs at least 6 distances", "add stations or reflectors");
    }
    if (fixture.reflectors.size() < k_least_reflectors) {
        root.refuse(k_too_few_reflectors, "fixture", counted(fixture.reflectors.size(), "reflector"),
                    "the pose of the table needs at least 3 reflectors", "add further reflectors");
    }
}

void check_angles(const RotaryTableReading& reading, const MeasuredPlaces& places, const std::string& where_angles,
                  const std::string& where_all, ProblemList& problems) {
    if (const std::optional<double> step = step_as_radians(places.angles_deg)) {
        problems.refuse(k_angles_in_radians, where_angles,
                        counted(places.angles_deg.size(), "angle") + " from " +
                            text::shortest_plain(places.angles_deg.front()) + " to " +
                            text::shortest_plain(places.angles_deg.back()) + " are multiples of " +
                            (*step < 1.0 ? "half a degree" : "5°") + " when they are taken as radians",
                        "angles are in degrees", "convert the angles to degrees");
        return;
    }
    const double span = places.angles_deg.back() - places.angles_deg.front();
    if (span < 180.0) {
        problems.warn(
            k_warn_angle_span, where_all,
            "the angles span " + text::shortest_plain(span) + "°, from " +
                text::shortest_plain(places.angles_deg.front()) + "° to " +
                text::shortest_plain(places.angles_deg.back()) + "°",
            "below half a turn, set-up errors and the first harmonics of the error motions are poorly separated",
            "measure over a full turn if the table allows it");
    }
    warn_of_same_positions(places.angles_deg, text::visible(problems.file()), problems);
    if (reading.stated.home_angle_deg && !places.angle_index(*reading.stated.home_angle_deg)) {
        const bool measured = reading.job().has_lengths;
        reading.root.refuse(
            k_home_not_measured, "home_angle_deg",
            home_angle(reading) + (measured ? " has no distance" : " is not planned"),
            std::string("the home angle is one of the ") + (measured ? "measured" : "planned") + " angles",
            std::string("state a home_angle_deg that ") + (measured ? "was measured" : "is planned") + ", from " +
                text::shortest_plain(places.angles_deg.front()) + "° to " +
                text::shortest_plain(places.angles_deg.back()) + "°");
    }
}

void store_angles(const RotaryTableReading& reading, const MeasuredPlaces& places) {
    engine::RotaryTableMeasurement& measurement = reading.job().measurement;
    measurement.angles_deg = places.angles_deg;
    for (const double angle : places.angles_deg) {
        measurement.angles.push_back(angle * k_degree);
    }
    measurement.home = places.angle_index(reading.stated.home_angle_deg.value_or(0.0)).value_or(0);
}

void check_home_of_plan(const RotaryTableReading& reading) {
    const RotaryTableJob& job = reading.job();
    const std::optional<double>& home = reading.stated.home_angle_deg;
    if (!job.has_lengths || !job.plan || job.plan->angles_deg.empty() || !home) {
        return;
    }
    const std::vector<double>& planned = job.plan->angles_deg;
    if (std::none_of(planned.begin(), planned.end(),
                     [&](double angle) { return std::abs(angle - *home) <= k_same_angle_deg; })) {
        reading.root.refuse(k_home_not_measured, "plan", home_angle(reading) + " is not among the angles of plan",
                            "the home angle is one of the planned angles", "add it to plan.angles_deg");
    }
}

void warn_of_idle_plan(const RotaryTableReading& reading, JobUse use) {
    const RotaryTableJob& job = reading.job();
    const nlohmann::json* plan = reading.root.find("plan");
    if (use == JobUse::evaluate || !job.has_lengths || !job.plan || !plan->is_object()) {
        return;
    }
    const bool simulated = use == JobUse::simulate;
    if (!simulated && plan->contains("angles_deg")) {
        return;
    }
    const bool full_turns = job.simulation && !job.simulation->angle_counts.empty();
    for (const char* key : {"angles_deg", "senses", "dead_paths", "sight"}) {
        // Full turns of other angles are not what was measured: whether they are seen is asked as for a plan.
        const bool uses_sight = std::string_view(key) == "sight" && (!simulated || full_turns);
        if (!plan->contains(key) || uses_sight) {
            continue;
        }
        reading.problems.warn(
            k_warn_unused_value, reading.document.where("/plan/" + std::string(key)), std::string(key) + " is not used",
            simulated ? "with a lengths file the layout of a simulation is that of the lengths"
                      : "with a lengths file and without angles_deg the distances of a plan are those of "
                        "the lengths",
            simulated ? "leave out the lengths file to simulate the plan; gumcert plan may need the key"
                      : "remove it, or state plan.angles_deg");
    }
}

void check_sizes(const RotaryTableReading& reading, const FixtureNames& fixture, const MeasuredPlaces& places) {
    const RotaryTableJob& job = reading.job();
    const auto check = [&](std::string_view key, std::size_t angles, std::size_t senses) {
        const double distances = static_cast<double>(places.stations.size() * fixture.reflectors.size()) *
                                 static_cast<double>(angles) * static_cast<double>(senses);
        if (distances > static_cast<double>(k_most_distances)) {
            reading.root.refuse(k_layout_too_large, key, text::shortest_plain(distances) + " distances",
                                "a layout has at most " + std::to_string(k_most_distances) + " distances",
                                "state fewer angles");
        }
    };
    if (job.plan) {
        check("plan", job.plan->angles_deg.size(), job.plan->both_senses ? 2 : 1);
    }
    if (job.simulation && !job.simulation->angle_counts.empty()) {
        check("simulation", *std::max_element(job.simulation->angle_counts.begin(), job.simulation->angle_counts.end()),
              2);
    }
}

void check_reversal(const RotaryTableReading& reading) {
    const engine::RotaryTableMeasurement& measurement = reading.job().measurement;
    const RotaryTableJob& job = reading.job();
    if (measurement.reversal != engine::ReversalModel::by_angle) {
        return;
    }
    const bool measured = job.has_lengths;
    const auto refuse = [&](const std::string& what) {
        reading.root.refuse(
            k_bad_reversal, "reversal", what,
            "a reversal by angle is the difference of both senses of approach at every angle and station",
            "measure both senses, or choose \"auto\" or \"constant\"");
    };
    if (measurement.method != engine::AdjustmentMethod::joint) {
        reading.root.refuse(k_bad_reversal, "reversal", "reversal is \"by_angle\", and method is \"sequential\"",
                            "the sequential method knows one reversal of all angles",
                            "choose \"method\": \"joint\", or \"reversal\": \"constant\"");
        return;
    }
    if (!measured) {
        if (job.plan && !job.plan->both_senses) {
            refuse("one sense of approach is planned");
        }
        return;
    }
    std::vector<std::array<bool, 2>> of_station(measurement.stations.size(), {false, false});
    std::vector<std::array<bool, 2>> of_angle(measurement.angles.size(), {false, false});
    for (const engine::LengthObservation& length : measurement.lengths) {
        const std::size_t sense = length.approach == engine::Approach::positive ? 0 : 1;
        of_station[length.station][sense] = true;
        of_angle[length.angle][sense] = true;
    }
    const auto one_sense = [](const std::array<bool, 2>& senses) { return !(senses[0] && senses[1]); };
    if (const auto at = std::ranges::find_if(of_station, one_sense); at != of_station.end()) {
        refuse("station " + measurement.stations[static_cast<std::size_t>(at - of_station.begin())] +
               " was measured in one sense of approach only");
    } else if (const auto angle = std::ranges::find_if(of_angle, one_sense); angle != of_angle.end()) {
        refuse("the angle " +
               text::shortest_plain(measurement.angles_deg[static_cast<std::size_t>(angle - of_angle.begin())]) +
               "° was measured in one sense of approach only");
    }
}

}  // namespace gumcert::jobs
