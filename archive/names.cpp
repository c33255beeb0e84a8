#include "archive/names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "gum/expression/name.h"
#include "gum/expression/name_spelling.h"
#include "text/utf8.h"

namespace gumcert::archive {

namespace {

constexpr char32_t small_letter_of_name(char32_t code) {
    const bool by_0x20 = (code >= U'A' && code <= U'Z') || (code >= 0xC0 && code <= 0xDE && code != 0xD7) ||
                         (code >= 0x391 && code <= 0x3A9 && code != 0x3A2) || (code >= 0x410 && code <= 0x42F);
    if (by_0x20) {
        return code + 0x20;
    }
    if (code >= 0x400 && code <= 0x40F) {
        return code + 0x50;
    }
    if (code == 0x178) {
        return 0xFF;
    }
    const bool even_is_capital = (code >= 0x100 && code <= 0x137 && code != 0x130) || (code >= 0x14A && code <= 0x177);
    const bool odd_is_capital = (code >= 0x139 && code <= 0x148) || (code >= 0x179 && code <= 0x17E);
    return (even_is_capital && code % 2 == 0) || (odd_is_capital && code % 2 == 1) ? code + 1 : code;
}

/// Calls with each character, and U+FFFD for a byte that is none.
template <class Work>
void each_character(std::string_view text, const Work& work) {
    for (std::size_t at = 0; at < text.size();) {
        const text::Character character = text::decode_utf8(text, at);
        work(character.bytes == 0 ? char32_t{0xFFFD} : character.code);
        at += std::max<std::size_t>(character.bytes, 1);
    }
}

bool is_hyphen(char32_t code) {
    return (code >= 0x2010 && code <= 0x2015) || code == 0x2043 || code == 0x2212 || code == 0xFE58 || code == 0xFE63 ||
           code == 0xFF0D;
}

/// A character in the form in which who reads it takes it: of another width or type, a sign for a letter.
std::string plain_form(char32_t code) {
    // Roman numerals from U+2160, small ones from U+2170.
    constexpr std::array<const char*, 16> k_roman = {"I",  "II", "III", "IV",  "V", "VI", "VII", "VIII",
                                                     "IX", "X",  "XI",  "XII", "L", "C",  "D",   "M"};
    const auto letter = [](char32_t ordinal) {  // of "A … Z a … z"
        return ordinal < 26 ? U'A' + ordinal : U'a' + (ordinal - 26);
    };
    if (code >= 0x2160 && code <= 0x217F) {
        return k_roman.at((code - 0x2160) % 16);
    }
    const char32_t plain = is_hyphen(code)                      ? U'-'
                           : code == 0x2044 || code == 0x2215   ? U'/'
                           : code == 0x212A                     ? U'K'  // kelvin, ångström and ohm are letters
                           : code == 0x212B                     ? 0xC5
                           : code == 0x2126                     ? 0x3A9
                           : code >= 0xFF01 && code <= 0xFF5E   ? code - 0xFF01 + U'!'          // full-width
                           : code >= 0x1D7CE && code <= 0x1D7FF ? U'0' + (code - 0x1D7CE) % 10  // of mathematics
                           : code >= 0x1D400 && code <= 0x1D6A3 ? letter((code - 0x1D400) % 52)
                                                                : code;
    return text::encode_utf8(plain);
}

}  // namespace

std::string name_key(std::string_view name) {
    std::string key;
    bool blank = false;
    each_character(name, [&](char32_t code) {
        if (text::is_blank(code)) {
            blank = !key.empty();
            return;
        }
        key += blank ? " " : "";
        blank = false;
        key += text::encode_utf8(small_letter_of_name(code));
    });
    return key;
}

bool may_be_one_person(std::string_view a, std::string_view b) {
    if (name_key(a) == name_key(b)) {
        return true;
    }
    const std::string plain = gum::without_spelling(a);
    return !plain.empty() && plain == gum::without_spelling(b);
}

std::string confusable_form(std::string_view number) {
    std::string letters;
    each_character(number, [&](char32_t code) {
        const bool unseen = text::is_hidden(code) || text::is_blank(code);
        letters += unseen ? "" : plain_form(code);
    });
    std::string form;
    each_character(gum::look_alike_skeleton(letters),
                   [&](char32_t code) { form += text::encode_utf8(small_letter_of_name(code)); });
    return form;
}

std::string objection_to_name(std::string_view name) {
    std::string objection;
    std::string word;
    bool blank = true;  // before the first word
    const auto object = [&](std::string phrase) { objection = objection.empty() ? std::move(phrase) : objection; };
    const auto end_word = [&] {
        if (!word.empty()) {
            if (const std::optional<std::string> reason = gum::reason_against_name(word)) {
                object(*reason);
            }
        }
        word.clear();
    };
    each_character(name, [&](char32_t code) {
        const gum::CharacterClass kind = gum::character_class(code);
        if (code == 0xFFFD) {
            object("is not UTF-8");
        } else if (text::is_hidden(code) && !text::is_joiner(code)) {
            object("has the hidden character " + gum::code_point_text(code));
        } else if (text::is_blank(code) && code != U' ') {
            object("has the blank " + gum::code_point_text(code));
        } else if (code == U' ' && blank) {
            object("begins with a blank, or has two of them in a row");
        } else if (code >= 0x300 && code <= 0x36F) {
            object("has a combining mark (" + gum::code_point_text(code) + ") in place of one letter with its accent");
        }
        if (kind == gum::CharacterClass::name_start && code != U'_') {
            word += text::encode_utf8(code);
        } else {
            end_word();
        }
        blank = code == U' ';
    });
    end_word();
    if (blank && !name.empty()) {
        object("ends with a blank");
    }
    return objection;
}

}  // namespace gumcert::archive
