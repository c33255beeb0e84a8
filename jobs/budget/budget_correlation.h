#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jobs/budget/budget_job.h"
#include "jobs/job_files.h"
#include "jobs/json_object.h"

namespace gumcert::jobs {

/// The covariance matrix of some inputs as the job states it, in products of their units.
struct StatedCovariance {
    std::vector<std::string> inputs;
    Eigen::MatrixXd matrix;  ///< n×n, symmetric, no negative diagonal element

    /// The variance of an input, [unit²]; nothing for an input that is not in it.
    [[nodiscard]] std::optional<double> variance_of(std::string_view input) const;
};

/// Reads the key `covariance`; problems go to the list.
/// \return nothing when it is absent or was refused
[[nodiscard]] std::optional<StatedCovariance> read_covariance(const JsonObject& root, const JsonDocument& document,
                                                              JobFiles& files, ProblemList& problems);

/// Takes the correlations of a job from `correlations`, `covariance` and `simultaneous`, and checks that they can hold
/// together: every cluster of correlated inputs has a positive semi-definite matrix.
///
/// \param positions  name → position in job.inputs, of the inputs that could be read
/// \param names      all names of inputs, those with problems of their own included
void read_correlations(const JsonObject& root, const JsonDocument& document,
                       const std::optional<StatedCovariance>& covariance,
                       const std::map<std::string, std::size_t>& positions, const std::vector<std::string>& names,
                       BudgetJob& job, ProblemList& problems);

}  // namespace gumcert::jobs
