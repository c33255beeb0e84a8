#include "gum/coverage.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"
#include "text/degrees_of_freedom.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

// An overflow is reported as our own failure below, not as an exception of the library. Computed in double throughout:
// three times as fast as the library's default, which goes by long double, and within 1e-13 of it.
using Policy = boost::math::policies::policy<boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                             boost::math::policies::promote_double<false>>;
using NormalDistribution = boost::math::normal_distribution<double, Policy>;
using StudentDistribution = boost::math::students_t_distribution<double, Policy>;
using ChiSquareDistribution = boost::math::chi_squared_distribution<double, Policy>;
using FisherDistribution = boost::math::fisher_f_distribution<double, Policy>;

/// t with P(|T| ≤ t) = p for a small p. By the tails this is the difference of two numbers near one half, and loses the digits
/// that p is small by. The probability about 0 is concave in t, so that Newton's steps from the tangent at 0, which lies
/// below the quantile, rise to it.
/// \return  none: the steps did not end (ν far below 1)
std::optional<double> quantile_near_zero(double p, double degrees_of_freedom) {
    constexpr int k_most_steps = 50;
    if (std::isinf(degrees_of_freedom)) {
        return std::sqrt(2.0) * boost::math::erf_inv(p, Policy());
    }
    const StudentDistribution distribution(degrees_of_freedom);
    double t = p / (2.0 * boost::math::pdf(distribution, 0.0));
    for (int step = 0; step < k_most_steps; ++step) {
        const double square = t * t / degrees_of_freedom;
        if (!(square > std::numeric_limits<double>::epsilon())) {
            return t;  // the density is that at 0 to all digits
        }
        const double inside = boost::math::ibeta(0.5, 0.5 * degrees_of_freedom, square / (1.0 + square), Policy());
        const double change = (p - inside) / (2.0 * boost::math::pdf(distribution, t));
        if (!std::isfinite(change)) {
            break;  // a density that is no number so far out
        }
        t += change;
        if (std::abs(change) <= 4.0 * std::numeric_limits<double>::epsilon() * t) {
            return t;
        }
    }
    return std::nullopt;
}

NoResultError no_finite_factor(double coverage_probability, double degrees_of_freedom) {
    return NoResultError(Diagnostic{.code = "GC-GUM-0010",
                                    .where = "coverage factor",
                                    .what = "no finite value for coverage probability " +
                                            text::shortest(coverage_probability) + " and " +
                                            text::degrees_of_freedom(text::shortest(degrees_of_freedom)),
                                    .rule = "an expanded uncertainty needs a finite coverage factor",
                                    .action = "State the contribution with few degrees of freedom better."});
}

void require_chi_square_arguments(double chi_square, double degrees_of_freedom) {
    require_not_negative(chi_square, "chi-square");
    require_positive(degrees_of_freedom, "degrees of freedom of chi-square");
}

}  // namespace

double coverage_factor(double coverage_probability, double degrees_of_freedom) {
    require_probability(coverage_probability, "coverage probability");
    require_degrees_of_freedom(degrees_of_freedom, "degrees of freedom");
    // ln k is about −ln(1 − p)/ν for ν far below 1. Beyond e^355 the square of k, which the quantile goes by, is no double.
    constexpr double k_beyond_all = 400.0;
    if (-std::log1p(-coverage_probability) > k_beyond_all * degrees_of_freedom) {
        throw no_finite_factor(coverage_probability, degrees_of_freedom);
    }
    constexpr double k_small = 1e-3;  // above, the tails keep 13 digits
    if (coverage_probability < k_small) {
        if (const std::optional<double> near_zero = quantile_near_zero(coverage_probability, degrees_of_freedom)) {
            return *near_zero;
        }
    }
    // The probability outside one end of the interval; the upper tail keeps its digits when p is close to 1.
    const double tail = (1.0 - coverage_probability) / 2.0;
    if (std::isinf(degrees_of_freedom)) {
        return boost::math::quantile(boost::math::complement(NormalDistribution(), tail));
    }
    // ν as it is: the table of the GUM has whole numbers because it is a table.
    double k = std::numeric_limits<double>::infinity();
    try {
        k = boost::math::quantile(boost::math::complement(StudentDistribution(degrees_of_freedom), tail));
    } catch (const std::runtime_error&) {
        // The iteration of the library did not end: the same refusal as for an overflow.
    } catch (const std::domain_error&) {
        // Half of the smallest double is 0, and the library takes no 0 for degrees of freedom.
    }
    if (!std::isfinite(k)) {
        throw no_finite_factor(coverage_probability, degrees_of_freedom);
    }
    return k;
}

double ellipsoid_coverage_factor(double coverage_probability, std::size_t outputs, double degrees_of_freedom,
                                 EstimatedSpread estimated) {
    require_probability(coverage_probability, "coverage probability");
    require_degrees_of_freedom(degrees_of_freedom, "degrees of freedom");
    const auto m = static_cast<double>(outputs);
    require_positive(m, "number of outputs");
    const double tail = 1.0 - coverage_probability;
    if (std::isinf(degrees_of_freedom)) {
        return std::sqrt(boost::math::quantile(boost::math::complement(ChiSquareDistribution(m), tail)));
    }
    if (estimated == EstimatedSpread::scale) {
        // Of the multivariate t-distribution zᵀ z/m is F(m, ν), whatever the number of outputs.
        return std::sqrt(
            m * boost::math::quantile(boost::math::complement(FisherDistribution(m, degrees_of_freedom), tail)));
    }
    // Hotelling's T²: m ν/(ν + 1 − m) F(m, ν + 1 − m). With fewer degrees of freedom the estimated covariance matrix is
    // singular, and there is no ellipsoid.
    const double denominator = degrees_of_freedom + 1.0 - m;
    if (!(denominator > 0.0)) {
        throw NoResultError(Diagnostic{.code = "GC-GUM-0011",
                                       .where = "coverage region",
                                       .what = text::degrees_of_freedom(text::shortest(degrees_of_freedom)) + " for " +
                                               text::count_of(outputs, "output"),
                                       .rule = "a joint region needs more degrees of freedom than outputs less one",
                                       .action = "Take more observations, or report intervals of single outputs."});
    }
    double k = std::numeric_limits<double>::infinity();
    try {
        const double F = boost::math::quantile(boost::math::complement(FisherDistribution(m, denominator), tail));
        k = std::sqrt(m * degrees_of_freedom / denominator * F);
    } catch (const std::runtime_error&) {
        // As in coverage_factor().
    } catch (const std::domain_error&) {
    }
    if (!std::isfinite(k)) {
        throw no_finite_factor(coverage_probability, degrees_of_freedom);
    }
    return k;
}

double effective_degrees_of_freedom(std::span<const UncertaintyContribution> contributions) {
    double largest = 0.0;
    for (const UncertaintyContribution& contribution : contributions) {
        // A contribution counts by |c| u, so its sign has been lost before: a negative one is a mistake of the caller.
        require_not_negative(contribution.uncertainty, "uncertainty contribution");
        require_degrees_of_freedom(contribution.degrees_of_freedom, "degrees of freedom of a contribution");
        largest = std::max(largest, contribution.uncertainty);
    }
    if (largest == 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    // Relative to the largest contribution, because fourth powers of uncertainties in metres leave the range of double.
    double sum_of_squares = 0.0;
    for (const UncertaintyContribution& contribution : contributions) {
        const double ratio = contribution.uncertainty / largest;
        sum_of_squares += ratio * ratio;
    }
    double denominator = 0.0;
    for (const UncertaintyContribution& contribution : contributions) {
        const double ratio = contribution.uncertainty / largest;
        // JCGM 100:2008, G.4.1, eq. G.2b with shares of the variance: 1/ν_eff = Σ share_i²/ν_i.
        const double share = ratio * ratio / sum_of_squares;
        denominator += share * share / contribution.degrees_of_freedom;
    }
    return 1.0 / denominator;  // no finite ν_i: 1/0 = infinity
}

double chi_square_lower_tail(double chi_square, double degrees_of_freedom) {
    require_chi_square_arguments(chi_square, degrees_of_freedom);
    return boost::math::cdf(ChiSquareDistribution(degrees_of_freedom), chi_square);
}

double chi_square_upper_tail(double chi_square, double degrees_of_freedom) {
    require_chi_square_arguments(chi_square, degrees_of_freedom);
    return boost::math::cdf(boost::math::complement(ChiSquareDistribution(degrees_of_freedom), chi_square));
}

double two_sided_tail_of_t(double t, double degrees_of_freedom) {
    require_not_negative(t, "t");
    require_degrees_of_freedom(degrees_of_freedom, "degrees of freedom");
    if (std::isinf(degrees_of_freedom)) {
        return 2.0 * boost::math::cdf(boost::math::complement(NormalDistribution(), t));
    }
    return 2.0 * boost::math::cdf(boost::math::complement(StudentDistribution(degrees_of_freedom), t));
}

double standard_normal_quantile(double probability) {
    require_probability(probability, "probability");
    return boost::math::quantile(NormalDistribution(), probability);
}

double two_sided_normal_critical_value(double alpha) {
    require_probability(alpha, "alpha");
    // α/2 from above: 1 − α/2 would round a small α away.
    return boost::math::quantile(boost::math::complement(NormalDistribution(), alpha / 2.0));
}

}  // namespace gumcert::gum
