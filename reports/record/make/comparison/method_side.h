#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "gum/comparison/shared_sources.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/budget/budget_job.h"
#include "jobs/comparison/comparison_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// One method at all points of a comparison, in the unit of the comparison.
struct MethodSide {
    std::vector<double> value;
    std::vector<gum::ResultUncertainty> uncertainty;
    Eigen::MatrixXd covariance;              ///< m×m
    std::vector<reports::BudgetRow> budget;  ///< at the point with the largest uncertainty; empty without one
    gum::PointSources sources;               ///< of its budget; empty without one
    /// Sources of its budget that a result of Monte Carlo depends on in a way that first-order terms do not tell: what
    /// the result has in common with another one through them is not known.
    std::set<std::string> not_linear_in;
    std::string origin;                     ///< where its numbers come from, a sentence; "" where the job states them
    std::vector<std::string> remarks;       ///< what its evaluation says beside
    std::vector<RefutedSide> refuted;       ///< what its evaluation says against its own numbers
    std::vector<gum::Diagnostic> warnings;  ///< of the evaluation of its job
};

/// A method whose values and uncertainties follow from a budget.
struct MethodBudget {
    const jobs::BudgetJob& job;
    std::string file;                ///< for messages
    std::string method;              ///< its name, for remarks
    std::vector<std::size_t> point;  ///< one a point of the comparison: its position in the table of points
    std::vector<std::string> name;   ///< one a point, for messages; "": the budget has one result
};

/// Evaluates the one output of the budget at all points, as the budget does by itself: value, u, U and k are what it
/// reports, by the law of propagation or by Monte Carlo, and what it says of them goes along (ADR 0070).
///
/// Where Monte Carlo reports an interval that is not symmetric about the value, U is that of
/// gum::expanded_about_value(). Where U covers another probability than about 95 %, `of_scores` is U for the probability
/// of the scores, from the same distribution.
/// \param unit  of the comparison, of the kind of that output; the readers of jobs see to both
/// \param coverage_probability  of the comparison
/// \throws NoResultError  GC-COMPARE-0205 no expanded uncertainty at a point, -0206 an uncertainty of 0, -0208 no
///                        standard uncertainty, -0209 no covariance of the points; those of gum::evaluate_budget()
[[nodiscard]] MethodSide side_of_budget(const MethodBudget& budget, const gum::Unit& unit, double coverage_probability);

/// What an evaluation says, as remarks: one for each kind of message, for a budget says the same at many points.
/// \param whose  what they begin with, "Budget of Method"
void add_remarks_of_evaluation(const std::string& whose, const std::vector<gum::Diagnostic>& notes,
                               std::vector<std::string>& remarks);

/// GC-COMPARE-0210: a result of Monte Carlo is not linear in a source that another result has too.
[[nodiscard]] gum::Diagnostic covariance_not_known(const std::string& where, const std::string& whose,
                                                   const std::string& source);

}  // namespace gumcert::reports
