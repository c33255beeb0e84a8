#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/joint_adjustment.h"

namespace gumcert::engine {

/// Reliability of one distance in an adjustment with correlated observations.
struct DistanceReliability {
    double residual = 0.0;                 ///< adjusted minus observed, [m]; for a left-out distance its prediction
    double redundancy_number = 0.0;        ///< (Q_v V⁻¹)_ii, 0 … 1; for a left-out distance 1
    double test_value = 0.0;               ///< w, standard normal for a good distance (Baarda 1968)
    double minimal_detectable_bias = 0.0;  ///< [m]
    bool flagged = false;
    bool removed = false;
};

/// One row a length of the measurement.
///
/// w_i = e_iᵀ V⁻¹ v / sqrt(e_iᵀ V⁻¹ Q_v V⁻¹ e_i), minimal detectable bias δ0 / sqrt(e_iᵀ V⁻¹ Q_v V⁻¹ e_i), for full V.
/// A distance that is left out is judged by its deviation from the prediction that the others of its visit allow.
[[nodiscard]] std::vector<DistanceReliability> distance_reliability(const JointAdjustment& adjustment,
                                                                    const NormalEquations& normal,
                                                                    const Eigen::MatrixXd& covariance,
                                                                    const StochasticModel& stochastic,
                                                                    double non_centrality);

}  // namespace gumcert::engine
