#pragma once

#include <optional>
#include <vector>

#include "app/assigned_value.h"
#include "app/laboratory_data.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// One item in one round, evaluated.
struct EvaluatedItem {
    const LaboratoryData* data = nullptr;
    AssignedValue assigned;
    std::size_t first_point = 0;  ///< in Comparison::points; one a result of `data`
};

/// Row "all" of the scores: counts, mean, largest and rms |E_n| of all results, also as they would be with findings
/// corrected and for the worst plausible correlation. The band of the rms E_n, p_low and p_high only for one item in
/// one round, where the covariance of the differences is known: results of several items share their laboratories.
/// \return nothing where no result has an E_n
[[nodiscard]] std::optional<reports::ComparisonSummary> summary_of_scores(const reports::Comparison& comparison,
                                                                          const std::vector<EvaluatedItem>& items,
                                                                          double coverage_probability);

/// Every laboratory over all items and rounds, in the order of the job. How its results of several items correlate is
/// not known, so that p_low and p_high are left out.
[[nodiscard]] std::vector<reports::ParticipantSummary> participant_summaries(const engine::ComparisonJob& job,
                                                                             const reports::Comparison& comparison);

/// E_n of the vectors of the job for every laboratory and round with all their quantities. One whose covariance is
/// singular is left out.
/// \param left_out  receives how many were
[[nodiscard]] std::vector<reports::VectorScore> vector_scores(const engine::ComparisonJob& job,
                                                              const reports::Comparison& comparison,
                                                              std::size_t& left_out);

/// Youden diagrams of the pairs of items of the job, a round each. The ellipse holds 95 % of a bivariate normal
/// distribution about the medians, with the scaled median absolute deviations as standard deviations and
/// r = 2 sin(π ρ/6) from the rank correlation ρ of Spearman. No ellipse for fewer than three points or a scale of 0.
[[nodiscard]] std::vector<reports::YoudenDiagram> youden_diagrams(const engine::ComparisonJob& job,
                                                                  const reports::Comparison& comparison);

}  // namespace gumcert::app
