#include "reports/forms/html_texts.h"

#include "text/small_letters.h"
#include "text/utf8.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <utility>

namespace gumcert::reports {

namespace {

/// The character that "&…;" stands for; "" for one that is not known.
std::string referred(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> k_names = {
        {{"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"apos", "'"}, {"nbsp", "\u00A0"}, {"shy", "\u00AD"}}};
    for (const auto& [known, character] : k_names) {
        if (name == known) {
            return std::string(character);
        }
    }
    if (!name.starts_with('#')) {
        return {};
    }
    const bool hexadecimal = name.size() > 1 && (name[1] == 'x' || name[1] == 'X');
    const std::string_view digits = name.substr(hexadecimal ? 2 : 1);
    unsigned code = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), code, hexadecimal ? 16 : 10);
    const bool is_code = error == std::errc() && end == digits.data() + digits.size() && code > 0 && code < 0x110000U &&
                         !(code >= 0xD800U && code < 0xE000U);
    return is_code ? text::encode_utf8(code) : std::string();
}

std::string without_references(std::string_view text) {
    constexpr std::size_t k_longest = 10;
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        // Looked for no further than a reference may be long: a page of nothing but "&" is read once, not once a sign.
        const std::size_t length = text[at] == '&' ? text.substr(at, k_longest + 1).find(';') : std::string_view::npos;
        const std::size_t end = at + length;
        const std::string character =
            length != std::string_view::npos ? referred(text.substr(at + 1, length - 1)) : std::string();
        out += character.empty() ? std::string(1, text[at]) : character;
        at = character.empty() ? at + 1 : end + 1;
    }
    return out;
}

/// Where a tag ends: behind a '>' that stands in no quotes.
std::size_t end_of_tag(std::string_view html, std::size_t at) {
    char quote = '\0';
    for (; at < html.size(); ++at) {
        const char c = html[at];
        if (quote != '\0') {
            quote = c == quote ? '\0' : quote;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '>') {
            return at + 1;
        }
    }
    return html.size();
}

std::string name_of_tag(std::string_view tag) {
    std::size_t end = 1;
    while (end < tag.size() && ((tag[end] >= 'a' && tag[end] <= 'z') || (tag[end] >= 'A' && tag[end] <= 'Z') ||
                                (tag[end] >= '0' && tag[end] <= '9'))) {
        ++end;
    }
    return text::in_small_letters(tag.substr(1, end - 1));
}

std::string data_text(std::string_view tag) {
    constexpr std::string_view k_attribute = " data-text=\"";
    const std::size_t found = tag.find(k_attribute);
    if (found == std::string_view::npos) {
        return {};
    }
    const std::size_t from = found + k_attribute.size();
    return ' ' + without_references(tag.substr(from, std::min(tag.find('"', from), tag.size()) - from));
}

}  // namespace

std::string text_of_html(std::string_view html) {
    static constexpr std::array<std::string_view, 5> k_unseen = {"head", "style", "script", "svg", "template"};
    const std::string small = text::in_small_letters(html);
    std::string text;
    for (std::size_t at = 0; at < html.size();) {
        const std::size_t tag = html.find('<', at);
        text += without_references(html.substr(at, tag == std::string_view::npos ? tag : tag - at));
        if (tag == std::string_view::npos) {
            break;
        }
        if (html.substr(tag).starts_with("<!--")) {
            const std::size_t end = html.find("-->", tag);
            at = end == std::string_view::npos ? html.size() : end + 3;
            continue;
        }
        at = end_of_tag(html, tag);
        text += data_text(html.substr(tag, at - tag)) + ' ';
        const std::string name = name_of_tag(html.substr(tag, at - tag));
        if (std::find(k_unseen.begin(), k_unseen.end(), name) != k_unseen.end()) {
            const std::size_t end = small.find("</" + name, at);
            at = end == std::string_view::npos ? html.size() : end_of_tag(html, end);
        }
    }
    return text;
}

}  // namespace gumcert::reports
