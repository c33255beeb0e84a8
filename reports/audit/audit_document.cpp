#include "reports/audit/audit_document.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "reports/audit/audit_plots.h"
#include "reports/audit/audit_words.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/document_forms.h"
#include "reports/printable_text.h"
#include "reports/view/certificate_builder.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;

constexpr std::size_t k_rows_of_document = 10;

/// The sections of one file.
class FileSections {
public:
    FileSections(const AuditedFileView& file, const AuditView& view, const AuditWords& words,
                 CertificateBuilder& builder, std::size_t number)
        : file_(file), view_(view), words_(words), builder_(builder), id_("file-" + std::to_string(number)) {}

    void build() {
        subject();
        limits();
        if (!file_.results.empty()) {
            const AuditedResultView& result = file_.results[file_.worst];
            equation(result);
            rows(result);
            contributors(result);
            outcomes(result);
            capability(result);
        }
        linearity();
        findings();
        waivers();
        questions();
        all_results();
        left_out();
    }

private:
    const AuditedFileView& file_;
    const AuditView& view_;
    const AuditWords& words_;
    CertificateBuilder& builder_;
    std::string id_;

    void section(const std::string& name) { builder_.section(id_ + "-" + name, words_(name)); }

    void table(const std::string& name, const std::string& caption, const std::vector<Column>& columns,
               const Rows& rows) {
        builder_.table(id_ + "-" + name, caption, columns, rows);
    }

    void subject() {
        builder_.section(id_, file_.name);
        Facts facts;
        add_fact(facts, words_("file"), file_.name + " (" + words_.file_kind(file_.kind) + ")");
        add_fact(facts, words_("digest"), file_.sha256);
        for (const AuditedFileView::ScopeLine& line : file_.scope) {
            std::string text = line.id;
            for (const std::string& part : {line.measurand, line.range, line.form}) {
                text += part.empty() ? "" : " · " + part;
            }
            add_fact(facts, words_("scope_line"), text);
        }
        if (!file_.results.empty()) {
            const AuditedResultView& result = file_.results[file_.worst];
            add_fact(facts, words_("measurand"), result.name + (result.unit.empty() ? "" : " / " + result.unit));
            add_fact(facts, words_("method"), words_.method(file_, result));
            add_fact(facts, words_("coverage"), words_.coverage(result));
            add_fact(facts, words_("summary"),
                     words_.change(result.claimed, result.audited, result.change, result.unit));
        }
        std::string counts;
        for (std::size_t i = 0; i < file_.counts.size(); ++i) {
            counts += (counts.empty() ? "" : ", ") + words_.severity(k_audit_severities[i]) + " " +
                      std::to_string(file_.counts[i]);
        }
        add_fact(facts, words_("findings"), counts);
        builder_.definitions(facts);
        if (file_.results.empty()) {
            builder_.paragraph(words_("no_results"));
        } else if (file_.own_results() > 1) {
            builder_.paragraph(words_.filled("worst_of", {{"count", std::to_string(file_.own_results())}}));
        }
    }

    void limits() {
        const std::vector<AuditSentence> sentences = words_.limits(file_);
        if (sentences.empty()) {
            return;
        }
        section("not_looked_at");
        for (const AuditSentence& sentence : sentences) {
            builder_.paragraph(sentence.text);
        }
    }

    void equation(const AuditedResultView& result) {
        section("section_equation");
        if (result.equation.empty()) {
            builder_.paragraph(words_("no_equation"));
        } else {
            builder_.formula(result.equation);
        }
    }

    void rows(const AuditedResultView& result) {
        section("section_rows");
        if (result.rows.empty()) {  // of a certificate
            builder_.paragraph(words_("not_stated"));
            return;
        }
        Rows lines;
        const std::size_t single =
            result.rows.size() > k_rows_of_document ? k_rows_of_document - 1 : result.rows.size();
        for (std::size_t i = 0; i < single; ++i) {
            const AuditedRowView& row = result.rows[i];
            lines.push_back({row.quantity, row.source, row.divisor, row.nu, row.contribution_text, row.share_percent});
        }
        if (single < result.rows.size()) {
            const AuditedRowView rest = summed_rows(result, single);
            lines.push_back({words_.filled("others", {{"count", std::to_string(result.rows.size() - single)}}), "", "",
                             "", rest.contribution_text, rest.share_percent});
        }
        table("rows", words_("rows_caption"),
              {{words_("quantity")},
               {words_("source")},
               {words_("divisor"), "", true},
               {"ν", "", true},
               {"|c|·u", result.unit, true},
               {words_("share"), "", true}},
              lines);
        builder_.figure(id_ + "-shares", words_("section_rows"), words_("rows_caption"),
                        svg(audited_share_plot(result, words_, id_ + "-share-plot")));
    }

    void contributors(const AuditedResultView& result) {
        section("section_contributors");
        Rows lines;
        for (const ContributorView& contributor : result.contributors) {
            lines.push_back({words_.contributor(contributor.id), words_.contributor_text(contributor, result.unit),
                             enumerated(contributor.rows)});
        }
        table("contributors", words_("contributors_caption"),
              {{words_("contributor")}, {words_("number_or_reason")}, {words_("rows_of_budget")}}, lines);
    }

    void outcomes(const AuditedResultView& result) {
        section("section_outcomes");
        const std::string unit = result.unit.empty() ? "" : " / " + result.unit;
        const PrintedOutcome &claimed = result.claimed, &recomputed = result.recomputed, &audited = result.audited;
        const auto number = [this](const std::string& text, bool stated) {
            return words_.number(text) + (stated ? "" : "*");
        };
        Rows lines = {{"u_c" + unit, number(claimed.u_c, result.claim_u_c.stated), words_.interval(result.u_c),
                       words_.number(recomputed.u_c), words_.number(audited.u_c)},
                      {"ν_eff", number(claimed.nu_eff, result.claim_nu_eff.stated), words_.interval(result.nu_eff),
                       words_.number(recomputed.nu_eff), words_.number(audited.nu_eff)},
                      {"k", number(claimed.k, result.claim_k.stated), words_.interval(result.k),
                       words_.number(recomputed.k), words_.number(audited.k)},
                      {"U" + unit, number(claimed.U, result.claim_U.stated), words_.interval(result.U),
                       words_.number(recomputed.U), words_.number(audited.U)},
                      {words_("verdict"), words_.verdict(claimed.verdict), "", words_.verdict(recomputed.verdict),
                       words_.verdict(audited.verdict)},
                      {"Eₙ", words_.number(claimed.En), "", words_.number(recomputed.En), words_.number(audited.En)}};
        table("outcomes", words_("outcomes_caption"),
              {{words_("item")}, {words_("claimed")}, {words_("allowed")}, {words_("recomputed")}, {words_("audited")}},
              lines);
        if (!result.all_stated()) {
            builder_.paragraph(words_("from_rows"));
        }
    }

    void capability(const AuditedResultView& result) {
        section("section_capability");
        if (result.capability.empty()) {
            builder_.paragraph(words_("no_capability"));
        } else {
            builder_.paragraph(words_.filled("capability_sentence",
                                             {{"budget", words_.with_unit(result.budget_U, result.unit)},
                                              {"capability", words_.with_unit(result.capability, result.unit)}}));
            if (result.recomputed.number.at_capability) {
                builder_.paragraph(words_("at_capability"));
            }
        }
        if (has_range_plot(file_)) {
            builder_.figure(id_ + "-range", words_("range_title"), words_("range_description"),
                            svg(range_plot(file_, words_, id_ + "-range-plot")));
        }
    }

    void linearity() {
        section("section_validation");
        if (file_.linearity.empty()) {
            builder_.paragraph(words_("no_rule_on_model"));
            return;
        }
        Rows lines;
        for (const RuleAnswer& one : file_.linearity) {
            lines.push_back({one.id + " " + words_.sentence(one.title).text, words_.said(one.answer).text});
        }
        table("linearity", words_("validation_caption"), {{words_("rule")}, {words_("answer")}}, lines);
    }

    void findings() {
        section("findings");
        if (file_.findings.empty()) {
            builder_.paragraph(words_("no_findings"));
        }
        for (const AuditFindingView& finding : file_.findings) {
            Facts facts;
            add_fact(facts, words_.severity(finding.severity) + " · " + finding.id,
                     words_.sentence(finding.title.empty() ? finding.id : finding.title).text);
            add_fact(facts, words_("where"), finding.where);
            add_fact(facts, words_("what"), words_.said(finding.what).text);
            for (const audit::Sentence& evidence : finding.evidence) {
                add_fact(facts, words_("evidence"), words_.said(evidence).text);
            }
            if (finding.effect) {
                const EffectView& effect = *finding.effect;
                add_fact(facts, words_("alone"), words_.effect_alone(effect, file_));
                add_fact(facts, words_("last"), words_.effect_last(effect, file_));
                add_fact(facts, words_("share_of_change"), words_.number(effect.share_percent) + " %");
            }
            if (finding.effect_on_score) {
                add_fact(facts, words_("score"), words_.effect_on_score(*finding.effect_on_score, file_));
            }
            if (finding.missing_term) {
                add_fact(facts, words_("bound"), words_.missing_term(*finding.missing_term));
            }
            add_fact(facts, words_("correction"), words_.sentence(finding.correction).text);
            add_fact(facts, words_("clause"), words_.clause(finding));
            builder_.definitions(facts);
        }
    }

    void waivers() {
        section("waivers");
        if (view_.waivers.empty()) {
            builder_.paragraph(words_("no_waivers"));
            return;
        }
        Rows lines;
        for (const PrintedWaiver& waiver : view_.waivers) {
            lines.push_back({waiver.rule, waiver.where.empty() ? words_("all") : waiver.where, waiver.by, waiver.when,
                             waiver.reason});
        }
        table("waivers", words_("waivers"),
              {{words_("rule")}, {words_("where")}, {words_("accepted_by")}, {words_("when")}, {words_("reason")}},
              lines);
    }

    void questions() {
        section("questions");
        if (file_.questions.empty()) {
            builder_.paragraph(words_("no_questions"));
            return;
        }
        Facts facts;
        for (std::size_t i = 0; i < file_.questions.size(); ++i) {
            std::vector<std::string> ids;
            for (const std::size_t finding : file_.questions[i].findings) {
                if (std::find(ids.begin(), ids.end(), file_.findings[finding].id) == ids.end()) {
                    ids.push_back(file_.findings[finding].id);
                }
            }
            add_fact(facts, std::to_string(i + 1) + " (" + enumerated(ids) + ")",
                     words_.sentence(file_.questions[i].question).text);
        }
        builder_.definitions(facts);
    }

    void all_results() {
        if (file_.results.size() < 2) {
            return;
        }
        section("section_all_results");
        Rows lines;
        for (const AuditedResultView& result : file_.results) {
            lines.push_back({result.name + (result.unit.empty() ? "" : " / " + result.unit), result.claimed.U,
                             result.audited.U, result.change.percent, result.capability,
                             words_.verdict(result.claimed.verdict), words_.verdict(result.audited.verdict)});
        }
        table("results", words_("outcomes_caption"),
              {{words_("measurand")},
               {"U, " + words_("claimed"), "", true},
               {"U, " + words_("audited"), "", true},
               {words_("change"), "", true},
               {words_("capability"), "", true},
               {words_("verdict") + ", " + words_("claimed")},
               {words_("verdict") + ", " + words_("audited")}},
              lines);
    }

    void left_out() {
        section("not_checked");
        builder_.paragraph(words_.filled("rules_not_checked", {{"count", std::to_string(file_.not_checked.size())}}));
        if (!file_.not_checked.empty()) {
            Rows lines;
            for (const NotCheckedView& one : file_.not_checked) {
                lines.push_back({one.id, words_.sentence(one.title).text, words_.said(one.because).text});
            }
            table("not-checked", words_("not_checked"), {{words_("rule")}, {words_("what")}, {words_("because")}},
                  lines);
        }
        if (!all_is_named_first(file_)) {
            section("not_read");
            for (const audit::Sentence& sentence : file_.not_read) {
                builder_.paragraph(words_.said(sentence).text);
            }
        }
    }
};

}  // namespace

std::string audit_as_pdf(const AuditView& view, const RenderAssets& assets) {
    const RenderAssets one_language = in_one_language(assets);
    const Wording wording = read_audit_wording(one_language);
    const AuditWords words(wording);
    CertificateBuilder builder(wording);
    if (const std::vector<AuditSentence> unaudited = words.unaudited(view); !unaudited.empty()) {
        builder.section("unaudited", words("unaudited"));
        for (const AuditSentence& sentence : unaudited) {
            builder.paragraph(sentence.text);
        }
    }
    for (std::size_t i = 0; i < view.files.size(); ++i) {
        FileSections(view.files[i], view, words, builder, i + 1).build();
    }
    const std::string title = view.files.size() == 1
                                  ? view.files.front().name
                                  : words.filled("title_of_several", {{"count", std::to_string(view.files.size())}});
    const std::string short_title = shortened(title, 80);
    json page = {{"language", words.language()},
                 {"mark", json::array({{{"text", words("mark")},
                                        {"also", json::array()},
                                        {"reason", words("mark_reason")},
                                        {"reason_also", json::array()}}})},
                 {"running_title", short_title},
                 {"header_left", short_title},
                 {"header_right", words("mark")},
                 {"footer_left", view.program.empty() ? short_title : view.program},
                 {"pages", json::array({{{"page", wording("document", "page").first()},
                                         {"of", wording("document", "of").first()},
                                         {"end", wording("document", "page_end").first()}}})},
                 {"identity", json::array()},
                 {"closing", json::array({{{"text", words("only_items")}, {"also", json::array()}}})},
                 {"attachment", json::array()},
                 {"sections", builder.take()}};
    put(page, "type", words("title"), wording.languages());
    put(page, "title", title, wording.languages());
    put(page, "end_mark", words("end_mark"), wording.languages());
    return view_as_pdf(page, one_language);
}

}  // namespace gumcert::reports
