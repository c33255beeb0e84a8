#include "reports/forms/text_columns.h"

#include <algorithm>
#include <string_view>

#include "text/utf8.h"

namespace gumcert::reports {
namespace {

/// Signs that must not begin a line.
bool closes(const std::string& glyph) {
    static constexpr std::string_view k_signs = "。，、；：！？）」』》%,.;:!?)";
    return k_signs.find(glyph) != std::string_view::npos;
}

/// Signs that must not end a line.
bool opens(const std::string& glyph) {
    static constexpr std::string_view k_signs = "（「『《(";
    return k_signs.find(glyph) != std::string_view::npos;
}

}  // namespace

std::vector<Glyph> glyphs(const std::string& utf8) {
    std::vector<Glyph> all;
    std::size_t i = 0;
    while (i < utf8.size()) {
        const auto [c, decoded] = text::decode_utf8(utf8, i);
        const std::string bytes = utf8.substr(i, std::max<std::size_t>(decoded, 1));
        i += bytes.size();
        const bool combining = (c >= 0x0300 && c <= 0x036F) || (c >= 0x200B && c <= 0x200D);
        if (combining && !all.empty()) {
            all.back().bytes += bytes;
            continue;
        }
        const bool wide = (c >= 0x1100 && c <= 0x115F) || (c >= 0x2E80 && c <= 0xA4CF) ||
                          (c >= 0xAC00 && c <= 0xD7A3) || (c >= 0xF900 && c <= 0xFAFF) ||
                          (c >= 0xFF00 && c <= 0xFF60) || (c >= 0x1F300 && c <= 0x3FFFD);
        all.push_back({bytes, combining ? 0U : wide ? 2U : 1U});
    }
    return all;
}

std::size_t width(const std::string& text) {
    std::size_t sum = 0;
    for (const Glyph& g : glyphs(text)) {
        sum += g.width;
    }
    return sum;
}

std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
    std::vector<std::string> lines(1);
    std::size_t used = 0;
    std::vector<Glyph> word;
    std::size_t word_width = 0;
    bool after_blank = true;
    const auto put_word = [&] {
        if (word.empty()) {
            return;
        }
        const std::size_t gap = used > 0 && after_blank ? 1 : 0;
        if (used + gap + word_width > most && used > 0) {
            lines.emplace_back();
            used = 0;
        }
        if (used > 0 && after_blank) {
            lines.back() += ' ';
            ++used;
        }
        for (const Glyph& g : word) {
            if (used + g.width > most && used > 0) {
                lines.emplace_back();
                used = 0;
            }
            lines.back() += g.bytes;
            used += g.width;
        }
        word.clear();
        word_width = 0;
        after_blank = false;
    };
    for (const Glyph& g : glyphs(text)) {
        if (g.bytes == " ") {
            put_word();
            after_blank = true;
            continue;
        }
        const bool wide = g.width == 2 || (!word.empty() && word.back().width == 2);
        if (wide && !word.empty() && !closes(g.bytes) && !opens(word.back().bytes)) {
            put_word();
        }
        word.push_back(g);
        word_width += g.width;
    }
    put_word();
    return lines;
}

std::string padded(const std::string& text, std::size_t to, bool right) {
    const std::size_t own = width(text);
    const std::string blanks(to > own ? to - own : 0, ' ');
    return right ? blanks + text : text + blanks;
}

}  // namespace gumcert::reports
