#pragma once

#include "reports/forms/render.h"

#include <string>

namespace gumcert::reports {

class PdfWorker;

// A label for the calibrated item, 60 mm × 30 mm, black on white: see label_view(). Its QR code leads from the item to the
// record.

/// \throws gum::InputError     GC-REPORT-0043 of a record without certificate data
/// \throws gum::NoResultError  GC-REPORT-0044 where the QR code cannot hold the number of the certificate
/// \throws gum::StorageError   if the wording is missing or damaged
[[nodiscard]] std::string render_label_svg(const EvaluationRecord& record, const RenderAssets& assets);

/// PDF/A-3a, set by templates/pdf/label.typ.
/// \throws the same, and those of render_pdf()
[[nodiscard]] std::string render_label_pdf(const EvaluationRecord& record, const RenderAssets& assets,
                                           PdfWorker* worker = nullptr);

}  // namespace gumcert::reports
