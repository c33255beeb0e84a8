#include "reports/record/make/budget/budget_texts.h"

#include <array>
#include <charconv>
#include <cmath>

#include "certificate/statement_of_uncertainty.h"
#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"
#include "text/numbers.h"

namespace gumcert::reports {

std::string rounded(double value, int digits) {
    return gum::round_significant(value, digits);
}

std::string printed_estimate(double value, double u) {
    return u > 0.0 ? gum::round_to_uncertainty(value, u, reports::k_digits_of_u).value : text::shortest(value);
}

std::string as_stated(double value) {
    std::array<char, 32> text{};
    const auto written = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 15);
    double back = value;
    std::from_chars(text.data(), written.ptr, back);
    // The 15 digits are what was written, unless conversion moved the number by more than its own rounding.
    return text::shortest(std::fabs(back - value) <= 4e-16 * std::fabs(value) ? back : value);
}

std::string printed_p_value(double p) {
    constexpr double k_least = 1e-4;
    return p < k_least ? "< 0.0001" : rounded(p, 2);
}

Shown<std::optional<double>> shown_degrees_of_freedom(double nu) {
    const std::optional<double> number = finite_or_none(nu);
    return {number, std::isnan(nu) ? "–" : certificate::printed_degrees_of_freedom(number)};
}

}  // namespace gumcert::reports
