#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/stated_number.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {

/// The verdict where a rule and limits are stated, and nothing can be decided: a parameter of the rule is not stated, or the
/// limits are impossible. It turns into no other verdict, and none turns into it.
inline constexpr std::string_view k_no_decision = "cannot_be_decided";

/// Everything that follows from the rows of a budget: nothing is scaled, all is evaluated again.
struct BudgetOutcome {
    std::optional<double> value;
    double u_c = 0.0;
    double nu_eff = 0.0;  ///< infinite where every row has infinite degrees of freedom
    double k = 0.0;
    double U = 0.0;              ///< k u_c, raised to the capability where the budget does so
    bool at_capability = false;  ///< U is the capability, because k u_c is smaller
    std::string printed_value, printed_U;
    /// U to the digits of the budget, in which a change is seen; `printed_U` may have the digits of a statement.
    std::string rounded_U;
    double stated_step =
        0.0;  ///< of a U that somebody stated: one unit of its last printed digit; 0 of one computed here
    /// `printed_U` is what is stated wherever U is no other number than that: another text is another number.
    bool is_held_against_statement = false;
    std::string verdict;       ///< "" without limits, rule or value
    std::optional<double> en;  ///< the largest by its amount; none without value or reference
    /// Why there is no decision, or no E_n although there is a reference. u_c, ν_eff, k and U do not rest on either.
    std::vector<gum::Diagnostic> undecided;
};

/// Whether two verdicts contradict each other: nothing contradicts what cannot be decided.
[[nodiscard]] bool verdict_turns(std::string_view before, std::string_view after);

/// |c| u of a row, in the unit of the result; 0 of one that is not in the sum.
[[nodiscard]] double contribution_of(const AuditedRow& row);

/// Evaluates a budget.
///
/// u_c² = Σ (c_i u_i)² + 2 Σ c_i c_j u_i u_j r_ij                               (JCGM 100:2008, eqs. 10 and 16)
/// ν_eff by Welch–Satterthwaite (eq. G.2b), k by the rule of coverage of the budget, U = max(k u_c, capability);
/// verdict by gum/conformity, E_n by gum/comparison, printed digits by gum/rounding.
/// Where verdict or E_n cannot be told, the outcome says why, and the rest of it stands.
/// Where the budget has an uncorrected U: no correction of it is printed as it is stated, and what lies between what was
/// evaluated and what is stated, which the laboratory rounded in its own way, is rounded like the latter.
/// \throws NoResultError  GC-AUDIT-0001 where rows and correlations give no positive u_c
[[nodiscard]] BudgetOutcome evaluate(const AuditedBudget& budget);
/// The same with another rule of coverage.
[[nodiscard]] BudgetOutcome evaluate(const AuditedBudget& budget, const CoverageRule& coverage);

/// value − reference of a result with an expanded uncertainty U that has an E_n, in the unit of the result.
[[nodiscard]] double difference_of_score(double en, double U, const ComparedReference& reference);

/// What the printed digits of the rows allow of u_c, ν_eff and U: the claimed numbers are reproducible where they lie
/// within.
struct OutcomeIntervals {
    Interval u_c, nu_eff, k, U;
};
/// Interval arithmetic over |c| u of all rows; ν_eff and k follow from their worst cases, so that no budget is accused
/// of its rounding. Correlated rows: every sign of the products is bounded.
[[nodiscard]] OutcomeIntervals outcome_intervals(const AuditedBudget& budget);
[[nodiscard]] OutcomeIntervals outcome_intervals(const AuditedBudget& budget, const CoverageRule& coverage);

/// k of t_p(ν_eff) where ν_eff lies in an interval: from its largest to its smallest, no less than 0.5.
[[nodiscard]] Interval student_factors(const CoverageRule& rule, const Interval& nu_eff);

}  // namespace gumcert::audit
