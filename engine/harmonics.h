#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace gumcert::engine {

/// One order k of a curve over a full turn: A cos(kθ - φ) = a cos kθ + b sin kθ.
struct Harmonic {
    int order = 1;
    double amplitude = 0.0;    ///< A = √(a² + b²), in the unit of the curve
    double phase = 0.0;        ///< φ, the angle times k at which the order is largest, [rad], 0 … 2π
    double u_amplitude = 0.0;  ///< of A by the law of propagation; of an amplitude well above it
};

struct HarmonicAnalysis {
    double mean = 0.0;  ///< order 0
    std::vector<Harmonic> orders;
    double rms_rest = 0.0;  ///< of the curve without these orders
};

/// Orders that angles tell apart: k such that the largest gap between neighbours, over the full turn, is less than half
/// a period of it; at most `most`. Of n equally spaced angles these are the orders below n/2. 0: the angles do not
/// cover the circle.
/// \param angles  ascending, [rad]
[[nodiscard]] int resolved_orders(const Eigen::Ref<const Eigen::VectorXd>& angles, int most);

/// Fourier coefficients of a curve by least squares, all values with the same weight: for equally spaced angles the
/// discrete Fourier transform.
/// \param covariance_of  covariance of combinations c of the values, k×n: c V cᵀ, k×k, in the square of their unit
/// \param orders         from resolved_orders()
/// Accuracy: amplitudes within 1e-13 of the values, phases within 1e-12 rad (docs/accuracy.md#adjustment-of-distances).
/// Example: examples/api/distances.cpp
[[nodiscard]] HarmonicAnalysis analyse_harmonics(
    const Eigen::Ref<const Eigen::VectorXd>& angles, const Eigen::Ref<const Eigen::VectorXd>& values,
    const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& covariance_of, int orders);

}  // namespace gumcert::engine
