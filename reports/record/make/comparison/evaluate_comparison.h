#pragma once

#include <string>
#include <vector>

#include "gum/quantity/progress.h"
#include "jobs/comparison/comparison_job.h"
#include "reports/record/evaluation_record.h"
#include "reports/record/make/comparison/refuted_side.h"

namespace gumcert::reports {

/// Evaluates a job of kind `comparison` and makes its record: between laboratories, or of two methods.
/// \param judges  of the jobs that are sides of a comparison of methods; needed where there are any
/// \throws InputError, NoResultError
[[nodiscard]] reports::EvaluationRecord evaluate_comparison(const jobs::ComparisonJob& job,
                                                            const std::vector<reports::InputFile>& files,
                                                            const gum::Progress& progress,
                                                            const JobJudges& judges = {});

/// `Comparison` of a job with `lab` and `reference`: reads their budgets, covariances and shared sources, and calls
/// compare_methods().
/// \param notes  receives what a person has to know beside the record
[[nodiscard]] reports::Comparison evaluate_methods(const jobs::ComparisonJob& job,
                                                   std::vector<gum::Diagnostic>* notes = nullptr,
                                                   const JobJudges& judges = {});

/// `Comparison` of a job with participants. Items for which nothing can be computed are listed in it.
/// \param notes  as above
/// \throws InputError, NoResultError  where no item has a result
[[nodiscard]] reports::Comparison evaluate_laboratories(const jobs::ComparisonJob& job, const gum::Progress& progress,
                                                        std::vector<gum::Diagnostic>* notes = nullptr);

}  // namespace gumcert::reports
