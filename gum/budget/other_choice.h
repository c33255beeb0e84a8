#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

// max, min and abs of estimates that are nearly equal, or nearly 0. Where the estimates were measured, the largest of them is
// larger than the largest of what they stand for, because it holds its error; trials about the estimates add such errors once
// more, and their mean and both ends of their interval lie higher still (docs/adr/0091). JCGM 101:2008, 7.6, states that mean
// all the same: it takes the distributions as what is known. Only the laboratory knows which of the two its inputs are.

/// From this share of the trials on it is said that another value is chosen than at the estimates.
inline constexpr double k_other_choice_matters = 0.01;

/// Share of the trials, one an output, in which a max, min or abs takes another of its values than at the estimates and the
/// output is another one by it: by more than a hundredth of half the width of its Monte Carlo interval. Of 4096 trials, the
/// first ones of those that Monte Carlo drew. 0 where that moves their mean by no more than about a tenth of u, as in a median, which
/// adds in some trials what it takes off in others; without max, min and abs, and where there are no trials. A limit without
/// uncertainty is no choice: max(x, 0) has an interval that holds x wherever that of x does.
[[nodiscard]] std::vector<double> shares_of_other_choices(const BudgetPointResult& point, std::uint64_t seed);

/// Warning GC-BUDGET-0044 of an output that is reported by Monte Carlo, with the point where the share is largest; none
/// where it does not matter.
[[nodiscard]] std::optional<Diagnostic> other_choice_message(const Budget& budget, const BudgetResult& result,
                                                             const std::string& output);

/// Warning GC-BUDGET-0045 of an output that is reported by Monte Carlo and whose value at the estimates lies outside of the
/// interval of the trials, by more than about a tenth of u, whatever the equations are: hypot(a, b) of values near 0 is an
/// abs(). With the point where that is most; none where GC-BUDGET-0044 says it. The sum of two squares about 0 of JCGM
/// 101:2008, 9.4.2, lies outside by a fortieth of u.
[[nodiscard]] std::optional<Diagnostic> value_outside_message(const Budget& budget, const BudgetResult& result,
                                                              const std::string& output);

/// Whether one of the two is told of a result at a point, and the trials have a mean: then evidence is against stating this mean
/// alone, or deciding by it what the value at the estimates decides otherwise.
[[nodiscard]] bool is_mean_in_doubt(const BudgetPointResult& point, std::size_t output);

/// What the law gives and what the trials give, of an output of which the law is reported against evidence: ": the law gives
/// 100.2 mm, from …, and Monte Carlo 101.0 mm, from …", at the point where they differ most; "" without trials.
[[nodiscard]] std::string law_beside_trials(const Budget& budget, const BudgetResult& result, const std::string& output,
                                            const std::string& reason);

}  // namespace gumcert::gum
