#pragma once

#include <string>

#include "reports/audit/audit_view.h"
#include "reports/forms/render.h"

namespace gumcert::reports {

/// The audit as one HTML file for an assessor: style, drawings and script inside, nothing to load. The script opens and
/// filters only: without it everything is there. Its digest stands in the policy of the page, so that no other runs.
///
/// First the page that answers ten questions (measurand, equation, contributions, contributors that every budget has,
/// claimed against recomputed, capability, linearity, worst findings, accepted deviations, questions to the laboratory),
/// then every finding, and the budget contribution by contribution.
/// \param assets  templates and languages; the first language is used. Sentences of rules that the catalogue does not
///                have in it stay English and are marked so.
/// \throws gum::StorageError  if a template or the wording is missing or damaged
[[nodiscard]] std::string audit_as_html(const AuditView& view, const RenderAssets& assets);

}  // namespace gumcert::reports
