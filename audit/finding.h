#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/budget_outcome.h"
#include "audit/sentence.h"
#include "certificate/certified_results.h"

namespace gumcert::audit {

using certificate::FindingSeverity;

/// Puts right in a budget what a finding names. Applied to copies, in the order of the rules; has no effect on a budget
/// that is right already.
using Correction = std::function<void(AuditedBudget&)>;

/// What correcting a finding does to a result, all of it evaluated again.
struct Effect {
    BudgetOutcome claimed;  ///< the budget as it is
    BudgetOutcome alone;    ///< only this finding corrected
    BudgetOutcome last;  ///< every other finding corrected, and this one not: what it still changes is its last effect
    BudgetOutcome audited;  ///< all findings corrected
    /// Its part of the relative change of U from claimed to audited, fairly divided (Shapley 1953): the mean over all
    /// orders of correction. The shares of all findings add up to that change.
    double share = 0.0;
    std::size_t budget = 0;  ///< the one of all points with the largest effect

    [[nodiscard]] double relative_change_alone() const { return alone.U / claimed.U - 1.0; }
};

/// Where the correction is not known: how large a missing term would have to be.
struct MissingTerm {
    double u_for_digit = 0.0;  ///< standard uncertainty, in the unit of the result, that changes the printed U
    std::optional<double> u_for_verdict;  ///< … that changes the verdict or moves |E_n| across 1; none: nothing does
    bool is_decided = true;  ///< false: a verdict or E_n cannot be told, so that nobody knows what changes it
};

/// Something that an assessor would remark on a budget.
struct AuditFinding {
    std::string rule;  ///< stable id: "U10"
    FindingSeverity severity = FindingSeverity::information;
    /// The gravest that its effect may make it: what errs on the safe side is no grave matter, however much it changes.
    FindingSeverity at_most = FindingSeverity::critical;
    std::string where;                 ///< row and column, "Budget!D5", or a JSON pointer
    Sentence what;                     ///< with the numbers
    std::vector<Sentence> evidence;    ///< the values used: "u = 0.4 µm (row 3)"
    Sentence expected, actual;         ///< "" where a comparison of two texts says nothing
    std::string correction;            ///< what to do
    std::string question;              ///< to the laboratory
    std::vector<std::size_t> budgets;  ///< results that it touches; empty: none by numbers
    std::string kind;                  ///< findings of one rule with the same kind are one finding; "" it stands alone
    Correction correct;                ///< of the first of `budgets`; empty: not known, or a document
    std::map<std::size_t, Correction> correct_others;  ///< of the other `budgets`
    std::vector<std::string> other_places;             ///< where else the same was found
    bool is_conclusion = false;                        ///< follows from other findings (Rule::conclude)
    bool of_gate = false;               ///< taken over from the gates of a certificate, which have it already
    bool contribution_missing = false;  ///< no `correct`, because nobody knows how large the missing contribution is
    std::optional<Effect> effect;
    /// On the result that is compared with a reference, where the correction changes it through a nested budget and
    /// `effect` is that on another result.
    std::optional<Effect> effect_on_score;
    std::optional<MissingTerm> missing_term;  ///< of the first of `budgets`, where a contribution is missing
};

/// What puts right one of the budgets that a finding touches; nullptr where it does not touch it, or nothing is known.
[[nodiscard]] const Correction* correction_of(const AuditFinding& finding, std::size_t budget);

}  // namespace gumcert::audit
