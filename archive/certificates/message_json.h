#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

/// A message as commands of an archive show it to programs, and hand it to each other; without its severity.
[[nodiscard]] nlohmann::json as_json(const gum::Diagnostic& diagnostic);
/// A list of them; empty, and not null, where there are none.
[[nodiscard]] nlohmann::json as_json(const std::vector<gum::Diagnostic>& diagnostics);

}  // namespace gumcert::archive
