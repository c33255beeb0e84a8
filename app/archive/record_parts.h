#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace gumcert::app {

/// A member of an object; null where there is none, or no object. Records of every version are looked into with it.
[[nodiscard]] const nlohmann::json& part_of(const nlohmann::json& object, const char* key);

/// The text of a member; "" where it is none.
[[nodiscard]] std::string text_of(const nlohmann::json& object, const char* key);

}  // namespace gumcert::app
