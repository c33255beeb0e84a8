#include "issuing/output_forms.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/dcc_document.h"
#include "reports/forms/comparison_csv.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/label.h"

namespace gumcert::issuing {

namespace {

constexpr std::string_view k_digital_certificate = "dcc";

std::string pdf(Issue& issue) {
    const IssueOptions& options = issue.options();
    const std::string& attached =
        is_certificate(issue.record(), options.kinds) ? issue.digital_certificate() : std::string();
    std::string pdf = reports::document_as_pdf(issue.view(), options.assets, attached, options.worker);
    if (options.signer == nullptr) {
        return pdf;
    }
    signing::require_a_chain(*options.signer, options.signing_time);
    return signing::sign_pdf(pdf, *options.signer, options.signing_time);
}

constexpr std::array<OutputForm, 9> k_forms{{
    {.name = "html",
     .ending = ".html",
     .description = "",
     .render = [](Issue& issue) { return reports::document_as_html(issue.view(), issue.options().assets); }},
    {.name = "pdf", .ending = ".pdf", .description = "", .render = pdf, .is_signed = true},
    {.name = "text",
     .ending = ".txt",
     .description = "",
     .render = [](Issue& issue) { return reports::view_as_text(issue.view()); }},
    {.name = k_digital_certificate,
     .ending = ".xml",
     .description = "digital certificate, XML",
     .render = [](Issue& issue) { return issue.digital_certificate(); },
     .is_signed = true},
    {.name = "csv",
     .ending = ".csv",
     .description = "scores of a comparison",
     .render = [](Issue& issue) { return reports::comparison_csv(issue.record()); },
     .with_templates = false},
    {.name = "report",
     .ending = "-report.pdf",
     .description = "internal budget report, PDF",
     .render =
         [](Issue& issue) {
             return reports::render_budget_report_pdf(issue.record(), issue.options().assets, issue.options().worker);
         },
     .is_issued = false},
    {.name = "report-html",
     .ending = "-report.html",
     .description = "the same, HTML",
     .render = [](Issue& issue) { return reports::render_budget_report_html(issue.record(), issue.options().assets); },
     .is_issued = false},
    {.name = "label",
     .ending = "-label.pdf",
     .description = "label for the item, PDF",
     .render =
         [](Issue& issue) {
             return reports::render_label_pdf(issue.record(), issue.options().assets, issue.options().worker);
         }},
    {.name = "label-svg",
     .ending = "-label.svg",
     .description = "the same, SVG",
     .render = [](Issue& issue) { return reports::render_label_svg(issue.record(), issue.options().assets); }},
}};

}  // namespace

const nlohmann::json& Issue::view() {
    if (!view_) {
        view_ = std::make_shared<const nlohmann::json>(reports::view_of_document(record_, options_.assets));
    }
    return *view_;
}

const std::string& Issue::digital_certificate() {
    if (!is_certificate(record_, options_.kinds)) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-REPORT-0041",
                            .where = "record",
                            .what = "a record of kind \"" + record_.kind + "\" has no digital calibration certificate",
                            .rule = "only a record of a calibration has one",
                            .action = "use --format html, pdf, text or csv; its record (JSON) is what programs read"});
    }
    if (digital_certificate_.empty()) {
        digital_certificate_ = reports::render_dcc(record_, options_.assets);
        if (options_.signer != nullptr) {
            signing::require_a_chain(*options_.signer, options_.signing_time);
            digital_certificate_ = signing::sign_dcc(digital_certificate_, *options_.signer, options_.signing_time);
        }
    }
    return digital_certificate_;
}

std::span<const OutputForm> output_forms() {
    return k_forms;
}

const OutputForm& output_form(std::string_view name) {
    const auto found = std::ranges::find(k_forms, name, &OutputForm::name);
    if (found == k_forms.end()) {
        throw std::invalid_argument("a form of documents that there is not: " + std::string(name));
    }
    return *found;
}

bool is_certificate(const reports::EvaluationRecord& record, std::span<const evaluation::Kind> kinds) {
    return std::ranges::find(evaluation::kind_of(record, kinds).forms, k_digital_certificate) !=
           evaluation::kind_of(record, kinds).forms.end();
}

}  // namespace gumcert::issuing
