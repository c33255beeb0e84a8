#include "gum/weighted_chi_square.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "gum/argument_check.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

constexpr int k_bisections_of_saddle = 60;  // any point near the saddle will do
constexpr double k_first_step = 0.5;        // of t, where y = w sinh t and w is the width of the bell on the path
constexpr int k_most_halvings = 12;
constexpr double k_converged = 1e-10;             // relative change by halving the step, which nearly squares the error
constexpr double k_negligible = 1e-18;            // of a term against the first one, which is w
constexpr std::size_t k_most_terms = 20'000'000;  // never reached; a loop must end
constexpr double k_slope = 0.6;                   // c, of the asymptotes of the path
constexpr double k_least_bend = 0.2;              // of the path, relative to the width of the bell
constexpr double k_smallest_ratio = 1e-100;       // x / λ_max below which the lower tail is 0 for every purpose
constexpr double k_smallest_exponent = 800.0;     // e^-800 is 0
constexpr double k_smallest_weight = 1e-30;       // relative to the largest: adds nothing to Q
constexpr std::uintmax_t k_most_steps_of_quantile = 200;

/// The weights that matter, relative to the largest one, and x relative to it.
struct Scaled {
    std::vector<double> weights;
    double largest = 0.0;  ///< in its unit
    double x = 0.0;
    double sum = 0.0;
};

// All lengths relative to the largest weight: the distribution scales with it, and no unit can leave the range.
Scaled scaled(std::span<const double> weights, double x) {
    double largest = 0.0;
    for (const double weight : weights) {
        require_not_negative(weight, "weight of a sum of chi-squares");
        largest = std::max(largest, weight);
    }
    require_positive(largest, "largest weight of a sum of chi-squares");
    require_finite(x, "sum of chi-squares");
    Scaled result{.weights = {}, .largest = largest, .x = x / largest};
    for (const double weight : weights) {
        if (weight > k_smallest_weight * largest) {
            result.weights.push_back(weight / largest);
        }
    }
    // The same sum for the same weights in another order.
    std::sort(result.weights.begin(), result.weights.end());
    result.sum = std::accumulate(result.weights.begin(), result.weights.end(), 0.0);
    return result;
}

/// The integrand e^Φ(s) along the hyperbola s = s_0 + iy − (√(a² + c²y²) − a), Φ(s) = s x − ½ Σ ln(1 + 2 λ s) − ln(±s).
///
/// The saddle point s_0 is the least value of Φ on the real axis: above 0 for the lower tail, between the branch point
/// −½ (λ_max = 1) and 0 for the upper one. The path opens to the left around the cut that begins at −½. Its slope c is
/// below 1, so that the real part of (s − s_0)² is negative on all of it: the product of many small weights, which is
/// nearly e^(σ²s²), then falls along the path, while e^(sx) falls where there are only few weights.
class SaddlePath {
public:
    SaddlePath(const Scaled& of, bool upper) : of_(of), upper_(upper) {
        s_ = upper ? upper_saddle() : lower_saddle();
        double second = 1.0 / (s_ * s_);
        double third = -2.0 / (s_ * s_ * s_);
        for (const double weight : of_.weights) {
            // Φ″ and Φ‴ at the saddle point: the first gives the width of the bell, both together how the path of
            // steepest descent bends.
            const double slope = weight / (1.0 + 2.0 * weight * s_);
            second += 2.0 * slope * slope;
            third -= 8.0 * slope * slope * slope;
        }
        width_ = 1.0 / std::sqrt(second);
        // The curvature c²/a of the path of steepest descent, where that opens to the left.
        const double curvature = std::max(-third / (3.0 * second), k_least_bend / width_);
        a_ = k_slope * k_slope / curvature;
        at_saddle_ = exponent({s_, 0.0}).real();
    }

    /// 1/π ∫ Re(e^Φ ds/i) from y = 0, which is the tail.
    [[nodiscard]] double integral() const {
        double step = k_first_step;
        double sum = 0.5 * term(0.0) + terms(step, step);
        // Halving the step only adds the points between: what has been evaluated is used again. Sums of a smooth,
        // rapidly falling integrand converge geometrically with the step.
        for (int halving = 0; halving < k_most_halvings; ++halving) {
            const double refined = sum + terms(0.5 * step, step);
            const double before = sum * step;
            const double after = refined * 0.5 * step;
            if (std::abs(after - before) <= k_converged * std::abs(after)) {
                return std::exp(at_saddle_) * (after / std::numbers::pi);
            }
            sum = refined;
            step *= 0.5;
        }
        throw NoResultError(Diagnostic{.code = "GC-GUM-0140",
                                       .where = "sum of chi-squares",
                                       .what = "the integral at " + text::shortest(of_.x) + " times the largest of " +
                                               std::to_string(of_.weights.size()) + " weights has not converged",
                                       .rule = "two steps of integration agree within 1e-10",
                                       .action = "Report the weights; this is not expected to happen."});
    }

private:
    /// Root of x − Σ λ/(1 + 2λs) − 1/s, which rises, between 1/x and (1 + n/2)/x.
    [[nodiscard]] double lower_saddle() const {
        double low = 1.0 / of_.x;
        double high = (1.0 + 0.5 * static_cast<double>(of_.weights.size())) / of_.x;
        for (int i = 0; i < k_bisections_of_saddle; ++i) {
            // In the logarithm: the saddle point may lie anywhere within hundreds of decades, and a mean of the ends
            // would spend all steps on the first few.
            const double s = std::sqrt(low) * std::sqrt(high);
            double slope = of_.x - 1.0 / s;
            for (const double weight : of_.weights) {
                slope -= weight / (1.0 + 2.0 * weight * s);
            }
            (slope > 0.0 ? high : low) = s;
        }
        return std::sqrt(low) * std::sqrt(high);
    }

    /// Root of the same function in s = −(1 − v)/2, where it rises with v: 1 + 2λs = 1 − λ + λv.
    [[nodiscard]] double upper_saddle() const {
        double low = std::min(0.5, 1.0 / (of_.x + 4.0));
        double high = 1.0;
        for (int i = 0; i < k_bisections_of_saddle; ++i) {
            const double v = 0.5 * (low + high);
            double slope = of_.x + 2.0 / (1.0 - v);
            for (const double weight : of_.weights) {
                slope -= weight / (1.0 - weight + weight * v);
            }
            (slope > 0.0 ? high : low) = v;
        }
        return -0.5 * (1.0 - 0.5 * (low + high));
    }

    /// Φ(s)
    [[nodiscard]] std::complex<double> exponent(std::complex<double> s) const {
        std::complex<double> logarithms = 0.0;
        for (const double weight : of_.weights) {
            // A sum of logarithms. The product of a thousand factors leaves the range of double, and its complex root
            // would need a branch.
            logarithms += std::log(1.0 + 2.0 * weight * s);
        }
        return s * of_.x - 0.5 * logarithms - std::log(upper_ ? -s : s);
    }

    /// The integrand relative to e^Φ(s_0), which may be too small for a double, as a function of t, y = w sinh t: where
    /// it falls slowly, few steps go far.
    [[nodiscard]] double term(double t) const {
        const double y = width_ * std::sinh(t);
        const double root = std::hypot(a_, k_slope * y);
        const double left = k_slope * k_slope * y * y / (root + a_);          // root − a without cancellation
        const std::complex<double> slope(1.0, k_slope * k_slope * y / root);  // ds/dy divided by i
        return (std::exp(exponent({s_ - left, y}) - at_saddle_) * slope).real() * width_ * std::cosh(t);
    }

    /// Sum of the terms at first, first + step, … until they are negligible.
    [[nodiscard]] double terms(double first, double step) const {
        double sum = 0.0;
        int small = 0;
        for (std::size_t i = 0; i < k_most_terms && small < 3; ++i) {
            const double value = term(first + static_cast<double>(i) * step);
            sum += value;
            small = std::abs(value) <= k_negligible * width_ ? small + 1 : 0;  // three of them are no zero crossing
        }
        return sum;
    }

    const Scaled& of_;
    bool upper_ = false;
    double s_ = 0.0, width_ = 0.0, a_ = 0.0, at_saddle_ = 0.0;
};

/// Whether the upper tail is below what a double can hold: it is at most e^(−x/4) Π (1 − λ/2)^(−½) (Chernoff's bound).
bool is_beyond(const Scaled& of) {
    return 0.25 * of.x - 0.5 * std::numbers::ln2 * static_cast<double>(of.weights.size()) > k_smallest_exponent;
}

double within_0_and_1(double probability) {
    return std::clamp(probability, 0.0, 1.0);
}

/// The smaller of the two tails is integrated: below the mean the lower one.
double lower_tail(const Scaled& of) {
    if (of.x <= k_smallest_ratio) {
        return 0.0;
    }
    // Far beyond, the lower tail is 1 to all its digits; the integral for the upper one would underflow to 0.
    if (is_beyond(of)) {
        return 1.0;
    }
    return within_0_and_1(of.x <= of.sum ? SaddlePath(of, false).integral() : 1.0 - SaddlePath(of, true).integral());
}

double upper_tail(const Scaled& of) {
    if (of.x <= k_smallest_ratio) {
        return 1.0;
    }
    if (is_beyond(of)) {
        return 0.0;
    }
    return within_0_and_1(of.x <= of.sum ? 1.0 - SaddlePath(of, false).integral() : SaddlePath(of, true).integral());
}

}  // namespace

double weighted_chi_square_lower_tail(std::span<const double> weights, double x) {
    return lower_tail(scaled(weights, x));
}

double weighted_chi_square_upper_tail(std::span<const double> weights, double x) {
    return upper_tail(scaled(weights, x));
}

double weighted_chi_square_quantile(std::span<const double> weights, double probability) {
    require_probability(probability, "probability of the quantile");
    Scaled at = scaled(weights, 0.0);
    // In the logarithm of x and of the smaller tail, where both ends of the distribution are nearly straight lines.
    const bool lower = probability <= 0.5;
    const double wanted = std::log(lower ? probability : 1.0 - probability);
    const auto excess = [&](double log_x) {
        at.x = std::exp(log_x);
        const double tail = lower ? lower_tail(at) : upper_tail(at);
        // −1000 stands for a tail of 0: below the logarithm of every double.
        const double difference = (tail > 0.0 ? std::log(tail) : -1e3) - wanted;
        return lower ? difference : -difference;
    };
    double low = std::log(at.sum);
    double high = low;
    for (double step = 1.0; excess(low) > 0.0; step *= 2.0) {
        low -= step;
    }
    for (double step = 0.5; excess(high) < 0.0; step *= 2.0) {
        high += step;
    }
    std::uintmax_t steps = k_most_steps_of_quantile;
    const auto [below, above] = boost::math::tools::toms748_solve(
        excess, low, high, [](double a, double b) { return std::abs(b - a) <= 1e-12; }, steps);
    return std::exp(0.5 * (below + above)) * at.largest;
}

}  // namespace gumcert::gum
