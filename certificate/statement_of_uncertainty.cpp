#include "certificate/statement_of_uncertainty.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace gumcert::certificate {

namespace {

constexpr int k_trusted_digits = 12;     // of a number that a unit was converted of
constexpr int k_digits_of_raised_U = 2;  // as scopes state capabilities
constexpr int k_most_digits_of_a_scope = 4;
constexpr double k_least_printed = 1e-4;  // of a risk
constexpr double k_largest_loss = 0.05;   // of U by rounding
constexpr double k_noise_of_a_quantum = 1e-6;
constexpr double k_noise_of_a_limit = 16.0 * std::numeric_limits<double>::epsilon();
constexpr double k_noise_of_arguments = 0.01;  // of a unit of the last digit of a capability
constexpr double k_noise = 1e-12;              // 3.999…9 degrees of freedom are 4

/// The number without the noise of a conversion.
double trusted(double number) {
    return number_of(gum::round_significant(number, k_trusted_digits)).value_or(number);
}

/// Decimals of a number as it was stated: without the zeros at its end and the noise of a conversion.
int own_decimals(double number) {
    const std::string text = gum::round_significant(number, k_trusted_digits);
    const std::string mantissa = text.substr(0, text.find('E'));
    const std::size_t last = mantissa.find_last_not_of('0');
    if (mantissa.find('.') == std::string::npos || last == std::string::npos) {
        return decimals_of(text);
    }
    const std::size_t zeros = mantissa.size() - 1 - last;
    return decimals_of(text) - static_cast<int>(zeros);
}

/// A number of the scope itself, not one that was computed from measured values.
bool is_of_a_scope(double capability) {
    return significant_digits(gum::round_to_quantum(capability, own_decimals(capability))) <= k_most_digits_of_a_scope;
}

StatedPair raised_to(double value, double capability) {
    const auto floor = [&](gum::RoundingMode mode) {
        return gum::round_to_uncertainty(value, capability, k_digits_of_raised_U, mode);
    };
    // Upwards by a whole unit only where something is left that is more than the scatter of the arguments.
    const gum::RoundedPair nearest = floor(gum::RoundingMode::half_even);
    const gum::RoundedPair pair = is_below_capability(nearest.U, capability) ? floor(gum::RoundingMode::up) : nearest;
    return {.value = pair.value, .U = pair.U, .raised = true};
}

/// Whether rounding took more than a twentieth of U away, as 0.14 printed as 0.1 does.
bool lost_much(const std::string& printed, double U) {
    return number_of(printed).value_or(U) < (1.0 - k_largest_loss) * U;
}

/// The next multiple of a quantum in one direction, or the number itself where it is one but for its rounding noise.
std::string printed_towards(double number, int decimals, double direction) {
    std::string text = gum::round_to_quantum(number, decimals);
    const double quantum = std::pow(10.0, -decimals);
    const double nearest = number_of(text).value_or(number);
    const double noise = k_noise_of_a_quantum * quantum + k_noise_of_a_limit * std::abs(number);
    return direction * (number - nearest) > noise ? gum::round_to_quantum(nearest + direction * quantum, decimals)
                                                  : text;
}

}  // namespace

PrintRule print_rule(const Profile& profile) {
    return {.digits = profile.digits,
            .rounding = profile.rounding == "up" ? gum::RoundingMode::up : gum::RoundingMode::half_even};
}

StatedPair state_uncertainty(double value, double U, std::optional<double> capability, const PrintRule& rule,
                             bool raise) {
    if (U == 0.0 && capability) {
        return raise ? raised_to(value, *capability)
                     : StatedPair{.value = gum::round_to_uncertainty(value, *capability, rule.digits).value,
                                  .U = "0",
                                  .below = true};
    }
    const gum::RoundedPair plain = gum::round_to_uncertainty(value, U, rule.digits, rule.rounding);
    // First as the profile rounds. Rounded down below the capability, or by more than a twentieth, U is rounded up;
    // only a U that is smaller by itself is replaced by the capability.
    const bool too_small = capability && is_below_capability(plain.U, *capability);
    if (!too_small && !lost_much(plain.U, U)) {
        return {.value = plain.value, .U = plain.U};
    }
    // U itself is not below the scope, only its print: it is rounded up and not marked as raised (ADR 0018).
    if (!too_small || trusted(U) >= trusted(*capability)) {
        const gum::RoundedPair upwards = gum::round_to_uncertainty(value, U, rule.digits, gum::RoundingMode::up);
        return {.value = upwards.value, .U = upwards.U};
    }
    return raise ? raised_to(value, *capability) : StatedPair{.value = plain.value, .U = plain.U, .below = true};
}

bool is_below_capability(const std::string& printed_U, double capability) {
    const double held = trusted(capability);
    double noise = 0.0;
    if (held > 0.0 && !is_of_a_scope(held)) {
        const double first_digit = std::floor(std::log10(held));
        noise = k_noise_of_arguments * std::pow(10.0, first_digit - (k_digits_of_raised_U - 1));
    }
    return number_of(printed_U).value_or(0.0) < held - noise;
}

bool states_capability(double U, const std::string& printed_U, std::optional<double> capability) {
    return capability && trusted(U) < trusted(*capability) && !is_below_capability(printed_U, *capability);
}

std::string printed_coverage_factor(double k) {
    return gum::round_to_quantum(k, 2);
}

std::string whole_degrees_of_freedom(double nu_eff) {
    // Truncated, not rounded (JCGM 100:2008, G.4.1, note 1): 149 printed for 148.6 would promise more than there is.
    return nu_eff < 10000.0 ? gum::round_to_quantum(std::floor(nu_eff * (1.0 + k_noise)), 0) : ">9999";
}

std::string printed_degrees_of_freedom(std::optional<double> nu_eff) {
    if (!nu_eff) {
        return "∞";
    }
    if (*nu_eff >= 100.0) {
        return whole_degrees_of_freedom(*nu_eff);
    }
    const std::string text = gum::round_to_quantum(*nu_eff, 1);
    return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string printed_probability(double probability) {
    const double complement = 1.0 - probability;
    // Far out a probability says more of the assumed form of the tail than of the item.
    if (probability < k_least_printed) {
        return "<0.01";
    }
    if (complement < k_least_printed) {
        return ">99.99";
    }
    // Two significant digits of the smaller of both: 99.87 % and 0.13 % are one statement.
    return probability < complement
               ? gum::round_significant(100.0 * probability, 2)
               : gum::round_to_quantum(100.0 * probability, decimals_of(gum::round_significant(100.0 * complement, 2)));
}

int decimals_of(const std::string& printed) {
    const std::size_t exponent_at = printed.find('E');
    const std::string digits = printed.substr(0, exponent_at);
    const std::size_t point = digits.find('.');
    int decimals = point == std::string::npos ? 0 : static_cast<int>(digits.size() - point - 1);
    if (exponent_at != std::string::npos) {
        const std::size_t first = exponent_at + (printed.compare(exponent_at + 1, 1, "+") == 0 ? 2U : 1U);
        int exponent = 0;
        std::from_chars(printed.data() + std::min(first, printed.size()), printed.data() + printed.size(), exponent);
        decimals -= exponent;
    }
    return decimals;
}

std::optional<double> number_of(const std::string& printed) {
    double number = 0.0;
    const char* const end = printed.data() + printed.size();
    const auto [last, error] = std::from_chars(printed.data(), end, number);
    return error == std::errc() && last == end ? std::optional(number) : std::nullopt;
}

int significant_digits(const std::string& printed) {
    const std::string number = printed.substr(0, printed.find('E'));
    const std::size_t first = number.find_first_of("123456789");
    if (first == std::string::npos) {
        return 1;
    }
    return static_cast<int>(std::count_if(number.begin() + static_cast<std::ptrdiff_t>(first), number.end(),
                                          [](char c) { return c >= '0' && c <= '9'; }));
}

std::string printed_coverage_probability(double p) {
    constexpr int k_digits = 4;
    std::string text = gum::round_significant(100.0 * p, k_digits);
    const double outside = 100.0 * (1.0 - p);
    if (!(outside > 0.0)) {
        return text;
    }
    const int enough = 1 - static_cast<int>(std::floor(std::log10(outside)));
    const auto least = text.size();
    const auto whole = text.find('.');
    if (whole == std::string::npos || enough <= static_cast<int>(least - whole - 1)) {
        return text;
    }
    text = gum::round_to_quantum(100.0 * p, enough);
    // 99.9990: the last zero says nothing, and "99.00" stays as it is.
    while (text.ends_with('0')) {
        text.pop_back();
    }
    return text;
}

std::string printed_limit(double limit, int decimals) {
    return gum::round_to_quantum(limit, std::max({own_decimals(limit), decimals, 0}));
}

std::string printed_at_least(double number, int decimals) {
    return printed_towards(number, decimals, 1.0);
}

std::string printed_at_most(double number, int decimals) {
    return printed_towards(number, decimals, -1.0);
}

std::string printed_capability(double capability) {
    if (is_of_a_scope(capability)) {
        return gum::round_to_quantum(capability, std::max(own_decimals(capability), 0));
    }
    const auto of_digits = [&](int digits) { return gum::round_to_uncertainty(0.0, capability, digits).U; };
    std::string text = of_digits(k_most_digits_of_a_scope);
    // Zeros at the end say nothing, but for those of two digits.
    for (int digits = k_most_digits_of_a_scope - 1; digits >= k_digits_of_raised_U; --digits) {
        const std::string shorter = of_digits(digits);
        if (number_of(shorter) == number_of(text)) {
            text = shorter;
        }
    }
    return text;
}

}  // namespace gumcert::certificate
