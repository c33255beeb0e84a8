// Harmonics of a curve over a full turn, against the discrete Fourier transform and known sums of cosines.
#include "engine/harmonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace gumcert::engine {
namespace {

/// Covariance of combinations, from the whole matrix.
auto of(const Eigen::MatrixXd& covariance) {
    return [covariance](const Eigen::MatrixXd& c) -> Eigen::MatrixXd { return c * covariance * c.transpose(); };
}

constexpr double k_turn = 2.0 * std::numbers::pi;

Eigen::VectorXd equal_steps(int count) {
    return Eigen::VectorXd::LinSpaced(count + 1, 0.0, k_turn).head(count);
}

TEST(Harmonics, OfEquallySpacedAnglesAreTheDiscreteFourierTransform) {
    const int n = 12;
    const Eigen::VectorXd angles = equal_steps(n);
    Eigen::VectorXd values(n);
    values << 3.1, -0.4, 2.2, 5.0, -1.3, 0.2, 0.9, -2.5, 1.1, 4.4, -0.7, 0.3;
    const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n) * 0.04;
    const HarmonicAnalysis found = analyse_harmonics(angles, values, of(covariance), 5);
    ASSERT_EQ(found.orders.size(), 5U);
    EXPECT_NEAR(found.mean, values.mean(), 1e-14);
    for (const Harmonic& h : found.orders) {
        std::complex<double> sum;
        for (int i = 0; i < n; ++i) {
            sum += values[i] * std::polar(1.0, h.order * angles[i]);
        }
        sum *= 2.0 / n;
        EXPECT_NEAR(h.amplitude, std::abs(sum), 1e-13);
        EXPECT_NEAR(std::remainder(h.phase - std::arg(sum), k_turn), 0.0, 1e-12);
        EXPECT_NEAR(h.u_amplitude, 0.2 * std::sqrt(2.0 / n), 1e-14);  // the same in all directions
    }
    // Parseval: what the orders leave is the order n/2.
    double nyquist = 0.0;
    for (int i = 0; i < n; ++i) {
        nyquist += values[i] * (i % 2 == 0 ? 1.0 : -1.0) / n;
    }
    EXPECT_NEAR(found.rms_rest, std::abs(nyquist), 1e-13);
}

TEST(Harmonics, OfUnequalAnglesAreThoseOfTheCurve) {
    Eigen::VectorXd angles = equal_steps(15);
    for (Eigen::Index i = 0; i < angles.size(); ++i) {
        angles[i] += 0.05 * std::sin(7.0 * static_cast<double>(i));
    }
    const Eigen::VectorXd values = 2.0 + 1.5 * (angles.array() - 0.4).cos() + 0.25 * (3.0 * angles.array() - 5.0).cos();
    const HarmonicAnalysis found =
        analyse_harmonics(angles, values, of(Eigen::MatrixXd::Zero(15, 15)), resolved_orders(angles, 4));
    ASSERT_EQ(found.orders.size(), 4U);
    EXPECT_NEAR(found.mean, 2.0, 1e-13);
    EXPECT_NEAR(found.orders[0].amplitude, 1.5, 1e-13);
    EXPECT_NEAR(found.orders[0].phase, 0.4, 1e-13);
    EXPECT_NEAR(found.orders[1].amplitude, 0.0, 1e-13);
    EXPECT_NEAR(found.orders[2].amplitude, 0.25, 1e-13);
    EXPECT_NEAR(found.orders[2].phase, 5.0, 1e-12);
    EXPECT_NEAR(found.rms_rest, 0.0, 1e-13);
}

TEST(Harmonics, HaveTheUncertaintyOfCorrelatedValues) {
    // Errors of the shape cos θ alone: they move the amplitude of order 1 by their whole size where its phase is 0, and
    // not at all where its phase is a quarter turn.
    const Eigen::VectorXd angles = equal_steps(8);
    const Eigen::VectorXd shape = angles.array().cos();
    const Eigen::MatrixXd covariance = 0.01 * shape * shape.transpose();
    const HarmonicAnalysis along = analyse_harmonics(angles, 3.0 * shape, of(covariance), 3);
    EXPECT_NEAR(along.orders[0].u_amplitude, 0.1, 1e-14);
    const HarmonicAnalysis across = analyse_harmonics(angles, 3.0 * angles.array().sin(), of(covariance), 3);
    EXPECT_NEAR(across.orders[0].u_amplitude, 0.0, 1e-8);
    EXPECT_NEAR(along.orders[1].u_amplitude, 0.0, 1e-8);
}

TEST(Harmonics, AreResolvedBelowHalfTheAngles) {
    EXPECT_EQ(resolved_orders(equal_steps(36), 100), 17);
    EXPECT_EQ(resolved_orders(equal_steps(36), 10), 10);
    EXPECT_EQ(resolved_orders(equal_steps(5), 10), 2);
    EXPECT_EQ(resolved_orders(Eigen::VectorXd::LinSpaced(19, 0.0, 0.5 * k_turn), 10), 0);  // half a turn
    EXPECT_EQ(resolved_orders(Eigen::VectorXd::LinSpaced(2, 0.0, 3.0), 10), 0);
}

}  // namespace
}  // namespace gumcert::engine
