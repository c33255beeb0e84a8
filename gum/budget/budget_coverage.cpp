#include "gum/budget/budget_coverage.h"

#include <cmath>
#include <string>

#include "gum/coverage.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/rounding.h"
#include "text/counts.h"

namespace gumcert::gum {

namespace {

constexpr double k_rounding_of_degrees_of_freedom = 1e-12;  // 3.999…9 is 4

}  // namespace

std::string convolution_note(double degrees_of_freedom, double k) {
    return "k is taken from the convolution of all distributions; that of the " +
           std::string(std::isinf(degrees_of_freedom) ? "normal " : "t-") + "distribution would be " +
           round_to_quantum(k, 2);
}

void expand_by_propagation(const Budget& budget, const BudgetPointResult& point, Eigen::Index output,
                           BudgetOutputResult& result) {
    const double u = point.propagation.standard_uncertainty(output);
    result.standard_uncertainty = u;
    result.degrees_of_freedom = point.propagation.effective_degrees_of_freedom(output);
    if (const auto at = static_cast<std::size_t>(output);
        at < point.without_derivative.size() && point.without_derivative[at]) {
        result.coverage = "none";
        result.coverage_note =
            "the model has no derivative at these estimates, so that the law of propagation gives no uncertainty";
        return;
    }
    // A wrong k costs more than none: the Welch-Satterthwaite formula holds for independent contributions, and a group
    // without degrees of freedom has no place in it (ADR 0014).
    if (std::isnan(result.degrees_of_freedom)) {
        result.coverage = "none";
        Eigen::Index g = 0;
        for (const InputGroup& group : point.model->inputs()) {
            if (std::isnan(group.degrees_of_freedom) &&
                point.propagation.budget[static_cast<std::size_t>(g)].variance(output) > 0.0) {
                result.coverage_note = group.no_degrees_of_freedom_because;
            }
            ++g;
        }
        return;
    }
    // JCGM 100:2008, 5.1.2, note: where the first derivatives vanish, second-order terms are what is left.
    if (u == 0.0 && point.second_order && point.second_order->standard_uncertainty(output) > 0.0) {
        result.standard_uncertainty = point.second_order->standard_uncertainty(output);
        result.coverage = "none";
        result.coverage_note =
            "the first-order terms of the law of propagation vanish at these estimates; u is that of the second-order "
            "terms, and the distribution of the result is not known from them";
        return;
    }
    // One number of degrees of freedom for k, for what is printed and for a decision on conformity.
    double& nu = result.degrees_of_freedom;
    double k = coverage_factor(result.coverage_probability, nu);
    // Asked before anything is convolved: a bound from the shares and degrees of freedom of the contributions tells
    // that k cannot move by 1 %, and a budget without such inputs costs no more than before (ADR 0025).
    if (!convolution_changes_little(*point.model, point.propagation, output)) {
        const auto convolved = expand_by_convolution(*point.model, point.propagation, output);
        if (convolved && !std::isnan(convolved->asymmetry)) {
            result.asymmetry = convolved->asymmetry;
        }
        // k = 0 and U = 0 would say that nothing is uncertain (JCGM 100:2008, 6.2.1: the interval is of the values that
        // could reasonably be attributed to the measurand).
        if (convolved && !(convolved->expanded_uncertainty > 0.0)) {
            result.coverage = "none";
            result.coverage_note =
                "more than the coverage probability of the result is one value, so that its coverage interval has no "
                "width and U would be 0 although u is not";
            return;
        }
        if (convolved && is_noticed_change(convolved->coverage_factor, k)) {
            result.coverage = "convolution";
            result.coverage_note = convolution_note(nu, k);
            if (convolved->draws > 0) {
                result.k_numerical_error = convolved->numerical_error;
                result.coverage_note += "; the numerical error of k from " + text::count_of(convolved->draws, "draw") +
                                        " of correlated inputs is " + round_significant(convolved->numerical_error, 1);
            }
            result.coverage_factor = convolved->coverage_factor;
            result.expanded_uncertainty = convolved->expanded_uncertainty;
            return;
        }
    }
    result.coverage = std::isinf(nu) ? "normal" : "student_t";
    // Below 1 the next lower whole number is 0, for which there is no t-distribution.
    if (budget.truncate_degrees_of_freedom && std::isfinite(nu) && nu >= 1.0) {
        nu = std::floor(nu * (1.0 + k_rounding_of_degrees_of_freedom));
        k = coverage_factor(result.coverage_probability, nu);
        result.coverage_note = "k is taken for the next lower whole number of degrees of freedom";
    }
    result.coverage_factor = k;
    result.expanded_uncertainty = *result.coverage_factor * u;
}

}  // namespace gumcert::gum
