#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gum/comparison/comparison_scheme.h"
#include "gum/comparison/item_result.h"
#include "gum/comparison/laboratory_data.h"
#include "gum/comparison/score_summary.h"
#include "gum/comparison/scored_result.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"

namespace gumcert::gum {

/// An item, in one round, for which nothing could be computed; the others are not lost by it.
struct ItemWithoutResult {
    std::size_t item = 0, round = 0;  ///< positions in the scheme
    std::vector<Diagnostic> because;
    bool refused_input = false;  ///< else the numbers have no result
};

/// All that follows from the results of a comparison between laboratories.
struct LaboratoryComparison {
    double score_probability = 0.0;     ///< coverage probability of E_n
    std::vector<ItemResult> items;      ///< item by item, and round by round in each
    std::vector<ScoredResult> results;  ///< in the order of `items`, and of the participants in each
    std::vector<ItemWithoutResult> without_result;
    std::vector<SharedSource> shared_sources;
    std::optional<ScoreSummary> summary;
    std::vector<ParticipantSummary> participants;  ///< one a participant of the scheme
    std::vector<VectorScore> vectors;
    std::size_t singular_vectors = 0;  ///< left out of `vectors`
    bool pairs_left_out = false;       ///< more than k_most_pairs of all items together
    std::vector<YoudenDiagram> youden;
};

/// Evaluates a comparison between laboratories: assigned values, scores, and what they say together.
///
/// Every item in every round that somebody measured is evaluated for itself. Where `items` of the result is empty nothing
/// could be computed at all.
/// \param results  those of one participant for one item in one round at most
/// \throws InputError  GC-COMPARE-0112 no results, -0113 a position that is not in the scheme
/// Accuracy: docs/accuracy.md#comparisons-and-robust-statistics
/// Example: examples/api/proficiency_test.cpp
[[nodiscard]] LaboratoryComparison evaluate_laboratories(const ComparisonScheme& scheme,
                                                         const std::vector<ParticipantResult>& results,
                                                         const Progress& progress = {});

}  // namespace gumcert::gum
