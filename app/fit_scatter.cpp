#include "app/fit_scatter.h"

#include <algorithm>
#include <limits>

#include "app/budget_fit_record.h"
#include "gum/coverage.h"

namespace gumcert::app {

bool is_without_scatter(const engine::BudgetFit& fit, const engine::CurveFit& solved) {
    constexpr double k_roundings = 64.0;
    if (fit.y_uncertainty.size() > 0 || solved.residuals.size() == 0) {
        return false;
    }
    const double largest = fit.y.cwiseAbs().maxCoeff();
    return solved.residuals.cwiseAbs().maxCoeff() <= k_roundings * std::numeric_limits<double>::epsilon() * largest;
}

gum::Diagnostic no_scatter_message(const engine::BudgetFit& fit) {
    return {.code = "GC-BUDGET-0036",
            .where = fit.where.empty() ? "fit " + fit.name : fit.where,
            .what = "all residuals are 0: the parameters have no uncertainty that could be found from them",
            .rule = "residuals of 0 say that the scatter is below the resolution, not that there is none",
            .action = "State the standard uncertainty of the data, with the resolution in it: \"u_" + fit.ordinate +
                      "\" in \"data\".",
            .severity = gum::Severity::warning};
}

bool keeps_stated_uncertainties(const engine::BudgetFit& fit, const engine::CurveFit& solved) {
    return fit.scale_by_residuals && fit.y_uncertainty.size() > 0 && solved.degrees_of_freedom > 0.0 &&
           gum::chi_square_lower_tail(solved.sum_of_squares, solved.degrees_of_freedom) < k_fit_overstated_level;
}

gum::Diagnostic kept_uncertainties_message(const engine::BudgetFit& fit) {
    return {.code = "GC-BUDGET-0035",
            .where = "fit " + fit.name,
            .what =
                "the residuals are far smaller than the stated uncertainties of the data: these hold, and are not "
                "scaled",
            .rule =
                "\"scale_by_residuals\" lowers no uncertainty that the residuals refute as too large: by chance "
                "alone this happens less than once in a hundred fits",
            .action =
                "State the uncertainties that the data have, or leave them out where the residuals alone are to "
                "give them.",
            .severity = gum::Severity::warning};
}

}  // namespace gumcert::app
