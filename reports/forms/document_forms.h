#pragma once

#include "reports/forms/render.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

// The forms of a document from its view, see certificate_view(). Certificates and studies share them.

/// A page from one of the templates (Mustache). Texts of the view are escaped where the template does not ask for them
/// as they are.
/// \param file  name in the folder of templates: "certificate.html.mustache"
/// \param view  objects, arrays and texts; an empty array is what does not apply
/// \throws gum::StorageError if the template is missing or damaged
[[nodiscard]] std::string filled_template(const std::string& file, const nlohmann::json& view,
                                          const RenderAssets& assets);

/// certificate_view() in the languages of the document. Where the templates were changed, the foot of the pages says it.
[[nodiscard]] nlohmann::json view_of_document(const EvaluationRecord& record, const RenderAssets& assets);

/// render_html() and render_pdf() of a record whose view_of_document() was made already.
/// \throws as these
[[nodiscard]] std::string document_as_html(const nlohmann::json& view, const RenderAssets& assets);
[[nodiscard]] std::string document_as_pdf(const nlohmann::json& view, const RenderAssets& assets,
                                          const std::string& dcc, PdfWorker* worker);

/// What stands on every page of a document, whatever the template does: the number of the certificate, its mark while it is
/// a draft or a specimen, and the digest of templates that were changed.
[[nodiscard]] std::vector<std::string> texts_of_every_page(const nlohmann::json& view);

/// \throws gum::NoResultError  GC-REPORT-0032 where the head that a document prints does not stand among its bytes
/// \param form  "HTML", "PDF"
void require_head(std::string_view document, const char* form, const RenderAssets& assets);

/// budget_report_view() in the languages of the document.
/// \throws gum::InputError  GC-REPORT-0042 of the record of a comparison
[[nodiscard]] nlohmann::json view_of_budget_report(const EvaluationRecord& record, const RenderAssets& assets);

[[nodiscard]] std::string view_as_text(const nlohmann::json& view);

/// \throws gum::StorageError if a template is missing or damaged
[[nodiscard]] std::string view_as_html(nlohmann::json view, const RenderAssets& assets);

/// \param view    label_view() with the drawing of its code
/// \param worker  none: a process for this label alone
/// \throws gum::StorageError, gum::NoResultError  as render_pdf() of a record
[[nodiscard]] std::string label_as_pdf(const nlohmann::json& view, const RenderAssets& assets, PdfWorker* worker);

/// \param worker  none: a process for this document alone
/// \throws gum::StorageError, gum::NoResultError  as render_pdf() of a record
[[nodiscard]] std::string view_as_pdf(const nlohmann::json& view, const RenderAssets& assets,
                                      PdfWorker* worker = nullptr);

/// Which of some characters no font of a document has. A page is set with them, so that node, Typst and the fonts are
/// known to work before an evaluation begins that would be lost without them.
/// \param view  of a document that shows the characters, as certificate_view(), in headings and in paragraphs
/// \return in the order of the characters
/// \throws gum::StorageError  as render_pdf()
[[nodiscard]] std::vector<std::string> without_glyph(const std::vector<std::string>& characters,
                                                     const nlohmann::json& view, const RenderAssets& assets,
                                                     PdfWorker& worker);

}  // namespace gumcert::reports
