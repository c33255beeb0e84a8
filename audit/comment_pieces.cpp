#include "audit/comment_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "audit/word_line.h"
#include "certificate/text_words.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/utf8.h"

namespace gumcert::audit {
namespace {

constexpr std::array<std::string_view, 14> k_signs{"±", "−", "×", "·", "√", "∞", "≤",
                                                   "≥", "–", "—", "„", "“", "”", "\u00A0"};

/// Bytes of a sign of more than one byte at the beginning of a text; 0 where there is none.
std::size_t sign_bytes(std::string_view text) {
    for (const std::string_view sign : k_signs) {
        if (text.starts_with(sign)) {
            return sign.size();
        }
    }
    return 0;
}
bool is_plain_digit(char c) {
    return c >= '0' && c <= '9';
}
bool belongs_to_word(std::string_view text) {
    const char c = text.front();
    if (static_cast<unsigned char>(c) < 0x80U) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_plain_digit(c) || c == '_';
    }
    return sign_bytes(text) == 0;
}
/// Where a number may begin: a digit, or a sign in front of one.
bool may_begin_number(std::string_view text) {
    for (const std::string_view sign : {"±", "+/-", "+-", "−", "-", "√", "∞", "+"}) {
        if (text.starts_with(sign)) {
            text.remove_prefix(sign.size());
            break;
        }
    }
    while (text.starts_with(' ')) {
        text.remove_prefix(1);
    }
    return !text.empty() && (is_plain_digit(text.front()) || text.starts_with("√"));
}

/// What stands directly behind a number, up to a space or the punctuation of a sentence: perhaps its unit.
std::string unit_behind(std::string_view rest) {
    std::size_t end = 0;
    while (end < rest.size() && std::string_view(" ,;:()[]=\t\n").find(rest[end]) == std::string_view::npos) {
        ++end;
    }
    std::string unit(rest.substr(0, end));
    while (unit.ends_with('.')) {
        unit.pop_back();
    }
    return unit;
}

/// The number at the beginning of a text, and how many bytes it takes; nothing where there is none.
std::optional<std::pair<Piece, std::size_t>> number_piece(std::string_view text, DecimalSign sign) {
    const std::optional<LeadingNumber> read = read_leading_number(text, "", Percent::hundredth, sign);
    if (!read || read->is_open || !std::isfinite(read->number.value)) {
        return std::nullopt;
    }
    // The rest has one character for each of the text, and no spaces at its ends.
    std::size_t end = text.size();
    while (end > 0 && (text[end - 1] == ' ' || text[end - 1] == '\t')) {
        --end;
    }
    for (std::size_t left = text::character_count(read->rest); left > 0 && end > 0; --left) {
        do {
            --end;
        } while (end > 0 && text::is_continuation(text[end]));
    }
    if (end == 0) {
        return std::nullopt;
    }
    Piece piece;
    piece.kind = Piece::Kind::number;
    piece.value = read->number.value;
    const std::string_view taken = text.substr(0, end);
    piece.percent = taken.find('%') != std::string_view::npos;
    piece.plus_minus = taken.find("±") != std::string_view::npos || taken.find("+/-") != std::string_view::npos ||
                       taken.find("+-") != std::string_view::npos;
    piece.plus = taken.starts_with('+') && !piece.plus_minus;
    std::string_view behind = text.substr(end);
    if (piece.plus_minus && behind.starts_with(')')) {  // "(23 ± 2) °C" is no 2 of the unit of the row
        behind.remove_prefix(1);
        behind.remove_prefix(std::min(behind.find_first_not_of(' '), behind.size()));
    }
    piece.unit = unit_behind(behind);
    while (behind.starts_with(' ')) {
        behind.remove_prefix(1);
    }
    constexpr std::size_t k_longest_unit = 24;
    piece.behind = cut(behind, k_longest_unit);
    return std::pair(std::move(piece), end);
}

/// Words that are units as well, and in a sentence are none.
bool is_word_and_unit(std::string_view text) {
    constexpr std::array<std::string_view, 5> k_words{"in", "a", "at", "as", "am"};
    return std::find(k_words.begin(), k_words.end(), text) != k_words.end();
}

std::optional<gum::Unit> unit_of(const std::string& text) {
    try {
        return gum::Unit::parse(text);
    } catch (const gum::InputError&) {
        return std::nullopt;
    }
}

/// A number in the unit of a row, where it can be written in that unit: 1e-320 µm is 0 m.
std::optional<NumberOfRow> number_of_row(double number) {
    return number > 0.0 && std::isfinite(number) ? std::optional(NumberOfRow{number, true}) : std::nullopt;
}

}  // namespace

Pieces pieces_of(std::string_view all, DecimalSign sign) {
    Pieces pieces;
    std::string_view text = cut(all, k_longest_text);
    if (!text::is_utf8(text)) {
        return pieces;
    }
    bool after_word = false, after_plus = false;
    while (!text.empty()) {
        if (!after_word && may_begin_number(text)) {
            if (std::optional<std::pair<Piece, std::size_t>> number = number_piece(text, sign)) {
                number->first.plus = number->first.plus || after_plus;
                after_plus = false;
                pieces.push_back(std::move(number->first));
                text.remove_prefix(number->second);
                continue;
            }
            after_plus = text.front() == '+';  // "+ 0.5": the number comes next
            // "12.3.4" is no number, and none of its parts is.
            std::size_t end = 1;
            while (end < text.size() && (is_plain_digit(text[end]) || text[end] == '.' || text[end] == ',')) {
                ++end;
            }
            while (end < text.size() && text::is_continuation(text[end])) {
                ++end;
            }
            text.remove_prefix(end);
            continue;
        }
        std::size_t end = 0;
        while (end < text.size() && belongs_to_word(text.substr(end))) {
            ++end;
            while (end < text.size() && text::is_continuation(text[end])) {
                ++end;
            }
        }
        after_word = end > 0;
        if (end > 0) {
            Piece piece;
            piece.kind = Piece::Kind::word;
            piece.raw = text.substr(0, end);
            for (const char32_t letter : certificate::letters_of(piece.raw)) {
                piece.word += text::encode_utf8(letter);
            }
            pieces.push_back(std::move(piece));
        } else {
            end = std::max<std::size_t>(1, sign_bytes(text));
            if (text.front() != ' ' && text.front() != '\t') {
                Piece piece;
                piece.raw = text.substr(0, end);
                pieces.push_back(std::move(piece));
            }
        }
        text.remove_prefix(end);
    }
    return pieces;
}

std::optional<NumberOfRow> in_unit_of_row(const Piece& piece, const AuditedRow& row) {
    const double size = std::abs(piece.value);
    if (!(size > 0.0)) {
        return std::nullopt;
    }
    if (piece.percent) {
        const bool of_percent = row.unit.find('%') != std::string::npos;
        return of_percent ? number_of_row(100.0 * size) : std::nullopt;
    }
    if (piece.unit.empty() || is_word_and_unit(piece.unit)) {
        return NumberOfRow{size, piece.unit == row.unit && !row.unit.empty()};
    }
    const bool several_words = row.unit.find(' ') != std::string::npos && piece.behind.starts_with(row.unit);
    if (piece.unit == row.unit || several_words) {
        return NumberOfRow{size, true};
    }
    const std::optional<gum::Unit> unit = unit_of(piece.unit);
    if (!unit) {
        return NumberOfRow{size, false};
    }
    // A number of another dimension belongs to something else: 20 °C in the row of a length is the temperature of the
    // room.
    const std::optional<gum::Unit> own = unit_of(row.unit);
    if (!own || !(own->dimension() == unit->dimension())) {
        return std::nullopt;
    }
    return number_of_row(own->difference_from_si(unit->difference_to_si(size)));
}

bool has_unit(const Piece& number) {
    const std::string_view behind = number.behind;
    // What is repeated has such names as well: "mean of 5 turns".
    constexpr std::array<std::string_view, 14> k_repeated{"turn",  "turns",  "rev",   "revolution", "revolutions",
                                                          "cycle", "cycles", "count", "counts",     "d",
                                                          "day",   "days",   "week",  "weeks"};
    const bool is_word = is_word_and_unit(number.unit) ||
                         std::find(k_repeated.begin(), k_repeated.end(), number.unit) != k_repeated.end();
    return behind.starts_with("°") || behind.starts_with("deg") || behind.starts_with("Grad") ||
           (!is_word && !number.unit.empty() && unit_of(number.unit));
}

bool is_filler(const Piece& piece) {
    if (piece.kind == Piece::Kind::sign) {
        return piece.raw == "=" || piece.raw == ":" || piece.raw == "±" || piece.raw == "(" || piece.raw == "≤" ||
               piece.raw == "<" || piece.raw == "-" || piece.raw == "~" || piece.raw == ">" || piece.raw == "\u00A0";
    }
    constexpr std::array<std::string_view, 11> k_words{"of",   "is",   "von", "ist",     "about", "ca",
                                                       "etwa", "step", "the", "betragt", "d"};
    return std::find(k_words.begin(), k_words.end(), piece.word) != k_words.end();
}
bool ends_sentence(const Piece& piece) {
    return piece.is_sign(";") || piece.is_sign("\n");
}

bool is_argument(const Pieces& pieces, std::size_t place) {
    const auto is_one_of = [&pieces](std::size_t at, std::span<const std::string_view> words) {
        return pieces[at].kind == Piece::Kind::word &&
               std::find(words.begin(), words.end(), pieces[at].word) != words.end();
    };
    constexpr std::array<std::string_view, 12> k_before{"at",    "bei",  "to",      "bis",      "up",      "from",
                                                        "range", "span", "between", "zwischen", "endwert", "fs"};
    constexpr std::array<std::string_view, 11> k_symbols{"fs", "l",     "t",    "p",       "f",          "range",
                                                         "x",  "scale", "span", "endwert", "messbereich"};
    if (place == 0) {
        return false;
    }
    const std::size_t before = place - 1;
    if (pieces[before].is_sign("=") || pieces[before].is_sign(":")) {
        return before > 0 && is_one_of(before - 1, k_symbols);
    }
    return is_one_of(before, k_before);
}

}  // namespace gumcert::audit
