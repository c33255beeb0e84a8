#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"
#include "reports/dcc/printed_number.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/demand.h"
#include "text/numbers.h"

namespace gumcert::fuzz {
namespace {

// Decimal digits of a computation that rounding does not look at, relative to the number (gum/rounding.h).
constexpr long double k_noise = 6e-14L;

long double read_back(const std::string& text) {
    char* end = nullptr;
    const long double value = std::strtold(text.c_str(), &end);
    demand(!text.empty() && *end == '\0', "a printed number that is no number");
    return value;
}

/// Half a unit of the last digit, and that the reader of certificates sees the same number.
long double half_unit_of(const std::string& text) {
    const auto read = reports::printed_number(text);
    demand(read.has_value(), "a printed number that the reader of certificates refuses");
    demand(read->value == std::strtod(text.c_str(), nullptr), "the reader of certificates sees another number");
    return static_cast<long double>(read->half_unit);
}

std::size_t significant_digits(std::string_view text) {
    text = text.substr(0, text.find('E'));
    std::size_t count = 0;
    for (const char c : text) {
        count += (c >= '1' && c <= '9') || (c == '0' && count > 0) ? 1U : 0U;
    }
    return count;
}

/// Digits, one point, one exponent; no negative zero.
void demand_plain(const std::string& text) {
    demand(text.find_first_not_of("0123456789.E+-") == std::string::npos, "a character that is no digit");
    demand(text.front() != '-' || text.find_first_of("123456789") < text.find('E'), "a negative zero");
    demand(std::isdigit(static_cast<unsigned char>(text.back())) != 0, "an end that is no digit");
}

/// Rounded to the nearest multiple of its last digit, and to the even one half-way.
void demand_nearest(double value, const std::string& text) {
    demand_plain(text);
    const long double half = half_unit_of(text);
    const auto exact = static_cast<long double>(value);
    const long double difference = std::abs(read_back(text) - exact);
    demand(difference <= half * (1.0L + 1e-12L) + std::abs(exact) * k_noise, "not the nearest");
}

void print_pair(double value, double U, int digits, gum::RoundingMode mode) {
    const gum::RoundedPair pair = gum::round_to_uncertainty(value, U, digits, mode);
    demand_nearest(value, pair.value);
    demand_plain(pair.U);
    const long double half = half_unit_of(pair.U);
    demand(std::abs(half_unit_of(pair.value) / half - 1.0L) < 1e-9L, "another decimal place");
    demand(significant_digits(pair.U) == static_cast<std::size_t>(digits), "another number of digits");
    const long double excess = read_back(pair.U) - static_cast<long double>(U);
    if (mode == gum::RoundingMode::up) {
        demand(excess >= -static_cast<long double>(U) * 6e-12L && excess < 2.0L * half * (1.0L + 1e-9L),
               "an uncertainty that was not rounded up");
    } else {
        demand_nearest(U, pair.U);
    }
    // What was printed is printed again unchanged.
    const double value_again = std::strtod(pair.value.c_str(), nullptr);
    const double U_again = std::strtod(pair.U.c_str(), nullptr);
    if (significant_digits(pair.value) <= 14) {
        demand(gum::round_to_uncertainty(value_again, U_again, digits, mode) == pair, "printed again otherwise");
    }
    // The sign of a value changes nothing else.
    const gum::RoundedPair mirrored = gum::round_to_uncertainty(-value, U, digits, mode);
    demand(read_back(mirrored.value) == -read_back(pair.value) && mirrored.U == pair.U, "not the same below zero");
}

void print_alone(double value, int digits, int decimals) {
    const std::string significant = gum::round_significant(value, digits);
    demand_nearest(value, significant);
    demand(value == 0.0 || significant_digits(significant) == static_cast<std::size_t>(digits),
           "another number of digits");
    demand_nearest(value, gum::round_to_quantum(value, decimals));
    demand_nearest(value * 100.0, gum::percent(value));
}

void write_number(double value, int digits) {
    const auto demand_same = [&](const std::string& text) {
        demand(std::strtod(text.c_str(), nullptr) == value && text != "-0", "another number is read back");
    };
    demand_same(text::shortest(value));
    demand_same(text::shortest_plain(value));
    demand_same(text::significant(value, 17));
    const std::string fixed = text::fixed(value, digits);
    demand(std::strtod(text::without_trailing_zeros(fixed).c_str(), nullptr) == std::strtod(fixed.c_str(), nullptr),
           "zeros that meant something");
}

}  // namespace
}  // namespace gumcert::fuzz

/// A number, an uncertainty and how to round them: what is printed is the nearest multiple of its last digit, is read back
/// as the same number and printed again as the same text.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    fuzz::ByteSource bytes({reinterpret_cast<const char*>(data), size});
    // Near the ends of the doubles the printed decimal number may be none.
    const auto inside = [](double number) {
        const double magnitude = std::abs(number);
        return magnitude > 0.0 && magnitude < 1e-290        ? 1e-290
               : std::isfinite(number) && magnitude > 1e290 ? 1e290
                                                            : number;
    };
    const double value = inside(bytes.number());
    const double U = inside(bytes.number());
    const int digits = bytes.between(0, 16);
    const auto mode = bytes.below(2) == 0 ? gum::RoundingMode::half_even : gum::RoundingMode::up;
    const int decimals = bytes.between(-302, 402);
    const bool is_printable = std::isfinite(value) && digits >= 1 && digits <= 15;
    try {
        fuzz::print_pair(value, U, digits, mode);
        fuzz::demand(is_printable && std::isfinite(U) && U > 0.0, "printed against its rule");
    } catch (const gum::InputError&) {
        fuzz::demand(!is_printable || !(std::isfinite(U) && U > 0.0), "refused without a reason");
    }
    try {
        fuzz::print_alone(value, digits, decimals);
    } catch (const gum::InputError&) {
        fuzz::demand(!is_printable || decimals < -300 || decimals > 400, "refused without a reason");
    }
    if (std::isfinite(value)) {
        fuzz::write_number(value, std::clamp(digits, 0, 15));
    }
    return 0;
}
