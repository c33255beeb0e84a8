// Blunders that laboratories make, planted on simulated campaigns, for tests and for the study of blunders.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine::synthetic {

enum class Blunder {
    none,
    outliers,             ///< single distances, up to 5 %, of 0.5 µm to 1 m
    visit,                ///< one visit of a station off by 5 u of a distance to 50 u
    jump,                 ///< interrupted beam of one station, 1 µm to 1 mm
    drift,                ///< of one station, 0.5 µm to 5 µm a run
    drift_of_all,         ///< the same of all stations, each with its own size
    angle_index,          ///< the angles of one station some steps off
    displaced_reflector,  ///< 5 µm to 50 µm from its stated place
    swapped_reflectors,   ///< two of them in the whole file
    swapped_reflectors_of_station,
    wrong_sense,  ///< of rotation, in the whole file
    hot_fixture,  ///< its temperature wrong by 2 K to 10 K, either way
    // Kinds that came later stand at the end: the seeds of the others mean the same campaigns as before.
    large_jump,           ///< interrupted beam of one station, 1 mm to 20 mm
    closed_drift,         ///< drift of one station, whose first angle is measured again at the end of each run
    closed_drift_of_all,  ///< the same of all stations
    moved_station,        ///< between its runs in both senses, 5 µm to 500 µm
    pair,                 ///< all distances between a station and a reflector, 5 µm to 50 µm
    leaning_reflector,    ///< elsewhere in a part of the turn, in every run, 2 µm to 50 µm
    moved_reflector,      ///< elsewhere from some visit on, 2 µm to 50 µm
    moved_fixture,        ///< on the table, before one of the stations, 2 µm to 300 µm
    scale_of_station,     ///< one factor on all its distances, 2 ppm to 500 ppm
    scale_of_two,         ///< the same of two stations, each with its own size
};

/// Whether the first angle is measured again at the end of each run.
inline bool is_closed(Blunder blunder) {
    return blunder == Blunder::closed_drift || blunder == Blunder::closed_drift_of_all;
}

inline constexpr std::array<std::pair<Blunder, const char*>, 22> k_blunders{
    {{Blunder::none, "none"},
     {Blunder::outliers, "outliers"},
     {Blunder::visit, "visit"},
     {Blunder::jump, "jump"},
     {Blunder::large_jump, "large jump"},
     {Blunder::drift, "drift"},
     {Blunder::closed_drift, "drift, runs closed"},
     {Blunder::drift_of_all, "drift of all stations"},
     {Blunder::closed_drift_of_all, "drift of all stations, runs closed"},
     {Blunder::moved_station, "station moved between its runs"},
     {Blunder::pair, "one station and one reflector"},
     {Blunder::leaning_reflector, "reflector elsewhere in a part of the turn"},
     {Blunder::moved_reflector, "reflector moved for good"},
     {Blunder::moved_fixture, "fixture moved on the table"},
     {Blunder::scale_of_station, "scale of one station"},
     {Blunder::scale_of_two, "scales of two stations"},
     {Blunder::angle_index, "angle index"},
     {Blunder::displaced_reflector, "displaced reflector"},
     {Blunder::swapped_reflectors, "swapped reflectors"},
     {Blunder::swapped_reflectors_of_station, "swapped reflectors of one station"},
     {Blunder::wrong_sense, "wrong sense"},
     {Blunder::hot_fixture, "hot fixture"}}};

/// A campaign with a blunder, and what it was.
struct Planted {
    RotaryTableMeasurement measurement;
    std::size_t station = 0, reflector = 0, other = 0, angle = 0;  ///< where it is, if anywhere
    double size = 0.0;                                             ///< [m], steps or [K]
    std::size_t last_angle = 0;                                    ///< of a part of the turn, which begins at `angle`
    std::size_t outliers = 0;                                      ///< distances that are wrong
};

/// A table with a repeatability of its own, whose components are estimated; a fixture of steel at 20 °C.
inline Campaign sound_campaign(std::uint64_t seed, int angles = 24, bool closed = false, bool both_senses = false) {
    CampaignPlan plan;
    plan.closed_runs = closed;
    plan.both_senses = both_senses;
    plan.angles_deg = full_turn(angles);
    plan.table_linear = 0.15e-6;
    plan.table_axial = 1.5e-6;
    plan.table_tilt = 0.5e-6;
    plan.u_temperature = 0.03;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 0.5e-6;
    plan.seed = seed;
    Campaign result = simulate(plan);
    result.measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    result.measurement.estimate_length_noise = true;
    result.measurement.outliers.test = OutlierTest::data_snooping;
    return result;
}

namespace planting {

/// Between two sizes, evenly in their logarithm.
inline double log_uniform(Noise& draw, double low, double high) {
    return low * std::pow(high / low, draw.uniform());
}
inline std::size_t one_of(Noise& draw, std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(draw.uniform() * static_cast<double>(count)));
}
inline double either_sign(Noise& draw) {
    return draw.uniform() < 0.5 ? -1.0 : 1.0;
}

inline void swap_reflectors(RotaryTableMeasurement& m, std::size_t a, std::size_t b, std::size_t station) {
    for (LengthObservation& length : m.lengths) {
        if (station == m.stations.size() || length.station == station) {
            length.reflector = length.reflector == a ? b : length.reflector == b ? a : length.reflector;
        }
    }
}

inline void add_outliers(Planted& planted, Noise& draw) {
    RotaryTableMeasurement& m = planted.measurement;
    const auto count = static_cast<std::size_t>((0.01 + 0.04 * draw.uniform()) * static_cast<double>(m.lengths.size()));
    std::vector<bool> wrong(m.lengths.size(), false);
    while (planted.outliers < count) {
        const std::size_t i = one_of(draw, wrong.size());
        if (!wrong[i]) {
            wrong[i] = true;
            m.lengths[i].length += either_sign(draw) * log_uniform(draw, 0.5e-6, 1.0);
            ++planted.outliers;
        }
    }
}

/// An error that grows over the visits of a station, in the order of its angles; a visit that closes the run has all of
/// it and a step more.
inline void add_drift(RotaryTableMeasurement& m, std::size_t station, double size) {
    std::size_t first = m.passes.size();
    for (LengthObservation& length : m.lengths) {
        if (length.station == station) {
            first = std::min(first, length.pass);
            const std::size_t visit = length.pass == first ? length.angle : m.angles.size();
            length.length += size * static_cast<double>(visit) / static_cast<double>(m.angles.size() - 1);
        }
    }
}

/// An interrupted beam: all distances of the station from an angle on, which leaves some visits on either side.
inline void add_jump(Planted& planted) {
    RotaryTableMeasurement& m = planted.measurement;
    planted.angle = 3 + planted.angle % (m.angles.size() - 5);
    for (LengthObservation& length : m.lengths) {
        if (length.station == planted.station && length.angle >= planted.angle) {
            length.length += planted.size;
        }
    }
}

/// What the distances from a station change by when it is moved, exactly.
inline void move_station(Planted& planted, const Campaign& sound, const Eigen::Vector3d& step) {
    RotaryTableMeasurement& m = planted.measurement;
    for (LengthObservation& length : m.lengths) {
        if (length.station == planted.station && length.approach == Approach::negative) {
            const auto at = [&](const Eigen::Vector3d& station) {
                const Eigen::Vector3d reflector =
                    nominal_rotation(m, length.angle) *
                    sound.truth.fixture.row(static_cast<Eigen::Index>(length.reflector)).transpose();
                return (reflector - station).norm();
            };
            const Eigen::Vector3d& station = sound.truth.stations[planted.station];
            length.length += at(station + step) - at(station);
        }
    }
}

/// One factor on all distances of a station, as of a wrong refractive index.
inline void scale_station(RotaryTableMeasurement& m, std::size_t station, double size) {
    for (LengthObservation& length : m.lengths) {
        length.length *= length.station == station ? 1.0 + size : 1.0;
    }
}

/// What a distance to a reflector changes by when it is moved in the fixture, exactly.
inline void move_reflector(RotaryTableMeasurement& m, LengthObservation& length, const Campaign& sound,
                           const Eigen::Vector3d& step) {
    const Eigen::Vector3d point = sound.truth.fixture.row(static_cast<Eigen::Index>(length.reflector)).transpose();
    const Eigen::Vector3d& station = sound.truth.stations[length.station];
    const Eigen::Matrix3d rotation = nominal_rotation(m, length.angle);
    length.length += (rotation * (point + step) - station).norm() - (rotation * point - station).norm();
}

}  // namespace planting

/// The same seed means the same campaign with the same blunder.
inline Planted plant(Blunder blunder, std::uint64_t seed, int angles = 24) {
    using namespace planting;
    const Campaign sound = sound_campaign(seed, angles, is_closed(blunder), blunder == Blunder::moved_station);
    Planted planted{.measurement = sound.measurement};
    RotaryTableMeasurement& m = planted.measurement;
    constexpr std::uint64_t k_far_away = 0x9E3779B97F4A7C15U;  // from the seeds of the campaigns
    Noise draw(k_far_away + std::uint64_t{1000003} * seed + static_cast<std::uint64_t>(blunder));
    planted.station = one_of(draw, m.stations.size());
    planted.reflector = one_of(draw, m.reflectors.size());
    planted.other = (planted.reflector + 1 + one_of(draw, m.reflectors.size() - 1)) % m.reflectors.size();
    planted.angle = one_of(draw, m.angles.size());
    const double sign = either_sign(draw);
    constexpr double k_u = 0.3e-6;  // of one distance of 1 m: length noise 0.25 µm and 0.15 µm of the table
    switch (blunder) {
        case Blunder::none:
            break;
        case Blunder::outliers:
            add_outliers(planted, draw);
            break;
        case Blunder::visit:
            planted.size = sign * k_u * log_uniform(draw, 5.0, 50.0);
            for (LengthObservation& length : m.lengths) {
                if (length.station == planted.station && length.angle == planted.angle) {
                    length.length += planted.size;
                }
            }
            break;
        case Blunder::jump:
            planted.size = sign * log_uniform(draw, 1e-6, 1e-3);
            add_jump(planted);
            break;
        case Blunder::large_jump:
            planted.size = sign * log_uniform(draw, 1e-3, 20e-3);
            add_jump(planted);
            break;
        case Blunder::drift:
        case Blunder::closed_drift:
            planted.size = sign * log_uniform(draw, 0.5e-6, 5e-6);
            add_drift(m, planted.station, planted.size);
            break;
        case Blunder::drift_of_all:
        case Blunder::closed_drift_of_all:
            planted.size = sign * log_uniform(draw, 0.5e-6, 5e-6);
            for (std::size_t j = 0; j < m.stations.size(); ++j) {
                add_drift(m, j, planted.size * (0.75 + 0.5 * draw.uniform()));
            }
            break;
        case Blunder::moved_station: {
            planted.size = log_uniform(draw, 5e-6, 500e-6);
            const Eigen::Vector3d direction(draw.normal(), draw.normal(), draw.normal());
            move_station(planted, sound, planted.size * direction.normalized());
            break;
        }
        case Blunder::pair:
            planted.size = sign * log_uniform(draw, 5e-6, 50e-6);
            for (LengthObservation& length : m.lengths) {
                if (length.station == planted.station && length.reflector == planted.reflector) {
                    length.length += planted.size;
                }
            }
            break;
        case Blunder::leaning_reflector: {
            planted.size = log_uniform(draw, 2e-6, 50e-6);
            const Eigen::Vector3d direction(draw.normal(), draw.normal(), draw.normal());
            // A quarter to half of the turn, not over its beginning, where the coordinates were measured.
            const std::size_t width = m.angles.size() / 4 + one_of(draw, m.angles.size() / 4 + 1);
            planted.angle = 1 + one_of(draw, m.angles.size() - width);
            planted.last_angle = planted.angle + width - 1;
            for (LengthObservation& length : m.lengths) {
                if (length.reflector == planted.reflector && length.angle >= planted.angle &&
                    length.angle <= planted.last_angle) {
                    move_reflector(m, length, sound, planted.size * direction.normalized());
                }
            }
            break;
        }
        case Blunder::moved_reflector: {
            planted.size = log_uniform(draw, 2e-6, 50e-6);
            const Eigen::Vector3d direction(draw.normal(), draw.normal(), draw.normal());
            planted.station = 1 + one_of(draw, m.stations.size() - 2);
            for (LengthObservation& length : m.lengths) {
                if (length.reflector == planted.reflector &&
                    (length.station > planted.station ||
                     (length.station == planted.station && length.angle >= planted.angle))) {
                    move_reflector(m, length, sound, planted.size * direction.normalized());
                }
            }
            break;
        }
        case Blunder::moved_fixture: {
            planted.size = log_uniform(draw, 2e-6, 300e-6);
            const Eigen::Vector3d direction(draw.normal(), draw.normal(), draw.normal());
            planted.station = 1 + one_of(draw, m.stations.size() - 1);
            for (LengthObservation& length : m.lengths) {
                if (length.station >= planted.station) {
                    move_reflector(m, length, sound, planted.size * direction.normalized());
                }
            }
            break;
        }
        case Blunder::scale_of_station:
            planted.size = sign * log_uniform(draw, 2e-6, 500e-6);
            scale_station(m, planted.station, planted.size);
            break;
        case Blunder::scale_of_two:
            planted.size = sign * log_uniform(draw, 2e-6, 500e-6);
            scale_station(m, planted.station, planted.size);
            planted.other = (planted.station + 1 + one_of(draw, m.stations.size() - 1)) % m.stations.size();
            scale_station(m, planted.other, either_sign(draw) * log_uniform(draw, 2e-6, 500e-6));
            break;
        case Blunder::angle_index: {
            const std::size_t steps = 1 + one_of(draw, m.angles.size() - 1);
            planted.size = static_cast<double>(steps);
            for (LengthObservation& length : m.lengths) {
                if (length.station == planted.station) {
                    length.angle = (length.angle + steps) % m.angles.size();
                }
            }
            break;
        }
        case Blunder::displaced_reflector: {
            planted.size = log_uniform(draw, 5e-6, 50e-6);
            Eigen::Vector3d direction(draw.normal(), draw.normal(), draw.normal());
            m.fixture.row(static_cast<Eigen::Index>(planted.reflector)) +=
                planted.size * direction.normalized().transpose();
            break;
        }
        case Blunder::swapped_reflectors:
            swap_reflectors(m, planted.reflector, planted.other, m.stations.size());
            break;
        case Blunder::swapped_reflectors_of_station:
            swap_reflectors(m, planted.reflector, planted.other, planted.station);
            break;
        case Blunder::wrong_sense:
            for (LengthObservation& length : m.lengths) {
                length.angle = (m.angles.size() - length.angle) % m.angles.size();
            }
            break;
        case Blunder::hot_fixture:
            planted.size = sign * log_uniform(draw, 2.0, 10.0);
            m.temperature_difference.array() += planted.size;
            break;
    }
    return planted;
}

}  // namespace gumcert::engine::synthetic
