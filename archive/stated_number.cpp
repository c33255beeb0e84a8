#include "archive/stated_number.h"

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "json/members.h"
#include "json/strict_parser.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;

/// Where a record has its number: of a certificate, else of the report of a comparison.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> k_places{
    {{"certificate", "data"}, {"comparison", "issuer"}}};

/// Goes through the lines of canonical JSON, in which a line is indented by a blank for each object around it.
class Lines {
public:
    explicit Lines(std::string_view text) : left_(text) {}

    /// Goes on to a line of this depth that begins with something, and not beyond the end of the object.
    /// \return what follows; none where there is no such line
    std::optional<std::string_view> next(std::size_t depth, std::string_view begins_with) {
        const std::string_view blanks = std::string_view("   ").substr(0, depth);
        while (left_.starts_with(blanks)) {
            const std::string_view line = left_.substr(0, left_.find('\n'));
            if (line.size() == left_.size()) {
                break;  // without an end of the line
            }
            left_.remove_prefix(line.size() + 1);
            if (line.substr(depth).starts_with(begins_with)) {
                return line.substr(depth + begins_with.size());
            }
        }
        return std::nullopt;
    }

private:
    std::string_view left_;
};

/// The number in a record as this program writes it, which is found in its first lines; of any other text none may be found.
std::optional<json> number_in_lines(std::string_view record) {
    const std::size_t begin = record.find('\n') + 1;  // behind "{"
    for (const auto& [outer, inner] : k_places) {
        Lines lines(record.substr(begin));
        if (lines.next(1, '"' + std::string(outer) + "\": {") == "" &&
            lines.next(2, '"' + std::string(inner) + "\": {") == "") {
            if (std::optional<std::string_view> number = lines.next(3, "\"number\": ")) {
                const bool more = number->ends_with(',');
                return gumcert::json::parse_faultless(number->substr(0, number->size() - (more ? 1 : 0)), {});
            }
        }
    }
    return std::nullopt;
}

}  // namespace

std::string number_stated_in(std::string_view record) {
    if (const std::optional<json> number = number_in_lines(record); number && number->is_string()) {
        return number->get<std::string>();
    }
    constexpr std::size_t k_longest_text = std::size_t{512} << 20U;  // records hold files of their jobs
    const std::optional<json> value = gumcert::json::parse_faultless(record, {.string_bytes = k_longest_text});
    for (const auto& [outer, inner] : k_places) {
        if (value) {
            const json& part = gumcert::json::part_of(gumcert::json::part_of(*value, std::string(outer).c_str()),
                                                      std::string(inner).c_str());
            if (std::string number = gumcert::json::text_of(part, "number"); !number.empty()) {
                return number;
            }
        }
    }
    return "";
}

}  // namespace gumcert::archive
