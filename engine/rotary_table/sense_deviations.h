#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// What the visits of one sense of approach to one angle show beyond the adjusted pose E ± reversal/2.
struct SenseDeviation {
    std::size_t angle = 0;
    Approach approach = Approach::positive;
    Eigen::Matrix<double, 6, 1> deviation = Eigen::Matrix<double, 6, 1>::Zero();  ///< [m] and [rad]
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// The six error motions of each sense of approach of their own, where the adjustment has one curve and one reversal
/// for all angles: with the lengths l of the sense at an angle, their derivatives A with respect to the pose and their
/// covariance M,
///
///   d = G (l - f(x̂)),  G = (AᵀM⁻¹A)⁻¹AᵀM⁻¹
///
/// Residuals are not correlated with the adjusted parameters, so that the covariance of E ± reversal/2 + d is that of
/// E ± reversal/2 and that of d, added:
///
///   V(d) = G Q_v Gᵀ = (AᵀM⁻¹A)⁻¹ - G J C Jᵀ Gᵀ
///
/// with the derivatives J of the lengths with respect to all parameters and their covariance C. The cost is
/// proportional to the angles. A sense whose lengths do not determine all six at an angle is left out.
///
/// \param normal, covariance  of the adjustment, at its solution
/// \return in the order of the angles, positive approach first
[[nodiscard]] std::vector<SenseDeviation> sense_deviations(const JointAdjustment& adjustment,
                                                           const NormalEquations& normal,
                                                           const BorderedCovariance& covariance);

}  // namespace gumcert::engine
