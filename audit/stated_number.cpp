#include "audit/stated_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "text/numbers.h"
#include "text/utf8.h"

namespace gumcert::audit {
namespace {

constexpr char32_t k_minus_sign = 0x2212, k_times = 0x00D7, k_middle_dot = 0x00B7, k_dot_operator = 0x22C5,
                   k_plus_minus = 0x00B1, k_infinity = 0x221E, k_root = 0x221A, k_no_break_space = 0x00A0,
                   k_thin_space = 0x2009, k_narrow_no_break_space = 0x202F, k_right_quote = 0x2019, k_en_dash = 0x2013,
                   k_bullet_operator = 0x2219, k_bullet = 0x2022;

/// Characters of a text in a form that a small reader can walk over: signs of typesetting as the ASCII that they mean.
std::u32string characters(std::string_view text) {
    std::u32string all;
    for (std::size_t offset = 0; offset < text.size();) {
        const text::Character next = text::decode_utf8(text, offset);
        if (next.bytes == 0) {
            return {};
        }
        offset += next.bytes;
        switch (next.code) {
            case k_minus_sign:
                all += U'-';
                break;
            case k_no_break_space:
            case k_thin_space:
            case k_narrow_no_break_space:
            case U'\t':
                all += U' ';
                break;
            case k_right_quote:
                all += U'\'';
                break;
            case k_dot_operator:
                all += k_middle_dot;  // "N⋅m" is the unit "N·m"
                break;
            default:
                all += next.code;
        }
    }
    return all;
}

/// So many characters of a text, without spaces at their end.
std::string beginning(std::string_view text, std::size_t characters) {
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < characters && bytes < text.size(); ++i) {
        bytes += text::decode_utf8(text, bytes).bytes;
    }
    while (bytes > 0 && (text[bytes - 1] == ' ' || text[bytes - 1] == '\t')) {
        --bytes;
    }
    return std::string(text.substr(0, bytes));
}

bool is_digit(char32_t code) {
    return code >= U'0' && code <= U'9';
}
/// A raised digit or sign as the one that it raises; others as they are.
char32_t lowered(char32_t code) {
    constexpr std::u32string_view k_raised = U"⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", k_plain = U"0123456789-+";
    const std::size_t at = k_raised.find(code);
    return at == std::u32string_view::npos ? code : k_plain[at];
}
bool is_times(char32_t code) {
    return code == k_times || code == k_middle_dot || code == U'*' || code == k_bullet_operator || code == k_bullet;
}

/// Walks over the characters of a text.
class Walk {
public:
    explicit Walk(std::u32string text) : text_(std::move(text)) {}

    [[nodiscard]] bool at_end() const { return at_ == text_.size(); }
    [[nodiscard]] char32_t peek(std::size_t ahead = 0) const {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : U'\0';
    }
    char32_t take() { return text_[at_++]; }
    void skip_spaces() {
        while (peek() == U' ') {
            ++at_;
        }
    }
    bool take_if(char32_t code) {
        if (at_end() || peek() != code) {
            return false;
        }
        ++at_;
        return true;
    }
    /// Takes an ASCII word whatever its case.
    bool take_word(std::string_view word) {
        for (std::size_t i = 0; i < word.size(); ++i) {
            const char32_t code = peek(i);
            const char32_t lower = code >= U'A' && code <= U'Z' ? code + 32 : code;
            if (lower != static_cast<unsigned char>(word[i])) {
                return false;
            }
        }
        at_ += word.size();
        return true;
    }
    [[nodiscard]] std::size_t position() const { return at_; }
    void go_to(std::size_t position) { at_ = position; }
    [[nodiscard]] std::string rest() {
        skip_spaces();
        std::string all;
        for (std::size_t i = at_; i < text_.size(); ++i) {
            all += text::encode_utf8(text_[i]);
        }
        while (!all.empty() && all.back() == ' ') {
            all.pop_back();
        }
        return all;
    }

private:
    std::u32string text_;
    std::size_t at_ = 0;
};

constexpr std::size_t k_group = 3;  ///< digits that are set apart together

struct Digits {
    std::string plain;  ///< digits with '.', as std::from_chars reads them
    int decimals = 0;
    bool whole = true;
    DecimalSign shows = DecimalSign::each;
    bool is_open = false;
};

/// Whether, behind spaces, a letter of a power of ten stands next with its sign: " E-13". Without a sign it may begin a word.
bool letter_of_power_follows(const Walk& walk) {
    std::size_t ahead = 0;
    while (walk.peek(ahead) == U' ') {
        ++ahead;
    }
    const char32_t letter = walk.peek(ahead), sign = walk.peek(ahead + 1);
    return (letter == U'e' || letter == U'E') && (sign == U'-' || sign == U'+' || sign == k_en_dash) &&
           is_digit(walk.peek(ahead + 2));
}

/// Whether a power of ten stands next: "E-3", "· 10^-3".
bool exponent_follows(const Walk& walk) {
    std::size_t ahead = 0;
    while (walk.peek(ahead) == U' ') {
        ++ahead;
    }
    const char32_t next = walk.peek(ahead);
    const bool letter = (ahead == 0 || letter_of_power_follows(walk)) && (next == U'e' || next == U'E');
    return letter || is_times(next) || (next == U'x' && (walk.peek(ahead + 1) == U' ' || walk.peek(ahead + 1) == U'1'));
}

/// Whether the last group of decimals stands next, of one or two digits: the "15" of "0.028 15 mm" and not the "10" of
/// "0.028 10^-3", nor digits with something of their own behind them, "0.028 0.5".
bool last_decimals_follow(const Walk& walk) {
    std::size_t end = 1;
    while (end < k_group && is_digit(walk.peek(end))) {
        ++end;
    }
    if (end == 1) {
        return false;
    }
    const char32_t next = walk.peek(end);
    const bool ends_sentence = (next == U'.' || next == U',') && !is_digit(walk.peek(end + 1));
    constexpr std::u32string_view k_may_follow = U" )];:%‰°±(";
    return next == U'\0' || ends_sentence || k_may_follow.find(next) != std::u32string_view::npos;
}

/// Whether a blank or apostrophe sets a group of digits apart (SI Brochure, 9th edition, 5.4.4: by three from the decimal
/// sign): before that sign three digits follow it; behind it three digits stand before it, and one to three follow.
/// \param run  digits since the decimal sign or the last group, or from the beginning
bool group_follows(const Walk& walk, bool is_behind_sign, bool is_behind_group, std::size_t run) {
    if (walk.peek() != U' ' && walk.peek() != U'\'') {
        return false;
    }
    const bool is_whole =
        is_digit(walk.peek(1)) && is_digit(walk.peek(2)) && is_digit(walk.peek(3)) && !is_digit(walk.peek(4));
    if (is_behind_sign || is_behind_group) {
        return run == k_group && (is_whole || (is_behind_sign && last_decimals_follow(walk)));
    }
    return run > 0 && run <= k_group && is_whole;
}

/// The digits of a number. A single separator is the decimal sign, unless three digits follow a comma of which there is
/// more than one; where both occur, the last one is it.
std::optional<Digits> take_digits(Walk& walk, DecimalSign sign) {
    std::u32string raw;
    bool has_groups = false, is_behind_sign = false;
    std::size_t run = 0;
    while (true) {
        const char32_t code = walk.peek();
        const bool group = group_follows(walk, is_behind_sign, has_groups, run);
        const bool separator = (code == U'.' || code == U',') && (is_digit(walk.peek(1)) || !raw.empty());
        if (!is_digit(code) && !separator && !group) {
            break;
        }
        if (separator && !is_digit(walk.peek(1)) && code == U',') {
            break;  // "0.36, k = 2": a comma of the sentence
        }
        walk.take();
        has_groups = has_groups || group;
        is_behind_sign = is_behind_sign || separator;
        run = group || separator ? 0 : run + 1;
        if (!group) {
            raw += code;
        }
    }
    const std::size_t last_point = raw.rfind(U'.'), last_comma = raw.rfind(U',');
    const auto count = [&raw](char32_t code) {
        std::size_t n = 0;
        for (const char32_t c : raw) {
            n += c == code ? 1U : 0U;
        }
        return n;
    };
    char32_t decimal = U'\0';
    if (last_point != std::u32string::npos && last_comma != std::u32string::npos) {
        decimal = last_point > last_comma ? U'.' : U',';
    } else if (last_point != std::u32string::npos && count(U'.') == 1) {
        decimal = U'.';
    } else if (last_comma != std::u32string::npos && count(U',') == 1) {
        decimal = U',';
    }
    if (decimal != U'\0' && count(decimal) > 1) {
        return std::nullopt;
    }
    Digits digits;
    // "1.200" may be 1200. No thousands stand behind a zero, and none are set apart in two ways or before a power of ten.
    const std::size_t separator = raw.find_first_of(U".,");
    const bool either = decimal != U'\0' && count(U'.') + count(U',') == 1 && separator > 0 && separator <= k_group &&
                        raw.front() != U'0' && raw.size() == separator + 1 + k_group && !has_groups &&
                        !exponent_follows(walk);
    if (either && sign != DecimalSign::each) {
        digits.is_open = sign == DecimalSign::open;
        decimal = (decimal == U'.') == (sign == DecimalSign::point) ? decimal : U'\0';
    } else if (!either && decimal != U'\0') {
        digits.shows = decimal == U'.' ? DecimalSign::point : DecimalSign::comma;
    } else if (!either && count(U'.') > 1) {
        digits.shows = DecimalSign::comma;
    } else if (!either && count(U',') > 1) {
        digits.shows = DecimalSign::point;
    }
    // What is not the decimal sign sets thousands apart: "631.74.2" is a slip of the keyboard, and no number.
    const std::size_t end_of_whole = decimal == U'\0' ? raw.size() : raw.find(decimal);
    std::size_t digits_before = 0;
    bool grouped = false;
    for (std::size_t i = 0; i <= end_of_whole; ++i) {
        if (i < end_of_whole && is_digit(raw[i])) {
            ++digits_before;
            continue;
        }
        if (grouped && digits_before != 3) {
            return std::nullopt;
        }
        grouped = i < end_of_whole;
        digits_before = 0;
    }
    if (end_of_whole < raw.size() && raw.find_first_of(U".,", end_of_whole + 1) != std::u32string::npos) {
        return std::nullopt;
    }
    bool any = false;
    for (const char32_t code : raw) {
        if (is_digit(code)) {
            digits.plain += static_cast<char>(code);
            digits.decimals += digits.whole ? 0 : 1;
            any = true;
        } else if (code == decimal) {
            digits.plain += '.';
            digits.whole = false;
        }
    }
    if (!any) {
        return std::nullopt;
    }
    return digits;
}

std::optional<int> take_exponent(Walk& walk) {
    const std::size_t start = walk.position();
    if (letter_of_power_follows(walk)) {
        walk.skip_spaces();
    }
    const char32_t first = walk.peek();
    const bool letter = first == U'e' || first == U'E';
    if (letter) {
        walk.take();
    } else {
        walk.skip_spaces();
        const bool times = is_times(walk.peek());
        if (times) {
            walk.take();
        }
        const bool is_multiplied = times || walk.take_word("x");
        walk.skip_spaces();
        if (!is_multiplied || !walk.take_word("10")) {
            walk.go_to(start);
            return std::nullopt;
        }
        bool is_raised = walk.take_if(U'^') || lowered(walk.peek()) != walk.peek();
        if (!is_raised && walk.peek() == U'*' && walk.peek(1) == U'*') {
            walk.take();
            walk.take();
            is_raised = true;
        }
        const bool is_bracketed = walk.take_if(U'(');
        // "× 100" is a hundred, and no power of ten without its sign.
        if (!is_raised && !is_bracketed && (walk.peek() == U'0' || walk.peek() == U'.' || walk.peek() == U',')) {
            walk.go_to(start);
            return std::nullopt;
        }
    }
    int sign = 1;
    if (const char32_t code = lowered(walk.peek()); code == U'-' || code == k_en_dash) {
        sign = -1;
        walk.take();
    } else if (code == U'+') {
        walk.take();
    }
    // "10⁻⁶" ends where digits are no longer raised.
    const bool by_raised = lowered(walk.peek()) != walk.peek();
    int exponent = 0, count = 0;
    while (is_digit(lowered(walk.peek())) && (lowered(walk.peek()) != walk.peek()) == by_raised && count < 4) {
        exponent = exponent * 10 + static_cast<int>(lowered(walk.take()) - U'0');
        ++count;
    }
    if (count == 0) {
        walk.go_to(start);
        return std::nullopt;
    }
    walk.take_if(U')');
    return sign * exponent;
}

/// "√3", "sqrt(3)", "sqrt 3", "Wurzel 3", "root 3".
std::optional<double> take_root(Walk& walk) {
    const std::size_t start = walk.position();
    const bool sign = walk.take_if(k_root);
    if (!sign && !walk.take_word("sqrt") && !walk.take_word("wurzel") && !walk.take_word("root")) {
        return std::nullopt;
    }
    walk.skip_spaces();
    const bool open = walk.take_if(U'(');
    const std::optional<Digits> digits = take_digits(walk, DecimalSign::each);
    if (!digits) {
        walk.go_to(start);
        return std::nullopt;
    }
    if (open && !walk.take_if(U')')) {
        walk.go_to(start);
        return std::nullopt;
    }
    double value = 0.0;
    std::from_chars(digits->plain.data(), digits->plain.data() + digits->plain.size(), value);
    return std::sqrt(value);
}

/// "^0.5", "^(1/2)", "^½" behind a number: its root.
bool takes_power_of_half(Walk& walk) {
    const std::size_t start = walk.position();
    if (walk.take_if(U'^')) {
        for (const std::string_view half : {"(1/2)", "(0.5)", "(0,5)", "1/2", "0.5", "0,5"}) {
            if (walk.take_word(half) && !is_digit(walk.peek())) {
                return true;
            }
        }
        constexpr char32_t k_half = 0x00BD;
        if (walk.take_if(k_half)) {
            return true;
        }
    }
    walk.go_to(start);
    return false;
}

std::optional<LeadingNumber> take_number(Walk& walk, Percent percent, DecimalSign sign_of_others) {
    walk.skip_spaces();
    double sign = 1.0;
    if (walk.take_if(k_plus_minus)) {
        walk.skip_spaces();
    } else if (walk.peek() == U'+' && walk.peek(1) == U'/' && walk.peek(2) == U'-') {
        walk.go_to(walk.position() + 3);
        walk.skip_spaces();
    } else if (walk.peek() == U'+' && walk.peek(1) == U'-') {
        walk.go_to(walk.position() + 2);
        walk.skip_spaces();
    }
    if (walk.take_if(U'-')) {
        sign = -1.0;
        walk.skip_spaces();
    } else {
        walk.take_if(U'+');
    }
    StatedNumber number;
    if (walk.take_if(k_infinity) || walk.take_word("infinity") || walk.take_word("infinite") ||
        walk.take_word("unendlich") || walk.take_word("inf")) {
        number.value = sign * std::numeric_limits<double>::infinity();
        return LeadingNumber{.number = std::move(number), .rest = ""};
    }
    if (const std::optional<double> root = take_root(walk)) {
        number.value = sign * *root;
        return LeadingNumber{.number = std::move(number), .rest = ""};
    }
    const std::optional<Digits> digits = take_digits(walk, sign_of_others);
    if (!digits) {
        return std::nullopt;
    }
    const std::optional<int> exponent = take_exponent(walk);
    const std::string all = digits->plain + "e" + std::to_string(exponent.value_or(0));
    const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), number.value);
    if (error != std::errc{} || end != all.data() + all.size()) {
        return std::nullopt;
    }
    // A whole number is meant exactly, as a divisor or a number of readings is; decimals say to which digit a number
    // was rounded.
    number.half_step = digits->whole && !exponent ? 0.0 : 0.5 * std::pow(10.0, exponent.value_or(0) - digits->decimals);
    if (takes_power_of_half(walk)) {
        number.value = std::sqrt(number.value);
        number.half_step = 0.0;
    }
    const std::size_t before = walk.position();
    walk.skip_spaces();
    if (percent == Percent::hundredth && walk.take_if(U'%')) {
        number.value /= 100.0;
        number.half_step /= 100.0;
    } else if (const std::optional<double> root = take_root(walk)) {
        number.value *= *root;
        number.half_step = 0.0;
    } else {
        walk.go_to(before);
    }
    number.value *= sign;
    return LeadingNumber{.number = std::move(number), .rest = "", .shows = digits->shows, .is_open = digits->is_open};
}

}  // namespace

double printed_half_step(const StatedNumber& number) {
    std::string text = number.text;
    if (number.half_step == 0.0) {  // signs in a whole number set thousands apart
        text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == '.' || c == ',' || c == '\''; }),
                   text.end());
    }
    if (number.half_step != 0.0 || number.value == 0.0 || text.empty() ||
        text.find_first_not_of("0123456789") != std::string::npos) {
        return number.half_step;
    }
    // Of "100" two digits are taken to be meant: no more than those are printed of an uncertainty.
    const std::size_t last = text.find_last_not_of('0');
    const std::size_t zeros = std::min(text.size() - 1 - last, text.size() - std::min<std::size_t>(text.size(), 2));
    return 0.5 * std::pow(10.0, static_cast<double>(zeros));
}

void convert(StatedNumber& number, double factor) {
    if (factor == 1.0) {
        return;
    }
    constexpr double k_power = 1e-12, k_most_decimals = 17.0;
    const double exponent = std::round(std::log10(std::abs(factor)));
    const bool is_power = factor > 0.0 && std::abs(factor / std::pow(10.0, exponent) - 1.0) < k_power;
    const bool is_whole = number.half_step == 0.0 && number.value == std::round(number.value);
    const bool has_digits = !number.text.empty() && (is_whole || number.half_step > 0.0);
    const double decimals =
        has_digits ? (is_whole ? 0.0 : std::round(-std::log10(2.0 * number.half_step))) - exponent : 0.0;
    const std::size_t sign = number.text.find_last_of(".,");
    const bool has_comma = !is_whole && sign != std::string::npos && number.text[sign] == ',';
    number.value *= factor;
    number.half_step *= std::abs(factor);
    number.scale *= factor;
    if (!has_digits || !is_power || !std::isfinite(number.value) || !(std::abs(decimals) <= k_most_decimals)) {
        number.text.clear();
        return;
    }
    number.text =
        number.value == 0.0 && is_whole ? "0" : text::fixed(number.value, static_cast<int>(std::max(0.0, decimals)));
    // The digits are those of before: the number is the nearest one to them, as if it had been read in this unit.
    std::from_chars(number.text.data(), number.text.data() + number.text.size(), number.value);
    const std::size_t point = number.text.find('.');
    if (has_comma && point != std::string::npos) {
        number.text[point] = ',';
    }
}

StatedNumber exact_number(double value, std::string place) {
    StatedNumber number;
    number.value = value;
    number.place = std::move(place);
    return number;
}

std::optional<LeadingNumber> read_leading_number(std::string_view text, std::string place, Percent percent,
                                                 DecimalSign sign) {
    constexpr std::size_t k_longest = 400;
    if (text.size() > k_longest) {
        return std::nullopt;
    }
    Walk walk(characters(text));
    std::optional<LeadingNumber> leading = take_number(walk, percent, sign);
    if (!leading) {
        return std::nullopt;
    }
    leading->number.text = beginning(text, walk.position());
    leading->number.place = std::move(place);
    leading->rest = walk.rest();
    return leading;
}

DecimalSign decimal_sign_in(std::string_view text) {
    DecimalSign all = DecimalSign::each;
    const auto is_part = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == ',' ||
               c == '-' || c == '/' || c == '_';
    };
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool begins = text[at] >= '0' && text[at] <= '9' && (at == 0 || !is_part(text[at - 1]));
        const std::optional<LeadingNumber> number = begins ? read_leading_number(text.substr(at), "") : std::nullopt;
        if (!number || number->shows == DecimalSign::each) {
            continue;
        }
        all = all == DecimalSign::each || all == number->shows ? number->shows : DecimalSign::open;
    }
    return all;
}

std::optional<StatedNumber> read_number(std::string_view text, std::string place, DecimalSign sign) {
    std::optional<LeadingNumber> leading = read_leading_number(text, std::move(place), Percent::hundredth, sign);
    if (!leading || leading->is_open || !leading->rest.empty()) {
        return std::nullopt;
    }
    return std::move(leading->number);
}

}  // namespace gumcert::audit
