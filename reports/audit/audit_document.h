#pragma once

#include <string>

#include "reports/audit/audit_view.h"
#include "reports/forms/render.h"

namespace gumcert::reports {

/// The audit as PDF/A-3a, with the look of a certificate and the mark that it is none; the sections of the first page of
/// audit_as_html(), then every finding. The same audit gives the same bytes.
/// \param assets  the first language is used
/// \throws gum::StorageError, gum::NoResultError  as render_pdf() of a record
[[nodiscard]] std::string audit_as_pdf(const AuditView& view, const RenderAssets& assets);

}  // namespace gumcert::reports
