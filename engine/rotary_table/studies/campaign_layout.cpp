#include "engine/rotary_table/studies/campaign_layout.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/rotary_table/joint_adjustment.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

void require_layout(const RotaryTableMeasurement& measurement) {
    std::vector<gum::Diagnostic> problems;
    if (measurement.angles.empty()) {
        problems.push_back({"GC-LAYOUT-0002", "layout", "no angle", "a layout is stations, reflectors and angles",
                            "state the angles of the plan", gum::Severity::error});
    }
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        if (!measurement.station_start[j]) {
            problems.push_back({"GC-LAYOUT-0001", "station " + measurement.stations[j], "no position",
                                "the distances of a layout are predicted from the positions of its stations",
                                "state it in the stations file", gum::Severity::error});
        }
    }
    if (!problems.empty()) {
        throw gum::InputError(std::move(problems));
    }
}

/// One flag a pass: it visits one angle alone, and another pass of its station several, so that it closes a run, or checks it.
std::vector<bool> closing_passes(const RotaryTableMeasurement& measurement) {
    std::map<std::size_t, std::size_t> first_angle;
    std::vector<bool> has_several(measurement.passes.size(), false);  // angles
    std::vector<bool> has_run(measurement.stations.size(), false);
    for (const LengthObservation& length : measurement.lengths) {
        if (first_angle.try_emplace(length.pass, length.angle).first->second != length.angle) {
            has_several[length.pass] = true;
            has_run[length.station] = true;
        }
    }
    std::vector<bool> closing(measurement.passes.size(), false);
    for (const LengthObservation& length : measurement.lengths) {
        closing[length.pass] = !has_several[length.pass] && has_run[length.station];
    }
    return closing;
}

/// The angle of a full turn from home on that is nearest to an angle of the measurement.
std::size_t nearest_of_turn(const RotaryTableMeasurement& measurement, std::size_t angle, std::size_t count) {
    const double turns = (measurement.angles[angle] - measurement.angles[measurement.home]) / (2.0 * std::numbers::pi);
    const double steps = std::round((turns - std::floor(turns)) * static_cast<double>(count));
    return static_cast<std::size_t>(steps) % count;
}

}  // namespace

double ideal_distance(const RotaryTableMeasurement& measurement, const Eigen::Matrix3d& rotation, std::size_t station,
                      std::size_t reflector) {
    // The fixture is larger by its temperature difference at that station.
    const double stretch =
        1.0 + measurement.expansion * measurement.temperature_difference[static_cast<Eigen::Index>(station)];
    // |(1 + α ΔT) R(θ) p − q|: the model of JointAdjustment with E and T_s the identity and l0 = 0.
    return (stretch * (rotation * measurement.fixture.row(static_cast<Eigen::Index>(reflector)).transpose()) -
            *measurement.station_start[station])
        .norm();
}

void lay_out(RotaryTableMeasurement& measurement, bool both_senses, bool dead_path_per_reflector) {
    require_layout(measurement);
    const std::size_t stations = measurement.stations.size();
    const std::size_t reflectors = measurement.reflectors.size();
    if (measurement.temperature_difference.size() == 0) {
        measurement.temperature_difference = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(stations));
    }
    if (measurement.u_temperature.size() == 0) {
        measurement.u_temperature = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(stations));
    }
    measurement.passes.clear();
    measurement.dead_paths.clear();
    measurement.lengths.clear();
    measurement.times.clear();
    for (std::size_t j = 0; j < stations; ++j) {
        // A beam that is broken between the reflectors gets a new constant for each of them.
        // Fringes are counted from there on.
        for (std::size_t m = 0; m < (dead_path_per_reflector ? reflectors : 1); ++m) {
            measurement.dead_paths.push_back(measurement.stations[j] +
                                             (dead_path_per_reflector ? "-" + measurement.reflectors[m] : ""));
        }
    }
    for (std::size_t j = 0; j < stations; ++j) {
        for (const Approach approach : {Approach::positive, Approach::negative}) {
            const bool down = approach == Approach::negative;
            if (down && !both_senses) {
                continue;
            }
            const std::size_t pass = measurement.passes.size();
            measurement.passes.push_back(measurement.stations[j] + (down ? "-2" : "-1"));
            const std::size_t angles = measurement.angles.size();
            for (std::size_t step = 0; step < angles; ++step) {
                // The table goes back the way it came: time and drift run against the angle in the sense −.
                const std::size_t i = down ? angles - 1 - step : step;
                const Eigen::Matrix3d rotation = nominal_rotation(measurement, i);
                for (std::size_t m = 0; m < reflectors; ++m) {
                    LengthObservation length;
                    length.station = j;
                    length.reflector = m;
                    length.pass = pass;
                    length.angle = i;
                    length.dead_path = dead_path_per_reflector ? j * reflectors + m : j;
                    length.approach = approach;
                    length.length = ideal_distance(measurement, rotation, j, m);
                    if (!(length.length > 0.0)) {
                        throw gum::InputError(
                            gum::Diagnostic{"GC-LAYOUT-0003", "station " + measurement.stations[j],
                                            "stands where reflector " + measurement.reflectors[m] + " comes to",
                                            "a distance is greater than 0", "move the station", gum::Severity::error});
                    }
                    // The line that the distance gets in a file: the first one holds the names of the columns.
                    length.line = measurement.lengths.size() + 2;
                    measurement.lengths.push_back(length);
                }
            }
        }
    }
}

RotaryTableMeasurement with_full_turn(const RotaryTableMeasurement& measurement, std::size_t count) {
    RotaryTableMeasurement result = measurement;
    const double home = measurement.angles.empty() ? 0.0 : measurement.angles[measurement.home];
    const double home_deg = measurement.angles.empty() ? 0.0 : measurement.angles_deg[measurement.home];
    result.angles.clear();
    result.angles_deg.clear();
    // A full turn ends one step before its beginning: home is measured once.
    result.home = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double turn = static_cast<double>(i) / static_cast<double>(count);
        result.angles.push_back(home + 2.0 * std::numbers::pi * turn);
        result.angles_deg.push_back(home_deg + 360.0 * turn);
    }
    // One length of every pass and reflector stands for all of them; the order of the passes stays.
    std::map<std::pair<std::size_t, std::size_t>, LengthObservation> pattern;
    for (const LengthObservation& length : measurement.lengths) {
        pattern.try_emplace({length.pass, length.reflector}, length);
    }
    const std::vector<bool> closes_run = closing_passes(measurement);
    std::vector<std::optional<std::size_t>> used(measurement.dead_paths.size());
    result.dead_paths.clear();
    result.lengths.clear();
    result.times.clear();
    for (auto begin = pattern.begin(); begin != pattern.end();) {
        auto end = begin;
        while (end != pattern.end() && end->first.first == begin->first.first) {
            ++end;
        }
        const bool down = begin->second.approach == Approach::negative;
        for (std::size_t step = 0; step < count; ++step) {
            const std::size_t i = down ? count - 1 - step : step;
            if (closes_run[begin->first.first] && i != nearest_of_turn(measurement, begin->second.angle, count)) {
                continue;
            }
            const Eigen::Matrix3d rotation = nominal_rotation(result, i);
            for (auto entry = begin; entry != end; ++entry) {
                LengthObservation length = entry->second;
                // Numbered as they are met, so that one which began in mid-turn, and is not met, is left out.
                if (!used[length.dead_path]) {
                    used[length.dead_path] = result.dead_paths.size();
                    result.dead_paths.push_back(measurement.dead_paths[length.dead_path]);
                }
                length.dead_path = *used[length.dead_path];
                length.angle = i;
                length.length = result.station_start[length.station]
                                    ? ideal_distance(result, rotation, length.station, length.reflector)
                                    : 0.0;
                length.line = result.lengths.size() + 2;
                result.lengths.push_back(length);
            }
        }
        begin = end;
    }
    return result;
}

}  // namespace gumcert::engine
