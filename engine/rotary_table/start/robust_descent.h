#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <vector>

#include "engine/rotary_table/start/observed_stations.h"

namespace gumcert::engine {

/// Where a station was found, and how well its distances fit there.
struct StationFit {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();       ///< in T, [m]
    double misfit = std::numeric_limits<double>::infinity();  ///< `misfit_of`, [m]
    Eigen::Vector4d set_up = Eigen::Vector4d::Zero();         ///< with which the station was found

    /// Misfit with a fixture that stands as fixtures stand: a table that turns the other way looks like one whose axis
    /// is turned over. A metre for the latter. [m]
    [[nodiscard]] double upright_misfit() const;
    /// Nothing better has to be looked for: it stands upright and leaves what error motions do.
    [[nodiscard]] bool is_settled() const;
};

/// Which distances a descent follows.
enum class Pull {
    of_those_that_agree,  ///< weights of Cauchy's function: gross errors have none
    of_all,               ///< plain least squares, before the one with weights
};

/// What a descent knows beforehand.
enum class Prior {
    weak,    ///< set-up errors are of millimetres and a degree: it only decides what the distances leave open
    strong,  ///< and stations stand some metres from the table: as probabilities, for distances that hardly tell a place
};

// Steps at which a descent ends, [m] and [rad]: of one station, to choose among candidates, and of the start values.
constexpr double k_coarse_step = 1e-4;
constexpr double k_fine_step = 1e-6;

/// Robust Gauss-Newton descent (iterated reweighting, scale from the median absolute deviation, damped) of the
/// positions of some stations and, with `free_set_up`, of the set-up that they share. Dead paths are eliminated.
/// \param of      stations, each once; only their fits are read and changed
/// \param set_up  with which it begins and ends
/// \param fits    one a station of the measurement
/// \param pull    of distances that are far off: of all alike, plain least squares, a descent finds its way from any
///                side of the points; with weights it ends where some of the distances agree by chance
void descend(const ObservedStations& observed, const std::vector<std::size_t>& of, Eigen::Vector4d& set_up,
             std::vector<StationFit>& fits, bool free_set_up, double step_tolerance = k_fine_step,
             Pull pull = Pull::of_those_that_agree, Prior knowledge = Prior::weak);

/// The same of one station from a place, with a set-up of its own.
/// \param pull  of_all: by plain least squares first
[[nodiscard]] StationFit refined(const ObservedStations& observed, std::size_t station, const Eigen::Vector3d& from,
                                 const Eigen::Vector4d& set_up, bool free_set_up, Pull pull = Pull::of_those_that_agree,
                                 Prior knowledge = Prior::weak);

}  // namespace gumcert::engine
