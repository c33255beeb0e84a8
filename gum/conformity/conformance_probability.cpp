#include "gum/conformity/conformance_probability.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/distribution_quantile.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

constexpr double k_negligible_tail = 1e-17;  // against the other tail
constexpr double k_no_chance = 1e-3;         // one trial, or a few, may fall on or beside a limit
constexpr int k_scan = 64;                   // values tried for a distribution that is not known to have one peak

/// The side of a root on which a function is to be, where it jumps over 0.
enum class Side { not_above, not_below };

/// The distribution of Y − y.
class Dispersion {
public:
    explicit Dispersion(const MeasuredValue& y)
        : y_(y), standard_(Distribution::student_t(0.0, y.standard_uncertainty, y.degrees_of_freedom)) {}

    /// P(Y − y ≤ d)
    [[nodiscard]] double below(double d) const {
        return y_.distribution ? std::clamp(y_.distribution(y_.value + d), 0.0, 1.0)
                               : lower_tail_probability(standard_, d);
    }
    /// P(Y − y < d)
    [[nodiscard]] double under(double d) const {
        return y_.distribution && y_.distribution_below ? std::clamp(y_.distribution_below(y_.value + d), 0.0, 1.0)
                                                        : below(d);
    }
    // The upper tail by its own function: 1 − P(Y ≤ x) has no digit left of a risk of 1e-17. A distribution that is
    // given by its P(Y ≤ x) alone has nothing better.
    [[nodiscard]] double above(double d) const {
        return y_.distribution ? 1.0 - below(d) : upper_tail_probability(standard_, d);
    }
    /// P(Y − y ≥ d)
    [[nodiscard]] double from(double d) const { return y_.distribution ? 1.0 - under(d) : above(d); }
    /// The d with P(Y − y > d) = q; where that jumps over q, it is smaller than q.
    [[nodiscard]] double upper(double q) const {
        return y_.distribution ? solve(1.0 - q, Side::not_below) : upper_quantile(standard_, q);
    }
    /// The d with P(Y − y ≤ d) = q; where that jumps over q, it is smaller than q.
    [[nodiscard]] double lower(double q) const {
        return y_.distribution ? solve(q, Side::not_above) : quantile(standard_, q);
    }
    /// The probability of nonconformity of a value s.
    /// Added up from the two tails and not 1 − p_c, for the same reason. A value on a limit conforms, so the lower tail
    /// is P(Y < T_L) without the limit itself.
    [[nodiscard]] double risk(double s, const ToleranceLimits& limits) const {
        return (limits.lower ? under(*limits.lower - s) : 0.0) + (limits.upper ? above(*limits.upper - s) : 0.0);
    }

private:
    [[nodiscard]] double solve(double p, Side side) const;

    const MeasuredValue& y_;
    Distribution standard_;
};

/// A root between two values of opposite sign; an end itself where its value is zero or the signs are equal,
/// which only rounding can bring about. Where the function jumps there is no root but a side.
template <class Function>
double root_between(const Function& f, double a, double b, Side side) {
    if (!(a < b)) {
        return a;
    }
    const double fa = f(a);
    const double fb = f(b);
    if (fa == 0.0 || fb == 0.0 || (fa > 0.0) == (fb > 0.0)) {
        return std::abs(fa) <= std::abs(fb) ? a : b;
    }
    std::uintmax_t steps = 200;
    const auto [low, high] =
        boost::math::tools::toms748_solve(f, a, b, fa, fb, boost::math::tools::eps_tolerance<double>(52), steps);
    const double middle = 0.5 * (low + high);
    const auto fits = [&](double x) { return side == Side::not_above ? f(x) <= 0.0 : f(x) >= 0.0; };
    return fits(middle) ? middle : fits(low) ? low : high;
}

double Dispersion::solve(double p, Side side) const {
    const auto f = [&](double d) { return below(d) - p; };
    double reach = 4.0 * y_.standard_uncertainty;
    // A given distribution may have tails of any length: ± 4 u need not hold the quantile.
    while ((f(-reach) > 0.0 || f(reach) < 0.0) && std::isfinite(2.0 * reach)) {
        reach *= 2.0;
    }
    return root_between(f, -reach, reach, side);
}

/// Where the risk crosses a level between two values.
double crossing(const Dispersion& dispersion, const ToleranceLimits& limits, double level, double from, double to) {
    return root_between([&](double s) { return dispersion.risk(s, limits) - level; }, std::min(from, to),
                        std::max(from, to), Side::not_above);
}

/// A limit that was found, on the side where its own risk keeps to the level: T − d and T − (T − d) are rounded, which
/// is nothing but where the risk jumps.
double kept_to_level(const std::function<double(double)>& risk, double level, double limit, bool is_lower) {
    constexpr double k_noise = 1e-12;  // relative, of a risk
    constexpr int k_most_steps = 24;
    const double grain = std::numeric_limits<double>::epsilon() * std::abs(limit);
    double kept = limit;
    for (int i = 0; i < k_most_steps && risk(kept) > level * (1.0 + k_noise); ++i) {
        kept = limit + (is_lower ? grain : -grain) * std::ldexp(1.0, i);
    }
    return risk(kept) > level * (1.0 + k_noise) ? limit : kept;
}

/// A value between two others whose risk is as small as any that is tried: y itself where it is accepted.
double good_value(const Dispersion& dispersion, const ToleranceLimits& limits, double level, double low, double high,
                  double y) {
    if (dispersion.risk(y, limits) <= level) {
        return y;
    }
    double best = std::clamp(0.5 * (*limits.lower + *limits.upper), low, high);
    double least = dispersion.risk(best, limits);
    for (int i = 0; i <= k_scan; ++i) {
        const double s = low + (high - low) * i / k_scan;
        if (const double risk = dispersion.risk(s, limits); risk < least) {
            least = risk;
            best = s;
        }
    }
    return best;
}

/// The value between `accepted` and an end where a risk first crosses a level.
double first_crossing(const std::function<double(double)>& risk, double level, double accepted, double end,
                      double tested) {
    std::vector<double> tried;
    for (int i = 1; i <= k_scan; ++i) {
        tried.push_back(accepted + (end - accepted) * i / k_scan);
    }
    if ((tested - accepted) * (end - tested) > 0.0) {
        tried.push_back(tested);
        std::sort(tried.begin(), tried.end(),
                  [&](double a, double b) { return std::abs(a - accepted) < std::abs(b - accepted); });
    }
    double before = accepted;
    for (const double s : tried) {
        if (risk(s) > level) {
            return root_between([&](double x) { return risk(x) - level; }, std::min(before, s), std::max(before, s),
                                Side::not_above);
        }
        before = s;
    }
    return end;
}

}  // namespace

void require_measured_value(const MeasuredValue& y) {
    const auto check = [](bool fine, const char* what, double value, const char* rule) {
        if (!fine) {
            refuse("GC-GUM-0081", "decision on conformity", std::string(what) + " " + text::shortest(value), rule,
                   "Correct the measured value or its uncertainty.");
        }
    };
    check(std::isfinite(y.value), "measured value", y.value, "must be finite");
    check(std::isfinite(y.standard_uncertainty) && y.standard_uncertainty > 0.0, "standard uncertainty",
          y.standard_uncertainty, "must be finite and greater than 0");
    check(std::isfinite(y.expanded_uncertainty) && y.expanded_uncertainty > 0.0, "expanded uncertainty",
          y.expanded_uncertainty, "must be finite and greater than 0");
    check(y.degrees_of_freedom > 0.0, "degrees of freedom", y.degrees_of_freedom, "must be greater than 0");
}

double distribution_function(const MeasuredValue& y, double x) {
    require_measured_value(y);
    return Dispersion(y).below(x - y.value);
}

double probability_below(const MeasuredValue& y, double x) {
    require_measured_value(y);
    return Dispersion(y).under(x - y.value);
}

bool has_probability_of_its_own(const MeasuredValue& y, double x) {
    return y.distribution && y.distribution_below && y.distribution(x) - y.distribution_below(x) > k_no_chance;
}

ToleranceLimits limits_that_can_be_passed(const MeasuredValue& y, const ToleranceLimits& limits) {
    if (!y.distribution) {
        return limits;
    }
    constexpr double k_near = 0.1;  // [u]
    const double step = k_near * y.standard_uncertainty;
    const auto under = [&y](double x) { return y.distribution_below ? y.distribution_below(x) : y.distribution(x); };
    const auto may_bound = [&y](double x) { return x == 0.0 || has_probability_of_its_own(y, x); };
    ToleranceLimits passable = limits;
    if (const std::optional<double> x = limits.lower;
        x && may_bound(*x) && !(under(*x) > 0.0) && y.distribution(*x + step) > k_no_chance) {
        passable.lower.reset();
    }
    if (const std::optional<double> x = limits.upper;
        x && may_bound(*x) && !(y.distribution(*x) < 1.0) && 1.0 - under(*x - step) > k_no_chance) {
        passable.upper.reset();
    }
    return passable;
}

double nonconformance_probability_at(double value, const MeasuredValue& y, const ToleranceLimits& limits) {
    require_limits(limits);
    require_measured_value(y);
    return std::min(1.0, Dispersion(y).risk(value, limits));
}

double nonconformance_probability(const MeasuredValue& y, const ToleranceLimits& limits) {
    return nonconformance_probability_at(y.value, y, limits);
}

double conformance_probability(const MeasuredValue& y, const ToleranceLimits& limits) {
    require_limits(limits);
    require_measured_value(y);
    const Dispersion dispersion(y);
    const double low = limits.lower ? *limits.lower - y.value : 0.0;
    const double high = limits.upper ? *limits.upper - y.value : 0.0;
    // A difference of the smaller tails: p_c keeps its digits when it is small, too.
    double probability = 0.0;
    if (!limits.two_sided()) {
        probability = limits.lower ? dispersion.from(low) : dispersion.below(high);
    } else if (low > 0.0) {
        probability = dispersion.from(low) - dispersion.above(high);
    } else if (high < 0.0) {
        probability = dispersion.below(high) - dispersion.under(low);
    } else {
        probability = 1.0 - dispersion.risk(y.value, limits);
    }
    return std::clamp(probability, 0.0, 1.0);
}

std::optional<ToleranceLimits> acceptance_limits_for_risk(const MeasuredValue& y, const ToleranceLimits& limits,
                                                          double risk) {
    require_limits(limits);
    require_measured_value(y);
    if (!(risk > 0.0 && risk <= 0.5)) {
        refuse("GC-GUM-0082", "decision on conformity", "largest risk " + text::shortest(risk),
               "must be greater than 0 and not above 0.5", "Correct the decision rule.");
    }
    const Dispersion dispersion(y);
    ToleranceLimits accepted;  // with one tail alone: no value outside of these can be accepted
    if (limits.lower) {
        accepted.lower = *limits.lower - dispersion.lower(risk);
    }
    if (limits.upper) {
        accepted.upper = *limits.upper - dispersion.upper(risk);
    }
    const auto of_value = [&](double s) { return dispersion.risk(s, limits); };
    if (!limits.two_sided()) {
        if (y.distribution && accepted.lower) {
            accepted.lower = kept_to_level(of_value, risk, *accepted.lower, true);
        }
        if (y.distribution && accepted.upper) {
            accepted.upper = kept_to_level(of_value, risk, *accepted.upper, false);
        }
        return accepted;
    }
    // Both tails together are a larger risk than one: the true acceptance limits lie between these two.
    double low = *accepted.lower;
    double high = *accepted.upper;
    // A value that keeps to the risk is accepted, whatever rounding made of the limits of one side: where all values fill
    // the tolerance just so, they change places.
    if (of_value(y.value) <= risk) {
        low = std::min(low, y.value);
        high = std::max(high, y.value);
    }
    // Already one tail alone is above the risk everywhere: the tolerance is too narrow for this u.
    if (low > high) {
        return std::nullopt;
    }
    if (y.distribution) {
        const double best = good_value(dispersion, limits, risk, low, high, y.value);
        return of_value(best) > risk ? std::nullopt
                                     : std::optional(accepted_around(of_value, risk, best, low, high, y.value));
    }
    // With one peak and symmetry the risk is least in the middle of the tolerance and grows to both sides, so that it
    // crosses the level once on each.
    const double best = std::clamp(0.5 * (*limits.lower + *limits.upper), low, high);
    if (dispersion.risk(best, limits) > risk) {
        return std::nullopt;
    }
    // Only where the far tail counts at all: else the closed form of one side stands, exact and without a search.
    if (dispersion.above(*limits.upper - low) > k_negligible_tail * risk) {
        accepted.lower = crossing(dispersion, limits, risk, low, best);
    }
    if (dispersion.under(*limits.lower - high) > k_negligible_tail * risk) {
        accepted.upper = crossing(dispersion, limits, risk, best, high);
    }
    return accepted;
}

ToleranceLimits accepted_around(const std::function<double(double)>& risk, double level, double accepted, double low,
                                double high, double tested) {
    return {.lower = first_crossing(risk, level, accepted, std::min(low, accepted), tested),
            .upper = first_crossing(risk, level, accepted, std::max(high, accepted), tested)};
}

ToleranceLimits rejection_limits_for_probability(const MeasuredValue& y, const ToleranceLimits& limits,
                                                 double probability) {
    require_limits(limits);
    require_measured_value(y);
    if (!(probability > 0.5 && probability < 1.0)) {
        refuse("GC-GUM-0082", "decision on conformity", "probability of nonconformity " + text::shortest(probability),
               "must be above 0.5 and below 1", "Correct the decision rule.");
    }
    const Dispersion dispersion(y);
    ToleranceLimits rejected;
    if (limits.lower) {
        // With one tail alone; the second one can only move these limits towards the tolerance.
        rejected.lower = *limits.lower - dispersion.upper(1.0 - probability);
    }
    if (limits.upper) {
        rejected.upper = *limits.upper - dispersion.lower(1.0 - probability);
    }
    if (limits.two_sided()) {  // the other tail helps to prove nonconformity
        const double lower = *rejected.lower;
        const double upper = *rejected.upper;
        if (dispersion.above(*limits.upper - lower) > k_negligible_tail) {
            rejected.lower = crossing(dispersion, limits, probability, lower, *limits.lower);
        }
        if (dispersion.under(*limits.lower - upper) > k_negligible_tail) {
            rejected.upper = crossing(dispersion, limits, probability, *limits.upper, upper);
        }
    }
    return rejected;
}

}  // namespace gumcert::gum
