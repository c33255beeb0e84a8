#include "gum/monte_carlo/joint_validation.h"

#include <cmath>
#include <cstddef>

#include "gum/quantity/dense_factors.h"

namespace gumcert::gum {
namespace {

double largest_eigenvalue(const Eigen::MatrixXd& covariance) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation_matrix(covariance), Eigen::EigenvaluesOnly);
    return eigen.eigenvalues().maxCoeff();
}

}  // namespace

JointValidation validate_jointly(const Propagation& propagation, const std::optional<double>& ellipsoid_factor,
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
    if (ellipsoid_factor && monte_carlo.regions && monte_carlo.regions->ellipsoid_factor) {
        result.factor_tolerance = numerical_tolerance(*ellipsoid_factor, digits);
        result.factor_distance = std::abs(*ellipsoid_factor - *monte_carlo.regions->ellipsoid_factor);
        result.validated = result.validated && *result.factor_distance <= *result.factor_tolerance;
    }
    return result;
}

}  // namespace gumcert::gum
