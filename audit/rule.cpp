#include "audit/rule.h"

#include <algorithm>
#include <utility>

namespace gumcert::audit {
namespace {

bool has(const AuditSubject& subject, Need need) {
    const auto any = [&subject](const auto& holds) {
        return std::any_of(subject.budgets.begin(), subject.budgets.end(), holds);
    };
    switch (need) {
        case Need::rows:
            return any([](const AuditedBudget& budget) { return !budget.rows.empty(); });
        case Need::results:
            return has(subject, Need::rows) || has(subject, Need::claims);
        case Need::claims:
            return any([](const AuditedBudget& budget) { return budget.claims.u_c || budget.claims.U; });
        case Need::readings:
            return any([](const AuditedBudget& budget) {
                return std::any_of(budget.rows.begin(), budget.rows.end(),
                                   [](const AuditedRow& row) { return !row.readings.empty() || row.n; });
            });
        case Need::certificate:
            return subject.certificate.has_value();
        case Need::gates:
            return subject.certificate && subject.kind != AuditSubject::Kind::certificate;
        case Need::capability:
            return any([](const AuditedBudget& budget) { return budget.capability.has_value(); });
        case Need::limits:
            return any([](const AuditedBudget& budget) { return budget.limits.lower || budget.limits.upper; });
        case Need::comparison:
            return subject.comparison.has_value() ||
                   any([](const AuditedBudget& budget) { return budget.reference.has_value(); });
        case Need::model:
            return any([](const AuditedBudget& budget) { return !budget.equation.empty(); });
        case Need::workbook:
            return subject.workbook != nullptr;
        case Need::recomputed:
            return subject.disagreements.has_value();
    }
    return false;
}

Sentence missing(Need need) {
    switch (need) {
        case Need::rows:
            return say("no rows of an uncertainty budget were found");
        case Need::results:
            return say("no results were found");
        case Need::claims:
            return say("no u_c and no U are claimed");
        case Need::readings:
            return say("no readings are stated");
        case Need::certificate:
            return say("no certificate data are stated");
        case Need::gates:
            return say("no certificate data are stated that passed the gates of this program");
        case Need::capability:
            return say("no capability (CMC) is stated");
        case Need::limits:
            return say("no limits of a specification are stated");
        case Need::comparison:
            return say("no reference value or comparison is stated");
        case Need::model:
            return say("no equation of the measurement is stated");
        case Need::workbook:
            return say("the file has no formulas");
        case Need::recomputed:
            return say("the file is no record whose job can be evaluated again");
    }
    return {};
}

}  // namespace

void FindingCollector::add(AuditFinding finding, FindingSeverity severity) {
    finding.rule = rule_.id;
    finding.severity = severity;
    if (finding.correction.empty()) {
        finding.correction = rule_.correction;
    }
    if (finding.question.empty()) {
        finding.question = rule_.question;
    }
    const std::string text = finding.where + '\0' + finding.what.english();
    const auto of_kind = finding.kind.empty() ? by_kind_.end() : by_kind_.find(finding.kind);
    const auto of_text = by_place_and_text_.find(text);
    const std::size_t none = findings_.size();
    const std::size_t found = std::min(of_kind == by_kind_.end() ? none : of_kind->second,
                                       of_text == by_place_and_text_.end() ? none : of_text->second);
    AuditFinding* const same = found == none ? nullptr : &findings_[found];
    const bool elsewhere =
        same != nullptr && !finding.budgets.empty() &&
        std::find(same->budgets.begin(), same->budgets.end(), finding.budgets.front()) == same->budgets.end();
    // The same at another point of a table is one finding with more places; twice in one budget it is two.
    if (same == nullptr || (!elsewhere && !finding.budgets.empty())) {
        by_place_and_text_.try_emplace(text, findings_.size());
        if (!finding.kind.empty()) {
            by_kind_.try_emplace(finding.kind, findings_.size());
        }
        findings_.push_back(std::move(finding));
        return;
    }
    for (const std::size_t budget : finding.budgets) {
        same->budgets.push_back(budget);
        if (finding.correct) {
            same->correct_others[budget] = finding.correct;
        }
    }
    if (finding.where != same->where) {
        same->other_places.push_back(finding.where);
    }
}

std::vector<AuditFinding> FindingCollector::take() {
    constexpr std::size_t k_most_places = 4;
    for (AuditFinding& finding : findings_) {
        if (!finding.other_places.empty()) {
            finding.evidence.push_back(
                say("the same at {places}", listed(sentences_of(finding.other_places), k_most_places)));
        }
    }
    by_kind_.clear();
    by_place_and_text_.clear();
    return std::exchange(findings_, {});
}

Sentence why_not_applicable(const Rule& rule, const AuditSubject& subject) {
    for (const Need need : rule.needs) {
        if (!has(subject, need)) {
            return missing(need);
        }
    }
    return {};
}

}  // namespace gumcert::audit
