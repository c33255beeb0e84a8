#include "reports/view/budget_report_sections.h"

#include "certificate/point_tables.h"
#include "certificate/section_data.h"
#include "reports/printable_text.h"
#include "reports/printed_texts.h"
#include "reports/record/record_sections.h"
#include "reports/result_names.h"
#include "reports/view/certificate_identity_sections.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using certificate::Certificate;
using certificate::CertificateData;

/// The form of the document: it changes when the layout changes in a way that an assessor would see.
constexpr const char* k_report_form = "gumcert-budget-report-1";
constexpr std::size_t k_most_lines = 20;  // of a file; the builder multiplies it

Text person_text(const std::optional<certificate::Person>& person, const Wording& words) {
    if (!person) {
        return {};
    }
    const Text function = words.localised(person->function);
    return function.empty() ? Text(person->name) : person->name + ", " + function;
}

void add_certificate_facts(Facts& facts, const Wording& words, const CertificateData& data) {
    add_fact(facts, words("certificate", "number"), data.number);
    add_fact(facts, words("heading", certificate::has_several_items(data) ? "items" : "item"),
             items_in_one_line(data, words));
    add_fact(facts, words("certificate", "customer"), words.localised(data.customer.name));
    add_fact(facts, words("certificate", "order"), data.customer.order);
    add_fact(facts, words("certificate", "performed"), from_to(data.dates.performed_from, data.dates.performed_to));
    add_fact(facts, words("certificate", "issued"), data.dates.issued);
    add_fact(facts, words("certificate", "performed_by"), person_text(data.persons.performed_by, words));
    add_fact(facts, words("certificate", "reviewed_by"), person_text(data.persons.reviewed_by, words));
    add_fact(facts, words("certificate", "authorised_by"), person_text(data.persons.authorised_by, words));
}

/// The lines of a text, without their ends.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        lines.push_back(line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

}  // namespace

void report_subject(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    builder.section("report_subject");
    Facts facts = {{words("label", "title"), words.localised(title_of(record))},
                   {words("label", "status"), words("certificate_status", document_status(record))}};
    if (record.certificate) {
        add_certificate_facts(facts, words, record.certificate->data);
    }
    add_fact(facts, words("label", "digest_of_record"), record.digest);
    builder.definitions(facts);
}

void capability_of_values(CertificateBuilder& builder, const Wording& words, const Certificate& certificate) {
    if (!certificate.data.accreditation) {
        return;
    }
    builder.section("capability_of_values");
    Rows rows;
    for (const certificate::CertifiedTable& table : certificate.tables) {
        for (const certificate::CertifiedColumn& column : table.columns) {
            for (std::size_t i = 0; i < column.values.size(); ++i) {
                const certificate::CertifiedValue& value = column.values[i];
                const bool at_points = table.argument && i < table.argument->printed.size();
                rows.push_back({name_of_result(table.id, column.result, words),
                                at_points ? table.argument->printed[i] : "",
                                certificate::value_as_shown(table, column, value.printed_value),
                                value.printed_U + (value.raised ? " #" : ""), value.printed_capability,
                                column.printed_unit, value.scope_entry, words.sentence(value.outside_because)});
            }
        }
    }
    builder.table("capability-of-values", words("sentence", "capability_of_values"),
                  {{words("certificate", "result"), ""},
                   {words("certificate", "point"), ""},
                   {words("certificate", "value"), "", true},
                   {words("certificate", "U_short"), "", true},
                   {words("label", "capability"), "", true},
                   {words("label", "unit"), ""},
                   {words("label", "scope_entry"), ""},
                   {words("label", "why_outside"), ""}},
                  rows);
}

void files_as_read(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const std::size_t most = builder.most(k_most_lines);
    std::size_t number = 0;
    for (const InputFile& file : record.job_files) {
        if (!file.content || file.encoding != "utf-8" || !file.name.ends_with(".csv")) {
            continue;
        }
        if (number == 0) {
            builder.section("files_as_read");
        }
        const std::vector<std::string_view> lines = lines_of(*file.content);
        Rows rows;
        for (std::size_t i = 0; i < std::min(lines.size(), most); ++i) {
            rows.push_back({std::to_string(i + 1), std::string(lines[i])});
        }
        builder.table("file-" + std::to_string(++number), words.fill("file_as_read", {{"name", file.name}}),
                      {{words("label", "line_number"), "", true}, {words("label", "line_as_read"), ""}}, rows);
        if (lines.size() > most) {
            builder.paragraph(words.fill(
                "file_lines_first",
                {{"shown", std::to_string(most)}, {"count", std::to_string(lines.size())}, {"name", file.name}}));
        }
    }
}

nlohmann::json budget_report_running_texts(const Wording& words, const EvaluationRecord& record) {
    const std::string title = shortened(printable(words.localised(title_of(record)).first()), 80);
    const std::string laboratory = record.certificate
                                       ? printable(words.localised(record.certificate->data.laboratory.name).first())
                                       : std::string();
    std::string head = words("document", "budget_report_type").first();
    if (record.certificate && !record.certificate->data.number.empty()) {
        head = words
                   .filled(
                       "certificate", "certificate_of_head",
                       {{"type", words("document", "budget_report_type")}, {"number", record.certificate->data.number}})
                   .first();
    }
    return {{"header_left", laboratory.empty() ? title : shortened(laboratory, 80)},
            {"header_right", printable(head) + " · " + words("document", "budget_report_mark").first()},
            {"footer_left", std::string(k_report_form) + " · " + record.software.name + " " + record.software.version}};
}

}  // namespace gumcert::reports
