#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/adjustment.h"

namespace gumcert::engine {

/// A point of a distance network: fixed, observed with a covariance (a CMM, an earlier adjustment) or free.
struct NetworkPoint {
    std::string name;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< fixed or observed value, or start value, [m]
    bool fixed = false;
    std::optional<Eigen::Matrix3d> covariance;  ///< of the observed position, [m²]
    bool eliminated = false;                    ///< one of many points that no distance joins to another such
};

/// Distance between two points: l + l0 = |P - Q|, with an optional additive constant shared by several distances.
struct NetworkDistance {
    std::size_t from = 0;
    std::size_t to = 0;
    std::optional<std::size_t> constant;  ///< index of the additive constant l0
    double length = 0.0;                  ///< l, [m]
    double u = 0.0;                       ///< standard uncertainty, [m]
};

struct NetworkReliability {
    double residual = 0.0;  ///< adjusted minus observed distance, [m]
    double redundancy_number = 0.0;
    /// Normalised residual (Baarda), standard normal for a good distance; none where no other distance controls this one
    std::optional<double> test_value;
    std::optional<double>
        minimal_detectable_bias;  ///< for the non-centrality asked for, [m]; none: no error would be found
};

struct NetworkSolution {
    SolveSummary summary;
    RankReport rank;
    std::vector<Eigen::Vector3d> positions;    ///< of all points, [m]
    std::vector<Eigen::Matrix3d> covariances;  ///< a priori, zero for fixed points, [m²]
    /// Of all coordinates together, 3P×3P, order x1 y1 z1 x2 …, a priori, zero for fixed points, [m²]; empty unless
    /// asked for.
    Eigen::MatrixXd joint_covariance;
    Eigen::VectorXd constants;    ///< l0, [m]
    Eigen::VectorXd u_constants;  ///< [m]
    double chi_square = 0.0;
    long degrees_of_freedom = 0;
    std::vector<NetworkReliability> reliability;  ///< one a distance
};

/// What is stated of the uncertainty of the points: the covariance of each, or of all together.
enum class PointCovariance { each, joint };

/// Adjustment of a network of points from distances (trilateration with additive constants).
///
/// \param constants      number of additive constants, start values 0
/// \param non_centrality δ0 of the minimal detectable bias; 4.13 for 0.1 % and 80 %
/// \param wanted        joint: fill `joint_covariance` as well (a matrix of the size of all points)
/// \throws gum::NoResultError if the points are not determined or the solution does not converge
/// Accuracy: positions of a network of metres within 1e-12 m, their standard uncertainties within 1e-6 relative
/// (docs/accuracy.md#adjustment-of-distances).
/// Example: examples/api/distances.cpp
[[nodiscard]] NetworkSolution adjust_distance_network(const std::vector<NetworkPoint>& points, std::size_t constants,
                                                      const std::vector<NetworkDistance>& distances,
                                                      const SolverOptions& options, double non_centrality = 4.13,
                                                      PointCovariance wanted = PointCovariance::each);

}  // namespace gumcert::engine
