#include "text/numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

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

double value_of(const std::string& number) {
    double value = 0.0;
    std::from_chars(number.data(), number.data() + number.size(), value);
    return value;
}

/// Significant digits of a number without an exponent.
int digits_of(const std::string& number) {
    const auto first = std::find_if(number.begin(), number.end(), [](char c) { return c >= '1' && c <= '9'; });
    return static_cast<int>(std::count_if(first, number.end(), [](char c) { return c >= '0' && c <= '9'; }));
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
        std::string plain = number;
        if (number.find_first_of("eE") != std::string::npos || digits_of(number) > k_digits_of_a_person) {
            plain = shortest_plain(value_of(significant(value_of(number), k_digits_of_a_person)));
        }
        if (plain.find('e') != std::string::npos) {
            return 0;
        }
        const std::size_t point = plain.find('.');
        most = std::max(most, point == std::string::npos ? 0 : static_cast<int>(plain.size() - point - 1));
    }
    return most;
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
