#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gumcert::json {

/// Canonical text of a value (docs/adr/0004-canonical-json.md): keys sorted by code point, one blank a level of depth,
/// shortest numbers that read back the same, UTF-8, LF at the end.
/// \throws gum::NoResultError  if a number is not finite, a text is not UTF-8, or the value is nested deeper than the
///                             parser reads: it must never reach a document
[[nodiscard]] std::string canonical_json(const nlohmann::json& value);

}  // namespace gumcert::json
