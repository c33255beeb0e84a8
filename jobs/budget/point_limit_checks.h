#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/unit.h"
#include "jobs/budget/budget_job.h"
#include "jobs/json_object.h"

namespace gumcert::jobs {

/// Results with their units: of each section, or of the whole job as one.
using ResultsOfSections = std::vector<std::vector<std::pair<std::string, gum::Unit>>>;

/// Whether specifications can be held against the points of a table as they stand: every point has limits, and they are those that
/// are meant for it. A slip of the pen in the word of a range, limits about a nominal value for an error, and limits that the
/// points state and no specification takes would give verdicts by other limits, without a word.
void check_point_limits(const JsonDocument& document, const BudgetJob& job, const ResultsOfSections& results,
                        ProblemList& problems);

}  // namespace gumcert::jobs
