#include "gum/weighted_t_square.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/weighted_chi_square.h"

namespace gumcert::gum {
namespace {

/// The principal root, from functions of real numbers that are the same on every processor (ADR 0058).
std::complex<double> square_root(const std::complex<double>& z) {
    const double larger = std::sqrt(0.5 * (std::abs(z.real()) + std::hypot(z.real(), z.imag())));
    if (!(larger > 0.0)) {
        return 0.0;
    }
    const double smaller = 0.5 * std::abs(z.imag()) / larger;
    return z.real() >= 0.0 ? std::complex<double>(larger, std::copysign(smaller, z.imag()))
                           : std::complex<double>(smaller, std::copysign(larger, z.imag()));
}

// S = χ²_ν/ν with y = ln S has the density e^(ν/2 (y − e^y)) but for a constant.
constexpr double k_largest_step_of_scale = 0.1;    // of y; the transform has a singularity 0.4 from the real axis
constexpr double k_step_in_deviations = 0.5;       // of its standard deviation √(2/ν), about
constexpr double k_negligible_log_density = 42.0;  // e^-42 is 6e-19
constexpr double k_normal_from = 1e8;              // ν from which T differs from Z by less than what is promised

constexpr int k_nodes_of_contour = 14;  // on each side of the real axis
constexpr double k_bend_of_contour = 1.172104229;
constexpr double k_step_of_contour = 1.081792140;
constexpr double k_size_of_contour = 4.492075287;

constexpr double k_slope_of_scale_path = 0.6;  // of the asymptotes
constexpr double k_least_bend_of_scale_path = 0.2;
constexpr int k_most_halvings_of_scale_path = 9;
constexpr double k_converged_scale_path = 1e-10;
constexpr double k_negligible_of_scale_path = 1e-17;

constexpr std::uintmax_t k_most_steps_of_t_quantile = 200;
constexpr double k_tolerance_of_quantile = 1e-10;  // of ln x
constexpr double k_factor_of_bracket = 4.0;
constexpr double k_range_of_logarithm = 600.0;

/// S as a few values with their probabilities: the trapezoidal rule in y, which converges geometrically.
struct ScaleNode {
    double scale = 1.0, probability = 1.0;
};

std::vector<ScaleNode> nodes_of_scale(double degrees_of_freedom) {
    if (degrees_of_freedom > k_normal_from) {
        return {{}};
    }
    const double half = 0.5 * degrees_of_freedom;
    const double step = std::min(k_largest_step_of_scale, k_step_in_deviations / std::sqrt(half));
    const auto log_density = [half](double y) { return half * (y - std::expm1(y)); };  // 0 at its maximum
    std::vector<ScaleNode> nodes{{1.0, 1.0}};
    double sum = 1.0;
    for (const double direction : {-1.0, 1.0}) {
        for (double y = direction * step; log_density(y) > -k_negligible_log_density; y += direction * step) {
            nodes.push_back({std::exp(y), std::exp(log_density(y))});
            sum += nodes.back().probability;
        }
    }
    for (ScaleNode& node : nodes) {
        node.probability /= sum;
    }
    return nodes;
}

/// The terms, relative to the largest weight, equal ones together.
class TransformOfSquares {
public:
    explicit TransformOfSquares(std::span<const SquaredT> terms) {
        std::map<std::pair<double, double>, std::size_t> groups;
        for (const SquaredT& term : terms) {
            require_not_negative(term.weight, "weight of a sum of squares of t");
            require_degrees_of_freedom(term.degrees_of_freedom, "degrees of freedom of t");
            largest_ = std::max(largest_, term.weight);
            if (term.weight > 0.0) {
                ++groups[{term.degrees_of_freedom, term.weight}];
            }
        }
        require_positive(largest_, "largest weight of a sum of squares of t");
        for (const auto& [term, count] : groups) {
            if (groups_.empty() || groups_.back().degrees_of_freedom != term.first) {
                groups_.push_back({term.first, nodes_of_scale(term.first), {}});
            }
            groups_.back().terms.emplace_back(term.second / largest_, count);
        }
    }

    [[nodiscard]] double largest() const { return largest_; }

    /// E[e^(−s Q)], Q relative to the largest weight.
    [[nodiscard]] std::complex<double> operator()(std::complex<double> s) const {
        std::complex<double> logarithm = 0.0;
        for (const Group& group : groups_) {
            for (const auto& [weight, count] : group.terms) {
                std::complex<double> of_one = 0.0;
                for (const ScaleNode& node : group.nodes) {
                    of_one += node.probability / square_root(1.0 + 2.0 * weight * s / node.scale);
                }
                logarithm += static_cast<double>(count) * std::log(of_one);
            }
        }
        return std::exp(logarithm);
    }

    /// P(Q ≤ x), x relative to the largest weight, or P(Q ≥ x).
    [[nodiscard]] double tail(double x, bool upper) const {
        const double step = k_step_of_contour / k_nodes_of_contour;
        const double size = k_size_of_contour * k_nodes_of_contour / x;
        double sum = 0.0;
        for (int k = 0; k <= k_nodes_of_contour; ++k) {
            // sin and cos of -a + iy
            const double y = static_cast<double>(k) * step;
            const double sine = -std::sin(k_bend_of_contour);
            const double cosine = std::cos(k_bend_of_contour);
            const std::complex<double> s =
                size * std::complex<double>(1.0 + sine * std::cosh(y), cosine * std::sinh(y));
            const std::complex<double> slope =
                size * std::complex<double>(cosine * std::cosh(y), -sine * std::sinh(y));  // ds/du over i
            const std::complex<double> transform = (*this)(s);
            const std::complex<double> term = std::exp(s * x) * (upper ? 1.0 - transform : transform) / s * slope;
            sum += (k == 0 ? 0.5 : 1.0) * term.real();
        }
        return std::clamp(sum * step / std::numbers::pi, k_least_tail_of_t, 1.0);
    }

private:
    struct Group {
        double degrees_of_freedom = 0.0;
        std::vector<ScaleNode> nodes;
        std::vector<std::pair<double, std::size_t>> terms;  ///< weight and how often
    };
    std::vector<Group> groups_;
    double largest_ = 0.0;
};

/// The x at which a distribution that rises from 0 to 1 is `probability`, searched from `start` in its logarithm.
double quantile_from(const std::function<double(double)>& lower_tail, double probability, double start) {
    const auto excess = [&](double logarithm) { return lower_tail(std::exp(logarithm)) - probability; };
    double low = std::log(start);
    double high = low;
    double at_low = excess(low);
    double at_high = at_low;
    while (at_low > 0.0 && low > -k_range_of_logarithm) {
        high = low;
        at_high = at_low;
        low -= std::log(k_factor_of_bracket);
        at_low = excess(low);
    }
    while (at_high < 0.0 && high < k_range_of_logarithm) {
        low = high;
        at_low = at_high;
        high += std::log(k_factor_of_bracket);
        at_high = excess(high);
    }
    if (at_low >= 0.0 || at_high <= 0.0) {
        return std::exp(at_low >= 0.0 ? low : high);
    }
    std::uintmax_t steps = k_most_steps_of_t_quantile;
    const auto near = [](double a, double b) { return std::abs(b - a) <= k_tolerance_of_quantile; };
    const auto [left, right] = boost::math::tools::toms748_solve(excess, low, high, at_low, at_high, near, steps);
    return std::exp(0.5 * (left + right));
}

double squared_t_tail(std::span<const SquaredT> terms, double x, bool upper) {
    require_finite(x, "sum of squares of t");
    const TransformOfSquares transform(terms);
    if (!(x > 0.0)) {
        return upper ? 1.0 : 0.0;
    }
    return transform.tail(x / transform.largest(), upper);
}

/// P(Q ≤ x S) or P(Q ≥ x S) for Q = Σ λ Z² and S = χ²_ν/ν: the sign of W = Q − x S, whose transform
/// Π (1 + 2 λ_k s)^(−1/2) (1 − 2 x s/ν)^(−ν/2) is inverted at 0 along a hyperbola through the saddle point, as
/// gum/weighted_chi_square.cpp does it for Q alone.
class CommonScalePath {
public:
    CommonScalePath(std::span<const double> weights, double degrees_of_freedom, double x, bool upper)
        : nu_(degrees_of_freedom), upper_(upper) {
        double largest = 0.0;
        for (const double weight : weights) {
            require_not_negative(weight, "weight of a sum of squares of t");
            largest = std::max(largest, weight);
        }
        require_positive(largest, "largest weight of a sum of squares of t");
        std::map<double, double> counts;
        for (const double weight : weights) {
            if (weight > 0.0) {
                counts[weight / largest] += 1.0;
            }
        }
        weights_.assign(counts.begin(), counts.end());
        x_ = x / largest;
        s_ = saddle();
        double second = 1.0 / (s_ * s_);
        double third = -2.0 / (s_ * s_ * s_);
        for (const auto& [weight, count] : weights_) {
            const double slope = weight / (1.0 + 2.0 * weight * s_);
            second += 2.0 * count * slope * slope;
            third -= 8.0 * count * slope * slope * slope;
        }
        const double slope = x_ / (1.0 - 2.0 * x_ * s_ / nu_);
        second += 2.0 * slope * slope / nu_;
        third += 8.0 * slope * slope * slope / (nu_ * nu_);
        width_ = 1.0 / std::sqrt(second);
        a_ = k_slope_of_scale_path * k_slope_of_scale_path /
             std::max(-third / (3.0 * second), k_least_bend_of_scale_path / width_);
        at_saddle_ = exponent({s_, 0.0}).real();
    }

    [[nodiscard]] double tail() const {
        double step = 0.5;
        double sum = 0.5 * term(0.0).real() + terms(step, step);
        double result = sum * step;
        for (int halving = 0; halving < k_most_halvings_of_scale_path; ++halving) {
            sum += terms(0.5 * step, step);
            step *= 0.5;
            const double refined = sum * step;
            const bool converged = std::abs(refined - result) <= k_converged_scale_path * std::abs(refined);
            result = refined;
            if (converged) {
                break;
            }
        }
        return std::clamp(std::exp(at_saddle_) * result / std::numbers::pi, 0.0, 1.0);
    }

private:
    /// Root of the derivative of the exponent, which rises on the interval.
    [[nodiscard]] double saddle() const {
        constexpr int k_bisections = 100;
        double low = upper_ ? -0.5 : 0.0;
        double high = upper_ ? 0.0 : nu_ / (2.0 * x_);
        for (int i = 0; i < k_bisections; ++i) {
            const double s = 0.5 * (low + high);
            double slope = x_ / (1.0 - 2.0 * x_ * s / nu_) - 1.0 / s;
            for (const auto& [weight, count] : weights_) {
                slope -= count * weight / (1.0 + 2.0 * weight * s);
            }
            (slope > 0.0 ? high : low) = s;
        }
        return 0.5 * (low + high);
    }

    [[nodiscard]] std::complex<double> exponent(std::complex<double> s) const {
        std::complex<double> sum = 0.0;
        for (const auto& [weight, count] : weights_) {
            sum += count * std::log(1.0 + 2.0 * weight * s);
        }
        // ln(1 + z) with the digits of a small z, which ν multiplies.
        const std::complex<double> z = -2.0 * x_ / nu_ * s;
        const std::complex<double> logarithm(0.5 * std::log1p(2.0 * z.real() + std::norm(z)),
                                             std::atan2(z.imag(), 1.0 + z.real()));
        return -0.5 * (sum + nu_ * logarithm) - std::log(upper_ ? -s : s);
    }

    [[nodiscard]] std::complex<double> term(double t) const {
        const double y = width_ * std::sinh(t);
        const double root = std::hypot(a_, k_slope_of_scale_path * y);
        const std::complex<double> s(s_ - (root - a_), y);
        const std::complex<double> slope(1.0, k_slope_of_scale_path * k_slope_of_scale_path * y / root);
        return std::exp(exponent(s) - at_saddle_) * slope * (width_ * std::cosh(t));
    }

    [[nodiscard]] double terms(double first, double step) const {
        constexpr double k_last = 200.0;  // sinh of more leaves the range of numbers; never reached
        double sum = 0.0;
        for (double t = first; t < k_last; t += step) {
            const std::complex<double> next = term(t);
            sum += next.real();
            if (!(std::abs(next) > k_negligible_of_scale_path * width_)) {
                break;
            }
        }
        return sum;
    }

    double nu_ = 0.0;
    bool upper_ = false;
    std::vector<std::pair<double, double>> weights_;  ///< weight relative to the largest, and how often
    double x_ = 0.0, s_ = 0.0, width_ = 0.0, a_ = 0.0, at_saddle_ = 0.0;
};

double common_t_tail(std::span<const double> weights, double degrees_of_freedom, double x, bool upper) {
    require_degrees_of_freedom(degrees_of_freedom, "degrees of freedom of t");
    require_finite(x, "sum of squares of t");
    if (degrees_of_freedom > k_normal_from) {
        return upper ? weighted_chi_square_upper_tail(weights, x) : weighted_chi_square_lower_tail(weights, x);
    }
    if (!(x > 0.0)) {
        return upper ? 1.0 : 0.0;
    }
    return CommonScalePath(weights, degrees_of_freedom, x, upper).tail();
}

}  // namespace

double squared_t_lower_tail(std::span<const SquaredT> terms, double x) {
    return squared_t_tail(terms, x, false);
}

double squared_t_upper_tail(std::span<const SquaredT> terms, double x) {
    return squared_t_tail(terms, x, true);
}

double squared_t_quantile(std::span<const SquaredT> terms, double probability) {
    require_probability(probability, "probability");
    const TransformOfSquares transform(terms);
    return transform.largest() * quantile_from([&](double x) { return transform.tail(x, false); }, probability,
                                               static_cast<double>(terms.size()));
}

double common_t_lower_tail(std::span<const double> weights, double degrees_of_freedom, double x) {
    return common_t_tail(weights, degrees_of_freedom, x, false);
}

double common_t_upper_tail(std::span<const double> weights, double degrees_of_freedom, double x) {
    return common_t_tail(weights, degrees_of_freedom, x, true);
}

double common_t_quantile(std::span<const double> weights, double degrees_of_freedom, double probability) {
    require_probability(probability, "probability");
    require_degrees_of_freedom(degrees_of_freedom, "degrees of freedom of t");
    return quantile_from([&](double x) { return common_t_tail(weights, degrees_of_freedom, x, false); }, probability,
                         weighted_chi_square_quantile(weights, probability));
}

}  // namespace gumcert::gum
