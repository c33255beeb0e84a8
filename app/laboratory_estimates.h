#pragma once

#include <optional>
#include <vector>

#include "app/assigned_value.h"
#include "app/laboratory_data.h"
#include "reports/record/comparison_evaluation.h"

namespace gumcert::app {

/// Up to this many results the largest consistent subset stands beside the other estimates without being asked for, and
/// pairs of laboratories are listed.
inline constexpr std::size_t k_most_laboratories_in_pairs = 40;
/// More pairs than this, of all items and rounds together, are not listed: the record would hold little else.
inline constexpr std::size_t k_most_pairs_in_record = 10'000;
/// Up to this many results pairs that are not compatible are counted.
inline constexpr std::size_t k_most_results_of_pair_count = 2000;

/// The reference values that the contributing results allow, side by side, in the order of the words of the job; then
/// the normalised interquartile range about the median, and the mode of the kernel density where a bandwidth is stated.
[[nodiscard]] std::vector<reports::ReferenceEstimate> reference_estimates(const LaboratoryData& data,
                                                                          const AssignedValue& assigned,
                                                                          double coverage_probability);

/// Test whether the contributing results agree within their uncertainties: of those that the assigned value rests on
/// where it is the largest consistent subset. Nothing where they do not all state one, or are fewer than two.
[[nodiscard]] std::optional<reports::ConsistencySummary> consistency_of(const LaboratoryData& data,
                                                                        const AssignedValue& assigned);

/// Robust standard deviation s* of the contributing results by algorithm A; nothing for fewer than three, or where more
/// than half of them are equal.
[[nodiscard]] std::optional<double> robust_standard_deviation(const LaboratoryData& data);

/// Robust pooled standard deviation of the replicates by algorithm S; nothing unless all contributing results state one
/// with the same number of observations.
[[nodiscard]] std::optional<double> pooled_standard_deviation(const LaboratoryData& data);

/// How many pairs pair_equivalences() lists.
[[nodiscard]] std::size_t count_pairs(const LaboratoryData& data);

/// Bilateral degrees of equivalence of all results with an uncertainty; none for more than 40.
[[nodiscard]] std::vector<reports::PairEquivalence> pair_equivalences(const engine::ComparisonJob& job,
                                                                      const LaboratoryData& data);

}  // namespace gumcert::app
