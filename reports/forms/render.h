#pragma once

#include "reports/forms/read_wordings.h"
#include "reports/record/evaluation_record.h"
#include "reports/view/document_kinds.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gumcert::reports {

/// A head of an archive that certificates print, so that whoever holds one can ask for the log behind it
/// (docs/adr/0059-the-head-on-the-certificate.md).
struct HeadToPrint {
    std::string entries;   ///< how many the log had
    std::string digits;    ///< the short form, for people
    std::string mark;      ///< what the QR code holds; it stands among the bytes of the document
    std::string check_at;  ///< where it can be checked: an address, a telephone number; "" without
};

/// Where the renderers find what they need. The caller knows the folders; nothing is searched for.
struct RenderAssets {
    std::filesystem::path templates;     ///< folder with certificate.html.mustache, pdf/, wording/
    std::filesystem::path node_program;  ///< the program node, for PDF only
    std::filesystem::path node_modules;  ///< folder with @myriaddreamin/typst-ts-node-compiler, for PDF only
    std::filesystem::path temporary_folder = "/tmp";  ///< PDF only: a private folder is made in it and removed again
    std::vector<std::filesystem::path>
        fonts;  ///< folders with fonts for scripts that the built-in fonts lack; PDF only
    /// Languages to print in, the binding one first, at most two; empty: those of the certificate data, else English.
    std::vector<std::string> languages;
    /// The first digits of template_digest() where the templates are not those of the release; "": they are. Documents
    /// say it on every page.
    std::string changed_templates = {};
    std::optional<HeadToPrint> head = {};  ///< certificates and reports as HTML, PDF and text print it at their end
    std::chrono::seconds pdf_time_limit{60};
    std::uint64_t pdf_memory_limit = std::uint64_t{4} << 30U;  ///< of the process that sets pages, [byte]
    std::span<const DocumentKind> kinds = document_kinds();    ///< what records of each kind show
    std::shared_ptr<ReadWordings> wordings = std::make_shared<ReadWordings>();  ///< copies of this object share it
};

/// The certificate as one HTML file: style and plots inside, no scripts, nothing to load.
/// \throws gum::NoResultError  GC-REPORT-0032 where a template leaves out the head that is to be printed
/// \throws gum::StorageError if a template is missing or damaged
[[nodiscard]] std::string render_html(const EvaluationRecord& record, const RenderAssets& assets);

/// The budget report, see budget_report_view(), as HTML.
/// \throws gum::InputError    GC-REPORT-0042 of the record of a comparison
/// \throws gum::StorageError  if a template is missing or damaged
[[nodiscard]] std::string render_budget_report_html(const EvaluationRecord& record, const RenderAssets& assets);

/// The certificate as plain text, UTF-8, lines of at most 100 characters. Plots are left out.
/// \throws gum::StorageError if the wording is missing or damaged
[[nodiscard]] std::string render_text(const EvaluationRecord& record, const RenderAssets& assets);

class PdfWorker;

/// The certificate as PDF/A-3a, set by Typst in a child process. The same record gives the same bytes. What was set is
/// checked (reports/forms/pdf_conformity.h) before it is returned.
///
/// The creation date is the date of issue; 1970-01-01 where the record states none, for PDF/A demands one.
/// \param dcc     the digital certificate to attach, signed or not; "" without
/// \param worker  for many documents; none: a process for this one alone
/// \throws gum::StorageError   if node or the Typst package is missing, or the child process fails or takes too long
/// \throws gum::NoResultError  if Typst refuses the document, e.g. for a character that its fonts do not have
[[nodiscard]] std::string render_pdf(const EvaluationRecord& record, const RenderAssets& assets,
                                     const std::string& dcc = {}, PdfWorker* worker = nullptr);

/// The budget report as PDF/A-3a.
/// \throws as render_budget_report_html(), and render_pdf()
[[nodiscard]] std::string render_budget_report_pdf(const EvaluationRecord& record, const RenderAssets& assets,
                                                   PdfWorker* worker = nullptr);

}  // namespace gumcert::reports
