#include "reports/agreement/numbers_as_printed.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "reports/forms/pdf_page_texts.h"
#include "text/utf8.h"

namespace gumcert::reports {

namespace {

constexpr char k_joint = k_end_of_drawn_text;
constexpr std::string_view k_minus = "\u2212";
constexpr std::string_view k_raised_minus = "\u207B";

constexpr bool is_digit_here(std::string_view text, std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

bool is_letter_here(std::string_view text, std::size_t at) {
    return at < text.size() && ((text[at] >= 'a' && text[at] <= 'z') || (text[at] >= 'A' && text[at] <= 'Z'));
}

bool is_space(char32_t code) {
    return text::is_blank(code) || code == U'\n' || code == static_cast<char32_t>(k_joint);
}

/// Behind blanks and line ends.
std::size_t behind_blanks(std::string_view text, std::size_t at) {
    while (at < text.size()) {
        const text::Character one = text::decode_utf8(text, at);
        if (one.bytes == 0 || !is_space(one.code)) {
            break;
        }
        at += one.bytes;
    }
    return at;
}

std::size_t behind_joints(std::string_view text, std::size_t at) {
    while (at < text.size() && text[at] == k_joint) {
        ++at;
    }
    return at;
}

/// Whether what stands here is a decimal sign with a digit behind it.
bool is_decimal_sign(std::string_view text, std::size_t at) {
    return at < text.size() && (text[at] == '.' || text[at] == ',') && is_digit_here(text, behind_joints(text, at + 1));
}

/// Whether the number that begins here has a minus sign.
bool has_minus(std::string_view text, std::size_t first) {
    if (first > 0 && text[first - 1] == '-') {
        return first == 1 || !(is_digit_here(text, first - 2) || is_letter_here(text, first - 2));
    }
    std::size_t at = first;
    for (bool is_blank = true; is_blank && at > 0;) {
        std::size_t begin = at - 1;
        while (begin > 0 && text::is_continuation(text[begin])) {
            --begin;
        }
        const text::Character one = text::decode_utf8(text, begin);
        is_blank = one.bytes > 0 && is_space(one.code);
        at = is_blank ? begin : at;
    }
    return text.substr(0, at).ends_with(k_minus);
}

/// A digit that is set as an exponent; -1 of anything else, and the bytes that it takes.
std::pair<int, std::size_t> raised_digit(std::string_view text) {
    static constexpr std::array<std::string_view, 10> k_digits = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                                                  "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    for (std::size_t i = 0; i < k_digits.size(); ++i) {
        if (text.starts_with(k_digits.at(i))) {
            return {static_cast<int>(i), k_digits.at(i).size()};
        }
    }
    return {-1, 0};
}

constexpr int k_largest_exponent = 9999;

/// The exponent behind a mantissa that ends here: "E-3", "× 10⁻³", "· 10" and "−3" behind it.
int exponent_behind(std::string_view text, std::size_t at) {
    int exponent = 0;
    const auto take = [&](int digit) { exponent = std::min(exponent * 10 + digit, k_largest_exponent); };
    if (at < text.size() && (text[at] == 'E' || text[at] == 'e')) {
        const bool is_negative = at + 1 < text.size() && text[at + 1] == '-';
        const bool has_sign = is_negative || (at + 1 < text.size() && text[at + 1] == '+');
        for (std::size_t i = at + (has_sign ? 2U : 1U); is_digit_here(text, i); ++i) {
            take(text[i] - '0');
        }
        return is_negative ? -exponent : exponent;
    }
    at = behind_blanks(text, at);
    for (const std::string_view times : {"\u00D7", "\u00B7", "\u22C5"}) {
        if (!text.substr(at).starts_with(times)) {
            continue;
        }
        const std::size_t one = behind_blanks(text, at + times.size());
        const std::size_t zero = behind_joints(text, one + 1);
        if (one >= text.size() || text[one] != '1' || zero >= text.size() || text[zero] != '0') {
            return 0;
        }
        std::string_view rest = text.substr(behind_joints(text, zero + 1));
        const bool raised = rest.starts_with(k_raised_minus) || raised_digit(rest).first >= 0;
        if (!raised) {
            rest = text.substr(behind_blanks(text, zero + 1));
        }
        bool is_negative = false;
        for (const std::string_view minus : {k_raised_minus, k_minus, std::string_view("-")}) {
            if (!is_negative && rest.starts_with(minus)) {
                is_negative = true;
                rest.remove_prefix(minus.size());
                rest.remove_prefix(behind_joints(rest, 0));
            }
        }
        for (auto [digit, bytes] = raised_digit(rest); digit >= 0; std::tie(digit, bytes) = raised_digit(rest)) {
            take(digit);
            rest.remove_prefix(bytes);
            rest.remove_prefix(behind_joints(rest, 0));
        }
        for (; !raised && is_negative && is_digit_here(rest, 0); rest.remove_prefix(1)) {
            take(rest.front() - '0');
        }
        return is_negative ? -exponent : exponent;
    }
    return 0;
}

}  // namespace

bool begins_a_number(std::string_view text, std::size_t begin, bool negative) {
    if (begin > 0) {
        std::size_t before = begin - 1;
        while (before > 0 && text[before] == k_joint) {
            --before;
        }
        const std::size_t sooner = before > 0 ? before - 1 : 0;
        const bool is_fraction = before > 0 && (text[before] == '.' || text[before] == ',') &&
                                 (is_digit_here(text, sooner) || text[sooner] == k_joint);
        if (is_fraction || is_digit_here(text, begin - 1)) {
            return false;
        }
    }
    return has_minus(text, begin) == negative;
}

bool is_printed_at(std::string_view text, std::size_t begin, const NumberAsPrinted& number) {
    if (!begins_a_number(text, begin, number.negative)) {
        return false;
    }
    std::size_t at = begin;
    for (std::size_t i = 0; i < number.digits.size(); ++i) {
        at = behind_joints(text, at);
        if (i > 0 && i + number.decimals == number.digits.size()) {
            if (!is_decimal_sign(text, at)) {
                return false;
            }
            at = behind_joints(text, at + 1);
        }
        if (at >= text.size() || text[at] != number.digits[i]) {
            return false;
        }
        ++at;
    }
    return !is_digit_here(text, at) && !is_decimal_sign(text, behind_joints(text, at)) &&
           exponent_behind(text, at) == number.exponent;
}

std::vector<NumberAsPrinted> numbers_as_printed(std::string_view text) {
    std::vector<NumberAsPrinted> numbers;
    std::size_t digits = 0;
    for (std::size_t at = 0; at < text.size();) {
        if (!is_digit_here(text, at)) {
            ++at;
            continue;
        }
        NumberAsPrinted number{.digits = {}, .negative = has_minus(text, at), .first_digit = digits};
        std::size_t signs = 0;
        for (; is_digit_here(text, at) ||
               (at < text.size() && (text[at] == '.' || text[at] == ',') && is_digit_here(text, at + 1));
             ++at) {
            if (is_digit_here(text, at)) {
                number.digits += text[at];
                number.decimals += signs > 0 ? 1U : 0U;
                ++digits;
            } else {
                ++signs;
            }
        }
        number.exponent = exponent_behind(text, at);
        if (signs < 2) {
            numbers.push_back(std::move(number));
        }
    }
    return numbers;
}

std::optional<NumberAsPrinted> only_number_as_printed(std::string_view text) {
    std::vector<NumberAsPrinted> numbers = numbers_as_printed(text);
    // The exponent of "1.4E-3" is read once more, as a number of its own.
    const std::size_t power = text.find_first_of("eE");
    const bool has_power = power != std::string_view::npos && power > 0 && is_digit_here(text, power - 1);
    return numbers.size() == 1 || (numbers.size() == 2 && has_power) ? std::optional(std::move(numbers.front()))
                                                                     : std::nullopt;
}

}  // namespace gumcert::reports
