#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gum/comparison/assigned_value.h"
#include "gum/comparison/laboratory_data.h"
#include "gum/comparison/reference_value.h"

namespace gumcert::gum {

/// Up to this many results the largest consistent subset stands beside the other estimates without being asked for, and
/// pairs of laboratories are listed.
inline constexpr std::size_t k_most_laboratories_in_pairs = 40;
/// More pairs than this, of all items and rounds together, are not listed: a report would hold little else.
inline constexpr std::size_t k_most_pairs = 10'000;
/// Up to this many results pairs that are not compatible are counted.
inline constexpr std::size_t k_most_results_of_pair_count = 2000;

/// One way to get a reference value from the results of an item.
struct ReferenceEstimate {
    std::string method;  ///< word of the method, also "niqr" and "kernel_mode"
    double value = 0.0;
    double rest = 0.0;  ///< the estimate is value + rest: SplitNumber
    std::optional<double> u = {};
    std::optional<double> scale = {};    ///< s*, s, MADe … of the results
    std::optional<double> between = {};  ///< τ
    /// Expanded uncertainty from the scatter of the results with t of these degrees of freedom; none where the method
    /// has no such one.
    std::optional<double> U = {};
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    std::optional<double> u_hartung_knapp = {};  ///< of a mean with τ
    std::size_t results = 0;                     ///< that it rests on
    bool used = false;                           ///< it is the assigned value
};

/// The reference values that the contributing results allow, side by side, in the order of AssignedValueMethod; then
/// the normalised interquartile range about the median, and the mode of the kernel density where a bandwidth is stated.
[[nodiscard]] std::vector<ReferenceEstimate> reference_estimates(const LaboratoryData& data,
                                                                 const AssignedValue& assigned,
                                                                 double coverage_probability);

/// The largest consistent subset of the contributing results, whose items differ as the check of homogeneity says; its
/// mean is that of the stated uncertainties.
[[nodiscard]] ConsistentSubset consistent_subset_of(const LaboratoryData& data, double alpha);

/// Test of consistency with the pairs of results that are not metrologically compatible, κ = 2.
struct ResultConsistency {
    ConsistencyTest test;
    double alpha = 0.05;
    /// In the test and in the pairs, beside the uncertainty of each result; of a subset without a drift.
    double u_items = 0.0;
    /// χ² of the stated uncertainties alone; none where that is the one of the test.
    std::optional<double> chi_square_of_statements = {};
    /// None for more than k_most_results_of_pair_count results.
    std::optional<std::size_t> pairs = {}, incompatible_pairs = {};
    /// It fails (of a subset: the test of all results does), no clearer and in no more of several items than chance
    /// makes.
    bool by_chance = false;
};

/// Test whether the contributing results agree within their uncertainties and what their items differ by: of those that the assigned value rests on
/// where it is the largest consistent subset. Nothing where they do not all state one, or are fewer than two.
[[nodiscard]] std::optional<ResultConsistency> consistency_of(const LaboratoryData& data, const AssignedValue& assigned,
                                                              const ItemUncertainty& items = {});

/// Robust standard deviation s* of the contributing results by algorithm A; nothing for fewer than three, or where more
/// than half of them are equal.
[[nodiscard]] std::optional<double> robust_standard_deviation(const LaboratoryData& data);

/// Robust pooled standard deviation of the replicates by algorithm S; nothing unless all contributing results state one
/// with the same number of observations.
[[nodiscard]] std::optional<double> pooled_standard_deviation(const LaboratoryData& data);

/// Bilateral degree of equivalence of two laboratories for one item.
struct PairEquivalence {
    std::size_t first = 0, second = 0;  ///< positions of the participants
    double d = 0.0, u = 0.0, U = 0.0;   ///< of first − second
    std::optional<double> en = {};      ///< none where U is 0
};

/// How many pairs pair_equivalences() lists.
[[nodiscard]] std::size_t count_pairs(const LaboratoryData& data);

/// Bilateral degrees of equivalence of all results with an uncertainty; none for more than 40.
/// \param u_items  of the item of each result
[[nodiscard]] std::vector<PairEquivalence> pair_equivalences(const LaboratoryData& data, double coverage_probability,
                                                             double u_items = 0.0);

}  // namespace gumcert::gum
