#pragma once

#include <Eigen/Core>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "certificate/capability_inputs.h"
#include "gum/circle_closure/evaluate_circle_closure.h"
#include "jobs/circle_closure/circle_closure_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Names of the deviations: "EAA", "EBB" or "ECC" of a table whose axis is stated, else "T"; "P" of the artefact.
[[nodiscard]] std::string table_quantity(const jobs::CircleClosureJob& job);
inline constexpr const char* k_artefact_quantity = "P";

/// Names of all results in their order: "EAA[30]" …, "P[30]" …, "range_EAA", "range_P".
[[nodiscard]] std::vector<std::string> circle_closure_result_names(const jobs::CircleClosureJob& job);

/// The record of a job of kind `circle_closure`, in the unit of the job.
/// \param covariance_file  name of the CSV that will hold the covariance; "": it stands in the record
[[nodiscard]] reports::EvaluationRecord circle_closure_record(const jobs::CircleClosureJob& job,
                                                              const gum::CircleClosureResult& result,
                                                              const std::vector<reports::InputFile>& files,
                                                              const std::string& covariance_file);

/// Of the results that are neither normal nor have a t-distribution, by their names; x in the unit of the job. For
/// decisions on conformity.
[[nodiscard]] std::map<std::string, std::function<certificate::ResultDistribution()>> circle_closure_distributions(
    const jobs::CircleClosureJob& job, const gum::CircleClosureResult& result);

/// The covariance of all results as CSV, in the square of their unit.
[[nodiscard]] std::string circle_closure_covariance_csv(const jobs::CircleClosureJob& job,
                                                        const gum::CircleClosureResult& result);

}  // namespace gumcert::reports
