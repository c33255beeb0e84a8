#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gumcert::jobs {

/// Puts a value in the place of another one that was refused: readers say nothing more of it.
inline void discard(nlohmann::json& value) {
    value = nlohmann::json(nlohmann::json::value_t::discarded);
}

/// The text under a key; "" where there is none.
[[nodiscard]] inline std::string text_in(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Writes a text under a key, unless it is "".
inline void set_if_stated(nlohmann::json& row, const char* key, const std::string& text) {
    if (!text.empty()) {
        row[key] = text;
    }
}

}  // namespace gumcert::jobs
