#include "gum/monte_carlo/joint_validation.h"

#include <cmath>
#include <cstddef>

#include "gum/coverage.h"
#include "gum/quantity/dense_factors.h"

namespace gumcert::gum {
namespace {

double largest_eigenvalue(const Eigen::MatrixXd& covariance) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation_matrix(covariance), Eigen::EigenvaluesOnly);
    return eigen.eigenvalues().maxCoeff();
}

}  // namespace

JointValidation validate_jointly(const Propagation& propagation, double degrees_of_freedom,
                                 const MonteCarloResult& monte_carlo, const Eigen::VectorXd& in_unit, int digits) {
    const Eigen::Index m = propagation.value.size();
    JointValidation result{.tolerance = Eigen::VectorXd::Zero(m),
                           .value_distance = Eigen::VectorXd::Zero(m),
                           .u_distance = Eigen::VectorXd::Zero(m)};
    result.validated = true;
    for (Eigen::Index j = 0; j < m; ++j) {
        const MonteCarloOutput& output = monte_carlo.outputs[static_cast<std::size_t>(j)];
        // In the unit of the result, because the tolerance is half a unit of a decimal digit of u.
        const double u = propagation.standard_uncertainty(j) * in_unit(j);
        result.tolerance(j) = u > 0.0 ? numerical_tolerance(u, digits) : 0.0;
        result.value_distance(j) = std::abs(propagation.value(j) - output.mean) * in_unit(j);
        result.u_distance(j) = std::abs(u - output.standard_uncertainty * in_unit(j));
        result.validated = result.validated && result.value_distance(j) <= result.tolerance(j) &&
                           result.u_distance(j) <= result.tolerance(j);
    }
    // Of the correlation matrix: an eigenvalue of covariances in different units means nothing.
    const double eigenvalue = largest_eigenvalue(propagation.covariance);
    result.eigenvalue_tolerance = numerical_tolerance(eigenvalue, digits);
    result.eigenvalue_distance = std::abs(eigenvalue - largest_eigenvalue(monte_carlo.covariance));
    result.validated = result.validated && result.eigenvalue_distance <= result.eigenvalue_tolerance;
    // With fewer degrees of freedom there is no ellipsoid (Hotelling's T²), and nothing to compare.
    const bool has_factor = monte_carlo.regions && monte_carlo.regions->ellipsoid_factor &&
                            degrees_of_freedom > static_cast<double>(m) - 1.0;
    if (has_factor) {
        const double k_p = ellipsoid_coverage_factor(monte_carlo.coverage_probability, static_cast<std::size_t>(m),
                                                     degrees_of_freedom);
        result.factor_tolerance = numerical_tolerance(k_p, digits);
        result.factor_distance = std::abs(k_p - *monte_carlo.regions->ellipsoid_factor);
        result.validated = result.validated && *result.factor_distance <= *result.factor_tolerance;
    }
    return result;
}

}  // namespace gumcert::gum
