#include "text/numbers.h"

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
