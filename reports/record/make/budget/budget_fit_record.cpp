#include "reports/record/make/budget/budget_fit_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gum/budget/fit_scatter.h"
#include "gum/coverage.h"
#include "gum/propagation.h"
#include "gum/rounding.h"
#include "reports/record/make/budget/budget_texts.h"
#include "reports/record/make/record_parts.h"

namespace gumcert::reports {

namespace {

using gum::Unit;
using reports::BudgetRow;
using reports::FitSummary;

constexpr int k_digits_of_residual = 3;

std::string fit_method(const gum::BudgetFit& fit) {
    if (fit.x_uncertainty.size() > 0) {
        return "errors in both variables";
    }
    if (fit.y_uncertainty.size() == 0) {
        return "ordinary";
    }
    return fit.y_uncertainty.cols() == 1 ? "weighted" : "generalised";
}

bool is_weighted(const gum::BudgetFit& fit) {
    return fit.y_uncertainty.size() > 0 || fit.x_uncertainty.size() > 0;
}

/// Standard uncertainties of n values from n×1 standard uncertainties or an n×n covariance; empty: none stated.
std::vector<double> standard_uncertainties(const Eigen::MatrixXd& stated, const Unit& unit) {
    std::vector<double> list;
    const bool is_covariance = stated.cols() > 1;
    for (Eigen::Index i = 0; i < stated.rows(); ++i) {
        list.push_back(unit.difference_from_si(is_covariance ? std::sqrt(stated(i, i)) : stated(i, 0)));
    }
    return list;
}

/// Numbers and their texts, each made by itself.
template <class Print>
Shown<std::vector<double>> shown(std::vector<double> numbers, const Print& print) {
    std::vector<std::string> texts;
    texts.reserve(numbers.size());
    for (const double number : numbers) {
        texts.push_back(print(number));
    }
    return {std::move(numbers), std::move(texts)};
}

/// Data of one column of a fit, with equal decimals.
Shown<std::vector<double>> shown_series(std::vector<double> numbers, const gum::BudgetFit& fit, std::size_t column) {
    std::vector<std::string> texts = series_as_stated(numbers, column < fit.decimals.size() ? fit.decimals[column] : 0);
    return {std::move(numbers), std::move(texts)};
}

std::string printed_u(double u) {
    return rounded(u, k_digits_of_u);
}

void add_parameters(const gum::BudgetFit& fit, const engine::CurveFit& solved, FitSummary& summary) {
    const auto p = static_cast<Eigen::Index>(fit.parameters.size());
    Eigen::MatrixXd covariance = solved.covariance;
    const auto unit_of = [&](Eigen::Index i) { return fit.parameters[static_cast<std::size_t>(i)].unit; };
    for (Eigen::Index i = 0; i < p; ++i) {
        for (Eigen::Index j = 0; j < p; ++j) {
            covariance(i, j) = unit_of(i).difference_from_si(unit_of(j).difference_from_si(covariance(i, j)));
        }
    }
    const Eigen::MatrixXd correlation = gum::correlation_matrix(solved.covariance);
    for (Eigen::Index i = 0; i < p; ++i) {
        const gum::BudgetFit::Parameter& from = fit.parameters[static_cast<std::size_t>(i)];
        FitSummary::Parameter parameter;
        parameter.name = from.name;
        parameter.unit = from.unit.text();
        const double value = from.unit.from_si(solved.parameters(i));
        const double u = from.unit.difference_from_si(std::sqrt(solved.covariance(i, i)));
        parameter.value = {value, printed_estimate(value, u)};
        parameter.u = shown_significant(u, reports::k_digits_of_u);
        parameter.printed_unit = gum::unit_for_people(from.unit.text());
        if (summary.consistency == "refuted") {
            parameter.scaled_u = shown_significant(u * solved.residual_standard_deviation, reports::k_digits_of_u);
        }
        summary.parameters.push_back(std::move(parameter));
        std::vector<double> row;
        std::vector<double> correlations;
        for (Eigen::Index j = 0; j < p; ++j) {
            row.push_back(covariance(i, j));
            correlations.push_back(correlation(i, j));
        }
        summary.covariance.push_back(std::move(row));
        summary.correlation.push_back(std::move(correlations));
    }
}

void add_data(const gum::BudgetFit& fit, const engine::CurveFit& solved, FitSummary& summary) {
    summary.y_name = fit.ordinate;
    summary.y_unit = fit.ordinate_unit.text();
    const auto column = [&](std::size_t regressor) {
        std::vector<double> values;
        for (Eigen::Index i = 0; i < fit.x.rows(); ++i) {
            values.push_back(fit.regressor_units[regressor].from_si(fit.x(i, static_cast<Eigen::Index>(regressor))));
        }
        return values;
    };
    if (fit.regressors.size() == 1) {
        summary.x_name = fit.regressors.front();
        summary.x_unit = fit.regressor_units.front().text();
        summary.x = shown_series(column(0), fit, 0);
        summary.u_x = shown(standard_uncertainties(fit.x_uncertainty, fit.regressor_units.front()), printed_u);
    } else {
        for (std::size_t q = 0; q < fit.regressors.size(); ++q) {
            summary.regressors.push_back({.name = fit.regressors[q],
                                          .unit = fit.regressor_units[q].text(),
                                          .values = shown_series(column(q), fit, q)});
        }
    }
    std::vector<double> y;
    for (Eigen::Index i = 0; i < fit.y.size(); ++i) {
        y.push_back(fit.ordinate_unit.from_si(fit.y(i)));
        summary.fitted.push_back(fit.ordinate_unit.from_si(fit.y(i) - solved.residuals(i)));
        summary.residual.number.push_back(fit.ordinate_unit.difference_from_si(solved.residuals(i)));
        summary.residual.text.push_back(rounded(summary.residual.number.back(), k_digits_of_residual));
    }
    summary.y = shown_series(std::move(y), fit, fit.regressors.size());
    summary.u_y = shown(standard_uncertainties(fit.y_uncertainty, fit.ordinate_unit), printed_u);
}

/// A row without a value of its own: what something makes of the uncertainty of the result.
BudgetRow joint_row(const std::string& name, const std::string& role, double variance_si, double nu, bool is_scaled,
                    const Unit& unit, double result_u) {
    BudgetRow row;
    row.input = name;
    row.role = role;
    row.unit = unit.text();
    const double contribution_si = std::sqrt(std::max(0.0, variance_si));
    row.contribution = shown_significant(unit.difference_from_si(contribution_si), reports::k_digits_of_u);
    row.u.number = row.contribution.number;
    row.nu = shown_degrees_of_freedom(nu);
    row.type = is_scaled ? "A" : "B";
    row.distribution = is_scaled ? "student_t" : "normal";
    const double ratio = result_u > 0.0 ? contribution_si / result_u : 0.0;  // nothing to share of 0
    row.share = shown_share(ratio * ratio);
    return row;
}

}  // namespace

FitSummary fit_summary(const gum::BudgetFit& fit, const engine::CurveFit& solved) {
    FitSummary summary;
    summary.name = fit.name;
    summary.equation = fit.equation.text;
    summary.method = fit_method(fit);
    const bool weighted = is_weighted(fit);
    const auto in_y = [&](double si) { return weighted ? si : fit.ordinate_unit.difference_from_si(si); };
    summary.degrees_of_freedom = solved.degrees_of_freedom;
    summary.sum_of_squares = shown_significant(in_y(in_y(solved.sum_of_squares)), 3);
    summary.residual_standard_deviation = shown_significant(in_y(solved.residual_standard_deviation), 3);
    summary.condition_number = solved.condition_number;
    summary.iterations = solved.iterations;
    summary.covariance_scaled = solved.covariance_scaled;
    if (solved.r_squared) {
        summary.r_squared = shown_to_quantum(*solved.r_squared, 6);
    }
    if (weighted && !solved.covariance_scaled && solved.degrees_of_freedom > 0.0) {
        const double upper = gum::chi_square_upper_tail(solved.sum_of_squares, solved.degrees_of_freedom);
        const double lower = gum::chi_square_lower_tail(solved.sum_of_squares, solved.degrees_of_freedom);
        summary.p_value = {upper, printed_p_value(upper)};
        summary.consistency = upper < k_fit_test_level              ? "refuted"
                              : lower < gum::k_fit_overstated_level ? "overstated"
                                                                    : "consistent";
    }
    add_parameters(fit, solved, summary);
    add_data(fit, solved, summary);
    return summary;
}

BudgetRow fit_row(const gum::BudgetFit& fit, const engine::CurveFit& solved, const Eigen::VectorXd& sensitivity,
                  const Unit& result_unit, double result_u) {
    const bool scaled = solved.covariance_scaled;
    const double nu = scaled ? solved.degrees_of_freedom : std::numeric_limits<double>::infinity();
    // Sums of squares, by the factors that the law of propagation takes: the row is what the fit has in u².
    const double all = (solved.factor.transpose() * sensitivity).squaredNorm();
    const double by_x = solved.factor_by_x.size() == 0
                            ? 0.0
                            : std::min((solved.factor_by_x.transpose() * sensitivity).squaredNorm(), all);
    BudgetRow row = joint_row(fit.name, "fit", all, nu, scaled, result_unit, result_u);
    row.components.push_back(joint_row(fit.ordinate, "fit_data", all - by_x, nu, scaled, result_unit, result_u));
    if (solved.factor_by_x.size() != 0) {
        row.components.push_back(
            joint_row(fit.regressors.front(), "fit_data", by_x, nu, scaled, result_unit, result_u));
    }
    for (Eigen::Index i = 0; i < sensitivity.size(); ++i) {
        const gum::BudgetFit::Parameter& parameter = fit.parameters[static_cast<std::size_t>(i)];
        const double u = std::sqrt(solved.covariance(i, i));
        BudgetRow part =
            joint_row(parameter.name, "fit_parameter", sensitivity(i) * sensitivity(i) * solved.covariance(i, i), nu,
                      scaled, result_unit, result_u);
        part.unit = parameter.unit.text();
        const double value = parameter.unit.from_si(solved.parameters(i));
        part.u = shown_significant(parameter.unit.difference_from_si(u), reports::k_digits_of_u);
        part.value = {value, printed_estimate(value, part.u.number)};
        part.sensitivity =
            shown_significant(result_unit.difference_from_si(sensitivity(i) * parameter.unit.difference_to_si(1.0)), 4);
        part.contribution.text.clear();  // alone it says nothing: the parameters of a fit are correlated
        part.share.text.clear();
        row.components.push_back(std::move(part));
    }
    return row;
}

}  // namespace gumcert::reports
