#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// Reliability of one distance in an adjustment with correlated observations.
struct DistanceReliability {
    double residual = 0.0;                 ///< adjusted minus observed, [m]; for a left-out distance its prediction
    double redundancy_number = 0.0;        ///< (Q_v V⁻¹)_ii, 0 … 1; for a left-out distance 1
    double test_value = 0.0;               ///< w, standard normal for a good distance (Baarda 1968)
    double minimal_detectable_bias = 0.0;  ///< [m]
    bool flagged = false;
    bool removed = false;
    double estimated_error = 0.0;  ///< observed minus what all other observations say, [m]
};

/// Reliability of one coordinate of the fixture as an observation.
struct CoordinateReliability {
    double residual = 0.0;                 ///< adjusted minus stated, [m]
    double redundancy_number = 0.0;        ///< (Q_v V⁻¹)_ii
    double test_value = 0.0;               ///< w, standard normal for a good coordinate
    double minimal_detectable_bias = 0.0;  ///< [m]; 0 where nothing controls the coordinate
    double estimated_error = 0.0;          ///< stated minus what all other observations say, [m]
};

/// One row a length of the measurement.
///
/// w_i = e_iᵀ V⁻¹ v / sqrt(e_iᵀ V⁻¹ Q_v V⁻¹ e_i), minimal detectable bias δ0 / sqrt(e_iᵀ V⁻¹ Q_v V⁻¹ e_i), for full V.
/// A distance that is left out is judged by its deviation from the prediction that the others of its visit allow.
[[nodiscard]] std::vector<DistanceReliability> distance_reliability(const JointAdjustment& adjustment,
                                                                    const NormalEquations& normal,
                                                                    const BorderedCovariance& covariance,
                                                                    const StochasticModel& stochastic,
                                                                    double non_centrality);

/// The same for the coordinates of the fixture, order x1 y1 z1 x2 …
[[nodiscard]] std::vector<CoordinateReliability> fixture_reliability(const JointAdjustment& adjustment,
                                                                     const NormalEquations& normal,
                                                                     const BorderedCovariance& covariance,
                                                                     double non_centrality);

/// Critical value of a test value whose variance was estimated from the same residuals (Pope 1976, tau distribution):
/// τ = sqrt(ν) t / sqrt(ν - 1 + t²).
///
/// \param student_critical_value  t, two-sided, with ν - 1 degrees of freedom
/// \param degrees_of_freedom      ν > 1, redundancy that the variance was estimated from
[[nodiscard]] double tau_critical_value(double student_critical_value, double degrees_of_freedom);

/// Distances left out one at a time, with the adjustment of all others repeated after each one.
///
/// Leaving out a distance is estimating its error b (mean-shift model): with M = V⁻¹ Q_v V⁻¹ and its column m_i,
/// V⁻¹v ← V⁻¹v - m_i b, M ← M - m_i m_iᵀ / M_ii, b = (V⁻¹v)_i / M_ii. That is the adjustment without the distance,
/// exact for the linearised model at fixed weights, and costs one column of M instead of an adjustment.
class OneAtATime {
public:
    struct Suspect {
        std::size_t length = 0;  ///< index into the lengths of the measurement
        double test_value = 0.0;
        double redundancy_number = 0.0;
        double estimated_error = 0.0;  ///< b: observed minus what all others say, [m]
    };

    /// All three must outlive this.
    OneAtATime(const JointAdjustment& adjustment, const NormalEquations& normal, const BorderedCovariance& covariance);

    /// The distance with the largest |w|, where that is above `critical`.
    [[nodiscard]] std::optional<Suspect> largest(double critical) const;
    void leave_out(std::size_t length);
    /// Never a suspect.
    void hold(std::size_t length) {
        floor_[places_[place_of_[length]].index] = std::numeric_limits<double>::infinity();
    }

private:
    struct Place {
        std::size_t visit = 0;
        Eigen::Index row = 0;    ///< within the visit
        Eigen::Index index = 0;  ///< among the active distances
    };
    struct LeftOut {
        Eigen::VectorXd column;  ///< m_i when it was left out
        double diagonal = 0.0;   ///< M_ii then
    };
    [[nodiscard]] Eigen::VectorXd column(const Place& place) const;

    const NormalEquations& normal_;
    const BorderedCovariance& covariance_;
    std::vector<Place> places_;          ///< of the active distances
    std::vector<std::size_t> lengths_;   ///< index of each active distance in the measurement
    std::vector<std::size_t> place_of_;  ///< by length
    std::vector<Eigen::Index> first_;    ///< first active distance of each visit
    Eigen::VectorXd weighted_;           ///< V⁻¹ v
    Eigen::VectorXd diagonal_;           ///< of M
    Eigen::VectorXd floor_;              ///< of the diagonal: below it nothing controls the distance
    std::vector<bool> out_;
    std::vector<LeftOut> left_out_;
};

}  // namespace gumcert::engine
