#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace gumcert::json {

/// The member of an object; null where there is none, or no object. Looks into records of every version, and into answers
/// of others, without asking first whether a part is there.
[[nodiscard]] const nlohmann::json& part_of(const nlohmann::json& object, const char* key);

/// The text of a member; "" where it is none.
[[nodiscard]] std::string text_of(const nlohmann::json& object, const char* key);

}  // namespace gumcert::json
