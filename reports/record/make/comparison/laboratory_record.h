#pragma once

#include "gum/comparison/laboratory_comparison.h"
#include "jobs/comparison/comparison_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The numbers of a comparison between laboratories as a record holds them, with their printed texts: items, points,
/// summaries, vectors, diagrams and shared sources. Nothing is computed here but texts.
/// \param job      whose scheme was evaluated
/// \param results  that were evaluated
[[nodiscard]] reports::Comparison laboratory_record(const jobs::ComparisonJob& job,
                                                    const std::vector<gum::ParticipantResult>& results,
                                                    const gum::LaboratoryComparison& comparison);

}  // namespace gumcert::reports
