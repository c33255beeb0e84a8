#include "gum/rounding.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "gum/argument_check.h"

namespace gumcert::gum {
namespace {

constexpr int k_most_digits = 15;           // every decimal of 15 digits survives a double
constexpr int k_trusted_digits = 12;        // of a computed uncertainty, see RoundingMode::up
constexpr int k_first_fixed_exponent = -4;  // 1e-4
constexpr int k_last_fixed_exponent = 5;    // below 1e6
constexpr int k_most_plain_decimals = 18;   // 20 characters: nobody counts more zeros behind the point
constexpr double k_least_with_power = 1e15;

/// ±digits × 10^exponent, digits without leading zeros ("0" for zero).
struct Decimal {
    bool negative = false;
    std::string digits;
    int exponent = 0;

    [[nodiscard]] bool is_zero() const { return digits == "0"; }
    /// Power of ten of the leading digit.
    [[nodiscard]] int leading_exponent() const { return exponent + static_cast<int>(digits.size()) - 1; }
};

/// The shortest decimal that reads back as the same double; `value` is finite.
Decimal shortest_decimal(double value) {
    std::array<char, 40> buffer{};
    const std::to_chars_result result =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific);
    std::string_view text(buffer.data(), static_cast<std::size_t>(result.ptr - buffer.data()));
    Decimal decimal;
    if (text.front() == '-') {
        decimal.negative = true;
        text.remove_prefix(1);
    }
    const std::size_t exponent_sign = text.find('e');
    for (const char character : text.substr(0, exponent_sign)) {
        if (character != '.') {
            decimal.digits += character;
        }
    }
    std::string_view exponent = text.substr(exponent_sign + 1);
    if (exponent.front() == '+') {
        exponent.remove_prefix(1);  // from_chars does not take a plus sign
    }
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), decimal.exponent);
    decimal.exponent -= static_cast<int>(decimal.digits.size()) - 1;
    return decimal;
}

/// Adds one unit of the last digit.
void increment(std::string& digits) {
    auto digit = digits.rbegin();
    while (digit != digits.rend() && *digit == '9') {
        *digit++ = '0';
    }
    if (digit == digits.rend()) {
        digits.insert(digits.begin(), '1');
    } else {
        ++*digit;
    }
}

// A number of 16 or 17 digits is the result of a computation, and its last digits are the rounding of that computation:
// 3139.674 + 223.676 gives 3363.3499999999995. Where a tie is judged far above them, they are rounded off first.
constexpr std::size_t k_digits_of_a_computed_number = 16;
constexpr int k_digits_before_rounding_noise = 14;
constexpr int k_most_digits_kept = 12;

/// The multiple of 10^quantum_exponent that stands for the number; the result has just that exponent.
Decimal rounded(const Decimal& number, int quantum_exponent, RoundingMode mode) {
    Decimal result{.negative = number.negative, .digits = number.digits, .exponent = quantum_exponent};
    if (number.is_zero()) {
        return result;
    }
    if (number.exponent >= quantum_exponent) {
        result.digits.append(static_cast<std::size_t>(number.exponent - quantum_exponent), '0');
        return result;
    }
    const int kept_count = number.leading_exponent() - quantum_exponent + 1;
    // Only for ties to even. RoundingMode::up has cut the noise before, at twelve digits, or an excess in the last bit
    // would move the printed U by a whole unit.
    if (mode == RoundingMode::half_even && number.digits.size() >= k_digits_of_a_computed_number &&
        kept_count <= k_most_digits_kept) {
        const int noise_exponent = number.leading_exponent() - k_digits_before_rounding_noise + 1;
        const Decimal without_noise = rounded(number, noise_exponent, mode);
        // Fewer digits than before, so that this ends.
        if (without_noise.digits.size() < k_digits_of_a_computed_number) {
            return rounded(without_noise, quantum_exponent, mode);
        }
    }
    const auto dropped_count = static_cast<std::size_t>(quantum_exponent - number.exponent);
    // Where the number lies wholly below the last place that is kept, zeros in front put its first digit where it
    // belongs: 0.04 rounded to units has the half at the tenths, and they are 0.
    std::string kept = "0";
    std::string dropped = number.digits;
    if (dropped_count < number.digits.size()) {
        kept = number.digits.substr(0, number.digits.size() - dropped_count);
        dropped = number.digits.substr(kept.size());
    } else {
        dropped.insert(0, dropped_count - number.digits.size(), '0');
    }
    const bool exact = dropped.find_first_not_of('0') == std::string::npos;
    const bool tie = dropped.front() == '5' && dropped.find_first_not_of('0', 1) == std::string::npos;
    const bool last_kept_is_odd = (kept.back() - '0') % 2 != 0;
    const bool away = mode == RoundingMode::up ? !exact : tie ? last_kept_is_odd : dropped.front() >= '5';
    if (away) {
        increment(kept);
    }
    result.digits = kept;
    return result;
}

/// Rounded to significant digits; a carry (9.96 -> 10) moves the last place, so that the count holds.
Decimal rounded_to_digits(const Decimal& number, int digits, RoundingMode mode) {
    const int quantum_exponent = number.leading_exponent() - digits + 1;
    Decimal result = rounded(number, quantum_exponent, mode);
    // After a carry the number itself is rounded again, one place higher, and not the rounded one: rounding twice can
    // make a tie of what was none.
    if (static_cast<int>(result.digits.size()) > digits) {
        result = rounded(number, quantum_exponent + 1, mode);
    }
    return result;
}

std::string sign_text(const Decimal& number) {
    return number.negative && !number.is_zero() ? "-" : "";
}

/// Plain decimal text; the exponent is 0 or negative.
std::string fixed_text(const Decimal& number) {
    const auto decimals = static_cast<std::size_t>(-number.exponent);
    std::string text = number.digits;
    if (text.size() <= decimals) {
        text.insert(0, decimals + 1 - text.size(), '0');
    }
    if (decimals > 0) {
        text.insert(text.size() - decimals, 1, '.');
    }
    return sign_text(number) + text;
}

/// One digit before the decimal sign and a power of ten.
std::string power_of_ten_text(const Decimal& number) {
    std::string text = number.digits;
    if (text.size() > 1) {
        text.insert(1, 1, '.');
    }
    const int exponent = number.leading_exponent();
    return sign_text(number) + text + (exponent < 0 ? "E-" : "E+") + std::to_string(std::abs(exponent));
}

/// Text of a rounded number; every digit of it is significant.
std::string document_text(const Decimal& number) {
    return number.exponent > 0 || number.exponent < -k_most_plain_decimals ? power_of_ten_text(number)
                                                                           : fixed_text(number);
}

void require_digits(int digits) {
    if (digits < 1 || digits > k_most_digits) {
        refuse("GC-GUM-0040", "number of significant digits", std::to_string(digits),
               "must be 1 to " + std::to_string(k_most_digits), "Use 2, or 1 where the profile demands it.");
    }
}

double number_in(const std::string& text) {
    double number = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// Numbers that differ behind it differ by the rounding of a computation.
constexpr int k_most_compared_digits = 12;

/// Whether two numbers as printed are in the order in which they are.
bool has_order(double printed, double printed_other, double number, double other) {
    return (printed < printed_other) == (number < other) && (printed > printed_other) == (number > other);
}

}  // namespace

RoundedPair round_to_uncertainty(double value, double U, int digits, RoundingMode mode) {
    require_finite(value, "value to print");
    require_positive(U, "uncertainty to print");
    require_digits(digits);
    Decimal uncertainty = shortest_decimal(U);
    if (mode == RoundingMode::up) {
        uncertainty = rounded_to_digits(uncertainty, std::max(k_trusted_digits, digits), RoundingMode::half_even);
    }
    const Decimal printed_uncertainty = rounded_to_digits(uncertainty, digits, mode);
    // The value is never rounded up, also where U is: that would move it. Both end at the same place (JCGM 100:2008,
    // 7.2.6).
    const Decimal printed_value =
        rounded(shortest_decimal(value), printed_uncertainty.exponent, RoundingMode::half_even);
    return {.value = document_text(printed_value), .U = document_text(printed_uncertainty)};
}

std::string round_to_quantum(double value, int decimals) {
    require_finite(value, "value to print");
    if (decimals < -300 || decimals > 400) {
        refuse("GC-GUM-0041", "number of decimals", std::to_string(decimals), "must be -300 to 400",
               "Correct the number of decimals.");
    }
    return document_text(rounded(shortest_decimal(value), -decimals, RoundingMode::half_even));
}

std::string round_as_written(double value, int decimals) {
    if (!(std::abs(value) >= k_least_with_power)) {
        return round_to_quantum(value, decimals);
    }
    require_finite(value, "value to print");
    Decimal number = rounded_to_digits(shortest_decimal(value), k_most_digits, RoundingMode::half_even);
    while (number.digits.size() > 1 && number.digits.back() == '0') {
        number.digits.pop_back();
        ++number.exponent;
    }
    return document_text(number);
}

double settled_decimal(double value, double lost) {
    // By chance a number lies so near to a decimal one once in 50 times, and nothing is lost then either.
    constexpr double k_far_above = 100.0;
    if (!std::isfinite(value) || value == 0.0 || !std::isfinite(lost) || !(lost > 0.0)) {
        return value;
    }
    const int quantum = static_cast<int>(std::ceil(std::log10(k_far_above * lost)));
    const Decimal number = shortest_decimal(value);
    if (number.exponent >= quantum) {
        return value;  // has no digit below
    }
    const Decimal nearest = rounded(number, quantum, RoundingMode::half_even);
    const std::string text = power_of_ten_text(nearest);
    double settled = value;
    std::from_chars(text.data(), text.data() + text.size(), settled);
    return std::abs(settled - value) <= lost ? settled : value;
}

std::string round_significant(double value, int digits) {
    require_finite(value, "value to print");
    require_digits(digits);
    const Decimal number = shortest_decimal(value);
    if (number.is_zero()) {
        return "0";
    }
    const Decimal printed = rounded_to_digits(number, digits, RoundingMode::half_even);
    const int leading = printed.leading_exponent();
    const bool fixed = printed.exponent <= 0 && leading >= k_first_fixed_exponent && leading <= k_last_fixed_exponent;
    return fixed ? fixed_text(printed) : power_of_ten_text(printed);
}

std::string round_significant_beside(double value, int digits, const std::vector<double>& limits) {
    const auto stands = [&](const std::string& text) {
        return std::all_of(limits.begin(), limits.end(),
                           [&](double limit) { return has_order(number_in(text), limit, value, limit); });
    };
    for (int more = digits; more <= k_most_compared_digits; ++more) {
        std::string text = round_significant(value, more);
        if (stands(text)) {
            return text;
        }
    }
    return round_significant(value, digits);  // rounding of the computation is all that parts them
}

std::vector<std::string> round_in_order(const std::vector<double>& numbers, int digits,
                                        std::string (*rounded)(double number, int digits)) {
    const auto texts_with = [&](int of) {
        std::vector<std::string> texts;
        for (const double number : numbers) {
            texts.push_back(rounded(number, of));
        }
        return texts;
    };
    for (int more = digits; more <= k_most_compared_digits; ++more) {
        std::vector<std::string> texts = texts_with(more);
        bool stands = true;
        for (std::size_t i = 1; i < numbers.size(); ++i) {
            stands = stands && has_order(number_in(texts[0]), number_in(texts[i]), numbers[0], numbers[i]);
        }
        if (stands) {
            return texts;
        }
    }
    return texts_with(digits);
}

std::string percent(double share) {
    require_finite(share, "share to print");
    Decimal number = shortest_decimal(share);
    // In decimal the factor 100 is a shift of the exponent. A product of doubles would bring a rounding of its own.
    number.exponent += 2;
    return document_text(rounded(number, -1, RoundingMode::half_even));
}

}  // namespace gumcert::gum
