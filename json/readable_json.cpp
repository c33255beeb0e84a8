#include "json/readable_json.h"

#include <nlohmann/json.hpp>

namespace gumcert::json {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t k_line = 120;

std::string before_element(const std::string& key, bool in_object) {
    return in_object ? ordered_json(key).dump() + ": " : std::string();
}

std::string in_one_line(const ordered_json& value) {
    if (!value.is_structured() || value.empty()) {
        return value.dump();
    }
    std::string text = value.is_object() ? "{ " : "[";
    const char* separator = "";
    for (const auto& [key, element] : value.items()) {
        text += separator + before_element(key, value.is_object()) + in_one_line(element);
        separator = ", ";
    }
    return text + (value.is_object() ? " }" : "]");
}

void lay_out(const ordered_json& value, std::size_t indent, std::size_t column, std::string& out) {
    const std::string line = in_one_line(value);
    if (!value.is_structured() || value.empty() || column + line.size() < k_line) {
        out += line;
        return;
    }
    out += value.is_object() ? "{" : "[";
    const char* separator = "\n";
    for (const auto& [key, element] : value.items()) {
        const std::string start = std::string(indent + 2, ' ') + before_element(key, value.is_object());
        out += separator + start;
        lay_out(element, indent + 2, start.size(), out);
        separator = ",\n";
    }
    out += "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
}

}  // namespace

std::string readable_json(const ordered_json& value, std::size_t indent, std::size_t column) {
    std::string text;
    lay_out(value, indent, column, text);
    return text;
}

}  // namespace gumcert::json
