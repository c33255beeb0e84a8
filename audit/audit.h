#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "audit/budget_outcome.h"
#include "audit/finding.h"
#include "audit/rule.h"
#include "audit/sentence.h"
#include "audit/subject.h"

namespace gumcert::audit {

/// A rule that was not applied, and why: silence is no finding.
struct RuleNotChecked {
    std::string rule;
    Sentence because;
};

/// What a rule answers although it finds nothing.
struct RuleNote {
    std::string rule;
    Sentence what;
};

/// One result before and after the audit.
struct AuditedResult {
    std::string name, unit;
    std::size_t budget = 0;         ///< its position in AuditSubject::budgets
    BudgetOutcome claimed = {};     ///< what is stated, and what follows from the rows where nothing is stated
    BudgetOutcome recomputed = {};  ///< from the rows, with the rule of coverage that is claimed
    BudgetOutcome audited = {};     ///< all corrections applied
    double unrounded_U = 0.0;       ///< U that gives the claimed one when it is rounded: changes are told from it
    OutcomeIntervals allowed = {};  ///< what the printed digits of the rows allow
    bool sampled_shares = false;    ///< more corrections than are divided exactly
    bool is_nested = false;         ///< of a budget that the results rest on (NestedBudgets)
};

struct AuditReport {
    AuditSubject subject;
    std::vector<AuditedResult> results;  ///< one a budget that has an outcome, in their order
    std::vector<AuditFinding> findings;  ///< the gravest first, then by effect, then by rule
    std::vector<RuleNotChecked> not_checked;
    std::vector<RuleNote> notes;

    /// Whether a critical finding is left that nobody accepts.
    [[nodiscard]] bool has_critical() const;
};

/// The waiver that accepts a finding: of its rule, and of its place where the waiver names one. What the gates of a
/// certificate found is not accepted in this way: they have reasons of their own for what may be left out.
/// \return nullptr where nobody accepts it
[[nodiscard]] const certificate::Waiver* waiver_of(const AuditFinding& finding,
                                                   std::span<const certificate::Waiver> waivers);

/// Whether a finding is critical, and nobody accepts it: an assessor would not accept the result, and no certificate is
/// issued.
[[nodiscard]] bool is_open_critical(const AuditFinding& finding, std::span<const certificate::Waiver> waivers);

/// Takes more waivers into a report. One that fits no finding is told in `not_read`, once, and accepts nothing. What
/// follows from other findings is concluded anew: an accepted one is no longer open.
/// \param rules  those of the audit
void accept_findings(AuditReport& report, std::span<const certificate::Waiver> waivers, std::span<const Rule> rules);
/// The same without telling which fit nothing, where one list serves several reports.
/// \return of each waiver, whether it fits a finding of the report
std::vector<bool> take_waivers(AuditReport& report, std::span<const certificate::Waiver> waivers,
                               std::span<const Rule> rules);
/// That a waiver fits no finding, of those that no report has taken; each sentence once.
[[nodiscard]] std::vector<Sentence> unused_waivers(std::span<const certificate::Waiver> waivers,
                                                   const std::vector<bool>& taken);

/// Applies all rules to a subject, and evaluates what each correction does to every result that it touches.
/// \param rules  audit/rules/registry.h holds them all
[[nodiscard]] AuditReport audit(AuditSubject subject, std::span<const Rule> rules);

}  // namespace gumcert::audit
