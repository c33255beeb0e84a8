#include "text/markup_size.h"

#include <algorithm>
#include <array>
#include <utility>

namespace gumcert::text {

namespace {

/// Behind what is no tag and begins at a place; the place itself where a tag does.
std::size_t behind_other_markup(std::string_view bytes, std::size_t at) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> k_other{
        {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};
    for (const auto& [open, close] : k_other) {
        if (bytes.substr(at).starts_with(open)) {
            return bytes.find(close, at + open.size());
        }
    }
    return at;
}

/// The end of a tag; its values are counted.
std::size_t end_of_tag(std::string_view bytes, std::size_t at, std::size_t& values) {
    for (; at < bytes.size() && bytes[at] != '>'; ++at) {
        if (bytes[at] != '"' && bytes[at] != '\'') {
            continue;
        }
        at = bytes.find(bytes[at], at + 1);
        if (at == std::string_view::npos) {
            return at;
        }
        ++values;
    }
    return at;
}

}  // namespace

MarkupSize markup_size(std::string_view bytes) {
    MarkupSize size;
    for (std::size_t at = bytes.find('<'); at != std::string_view::npos; at = bytes.find('<', at)) {
        const std::size_t behind = behind_other_markup(bytes, at);
        if (behind != at) {
            at = behind;
            if (at == std::string_view::npos) {
                break;
            }
            continue;
        }
        std::size_t values = 0;
        at = end_of_tag(bytes, at + 1, values);
        ++size.tags;
        size.attributes += values;
        size.most_in_tag = std::max(size.most_in_tag, values);
        if (at == std::string_view::npos) {
            break;
        }
    }
    return size;
}

}  // namespace gumcert::text
