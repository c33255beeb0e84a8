#pragma once

#include <optional>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/finding.h"

namespace gumcert::audit {

/// What each correction of a budget does: alone, last, and its fair share of the whole change.
///
/// Effects of corrections do not add up: a smaller row lowers ν_eff, and k rises. So each set of corrections is
/// evaluated whole. The share of a correction is its Shapley value of ln U (L. S. Shapley, A value for n-person games,
/// 1953): exact for up to k_exact_shares corrections, over k_sampled_orders orders of a fixed sequence of random numbers
/// beyond; over fewer, at least one, where corrections times rows are more than 100 000.
/// \param corrections  applied in this order, those of a set after each other
/// \return one an entry of `corrections`; empty where the budget itself has no outcome
[[nodiscard]] std::vector<Effect> effects_of(const AuditedBudget& budget,
                                             const std::vector<const Correction*>& corrections);

inline constexpr std::size_t k_exact_shares = 12;
inline constexpr std::size_t k_sampled_orders = 200;

/// How large a term that is missing would have to be to be seen: by bisection to a relative 1e-6.
/// \return nothing where the budget has no outcome
[[nodiscard]] std::optional<MissingTerm> missing_term(const AuditedBudget& budget);

}  // namespace gumcert::audit
