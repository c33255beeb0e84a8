#include "gum/nearest_correlation.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/special_values.h"

#include <cmath>
#include <limits>

namespace gumcert::gum {

namespace {

constexpr int k_most_steps = 500;
/// Smallest eigenvalue that the projection leaves: above 0, so that the box of the tolerances is reached in a finite
/// number of steps.
constexpr double k_floor = 1e-11;

}  // namespace

bool is_positive_semidefinite(const Eigen::MatrixXd& correlation) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation, Eigen::EigenvaluesOnly);
    const Eigen::Index n = correlation.rows();
    // Relative to the largest eigenvalue and in proportion to n: that is what the rounding of an eigenvalue solver may
    // leave of a 0. The law of propagation judges by the same limit.
    return eigen.eigenvalues()(0) >= -10.0 * static_cast<double>(n) * k_epsilon * eigen.eigenvalues()(n - 1);
}

std::optional<Eigen::MatrixXd> nearest_correlation(const Eigen::MatrixXd& correlation,
                                                   const Eigen::MatrixXd& tolerance) {
    // Stated coefficients are rounded. A matrix that contradicts itself by less than their last digits is taken for the
    // one that was meant (ADR 0025).
    Eigen::MatrixXd boxed = correlation;
    Eigen::MatrixXd of_cone = Eigen::MatrixXd::Zero(correlation.rows(), correlation.cols());  // corrections
    Eigen::MatrixXd of_box = of_cone;
    for (int step = 0; step < k_most_steps; ++step) {
        // The test comes first, at a point inside of the box: what is returned has the ones on its diagonal and
        // coefficients within their tolerances exactly, and not only within the last projection.
        if (is_positive_semidefinite(boxed)) {
            return boxed;
        }
        // Each projection starts from the point less what the same projection added before (Dykstra). Without that the
        // sequence ends in some point of both sets, but not in the nearest one.
        const Eigen::MatrixXd before_cone = boxed - of_cone;
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(before_cone);
        const Eigen::MatrixXd positive = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(k_floor).asDiagonal() *
                                         eigen.eigenvectors().transpose();
        of_cone = positive - before_cone;
        const Eigen::MatrixXd before_box = positive - of_box;
        boxed = before_box.cwiseMax(correlation - tolerance).cwiseMin(correlation + tolerance);
        // The product above is symmetric but for rounding; a solver that reads one triangle must not depend on which
        // one.
        boxed = (0.5 * (boxed + boxed.transpose())).eval();
        boxed.diagonal().setOnes();
        of_box = boxed - before_box;
    }
    return std::nullopt;
}

}  // namespace gumcert::gum
