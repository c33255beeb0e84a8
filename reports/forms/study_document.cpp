#include "reports/forms/study_document.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms/document_forms.h"
#include "reports/printable_text.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certificate_view.h"
#include "reports/wording.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gumcert::reports {

namespace {

using nlohmann::json;

/// The texts of a study that are the same for all studies of its kind. They stand here and not in the wording of
/// certificates, because the plain-text form is made without any file.
const json& texts_of(const std::string& kind) {
    static const json k_shared = {{"table", "Table"}, {"figure", "Figure"}, {"absent", "–"}};
    static const json k_simulation = {
        {"language", "en"},
        {"document", k_shared},
        {"study",
         {{"type", "Simulation study"},
          {"mark", "Simulation study – not a calibration certificate"},
          {"mark_reason",
           "Nothing in this document was measured: every observation was drawn by a program from a stated model."},
          {"only_items", "The results hold for the simulated model and layout only."},
          {"end_mark", "End of simulation study"},
          {"facts", "The study"}}}};
    static const json k_plan = {
        {"language", "en"},
        {"document", k_shared},
        {"study",
         {{"type", "Measurement plan"},
          {"mark", "Plan – nothing was measured"},
          {"mark_reason",
           "The uncertainties in this document are expected ones: they follow from the planned layout and the stated "
           "uncertainties, without any measurement. This is not a calibration certificate."},
          {"only_items", "The results hold for the planned layout and the stated uncertainties only."},
          {"end_mark", "End of plan"},
          {"facts", "The plan"}}}};
    if (kind == "simulation") {
        return k_simulation;
    }
    if (kind == "plan") {
        return k_plan;
    }
    throw gum::InputError(gum::Diagnostic{.code = "GC-REPORT-0004",
                                          .where = "study",
                                          .what = "kind \"" + kind + '"',
                                          .rule = "a study is a simulation or a plan",
                                          .action = "report this as a defect"});
}

/// The view of a study in the form of certificate_view(), so that both have one look and one set of templates.
json study_view(const StudyDocument& study) {
    const json& texts = texts_of(study.kind);
    const Wording words(texts);
    CertificateBuilder builder(words);
    builder.section("study", words("study", "facts"));
    if (!study.subtitle.empty()) {
        builder.paragraph(study.subtitle);
    }
    if (!study.facts.empty()) {
        builder.definitions({study.facts.begin(), study.facts.end()});
    }
    std::size_t sections = 0;
    std::size_t tables = 0;
    std::size_t figures = 0;
    for (const StudySection& section : study.sections) {
        builder.section("section-" + std::to_string(++sections), section.heading);
        for (const std::string& paragraph : section.paragraphs) {
            builder.paragraph(paragraph);
        }
        for (const StudyTable& table : section.tables) {
            std::vector<Column> columns;
            for (const StudyColumn& column : table.columns) {
                columns.push_back({.head = column.head, .unit = column.unit, .number = column.number});
            }
            std::vector<std::vector<Text>> rows;
            for (const std::vector<std::string>& row : table.rows) {
                rows.emplace_back(row.begin(), row.end());
                rows.back().resize(columns.size());
            }
            builder.table(std::to_string(++tables), table.caption, columns, rows);
        }
        for (const StudyFigure& figure : section.figures) {
            builder.figure("figure-" + std::to_string(++figures), figure.caption, figure.alternative_text,
                           figure.drawing);
        }
    }
    const std::string title = shortened(printable(study.title), 80);
    json view = {{"language", words.language()},
                 {"mark", json::array({{{"text", words("study", "mark").first()},
                                        {"also", json::array()},
                                        {"reason", words("study", "mark_reason").first()},
                                        {"reason_also", json::array()}}})},
                 {"running_title", title},
                 {"header_left", title},
                 {"header_right", words("study", "mark").first()},
                 {"footer_left", title},
                 {"pages", json::array({{{"page", "page"}, {"of", "of"}, {"end", ""}}})},
                 {"identity", json::array()},
                 {"closing", json::array({{{"text", words("study", "only_items").first()}, {"also", json::array()}}})},
                 {"attachment", json::array()},
                 {"sections", builder.take()}};
    put(view, "type", words("study", "type"), words.languages());
    put(view, "title", study.title, words.languages());
    put(view, "end_mark", words("study", "end_mark"), words.languages());
    return view;
}

}  // namespace

std::string render_text(const StudyDocument& study) {
    return view_as_text(study_view(study));
}

std::string render_html(const StudyDocument& study, const RenderAssets& assets) {
    return view_as_html(study_view(study), assets);
}

std::string render_pdf(const StudyDocument& study, const RenderAssets& assets, PdfWorker* worker) {
    return view_as_pdf(study_view(study), assets, worker);
}

std::vector<std::string> characters_without_glyph(const std::vector<std::string>& characters,
                                                  const RenderAssets& assets, PdfWorker& worker) {
    std::string all;
    for (const std::string& character : characters) {
        all += character + ' ';  // a text of its own, so that each is named that cannot be shown
    }
    const StudyDocument page{.kind = "plan",
                             .title = "Characters",
                             .subtitle = {},
                             .facts = {},
                             .sections = {{.heading = all, .paragraphs = {all}, .tables = {}, .figures = {}}},
                             .data_json = {}};
    return without_glyph(characters, study_view(page), assets, worker);
}

}  // namespace gumcert::reports
