#include "reports/record/make/comparison/comparison_print.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "gum/comparison/agreement.h"
#include "gum/comparison/scores.h"
#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

constexpr int k_digits_without_u = 4;
constexpr int k_decimals_of_score = 2;
// Tails below what double precision holds come out as 0, which no probability of a test is.
constexpr double k_least_probability = 1e-300;
constexpr const char* k_below_least = "<1E-300";
constexpr int k_digits_of_limit = 3;
// Of consistency, of p_low and p_high, of a bias and a pattern.
constexpr std::array k_limits_of_probabilities = {0.05, 0.025, 0.01};

enum class SideOf { en, z, allowed };

/// What a score calls for.
gum::Signal signal_of(double score, SideOf kind) {
    constexpr double k_all_that_is_allowed = 100.0;  // %
    switch (kind) {
        case SideOf::en:
            return gum::signal_of_en(score);
        case SideOf::z:
            return gum::signal_of_z(score);
        case SideOf::allowed:
            break;
    }
    return std::abs(score) > k_all_that_is_allowed ? gum::Signal::action : gum::Signal::none;
}

/// A printed number, as a reader takes it.
double read(const std::string& printed) {
    double number = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(printed.data(), printed.data() + printed.size(), number);
    return number;
}

std::string printed_on_its_side(const std::optional<double>& score, SideOf kind) {
    constexpr int k_most_decimals = 17;
    if (!score) {
        return "";
    }
    const gum::Signal signal = signal_of(*score, kind);
    for (int decimals = k_decimals_of_score; decimals <= k_most_decimals; ++decimals) {
        std::string text = gum::round_to_quantum(*score, decimals);
        if (signal_of(read(text), kind) == signal) {
            return text;
        }
    }
    return text::shortest(*score);
}

}  // namespace

std::string printed_en(const std::optional<double>& en) {
    return printed_on_its_side(en, SideOf::en);
}

reports::Shown<std::optional<double>> shown_worst_en(const std::optional<double>& en) {
    if (en && std::isinf(*en)) {
        return {std::nullopt, *en < 0.0 ? "-∞" : "∞"};
    }
    return shown(en, printed_en);
}

std::string printed_z(const std::optional<double>& score) {
    return printed_on_its_side(score, SideOf::z);
}

std::string printed_share_of_allowed(const std::optional<double>& percent) {
    return printed_on_its_side(percent, SideOf::allowed);
}

std::string printed_value(double value, const std::optional<double>& U) {
    return U && *U > 0.0 ? gum::round_to_uncertainty(value, *U, reports::k_digits_of_u).value : text::shortest(value);
}

std::string printed_value(double value, double rest, const std::optional<double>& U) {
    constexpr double k_part_that_shows = 0.005;  // of the last printed digit
    constexpr double k_all_integers = 0x1p53;
    std::string text = printed_value(std::abs(value), U);
    const std::size_t point = text.find('.');
    const std::size_t decimals = point == std::string::npos ? 0 : text.size() - point - 1;
    const double scale = std::pow(10.0, static_cast<double>(decimals));
    if (!U || text.find('E') != std::string::npos || std::abs(rest) * scale < k_part_that_shows ||
        !(std::abs(value) < k_all_integers)) {
        return printed_value(value, U);
    }
    // Integer and fraction apart: neither of them rounds, and neither does their sum.
    double whole = std::floor(std::abs(value));
    double fraction = std::nearbyint(((std::abs(value) - whole) + (value < 0.0 ? -rest : rest)) * scale);
    const double carry = std::floor(fraction / scale);
    whole += carry;
    fraction -= carry * scale;
    std::string digits = gum::round_to_quantum(fraction, 0);
    digits.insert(0, decimals > digits.size() ? decimals - digits.size() : 0, '0');
    return (value < 0.0 ? "-" : "") + gum::round_to_quantum(whole, 0) + (decimals > 0 ? "." + digits : "");
}

std::string printed_difference(double difference, const std::optional<double>& U, const std::optional<double>& scale) {
    if (U && *U > 0.0) {
        return printed_value(difference, U);
    }
    return scale && *scale > 0.0 ? printed_value(difference, scale)
                                 : gum::round_significant(difference, k_digits_without_u);
}

std::string printed_uncertainty(const std::optional<double>& u) {
    if (!u) {
        return "";
    }
    // As beside its value: 0.000000001000 with 0.000000000044, not with 4.4E-11.
    return *u > 0.0 ? gum::round_to_uncertainty(0.0, *u, reports::k_digits_of_u).U : "0";
}

std::string printed_as_stated(const std::optional<double>& number) {
    return number ? text::shortest(*number) : "";
}

std::string printed_score(const std::optional<double>& score) {
    return score ? gum::round_to_quantum(*score, k_decimals_of_score) : "";
}

std::string printed_probability(const std::optional<double>& probability) {
    return probability ? printed_probability_beside(*probability, k_limits_of_probabilities.front()) : "";
}

std::string printed_probability_beside(double probability, double limit) {
    std::vector<double> limits(k_limits_of_probabilities.begin(), k_limits_of_probabilities.end());
    limits.push_back(limit);
    return probability < k_least_probability
               ? k_below_least
               : gum::round_significant_beside(probability, reports::k_digits_of_u, limits);
}

std::string printed_limit_in_family(double chance, std::size_t family) {
    return gum::round_significant(gum::chance_in_family(chance, family), k_digits_of_limit);
}

std::string printed_probability_in_family(const std::optional<double>& probability, double chance, std::size_t family) {
    if (!probability || family <= 1 || *probability < k_least_probability) {
        return printed_probability(probability);
    }
    return gum::round_significant_beside(
        *probability, reports::k_digits_of_u,
        {gum::chance_in_family(chance, family), read(printed_limit_in_family(chance, family))});
}

bool is_turn_apart(double first, double second, const gum::Unit& unit) {
    constexpr double k_most = 0.9 * 2.0 * std::numbers::pi;
    return unit.dimension() == gum::Dimension::angle() && std::abs(unit.difference_to_si(second - first)) >= k_most;
}

}  // namespace gumcert::reports
