#include "gum/expression/name.h"
#include "text/utf8.h"
#include "text/visible_text.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace gumcert::gum {

namespace {

constexpr std::size_t k_longest_name = 256;  // bytes

struct Range {
    char32_t first, last;
};

bool is_in(std::span<const Range> ranges, char32_t code) {
    return std::any_of(ranges.begin(), ranges.end(),
                       [code](const Range& range) { return range.first <= code && code <= range.last; });
}

enum class Script : std::uint8_t { none, latin, greek, cyrillic, other };

constexpr std::array k_latin{Range{U'A', U'Z'},  Range{U'a', U'z'},     Range{0xAA, 0xAA},
                             Range{0xBA, 0xBA},  Range{0xC0, 0xD6},     Range{0xD8, 0xF6},
                             Range{0xF8, 0x24F}, Range{0x1E00, 0x1EFF}, Range{0x212A, 0x212B}};
constexpr std::array k_greek{Range{0xB5, 0xB5},     Range{0x370, 0x373},   Range{0x376, 0x377},   Range{0x37B, 0x37D},
                             Range{0x37F, 0x37F},   Range{0x386, 0x386},   Range{0x388, 0x3FF},   Range{0x1F00, 0x1FBC},
                             Range{0x1FC2, 0x1FCC}, Range{0x1FD0, 0x1FDB}, Range{0x1FE0, 0x1FEC}, Range{0x1FF2, 0x1FFC},
                             Range{0x2126, 0x2126}};
constexpr std::array k_cyrillic{Range{0x400, 0x481}, Range{0x48A, 0x52F}};
// Armenian, Hebrew, Arabic, Devanagari, Thai, Georgian, Hangul, Japanese syllables, Chinese characters.
constexpr std::array k_other_letters{
    Range{0x531, 0x556},   Range{0x561, 0x587},   Range{0x5D0, 0x5EA},   Range{0x620, 0x64A},   Range{0x671, 0x6D3},
    Range{0x904, 0x939},   Range{0xE01, 0xE30},   Range{0x10A0, 0x10FF}, Range{0x3041, 0x3096}, Range{0x30A1, 0x30FA},
    Range{0x30FC, 0x30FC}, Range{0x3400, 0x4DBF}, Range{0x4E00, 0x9FFF}, Range{0xAC00, 0xD7A3}};
constexpr std::array k_combining{
    Range{0x300, 0x36F},   Range{0x483, 0x489},   Range{0x591, 0x5BD},   Range{0x64B, 0x65F},   Range{0x93A, 0x94D},
    Range{0xE31, 0xE3A},   Range{0xE47, 0xE4E},   Range{0x1AB0, 0x1AFF}, Range{0x1DC0, 0x1DFF}, Range{0x20D0, 0x20FF},
    Range{0x3099, 0x309A}, Range{0xFE00, 0xFE0F}, Range{0xFE20, 0xFE2F}};
constexpr std::array k_subscripts{Range{0x2080, 0x2089}, Range{0x2090, 0x209C}};

/// Letters of other scripts that print like an ASCII letter. ν, ρ, α and their like are told apart by every metrologist
/// and are not among them.
constexpr std::array k_look_alikes{
    std::pair{U'Α', 'A'}, std::pair{U'Β', 'B'}, std::pair{U'Ε', 'E'}, std::pair{U'Ζ', 'Z'}, std::pair{U'Η', 'H'},
    std::pair{U'Ι', 'I'}, std::pair{U'Κ', 'K'}, std::pair{U'Μ', 'M'}, std::pair{U'Ν', 'N'}, std::pair{U'Ο', 'O'},
    std::pair{U'Ρ', 'P'}, std::pair{U'Τ', 'T'}, std::pair{U'Υ', 'Y'}, std::pair{U'Χ', 'X'}, std::pair{U'ο', 'o'},
    std::pair{U'А', 'A'}, std::pair{U'В', 'B'}, std::pair{U'Е', 'E'}, std::pair{U'К', 'K'}, std::pair{U'М', 'M'},
    std::pair{U'Н', 'H'}, std::pair{U'О', 'O'}, std::pair{U'Р', 'P'}, std::pair{U'С', 'C'}, std::pair{U'Т', 'T'},
    std::pair{U'У', 'Y'}, std::pair{U'Х', 'X'}, std::pair{U'а', 'a'}, std::pair{U'е', 'e'}, std::pair{U'о', 'o'},
    std::pair{U'р', 'p'}, std::pair{U'с', 'c'}, std::pair{U'у', 'y'}, std::pair{U'х', 'x'}, std::pair{U'і', 'i'},
    std::pair{U'ј', 'j'}, std::pair{U'ѕ', 's'}, std::pair{U'Ѕ', 'S'}, std::pair{U'І', 'I'}, std::pair{U'Ј', 'J'},
    std::pair{U'һ', 'h'}, std::pair{U'ԁ', 'd'}, std::pair{U'ԛ', 'q'}, std::pair{U'ԝ', 'w'}};

std::optional<char> look_alike(char32_t code) {
    for (const auto& [letter, ascii] : k_look_alikes) {
        if (letter == code) {
            return ascii;
        }
    }
    return std::nullopt;
}

Script script(char32_t code) {
    if (is_in(k_latin, code)) {
        return Script::latin;
    }
    if (is_in(k_greek, code)) {
        return Script::greek;
    }
    if (is_in(k_cyrillic, code)) {
        return Script::cyrillic;
    }
    return is_in(k_other_letters, code) ? Script::other : Script::none;
}

/// Micro sign, ohm, kelvin and ångström sign are characters of their own in Unicode, and print as the letters.
char32_t canonical(char32_t code) {
    switch (code) {
        case 0xB5:
            return U'μ';
        case 0x2126:
            return U'Ω';
        case 0x212A:
            return U'K';
        case 0x212B:
            return U'Å';
        default:
            return code;
    }
}

std::vector<char32_t> characters(std::string_view text) {
    std::vector<char32_t> codes;
    for (std::size_t i = 0; i < text.size();) {
        const text::Character character = text::decode_utf8(text, i);
        codes.push_back(character.bytes == 0 ? char32_t{0xFFFD} : character.code);
        i += std::max<std::size_t>(character.bytes, 1);
    }
    return codes;
}

}  // namespace

CharacterClass character_class(char32_t code) {
    if (code == U'_' || script(code) != Script::none) {
        return CharacterClass::name_start;
    }
    if ((U'0' <= code && code <= U'9') || code == U'\'' || is_in(k_subscripts, code)) {
        return CharacterClass::name_part;
    }
    if (text::is_hidden(code)) {
        return CharacterClass::control;
    }
    return is_in(k_combining, code) ? CharacterClass::combining_mark : CharacterClass::other;
}

std::string canonical_name(std::string_view name) {
    std::string text;
    for (std::size_t i = 0; i < name.size();) {
        const text::Character character = text::decode_utf8(name, i);
        const std::size_t bytes = std::max<std::size_t>(character.bytes, 1);
        const char32_t code = canonical(character.code);
        text += code == character.code ? std::string(name.substr(i, bytes)) : text::encode_utf8(code);
        i += bytes;
    }
    return text;
}

std::string look_alike_skeleton(std::string_view name) {
    std::string text;
    for (const char32_t code : characters(name)) {
        const std::optional<char> ascii = look_alike(canonical(code));
        text += ascii ? std::string(1, *ascii) : text::encode_utf8(canonical(code));
    }
    return text;
}

std::optional<std::string> reason_against_name(std::string_view name) {
    if (name.empty()) {
        return "is empty";
    }
    if (name.size() > k_longest_name) {
        return "has " + std::to_string(name.size()) + " bytes, more than " + std::to_string(k_longest_name);
    }
    bool ascii_letter = false;
    std::optional<char32_t> look_alike_of_ascii;
    std::array<bool, 5> seen{};
    for (std::size_t i = 0; i < name.size();) {
        const text::Character character = text::decode_utf8(name, i);
        if (character.bytes == 0) {
            return "is not valid UTF-8";
        }
        const char32_t code = character.code;
        switch (character_class(code)) {
            case CharacterClass::name_start:
                break;
            case CharacterClass::name_part:
                if (i == 0) {
                    return "begins with \"" + text::encode_utf8(code) + "\"";
                }
                break;
            case CharacterClass::combining_mark:
                return "has a combining mark (" + code_point_text(code) + ") in place of one letter with its accent";
            case CharacterClass::control:
                return "has the invisible character " + code_point_text(code);
            case CharacterClass::other:
                return code == U' ' ? "has a space" : "has the character \"" + text::encode_utf8(code) + "\"";
        }
        seen[static_cast<std::size_t>(script(canonical(code)))] = true;
        ascii_letter = ascii_letter || (U'A' <= code && code <= U'Z') || (U'a' <= code && code <= U'z');
        if (look_alike(code)) {
            look_alike_of_ascii = code;
        }
        i += character.bytes;
    }
    const auto has = [&](Script which) { return seen[static_cast<std::size_t>(which)]; };
    if (ascii_letter && look_alike_of_ascii) {
        return "mixes Latin letters with " + code_point_text(*look_alike_of_ascii) +
               ", which only looks like the Latin " + std::string(1, *look_alike(*look_alike_of_ascii));
    }
    // Greek letters beside Latin ones are how quantities are written (ΔT). Cyrillic letters look like both.
    if (has(Script::cyrillic) && (has(Script::latin) || has(Script::greek))) {
        return "mixes Cyrillic letters with letters of another script";
    }
    return std::nullopt;
}

std::string code_point_text(char32_t code) {
    return "U+" + text::hexadecimal(code);
}

std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> candidates) {
    constexpr std::size_t k_longest_compared = 64;  // characters; keeps the search quick
    const std::vector<char32_t> wanted = characters(canonical_name(name));
    if (wanted.size() > k_longest_compared) {
        return std::nullopt;
    }
    const auto folded = [](char32_t code) { return U'A' <= code && code <= U'Z' ? code + (U'a' - U'A') : code; };
    // Of short names, such as those of most quantities, nearly every other one is two letters away.
    const std::size_t allowed = wanted.size() <= 3 ? 2 : wanted.size() <= 5 ? 4 : 6;  // in halves of a letter
    std::optional<std::string> nearest;
    std::size_t least = allowed + 1;
    for (const std::string& candidate : candidates) {
        const std::vector<char32_t> letters = characters(canonical_name(candidate));
        if (letters.size() > wanted.size() + 3 || wanted.size() > letters.size() + 3) {
            continue;
        }
        // Levenshtein's distance; a letter in the other case, or an underscore, counts half.
        std::vector<std::size_t> row(letters.size() + 1);
        for (std::size_t j = 1; j <= letters.size(); ++j) {
            row[j] = row[j - 1] + (letters[j - 1] == U'_' ? 1 : 2);
        }
        for (std::size_t i = 1; i <= wanted.size(); ++i) {
            const std::size_t drop = wanted[i - 1] == U'_' ? 1 : 2;
            std::size_t diagonal = row[0];
            row[0] += drop;
            for (std::size_t j = 1; j <= letters.size(); ++j) {
                const std::size_t add = letters[j - 1] == U'_' ? 1 : 2;
                const std::size_t change = wanted[i - 1] == letters[j - 1]                   ? 0
                                           : folded(wanted[i - 1]) == folded(letters[j - 1]) ? 1
                                                                                             : 2;
                const std::size_t best = std::min({row[j] + drop, row[j - 1] + add, diagonal + change});
                diagonal = row[j];
                row[j] = best;
            }
        }
        // A name of which no letter is left is not a slip.
        if (row.back() < least && row.back() < 2 * std::max(wanted.size(), letters.size())) {
            least = row.back();
            nearest = candidate;
        }
    }
    return nearest;
}

}  // namespace gumcert::gum
