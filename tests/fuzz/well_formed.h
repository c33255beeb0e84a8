#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/demand.h"

namespace gumcert::fuzz {

/// Elements of HTML without an end.
inline bool is_void_element(std::string_view name) {
    static constexpr std::array<std::string_view, 7> k_names{"meta", "img", "br", "hr", "link", "col", "input"};
    return std::ranges::find(k_names, name) != k_names.end();
}

/// A tag begins at `at`: its attributes have quoted values and nothing acts in them.
/// \return where it ends
inline std::size_t demand_tag(std::string_view html, std::size_t at) {
    while (at < html.size() && html[at] != '>' && html[at] != '/') {
        if (std::isspace(static_cast<unsigned char>(html[at])) != 0) {
            ++at;
            continue;
        }
        const std::size_t name = at;
        while (at < html.size() && (std::isalnum(static_cast<unsigned char>(html[at])) != 0 || html[at] == '-' ||
                                    html[at] == ':' || html[at] == '_')) {
            ++at;
        }
        demand(at > name && !html.substr(name).starts_with("on"), "an attribute that acts, or none");
        if (at < html.size() && html[at] == '=') {
            demand(html.substr(at + 1).starts_with('"'), "an attribute without quotation marks");
            const std::size_t close = html.find('"', at + 2);
            demand(close != std::string_view::npos, "a quotation mark that is not closed");
            demand(html.substr(at, close - at).find('<') == std::string_view::npos, "a tag in an attribute");
            at = close + 1;
        }
    }
    demand(at < html.size(), "a tag that is not closed");
    return at;
}

/// A page whose elements are closed in turn, in which nothing acts and nothing is loaded.
inline void demand_well_formed_html(std::string_view html) {
    std::vector<std::string> open;
    std::size_t at = 0;
    while ((at = html.find('<', at)) != std::string_view::npos) {
        if (html.substr(at).starts_with("<!DOCTYPE html>")) {
            at += 15;
            continue;
        }
        const bool is_end = html.substr(at).starts_with("</");
        const std::size_t name_at = at + (is_end ? 2 : 1);
        std::size_t name_end = name_at;
        while (name_end < html.size() &&
               (std::isalnum(static_cast<unsigned char>(html[name_end])) != 0 || html[name_end] == '-')) {
            ++name_end;
        }
        const std::string name(html.substr(name_at, name_end - name_at));
        demand(!name.empty(), "a < that begins no tag");
        demand(name != "script" && name != "iframe" && name != "object" && name != "foreignObject", "a page that acts");
        const std::size_t end = demand_tag(html, name_end);
        const bool closes_itself = html[end] == '/';
        if (is_end) {
            demand(!open.empty() && open.back() == name, "an element that is closed out of turn");
            open.pop_back();
        } else if (!closes_itself && !is_void_element(name)) {
            open.push_back(name);
        }
        at = end + 1;
        if (!is_end && name == "style") {
            at = html.find("</style>", at);
        }
    }
    demand(open.empty(), "an element that is not closed");
}

/// No control characters but the ends of lines.
inline bool is_plain_text(std::string_view text) {
    return std::ranges::none_of(
        text, [](char c) { return (static_cast<unsigned char>(c) < 0x20U && c != '\n') || c == '\x7F'; });
}

}  // namespace gumcert::fuzz
