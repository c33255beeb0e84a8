#pragma once

#include <cstddef>
#include <functional>
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

/// How much U changes, |ln(U_to/U_from)|, to 1e-9: which of equal changes is taken for the largest must not depend on last
/// bits. 0 where one of both is not above 0.
[[nodiscard]] double size_of_change(double U_from, double U_to);

/// A set of corrections: true at i where the i-th one is made.
using ChosenCorrections = std::vector<bool>;

/// How shares are found: over all sets of corrections, or as means over some random orders.
struct ShareDivision {
    bool is_exact = true;
    std::size_t orders = 1;  ///< where it is not exact
};
/// That of effects_of() for a budget.
[[nodiscard]] ShareDivision share_division(std::size_t corrections, std::size_t rows);
/// The same where each set that changes nested budgets is a new evaluation of the job: exact up to 2⁴ of them, else over
/// so many orders that there are about 32.
/// \param nested  how many of the corrections change nested budgets
[[nodiscard]] ShareDivision share_division(std::size_t corrections, std::size_t rows, std::size_t nested);

/// The same for whatever gives the outcome of a set; each set is asked for once.
/// \param outcome  that of the budget itself for the set without corrections
[[nodiscard]] std::vector<Effect> effects_of(std::size_t corrections, const ShareDivision& division,
                                             const std::function<BudgetOutcome(const ChosenCorrections&)>& outcome);

/// A budget without the texts of its rows: corrections change numbers, and it is copied for every set of them.
[[nodiscard]] AuditedBudget without_texts(AuditedBudget budget);

inline constexpr std::size_t k_exact_shares = 12;
inline constexpr std::size_t k_sampled_orders = 200;

/// How large a term that is missing would have to be to be seen: by bisection to a relative 1e-6.
/// \return nothing where the budget has no outcome
[[nodiscard]] std::optional<MissingTerm> missing_term(const AuditedBudget& budget);

}  // namespace gumcert::audit
