#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/studies/line_of_sight.h"
#include "engine/rotary_table/studies/measurement_plan.h"

namespace gumcert::engine {

/// Largest standard uncertainty of each of the six error motions, in units of the one wanted.
/// \param wanted  of the three linear and the three angular error motions, [m] and [rad]
[[nodiscard]] std::array<double, 6> motion_ratios(const Eigen::VectorXd& variances, Eigen::Index angles,
                                                  const std::array<double, 2>& wanted);
/// The largest of them; infinite where there are no variances, because something is not determined.
[[nodiscard]] double largest_ratio(const std::optional<Eigen::VectorXd>& variances, Eigen::Index angles,
                                   const std::array<double, 2>& wanted);

/// Box and rules for where stations may stand.
struct StationRegion {
    std::array<Eigen::Vector3d, 2> corners;  ///< opposite, in T, [m]
    double step = 0.2;                       ///< [m]
    double least_distance = 0.2;             ///< from every reflector at every angle, [m]
    /// From the rotary axis, [m]: from the axis itself a ring of reflectors is seen on a cone.
    double least_axis_distance = 0.02;
    std::size_t most_candidates = 2000;
};

struct StationCandidates {
    std::vector<Eigen::Vector3d> positions;  ///< x slowest, z fastest
    double step = 0.0;                       ///< of the grid that was used, coarser where there were too many, [m]
};

/// Grid in the box that begins and ends at its faces, without the positions that the rules forbid.
[[nodiscard]] StationCandidates station_candidates(const RotaryTableMeasurement& measurement,
                                                   const StationRegion& region);

/// A station that stands nearer to a reflector than a station may, and where that reflector is nearest to it.
struct StationAmongReflectors {
    std::size_t station = 0, reflector = 0, angle = 0;
    double distance = 0.0;  ///< [m]
};
/// \param measurement  with the positions of all stations
/// \param least_distance  of a station from every reflector at every angle, [m]
[[nodiscard]] std::vector<StationAmongReflectors> stations_among_reflectors(const RotaryTableMeasurement& measurement,
                                                                            double least_distance);

/// Runs numbered tasks, each once, on any number of threads; `worker` is below `workers`.
struct ParallelTasks {
    unsigned workers = 1;
    std::function<void(std::size_t tasks, const std::function<void(unsigned worker, std::size_t task)>& work)> run;
};

/// What makes a layout better.
struct ExchangeRules {
    std::array<double, 2> wanted{};  ///< see motion_ratios
    /// No exchange may take the U of an error motion that meets its target above it.
    bool keep_met = false;
    const LineOfSight* sight = nullptr;  ///< null: every station sees every reflector from everywhere
    double least_gain = 0.005;           ///< of an exchange, part of the largest ratio
};

struct StationExchange {
    std::size_t station = 0;
    Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< [m]
    double ratio = 0.0;                                                            ///< largest ratio after it
};

struct StationProposal {
    std::vector<Eigen::Vector3d> positions;  ///< in the order of the stations, [m]
    double ratio_before = 0.0, ratio_after = 0.0;
    std::vector<StationExchange> exchanges;  ///< in order
    std::size_t layouts = 0;                 ///< that were compared
};

/// Stations that make the largest expected uncertainty smaller, by greedy exchange: each round tries every station at
/// every candidate and makes the one exchange that lowers the largest ratio most, until none lowers it by more than
/// `least_gain`. Equal exchanges: the first station and the first candidate win, so the result is the same for any
/// number of threads. It is a local optimum of single moves, not proved to be the best layout.
///
/// A layout whose poses alone are too uncertain (LayoutVariances::least_variances) is not looked at further: it cannot
/// be the best of its round.
/// \param measurement  with all distances that would be measured if nothing stood in the way
[[nodiscard]] StationProposal propose_stations(const RotaryTableMeasurement& measurement,
                                               const StochasticModel& stochastic,
                                               const std::vector<Eigen::Vector3d>& candidates,
                                               const ExchangeRules& rules, const ParallelTasks& parallel,
                                               const Progress& progress = {});

}  // namespace gumcert::engine
