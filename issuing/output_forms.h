#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "evaluation/kinds.h"
#include "reports/forms/pdf_worker.h"
#include "reports/forms/render.h"
#include "reports/record/evaluation_record.h"
#include "signing/signer.h"

namespace gumcert::issuing {

/// What the documents of a record are made with.
struct IssueOptions {
    reports::RenderAssets assets;
    const signing::Signer* signer = nullptr;  ///< none: documents are not signed
    std::int64_t signing_time = 0;            ///< seconds since 1970-01-01 UTC
    reports::PdfWorker* worker = nullptr;     ///< for many documents; none: a process for each PDF
    std::span<const evaluation::Kind> kinds = evaluation::program_kinds();
};

/// A record on its way to documents. What they show is put together once for all forms. The digital certificate is made and
/// signed once, and the PDF has it attached as it was signed.
class Issue {
public:
    Issue(const reports::EvaluationRecord& record, const IssueOptions& options) : record_(record), options_(options) {}

    [[nodiscard]] const reports::EvaluationRecord& record() const { return record_; }
    [[nodiscard]] const IssueOptions& options() const { return options_; }
    /// reports::view_of_document()
    [[nodiscard]] const nlohmann::json& view();
    /// \throws gum::InputError  GC-REPORT-0041 of a record that has none
    [[nodiscard]] const std::string& digital_certificate();

private:
    const reports::EvaluationRecord& record_;
    const IssueOptions& options_;
    std::shared_ptr<const nlohmann::json> view_;
    std::string digital_certificate_;
};

/// A form that documents are written in, in one row.
struct OutputForm {
    std::string_view name;                ///< after --format
    std::string_view ending;              ///< of its files, behind the name of the record: ".html"
    std::string_view description;         ///< for --help, where the name alone says too little
    std::string (*render)(Issue& issue);  ///< refuses a record that has no such form (gum::InputError)
    bool with_templates = true;           ///< it is made with templates and wording
    bool is_issued = true;                ///< it goes to customers: findings that block a certificate block it as well
    bool is_signed = false;               ///< it takes a signature, or has a document with one inside
};

/// The forms of the program, in the order in which messages list them.
[[nodiscard]] std::span<const OutputForm> output_forms();

/// The form with this name.
/// \throws std::invalid_argument  if there is none: the command line and the rows of kinds name those of the table
[[nodiscard]] const OutputForm& output_form(std::string_view name);

/// Whether a record becomes a certificate, with a digital one, which may be signed; else a report.
[[nodiscard]] bool is_certificate(const reports::EvaluationRecord& record, std::span<const evaluation::Kind> kinds);

}  // namespace gumcert::issuing
