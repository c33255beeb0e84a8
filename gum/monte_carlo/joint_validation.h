#pragma once

#include <Eigen/Core>
#include <optional>

#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"

namespace gumcert::gum {

/// Comparison of the law of propagation with Monte Carlo for several outputs together (JCGM 102:2011, clause 8):
/// estimates, standard uncertainties, largest eigenvalue of the correlation matrix, and factor of the elliptical
/// region.
struct JointValidation {
    Eigen::VectorXd tolerance;                   ///< m, δ_j of u(y_j), [unit of y_j]
    Eigen::VectorXd value_distance, u_distance;  ///< m, [unit of y_j]
    double eigenvalue_tolerance = 0.0, eigenvalue_distance = 0.0;
    std::optional<double> factor_tolerance = {},
                          factor_distance = {};  ///< of k_p; none where the covariance is singular
    bool validated = false;                      ///< every distance is within its tolerance
};

/// \param in_unit  m, factors that turn coherent SI into the units of the results, where decimal digits count
/// \param ellipsoid_factor  k_p of the law of propagation, for the coverage probability of `monte_carlo`; none: it is not
///                          compared
/// \param digits   significant digits regarded as meaningful, 1 or 2
/// \pre monte_carlo is of the same model and has two or more outputs
[[nodiscard]] JointValidation validate_jointly(const Propagation& propagation,
                                               const std::optional<double>& ellipsoid_factor,
                                               const MonteCarloResult& monte_carlo, const Eigen::VectorXd& in_unit,
                                               int digits);

}  // namespace gumcert::gum
