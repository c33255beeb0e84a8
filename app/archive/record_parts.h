#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

/// A member of an object; null where there is none, or no object. Records of every version are looked into with it.
[[nodiscard]] const nlohmann::json& part_of(const nlohmann::json& object, const char* key);

/// The text of a member; "" where it is none.
[[nodiscard]] std::string text_of(const nlohmann::json& object, const char* key);

/// A message as commands of an archive show it to programs, and hand it to each other; without its severity.
[[nodiscard]] nlohmann::json as_json(const gum::Diagnostic& diagnostic);

}  // namespace gumcert::app
