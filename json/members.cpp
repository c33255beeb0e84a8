#include "json/members.h"

#include <nlohmann/json.hpp>

namespace gumcert::json {

const nlohmann::json& part_of(const nlohmann::json& object, const char* key) {
    static const nlohmann::json k_nothing;
    if (!object.is_object()) {
        return k_nothing;
    }
    const auto found = object.find(key);
    return found != object.end() ? *found : k_nothing;
}

std::string text_of(const nlohmann::json& object, const char* key) {
    const nlohmann::json& value = part_of(object, key);
    return value.is_string() ? value.get<std::string>() : "";
}

}  // namespace gumcert::json
