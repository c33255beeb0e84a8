#include "gum/expression/name_spelling.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

#include "gum/expression/name.h"
#include "text/utf8.h"

namespace gumcert::gum {

namespace {

/// Letters and signs that stand for others, "" for nothing at all.
struct Folding {
    char32_t first, last;
    std::string_view folded;
};

// In ascending order of the codes.
constexpr std::array k_foldings = {
    Folding{0x80, 0xa9, ""},           Folding{0xaa, 0xaa, "a"},        Folding{0xab, 0xb1, ""},
    Folding{0xb2, 0xb2, "2"},          Folding{0xb3, 0xb3, "3"},        Folding{0xb4, 0xb4, ""},
    Folding{0xb5, 0xb5, "\u03bc"},     Folding{0xb6, 0xb8, ""},         Folding{0xb9, 0xb9, "1"},
    Folding{0xba, 0xba, "o"},          Folding{0xbb, 0xbf, ""},         Folding{0xc0, 0xc5, "a"},
    Folding{0xc6, 0xc6, "ae"},         Folding{0xc7, 0xc7, "c"},        Folding{0xc8, 0xcb, "e"},
    Folding{0xcc, 0xcf, "i"},          Folding{0xd0, 0xd0, "d"},        Folding{0xd1, 0xd1, "n"},
    Folding{0xd2, 0xd6, "o"},          Folding{0xd7, 0xd7, ""},         Folding{0xd8, 0xd8, "o"},
    Folding{0xd9, 0xdc, "u"},          Folding{0xdd, 0xdd, "y"},        Folding{0xde, 0xde, "th"},
    Folding{0xdf, 0xdf, "ss"},         Folding{0xe0, 0xe5, "a"},        Folding{0xe6, 0xe6, "ae"},
    Folding{0xe7, 0xe7, "c"},          Folding{0xe8, 0xeb, "e"},        Folding{0xec, 0xef, "i"},
    Folding{0xf0, 0xf0, "d"},          Folding{0xf1, 0xf1, "n"},        Folding{0xf2, 0xf6, "o"},
    Folding{0xf7, 0xf7, ""},           Folding{0xf8, 0xf8, "o"},        Folding{0xf9, 0xfc, "u"},
    Folding{0xfd, 0xfd, "y"},          Folding{0xfe, 0xfe, "th"},       Folding{0xff, 0xff, "y"},
    Folding{0x100, 0x105, "a"},        Folding{0x106, 0x10d, "c"},      Folding{0x10e, 0x111, "d"},
    Folding{0x112, 0x11b, "e"},        Folding{0x11c, 0x123, "g"},      Folding{0x124, 0x127, "h"},
    Folding{0x128, 0x131, "i"},        Folding{0x132, 0x133, "ij"},     Folding{0x134, 0x135, "j"},
    Folding{0x136, 0x138, "k"},        Folding{0x139, 0x142, "l"},      Folding{0x143, 0x14b, "n"},
    Folding{0x14c, 0x151, "o"},        Folding{0x152, 0x153, "oe"},     Folding{0x154, 0x159, "r"},
    Folding{0x15a, 0x161, "s"},        Folding{0x162, 0x167, "t"},      Folding{0x168, 0x173, "u"},
    Folding{0x174, 0x175, "w"},        Folding{0x176, 0x178, "y"},      Folding{0x179, 0x17e, "z"},
    Folding{0x17f, 0x17f, "s"},        Folding{0x218, 0x219, "s"},      Folding{0x21a, 0x21b, "t"},
    Folding{0x300, 0x36f, ""},         Folding{0x386, 0x386, "\u03b1"}, Folding{0x388, 0x388, "\u03b5"},
    Folding{0x389, 0x389, "\u03b7"},   Folding{0x38a, 0x38a, "\u03b9"}, Folding{0x38c, 0x38c, "\u03bf"},
    Folding{0x38e, 0x38e, "\u03c5"},   Folding{0x38f, 0x38f, "\u03c9"}, Folding{0x390, 0x390, "\u03b9"},
    Folding{0x3aa, 0x3aa, "\u03b9"},   Folding{0x3ab, 0x3ab, "\u03c5"}, Folding{0x3ac, 0x3ac, "\u03b1"},
    Folding{0x3ad, 0x3ad, "\u03b5"},   Folding{0x3ae, 0x3ae, "\u03b7"}, Folding{0x3af, 0x3af, "\u03b9"},
    Folding{0x3b0, 0x3b0, "\u03c5"},   Folding{0x3c2, 0x3c2, "\u03c3"}, Folding{0x3ca, 0x3ca, "\u03b9"},
    Folding{0x3cb, 0x3cb, "\u03c5"},   Folding{0x3cc, 0x3cc, "\u03bf"}, Folding{0x3cd, 0x3cd, "\u03c5"},
    Folding{0x3ce, 0x3ce, "\u03c9"},   Folding{0x401, 0x401, "\u0435"}, Folding{0x451, 0x451, "\u0435"},
    Folding{0x1e9e, 0x1e9e, "ss"},     Folding{0x2000, 0x206f, ""},     Folding{0x2116, 0x2116, "no"},
    Folding{0x2126, 0x2126, "\u03c9"}, Folding{0x2212, 0x2212, ""},     Folding{0x3000, 0x3003, ""},
};

/// Letters whose small form is a fixed number of codes away: capital Greek, Cyrillic and full-width letters.
constexpr char32_t small_letter(char32_t code) {
    if ((U'A' <= code && code <= U'Z') || (0x391 <= code && code <= 0x3a9) || (0x410 <= code && code <= 0x42f)) {
        return code + 0x20;
    }
    if (0x400 <= code && code <= 0x40f) {
        return code + 0x50;
    }
    if ((0x460 <= code && code <= 0x481) || (0x48a <= code && code <= 0x4bf) || (0x4d0 <= code && code <= 0x52f) ||
        (0x1e00 <= code && code <= 0x1eff)) {
        return code | 1U;  // pairs
    }
    return code;
}

/// Digits that are set as something else, and full-width characters, as the plain character.
constexpr char32_t plain_character(char32_t code) {
    if (0xff01 <= code && code <= 0xff5e) {
        return code - 0xff01 + U'!';
    }
    if ((0x2070 <= code && code <= 0x2079) || (0x2080 <= code && code <= 0x2089)) {
        return U'0' + (code & 0xfU);
    }
    return 0x2460 <= code && code <= 0x2468 ? code - 0x2460 + U'1' : code;  // ① … ⑨
}

bool is_ascii_digit(char c) {
    return c >= '0' && c <= '9';
}

void append_ascii(char c, std::string& plain) {
    if (is_ascii_digit(c)) {
        // T_01 and T_1 are one name for whoever reads them.
        const bool leading = c == '0' && (plain.empty() || !is_ascii_digit(plain.back()));
        plain += leading ? "" : std::string(1, c);
    } else if (c >= 'a' && c <= 'z') {
        plain += c;
    }
}

std::string folded(char32_t code) {
    const char32_t plain = plain_character(code);
    const auto* const found = std::find_if(k_foldings.begin(), k_foldings.end(), [&](const Folding& folding) {
        return folding.first <= plain && plain <= folding.last;
    });
    return found != k_foldings.end() ? std::string(found->folded) : text::encode_utf8(small_letter(plain));
}

}  // namespace

std::string without_spelling(std::string_view name) {
    std::string letters;
    for (std::size_t i = 0; i < name.size();) {
        const text::Character character = text::decode_utf8(name, i);
        const std::size_t bytes = std::max<std::size_t>(character.bytes, 1);
        letters += character.bytes == 0 ? std::string(name.substr(i, 1)) : folded(character.code);
        i += bytes;
    }
    std::string plain;
    for (const char c : gum::look_alike_skeleton(letters)) {
        if ((static_cast<unsigned char>(c) & 0x80U) != 0U) {
            plain += c;
        } else {
            append_ascii(c, plain);
        }
    }
    return plain;
}

std::vector<gum::Diagnostic> similar_source_names(const std::set<std::string>& names,
                                                  const std::vector<std::string>& different) {
    std::map<std::string, std::vector<std::string>> alike;
    for (const std::string& name : names) {
        if (std::find(different.begin(), different.end(), name) == different.end()) {
            alike[without_spelling(name)].push_back(name);
        }
    }
    std::vector<gum::Diagnostic> questions;
    for (const auto& [plain, spelled] : alike) {
        if (spelled.size() < 2 || plain.empty()) {
            continue;
        }
        std::string list;
        for (const std::string& name : spelled) {
            list += (list.empty() ? "\"" : ", \"") + name + '"';
        }
        questions.push_back(
            {.code = "GC-COMPARE-0129",
             .where = "sources",
             .what = "the names " + list + " are taken as different sources of uncertainty; are they the same?",
             .rule =
                 "results share a source where they name it alike, and a covariance that is left out hides failures",
             .action = "Spell the source alike everywhere, or list the names in \"different_sources\".",
             .severity = gum::Severity::warning});
    }
    return questions;
}

}  // namespace gumcert::gum
