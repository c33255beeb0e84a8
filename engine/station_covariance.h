#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "engine/adjustment.h"
#include "engine/datum.h"
#include "engine/joint_adjustment.h"

namespace gumcert::engine {

/// Covariance of the position of a station in the frame of the datum, [m²]: the position of the solver, moved by the
/// motion of the world that the datum makes of the poses.
[[nodiscard]] Eigen::Matrix3d station_covariance(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                 const BorderedCovariance& covariance, const DatumSolution& datum,
                                                 std::size_t station);

}  // namespace gumcert::engine
