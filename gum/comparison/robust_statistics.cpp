#include "gum/comparison/robust_statistics.h"

#include <algorithm>
#include <bit>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "gum/argument_check.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

// 64 bits of mantissa and a wide range of exponents on x86-64: no square of a result overflows.
using Real = long double;

constexpr double k_made_factor = 1.483;                                       // ISO 13528:2022, annex C
constexpr double k_iqr_factor = 0.7413;                                       // ISO 13528:2022, annex C
constexpr double k_algorithm_a_factor = 1.134;                                // ISO 13528:2022, annex C
constexpr double k_algorithm_a_limit = 1.5;                                   // in units of s*
constexpr double k_third_normal_quartile = 0.674489750196081743202227014541;  // Φ⁻¹(0.75)
constexpr double k_stand_still = 1e-16;  // of the scale; steps may be a hundred times shorter than what is left to go
constexpr int k_most_steps = 10'000;
constexpr double k_vanished = 1e-12;  // of the scale that algorithm A began with

[[noreturn]] void refuse_scale(const std::string& method, const std::string& what, const std::string& other = "") {
    refuse("GC-GUM-0102", method, what, "a robust standard deviation greater than 0 is needed",
           "Take a value and a limit that need no such scale (sigma_pt or delta_E), " + other +
               "or give the results with more digits.");
}

[[noreturn]] void refuse_equal(const std::string& method, std::size_t results) {
    refuse_scale(method, "all " + text::count_of(results, "result") + " are equal: the scale is 0");
}

/// Whether the Q method with Hampel's estimator is an advice: it gives a value of these results.
bool has_q_hampel(std::span<const double> results) {
    try {
        (void)supported_q_hampel(results);
        return true;
    } catch (const DiagnosedError&) {
        return false;
    }
}

[[noreturn]] void refuse_no_scale_of_algorithm_a(std::span<const double> results) {
    refuse_scale("algorithm A",
                 "more than half of " + std::to_string(results.size()) +
                     " results are equal, and the others too few or too far away to make a scale",
                 has_q_hampel(results) ? "use the Q method with Hampel's estimator, " : "");
}

/// In ascending order, so that no sum depends on the order of the results.
std::vector<double> sorted(std::span<const double> results, std::size_t least) {
    if (results.size() < least) {
        const bool none = least == 1;
        refuse(none ? "GC-GUM-0100" : "GC-GUM-0101", "results", std::to_string(results.size()),
               none ? "at least 1 result is needed" : "a robust standard deviation needs at least 2 results",
               none ? "Give the results." : "Give more results, or state the uncertainty another way.");
    }
    for (std::size_t i = 0; i < results.size(); ++i) {
        require_finite(results[i], "result " + std::to_string(i + 1));
    }
    std::vector<double> ascending(results.begin(), results.end());
    std::sort(ascending.begin(), ascending.end());
    return ascending;
}

Real median_of_sorted(const std::vector<double>& ascending) {
    const std::size_t n = ascending.size();
    return (static_cast<Real>(ascending[(n - 1) / 2]) + static_cast<Real>(ascending[n / 2])) / 2;
}

/// (x − median)/unit, ascending: a large common value is taken off, and nothing below depends on it.
std::vector<Real> centred(const std::vector<double>& ascending, Real centre, Real unit = 1.0L) {
    std::vector<Real> differences;
    differences.reserve(ascending.size());
    for (const double value : ascending) {
        differences.push_back((static_cast<Real>(value) - centre) / unit);
    }
    return differences;
}

Real standard_deviation(const std::vector<Real>& differences) {
    const auto n = static_cast<Real>(differences.size());
    Real sum = 0.0L;
    for (const Real value : differences) {
        sum += value;
    }
    Real squares = 0.0L;
    for (const Real value : differences) {
        squares += (value - sum / n) * (value - sum / n);
    }
    return std::sqrt(squares / (n - 1));
}

Real median_of_absolute(const std::vector<Real>& differences) {
    std::vector<Real> absolute;
    absolute.reserve(differences.size());
    for (const Real value : differences) {
        absolute.push_back(std::abs(value));
    }
    const auto middle = absolute.begin() + static_cast<std::ptrdiff_t>(absolute.size() / 2);
    std::nth_element(absolute.begin(), middle, absolute.end());
    return absolute.size() % 2 == 1 ? *middle : (*std::max_element(absolute.begin(), middle) + *middle) / 2;
}

RobustEstimate estimate(Real location, Real scale, std::size_t results) {
    const RobustEstimate found{
        .location = static_cast<double>(location),
        .scale = static_cast<double>(scale),
        .u = static_cast<double>(k_robust_location_factor * scale / std::sqrt(static_cast<Real>(results))),
        .rest = static_cast<double>(location - static_cast<Real>(static_cast<double>(location)))};
    require_finite(found.location, "robust mean");
    require_finite(found.scale, "robust standard deviation");
    return found;
}

/// Quantile by linear interpolation between order statistics, type 7 of Hyndman and Fan.
Real quantile_of_sorted(const std::vector<double>& ascending, Real probability) {
    const Real position = probability * static_cast<Real>(ascending.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, ascending.size() - 1);
    const Real share = position - static_cast<Real>(below);
    return (1.0L - share) * static_cast<Real>(ascending[below]) + share * static_cast<Real>(ascending[above]);
}

/// 1/√E[min(|Z|, c)²] of the standard normal distribution: with it, results drawn in to ± c keep the standard
/// deviation of a normal distribution.
Real exact_algorithm_a_factor() {
    // E[min(|Z|, c)²] = 1 − P(|Z| > c) − 2 c φ(c) + c² P(|Z| > c), by parts.
    const Real c = k_algorithm_a_limit;
    const Real density = std::exp(-c * c / 2) / std::sqrt(2 * std::numbers::pi_v<Real>);
    const Real outside = std::erfc(c / std::numbers::sqrt2_v<Real>);
    return 1.0L / std::sqrt(1.0L - outside - 2 * c * density + c * c * outside);
}

/// Sums over ranges of sorted numbers, each from its own members only, so that no outlier spoils the digits of others.
class RangeSums {
public:
    // A tree of partial sums, and not one running sum from which two places are subtracted: an outlier of 1e20 in it
    // would leave no digit of any sum behind it.
    explicit RangeSums(const std::vector<Real>& values) : size_(values.size()), tree_(2 * values.size()) {
        std::copy(values.begin(), values.end(), tree_.begin() + static_cast<std::ptrdiff_t>(size_));
        for (std::size_t node = size_; node-- > 1;) {
            tree_[node] = tree_[2 * node] + tree_[2 * node + 1];
        }
    }
    [[nodiscard]] Real sum(std::size_t first, std::size_t end) const {
        Real total = 0.0L;
        for (first += size_, end += size_; first < end; first /= 2, end /= 2) {
            if (first % 2 == 1) {
                total += tree_[first++];
            }
            if (end % 2 == 1) {
                total += tree_[--end];
            }
        }
        return total;
    }

private:
    std::size_t size_;
    std::vector<Real> tree_;
};

/// Sorted values drawn in to centre ± limit: their mean and standard deviation, in a time that hardly depends on their
/// number.
class DrawnIn {
public:
    explicit DrawnIn(const std::vector<Real>& ascending)
        : values_(ascending), sums_(ascending), squares_(squared(ascending)) {}

    [[nodiscard]] std::pair<Real, Real> mean_and_deviation(Real centre, Real limit) const {
        const Real low = centre - limit, high = centre + limit;
        const auto first = std::lower_bound(values_.begin(), values_.end(), low) - values_.begin();
        const auto end = std::upper_bound(values_.begin(), values_.end(), high) - values_.begin();
        const auto from = static_cast<std::size_t>(first), to = static_cast<std::size_t>(end);
        const auto below = static_cast<Real>(from), above = static_cast<Real>(values_.size() - to);
        const auto inside = static_cast<Real>(to - from), count = static_cast<Real>(values_.size());
        const Real sum = sums_.sum(from, to);
        const Real mean = (sum + below * low + above * high) / count;
        // The values are centred on their median, and mean and limits are no farther from it than a few limits.
        const Real squares = squares_.sum(from, to) - 2 * mean * sum + inside * mean * mean +
                             below * (low - mean) * (low - mean) + above * (high - mean) * (high - mean);
        return {mean, std::sqrt(std::max(squares, 0.0L) / (count - 1))};
    }

private:
    static std::vector<Real> squared(const std::vector<Real>& values) {
        std::vector<Real> squares;
        squares.reserve(values.size());
        for (const Real value : values) {
            squares.push_back(value * value);
        }
        return squares;
    }

    const std::vector<Real>& values_;
    RangeSums sums_, squares_;
};

// ---- Q method -------------------------------------------------------------------------------------------------------

/// The differences x_j − x_i ≥ 0 of all pairs, counted and searched without being formed: in ascending results the
/// differences of one result to the others ascend too, and the places where they pass a bound move on monotonically.
class PairwiseDifferences {
public:
    explicit PairwiseDifferences(const std::vector<double>& ascending) : x_(ascending) {
        std::vector<double> sizes(x_.size());
        std::transform(x_.begin(), x_.end(), sizes.begin(), [](double x) { return std::abs(x); });
        std::sort(sizes.begin(), sizes.end());
        // Half a unit in the last place of each of four numbers, and a little. No outlier may stretch it.
        const double size = std::min(sizes.back(), 100.0 * sizes[sizes.size() / 2]);
        same_ = 2.5 * (size - std::nextafter(size, 0.0));
    }

    [[nodiscard]] std::uint64_t pairs() const { return static_cast<std::uint64_t>(x_.size()) * (x_.size() - 1) / 2; }
    [[nodiscard]] double largest() const { return x_.back() - x_.front(); }
    [[nodiscard]] bool is_zero(double difference) const { return difference <= same_; }

    /// Pairs up to the value, with all that are the same as it but for rounding.
    [[nodiscard]] std::uint64_t up_to(double value) const {
        const double bound = value + same_;
        return count([bound](double difference) { return difference <= bound; });
    }
    /// Pairs below the value and not the same as it.
    [[nodiscard]] std::uint64_t below(double value) const {
        const double bound = value - same_;
        return count([bound](double difference) { return difference < bound; });
    }
    /// Smallest difference that is not below the bound.
    [[nodiscard]] double smallest_from(double bound) const {
        double smallest = std::numeric_limits<double>::infinity();
        for_each_boundary([bound](double difference) { return difference < bound; },
                          [&](std::size_t i, std::size_t end) {
                              if (end < x_.size()) {
                                  smallest = std::min(smallest, x_[end] - x_[i]);
                              }
                          });
        return smallest;
    }
    /// Largest difference that is below the value and not the same as it.
    [[nodiscard]] std::optional<double> largest_below(double value) const {
        const double bound = value - same_;
        std::optional<double> largest;
        for_each_boundary([bound](double difference) { return difference < bound; },
                          [&](std::size_t i, std::size_t end) {
                              if (end > i + 1) {
                                  largest = std::max(largest.value_or(0.0), x_[end - 1] - x_[i]);
                              }
                          });
        return largest;
    }

private:
    /// For each i the first j > i for which x_j − x_i is outside.
    template <class Inside, class Visit>
    void for_each_boundary(Inside inside, Visit visit) const {
        std::size_t end = 0;
        for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
            end = std::max(end, i + 1);
            while (end < x_.size() && inside(x_[end] - x_[i])) {
                ++end;
            }
            visit(i, end);
        }
    }
    template <class Inside>
    [[nodiscard]] std::uint64_t count(Inside inside) const {
        std::uint64_t pairs = 0;
        for_each_boundary(inside, [&](std::size_t i, std::size_t end) { pairs += end - i - 1; });
        return pairs;
    }

    const std::vector<double>& x_;
    double same_ = 0.0;
};

/// Smallest number from 0 to `largest` for which a condition holds that holds for `largest` and, once it holds, for
/// all that follow. Numbers that are not negative have the order of their bits: at most 64 steps, and exact.
template <class Condition>
double smallest_number(double largest, Condition holds) {
    // Bisection of the numbers themselves, not of the interval: no tolerance is needed, and the answer is exact for
    // results of any magnitude.
    auto low = std::uint64_t{0};
    auto high = std::bit_cast<std::uint64_t>(largest);
    while (low < high) {
        const std::uint64_t middle = low + (high - low) / 2;
        if (holds(std::bit_cast<double>(middle))) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return std::bit_cast<double>(high);
}

/// Robust standard deviation from pairwise differences.                                (ISO 13528:2022, annex C)
///
/// H(d) is the share of pairs that differ by no more than d. G runs through the middle of each step of H, 0 at 0, and
/// linearly between them; s* = G⁻¹(0.25 + 0.75 H(0)) / (√2 Φ⁻¹(0.625 + 0.375 H(0))).
double q_scale(const std::vector<double>& ascending) {
    const PairwiseDifferences differences(ascending);
    const auto pairs = static_cast<double>(differences.pairs());
    const auto equal_pairs = static_cast<double>(differences.up_to(0.0));
    if (equal_pairs == pairs) {
        refuse_equal("Q method", ascending.size());
    }
    // Twice the number of pairs, so that all counts are whole or half: 2 pairs G.
    const double wanted = 0.5 * pairs + 1.5 * equal_pairs;
    const auto steps = [&](double difference) {
        return static_cast<double>(differences.up_to(difference)) + static_cast<double>(differences.below(difference));
    };
    const double reached =
        smallest_number(differences.largest(), [&](double difference) { return steps(difference) >= wanted; });
    // The number that was reached need not be a difference: the next one from it on is, and the one before it is the
    // other end of the linear piece of G.
    const double above = differences.smallest_from(reached);
    const double steps_above = steps(above);
    double below = differences.largest_below(above).value_or(0.0);
    double steps_below = 0.0;
    if (differences.is_zero(below)) {
        below = 0.0;
    } else {
        steps_below = steps(below);
    }
    const double quantile = below + (wanted - steps_below) / (steps_above - steps_below) * (above - below);
    const double share_of_equal = equal_pairs / pairs;
    // Differences of two normal results have √2 times their standard deviation. Pairs that are equal, because of
    // rounding, carry no scale: the quantile is moved by their share.
    return quantile / (std::numbers::sqrt2 * standard_normal_quantile(0.625 + 0.375 * share_of_equal));
}

// ---- Hampel's estimator ---------------------------------------------------------------------------------------------

/// Σ ψ(q_i − x) as a function of x, for q in units of the scale. ψ(q) = q up to 1.5, 1.5 up to 3, 4.5 − q up to 4.5,
/// then 0; odd.                                                                        (ISO 13528:2022, annex C)
class HampelSum {
public:
    explicit HampelSum(const std::vector<Real>& ascending) : q_(ascending), sums_(ascending) {}

    [[nodiscard]] Real operator()(Real x) const {
        // The corners of ψ divide the sorted results into ranges in each of which ψ is linear: five terms give the
        // whole, whatever the number of results.
        const std::size_t a = place(x - 4.5L), b = place(x - 3.0L), c = place(x - 1.5L);
        const std::size_t d = place(x + 1.5L), e = place(x + 3.0L), f = place(x + 4.5L);
        const Real total = count(a, b) * (x - 4.5L) - sums_.sum(a, b) - 1.5L * count(b, c) + sums_.sum(c, d) -
                           count(c, d) * x + 1.5L * count(d, e) + count(e, f) * (x + 4.5L) - sums_.sum(e, f);
        // What is left of terms that cancel is 0, so that a root at a corner is found as such.
        return std::abs(total) <= 1e-15L * static_cast<Real>(q_.size()) ? 0.0L : total;
    }

    /// Where the slope may change, ascending, from the smallest to the largest q: outside of them is no location.
    [[nodiscard]] std::vector<Real> corners() const {
        std::vector<Real> all{q_.front(), q_.back()};
        all.reserve(6 * q_.size() + 2);
        for (const Real q : q_) {
            for (const Real corner : {-4.5L, -3.0L, -1.5L, 1.5L, 3.0L, 4.5L}) {
                if (q + corner > q_.front() && q + corner < q_.back()) {
                    all.push_back(q + corner);
                }
            }
        }
        std::sort(all.begin(), all.end());
        return all;
    }

private:
    [[nodiscard]] std::size_t place(Real bound) const {
        return static_cast<std::size_t>(std::lower_bound(q_.begin(), q_.end(), bound) - q_.begin());
    }
    static Real count(std::size_t first, std::size_t end) { return static_cast<Real>(end - first); }

    const std::vector<Real>& q_;
    RangeSums sums_;
};

/// First root on the way from 0 along corners that lead away from it.
template <class Corner>
std::optional<Real> first_root(const HampelSum& sum, Corner corner, Corner end) {
    Real x = 0.0L;
    Real value = sum(x);
    for (; corner != end; ++corner) {
        const Real next = *corner;
        const Real next_value = sum(next);
        if (next_value == 0.0L) {
            return next;
        }
        if ((next_value > 0.0L) != (value > 0.0L)) {
            return x + (next - x) * (value / (value - next_value));
        }
        x = next;
        value = next_value;
    }
    return std::nullopt;
}

/// Root of Σ ψ(q_i − x) nearest to 0, exactly: the sum is linear between its corners.
Real hampel_location(const std::vector<Real>& q) {
    const HampelSum sum(q);
    if (sum(0.0L) == 0.0L) {
        return 0.0L;
    }
    const std::vector<Real> corners = sum.corners();
    const auto upper = std::upper_bound(corners.begin(), corners.end(), 0.0L);
    const auto lower = std::lower_bound(corners.begin(), corners.end(), 0.0L);
    // ψ falls again beyond 3, so that the sum may have several roots. The one nearest to the median is the location; a
    // search that begins elsewhere could end at a group of outliers.
    const std::optional<Real> right = first_root(sum, upper, corners.end());
    const std::optional<Real> left =
        first_root(sum, std::make_reverse_iterator(lower), std::make_reverse_iterator(corners.begin()));
    if (right && left) {
        // Two roots equally far away, as symmetric results have them: neither is better, and the median lies in their
        // middle.
        const Real gap = *right + *left;  // of the two distances
        return std::abs(gap) <= 1e-12L ? 0.0L : (gap < 0.0L ? *right : *left);
    }
    // The sum is not negative at the smallest q and not positive at the largest: one of the two exists.
    return right ? *right : left.value_or(0.0L);
}

// ---- kernel density -------------------------------------------------------------------------------------------------

/// Σ exp(−(x − q_i)²/2) and its slope, for q in bandwidths.
class KernelDensity {
public:
    explicit KernelDensity(const std::vector<Real>& ascending) : q_(ascending) {}

    [[nodiscard]] Real height(Real x) const {
        Real total = 0.0L;
        visit(x, [&](double kernel, Real) { total += kernel; });
        return total;
    }
    [[nodiscard]] Real slope(Real x) const {
        Real total = 0.0L;
        visit(x, [&](double kernel, Real distance) { total += kernel * distance; });
        return total;
    }

private:
    template <class Visit>
    void visit(Real x, Visit add) const {
        constexpr Real reach = 9.5L;  // exp(−reach²/2) < 1e-19
        auto one = std::lower_bound(q_.begin(), q_.end(), x - reach);
        for (; one != q_.end() && *one <= x + reach; ++one) {
            const Real distance = *one - x;
            add(std::exp(static_cast<double>(-distance * distance / 2)), distance);
        }
    }

    const std::vector<Real>& q_;
};

struct DensityPoint {
    Real place = 0.0L, height = 0.0L;
};

constexpr Real k_density_step = 0.125L;  // in bandwidths

/// A sum of kernels is convex where no kernel is nearer than one bandwidth: no mode lies there. The rest is sampled in
/// steps that miss the height of a mode by less than 1 %.
std::vector<DensityPoint> density_samples(const KernelDensity& density, const std::vector<Real>& centres) {
    std::vector<DensityPoint> samples;
    Real next = -std::numeric_limits<Real>::infinity();
    for (const Real centre : centres) {
        Real x = std::max(next, centre - 1.0L);
        // Counted, because far from 0 a step may be lost in the rounding.
        for (int step = 0; step <= 16 && x <= centre + 1.0L; ++step) {
            samples.push_back({x, density.height(x)});
            x += k_density_step;
            next = x;
        }
    }
    return samples;
}

/// Mode within one step of a sample that is not lower than its neighbours.
DensityPoint mode_near(const KernelDensity& density, Real place) {
    Real low = place - k_density_step, high = place + k_density_step;
    for (int halving = 0; halving < 60; ++halving) {
        // By the slope: the height is flat at a maximum and would give half of the digits only.
        const Real middle = low + (high - low) / 2;
        (density.slope(middle) > 0.0L ? low : high) = middle;
    }
    return {low, density.height(low)};
}

/// Greatest mode, in bandwidths.
Real greatest_mode(const std::vector<Real>& q) {
    const KernelDensity density(q);
    const std::vector<DensityPoint> samples = density_samples(density, q);
    Real highest = 0.0L;
    for (const DensityPoint& sample : samples) {
        highest = std::max(highest, sample.height);
    }
    DensityPoint best;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Real height = samples[i].height;
        const bool peak =
            (i == 0 || height >= samples[i - 1].height) && (i + 1 == samples.size() || height >= samples[i + 1].height);
        // A sample may miss its mode by 1 %, so that all peaks within 2 % of the highest are refined before they are
        // compared.
        if (peak && height >= 0.98L * highest) {
            const DensityPoint mode = mode_near(density, samples[i].place);
            // Of equal modes the lowest stays: rounding must not choose.
            if (mode.height > best.height * (1.0L + 1e-12L)) {
                best = mode;
            }
        }
    }
    return best.place;
}

}  // namespace

double median(std::span<const double> results) {
    return static_cast<double>(median_of_sorted(sorted(results, 1)));
}

RobustEstimate median_with_made(std::span<const double> results) {
    const std::vector<double> ascending = sorted(results, 2);
    const Real centre = median_of_sorted(ascending);
    const Real made = static_cast<Real>(k_made_factor) * median_of_absolute(centred(ascending, centre));
    return estimate(centre, made, ascending.size());
}

double normalised_interquartile_range(std::span<const double> results) {
    const std::vector<double> ascending = sorted(results, 2);
    const auto range = static_cast<double>(
        k_iqr_factor * (quantile_of_sorted(ascending, 0.75L) - quantile_of_sorted(ascending, 0.25L)));
    require_finite(range, "normalised interquartile range");
    return range;
}

RobustEstimate algorithm_a(std::span<const double> results, AlgorithmAConstants constants) {
    const std::vector<double> ascending = sorted(results, 2);
    const Real centre = median_of_sorted(ascending);
    const std::vector<Real> values = centred(ascending, centre);
    const bool published = constants == AlgorithmAConstants::published;
    Real start = median_of_absolute(values) *
                 (published ? static_cast<Real>(k_made_factor) : 1.0L / static_cast<Real>(k_third_normal_quartile));
    const Real factor = published ? static_cast<Real>(k_algorithm_a_factor) : exact_algorithm_a_factor();
    const bool half_are_equal = !(start > 0.0L);
    // MADe is 0 where more than half of the results are equal. Begun with 0, everything would be drawn in to the median
    // at once; from the standard deviation the iteration may still find a scale in the others.
    if (half_are_equal) {
        start = standard_deviation(values);
    }
    constexpr Real k_roundings = 8.0L;  // numbers that differ by no more are equal
    const Real largest =
        std::max(std::abs(static_cast<Real>(ascending.front())), std::abs(static_cast<Real>(ascending.back())));
    if (!(start > (half_are_equal ? k_roundings * std::numeric_limits<double>::epsilon() * largest : 0.0L))) {
        refuse_equal("algorithm A", ascending.size());
    }
    const DrawnIn drawn(values);
    Real x = 0.0L;  // x* − median
    Real s = start;
    for (int step = 0; step < k_most_steps; ++step) {
        const auto [mean, deviation] = drawn.mean_and_deviation(x, static_cast<Real>(k_algorithm_a_limit) * s);
        const Real scale = factor * deviation;
        const Real limit = static_cast<Real>(k_stand_still) * scale;
        // The iteration converges linearly: a limit like 1e-6 of s* would stop it while a hundred such steps are left
        // to go.
        const bool stands_still = std::abs(mean - x) <= limit && std::abs(scale - s) <= limit;
        x = mean;
        s = scale;
        if (stands_still) {
            return estimate(centre + x, s, ascending.size());
        }
        if (half_are_equal && s < k_vanished * start) {  // it would go on shrinking for ever
            refuse_no_scale_of_algorithm_a(ascending);
        }
    }
    throw NoResultError(Diagnostic{.code = "GC-GUM-0103",
                                   .where = "algorithm A",
                                   .what = "not converged after " + std::to_string(k_most_steps) + " steps",
                                   .rule = "two successive steps must agree",
                                   .action = "Look for groups of results; use the median where they are one."});
}

AlgorithmSFactors algorithm_s_factors(double degrees_of_freedom) {
    require_positive(degrees_of_freedom, "degrees of freedom of a standard deviation");
    constexpr double k_most_degrees_of_freedom = 1e10;
    if (degrees_of_freedom > k_most_degrees_of_freedom) {
        refuse("GC-GUM-0005", "degrees of freedom of a standard deviation", text::shortest(degrees_of_freedom),
               "must not be greater than " + text::shortest(k_most_degrees_of_freedom), "Correct the number.");
    }
    using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;  // ADR 0058
    const boost::math::chi_squared_distribution<double, InDouble> distribution(degrees_of_freedom);
    const double limit_square = boost::math::quantile(distribution, 0.9) / degrees_of_freedom;
    // E[min(W, η²ν)] of a χ² W: ∫ w f_ν(w) dw = ν P(χ²(ν + 2) ≤ …), and η²ν with probability 0.1.
    const double mean_square =
        chi_square_lower_tail(limit_square * degrees_of_freedom, degrees_of_freedom + 2.0) + 0.1 * limit_square;
    const AlgorithmSFactors factors{.limit = std::sqrt(limit_square), .adjustment = 1.0 / std::sqrt(mean_square)};
    require_finite(factors.adjustment, "adjustment factor of algorithm S");
    return factors;
}

double algorithm_s(std::span<const double> standard_deviations, double degrees_of_freedom) {
    return algorithm_s(standard_deviations, algorithm_s_factors(degrees_of_freedom));
}

double algorithm_s(std::span<const double> standard_deviations, const AlgorithmSFactors& factors) {
    require_positive(factors.limit, "limit factor of algorithm S");
    require_positive(factors.adjustment, "adjustment factor of algorithm S");
    require_positive(factors.limit * factors.adjustment - 1.0, "product of the factors of algorithm S, less 1");
    const std::vector<double> ascending = sorted(standard_deviations, 1);
    require_not_negative(ascending.front(), "standard deviation");
    const auto count = static_cast<Real>(ascending.size());
    const Real adjustment_square = static_cast<Real>(factors.adjustment) * static_cast<Real>(factors.adjustment);
    const Real step_square = adjustment_square * static_cast<Real>(factors.limit) * static_cast<Real>(factors.limit);
    // From the largest on they are drawn in, as long as η w* would be smaller even if they were just at the limit.
    std::vector<Real> sums{0.0L};  // of the squares of the smallest 0, 1, … of them
    for (const double value : ascending) {
        sums.push_back(sums.back() + static_cast<Real>(value) * static_cast<Real>(value));
    }
    std::size_t inside = ascending.size();
    Real drawn_in = 0.0L;
    // Which of them are drawn in decides everything, and w* then follows from one equation. The steps of the algorithm
    // lead to the same w*.
    for (; inside > 0; --inside, ++drawn_in) {
        const Real limit = ascending[inside - 1];
        if (step_square * (sums[inside] + drawn_in * limit * limit) >= count * limit * limit) {
            break;
        }
    }
    // w² = ξ² (Σ of those inside + drawn_in η² w²)/p
    const Real w_square = adjustment_square * sums[inside] / (count - step_square * drawn_in);
    if (!(median_of_sorted(ascending) > 0.0L && w_square > 0.0L)) {
        const auto zeros = std::upper_bound(ascending.begin(), ascending.end(), 0.0) - ascending.begin();
        refuse("GC-GUM-0102", "algorithm S",
               std::to_string(zeros) + " of " + std::to_string(ascending.size()) + " standard deviations are 0",
               "a robust standard deviation greater than 0 is needed",
               "Give the replicates with more digits, or leave out the pooled standard deviation.");
    }
    const auto pooled = static_cast<double>(std::sqrt(w_square));
    require_finite(pooled, "pooled standard deviation");
    return pooled;
}

RobustEstimate q_hampel(std::span<const double> results) {
    const std::vector<double> ascending = sorted(results, 2);
    const double scale = q_scale(ascending);
    require_positive(scale, "scale of the Q method");
    const Real centre = median_of_sorted(ascending);
    const Real location = centre + static_cast<Real>(scale) * hampel_location(centred(ascending, centre, scale));
    return estimate(location, scale, ascending.size());
}

RobustEstimate supported_q_hampel(std::span<const double> results) {
    constexpr double k_reach_of_psi = 4.5;
    const RobustEstimate estimate = q_hampel(results);
    const auto within = static_cast<std::size_t>(std::count_if(results.begin(), results.end(), [&](double result) {
        return std::abs((result - estimate.location) - estimate.rest) <= k_reach_of_psi * estimate.scale;
    }));
    if (2 * within < results.size()) {
        throw NoResultError(Diagnostic{
            .code = "GC-GUM-0144",
            .where = "Q method with Hampel's estimator",
            .what = std::to_string(within) + " of " + std::to_string(results.size()) +
                    " results lie within 4.5 s* = " + text::shortest(k_reach_of_psi * estimate.scale) +
                    " of the location " + text::shortest(estimate.location),
            .rule = "at least half of the results must speak for it",
            .action = "Look for groups of results and for what tells them apart; one value does not describe them."});
    }
    return estimate;
}

double kernel_density_mode(std::span<const double> results, double bandwidth) {
    require_positive(bandwidth, "bandwidth of the kernel density");
    const std::vector<double> ascending = sorted(results, 1);
    const Real centre = median_of_sorted(ascending);
    const Real mode = greatest_mode(centred(ascending, centre, bandwidth));
    return static_cast<double>(centre + static_cast<Real>(bandwidth) * mode);
}

}  // namespace gumcert::gum
