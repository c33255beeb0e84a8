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

/// Goes through JSON as this program writes it: a line has one value, the beginning or the end of one, or an array without objects and
/// arrays, and a blank for each object or array around it. Every line is held against that, so that what stands at a place is there in JSON, too.
class Lines {
public:
    explicit Lines(std::string_view text) : left_(text) {}

    bool take(std::string_view line) {
        const bool is_next = left_.starts_with(line);
        left_.remove_prefix(is_next ? line.size() : 0);
        return is_next;
    }

    /// Goes on to the member of a key, over those before it.
    /// \return false where it is not there, or a line is another one than this program writes
    bool find(std::size_t depth, std::string_view key) {
        const std::string member = std::string(depth, ' ') + '"' + std::string(key) + "\": ";
        while (!left_.starts_with(member)) {
            if (!skip(depth)) {
                return false;
            }
        }
        return take(member);
    }

    /// A text that ends its line, with its quotes.
    std::string_view take_text() {
        const std::string_view before = left_;
        return skip_text() && ends_line() ? before.substr(0, before.find('\n') - (before_end_ == ',' ? 1U : 0U))
                                          : std::string_view();
    }

private:
    static constexpr std::size_t k_deepest = 12;  // what lies deeper is read as JSON
    std::string_view left_;
    char before_end_ = 0;

    bool ends_line() {
        before_end_ = left_.starts_with(',') ? ',' : '\0';
        left_.remove_prefix(before_end_ == ',' ? 1 : 0);
        return take("\n");
    }
    bool skip_text() {
        if (!left_.starts_with('"')) {
            return false;
        }
        for (std::size_t i = 1; i < left_.size() && left_[i] != '\n'; ++i) {
            if (left_[i] == '"') {
                left_.remove_prefix(i + 1);
                return true;
            }
            if (left_[i] == '\\' && (++i == left_.size() || left_[i] == '\n')) {
                return false;
            }
        }
        return false;
    }
    bool skip_word() {
        const std::size_t end =
            left_.find_first_not_of("+-.0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz");
        const bool is_one = end != std::string_view::npos && end > 0;
        left_.remove_prefix(is_one ? end : 0);
        return is_one;
    }
    bool skip_inner(std::size_t depth) {
        const std::string blanks(depth, ' ');
        while (!left_.starts_with(blanks + "}") && !left_.starts_with(blanks + "]")) {
            if (depth == k_deepest || !skip(depth + 1)) {
                return false;
            }
        }
        left_.remove_prefix(depth + 1);
        return ends_line();
    }
    bool skip_plain() { return skip_text() || skip_word(); }
    /// The rest of an array without objects and arrays.
    bool skip_array() {
        if (take("]")) {
            return true;
        }
        do {
            if (!skip_plain()) {
                return false;
            }
        } while (take(", "));
        return take("]");
    }
    /// A value, with its key where it has one.
    bool skip(std::size_t depth) {
        if (!take(std::string(depth, ' '))) {
            return false;
        }
        if (skip_text() && !take(": ")) {
            return ends_line();
        }
        return take("{\n") || take("[\n") ? skip_inner(depth)
                                          : (take("{}") || (take("[") ? skip_array() : skip_plain())) && ends_line();
    }
};

/// The number of a certificate in a record as this program writes it, which is found in its first lines; "" of any other text.
std::string number_in_lines(std::string_view record) {
    Lines lines(record);
    if (!lines.take("{\n") || !lines.find(1, k_places[0].first) || !lines.take("{\n") ||
        !lines.find(2, k_places[0].second) || !lines.take("{\n") || !lines.find(3, "number")) {
        return "";
    }
    const std::optional<json> number = gumcert::json::parse_faultless(lines.take_text(), {});
    return number && number->is_string() ? number->get<std::string>() : "";
}

}  // namespace

std::string number_stated_in(std::string_view record) {
    if (std::string number = number_in_lines(record); !number.empty()) {
        return number;
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
