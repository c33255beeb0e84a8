#include "reports/record/make/comparison/method_side.h"

#include <algorithm>
#include <map>
#include <utility>

#include "gum/budget/budget_covariance.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/make/budget/budget_record.h"
#include "reports/record/make/comparison/budget_sources.h"

namespace gumcert::reports {

namespace {

std::string place_of(const MethodBudget& budget, std::size_t i) {
    return budget.name[i].empty() ? budget.file : budget.file + ", point " + budget.name[i];
}

[[noreturn]] void refuse_point(const MethodBudget& budget, std::size_t i, const std::string& code,
                               const std::string& what, const std::string& rule, const std::string& action) {
    throw gum::NoResultError(
        gum::Diagnostic{.code = code, .where = place_of(budget, i), .what = what, .rule = rule, .action = action});
}

gum::ResultUncertainty uncertainty_at(const MethodBudget& budget, std::size_t i, const gum::BudgetOutputResult& output,
                                      const gum::Unit& unit) {
    if (!output.expanded_uncertainty || !output.coverage_factor) {
        refuse_point(budget, i, "GC-COMPARE-0205", "no expanded uncertainty can be stated: " + output.coverage_note,
                     "a comparison needs the expanded uncertainty of both values",
                     "State inputs from which a coverage factor follows.");
    }
    if (!(output.standard_uncertainty > 0.0)) {
        refuse_point(budget, i, "GC-COMPARE-0206", "the standard uncertainty is 0",
                     "a measured value has an uncertainty", "State it in the budget.");
    }
    return {.u = unit.difference_from_si(output.standard_uncertainty),
            .U = unit.difference_from_si(*output.expanded_uncertainty),
            .k = *output.coverage_factor,
            .degrees_of_freedom = output.degrees_of_freedom};
}

/// One remark for each kind of note; a budget says the same at many points.
void add_notes(const MethodBudget& budget, const std::vector<gum::Diagnostic>& notes,
               std::vector<std::string>& remarks) {
    std::map<std::string, std::size_t> count;
    for (const gum::Diagnostic& note : notes) {
        ++count[note.code];
    }
    for (const gum::Diagnostic& note : notes) {
        const std::size_t of_kind = std::exchange(count[note.code], 0);
        if (of_kind > 0) {
            remarks.push_back("Budget of " + budget.method + ": " + gum::message(note) +
                              (of_kind == 1 ? "" : " (and " + std::to_string(of_kind - 1) + " more of this kind)"));
        }
    }
}

}  // namespace

MethodSide side_of_budget(const MethodBudget& budget, const gum::Unit& unit, double coverage_probability) {
    jobs::BudgetJob job = budget.job;
    // U of both sides for one probability; Monte Carlo of single points would not be looked at.
    job.coverage_probability = coverage_probability;
    for (gum::BudgetOutput& output : job.outputs) {
        output.coverage_probability.reset();
        output.coverage.reset();
    }
    job.monte_carlo.reset();
    // A covariance between points, and shared sources, are those of the law of propagation.
    job.coverage = gum::CoverageChoice::law_of_propagation;
    gum::BudgetResult result = gum::evaluate_budget(job, 1);
    for (gum::BudgetPointResult& point : result.points) {
        point.outputs.front().unit = unit;  // the rows of its table as well are in the unit of the comparison
    }
    const Eigen::MatrixXd covariance = gum::budget_covariance(result);
    MethodSide side;
    std::vector<Eigen::Index> rows;
    std::size_t largest = 0;
    for (std::size_t i = 0; i < budget.point.size(); ++i) {
        const std::size_t at = budget.point[i];
        const gum::BudgetPointResult& point = result.points[at];
        rows.push_back(static_cast<Eigen::Index>(at));
        side.value.push_back(unit.from_si(point.propagation.value(0)));
        side.uncertainty.push_back(uncertainty_at(budget, i, point.outputs.front(), unit));
        side.sources.all.push_back(uncertainty_sources(job, result, at, 0, unit));
        side.sources.common.push_back(uncertainty_sources(job, result, at, 0, unit, true));
        largest = side.uncertainty[i].u > side.uncertainty[largest].u ? i : largest;
    }
    const double scale = unit.difference_from_si(1.0);
    side.covariance = covariance(rows, rows) * scale * scale;
    reports::EvaluationRecord of_budget = budget_record(job, result, {}, {}, "");
    side.budget = std::move(of_budget.results[budget.point[largest]].budget);
    side.remarks.push_back("Values and uncertainties of " + budget.method + " come from the budget " + budget.file +
                           (budget.point.size() == 1
                                ? "."
                                : ", evaluated at every point; the table of it is that of the point with the largest "
                                  "uncertainty, " +
                                      budget.name[largest] +
                                      ". What its inputs have in common between the points is in their covariance."));
    add_notes(budget, result.notes, side.remarks);
    return side;
}

}  // namespace gumcert::reports
