#include "certificate/text_words.h"
#include "text/utf8.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace gumcert::certificate {

namespace {

struct Range {
    char32_t first, last;
};

/// Code points above ASCII that are no letter and no digit, of those that stand for one another or for nothing: punctuation,
/// symbols, spaces and letters without an image. What is not listed counts as a letter.
constexpr std::array<Range, 18> k_no_letters{{{0x80, 0xA9},
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
                                              {0xFE00, 0xFE0F},
                                              {0xFF00, 0xFF0F},
                                              {0xFF1A, 0xFF20},
                                              {0xE0000, 0xE0FFF}}};
constexpr std::array<char32_t, 4> k_more{0x3030, 0xFFA0, 0xFFFD, 0xFEFF};

bool is_letter(char32_t point) {
    if (point < 0x80) {  // what nearly all texts are made of
        return (point >= 'a' && point <= 'z') || (point >= '0' && point <= '9') || (point >= 'A' && point <= 'Z');
    }
    return std::none_of(k_no_letters.begin(), k_no_letters.end(),
                        [&](const Range& r) { return r.first <= point && point <= r.last; }) &&
           std::find(k_more.begin(), k_more.end(), point) == k_more.end();
}

/// À to ÿ without their accents; '*' for the two signs among them, and for letters that become two.
constexpr std::string_view k_latin_1 =
    "aaaaaa*ceeeeiiiidnooooo*ouuuuy**"
    "aaaaaa*ceeeeiiiidnooooo*ouuuuy*y";

/// Letters of other scripts with the image of a Latin one.
constexpr std::array<std::pair<char32_t, char>, 34> k_lookalikes{
    {{0x430, 'a'}, {0x435, 'e'}, {0x43E, 'o'}, {0x440, 'p'}, {0x441, 'c'}, {0x445, 'x'}, {0x443, 'y'},
     {0x456, 'i'}, {0x455, 's'}, {0x458, 'j'}, {0x43A, 'k'}, {0x442, 't'}, {0x43C, 'm'}, {0x43D, 'h'},
     {0x432, 'b'}, {0x3B1, 'a'}, {0x3BF, 'o'}, {0x3C1, 'p'}, {0x3B9, 'i'}, {0x3BA, 'k'}, {0x3BD, 'v'},
     {0x3C5, 'u'}, {0x3C4, 't'}, {0x3C7, 'x'}, {0x395, 'e'}, {0x39D, 'n'}, {0x39F, 'o'}, {0x391, 'a'},
     {0x39A, 'k'}, {0x3A7, 'x'}, {0x3A4, 't'}, {0x399, 'i'}, {0x501, 'd'}, {0x4BB, 'h'}}};

bool is_accent(char32_t c) {
    return c >= 0x300 && c <= 0x36F && c != 0x34F;
}

void add_small(std::u32string& word, char32_t c) {
    if (c >= 0xFF10 && c <= 0xFF5A) {  // full width
        c -= 0xFEE0;
    }
    if (c < 0x80) {
        word += c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c;
        return;
    }
    if (c >= 0x410 && c <= 0x42F) {
        c += 0x20;
    } else if (c == 0xC6 || c == 0xE6) {
        word += U"ae";
        return;
    } else if (c == 0xDF) {
        word += U"ss";
        return;
    } else if (c >= 0xC0 && c <= 0xFF && k_latin_1[c - 0xC0] != '*') {
        c = static_cast<unsigned char>(k_latin_1[c - 0xC0]);
    }
    // Letters that look alike count as one, so that a text cannot be made "another one" by a Cyrillic letter.
    const auto* const like =
        std::find_if(k_lookalikes.begin(), k_lookalikes.end(), [&](const auto& pair) { return pair.first == c; });
    word += like == k_lookalikes.end() ? c : static_cast<unsigned char>(like->second);
}

}  // namespace

std::vector<std::u32string> words_of(std::string_view text) {
    std::vector<std::u32string> words;
    std::u32string word;
    const auto end_word = [&] {
        if (!word.empty()) {
            words.push_back(std::exchange(word, {}));
        }
    };
    for (std::size_t at = 0; at < text.size();) {
        const text::Character character = text::decode_utf8(text, at);
        const char32_t point = character.bytes == 0 ? char32_t{0xFFFD} : character.code;
        at += std::max<std::size_t>(character.bytes, 1);
        const bool without_image = point == 0xAD || (point >= 0x200B && point <= 0x200F) || point == 0xFEFF;
        // Accents and characters without an image, as a soft hyphen, part no word.
        if (is_accent(point) || without_image) {
            continue;
        }
        if (is_letter(point)) {
            add_small(word, point);
        } else {
            end_word();
        }
    }
    end_word();
    return words;
}

std::u32string letters_of(std::string_view text) {
    std::u32string letters;
    for (const std::u32string& word : words_of(text)) {
        letters += word;
    }
    return letters;
}

bool is_ideograph(char32_t character) {
    return (character >= 0x3400 && character <= 0x9FFF) || (character >= 0x3040 && character <= 0x30FF) ||
           (character >= 0xF900 && character <= 0xFAFF) || (character >= 0x20000 && character <= 0x3FFFF);
}

}  // namespace gumcert::certificate
