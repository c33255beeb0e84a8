#include "gum/distribution_quantile.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "gum/argument_check.h"
#include "gum/quantity/special_values.h"
#include "text/numbers.h"

namespace gumcert::gum {

// A distribution is location + scale · S with S of a standard form. Tails and quantiles are those of S. A small tail is
// never 1 minus the other one: symmetric forms compute the smaller one, the others each by a function of its own. So a
// tail of 1e-30 has as many digits as one of 0.3.

namespace {

namespace bm = boost::math;
/// Too large is infinite, too small is 0: both are true answers here, not failures.
using QuantilePolicy =
    bm::policies::policy<bm::policies::promote_double<false>, bm::policies::overflow_error<bm::policies::ignore_error>,
                         bm::policies::underflow_error<bm::policies::ignore_error>>;
using StudentT = bm::students_t_distribution<double, QuantilePolicy>;
using Gamma = bm::gamma_distribution<double, QuantilePolicy>;
using Beta = bm::beta_distribution<double, QuantilePolicy>;

constexpr double k_pi = std::numbers::pi;

/// e + (1 - e) ln(1 - e) for 0 ≤ e ≤ 1: e²/2 at small e, where the closed form has lost all its digits.
double curved_tail(double e) {
    if (e > 0.1) {
        return e < 1.0 ? e + (1.0 - e) * std::log1p(-e) : 1.0;
    }
    // Sixteen terms: at e = 0.1 the first one left out is 1e-18 of the sum.
    static constexpr auto coefficients = [] {  // of Σ e^k / (k (k-1)), k ≥ 2
        std::array<double, 16> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double k = static_cast<double>(i) + 2.0;
            values[i] = 1.0 / (k * (k - 1.0));
        }
        return values;
    }();
    double sum = 0.0;
    for (std::size_t i = coefficients.size(); i-- > 0;) {
        sum = sum * e + coefficients[i];
    }
    return sum * e * e;
}

/// The e with curved_tail(e) = value.
double inverse_curved_tail(double value) {
    // h(e) between e²/2 and e² for 0 ≤ e ≤ 1: √(2h) is too large by at most √2. h is convex and increasing, so that
    // Newton steps from there go down to the root and never pass it.
    double e = std::min(std::sqrt(2.0 * value), 1.0);
    for (int step = 0; step < 60; ++step) {
        // h′(e) = −ln(1 − e) is infinite at e = 1; the last double below 1 keeps the step finite.
        const double slope = -std::log1p(-std::min(e, 1.0 - 1e-16));
        const double next = e - (curved_tail(e) - value) / slope;
        // For the value 0 numerator and slope are both 0 and the quotient is NaN: e = 0 is the root then.
        if (!(next > 0.0)) {
            return e;
        }
        if (std::abs(next - e) <= 1e-8 * e) {  // squared by this step
            return next;
        }
        e = std::min(next, 1.0);
    }
    return e;
}

/// P(S > s) of the standard distributions that are symmetric about 0, s ≥ 0.
double symmetric_tail(const Distribution& distribution, double s) {
    const double shape = distribution.shape;
    switch (distribution.kind) {
        case DistributionKind::normal:
            // erfc and not 1 − erf, which has no digits left from 6 standard deviations on.
            return 0.5 * std::erfc(s / std::numbers::sqrt2);
        case DistributionKind::uniform:
            return s < 1.0 ? 0.5 * (1.0 - s) : 0.0;
        case DistributionKind::triangular:
            return s < 1.0 ? 0.5 * (1.0 - s) * (1.0 - s) : 0.0;
        case DistributionKind::arcsine:
            return s < 1.0 ? std::acos(s) / k_pi : 0.0;
        case DistributionKind::trapezoidal:
            if (s >= 1.0) {
                return 0.0;
            }
            // (1 − β)(1 + β), not 1 − β²: where the trapezoid is nearly a rectangle the square would cancel.
            return s < shape ? 0.5 - s / (1.0 + shape) : 0.5 * (1.0 - s) * (1.0 - s) / ((1.0 - shape) * (1.0 + shape));
        case DistributionKind::curvilinear_trapezoid: {
            const double limit = 1.0 + shape;
            if (s >= limit) {
                return 0.0;
            }
            // Between the limits the two distributions differ by a part of r²/3 then, which is rounding. In the
            // outermost part, of width 2r, 1 + r − s would keep fewer than nine digits.
            if (shape < 1e-7) {  // the limits are known: uniform
                return s < 1.0 ? 0.5 * (1.0 - s) : 0.0;
            }
            if (s <= 1.0 - shape && shape < 1.0) {
                // Between the nearest positions of the limits the density of JCGM 101:2008, 6.4.3.3 is constant.
                return 0.5 - s * (std::log1p(shape) - std::log1p(-shape)) / (4.0 * shape);
            }
            // ∫ ln((1 + r)/t)/(4 r) dt from s to 1 + r = (1 + r)/(4 r) h(e),
            // h(e) = e + (1 − e) ln(1 − e) with e = 1 − s/(1 + r).
            return limit / (4.0 * shape) * curved_tail((limit - s) / limit);
        }
        case DistributionKind::student_t:
            return bm::cdf(bm::complement(StudentT(shape), s));
        default:
            return std::numeric_limits<double>::quiet_NaN();
    }
}

/// The s ≥ 0 with P(S > s) = q, 0 ≤ q ≤ 1/2, of the same.
double symmetric_quantile(const Distribution& distribution, double q) {
    const double shape = distribution.shape;
    if (q >= 0.5) {
        return 0.0;
    }
    switch (distribution.kind) {
        case DistributionKind::normal:
            return q > 0.0 ? std::numbers::sqrt2 * bm::erfc_inv(2.0 * q, QuantilePolicy()) : k_infinity;
        case DistributionKind::uniform:
            return 1.0 - 2.0 * q;
        case DistributionKind::triangular:
            return 1.0 - std::sqrt(2.0 * q);
        case DistributionKind::arcsine:
            // The same number twice: each form keeps its digits where the other cancels, near the limit and near the
            // middle.
            return q < 0.25 ? std::cos(k_pi * q) : std::sin(k_pi * (0.5 - q));
        case DistributionKind::trapezoidal: {
            const double slanted = (1.0 - shape) * (1.0 + shape);
            // The tail beyond the flat part, P(S > β) = (1 − β)/(2 (1 + β)), says on which part q lies.
            return 2.0 * q * (1.0 + shape) <= 1.0 - shape ? 1.0 - std::sqrt(2.0 * q * slanted)
                                                          : (0.5 - q) * (1.0 + shape);
        }
        case DistributionKind::curvilinear_trapezoid: {
            if (shape < 1e-7) {
                return 1.0 - 2.0 * q;
            }
            const double limit = 1.0 + shape;
            const double flat = 1.0 - shape;
            if (flat > 0.0) {
                const double s = (0.5 - q) * 4.0 * shape / (std::log1p(shape) - std::log1p(-shape));
                if (s <= flat) {
                    return s;
                }
            }
            return limit * (1.0 - inverse_curved_tail(q * 4.0 * shape / limit));
        }
        case DistributionKind::student_t:
            return q > 0.0 ? bm::quantile(bm::complement(StudentT(shape), q)) : k_infinity;
        default:
            return std::numeric_limits<double>::quiet_NaN();
    }
}

bool standard_is_symmetric(DistributionKind kind) {
    switch (kind) {
        case DistributionKind::normal:
        case DistributionKind::uniform:
        case DistributionKind::triangular:
        case DistributionKind::arcsine:
        case DistributionKind::trapezoidal:
        case DistributionKind::curvilinear_trapezoid:
        case DistributionKind::student_t:
            return true;
        default:
            return false;
    }
}

/// P(S ≤ s), or P(S > s) for `upper`.
double standard_tail(const Distribution& distribution, double s, bool upper) {
    if (standard_is_symmetric(distribution.kind)) {
        // The half on the side of s is the small one. The other one is 1 minus it and loses nothing, being 1/2 at
        // least.
        if (std::isinf(s)) {
            return (s > 0.0) == upper ? 0.0 : 1.0;
        }
        const double tail = symmetric_tail(distribution, std::abs(s));
        return (s > 0.0) == upper ? tail : 1.0 - tail;
    }
    const double shape = distribution.shape;
    const double below = upper ? 1.0 : 0.0;  // of a value under the lower limit
    const double above = 1.0 - below;
    switch (distribution.kind) {
        case DistributionKind::constant:
            return s < 0.0 ? below : above;
        // expm1 and log1p: 1 − e^(−s) would lose the digits of a small lower tail.
        case DistributionKind::exponential:
            return s <= 0.0 ? below : (upper ? std::exp(-s) : -std::expm1(-s));
        case DistributionKind::lognormal: {
            if (s <= 0.0) {
                return below;
            }
            const double z = std::log(s) / shape;
            return 0.5 * std::erfc((upper ? z : -z) / std::numbers::sqrt2);
        }
        case DistributionKind::gamma: {
            if (s <= 0.0 || std::isinf(s)) {
                return s <= 0.0 ? below : above;
            }
            const Gamma gamma(shape);
            return upper ? bm::cdf(bm::complement(gamma, s)) : bm::cdf(gamma, s);
        }
        case DistributionKind::beta: {
            if (s <= 0.0 || s >= 1.0) {
                return s <= 0.0 ? below : above;
            }
            const Beta beta(shape, distribution.second_shape);
            return upper ? bm::cdf(bm::complement(beta, s)) : bm::cdf(beta, s);
        }
        default:
            break;
    }
    const std::vector<double>& samples = *distribution.samples;
    // Equal samples all count on the side of "≤ s": P(X ≤ s) and P(X > s) then add up to 1.
    const auto first_above = std::upper_bound(samples.begin(), samples.end(), s);
    const auto count = upper ? samples.end() - first_above : first_above - samples.begin();
    return static_cast<double>(count) / static_cast<double>(samples.size());
}

/// The s with P(S ≤ s) = q, or with P(S > s) = q for `upper`.
double standard_quantile(const Distribution& distribution, double q, bool upper) {
    if (standard_is_symmetric(distribution.kind)) {
        // 1 − q is exact in double for q from 1/2 to 1: the upper half is the mirror of the lower one without a loss.
        const double s = q <= 0.5 ? symmetric_quantile(distribution, q) : -symmetric_quantile(distribution, 1.0 - q);
        return upper ? s : -s;
    }
    const double shape = distribution.shape;
    // q = 0 and q = 1 are the limits of the distribution, which no iteration of the library has to find.
    const double lower_limit = q == (upper ? 1.0 : 0.0) ? 1.0 : 0.0;
    const double upper_limit = q == (upper ? 0.0 : 1.0) ? 1.0 : 0.0;
    switch (distribution.kind) {
        case DistributionKind::constant:
            return 0.0;
        case DistributionKind::exponential:
            return upper ? -std::log(q) : -std::log1p(-q);
        case DistributionKind::lognormal: {
            const double z = q > 0.0 && q < 1.0 ? std::numbers::sqrt2 * bm::erfc_inv(2.0 * q, QuantilePolicy())
                                                : (q > 0.0 ? -k_infinity : k_infinity);
            return std::exp(shape * (upper ? z : -z));
        }
        case DistributionKind::gamma: {
            if (lower_limit > 0.0 || upper_limit > 0.0) {
                return lower_limit > 0.0 ? 0.0 : k_infinity;
            }
            const Gamma gamma(shape);
            return upper ? bm::quantile(bm::complement(gamma, q)) : bm::quantile(gamma, q);
        }
        case DistributionKind::beta: {
            if (lower_limit > 0.0 || upper_limit > 0.0) {
                return upper_limit;
            }
            const Beta beta(shape, distribution.second_shape);
            return upper ? bm::quantile(bm::complement(beta, q)) : bm::quantile(beta, q);
        }
        default:
            break;
    }
    const std::vector<double>& samples = *distribution.samples;
    const double n = static_cast<double>(samples.size());
    // Smallest k with k/n ≥ p, where p = q or 1 - q; the latter counted from above, because 1 - q would round.
    const double k = upper ? n - std::floor(q * n) : std::ceil(q * n);
    return samples[static_cast<std::size_t>(std::clamp(k, 1.0, n)) - 1];
}

double standard_density(const Distribution& distribution, double s) {
    const double shape = distribution.shape;
    const double size = std::abs(s);
    switch (distribution.kind) {
        case DistributionKind::normal:
            return std::exp(-0.5 * s * s) / std::sqrt(2.0 * k_pi);
        case DistributionKind::uniform:
            return size <= 1.0 ? 0.5 : 0.0;
        case DistributionKind::triangular:
            return size < 1.0 ? 1.0 - size : 0.0;
        case DistributionKind::arcsine:
            // (1 − s)(1 + s) keeps its digits at the limits, where the density becomes infinite and 1 − s² would
            // cancel.
            return size <= 1.0 ? 1.0 / (k_pi * std::sqrt((1.0 - size) * (1.0 + size))) : 0.0;
        case DistributionKind::trapezoidal: {
            if (size > 1.0) {
                return 0.0;
            }
            return size <= shape ? 1.0 / (1.0 + shape) : (1.0 - size) / ((1.0 - shape) * (1.0 + shape));
        }
        case DistributionKind::curvilinear_trapezoid:
            if (shape < 1e-7) {
                return size <= 1.0 ? 0.5 : 0.0;
            }
            // The innermost part is flat: there the logarithm is that of (1 + r)/(1 − r), whatever s is.
            return size < 1.0 + shape ? std::log((1.0 + shape) / std::max(1.0 - shape, size)) / (4.0 * shape) : 0.0;
        case DistributionKind::student_t:
            return std::isinf(s) ? 0.0 : bm::pdf(StudentT(shape), s);
        case DistributionKind::exponential:
            return s >= 0.0 ? std::exp(-s) : 0.0;
        case DistributionKind::lognormal: {
            if (!(s > 0.0) || std::isinf(s)) {
                return 0.0;
            }
            const double z = std::log(s) / shape;
            return std::exp(-0.5 * z * z) / (std::sqrt(2.0 * k_pi) * shape * s);
        }
        case DistributionKind::gamma:
            if (s < 0.0 || std::isinf(s)) {
                return 0.0;
            }
            // At its limit the density is infinite, 0 or finite: with the shape below, above or equal to 1.
            if (s == 0.0) {
                return shape < 1.0 ? k_infinity : (shape > 1.0 ? 0.0 : 1.0);
            }
            return bm::pdf(Gamma(shape), s);
        case DistributionKind::beta: {
            if (s < 0.0 || s > 1.0) {
                return 0.0;
            }
            const double end_shape = s == 0.0 ? shape : distribution.second_shape;
            if (s == 0.0 || s == 1.0) {
                return end_shape < 1.0 ? k_infinity : (end_shape > 1.0 ? 0.0 : shape + distribution.second_shape - 1.0);
            }
            return bm::pdf(Beta(shape, distribution.second_shape), s);
        }
        case DistributionKind::constant:
        case DistributionKind::empirical:
            break;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// What cannot be used of a distribution. No texts are made here: it is asked at each value of a tail.
struct Problem {
    const char* what;
    std::optional<double> value;
    const char* rule;
};

std::optional<Problem> problem_of(const Distribution& distribution) {
    const double shape = distribution.shape;
    const auto positive = [](const char* name, double value) -> std::optional<Problem> {
        if (value > 0.0 && std::isfinite(value)) {
            return std::nullopt;
        }
        return Problem{name, value, "must be finite and greater than 0"};
    };
    if (!std::isfinite(distribution.location)) {
        return Problem{"location", distribution.location, "must be finite"};
    }
    if (distribution.kind == DistributionKind::constant) {
        return distribution.scale == 0.0 ? std::nullopt
                                         : std::optional(Problem{"scale", distribution.scale, "a constant has none"});
    }
    if (const std::optional<Problem> problem = positive("scale", distribution.scale)) {
        return problem;
    }
    switch (distribution.kind) {
        case DistributionKind::trapezoidal:
        case DistributionKind::curvilinear_trapezoid:
            return shape >= 0.0 && shape <= 1.0 ? std::nullopt
                                                : std::optional(Problem{"shape", shape, "must be from 0 to 1"});
        case DistributionKind::student_t:
            return positive("degrees of freedom", shape);
        case DistributionKind::gamma:
        case DistributionKind::lognormal:
            return positive("shape", shape);
        case DistributionKind::beta: {
            const std::optional<Problem> problem = positive("shape alpha", shape);
            return problem ? problem : positive("shape beta", distribution.second_shape);
        }
        case DistributionKind::empirical: {
            if (!distribution.samples || distribution.samples->empty()) {
                return Problem{"no samples", std::nullopt, "needs at least one"};
            }
            const std::vector<double>& samples = *distribution.samples;
            if (!std::all_of(samples.begin(), samples.end(), [](double x) { return std::isfinite(x); })) {
                return Problem{"a sample that is not finite", std::nullopt, "samples must be finite"};
            }
            // Tails are counted and quantiles looked up by place.
            return std::is_sorted(samples.begin(), samples.end())
                       ? std::nullopt
                       : std::optional(Problem{"samples not in ascending order", std::nullopt, "must be sorted"});
        }
        default:
            return std::nullopt;
    }
}

void require_usable(const Distribution& distribution) {
    if (problem_of(distribution)) {
        refuse("GC-GUM-0124", "distribution " + std::string(distribution_name(distribution.kind)),
               distribution_problem(distribution), "a distribution needs parameters inside its range",
               "Correct the parameters.");
    }
}

void require_argument(bool usable, const char* name, double value, const char* rule) {
    if (!usable) {
        refuse("GC-GUM-0125", name, text::shortest(value), rule, "Correct the value.");
    }
}

double location_and_scale(const Distribution& distribution, double s) {
    return distribution.kind == DistributionKind::constant ? distribution.location
                                                           : distribution.location + distribution.scale * s;
}

double standardised(const Distribution& distribution, double x) {
    const double difference = x - distribution.location;
    // A constant has no scale to divide by: only the sign of the difference counts.
    return distribution.kind == DistributionKind::constant ? difference : difference / distribution.scale;
}

}  // namespace

std::string distribution_problem(const Distribution& distribution) {
    const std::optional<Problem> problem = problem_of(distribution);
    if (!problem) {
        return "";
    }
    const std::string value = problem->value ? " " + text::shortest(*problem->value) : "";
    return problem->what + value + "; " + problem->rule;
}

double lower_tail_probability(const Distribution& distribution, double x) {
    require_usable(distribution);
    require_argument(!std::isnan(x), "value", x, "a number is needed");
    return standard_tail(distribution, standardised(distribution, x), false);
}

double upper_tail_probability(const Distribution& distribution, double x) {
    require_usable(distribution);
    require_argument(!std::isnan(x), "value", x, "a number is needed");
    return standard_tail(distribution, standardised(distribution, x), true);
}

double probability_density(const Distribution& distribution, double x) {
    require_usable(distribution);
    require_argument(!std::isnan(x), "value", x, "a number is needed");
    return standard_density(distribution, standardised(distribution, x)) / distribution.scale;
}

double quantile(const Distribution& distribution, double p) {
    require_usable(distribution);
    require_argument(p >= 0.0 && p <= 1.0, "probability", p, "a probability lies between 0 and 1");
    return location_and_scale(distribution, standard_quantile(distribution, p, false));
}

double upper_quantile(const Distribution& distribution, double q) {
    require_usable(distribution);
    require_argument(q >= 0.0 && q <= 1.0, "probability", q, "a probability lies between 0 and 1");
    return location_and_scale(distribution, standard_quantile(distribution, q, true));
}

}  // namespace gumcert::gum
