#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audit/sentence.h"
#include "reports/audit/audit_view.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// A text, and whether it is English in a document of another language.
struct AuditSentence {
    std::string text;
    bool english = false;
};

/// Whether limits() names everything that could not be understood; else the whole list stands at the end of the file.
[[nodiscard]] bool all_is_named_first(const AuditedFileView& file);

/// "a; b; c".
[[nodiscard]] std::string enumerated(const std::vector<std::string>& names);

/// Words of an audit in the language of its document (group `audit` of templates/wording): the forms for people share
/// them.
class AuditWords {
public:
    /// \param wording  must outlive this object; its first language is used
    explicit AuditWords(const Wording& wording) : wording_(wording) {}

    [[nodiscard]] const std::string& language() const { return wording_.language(); }
    [[nodiscard]] const std::string& decimal_sign() const { return wording_.decimal_sign(); }
    /// A label or sentence of the group `audit`.
    [[nodiscard]] std::string operator()(const std::string& name) const;
    [[nodiscard]] std::string filled(const std::string& name, const Wording::Values& values) const;
    /// A printed number with the decimal sign of the language; "–" where there is none.
    [[nodiscard]] std::string number(const std::string& printed) const;
    [[nodiscard]] std::string with_unit(const std::string& printed, const std::string& unit) const;
    /// "0.481 … 0.503", one number where both are the same.
    [[nodiscard]] std::string interval(const PrintedInterval& interval) const;
    [[nodiscard]] std::string severity(const std::string& name) const;
    [[nodiscard]] std::string verdict(const std::string& name) const;
    [[nodiscard]] std::string distribution(const AuditedRowView& row) const;
    [[nodiscard]] std::string contributor(const std::string& id) const;
    [[nodiscard]] std::string file_kind(const std::string& id) const;
    /// "U understated".
    [[nodiscard]] std::string direction(const Change& change) const;
    /// "U 0.50 → 0.62 µm (+24.1 %): U understated; verdict pass → fail; Eₙ 0.91 → 1.10".
    [[nodiscard]] std::string change(const PrintedOutcome& before, const PrintedOutcome& after, const Change& change,
                                     const std::string& unit) const;
    /// What correcting a finding alone does; with the name of the result where the file has several.
    [[nodiscard]] std::string effect_alone(const EffectView& effect, const AuditedFileView& file) const;
    /// The same as the last of all corrections.
    [[nodiscard]] std::string effect_last(const EffectView& effect, const AuditedFileView& file) const;
    /// What correcting a finding alone does to E_n of the compared result, and to its U.
    [[nodiscard]] std::string effect_on_score(const EffectView& effect, const AuditedFileView& file) const;
    /// What a missing contribution would have to be.
    [[nodiscard]] std::string missing_term(const MissingTermView& term) const;
    /// The clause, and that nobody held it against the document where that is so.
    [[nodiscard]] std::string clause(const AuditFindingView& finding) const;
    /// How a budget comes to U: "t-distribution, 95.45 %".
    [[nodiscard]] std::string coverage(const AuditedResultView& result) const;
    /// The method of a certificate, else that of the budget.
    [[nodiscard]] std::string method(const AuditedFileView& file, const AuditedResultView& result) const;
    /// A sentence of a rule: in the language where the catalogue of sentences has it.
    [[nodiscard]] AuditSentence sentence(const std::string& english) const;
    /// What the audit says of a file: by the translation of its pattern, and of those in its places. Where one of them has
    /// none, the whole of it is English. A text without a pattern is the same in every language.
    [[nodiscard]] AuditSentence said(const audit::Sentence& sentence) const;
    /// What of a file the audit did not look at, for the place where a form begins: what could not be understood, as far as
    /// all_is_named_first() says, rules that were not checked, shares that are sampled.
    [[nodiscard]] std::vector<AuditSentence> limits(const AuditedFileView& file) const;
    /// Files that have no audit, and why.
    [[nodiscard]] std::vector<AuditSentence> unaudited(const AuditView& view) const;
    /// A number with what a contributor is: "0.012 µm (3.1 %)", or why there is none.
    [[nodiscard]] std::string contributor_text(const ContributorView& contributor, const std::string& unit) const;

private:
    [[nodiscard]] std::optional<std::string> by_pattern(const audit::Sentence& sentence) const;
    [[nodiscard]] std::string shown_number(const std::string& shown) const;
    [[nodiscard]] std::optional<std::string> of_program(const std::string& english) const;

    const Wording& wording_;
};

}  // namespace gumcert::reports
