#include "text/angle_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace gumcert::text {

namespace {

constexpr std::size_t k_most_digits = 18;   // of a number that is read
constexpr std::size_t k_most_printed = 17;  // before the point, of one that is printed: it can be read again
constexpr std::uint64_t k_sixty = 60;

enum Part : std::size_t { degrees, minutes, seconds };

/// Longer ones first: two apostrophes are a sign of seconds.
constexpr std::array<std::pair<std::string_view, Part>, 9> k_signs{{{"\u00B0", degrees},
                                                                    {"\u00BA", degrees},
                                                                    {"''", seconds},
                                                                    {"\u2033", seconds},
                                                                    {"\u201D", seconds},
                                                                    {"\"", seconds},
                                                                    {"\u2032", minutes},
                                                                    {"\u2019", minutes},
                                                                    {"'", minutes}}};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool all_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

void skip_blanks(std::string_view& text) {
    constexpr std::array<std::string_view, 4> k_blanks{" ", "\u00A0", "\u2009", "\u202F"};
    for (bool again = true; again;) {
        again = false;
        for (const std::string_view blank : k_blanks) {
            if (text.starts_with(blank)) {
                text.remove_prefix(blank.size());
                again = true;
            }
        }
    }
}

bool take(std::string_view& text, std::string_view what) {
    if (!text.starts_with(what)) {
        return false;
    }
    text.remove_prefix(what.size());
    return true;
}

/// A number with decimals, as its digits and how many of them are decimals.
struct Digits {
    std::uint64_t value = 0;
    std::size_t decimals = 0;
};

bool is_decimal_sign(char c) {
    return c == '.' || c == ',';
}

/// Digits with at most one decimal sign, at most 18 in all.
std::optional<Digits> take_digits(std::string_view& text) {
    Digits number;
    std::size_t count = 0;
    bool has_point = false;
    while (!text.empty() && (is_digit(text.front()) || (is_decimal_sign(text.front()) && !has_point && count > 0))) {
        if (is_decimal_sign(text.front())) {
            has_point = true;
        } else {
            if (++count > k_most_digits) {
                return std::nullopt;
            }
            number.value = 10 * number.value + static_cast<std::uint64_t>(text.front() - '0');
            number.decimals += has_point ? 1U : 0U;
        }
        text.remove_prefix(1);
    }
    return count == 0 || (has_point && number.decimals == 0) ? std::nullopt : std::optional(number);
}

/// Digits with the point before the last `decimals` of them, without zeros in front.
std::string with_point(std::string digits, std::size_t decimals) {
    if (digits.size() <= decimals) {
        digits.insert(0, decimals + 1 - digits.size(), '0');
    }
    const std::size_t point = digits.size() - decimals;
    const std::size_t first = std::min(digits.find_first_not_of('0'), point - 1);
    return digits.substr(first, point - first) + (decimals > 0 ? "." + digits.substr(point) : "");
}

/// 12.50 degrees as minutes: each factor of 60 takes one decimal, which is 0.
void times_sixty(Digits& number) {
    number.value *= number.decimals > 0 ? k_sixty / 10 : k_sixty;
    number.decimals -= number.decimals > 0 ? 1U : 0U;
}

bool fits(const Digits& number) {
    constexpr std::uint64_t k_largest = 100'000'000'000'000'000;  // times 60, twice … once more is below 2^64
    return number.value < k_largest;
}

std::string two_digits(std::uint64_t number) {
    return (number < 10 ? "0" : "") + std::to_string(number);
}

}  // namespace

bool has_angle_sign(std::string_view text) {
    return std::any_of(k_signs.begin(), k_signs.end(),
                       [&](const auto& sign) { return text.find(sign.first) != std::string_view::npos; });
}

std::optional<std::string> decimal_of_angle(std::string_view text, AnglePart last) {
    const std::size_t end = last == AnglePart::seconds ? seconds : minutes;
    skip_blanks(text);
    const bool is_negative = take(text, "-") || take(text, "\u2212");
    if (!is_negative) {
        take(text, "+");
    }
    Digits sum;
    std::optional<std::size_t> before;
    for (skip_blanks(text); !text.empty(); skip_blanks(text)) {
        if (before && sum.decimals > 0) {
            return std::nullopt;  // only the last part has decimals
        }
        const std::optional<Digits> number = take_digits(text);
        skip_blanks(text);
        const auto* const sign =
            std::find_if(k_signs.begin(), k_signs.end(), [&](const auto& one) { return text.starts_with(one.first); });
        if (!number || sign == k_signs.end() || sign->second > end || (before && sign->second <= *before)) {
            return std::nullopt;
        }
        text.remove_prefix(sign->first.size());
        std::uint64_t scale = 1;
        for (std::size_t i = 0; i < number->decimals; ++i) {
            scale *= 10;
        }
        if (before && number->value >= k_sixty * scale) {
            return std::nullopt;
        }
        for (std::size_t part = before.value_or(sign->second); part < sign->second; ++part) {
            times_sixty(sum);
            if (!fits(sum)) {
                return std::nullopt;
            }
        }
        if (sum.value >= UINT64_MAX / scale / 2) {
            return std::nullopt;
        }
        sum = {.value = sum.value * scale + number->value, .decimals = number->decimals};
        if (!fits(sum)) {
            return std::nullopt;
        }
        before = sign->second;
    }
    if (!before) {
        return std::nullopt;
    }
    for (std::size_t part = *before; part < end; ++part) {
        times_sixty(sum);
        if (!fits(sum)) {
            return std::nullopt;
        }
    }
    const std::string number = with_point(std::to_string(sum.value), sum.decimals);
    return (is_negative && sum.value > 0 ? "-" : "") + number;
}

std::string angle_in_parts(std::string_view decimal, AnglePart last) {
    std::string_view rest = decimal;
    const bool is_negative = take(rest, "-");
    const std::size_t point = std::min(rest.find('.'), rest.size());
    std::string whole(rest.substr(0, point));
    const std::string fraction(rest.substr(std::min(point + 1, rest.size())));
    if (!all_digits(whole) || (point < rest.size() && !all_digits(fraction))) {
        return std::string(decimal);
    }
    whole.erase(0, std::min(whole.find_first_not_of('0'), whole.size() - 1));
    if (whole.size() > k_most_printed) {
        return std::string(decimal);
    }
    std::uint64_t number = 0;
    std::from_chars(whole.data(), whole.data() + whole.size(), number);
    constexpr std::string_view k_blank = "\u00A0";
    const std::string decimals = fraction.empty() ? "" : "." + fraction;
    std::string parts = two_digits(number % k_sixty) + decimals + (last == AnglePart::seconds ? "\u2033" : "\u2032");
    number /= k_sixty;
    if (last == AnglePart::seconds) {
        parts = two_digits(number % k_sixty) + "\u2032" + std::string(k_blank) + parts;
        number /= k_sixty;
    }
    return (is_negative ? "-" : "") + std::to_string(number) + "\u00B0" + std::string(k_blank) + parts;
}

}  // namespace gumcert::text
