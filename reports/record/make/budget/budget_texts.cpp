#include "reports/record/make/budget/budget_texts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

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

namespace {

/// Zeros behind the number up to those of the finest of a series: not up to those of 1e-30.
constexpr int k_most_filled_decimals = 18;

/// The number that was written, without the traces of conversion.
double written_number(double value) {
    std::array<char, 32> text{};
    const auto written = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 15);
    double back = value;
    std::from_chars(text.data(), written.ptr, back);
    // The 15 digits are what was written, unless conversion moved the number by more than its own rounding.
    return std::fabs(back - value) <= 4e-16 * std::fabs(value) ? back : value;
}

}  // namespace

std::string as_stated(double value) {
    return text::shortest(written_number(value));
}

std::vector<std::string> series_as_stated(std::span<const double> values, int least) {
    std::vector<std::string> texts;
    texts.reserve(values.size());
    std::vector<int> decimals;
    decimals.reserve(values.size());
    int most = std::max(least, 0);
    for (const double value : values) {
        const std::string shortest = text::shortest(written_number(value));
        decimals.push_back(text::most_decimals({&shortest, 1}));
        most = std::max(most, decimals.back());
    }
    const bool are_filled = most <= k_most_filled_decimals;
    for (std::size_t i = 0; i < values.size(); ++i) {
        texts.push_back(gum::round_as_written(written_number(values[i]), are_filled ? most : decimals[i]));
    }
    return texts;
}

std::string printed_p_value(double p) {
    constexpr double k_least = 1e-4;
    return p < k_least ? "< 0.0001" : gum::round_significant_beside(p, 2, {0.05, 0.01});
}

Shown<std::optional<double>> shown_degrees_of_freedom(double nu) {
    const std::optional<double> number = finite_or_none(nu);
    return {number, std::isnan(nu) ? "–" : certificate::printed_degrees_of_freedom(number)};
}

}  // namespace gumcert::reports
