#include "reports/dcc/printed_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "text/plus_sign.h"

namespace gumcert::reports {

std::optional<PrintedNumber> printed_number(std::string_view printed) {
    const std::string_view text = text::without_plus(printed);
    PrintedNumber number;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number.value);
    if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(number.value)) {
        return std::nullopt;
    }
    const std::size_t exponent_at = std::min(text.find_first_of("eE"), text.size());
    const std::string_view digits = text.substr(0, exponent_at);
    const std::size_t point = digits.find('.');
    int exponent = 0;
    if (exponent_at < text.size()) {
        std::string_view rest = text.substr(exponent_at + 1);
        rest.remove_prefix(rest.starts_with('+') ? 1 : 0);
        std::from_chars(rest.data(), rest.data() + rest.size(), exponent);
    }
    const int decimals = point == std::string_view::npos ? 0 : static_cast<int>(digits.size() - point - 1);
    // A number printed to d decimals stands for all numbers within half a unit of its last digit, zeros at its end
    // included.
    number.half_unit = 0.5 * std::pow(10.0, exponent - decimals);
    return number;
}

}  // namespace gumcert::reports
