#include "gum/comparison/random_effects.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "gum/argument_check.h"
#include "gum/comparison/correlated_results.h"
#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

using Eigen::ArrayXd;

void require_independent_results(const LaboratoryResults& results) {
    require_results(results);
    if (results.covariance.size() != 0) {
        refuse("GC-GUM-0139", "random-effects mean", "results with a covariance",
               "the variance between laboratories is defined here for results that are independent of each other",
               "Leave the correlations out, or take the weighted mean or the largest consistent subset.");
    }
}

/// Values less that of the most precise result, and their uncertainties, in a unit in which both are moderate.
struct ShiftedResults {
    double centre = 0.0, unit = 0.0;
    ArrayXd x = {}, variance = {};
};

ShiftedResults shifted(const LaboratoryResults& results) {
    ShiftedResults c{.centre = results.x(most_precise(results))};
    c.x = results.x.array() - c.centre;
    // 1/u² and the squares of the values then stay in the range of numbers, in any unit of the item.
    c.unit = std::max(c.x.abs().maxCoeff(), results.u.maxCoeff());
    c.x /= c.unit;
    c.variance = (results.u.array() / c.unit).square();
    return c;
}

/// Mean with weights 1/(u_i² + τ²) and the sum of weighted squares about it, in the unit of ShiftedResults.
struct WeightedSums {
    ArrayXd weights;
    double total = 0.0, mean = 0.0, squares = 0.0;
};

WeightedSums weighted_sums(const ShiftedResults& c, double between_variance) {
    WeightedSums sums{.weights = (c.variance + between_variance).inverse()};
    sums.total = sums.weights.sum();
    sums.mean = (sums.weights * c.x).sum() / sums.total;
    sums.squares = (sums.weights * (c.x - sums.mean).square()).sum();
    return sums;
}

double variance_of_values(const ShiftedResults& c) {
    return (c.x - c.x.mean()).square().sum() / static_cast<double>(c.x.size() - 1);
}

ReferenceValue random_effects_mean(const ShiftedResults& c, double between_variance) {
    const WeightedSums sums = weighted_sums(c, between_variance);
    const SplitNumber value = split_sum(c.centre, c.unit * sums.mean);
    return {.value = value.value,
            .u = c.unit / std::sqrt(sums.total),
            .weights = (sums.weights / sums.total).matrix(),
            .between_standard_deviation = c.unit * std::sqrt(between_variance),
            .rest = value.rest};
}

/// Σ (x_i − y)²/(u_i² + τ²) falls with τ². At τ² = s², the variance of the values, it is at most n − 1: the sum is the
/// least one over y, and with the arithmetic mean and without the u_i² it would be n − 1.
double mandel_paule_variance(const ShiftedResults& c) {
    const double target = static_cast<double>(c.x.size() - 1);
    const auto excess = [&](double between_variance) { return weighted_sums(c, between_variance).squares - target; };
    if (excess(0.0) <= 0.0) {
        return 0.0;
    }
    // Where all u_i vanish beside τ the root is s² itself: a little more, so that rounding does not put it outside.
    double high = variance_of_values(c) * (1.0 + 1e-9);
    double low = 0.5 * high;
    int steps = 0;
    constexpr double k_step = 1.0 / 64.0;
    constexpr int k_most_steps = 200;
    // In steps of a factor: τ² may be many powers of ten below s², and a bracket from 0 would leave the solver halving
    // it.
    while (excess(low) < 0.0) {
        high = low;
        low *= k_step;
        if (++steps > k_most_steps || low == 0.0) {
            return 0.0;  // far below the smallest u²: the sum is n − 1 but for rounding
        }
    }
    std::uintmax_t iterations = 200;
    // A few bits short of the last: the sum itself rounds by that much, and the solver would never end.
    boost::math::tools::eps_tolerance<double> narrow(std::numeric_limits<double>::digits - 3);
    const auto [below, above] = boost::math::tools::toms748_solve(excess, low, high, narrow, iterations);
    if (!narrow(below, above)) {
        throw NoResultError(Diagnostic{.code = "GC-GUM-0130",
                                       .where = "Mandel-Paule mean",
                                       .what = "the variance between laboratories did not converge",
                                       .rule = "Σ (x − y)²/(u² + τ²) must become n − 1",
                                       .action = "Review the uncertainties, or choose another reference value."});
    }
    return 0.5 * (below + above);
}

}  // namespace

ReferenceValue dersimonian_laird(const LaboratoryResults& results) {
    require_independent_results(results);
    const ShiftedResults c = shifted(results);
    const WeightedSums sums = weighted_sums(c, 0.0);
    const double nu = static_cast<double>(c.x.size() - 1);
    // Σw − Σw²/Σw = Σ w_i (1 − w_i/Σw), the sum of the others for 1 − w_i/Σw: nothing cancels where one w is large.
    double others = 0.0;
    double scale = 0.0;
    const ArrayXd share = sums.weights / sums.total;
    for (Eigen::Index i = 0; i < share.size(); ++i) {
        scale += 2.0 * sums.weights(i) * others;  // Σ_i Σ_j≠i w_i share_j, every pair twice
        others += share(i);
    }
    // Q below its expected value n − 1: the stated uncertainties already explain more than the scatter. A negative
    // variance would weigh the results as if they were better than stated.
    const double between_variance = std::max(0.0, (sums.squares - nu) / scale);
    return random_effects_mean(c, between_variance);
}

double hartung_knapp_u(const LaboratoryResults& results, const ReferenceValue& mean) {
    require_independent_results(results);
    require_finite(mean.value, "value of the mean");
    require_not_negative(mean.between_standard_deviation, "standard deviation between laboratories");
    const ShiftedResults c = shifted(results);
    const double tau = mean.between_standard_deviation / c.unit;
    const WeightedSums sums = weighted_sums(c, tau * tau);
    const double away = (mean.value - c.centre) / c.unit - sums.mean;
    // About the value that was handed in; for a mean of this kind `away` is its rounding, which must not count.
    const double rounding = 1e-12 * (1.0 + std::abs(mean.value) / c.unit);
    const double squares = sums.squares + (std::abs(away) <= rounding ? 0.0 : sums.total * away * away);
    return c.unit * std::sqrt(squares / (static_cast<double>(c.x.size() - 1) * sums.total));
}

double cochran_between_standard_deviation(const LaboratoryResults& results) {
    require_independent_results(results);
    const ShiftedResults c = shifted(results);
    return c.unit * std::sqrt(std::max(0.0, variance_of_values(c) - c.variance.mean()));
}

ReferenceValue mandel_paule(const LaboratoryResults& results) {
    require_independent_results(results);
    const ShiftedResults c = shifted(results);
    return random_effects_mean(c, mandel_paule_variance(c));
}

ReferenceValue power_moderated_mean(const LaboratoryResults& results) {
    require_results(results);
    return power_moderated_mean(results, 2.0 - 3.0 / static_cast<double>(results.x.size()));
}

ReferenceValue power_moderated_mean(const LaboratoryResults& results, double alpha) {
    require_independent_results(results);
    if (!(alpha >= 0.0 && alpha <= 2.0)) {
        refuse("GC-GUM-0137", "power of the power-moderated mean", text::shortest(alpha), "must lie between 0 and 2",
               "Take 2 - 3/n for n results, or leave it out.");
    }
    const ShiftedResults c = shifted(results);
    const double n = static_cast<double>(c.x.size());
    const double between_variance = mandel_paule_variance(c);
    const double of_arithmetic_mean = variance_of_values(c) / n;
    const double of_mandel_paule_mean = 1.0 / weighted_sums(c, between_variance).total;
    // The larger of the two: stated uncertainties that are too small must not make the characteristic one too small as
    // well.
    const double characteristic = n * std::max(of_arithmetic_mean, of_mandel_paule_mean);  // S²
    // In units of S² the weight 1/(√(u² + s²)^α S^(2−α)) is ((u² + s²)/S²)^(−α/2)/S², a power of a plain number; hence
    // u² = S²/Σ below.
    const ArrayXd weights = ((c.variance + between_variance) / characteristic).pow(-0.5 * alpha);
    const double total = weights.sum();
    const double mean = (weights * c.x).sum() / total;
    const SplitNumber value = split_sum(c.centre, c.unit * mean);
    return {.value = value.value,
            .u = c.unit * std::sqrt(characteristic / total),
            .weights = (weights / total).matrix(),
            .between_standard_deviation = c.unit * std::sqrt(between_variance),
            .rest = value.rest};
}

}  // namespace gumcert::gum
