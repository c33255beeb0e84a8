#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "gum/comparison/agreement.h"
#include "gum/comparison/assigned_value.h"
#include "gum/comparison/laboratory_data.h"
#include "gum/comparison/scored_result.h"
#include "gum/comparison/scores.h"

namespace gumcert::gum {

/// Companion numbers of the scores of all results.
struct ScoreSummary {
    ComparisonSummary scores;
    std::optional<EnVariant> worst = {};    ///< for the worst plausible correlation, where a result has such an E_n
    std::optional<EnVariant> audited = {};  ///< with findings corrected, where a result has such an E_n
    std::optional<double> d_fail_smallest = {}, d_fail_largest = {};  ///< where all items have one unit
    /// The band of the rms E_n, p_low and p_high, only for one item in one round, where the covariance of the
    /// differences is known: results of several items share their laboratories.
    std::optional<Agreement> agreement = {};
};

/// One item in one round with what its scores were computed from.
struct EvaluatedItem {
    LaboratoryData data;
    AssignedValue assigned;
    ItemResult result;
    std::vector<ScoredResult> scores;  ///< one a result of `data`
};

/// Counts, mean, largest and rms |E_n| of all results, also as they would be with findings corrected and for the worst
/// plausible correlation.
/// \return nothing where no result has an E_n
[[nodiscard]] std::optional<ScoreSummary> summary_of_scores(const ComparisonScheme& scheme,
                                                            const std::vector<EvaluatedItem>& items);

/// One laboratory over all items and rounds. How its results of several items correlate is not known, so that nothing
/// is said of their distribution.
struct ParticipantSummary {
    std::size_t results = 0, scored = 0, warnings = 0, actions = 0, inconclusive = 0;
    std::optional<ComparisonSummary> scores = {};  ///< of those with an E_n
};
/// \return one a participant of the scheme
[[nodiscard]] std::vector<ParticipantSummary> participant_summaries(const ComparisonScheme& scheme,
                                                                    const std::vector<EvaluatedItem>& items);

/// E_n of several quantities of one participant together.
struct VectorScore {
    std::size_t vector = 0, participant = 0, round = 0;  ///< positions in the scheme
    std::size_t quantities = 0;
    double mahalanobis_square = 0.0;  ///< Dᵀ V⁻¹ D, V of the standard uncertainties
    double vector_en = 0.0, largest_absolute_en = 0.0;
};
/// E_n of the vectors of the scheme for every laboratory and round with all their quantities. One whose covariance is
/// singular is left out.
///
/// √(Eᵀ R⁻¹ E) k_1/k_m, E the E_n of the m quantities, R the correlations of their differences, k_m the factor of the
/// joint region and k_1 that of one quantity, for the probability of E_n: of one quantity it is |E_n|. Where every U_D
/// is k_1 u_D, that is √(Dᵀ V⁻¹ D)/k_m.                                                    (after JCGM 102:2011, 6.5.2)
/// \param left_out  receives how many were
[[nodiscard]] std::vector<VectorScore> vector_scores(const ComparisonScheme& scheme,
                                                     const std::vector<EvaluatedItem>& items, std::size_t& left_out);

/// D of two items for all laboratories, with the ellipse that holds 95 % of them if only chance is at work.
struct YoudenPoint {
    std::size_t participant = 0;
    double first = 0.0, second = 0.0;  ///< D of the two items, in their units
};
struct YoudenDiagram {
    std::size_t first_item = 0, second_item = 0, round = 0;
    std::optional<double> sigma_first = {}, sigma_second = {};  ///< σ_pt, or √(σ_pt² + u²(X)) for z'; both or none
    double centre_first = 0.0, centre_second = 0.0;             ///< medians
    double scale_first = 0.0, scale_second = 0.0;               ///< robust standard deviations
    double correlation = 0.0;                                   ///< of the two, by ranks
    std::vector<std::pair<double, double>> ellipse = {};        ///< closed curve, in the units of the points
    std::vector<YoudenPoint> points = {};
};
/// Youden diagrams of the pairs of items of the scheme, a round each. The ellipse holds 95 % of a bivariate normal
/// distribution about the medians, with the scaled median absolute deviations as standard deviations and
/// r = 2 sin(π ρ/6) from the rank correlation ρ of Spearman. No ellipse for fewer than three points or a scale of 0.
[[nodiscard]] std::vector<YoudenDiagram> youden_diagrams(const ComparisonScheme& scheme,
                                                         const std::vector<EvaluatedItem>& items);

}  // namespace gumcert::gum
