#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "engine/adjustment.h"
#include "engine/rotary_table/anglewise_map.h"
#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// Covariance of the positions of all stations in the frame of the datum, 3n×3n in the order x1 y1 z1 x2 …, [m²]: the
/// positions of the solver, moved by the motion of the world that the datum makes of the poses.
[[nodiscard]] Eigen::MatrixXd covariance_of_stations(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                     const BorderedCovariance& covariance, const DatumSolution& datum);
/// The largest part that the variance of a quantity of `map` loses if the station is exactly known along the line on
/// which it is known least (all other parameters adjusted again): the square of their correlation coefficient, 0 to 1.
/// \param variances  of the quantities
[[nodiscard]] double largest_share_of_station(const JointAdjustment& adjustment, const NormalEquations& normal,
                                              const BorderedCovariance& covariance, const DatumSolution& datum,
                                              const AnglewiseMap& map, const Eigen::VectorXd& variances,
                                              std::size_t station);
/// Of one station.
[[nodiscard]] Eigen::Matrix3d station_covariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                 const BorderedCovariance& covariance, const DatumSolution& datum,
                                                 std::size_t station);

}  // namespace gumcert::engine
