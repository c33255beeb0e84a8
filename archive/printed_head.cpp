#include "archive/printed_head.h"

#include <charconv>
#include <optional>
#include <set>
#include <utility>

#include "encoding/sha2.h"
#include "text/lists.h"

namespace gumcert::archive {

namespace {

constexpr std::string_view k_mark = "gumcert-head:";
constexpr std::size_t k_root_digits = 64;

/// \param text  behind the mark: "1234:5dc9da79…" and what follows
std::optional<PrintedHead> head_at(std::string_view text) {
    PrintedHead head;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), head.size);
    const auto digits = static_cast<std::size_t>(end - text.data());
    if (error != std::errc() || head.size < 1 || text.front() == '0' || text.size() < digits + 1 + k_root_digits ||
        text[digits] != ':') {
        return std::nullopt;
    }
    const std::optional<std::string> root =
        encoding::bytes_from_hexadecimal(std::string(text.substr(digits + 1, k_root_digits)));
    if (!root) {
        return std::nullopt;
    }
    head.root = *root;
    return head;
}

}  // namespace

std::string mark_of(const Head& head) {
    return std::string(k_mark) + std::to_string(head.size) + ":" + encoding::hexadecimal(head.root);
}

std::string short_form(const Head& head) {
    constexpr std::size_t k_groups = 4;
    constexpr std::size_t k_digits = 4;
    const std::string digits = encoding::hexadecimal(head.root);
    std::string text;
    for (std::size_t i = 0; i < k_groups; ++i) {
        text += (i == 0 ? "" : " ") + digits.substr(i * k_digits, k_digits);
    }
    return text;
}

std::vector<PrintedHead> printed_heads_in(std::string_view document) {
    std::vector<PrintedHead> heads;
    std::set<std::pair<std::int64_t, std::string>> known;
    for (std::size_t at = document.find(k_mark); at != std::string_view::npos; at = document.find(k_mark, at + 1)) {
        const std::optional<PrintedHead> head = head_at(document.substr(at + k_mark.size()));
        if (head && known.emplace(head->size, head->root).second) {
            heads.push_back(*head);
        }
    }
    return heads;
}

std::string fault_of(const PrintedHead& head, bool is_of_log, std::int64_t drafted, std::int64_t archived) {
    const std::string which = "prints a head of " + text::count_of(head.size, "entry");
    return !is_of_log || head.size >= archived ? which + ", which the log did not have before the document"
           : drafted > head.size               ? which + ", which does not contain the draft of its record"
                                               : "";
}

}  // namespace gumcert::archive
