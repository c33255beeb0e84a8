#include "gum/conformity/global_risk.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "gum/argument_check.h"
#include "gum/coverage.h"
#include "gum/quantity/golden_section.h"
#include "gum/quantity/special_values.h"

namespace gumcert::gum {
namespace {

// Fixed panels of 20 points and no adaptive rule: panel ends lie where the integrand changes (panel_ends), so that a
// measurement far narrower than the population is not stepped over.
using Panel = boost::math::quadrature::gauss<double, 20>;

constexpr int k_reach = 38;  // standard deviations: beyond, a normal density is not a number above 0 any more

double density(double z) {
    return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}
// By erfc: 1 − Φ(z) has no digits left from z = 8 on.
double upper_tail(double z) {
    return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

/// P(a < Z < b), from the smaller tails.
double probability_between(double a, double b) {
    if (!(a < b)) {
        return 0.0;
    }
    // Both on one side of the mean: a difference of two small tails and not of two numbers close to 1.
    if (a > 0.0) {
        return upper_tail(a) - upper_tail(b);
    }
    return b < 0.0 ? upper_tail(-b) - upper_tail(-a) : 1.0 - upper_tail(-a) - upper_tail(b);
}

/// A normal population, a normal measurement and the limits, the missing ones infinite.
struct Situation {
    double lower, upper, accept_lower, accept_upper, centre, deviation, u;

    [[nodiscard]] double population(double t) const { return density((t - centre) / deviation) / deviation; }
    [[nodiscard]] double accepted(double t) const {
        return probability_between((accept_lower - t) / u, (accept_upper - t) / u);
    }
    [[nodiscard]] double rejected(double t) const {
        return accept_lower > accept_upper ? 1.0
                                           : upper_tail((t - accept_lower) / u) + upper_tail((accept_upper - t) / u);
    }
    /// Mirrored about zero: what is above becomes what is below.
    [[nodiscard]] Situation mirrored() const {
        return {-upper, -lower, -accept_upper, -accept_lower, -centre, deviation, u};
    }
};

/// Ends of panels between two values, none wider than one standard deviation where a factor of the integrand varies.
std::vector<double> panel_ends(const Situation& s, double from, double to) {
    // The factors of the integrand change over s0 about the centre of the population, and over u about each acceptance
    // limit. In panels of one standard deviation 20 points give the stated accuracy.
    std::vector<double> ends{from, to};
    const auto add = [&](double middle, double step) {
        if (!std::isfinite(middle)) {
            return;
        }
        for (int i = -k_reach; i <= k_reach; ++i) {
            const double end = middle + i * step;
            if (end > from && end < to) {
                ends.push_back(end);
            }
        }
    };
    add(s.centre, s.deviation);
    add(s.accept_lower, s.u);
    add(s.accept_upper, s.u);
    std::sort(ends.begin(), ends.end());
    return ends;
}

double farthest(const Situation& s) {
    return s.centre + k_reach * s.deviation;
}

/// Bad and accepted, above the upper limit. The integrand is a product of log-concave functions and so has one peak:
/// once the panels fall, those that follow are smaller still.
double false_accept_above(const Situation& s) {
    if (!std::isfinite(s.upper) || s.upper >= farthest(s)) {
        return 0.0;
    }
    const std::vector<double> ends = panel_ends(s, s.upper, farthest(s));
    double sum = 0.0;
    double last_mean = 0.0;
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const double width = ends[i] - ends[i - 1];
        if (!(width > 0.0)) {
            continue;
        }
        const double part =
            Panel::integrate([&](double t) { return s.population(t) * s.accepted(t); }, ends[i - 1], ends[i]);
        sum += part;
        // Panels have different widths, so that their mean height is compared and not their area.
        const double mean = part / width;
        if (mean < last_mean && mean * (farthest(s) - ends[i]) < 1e-16 * sum) {
            break;
        }
        last_mean = mean;
    }
    return sum;
}

double false_reject(const Situation& s) {
    const double from = std::max(s.lower, s.centre - k_reach * s.deviation);
    const double to = std::min(s.upper, farthest(s));
    if (!(from < to)) {
        return 0.0;
    }
    const std::vector<double> ends = panel_ends(s, from, to);
    double sum = 0.0;
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if (ends[i] > ends[i - 1]) {
            sum += Panel::integrate([&](double t) { return s.population(t) * s.rejected(t); }, ends[i - 1], ends[i]);
        }
    }
    return sum;
}

double false_accept(const Situation& s) {
    return s.accept_lower > s.accept_upper ? 0.0 : false_accept_above(s) + false_accept_above(s.mirrored());
}

double acceptance_probability(const Situation& s) {
    // Values of a normal population that is measured with a normal distribution are normal with s0² + u².
    const double spread = std::hypot(s.deviation, s.u);
    return probability_between((s.accept_lower - s.centre) / spread, (s.accept_upper - s.centre) / spread);
}

double conditional_false_accept(const Situation& s) {
    const double accepted = acceptance_probability(s);
    return accepted > 0.0 ? std::min(1.0, false_accept(s) / accepted) : 0.0;
}

Situation situation(const ToleranceLimits& tolerance, const ToleranceLimits& acceptance, double centre,
                    double deviation, double u) {
    require_limits(tolerance);
    require_finite(centre, "centre of the population");
    require_positive(deviation, "standard deviation of the population");
    require_positive(u, "standard uncertainty of the measurement");
    return {tolerance.lower.value_or(-k_infinity),
            tolerance.upper.value_or(k_infinity),
            acceptance.lower.value_or(-k_infinity),
            acceptance.upper.value_or(k_infinity),
            centre,
            deviation,
            u};
}

/// Where a falling function crosses zero.
template <class Function>
double falling_root(const Function& f, double a, double b) {
    std::uintmax_t steps = 200;
    const auto [low, high] =
        boost::math::tools::toms748_solve(f, a, b, boost::math::tools::eps_tolerance<double>(50), steps);
    return high;  // the side where the function is not above zero
}

}  // namespace

GlobalRisk global_risk(const ToleranceLimits& tolerance, const ToleranceLimits& acceptance, double centre,
                       double deviation, double u) {
    const Situation s = situation(tolerance, acceptance, centre, deviation, u);
    return {false_accept(s), false_reject(s), conditional_false_accept(s)};
}

double largest_false_accept(const ToleranceLimits& tolerance, const ToleranceLimits& acceptance, double u) {
    require_limits(tolerance);
    require_positive(u, "standard uncertainty of the measurement");
    if (!tolerance.two_sided()) {
        refuse("GC-GUM-0080", "largest false accept probability", "one-sided limits",
               "a population is centred between two limits", "State the population.");
    }
    const double half = 0.5 * (*tolerance.upper - *tolerance.lower);
    const double centre = *tolerance.lower + half;
    const auto risk = [&](double log_deviation) {
        return false_accept(situation(tolerance, acceptance, centre, half * std::exp(log_deviation), u));
    };
    // One peak: a narrow population has no bad items, a wide one few items near the limits. From T/20 to 20 T, or to a
    // good deal more than u where that is larger, in steps, then by golden section about the best step.
    constexpr int k_steps = 20;
    const double low = std::log(0.05);
    const double high = std::log(20.0 * std::max(1.0, u / half));
    int best = 0;
    double most = -1.0;
    for (int i = 0; i <= k_steps; ++i) {
        if (const double value = risk(low + (high - low) * i / k_steps); value > most) {
            most = value;
            best = i;
        }
    }
    const double spacing = (high - low) / k_steps;
    // A cut leaves 0.618 of the way. The square of what is left is the relative error of the maximum.
    constexpr double k_left = 1e-6;
    const double from = low + spacing * std::max(0, best - 1), to = low + spacing * std::min(k_steps, best + 1);
    const int cuts = static_cast<int>(std::ceil(std::log((to - from) / k_left) / std::log(std::numbers::phi)));
    const double at = least_by_golden_section([&risk](double x) { return -risk(x); }, from, to, cuts);
    return std::max(most, risk(at));
}

double population_deviation(double half_tolerance, double reliability) {
    require_positive(half_tolerance, "half of the tolerance");
    require_probability(reliability, "reliability of the population");
    return half_tolerance / two_sided_normal_critical_value(1.0 - reliability);
}

std::optional<double> population_deviation(const ToleranceLimits& limits, double centre, double reliability) {
    require_limits(limits);
    require_finite(centre, "centre of the population");
    require_probability(reliability, "reliability of the population");
    const double below = limits.lower ? centre - *limits.lower : k_infinity;
    const double above = limits.upper ? *limits.upper - centre : k_infinity;
    if (!(below > 0.0 && above > 0.0) || (!limits.two_sided() && reliability <= 0.5)) {
        return std::nullopt;
    }
    if (!limits.two_sided()) {
        return std::min(below, above) / standard_normal_quantile(reliability);
    }
    // Between the deviation that the farther limit gives on both sides and the one of the nearer limit.
    const double narrow = population_deviation(std::min(below, above), reliability);
    const double wide = population_deviation(std::max(below, above), reliability);
    const auto excess = [&](double deviation) {
        return probability_between(-below / deviation, above / deviation) - reliability;
    };
    if (!(excess(narrow) > 0.0)) {
        return narrow;
    }
    return excess(wide) < 0.0 ? falling_root(excess, narrow, wide) : wide;
}

std::optional<double> population_deviation_from_observed(double observed_deviation, double u) {
    require_not_negative(observed_deviation, "observed standard deviation");
    require_not_negative(u, "standard uncertainty of the measurement");
    if (!(observed_deviation > u)) {
        return std::nullopt;
    }
    // s² − u² as a product: nothing cancels where the items hardly differ.
    return std::sqrt((observed_deviation - u) * (observed_deviation + u));
}

ToleranceLimits guarded_limits(const ToleranceLimits& tolerance, double guard_band) {
    ToleranceLimits guarded = tolerance;
    if (guarded.lower) {
        *guarded.lower += guard_band;
    }
    if (guarded.upper) {
        *guarded.upper -= guard_band;
    }
    return guarded;
}

std::optional<double> guard_band_for_global_risk(const ToleranceLimits& tolerance, double centre, double deviation,
                                                 double u, double largest_risk, FalseAccept kind) {
    require_probability(largest_risk, "largest global risk");
    const auto excess = [&](double guard_band) {
        const Situation s = situation(tolerance, guarded_limits(tolerance, guard_band), centre, deviation, u);
        return (kind == FalseAccept::conditional ? conditional_false_accept(s) : false_accept(s)) - largest_risk;
    };
    // A guard band makes false acceptance rarer and false rejection more frequent: none is taken that is not needed.
    if (excess(0.0) <= 0.0) {
        return 0.0;
    }
    double widest = u;
    if (tolerance.two_sided()) {
        // Nearly nothing is accepted then; a little is, so that there are items to say something about.
        widest = 0.5 * (*tolerance.upper - *tolerance.lower) * (1.0 - 1e-6);
        if (excess(widest) > 0.0) {
            return std::nullopt;
        }
    } else {
        const double most = 30.0 * std::hypot(u, deviation) + std::abs(centre - tolerance.lower.value_or(centre)) +
                            std::abs(centre - tolerance.upper.value_or(centre));
        while (excess(widest) > 0.0) {
            widest *= 2.0;
            if (widest > most) {
                return std::nullopt;
            }
        }
    }
    return falling_root(excess, 0.0, widest);
}

}  // namespace gumcert::gum
