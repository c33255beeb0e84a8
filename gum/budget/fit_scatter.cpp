#include "gum/budget/fit_scatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "gum/coverage.h"
#include "gum/quantity/decimal_rounding.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"

namespace gumcert::gum {

bool is_without_scatter(const BudgetFit& fit, const engine::CurveFit& solved) {
    // Where the curve goes through all points, what is left are roundings of terms as large as the ordinates.
    constexpr double k_roundings = 64.0;
    if (fit.y_uncertainty.size() > 0 || solved.residuals.size() == 0) {
        return false;
    }
    const double largest = fit.y.cwiseAbs().maxCoeff();
    return solved.residuals.cwiseAbs().maxCoeff() <= k_roundings * std::numeric_limits<double>::epsilon() * largest;
}

namespace {

/// The smallest standard uncertainty among data; 0 without any.
double least_uncertainty(const Eigen::MatrixXd& uncertainty) {
    if (uncertainty.size() == 0) {
        return 0.0;
    }
    return uncertainty.cols() == 1 ? uncertainty.col(0).minCoeff()
                                   : std::sqrt(std::max(0.0, uncertainty.diagonal().minCoeff()));
}

/// How far data may be from the decimal numbers that were written.
double rounding_of(const Eigen::Ref<const Eigen::VectorXd>& data, const Unit& unit) {
    double most = 0.0;
    for (const double value : data) {
        most = std::max(most, unit.difference_to_si(decimal_rounding(unit.from_si(value))));
    }
    return most;
}

}  // namespace

std::optional<Diagnostic> lost_digits_message(const BudgetFit& fit, const engine::CurveFit& solved) {
    std::string name = fit.ordinate;
    const Unit* unit = &fit.ordinate_unit;
    double u = least_uncertainty(fit.y_uncertainty);
    // No stated u: the residuals say how well the data are known.
    if (u == 0.0 && solved.degrees_of_freedom > 0.0) {
        u = std::sqrt(solved.residuals.squaredNorm() / solved.degrees_of_freedom);
    }
    double lost = rounding_of(fit.y, *unit);
    if (const double u_x = least_uncertainty(fit.x_uncertainty); u_x > 0.0) {
        const double lost_x = rounding_of(fit.x.col(0), fit.regressor_units.front());
        // Of ordinate and regressor the one that loses more against its own uncertainty is told.
        if (lost_x * u > lost * u_x) {
            name = fit.regressors.front();
            unit = &fit.regressor_units.front();
            lost = lost_x;
            u = u_x;
        }
    }
    if (!(u > 0.0) || !(lost > k_accepted_rounding * u)) {
        return std::nullopt;
    }
    return Diagnostic{.code = "GC-BUDGET-0034",
                      .where = "fit " + fit.name,
                      .what = "the digits of the data of " + name + " are held to ±" +
                              round_significant(unit->difference_from_si(lost), 2) +
                              " only, and their standard uncertainty is " +
                              round_significant(unit->difference_from_si(u), 2),
                      .rule = "a number has about 16 digits; what is lost of it must be small beside its uncertainty",
                      .action = "Subtract a whole number from the data, and add it as a constant in the model.",
                      .severity = Severity::warning};
}

Diagnostic no_scatter_message(const BudgetFit& fit) {
    return {.code = "GC-BUDGET-0036",
            .where = fit.where.empty() ? "fit " + fit.name : fit.where,
            .what = "all residuals are 0: the parameters have no uncertainty that could be found from them",
            .rule = "residuals of 0 say that the scatter is below the resolution, not that there is none",
            .action = "State the standard uncertainty of the data, with the resolution in it: \"u_" + fit.ordinate +
                      "\" in \"data\".",
            .severity = Severity::warning};
}

bool keeps_stated_uncertainties(const BudgetFit& fit, const engine::CurveFit& solved) {
    // A test on one side: residuals that are too large enlarge the uncertainty, as asked. Only to make it smaller takes
    // more than a χ² that is below its expected value by chance.
    return fit.scale_by_residuals && fit.y_uncertainty.size() > 0 && solved.degrees_of_freedom > 0.0 &&
           chi_square_lower_tail(solved.sum_of_squares, solved.degrees_of_freedom) < k_fit_overstated_level;
}

Diagnostic kept_uncertainties_message(const BudgetFit& fit) {
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
            .severity = Severity::warning};
}

}  // namespace gumcert::gum
