#include "text/numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <system_error>

namespace gumcert::text {

namespace {

template <typename... Form>
std::string written(double value, Form... form) {
    if (std::isnan(value)) {
        return "NaN";  // to_chars shows the sign bit of a NaN, which means nothing to a reader
    }
    // The largest double has 309 digits before the point; more decimals than the rest holds are asked for by nobody.
    std::array<char, 1100> buffer{};
    const double shown = value == 0.0 ? 0.0 : value;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), shown, form...).ptr;
    return {buffer.data(), end};
}

/// Nobody writes more: the others are traces of a conversion, 0.30000000000000004.
constexpr int k_digits_of_a_person = 15;
/// The smallest number of double precision, 4.9e-324, with the digits of a person.
constexpr int k_most_decimals = 340;

double value_of(const std::string& number) {
    double value = 0.0;
    std::from_chars(number.data(), number.data() + number.size(), value);
    return value;
}

/// Significant digits of a number, whatever its power of ten.
int digits_of(std::string_view number) {
    const std::string_view mantissa = number.substr(0, number.find_first_of("eE"));
    const auto first = std::find_if(mantissa.begin(), mantissa.end(), [](char c) { return c >= '1' && c <= '9'; });
    return static_cast<int>(std::count_if(first, mantissa.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

/// Decimals of the mantissa less its power of ten: -1.50e-3 has 5, 2e3 has -3.
int decimals_of(std::string_view number) {
    const std::size_t end = std::min(number.find_first_of("eE"), number.size());
    const std::size_t point = number.substr(0, end).find('.');
    const auto most = static_cast<std::size_t>(k_most_decimals);
    const auto decimals = static_cast<int>(point < end ? std::min(end - point - 1, most) : 0);
    std::string_view power = number.substr(std::min(end + 1, number.size()));
    power.remove_prefix(power.starts_with('+') ? 1 : 0);
    int exponent = 0;
    if (std::from_chars(power.data(), power.data() + power.size(), exponent).ec == std::errc::result_out_of_range) {
        exponent = power.starts_with('-') ? -k_most_decimals : k_most_decimals;
    }
    return decimals - std::clamp(exponent, -k_most_decimals, k_most_decimals);
}

/// The 15 digits of a number that is written with more, without the zeros at their end.
std::string without_traces(double value) {
    const std::string text = written(value, std::chars_format::scientific, k_digits_of_a_person - 1);
    const std::size_t end = text.find('e');
    return end == std::string::npos ? text : without_trailing_zeros(text.substr(0, end)) + text.substr(end);
}

}  // namespace

std::string shortest(double value) {
    return written(value);
}

std::string shortest_plain(double value, double least) {
    const double size = std::abs(value);
    return size >= least && size < 1e15 ? written(value, std::chars_format::fixed) : written(value);
}

std::string significant(double value, int digits) {
    return written(value, std::chars_format::general, digits);
}

std::string fixed(double value, int decimals) {
    return written(value, std::chars_format::fixed, decimals);
}

int most_decimals(std::span<const std::string> numbers) {
    int most = 0;
    for (const std::string& number : numbers) {
        const bool has_traces = digits_of(number) > k_digits_of_a_person;
        most = std::max(most, decimals_of(has_traces ? without_traces(value_of(number)) : number));
    }
    return std::min(most, k_most_decimals);
}

std::string without_trailing_zeros(std::string number) {
    if (number.find('.') == std::string::npos || number.find_first_of("eE") != std::string::npos) {
        return number;
    }
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') {
        number.pop_back();
    }
    return number;
}

}  // namespace gumcert::text
