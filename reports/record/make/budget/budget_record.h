#pragma once

#include <string>
#include <vector>

#include "gum/budget/evaluate_budget.h"
#include "jobs/budget/budget_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The record of a budget job. Numbers are in the units of the job, and rounded here once for documents.
/// \param covariance      of all results, coherent SI (gum::budget_covariance); empty: too many results
/// \param covariance_file name of the CSV that will hold the covariance; "": it stands in the record
[[nodiscard]] reports::EvaluationRecord budget_record(const jobs::BudgetJob& job, const gum::BudgetResult& result,
                                                      const std::vector<reports::InputFile>& files,
                                                      const Eigen::MatrixXd& covariance,
                                                      const std::string& covariance_file);

/// The covariance of all results as CSV, in the products of their units.
[[nodiscard]] std::string budget_covariance_csv(const jobs::BudgetJob& job, const gum::BudgetResult& result,
                                                const Eigen::MatrixXd& covariance);

}  // namespace gumcert::reports
