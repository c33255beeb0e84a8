#include "engine/harmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double k_full_turn = 2.0 * std::numbers::pi;

/// One column of ones, then cosine and sine of every order.
MatrixXd design(const Eigen::Ref<const VectorXd>& angles, int orders) {
    MatrixXd columns = MatrixXd::Ones(angles.size(), 1 + 2 * orders);
    for (int k = 1; k <= orders; ++k) {
        columns.col(2 * k - 1) = (k * angles.array()).cos();
        columns.col(2 * k) = (k * angles.array()).sin();
    }
    return columns;
}

/// Along the direction in which the amplitude grows; of an amplitude of zero the mean of all directions.
double uncertainty_of_amplitude(double a, double b, const Eigen::Matrix2d& covariance) {
    const double square = a * a + b * b;
    const double variance =
        square > 0.0 ? (a * a * covariance(0, 0) + 2.0 * a * b * covariance(0, 1) + b * b * covariance(1, 1)) / square
                     : 0.5 * covariance.trace();
    return std::sqrt(std::max(0.0, variance));
}

}  // namespace

int resolved_orders(const Eigen::Ref<const VectorXd>& angles, int most) {
    if (angles.size() < 3) {
        return 0;
    }
    double gap = angles[0] + k_full_turn - angles[angles.size() - 1];
    for (Index i = 1; i < angles.size(); ++i) {
        gap = std::max(gap, angles[i] - angles[i - 1]);
    }
    // Strictly below half the turns a gap: the order n/2 of n equal steps has no sine.
    const int orders = static_cast<int>(std::ceil(std::numbers::pi / gap * (1.0 - 1e-9))) - 1;
    return std::clamp(orders, 0, most);
}

HarmonicAnalysis analyse_harmonics(const Eigen::Ref<const VectorXd>& angles, const Eigen::Ref<const VectorXd>& values,
                                   const std::function<MatrixXd(const MatrixXd&)>& covariance_of, int orders) {
    const MatrixXd columns = design(angles, orders);
    // By an orthogonal factorisation: for unequal steps cosines and sines are not orthogonal, and the sums of the
    // discrete Fourier transform would mix the orders.
    const Eigen::HouseholderQR<MatrixXd> factor(columns);
    const MatrixXd basis = factor.householderQ() * MatrixXd::Identity(angles.size(), columns.cols());
    const auto triangle = factor.matrixQR().topRows(columns.cols()).triangularView<Eigen::Upper>();
    const MatrixXd gain = triangle.solve(basis.transpose());  // (2 orders + 1)×n
    const VectorXd coefficients = gain * values;
    // The coefficients are linear in the values: their covariance is that of the same combinations, with all
    // correlations between the angles.
    const MatrixXd spread = covariance_of(gain);
    HarmonicAnalysis result;
    result.mean = coefficients[0];
    result.rms_rest = (values - columns * coefficients).norm() / std::sqrt(static_cast<double>(angles.size()));
    for (int k = 1; k <= orders; ++k) {
        const double a = coefficients[2 * k - 1];
        const double b = coefficients[2 * k];
        // The phase of A cos(kθ − φ): of b over a.
        const double phase = std::atan2(b, a);
        result.orders.push_back(
            {.order = k,
             .amplitude = std::hypot(a, b),
             .phase = phase < 0.0 ? phase + k_full_turn : phase,
             .u_amplitude = uncertainty_of_amplitude(a, b, spread.block<2, 2>(2 * k - 1, 2 * k - 1))});
    }
    return result;
}

}  // namespace gumcert::engine
