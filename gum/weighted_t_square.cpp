#include "gum/weighted_t_square.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "gum/weighted_chi_square.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

// S = χ²_ν/ν with y = ln S has the density e^(ν/2 (y − e^y)) but for a constant.
constexpr double k_largest_step_of_scale = 0.16;   // of y; the transform has a singularity 1 from the real axis
constexpr double k_step_in_deviations = 0.7;       // of its standard deviation √(2/ν), about
constexpr double k_negligible_log_density = 36.0;  // e^-36 is 2e-16
constexpr double k_normal_from = 1e8;              // ν from which T differs from Z by less than what is promised

constexpr double k_width_of_cell = 1.0;  // of ln λ
constexpr std::size_t k_nodes_of_cell = 24;

constexpr double k_slope_of_scale_path = 0.6;  // of the asymptotes
constexpr double k_least_bend_of_scale_path = 0.2;
constexpr int k_most_halvings_of_scale_path = 12;
constexpr double k_converged_scale_path = 1e-10;  // relative change by halving the step, which nearly squares the error
constexpr double k_converged_beside = 1e-9;       // of a tail, for an x beside that of the path
constexpr double k_negligible_of_scale_path = 1e-17;
constexpr double k_last_of_scale_path = 200.0;  // sinh of more leaves the range of numbers; never reached
constexpr double k_reach_of_scale_path = 3.0;   // in standard deviations: how far x may lie from that of a path

constexpr std::uintmax_t k_most_steps_of_t_quantile = 200;
constexpr double k_tolerance_of_quantile = 1e-10;  // of ln x
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

[[noreturn]] void refuse_unconverged(double x, std::size_t weights) {
    throw NoResultError(Diagnostic{.code = "GC-GUM-0140",
                                   .where = "sum of squares of t",
                                   .what = "the integral at " + text::shortest(x) + " times the largest of " +
                                           std::to_string(weights) + " weights has not converged",
                                   .rule = "two steps of integration agree within 1e-10",
                                   .action = "Report the weights; this is not expected to happen."});
}

/// A weight, and how often.
struct CountedWeight {
    double weight = 0.0, count = 0.0;
};

/// The weights of one cell of ln λ as few with other counts: Σ f(ln λ_k) = Σ W_j f(c_j) for the polynomial through
/// Chebyshev's points c_j. The logarithms of the transforms are analytic in ln λ for |Im| < π − |arg s|, which is 1 and
/// more on the path, so that 24 points leave 5e-16 of the function.
std::vector<CountedWeight> on_nodes(std::span<const CountedWeight> cell) {
    if (cell.size() <= k_nodes_of_cell) {
        return {cell.begin(), cell.end()};
    }
    const double low = std::log(cell.front().weight);
    const double high = std::log(cell.back().weight);
    std::vector<double> nodes;
    std::vector<CountedWeight> result;
    for (std::size_t j = 0; j < k_nodes_of_cell; ++j) {
        const double angle = (static_cast<double>(j) + 0.5) * std::numbers::pi / static_cast<double>(k_nodes_of_cell);
        nodes.push_back(std::cos(angle));
        result.push_back({std::exp(0.5 * (low + high) + 0.5 * (high - low) * nodes.back()), 0.0});
    }
    std::vector<double> factors(k_nodes_of_cell);
    for (const CountedWeight& term : cell) {
        const double at = high > low ? (2.0 * std::log(term.weight) - low - high) / (high - low) : 0.0;
        // Lagrange's polynomials in barycentric form.
        double sum = 0.0;
        std::size_t hit = k_nodes_of_cell;
        for (std::size_t j = 0; j < k_nodes_of_cell; ++j) {
            const double angle =
                (static_cast<double>(j) + 0.5) * std::numbers::pi / static_cast<double>(k_nodes_of_cell);
            if (at == nodes[j]) {
                hit = j;
                break;
            }
            factors[j] = (j % 2 == 0 ? 1.0 : -1.0) * std::sin(angle) / (at - nodes[j]);
            sum += factors[j];
        }
        for (std::size_t j = 0; j < k_nodes_of_cell; ++j) {
            const double share = hit == k_nodes_of_cell ? factors[j] / sum : (j == hit ? 1.0 : 0.0);
            result[j].count += term.count * share;
        }
    }
    return result;
}

/// \param terms  in the order of their weights
std::vector<CountedWeight> on_few_weights(const std::vector<CountedWeight>& terms) {
    std::vector<CountedWeight> result;
    for (std::size_t begin = 0; begin < terms.size();) {
        std::size_t end = begin;
        while (end < terms.size() && terms[end].weight <= terms[begin].weight * std::exp(k_width_of_cell)) {
            ++end;
        }
        const std::vector<CountedWeight> cell = on_nodes(std::span(terms).subspan(begin, end - begin));
        result.insert(result.end(), cell.begin(), cell.end());
        begin = end;
    }
    return result;
}

/// ln E[e^(−s Q)] for Q = Σ λ T² relative to the largest weight, equal terms together.
class TransformOfSquares {
public:
    explicit TransformOfSquares(std::span<const SquaredT> terms) {
        std::map<std::pair<double, double>, double> groups;
        for (const SquaredT& term : terms) {
            require_not_negative(term.weight, "weight of a sum of squares of t");
            require_degrees_of_freedom(term.degrees_of_freedom, "degrees of freedom of t");
            largest_ = std::max(largest_, term.weight);
            if (term.weight > 0.0) {
                groups[{term.degrees_of_freedom, term.weight}] += 1.0;
                ++count_;
            }
        }
        require_positive(largest_, "largest weight of a sum of squares of t");
        double nu = 0.0;
        for (const auto& [term, count] : groups) {
            if (groups_.empty() || nu != term.first) {
                nu = term.first;
                groups_.push_back({nodes_of_scale(nu), {}});
            }
            groups_.back().terms.push_back({term.second / largest_, count});
            // The median of T² lies within a factor of 2 of 0.7, its mean at ν/(ν − 2) where there is one.
            constexpr double k_has_mean = 3.0;
            centre_ += count * term.second / largest_ * (nu > k_has_mean ? 1.0 / (1.0 - 2.0 / nu) : k_has_mean);
        }
        for (Group& group : groups_) {
            group.terms = on_few_weights(group.terms);
        }
    }

    [[nodiscard]] double largest() const { return largest_; }
    [[nodiscard]] std::size_t count() const { return count_; }
    /// About the mean.
    [[nodiscard]] double centre() const { return centre_; }

    [[nodiscard]] std::complex<double> logarithm(std::complex<double> s) const {
        double modulus = 0.0;
        double argument = 0.0;
        for (const Group& group : groups_) {
            for (const CountedWeight& term : group.terms) {
                // Every (1 + 2 λ s/S)^(−1/2) lies in one half of the half-plane Re > 0, and so does their sum: its
                // logarithm is the principal one.
                double real = 0.0;
                double imaginary = 0.0;
                for (const ScaleNode& node : group.nodes) {
                    const double a = 1.0 + 2.0 * term.weight * s.real() / node.scale;
                    const double b = 2.0 * term.weight * s.imag() / node.scale;
                    // 1/√(a + ib) = √(a − ib)/r
                    const double r = std::sqrt(a * a + b * b);
                    const double larger = std::sqrt(0.5 * (std::abs(a) + r));
                    const double smaller = 0.5 * std::abs(b) / larger;
                    const double factor = node.probability / r;
                    real += factor * (a >= 0.0 ? larger : smaller);
                    imaginary -= factor * std::copysign(a >= 0.0 ? smaller : larger, b);
                }
                modulus += 0.5 * term.count * std::log(real * real + imaginary * imaginary);
                argument += term.count * std::atan2(imaginary, real);
            }
        }
        return {modulus, argument};
    }

    /// First three derivatives of the logarithm by s at a real s ≥ 0.
    struct Derivatives {
        double first = 0.0, second = 0.0, third = 0.0;
    };
    [[nodiscard]] Derivatives derivatives(double s) const {
        Derivatives sum;
        for (const Group& group : groups_) {
            for (const CountedWeight& term : group.terms) {
                double g = 0.0;
                double g1 = 0.0;
                double g2 = 0.0;
                double g3 = 0.0;
                for (const ScaleNode& node : group.nodes) {
                    const double rate = term.weight / node.scale;
                    const double h2 = 1.0 / (1.0 + 2.0 * rate * s);
                    const double slope = rate * h2;
                    const double h = node.probability * std::sqrt(h2);
                    g += h;
                    g1 -= h * slope;
                    g2 += 3.0 * h * slope * slope;
                    g3 -= 15.0 * h * slope * slope * slope;
                }
                const double first = g1 / g;
                const double second = g2 / g - first * first;
                sum.first += term.count * first;
                sum.second += term.count * second;
                sum.third += term.count * (g3 / g - 3.0 * first * second - first * first * first);
            }
        }
        return sum;
    }

private:
    struct Group {
        std::vector<ScaleNode> nodes;
        std::vector<CountedWeight> terms;
    };
    std::vector<Group> groups_;
    double largest_ = 0.0, centre_ = 0.0;
    std::size_t count_ = 0;
};

/// P(Q ≤ x) for x about the x of the path: 1/(2πi) ∫ e^(sx) E[e^(−sQ)] ds/s along a hyperbola through the saddle point,
/// as gum/weighted_chi_square.cpp does it for normal scores. The distribution of many terms has the relative width
/// √(2/n): only a path whose steps follow the width of the saddle resolves it. The tail of t falls like a power, so
/// that the transform has its cut up to 0 and there is no saddle point below 0: the upper tail is 1 less the lower one.
class SquaredTPath {
public:
    /// \param x  > 0, relative to the largest weight
    SquaredTPath(const TransformOfSquares& transform, double x) : transform_(&transform), x_(x) {
        s_ = saddle();
        const TransformOfSquares::Derivatives at = transform.derivatives(s_);
        const double second = at.second + 1.0 / (s_ * s_);
        const double third = at.third - 2.0 / (s_ * s_ * s_);
        width_ = 1.0 / std::sqrt(second);
        // Without the pole at 0: the standard deviation of Q, tilted by e^(−s Q).
        deviation_ = std::sqrt(std::max(at.second, 0.0));
        a_ = k_slope_of_scale_path * k_slope_of_scale_path /
             std::max(-third / (3.0 * second), k_least_bend_of_scale_path / width_);
        at_saddle_ = transform.logarithm({s_, 0.0}).real() - std::log(s_);
        integrate();
    }

    /// P(Q ≤ x), or nothing where this path does not give it.
    [[nodiscard]] std::optional<double> lower_tail(double x) const {
        if (!(std::abs(x - x_) <= k_reach_of_scale_path * deviation_) && x != x_) {
            return std::nullopt;
        }
        double all = 0.0;
        double every_second = 0.0;
        for (const Node& node : nodes_) {
            const double value = (std::exp(node.exponent + node.s * (x - x_)) * node.slope).real();
            all += value;
            every_second += node.is_coarse ? 2.0 * value : 0.0;
        }
        const double scale = std::exp(at_saddle_ + s_ * x_) * step_ / std::numbers::pi;
        // A tail near 0 or 1 counts by its absolute error.
        if (!(scale * std::abs(all - every_second) <= k_converged_beside)) {
            return std::nullopt;
        }
        return std::clamp(scale * all, 0.0, 1.0);
    }

private:
    struct Node {
        std::complex<double> s, slope;
        std::complex<double> exponent;  ///< at x_, less that at the saddle point
        bool is_coarse = true;          ///< of the step before the last one
    };

    /// Root of x + (ln φ)′ − 1/s, which rises, between 1/x and (1 + n/2)/x.
    [[nodiscard]] double saddle() const {
        constexpr int k_bisections = 24;  // any point near the saddle will do
        double low = 1.0 / x_;
        double high = (1.0 + 0.5 * static_cast<double>(transform_->count())) / x_;
        for (int i = 0; i < k_bisections; ++i) {
            const double s = std::sqrt(low) * std::sqrt(high);
            (x_ + transform_->derivatives(s).first - 1.0 / s > 0.0 ? high : low) = s;
        }
        return std::sqrt(low) * std::sqrt(high);
    }

    [[nodiscard]] Node node(double t) const {
        const double y = width_ * std::sinh(t);
        const double root = std::hypot(a_, k_slope_of_scale_path * y);
        const double left = k_slope_of_scale_path * k_slope_of_scale_path * y * y / (root + a_);  // root − a
        Node result;
        result.s = {s_ - left, y};
        const std::complex<double> pole(0.5 * std::log(std::norm(result.s)),
                                        std::atan2(result.s.imag(), result.s.real()));
        result.exponent =
            transform_->logarithm(result.s) - pole - at_saddle_ + std::complex<double>(-left * x_, y * x_);
        result.slope = std::complex<double>(1.0, k_slope_of_scale_path * k_slope_of_scale_path * y / root) *
                       (width_ * std::cosh(t));
        return result;
    }

    /// Adds the nodes at first, first + step, … until they are negligible, and returns their sum.
    double add_nodes(double first, double step) {
        double sum = 0.0;
        for (double t = first; t < k_last_of_scale_path; t += step) {
            Node next = node(t);
            if (t == 0.0) {
                next.slope *= 0.5;
            }
            nodes_.push_back(next);
            const std::complex<double> value = std::exp(next.exponent) * next.slope;
            sum += value.real();
            if (!(std::abs(value) > k_negligible_of_scale_path * width_)) {
                break;
            }
        }
        return sum;
    }

    void integrate() {
        step_ = 0.5;
        double sum = add_nodes(0.0, step_);
        for (int halving = 0; halving < k_most_halvings_of_scale_path; ++halving) {
            for (Node& old : nodes_) {
                old.is_coarse = true;
            }
            const std::size_t before = nodes_.size();
            const double refined = sum + add_nodes(0.5 * step_, step_);
            for (std::size_t i = before; i < nodes_.size(); ++i) {
                nodes_[i].is_coarse = false;
            }
            step_ *= 0.5;
            if (std::abs(refined - 2.0 * sum) <= k_converged_scale_path * std::abs(refined)) {
                return;
            }
            sum = refined;
        }
        refuse_unconverged(x_, transform_->count());
    }

    const TransformOfSquares* transform_;
    double x_ = 0.0, s_ = 0.0, width_ = 0.0, deviation_ = 0.0, a_ = 0.0, at_saddle_ = 0.0, step_ = 0.0;
    std::vector<Node> nodes_;
};

/// P(Q ≤ x) at several x that lie close together, from as few paths as do.
class SquaredTTails {
public:
    explicit SquaredTTails(const TransformOfSquares& transform) : transform_(transform) {}

    /// \param x  relative to the largest weight
    [[nodiscard]] double lower(double x) {
        if (!(x > 0.0)) {
            return 0.0;
        }
        if (path_) {
            if (const std::optional<double> tail = path_->lower_tail(x)) {
                return *tail;
            }
        }
        path_.emplace(transform_, x);
        const std::optional<double> tail = path_->lower_tail(x);
        if (!tail) {
            refuse_unconverged(x, transform_.count());
        }
        return *tail;
    }

private:
    const TransformOfSquares& transform_;
    std::optional<SquaredTPath> path_;
};

/// The x at which a distribution that rises from 0 to 1 is `probability`, searched from `start` in its logarithm.
/// \param reach  first step of ln x: about the relative width of the distribution
double quantile_from(const std::function<double(double)>& lower_tail, double probability, double start, double reach) {
    const auto excess = [&](double logarithm) { return lower_tail(std::exp(logarithm)) - probability; };
    double low = std::log(start);
    double high = low;
    double at_low = excess(low);
    double at_high = at_low;
    for (double step = reach; at_low > 0.0 && low > -k_range_of_logarithm; step *= 2.0) {
        high = low;
        at_high = at_low;
        low -= step;
        at_low = excess(low);
    }
    for (double step = reach; at_high < 0.0 && high < k_range_of_logarithm; step *= 2.0) {
        low = high;
        at_low = at_high;
        high += step;
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

/// Relative width of χ² of so many terms, with which the search of a quantile begins.
double reach_of_quantile(double terms) {
    constexpr double k_largest_reach = 1.4;
    return std::min(k_largest_reach, 2.0 * std::sqrt(2.0 / terms));
}

double squared_t_tail(std::span<const SquaredT> terms, double x, bool upper) {
    require_finite(x, "sum of squares of t");
    const TransformOfSquares transform(terms);
    if (!(x > 0.0)) {
        return upper ? 1.0 : 0.0;
    }
    // Both tails from one integral, so that they add up to 1.
    const double lower = SquaredTTails(transform).lower(x / transform.largest());
    return std::clamp(upper ? 1.0 - lower : lower, k_least_tail_of_t, 1.0);
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
        double second = 0.0;
        double third = 0.0;
        for (const auto& [weight, count] : weights_) {
            const double slope = weight / (1.0 + 2.0 * weight * s_);
            second += 2.0 * count * slope * slope;
            third -= 8.0 * count * slope * slope * slope;
        }
        const double slope = x_ / (1.0 - 2.0 * x_ * s_ / nu_);
        second += 2.0 * slope * slope / nu_;
        third += 8.0 * slope * slope * slope / (nu_ * nu_);
        width_ = 1.0 / std::sqrt(second + 1.0 / (s_ * s_));
        // Steepest descent leads round the cut of Q on the left, or round that of S on the right where few degrees of
        // freedom make the longer tail: on the wrong side the integrand would grow by many powers of ten. The pole at 0
        // has no say in it.
        side_ = third > 0.0 ? 1.0 : -1.0;
        a_ = k_slope_of_scale_path * k_slope_of_scale_path /
             std::max(std::abs(third) / (3.0 * second), k_least_bend_of_scale_path / width_);
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
            if (std::abs(refined - result) <= k_converged_scale_path * std::abs(refined)) {
                return std::clamp(std::exp(at_saddle_) * refined / std::numbers::pi, 0.0, 1.0);
            }
            result = refined;
        }
        refuse_unconverged(x_, weights_.size());
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
        const std::complex<double> s(s_ + side_ * (root - a_), y);
        const std::complex<double> slope(1.0, -side_ * k_slope_of_scale_path * k_slope_of_scale_path * y / root);
        return std::exp(exponent(s) - at_saddle_) * slope * (width_ * std::cosh(t));
    }

    [[nodiscard]] double terms(double first, double step) const {
        double sum = 0.0;
        for (double t = first; t < k_last_of_scale_path; t += step) {
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
    double x_ = 0.0, s_ = 0.0, width_ = 0.0, side_ = 0.0, a_ = 0.0, at_saddle_ = 0.0;
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
    // The smaller of the two tails is integrated: the saddle point lies away from the pole at 0 then.
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0);
    const bool upper_is_smaller = x > mean;
    const double tail = CommonScalePath(weights, degrees_of_freedom, x, upper_is_smaller).tail();
    return upper == upper_is_smaller ? tail : 1.0 - tail;
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
    SquaredTTails tails(transform);
    return transform.largest() * quantile_from([&](double x) { return tails.lower(x); }, probability,
                                               transform.centre(),
                                               reach_of_quantile(static_cast<double>(transform.count())));
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
                         weighted_chi_square_quantile(weights, probability),
                         reach_of_quantile(std::min(static_cast<double>(weights.size()), degrees_of_freedom)));
}

}  // namespace gumcert::gum
