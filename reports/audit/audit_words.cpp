#include "reports/audit/audit_words.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace gumcert::reports {
namespace {

constexpr std::size_t k_named_first = 6;   // of what could not be understood
constexpr std::size_t k_files_named = 12;  // of those that no audit reads

}  // namespace

bool all_is_named_first(const AuditedFileView& file) {
    return file.not_read.size() <= k_named_first;
}

std::string enumerated(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "" : "; ") + name;
    }
    return text;
}

std::string AuditWords::operator()(const std::string& name) const {
    return wording_("audit", name).first();
}

std::string AuditWords::filled(const std::string& name, const Wording::Values& values) const {
    return wording_.filled("audit", name, values).first();
}

std::string AuditWords::number(const std::string& printed) const {
    if (printed.empty()) {
        return wording_("document", "absent").first();
    }
    return wording_.number(printed).first();
}

std::string AuditWords::with_unit(const std::string& printed, const std::string& unit) const {
    return number(printed) + (printed.empty() || unit.empty() ? "" : "\u00A0" + unit);
}

std::string AuditWords::interval(const PrintedInterval& interval) const {
    return interval.low == interval.high ? number(interval.low) : number(interval.low) + " … " + number(interval.high);
}

std::string AuditWords::severity(const std::string& name) const {
    return wording_("finding_severity", name).first();
}

std::string AuditWords::verdict(const std::string& name) const {
    if (name.empty()) {
        return wording_("document", "absent").first();
    }
    return wording_.has("verdict_name", name) ? wording_("verdict_name", name).first() : name;
}

std::string AuditWords::distribution(const AuditedRowView& row) const {
    if (!row.shape.empty()) {
        return row.shape;
    }
    return row.shape_name.empty() ? "" : wording_("distribution_name", row.shape_name).first();
}

std::string AuditWords::contributor(const std::string& id) const {
    return wording_("audit_contributor", id).first();
}

std::string AuditWords::file_kind(const std::string& id) const {
    return wording_("audit_kind", id).first();
}

std::string AuditWords::direction(const Change& change) const {
    return wording_("audit_direction", change.direction).first();
}

std::string AuditWords::change(const PrintedOutcome& before, const PrintedOutcome& after, const Change& change,
                               const std::string& unit) const {
    std::string text = filled("change_of_U", {{"before", number(before.U)},
                                              {"after", with_unit(after.U, unit)},
                                              {"percent", number(change.percent)},
                                              {"direction", direction(change)}});
    if (change.verdict_turns) {
        text += "; " +
                filled("change_of_verdict", {{"before", verdict(before.verdict)}, {"after", verdict(after.verdict)}});
    }
    if (!before.En.empty() && !after.En.empty() && before.En != after.En) {
        text += "; " + filled("change_of_En", {{"before", number(before.En)}, {"after", number(after.En)}});
    }
    return text;
}

std::string AuditWords::effect_alone(const EffectView& effect, const AuditedFileView& file) const {
    const AuditedResultView& result = file.results[effect.result];
    return (file.results.size() > 1 ? result.name + ": " : "") +
           change(effect.claimed, effect.alone, effect.change_alone, result.unit);
}

std::string AuditWords::effect_last(const EffectView& effect, const AuditedFileView& file) const {
    const AuditedResultView& result = file.results[effect.result];
    return (file.results.size() > 1 ? result.name + ": " : "") +
           change(effect.last, effect.audited, effect.change_last, result.unit);
}

std::string AuditWords::effect_on_score(const EffectView& effect, const AuditedFileView& file) const {
    const AuditedResultView& result = file.results[effect.result];
    std::string text = result.name + ": " + change(effect.claimed, effect.alone, effect.change_alone, result.unit);
    if (effect.claimed.En == effect.alone.En) {  // else the change says so
        text +=
            "; " + filled("change_of_En", {{"before", number(effect.claimed.En)}, {"after", number(effect.alone.En)}});
    }
    return text;
}

std::string AuditWords::missing_term(const MissingTermView& term) const {
    std::string text = filled("bound_of_digit", {{"u", with_unit(term.u_for_digit, term.unit)}});
    if (term.u_for_verdict.empty() && !term.number.is_decided) {
        return text;
    }
    text += " " + (term.u_for_verdict.empty()
                       ? (*this)("bound_of_no_verdict")
                       : filled("bound_of_verdict", {{"u", with_unit(term.u_for_verdict, term.unit)}}));
    return text;
}

std::string AuditWords::clause(const AuditFindingView& finding) const {
    if (finding.clause.empty()) {
        return "";
    }
    return finding.clause_verified ? finding.clause : finding.clause + " " + (*this)("not_verified");
}

std::string AuditWords::coverage(const AuditedResultView& result) const {
    const std::string name = wording_("audit_coverage", result.coverage).first();
    const bool is_stated = result.coverage == "fixed" || result.coverage == "of_sheet";
    return name + (is_stated ? ", k = " + number(result.stated_k) : ", " + number(result.coverage_probability) + " %");
}

std::string AuditWords::method(const AuditedFileView& file, const AuditedResultView& result) const {
    if (!file.method.empty() || result.method.empty()) {
        return file.method.empty() ? (*this)("not_stated") : file.method;
    }
    return wording_.pattern(result.method).value_or(result.method);  // the title of a checklist has a translation
}

AuditSentence AuditWords::sentence(const std::string& english) const {
    const std::string worded = wording_.sentence(english).first();
    return {.text = worded, .english = !english.empty() && language() != "en" && worded == english};
}

AuditSentence AuditWords::said(const audit::Sentence& sentence) const {
    const bool same = language() == "en" || sentence.pattern().empty();
    std::optional<std::string> worded = same ? sentence.english() : by_pattern(sentence);
    return worded ? AuditSentence{.text = std::move(*worded)}
                  : AuditSentence{.text = sentence.english(), .english = true};
}

std::optional<std::string> AuditWords::by_pattern(const audit::Sentence& sentence) const {
    const std::optional<std::string> translation = wording_.pattern(sentence.pattern());
    if (!translation) {
        return std::nullopt;
    }
    const audit::PatternPieces english = audit::pattern_pieces(sentence.pattern()),
                               own = audit::pattern_pieces(*translation);
    std::string text(own.literals.front());
    for (std::size_t i = 0; i < own.places.size(); ++i) {
        const auto place = std::find_if(english.places.begin(), english.places.end(),
                                        [&](const auto& one) { return one.name == own.places[i].name; });
        if (place == english.places.end()) {
            return std::nullopt;
        }
        const audit::Sentence& argument =
            sentence.arguments()[static_cast<std::size_t>(place - english.places.begin())];
        const std::optional<std::string> value = !argument.pattern().empty() ? by_pattern(argument)
                                                 : place->is_number          ? shown_number(argument.english())
                                                 : place->is_sentence        ? of_program(argument.english())
                                                                             : argument.english();
        if (!value) {
            return std::nullopt;
        }
        text += *value;
        text += own.literals[i + 1];
    }
    return text;
}

std::optional<std::string> AuditWords::of_program(const std::string& english) const {
    AuditSentence worded = sentence(english);
    return worded.english ? std::nullopt : std::optional(std::move(worded.text));
}

/// "infinite" is the one word that stands for a number.
std::string AuditWords::shown_number(const std::string& shown) const {
    const std::string infinite = "infinite";
    return shown.starts_with(infinite) ? "∞" + shown.substr(infinite.size()) : wording_.number(shown).first();
}

std::string AuditWords::contributor_text(const ContributorView& contributor, const std::string& unit) const {
    if (contributor.rows.empty()) {
        return (*this)("no_row");
    }
    if (contributor.contribution == 0.0) {
        return contributor.reason.empty() ? (*this)("zero_without_reason")
                                          : filled("zero_because", {{"reason", contributor.reason}});
    }
    return with_unit(contributor.contribution_text, unit) + " (" + number(contributor.share_percent) + " %)";
}

std::vector<AuditSentence> AuditWords::limits(const AuditedFileView& file) const {
    std::vector<AuditSentence> all;
    for (std::size_t i = 0; i < std::min(file.not_read.size(), k_named_first); ++i) {
        all.push_back(said(file.not_read[i]));
    }
    if (!all_is_named_first(file)) {
        all.push_back(
            {.text = filled("more_limits", {{"count", std::to_string(file.not_read.size() - k_named_first)}})});
    }
    if (!file.not_checked.empty()) {
        all.push_back({.text = filled("rules_not_checked", {{"count", std::to_string(file.not_checked.size())}})});
    }
    if (file.sampled_shares) {
        all.push_back({.text = (*this)("sampled")});
    }
    return all;
}

std::vector<AuditSentence> AuditWords::unaudited(const AuditView& view) const {
    std::vector<AuditSentence> all;
    std::vector<std::string> of_other_kinds;
    for (const UnauditedFile& one : view.unaudited) {
        switch (one.kind) {
            case UnauditedFile::Kind::refused:
                all.push_back({.text = one.because, .english = language() != "en"});
                break;
            case UnauditedFile::Kind::in_record:
                all.push_back({.text = filled("unaudited_in_record", {{"file", one.file}, {"record", one.because}})});
                break;
            case UnauditedFile::Kind::other_kind:
                of_other_kinds.push_back(one.file);
                break;
        }
    }
    if (!of_other_kinds.empty()) {
        const std::size_t count = of_other_kinds.size();
        if (count > k_files_named) {
            of_other_kinds.resize(k_files_named);
            of_other_kinds.push_back("… (" + std::to_string(count) + ")");
        }
        all.push_back({.text = filled("unaudited_other_kind", {{"files", enumerated(of_other_kinds)}})});
    }
    return all;
}

}  // namespace gumcert::reports
