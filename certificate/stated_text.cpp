#include "certificate/stated_text.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gumcert::certificate {

namespace {

struct Range {
    std::uint32_t first, last;
};

/// Code points that are no letter and no digit, of those that stand for one another or for nothing: punctuation,
/// symbols, spaces and letters without an image. What is not listed counts as a letter.
constexpr std::array<Range, 18> k_no_letters{{{0x00, 0x2F},
                                              {0x3A, 0x40},
                                              {0x5B, 0x60},
                                              {0x7B, 0xA9},
                                              {0xAB, 0xB1},
                                              {0xB4, 0xB4},
                                              {0xB6, 0xB8},
                                              {0xBB, 0xBF},
                                              {0x34F, 0x34F},
                                              {0x115F, 0x1160},
                                              {0x1680, 0x1680},
                                              {0x180E, 0x180E},
                                              {0x2000, 0x206F},
                                              {0x2190, 0x2BFF},
                                              {0x3000, 0x3004},
                                              {0x3008, 0x3020},
                                              {0x3164, 0x3164},
                                              {0xFF00, 0xFF0F}}};
constexpr std::array<std::uint32_t, 3> k_more{0x3030, 0xFFA0, 0xFFFD};

bool is_letter(std::uint32_t point) {
    return std::none_of(k_no_letters.begin(), k_no_letters.end(),
                        [&](const Range& r) { return r.first <= point && point <= r.last; }) &&
           std::find(k_more.begin(), k_more.end(), point) == k_more.end();
}

/// The code point that begins at a byte of UTF-8; moves behind it.
std::uint32_t next_point(std::string_view text, std::size_t& at) {
    const auto byte = static_cast<unsigned char>(text[at++]);
    const int more = byte < 0xC0 ? 0 : byte < 0xE0 ? 1 : byte < 0xF0 ? 2 : 3;
    std::uint32_t point = more == 0 ? byte : byte & (0x3FU >> static_cast<unsigned>(more));
    for (int i = 0; i < more && at < text.size(); ++i) {
        point = (point << 6U) | (static_cast<unsigned char>(text[at++]) & 0x3FU);
    }
    return point;
}

}  // namespace

bool is_stated(const std::string& text) {
    std::string letters;
    for (const char c : text) {
        letters += static_cast<char>(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
    }
    if (letters == "n/a" || letters == "tbd" || letters == "tba") {
        return false;
    }
    for (std::size_t at = 0; at < text.size();) {
        if (is_letter(next_point(text, at))) {
            return true;
        }
    }
    return false;
}

bool is_stated(const LocalisedText& text) {
    return !text.empty() && (text.plain.empty() || is_stated(text.plain)) &&
           std::all_of(text.by_language.begin(), text.by_language.end(),
                       [](const auto& entry) { return is_stated(entry.second); });
}

}  // namespace gumcert::certificate
