#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "gum/comparison/shared_sources.h"
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
    std::vector<std::string> remarks;
};

/// A method whose values and uncertainties follow from a budget.
struct MethodBudget {
    const jobs::BudgetJob& job;
    std::string file;                ///< for messages
    std::string method;              ///< its name, for remarks
    std::vector<std::size_t> point;  ///< one a point of the comparison: its position in the table of points
    std::vector<std::string> name;   ///< one a point, for messages; "": the budget has one result
};

/// Evaluates the one output of the budget at all points, with the coverage probability of the comparison.
/// \param unit  of the comparison, of the kind of that output; the readers of jobs see to both
/// \throws NoResultError  GC-COMPARE-0205 no expanded uncertainty at a point, -0206 an uncertainty of 0; those of
///                        gum::evaluate_budget()
[[nodiscard]] MethodSide side_of_budget(const MethodBudget& budget, const gum::Unit& unit, double coverage_probability);

}  // namespace gumcert::reports
