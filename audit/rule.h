#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "audit/finding.h"
#include "audit/sentence.h"
#include "audit/subject.h"

namespace gumcert::audit {

/// A clause as the audit states it. Where nobody held the number against the document, the reader is told so.
struct Clause {
    std::string_view text;  ///< "JCGM 100:2008, 4.3.7"
    bool verified = false;
};

/// What a rule needs of a subject. Without it the rule is listed as not checked.
/// `results`: rows, or claims of a result that has none, as on a certificate. `gates`: a certificate of ours, whose data
/// passed the gates before it was issued.
enum class Need {
    rows,
    results,
    claims,
    readings,
    certificate,
    gates,
    capability,
    limits,
    comparison,
    model,
    workbook,
    recomputed,
};

/// How the severity of a finding is decided.
enum class SeverityPolicy {
    by_effect,  ///< critical, major or minor by what the correction does (audit/severity.h)
    fixed,      ///< documents, traceability, and what no number shows
};

class FindingCollector;

/// One thing that an audit looks for.
struct Rule {
    std::string_view id;
    std::string_view title;
    Clause clause = {};
    SeverityPolicy policy = SeverityPolicy::by_effect;
    /// Of `fixed`; of `by_effect` where no effect can be computed.
    FindingSeverity severity = FindingSeverity::major;
    std::vector<Need> needs = {};
    std::string_view detection = {};   ///< how it is seen, for docs/audit_rules.md
    std::string_view correction = {};  ///< what is put right, and what to do
    std::string_view question = {};    ///< to the laboratory
    void (*examine)(const AuditSubject& subject, FindingCollector& findings) = nullptr;
    /// Where it finds nothing, it looks again at the budgets with all corrections in place: one error may hide another,
    /// as a row that is far too large hides that k = 2 is fixed for few degrees of freedom.
    bool looks_again = false;
    /// After all others have examined, before effects are known: what none of their corrections explains.
    void (*examine_rest)(const AuditSubject& subject, std::span<const AuditFinding> others,
                         FindingCollector& findings) = nullptr;
    /// What others have found already: taken whether or not the subject has what the rule itself needs.
    void (*examine_gates)(const AuditSubject& subject, FindingCollector& findings) = nullptr;
    /// After all rules have been examined and their effects are known: what follows from the findings of the others.
    void (*conclude)(const AuditSubject& subject, std::span<const AuditFinding> others,
                     FindingCollector& findings) = nullptr;
};

/// Takes the findings of one rule: id, question and correction text come from the rule unless the finding has its own.
class FindingCollector {
public:
    explicit FindingCollector(const Rule& rule) : rule_(rule) {}

    /// \param finding  with `where`, `what` and `evidence`; the same place and text twice is one finding of both budgets
    void add(AuditFinding finding) { add(std::move(finding), rule_.severity); }
    /// \param severity  in place of that of the rule, where the case decides it
    void add(AuditFinding finding, FindingSeverity severity);
    /// What the rule answers although it finds nothing: a bound that it proved.
    void note(Sentence sentence) { notes_.push_back(std::move(sentence)); }
    /// What of the subject it could not look at, and why.
    void leave_unchecked(Sentence because) { unchecked_.push_back(std::move(because)); }
    [[nodiscard]] std::string_view rule() const { return rule_.id; }
    [[nodiscard]] std::vector<AuditFinding> take();
    [[nodiscard]] const std::vector<Sentence>& notes() const { return notes_; }
    [[nodiscard]] const std::vector<Sentence>& unchecked() const { return unchecked_; }

private:
    const Rule& rule_;
    std::vector<AuditFinding> findings_;
    std::unordered_map<std::string, std::size_t> by_kind_, by_place_and_text_;  ///< the first of each
    std::vector<Sentence> notes_, unchecked_;
};

/// "the table names no distributions" … why a rule cannot be applied to a subject; "" where it can.
[[nodiscard]] Sentence why_not_applicable(const Rule& rule, const AuditSubject& subject);

}  // namespace gumcert::audit
