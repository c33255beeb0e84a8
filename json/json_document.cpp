#include "json/json_document.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "json/json_pointer.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::json {

std::string JsonDocument::where(const std::string& pointer) const {
    std::string shown = text::visible(file) + "#" + text::visible(pointer);
    if (const auto place = places.find(pointer); place != places.end()) {
        if (is_table) {
            return text::where_in_text(file, place->second);
        }
        shown += " (" + text::line_and_column(place->second) + ")";
    }
    return shown;
}

std::string JsonDocument::number_as_written(const std::string& pointer) const {
    const auto place = places.find(pointer);
    if (place == places.end()) {
        return "";
    }
    const std::size_t begin = std::min(place->second.offset, text.size());
    const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE", begin), text.size());
    return text.substr(begin, end - begin);
}

int JsonDocument::decimals_as_written(const std::string& pointer) const {
    std::vector<std::string> numbers{number_as_written(pointer)};
    if (numbers.front().empty()) {
        numbers.front() = number_as_written(child_pointer(pointer, 0));
        while (!numbers.back().empty()) {
            numbers.push_back(number_as_written(child_pointer(pointer, numbers.size())));
        }
        numbers.pop_back();
    }
    return text::most_decimals(numbers);
}

std::string described(const nlohmann::json& value) {
    switch (value.type()) {
        case nlohmann::json::value_t::null:
            return "null";
        case nlohmann::json::value_t::boolean:
            return value.get<bool>() ? "true" : "false";
        case nlohmann::json::value_t::string:
            return text::in_quotes(value.get_ref<const std::string&>());
        case nlohmann::json::value_t::discarded:
            return "not a number";
        case nlohmann::json::value_t::object:
            return "an object";
        case nlohmann::json::value_t::array:
            return "an array";
        case nlohmann::json::value_t::number_integer:
            return std::to_string(value.get<std::int64_t>());
        case nlohmann::json::value_t::number_unsigned:
            return std::to_string(value.get<std::uint64_t>());
        default:
            return text::shortest_plain(value.get<double>());
    }
}

}  // namespace gumcert::json
