#include "reports/view/certificate_view.h"

#include "certificate/dates.h"
#include "gum/quantity/diagnostic.h"
#include "reports/printable_text.h"
#include "reports/record/record_sections.h"
#include "reports/view/budget_report_sections.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certificate_identity_sections.h"
#include "reports/view/certificate_statement_sections.h"
#include "reports/view/document_kinds.h"
#include "reports/view/symbols.h"
#include "reports/wording.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using nlohmann::json;

void messages(CertificateBuilder& builder, const Wording& words, const std::vector<gum::Diagnostic>& diagnostics) {
    builder.section("messages");
    builder.paragraph(words("sentence", "messages"));
    static constexpr std::array<const char*, 3> k_severities = {"note", "warning", "error"};
    Facts rows;
    for (const gum::Diagnostic& d : diagnostics) {
        rows.emplace_back(
            words("value", "severity", k_severities.at(static_cast<std::size_t>(d.severity))) + " " + printable(d.code),
            words.message(d));
    }
    builder.definitions(rows);
}

/// The codes of the laboratories whose budgets are files, by the names of these files, where documents must not name
/// laboratories: the name of a file tells whose it is.
std::map<std::string, std::string> confidential_budgets(const EvaluationRecord& record) {
    std::map<std::string, std::string> codes;
    if (!record.comparison || record.comparison->form != "laboratories" || record.comparison->names_released) {
        return codes;
    }
    for (const BudgetFile& budget : record.comparison->budget_files) {
        codes.emplace(budget.file, budget.participant);
    }
    return codes;
}

/// The messages, with the code of a laboratory in place of the name of its budget.
std::vector<gum::Diagnostic> without_file_names(const EvaluationRecord& record) {
    std::vector<gum::Diagnostic> diagnostics = record.diagnostics;
    for (const auto& [file, code] : confidential_budgets(record)) {
        for (gum::Diagnostic& d : diagnostics) {
            for (std::string* text : {&d.where, &d.what, &d.rule, &d.action}) {
                for (std::size_t at = text->find(file); !file.empty() && at != std::string::npos;
                     at = text->find(file, at + code.size())) {
                    text->replace(at, file.size(), code);
                }
            }
        }
    }
    return diagnostics;
}

/// Files by their names, but budgets by the codes of their laboratories, and what they read in turn by its number.
void input(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    builder.section("input");
    const std::map<std::string, std::string> codes = confidential_budgets(record);
    Rows rows;
    for (const InputFile& file : record.job_files) {
        const auto code = codes.find(file.name);
        const bool is_job = rows.empty();
        Text name = file.name;
        if (code != codes.end()) {
            name = words.filled("comparison", "budget_file_of", {{"participant", code->second}});
        } else if (!codes.empty() && !is_job) {
            name = words.filled("comparison", "file_number", {{"number", std::to_string(rows.size() + 1)}});
        }
        rows.push_back({name, file.sha256});
    }
    builder.table("files", words("sentence", "files"), {{words("label", "file"), ""}, {words("label", "sha256"), ""}},
                  rows);
}

/// What the laboratory certifies. The annexes do not repeat it: a certified U may be the capability of the laboratory
/// and then differs from the evaluated one.
void certified_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record,
                        const DocumentKind& kind) {
    findings_section(builder, words, *record.certificate);
    method_sections(builder, words, record);
    result_sections(builder, words, record);
    kind.conventions(builder, words, record);
    closing_sections(builder, words, record);
}

/// How the results came about, below what the document states.
void background(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record,
                const DocumentKind& kind) {
    kind.evidence(builder, words, record);
    if (!record.diagnostics.empty()) {
        messages(builder, words, without_file_names(record));
    }
    input(builder, words, record);
    kind.measured_values(builder, words, record);
}

/// As much of it as the laboratory gives to its customers. What ISO/IEC 17025:2017, 7.8.2 and 7.8.4 demand stands
/// before the annexes.
void annexes(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record,
             const DocumentKind& kind) {
    const std::string& extent = record.certificate->data.annexes;
    // What the scope covers are the certified tables: nothing else of the document claims the accreditation.
    builder.annexes(record.certificate->symbol);
    if (extent == "summary") {
        kind.summary(builder, words, record);
    } else if (extent != "none") {
        kind.evaluation(builder, words, record);
        background(builder, words, record, kind);
    }
}

/// "2026-11-21" as {year, month, day} without leading zeros; 1970-01-01 where no date is stated, because PDF/A demands
/// one and that of the computer would change the bytes with every run.
json date_of_creation(const EvaluationRecord& record) {
    const std::string date = record.certificate                               ? record.certificate->data.dates.issued
                             : record.comparison && record.comparison->issuer ? record.comparison->issuer->issued
                                                                              : "";
    const std::chrono::year_month_day day =
        certificate::calendar_date(date).value_or(std::chrono::year(1970) / std::chrono::January / 1);
    return {{"year", std::to_string(static_cast<int>(day.year()))},
            {"month", std::to_string(static_cast<unsigned>(day.month()))},
            {"day", std::to_string(static_cast<unsigned>(day.day()))}};
}

json pages(const Wording& words) {
    json all = json::array();
    const Text page = words("document", "page");
    const Text of = words("document", "of");
    const Text end = words("document", "page_end");
    for (std::size_t i = 0; i < words.languages().size(); ++i) {
        all.push_back({{"page", page.in(i)}, {"of", of.in(i)}, {"end", end.in(i)}});
    }
    return all;
}

/// What documents of all sorts say of themselves.
json frame(const Wording& words, const EvaluationRecord& record) {
    const Text title = words.localised(title_of(record));
    json view = {{"language", words.language()}, {"running_title", shortened(printable(title.first()), 80)},
                 {"pages", pages(words)},        {"created", date_of_creation(record)},
                 {"attachment", json::array()},  {"status", json::array()},
                 {"closing", json::array()}};
    view.update(symbols_in(record));
    put(view, "title", title, words.languages());
    return view;
}

}  // namespace

nlohmann::json certificate_view(const EvaluationRecord& record, const Wording& words,
                                std::span<const DocumentKind> kinds) {
    const std::vector<std::string>& languages = words.languages();
    const DocumentKind& kind = document_kind(record, kinds);
    const bool is_certificate = record.certificate && !kind.is_report();
    const auto of_kind = [&](const char* text) { return words("document", std::string(kind.report) + text); };
    CertificateBuilder builder(words);
    json view = kind.running_texts(words, record);
    view["identity"] = json::array();
    if (is_certificate) {
        view["identity"].push_back(identity_page(builder, words, record));
        certified_sections(builder, words, record, kind);
        annexes(builder, words, record, kind);
    } else {
        kind.specimen(builder, words, record);
        background(builder, words, record, kind);
    }
    view.update(frame(words, record));
    view["mark"] = document_marks(words, record, kind.report);
    if (!is_certificate) {  // the first page of a certificate says it
        const Text only = of_kind("only_items");
        view["closing"].push_back({{"text", only.first()}, {"also", also(only, languages)}});
    }
    if (is_certificate) {
        view["status"] = issued_status(words, record);
    }
    put(view, "type", is_certificate ? document_type(record, words) : of_kind("type"), languages);
    put(view, "end_mark", of_kind("end_mark"), languages);
    view["sections"] = builder.take();
    return view;
}

nlohmann::json budget_report_view(const EvaluationRecord& record, const Wording& words,
                                  std::span<const DocumentKind> kinds) {
    const std::vector<std::string>& languages = words.languages();
    const DocumentKind& kind = document_kind(record, kinds);
    CertificateBuilder builder(words);
    builder.unabridged();
    report_subject(builder, words, record);
    if (record.certificate) {
        all_findings(builder, words, *record.certificate);
        method_sections(builder, words, record);
        result_sections(builder, words, record);
        kind.conventions(builder, words, record);
        closing_sections(builder, words, record);
        capability_of_values(builder, words, *record.certificate);
        kind.evaluation(builder, words, record);
    } else {
        kind.specimen(builder, words, record);
    }
    background(builder, words, record, kind);
    files_as_read(builder, words, record);

    json view = budget_report_running_texts(words, record);
    view.update(frame(words, record));
    const Text mark = words("document", "budget_report_mark");
    const Text reason = words("document", "budget_report_mark_reason");
    view["mark"] = json::array({{{"text", mark.first()},
                                 {"also", also(mark, languages)},
                                 {"reason", reason.first()},
                                 {"reason_also", also(reason, languages)}}});
    view["identity"] = json::array();
    const Text certified = words("document", "budget_report_only_items");
    view["closing"].push_back({{"text", certified.first()}, {"also", also(certified, languages)}});
    put(view, "type", words("document", "budget_report_type"), languages);
    put(view, "end_mark", words("document", "budget_report_end_mark"), languages);
    view["sections"] = builder.take();
    return view;
}

}  // namespace gumcert::reports
