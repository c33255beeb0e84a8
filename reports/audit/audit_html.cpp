#include "reports/audit/audit_html.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "reports/audit/audit_plots.h"
#include "reports/audit/audit_words.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/document_forms.h"
#include "reports/view/certificate_builder.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;

constexpr std::size_t k_rows_of_page = 10;     // the others are summed
constexpr std::size_t k_findings_of_page = 5;  // those with the largest effect
constexpr std::size_t k_trees = 24;            // results whose contributions are shown one by one

/// A block of a template that is there once, or not at all.
json once(json content) {
    return json::array({std::move(content)});
}

json once_if(bool there) {
    return there ? json::array({{{"there", "yes"}}}) : json::array();
}

json one_text(const std::string& text) {
    return text.empty() ? json::array() : once({{"text", text}});
}

json marked(const AuditSentence& sentence) {
    return {{"text", sentence.text}, {"english", once_if(sentence.english)}};
}

/// A sentence of a rule, once, or not at all where it is empty.
json said(const std::string& english, const AuditWords& words) {
    return english.empty() ? json::array() : once(marked(words.sentence(english)));
}
json said(const audit::Sentence& sentence, const AuditWords& words) {
    return sentence.empty() ? json::array() : once(marked(words.said(sentence)));
}

/// A list of sentences, once, or not at all where there are none.
json listed(const std::vector<AuditSentence>& sentences) {
    json lines = json::array();
    for (const AuditSentence& sentence : sentences) {
        lines.push_back(marked(sentence));
    }
    return sentences.empty() ? json::array() : once({{"lines", std::move(lines)}});
}

void add(json& facts, const std::string& label, const std::string& value) {
    if (!value.empty()) {
        facts.push_back({{"label", label}, {"value", value}});
    }
}

std::string finding_id(const std::string& file, std::size_t finding) {
    return file + "-finding-" + std::to_string(finding + 1);
}

/// The page of one file.
class FilePage {
public:
    FilePage(const AuditedFileView& file, const AuditView& view, const AuditWords& words, std::string id)
        : file_(file), view_(view), words_(words), id_(std::move(id)) {}

    json page() const {
        json all = {{"id", id_},
                    {"name", file_.name},
                    {"kind", words_.file_kind(file_.kind)},
                    {"sha256", one_text(file_.sha256)},
                    {"counts", counts()},
                    {"limits", listed(words_.limits(file_))},
                    {"subject", subject()},
                    {"result", json::array()},
                    {"no_result", once_if(file_.results.empty())},
                    {"validation", validation()},
                    {"worst_findings", worst_findings()},
                    {"no_findings", once_if(file_.findings.empty())},
                    {"waivers", waivers()},
                    {"no_waivers", once_if(view_.waivers.empty())},
                    {"questions", questions()},
                    {"no_questions", once_if(file_.questions.empty())},
                    {"filters", filters()},
                    {"findings", findings()},
                    {"has_findings", once_if(!file_.findings.empty())},
                    {"all_results", all_results()},
                    {"trees", trees()},
                    {"trees_left_out", trees_left_out()},
                    {"not_checked", not_checked()},
                    {"not_checked_sentence",
                     words_.filled("rules_not_checked", {{"count", std::to_string(file_.not_checked.size())}})},
                    {"not_read", not_read()}};
        if (!file_.results.empty()) {
            all["result"] = once(worst_result());
        }
        return all;
    }

private:
    const AuditedFileView& file_;
    const AuditView& view_;
    const AuditWords& words_;
    std::string id_;

    const AuditedResultView& worst() const { return file_.results[file_.worst]; }

    json counts() const {
        json all = json::array();
        for (std::size_t i = 0; i < file_.counts.size(); ++i) {
            all.push_back({{"severity", k_audit_severities[i]},
                           {"word", words_.severity(k_audit_severities[i])},
                           {"count", std::to_string(file_.counts[i])},
                           {"none", once_if(file_.counts[i] == 0)}});
        }
        return all;
    }

    json subject() const {
        json facts = json::array();
        if (!file_.results.empty()) {
            const AuditedResultView& result = worst();
            add(facts, words_("measurand"), result.name + (result.unit.empty() ? "" : " / " + result.unit));
            add(facts, words_("place"), result.place);
            add(facts, words_("method"), words_.method(file_, result));
            if (file_.own_results() > 1) {
                add(facts, words_("points"), std::to_string(file_.own_results()));
            }
            for (const AuditedFileView::ScopeLine& line : file_.scope) {
                std::string text = line.id;
                for (const std::string& part : {line.measurand, line.range, line.form}) {
                    text += part.empty() ? "" : " · " + part;
                }
                add(facts, words_("scope_line"), text);
            }
            add(facts, words_("capability"),
                result.capability.empty() ? words_("not_stated") : words_.with_unit(result.capability, result.unit));
            add(facts, words_("coverage"), words_.coverage(result));
            if (!result.lower_limit.empty() || !result.upper_limit.empty()) {
                add(facts, words_("limits"),
                    words_.number(result.lower_limit) + " … " + words_.with_unit(result.upper_limit, result.unit));
            }
            if (!result.reference_value.empty()) {
                add(facts, words_("reference"),
                    (result.reference_name.empty() ? "" : result.reference_name + ": ") +
                        words_.number(result.reference_value) + " ± " +
                        words_.with_unit(result.reference_U, result.unit));
            }
        }
        return facts;
    }

    json answer_of(const AuditedResultView& result) const {
        json all = {{"name", result.name},
                    {"unit", one_text(result.unit)},
                    {"before", words_.number(result.claimed.U)},
                    {"after", words_.number(result.audited.U)},
                    {"percent", words_.number(result.change.percent)},
                    {"direction", result.change.direction},
                    {"direction_word", words_.direction(result.change)},
                    {"verdict", json::array()},
                    {"En", json::array()}};
        if (!result.claimed.verdict.empty() || !result.audited.verdict.empty()) {
            all["verdict"] = once({{"before", words_.verdict(result.claimed.verdict)},
                                   {"after", words_.verdict(result.audited.verdict)},
                                   {"turns", result.change.verdict_turns ? "turns" : "stays"}});
        }
        if (!result.claimed.En.empty() || !result.audited.En.empty()) {
            all["En"] = once({{"before", words_.number(result.claimed.En)},
                              {"after", words_.number(result.audited.En)},
                              {"turns", result.change.En_crosses_one ? "turns" : "stays"}});
        }
        return all;
    }

    /// What the first page says of the worst result.
    json worst_result() const {
        const AuditedResultView& result = worst();
        return {{"answer", once(answer_of(result))},
                {"several", file_.own_results() > 1
                                ? one_text(words_.filled("worst_of", {{"count", std::to_string(file_.own_results())}}))
                                : json::array()},
                {"equation", one_text(result.equation)},
                {"no_equation", once_if(result.equation.empty())},
                {"unit_head", result.unit.empty() ? "" : " / " + result.unit},
                {"rows", rows_of_page(result)},
                {"contributors", contributors(result)},
                {"outcomes", outcomes(result)},
                {"from_rows", once_if(!result.all_stated())},
                {"capability", capability(result)},
                {"plot", has_range_plot(file_)
                             ? once({{"svg", with_decimal_signs(svg(range_plot(file_, words_, id_ + "-range")),
                                                                words_.decimal_sign())}})
                             : json::array()}};
    }

    json ids_of(const std::vector<std::size_t>& findings) const {
        json all = json::array();
        for (const std::size_t finding : findings) {
            all.push_back({{"href", "#" + finding_id(id_, finding)},
                           {"id", file_.findings[finding].id},
                           {"severity", file_.findings[finding].severity}});
        }
        return all;
    }

    json rows_of_page(const AuditedResultView& result) const {
        json all = json::array();
        const std::size_t single = result.rows.size() > k_rows_of_page ? k_rows_of_page - 1 : result.rows.size();
        for (std::size_t i = 0; i < single; ++i) {
            const AuditedRowView& row = result.rows[i];
            all.push_back({{"quantity", row.quantity},
                           {"source", row.source.empty() ? words_.number("") : row.source},
                           {"divisor", words_.number(row.divisor)},
                           {"nu", words_.number(row.nu)},
                           {"contribution", row.in_sum ? words_.number(row.contribution_text) : words_("not_in_sum")},
                           {"share", words_.number(row.share_percent)},
                           {"bar", share_bar(row.share)},
                           {"findings", ids_of(row.findings)}});
        }
        if (single < result.rows.size()) {
            const AuditedRowView sum = summed_rows(result, single);
            all.push_back(
                {{"quantity", words_.filled("others", {{"count", std::to_string(result.rows.size() - single)}})},
                 {"source", ""},
                 {"divisor", ""},
                 {"nu", ""},
                 {"contribution", words_.number(sum.contribution_text)},
                 {"share", words_.number(sum.share_percent)},
                 {"bar", share_bar(sum.share)},
                 {"findings", json::array()}});
        }
        return all;
    }

    json contributors(const AuditedResultView& result) const {
        json all = json::array();
        for (const ContributorView& contributor : result.contributors) {
            const std::string rows = enumerated(contributor.rows);
            const bool answered = contributor.contribution > 0.0 || !contributor.reason.empty();
            all.push_back({{"name", words_.contributor(contributor.id)},
                           {"text", words_.contributor_text(contributor, result.unit)},
                           {"state", answered ? "answered" : "open"},
                           {"rows", rows.empty() ? words_.number("") : rows}});
        }
        return all;
    }

    json outcomes(const AuditedResultView& result) const {
        json all = json::array();
        const std::string unit = result.unit.empty() ? "" : " / " + result.unit;
        const auto line = [&](json head, const std::string& before, const std::string& recomputed,
                              const std::string& audited) {
            head.update({{"claimed", before},
                         {"mark", ""},
                         {"recomputed", recomputed},
                         {"audited", audited},
                         {"allowed", json::array()}});
            all.push_back(std::move(head));
        };
        const auto symbol = [](const char* letter, const char* below, const std::string& after) {
            return json{{"symbol", once({{"letter", letter}, {"below", one_text(below)}})}, {"head", after}};
        };
        const auto number = [&](json head, const std::string& claimed, AuditedResultView::Claim claim,
                                const std::string& recomputed, const PrintedInterval& allowed,
                                const std::string& audited) {
            line(std::move(head), words_.number(claimed), words_.number(recomputed), words_.number(audited));
            all.back()["mark"] = claim.stated ? "" : "*";
            all.back()["allowed"] = once({{"text", words_.interval(allowed)}, {"outside", once_if(!claim.allowed)}});
        };
        const auto named = [](const std::string& head) { return json{{"symbol", json::array()}, {"head", head}}; };
        const PrintedOutcome &claimed = result.claimed, &recomputed = result.recomputed, &audited = result.audited;
        number(symbol("u", "c", unit), claimed.u_c, result.claim_u_c, recomputed.u_c, result.u_c, audited.u_c);
        number(symbol("ν", "eff", ""), claimed.nu_eff, result.claim_nu_eff, recomputed.nu_eff, result.nu_eff,
               audited.nu_eff);
        number(symbol("k", "", ""), claimed.k, result.claim_k, recomputed.k, result.k, audited.k);
        number(symbol("U", "", unit), claimed.U, result.claim_U, recomputed.U, result.U, audited.U);
        if (!claimed.value.empty()) {
            line(named(words_("value") + unit), words_.number(claimed.value), words_.number(recomputed.value),
                 words_.number(audited.value));
        }
        if (!claimed.verdict.empty() || !audited.verdict.empty()) {
            line(named(words_("verdict")), words_.verdict(claimed.verdict), words_.verdict(recomputed.verdict),
                 words_.verdict(audited.verdict));
        }
        if (!claimed.En.empty() || !audited.En.empty()) {
            line(symbol("E", "n", ""), words_.number(claimed.En), words_.number(recomputed.En),
                 words_.number(audited.En));
        }
        return all;
    }

    json capability(const AuditedResultView& result) const {
        if (result.capability.empty()) {
            return once({{"text", words_("no_capability")}});
        }
        json all = once({{"text", words_.filled("capability_sentence",
                                                {{"budget", words_.with_unit(result.budget_U, result.unit)},
                                                 {"capability", words_.with_unit(result.capability, result.unit)}})}});
        if (result.recomputed.number.at_capability) {
            all.push_back({{"text", words_("at_capability")}});
        }
        return all;
    }

    json validation() const {
        json lines = json::array();
        for (const RuleAnswer& one : file_.linearity) {
            lines.push_back({{"id", one.id}, {"title", said(one.title, words_)}, {"answer", said(one.answer, words_)}});
        }
        const bool none = lines.empty();
        return once({{"lines", std::move(lines)}, {"none", once_if(none)}});
    }

    std::string unit_of(const AuditFindingView& finding) const {
        return finding.effect && finding.effect->result < file_.results.size()
                   ? file_.results[finding.effect->result].unit
                   : "";
    }

    /// The effect of a finding with an arrow, the bound of a missing term, or that there is no number.
    json effect_lines(const AuditFindingView& finding, double largest) const {
        json lines = json::array();
        if (finding.effect) {
            const EffectView& effect = *finding.effect;
            lines.push_back(
                {{"text", words_.effect_alone(effect, file_)},
                 {"arrow", once({{"svg", change_arrow(effect.claimed.number.U, effect.alone.number.U, largest)}})},
                 {"direction", effect.change_alone.direction}});
        }
        if (finding.effect_on_score) {
            const EffectView& effect = *finding.effect_on_score;
            lines.push_back({{"text", words_.effect_on_score(effect, file_)},
                             {"arrow", json::array()},
                             {"direction", effect.change_alone.direction}});
        }
        if (finding.missing_term) {
            lines.push_back({{"text", words_.missing_term(*finding.missing_term)},
                             {"arrow", json::array()},
                             {"direction", "unchanged"}});
        }
        if (lines.empty()) {
            lines.push_back({{"text", words_("no_effect")}, {"arrow", json::array()}, {"direction", "unchanged"}});
        }
        return lines;
    }

    json head_of(const AuditFindingView& finding, std::size_t position) const {
        return {{"id", finding.id},
                {"anchor", finding_id(id_, position)},
                {"severity", finding.severity},
                {"severity_word", words_.severity(finding.severity)},
                {"title", said(finding.title.empty() ? finding.id : finding.title, words_)},
                {"where", one_text(finding.where)},
                {"what", said(finding.what, words_)}};
    }

    json worst_findings() const {
        json all = json::array();
        const std::size_t count = std::min(k_findings_of_page, file_.findings.size());
        double largest = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            if (const auto& effect = file_.findings[i].effect) {
                largest = std::max({largest, effect->claimed.number.U, effect->alone.number.U});
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            json entry = head_of(file_.findings[i], i);
            entry["effects"] = effect_lines(file_.findings[i], 1.05 * largest);
            all.push_back(std::move(entry));
        }
        return all;
    }

    json waivers() const {
        json all = json::array();
        for (const PrintedWaiver& waiver : view_.waivers) {
            all.push_back({{"rule", waiver.rule},
                           {"where", waiver.where.empty() ? words_("all") : waiver.where},
                           {"by", waiver.by},
                           {"when", waiver.when},
                           {"reason", waiver.reason}});
        }
        return all;
    }

    json questions() const {
        json all = json::array();
        for (const QuestionView& question : file_.questions) {
            all.push_back({{"question", said(question.question, words_)}, {"findings", ids_of(question.findings)}});
        }
        return all;
    }

    json filters() const {
        json all = json::array();
        for (std::size_t i = 0; i < file_.counts.size(); ++i) {
            if (file_.counts[i] > 0) {
                all.push_back({{"severity", k_audit_severities[i]},
                               {"word", words_.severity(k_audit_severities[i])},
                               {"count", std::to_string(file_.counts[i])}});
            }
        }
        return all;
    }

    json effect_table(const AuditFindingView& finding) const {
        if (!finding.effect) {
            return json::array();
        }
        const EffectView& effect = *finding.effect;
        json lines = json::array();
        const auto line = [&](const std::string& head, const PrintedOutcome& outcome) {
            lines.push_back({{"head", head},
                             {"u_c", words_.number(outcome.u_c)},
                             {"nu_eff", words_.number(outcome.nu_eff)},
                             {"k", words_.number(outcome.k)},
                             {"U", words_.number(outcome.U)},
                             {"verdict", words_.verdict(outcome.verdict)},
                             {"En", words_.number(outcome.En)}});
        };
        line(words_("claimed"), effect.claimed);
        line(words_("alone") + ", " + words_("after"), effect.alone);
        line(words_("last") + ", " + words_("before"), effect.last);
        line(words_("last") + ", " + words_("after"), effect.audited);
        const std::string unit = unit_of(finding);
        return once({{"caption", words_.filled("effect_caption", {{"id", finding.id}})},
                     {"unit_head", unit.empty() ? "" : " / " + unit},
                     {"lines", std::move(lines)},
                     {"share", words_.number(effect.share_percent)},
                     {"of", file_.results.size() > 1 ? one_text(file_.results[effect.result].name) : json::array()},
                     {"sampled", once_if(file_.results[effect.result].sampled_shares)}});
    }

    json findings() const {
        json all = json::array();
        for (std::size_t i = 0; i < file_.findings.size(); ++i) {
            const AuditFindingView& finding = file_.findings[i];
            json entry = head_of(finding, i);
            double largest = 0.0;
            if (finding.effect) {
                largest = 1.05 * std::max(finding.effect->claimed.number.U, finding.effect->alone.number.U);
            }
            entry["effects"] = effect_lines(finding, largest);
            entry["evidence"] = json::array();
            for (const audit::Sentence& evidence : finding.evidence) {
                entry["evidence"].push_back(marked(words_.said(evidence)));
            }
            entry["has_evidence"] = once_if(!finding.evidence.empty());
            entry["compared"] = finding.expected.empty() && finding.actual.empty()
                                    ? json::array()
                                    : once({{"expected", once(marked(words_.said(finding.expected)))},
                                            {"actual", once(marked(words_.said(finding.actual)))}});
            entry["correction"] = said(finding.correction, words_);
            entry["question"] = said(finding.question, words_);
            entry["clause"] = one_text(words_.clause(finding));
            entry["waiver"] = finding.waiver
                                  ? one_text(words_.filled("accepted", {{"by", view_.waivers[*finding.waiver].by}}))
                                  : json::array();
            entry["table"] = effect_table(finding);
            all.push_back(std::move(entry));
        }
        return all;
    }

    json all_results() const {
        if (file_.results.size() < 2) {
            return json::array();
        }
        json lines = json::array();
        for (std::size_t i = 0; i < file_.results.size(); ++i) {
            const AuditedResultView& result = file_.results[i];
            json entry = answer_of(result);
            entry["number"] = std::to_string(i + 1);
            entry["capability"] = words_.number(result.capability);
            entry["verdict_text"] = result.change.verdict_turns ? words_.verdict(result.claimed.verdict) + " → " +
                                                                      words_.verdict(result.audited.verdict)
                                                                : words_.verdict(result.claimed.verdict);
            lines.push_back(std::move(entry));
        }
        return once({{"lines", std::move(lines)}});
    }

    json tree_row(const AuditedResultView& result, const AuditedRowView& row) const {
        json inputs = json::array();
        const auto number = [&](const char* label, const std::string& text, const std::string& unit) {
            if (!text.empty()) {
                add(inputs, words_(label), words_.with_unit(text, unit));
            }
        };
        number("estimate", row.estimate, row.unit);
        number("stated", row.stated, row.unit);
        number("divisor", row.divisor, "");
        add(inputs, words_("distribution"), words_.distribution(row));
        add(inputs, "u", words_.with_unit(row.u, row.unit));
        number("sensitivity", row.sensitivity, "");
        add(inputs, "|c|·u", words_.with_unit(row.contribution_text, result.unit));
        add(inputs, "ν", row.nu.empty() ? words_("not_stated") : words_.number(row.nu));
        add(inputs, words_("source"), row.source.empty() ? words_("not_stated") : row.source);
        add(inputs, words_("comment"), row.comment);
        add(inputs, words_("row_place"), row.place);
        json found = json::array();
        for (const std::size_t position : row.findings) {
            json entry = head_of(file_.findings[position], position);
            entry["effects"] = effect_lines(file_.findings[position], largest_U(file_.findings[position]));
            found.push_back(std::move(entry));
        }
        return {
            {"quantity", row.quantity},
            {"contribution", row.in_sum ? words_.with_unit(row.contribution_text, result.unit) : words_("not_in_sum")},
            {"share", words_.number(row.share_percent)},
            {"bar", share_bar(row.share)},
            {"flags", ids_of(row.findings)},
            {"inputs", std::move(inputs)},
            {"found", std::move(found)},
            {"nothing_found", once_if(row.findings.empty())}};
    }

    static double largest_U(const AuditFindingView& finding) {
        return finding.effect ? 1.05 * std::max(finding.effect->claimed.number.U, finding.effect->alone.number.U) : 0.0;
    }

    /// Results by how much they change, the most first, as far as their contributions are shown.
    std::vector<std::size_t> shown_results() const {
        std::vector<std::size_t> order(file_.results.size());
        std::iota(order.begin(), order.end(), 0U);
        const auto size = [this](std::size_t i) {
            const Change& change = file_.results[i].change;
            return std::pair(change.decision_turns(), std::abs(change.relative));
        };
        if (order.size() > k_trees) {
            std::stable_sort(order.begin(), order.end(),
                             [&size](std::size_t a, std::size_t b) { return size(a) > size(b); });
            order.resize(k_trees);
            std::sort(order.begin(), order.end());
        }
        return order;
    }

    json trees() const {
        json all = json::array();
        for (const std::size_t i : shown_results()) {
            const AuditedResultView& result = file_.results[i];
            json rows = json::array();
            for (const AuditedRowView& row : result.rows) {
                rows.push_back(tree_row(result, row));
            }
            all.push_back({{"name", result.name},
                           {"open", once_if(i == file_.worst)},
                           {"sentence", words_.change(result.claimed, result.audited, result.change, result.unit)},
                           {"rows", std::move(rows)}});
        }
        return all;
    }

    json trees_left_out() const {
        return file_.results.size() > k_trees
                   ? one_text(
                         words_.filled("trees_left_out", {{"count", std::to_string(file_.results.size() - k_trees)}}))
                   : json::array();
    }

    json not_checked() const {
        if (file_.not_checked.empty()) {
            return json::array();
        }
        json lines = json::array();
        for (const NotCheckedView& one : file_.not_checked) {
            lines.push_back(
                {{"id", one.id}, {"title", said(one.title, words_)}, {"because", said(one.because, words_)}});
        }
        return once({{"lines", std::move(lines)}});
    }

    json not_read() const {
        if (all_is_named_first(file_)) {
            return json::array();
        }
        std::vector<AuditSentence> all;
        for (const audit::Sentence& sentence : file_.not_read) {
            all.push_back(words_.said(sentence));
        }
        return listed(all);
    }
};

/// One line a file, where there are several.
json overview(const AuditView& view, const AuditWords& words) {
    if (view.files.size() < 2) {
        return json::array();
    }
    json lines = json::array();
    for (std::size_t i = 0; i < view.files.size(); ++i) {
        const AuditedFileView& file = view.files[i];
        const auto gravest = std::find_if(file.counts.begin(), file.counts.end(), [](std::size_t n) { return n > 0; });
        const bool any = gravest != file.counts.end();
        const char* severity =
            any ? k_audit_severities[static_cast<std::size_t>(gravest - file.counts.begin())] : "none";
        json line = {{"href", "#file-" + std::to_string(i + 1)},
                     {"name", file.name},
                     {"severity", severity},
                     {"severity_word", any ? words.severity(severity) : words("none")},
                     {"count", std::to_string(file.findings.size())},
                     {"change", words.number("")}};
        if (!file.results.empty()) {
            const AuditedResultView& result = file.results[file.worst];
            line["change"] = words.change(result.claimed, result.audited, result.change, result.unit);
        }
        lines.push_back(std::move(line));
    }
    return once({{"lines", std::move(lines)}});
}

}  // namespace

std::string audit_as_html(const AuditView& view, const RenderAssets& assets) {
    const Wording wording = read_audit_wording(assets);
    const AuditWords words(wording);
    const std::string script = read_asset(assets.templates / "audit.js");
    json page = {{"language", words.language()},
                 {"w", wording.group("audit")},
                 {"style", read_asset(assets.templates / "audit.css")},
                 {"script", script},
                 {"script_digest", encoding::base64(encoding::sha256_bytes(script))},
                 {"title", view.files.size() == 1
                               ? view.files.front().name
                               : words.filled("title_of_several", {{"count", std::to_string(view.files.size())}})},
                 {"several_files", once_if(view.files.size() > 1)},
                 {"program", one_text(view.program)},
                 {"unaudited", listed(words.unaudited(view))},
                 {"overview", overview(view, words)},
                 {"files", json::array()}};
    for (std::size_t i = 0; i < view.files.size(); ++i) {
        page["files"].push_back(FilePage(view.files[i], view, words, "file-" + std::to_string(i + 1)).page());
    }
    return filled_template("audit.html.mustache", page, assets);
}

}  // namespace gumcert::reports
