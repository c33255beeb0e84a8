// Changes of XML that leave it well-formed where it was: elements taken out, repeated and moved, texts changed.

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/fuzz/mutated_bytes.h"

namespace gumcert::fuzz {
namespace {

struct Range {
    std::size_t begin = 0, end = 0;
};

struct XmlRanges {
    std::vector<Range> elements, texts;  ///< texts: between tags, and values of attributes
};

/// Elements and texts as far as tags fit each other.
XmlRanges ranges_of(std::string_view xml) {
    XmlRanges ranges;
    std::vector<std::size_t> open;
    for (std::size_t at = xml.find('<'); at < xml.size(); at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find('>', at);
        if (end == std::string_view::npos || at + 1 >= xml.size()) {
            break;
        }
        const char kind = xml[at + 1];
        if (kind == '/') {
            if (!open.empty()) {
                ranges.elements.push_back({open.back(), end + 1});
                open.pop_back();
            }
        } else if (kind != '?' && kind != '!') {
            if (xml[end - 1] == '/') {
                ranges.elements.push_back({at, end + 1});
            } else {
                open.push_back(at);
            }
            for (std::size_t quote = xml.find('"', at); quote < end;) {
                const std::size_t close = xml.find('"', quote + 1);
                if (close >= end) {
                    break;
                }
                ranges.texts.push_back({quote + 1, close});
                quote = xml.find('"', close + 1);
            }
        }
        const std::size_t next = std::min(xml.find('<', end), xml.size());
        if (next > end + 1 && xml[end + 1] != '\n') {
            ranges.texts.push_back({end + 1, next});
        }
    }
    return ranges;
}

std::string changed_text(const std::string& text, std::mt19937& random) {
    static const std::vector<std::string> k_texts{
        "0", "-1", "NaN", "1e300", "0.95", "2", "1.0 2.0 3.0", "1e-9", "\\metre", "\\milli\\metre", "", "true", "INF"};
    return random() % 3 == 0 ? k_texts[random() % k_texts.size()] : mutated_text(text);
}

std::string changed_xml(std::string xml, std::string_view other, unsigned seed) {
    std::mt19937 random(seed);
    const XmlRanges ranges = ranges_of(xml);
    const auto one_of = [&](const std::vector<Range>& all) { return all[random() % all.size()]; };
    const auto part = [](std::string_view text, const Range& range) {
        return std::string(text.substr(range.begin, range.end - range.begin));
    };
    if (ranges.elements.empty() || random() % 8 == 0) {
        return mutated_text(std::move(xml));
    }
    const Range element = one_of(ranges.elements);
    switch (random() % 6) {
        case 0:
            return xml.erase(element.begin, element.end - element.begin);
        case 1:
            return xml.insert(element.end, part(xml, element));
        case 2:
        case 3: {
            const XmlRanges of_other = ranges_of(other);
            const std::vector<Range>& lent = of_other.elements.empty() ? ranges.elements : of_other.elements;
            const std::string moved = part(of_other.elements.empty() ? std::string_view(xml) : other, one_of(lent));
            return random() % 2 == 0 ? xml.insert(element.begin, moved)
                                     : xml.replace(element.begin, element.end - element.begin, moved);
        }
        default:
            if (ranges.texts.empty()) {
                return mutated_text(std::move(xml));
            }
            const Range text = one_of(ranges.texts);
            return xml.replace(text.begin, text.end - text.begin, changed_text(part(xml, text), random));
    }
}

}  // namespace

std::string changed_input(std::string_view input, std::string_view other, unsigned seed) {
    return changed_xml(std::string(input), other, seed);
}

}  // namespace gumcert::fuzz
