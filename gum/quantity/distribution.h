#pragma once

#include <limits>
#include <memory>
#include <string_view>
#include <vector>

namespace gumcert::gum {

enum class DistributionKind {
    constant,               ///< the value `location`, without uncertainty
    normal,                 ///< standard: N(0, 1)
    uniform,                ///< standard: R(−1, 1)
    triangular,             ///< standard: symmetric on −1 … 1
    arcsine,                ///< standard: U-shaped on −1 … 1
    trapezoidal,            ///< standard: symmetric on −1 … 1, shape = top / base, 0 … 1
    curvilinear_trapezoid,  ///< standard: limits ±1 inexactly known within ±shape, 0 … 1 (JCGM 101:2008, 6.4.3)
    student_t,              ///< standard: t with shape = ν > 0 degrees of freedom
    gamma,                  ///< standard: shape k > 0, scale 1
    exponential,            ///< standard: mean 1
    lognormal,              ///< standard: exp(shape Z), Z normal, shape > 0
    beta,                   ///< standard: on 0 … 1, shape = α > 0, second_shape = β > 0
    empirical,              ///< standard: the values of `samples`, each with the same probability
};

/// The name of a kind as jobs and records write it, e.g. "curvilinear_trapezoid".
[[nodiscard]] std::string_view distribution_name(DistributionKind kind);

/// Probability distribution assigned to an input quantity (JCGM 101:2008, 6.4 and table 1): X = location + scale S,
/// where S has the standard distribution of its kind. A change of unit touches location and scale alone.
///
/// The moments that an input has in the law of propagation are not taken from here: a Type A quantity has u = s/√n
/// there and the scaled and shifted t here (JCGM 101:2008, 6.4.9.4).
struct Distribution {
    DistributionKind kind = DistributionKind::constant;
    double location = 0.0;
    double scale = 0.0;  ///< ≥ 0; 0 for a constant only
    double shape = 0.0;
    double second_shape = 0.0;
    std::shared_ptr<const std::vector<double>> samples = {};  ///< ascending, `empirical` only

    [[nodiscard]] static Distribution constant(double value);
    [[nodiscard]] static Distribution normal(double mean, double standard_deviation);
    [[nodiscard]] static Distribution uniform(double centre, double half_width);
    /// \param degrees_of_freedom  ν > 0; infinite gives the normal distribution
    [[nodiscard]] static Distribution student_t(double location, double scale, double degrees_of_freedom);
};

/// Expectation of the distribution, [unit of location]. Infinite or NaN where none exists (t with ν ≤ 1).
[[nodiscard]] double expectation(const Distribution& distribution);

/// Standard deviation of the distribution, ≥ 0, [unit of location]. Infinite where none exists (t with ν ≤ 2).
///
/// Uniform a/√3, triangular a/√6, arcsine a/√2, trapezoidal a √((1+β²)/6), curvilinear trapezoid √(a²/3 + d²/9),
/// t s √(ν/(ν−2))                                                            (JCGM 101:2008, 6.4.2 to 6.4.9)
[[nodiscard]] double standard_deviation(const Distribution& distribution);

/// True when the distribution is symmetric about its location.
[[nodiscard]] bool is_symmetric(const Distribution& distribution);

/// True when all values lie between two finite limits.
[[nodiscard]] bool is_bounded(const Distribution& distribution);

}  // namespace gumcert::gum
