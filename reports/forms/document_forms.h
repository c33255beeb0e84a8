#pragma once

#include "reports/forms/render.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace gumcert::reports {

// The forms of a document from its view, see certificate_view(). Certificates and studies share them.

[[nodiscard]] std::string view_as_text(const nlohmann::json& view);

/// \throws gum::StorageError if a template is missing or damaged
[[nodiscard]] std::string view_as_html(nlohmann::json view, const RenderAssets& assets);

/// \throws gum::StorageError, gum::NoResultError  as render_pdf() of a record
[[nodiscard]] std::string view_as_pdf(const nlohmann::json& view, const RenderAssets& assets);

}  // namespace gumcert::reports
