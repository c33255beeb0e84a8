#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "gum/quantity/unit.h"

#include "reports/record/shown.h"

namespace gumcert::reports {

// Texts of the numbers of a comparison. Every one is rounded here, once, by gum/rounding.

/// A value to the decimal place of two significant digits of U; all its digits where there is no U, or U is 0.
[[nodiscard]] std::string printed_value(double value, const std::optional<double>& U);
/// The same of value + rest, where the rest is what the nearest double leaves of a value: 473 612 353 604 000.0225 ± 0.13 is
/// printed as …000.02, though doubles of that size are 1/16 apart.
[[nodiscard]] std::string printed_value(double value, double rest, const std::optional<double>& U);
/// A difference that may have no U: then to two significant digits of `scale`, a standard deviation or another U; to
/// four significant digits without one.
[[nodiscard]] std::string printed_difference(double difference, const std::optional<double>& U,
                                             const std::optional<double>& scale);
/// Two significant digits at the decimal place that printed_value() gives a value with it; "" for nothing.
[[nodiscard]] std::string printed_uncertainty(const std::optional<double>& u);
/// A number that the job states: all its digits; "" for nothing.
[[nodiscard]] std::string printed_as_stated(const std::optional<double>& number);
/// Two decimals, as of a score or a coverage factor; "" for nothing.
[[nodiscard]] std::string printed_score(const std::optional<double>& score);
/// |E_n|, ζ, z or z', and P_A in %: two decimals, and as many more as it takes for the printed number to call for the
/// same signal as the number does (gum::signal_of_en(), gum::signal_of_z(), above 100 %). A score of 1.0004 beside an
/// action is not printed as 1.00. "" for nothing.
[[nodiscard]] std::string printed_en(const std::optional<double>& en);
/// E_n for the worst plausible correlation: "∞" without a number where no finite number bounds it.
[[nodiscard]] reports::Shown<std::optional<double>> shown_worst_en(const std::optional<double>& en);
[[nodiscard]] std::string printed_z(const std::optional<double>& score);
[[nodiscard]] std::string printed_share_of_allowed(const std::optional<double>& percent);
/// Two significant digits, not less than 0.0001 in plain decimals, "<1E-300" below that; "" for nothing. As many more as it
/// takes to see on which side of the limits of the comparison it is, 0.05, 0.025 and 0.01: 0.0498 and not 0.050.
[[nodiscard]] std::string printed_probability(const std::optional<double>& probability);
/// The same beside the limit of a test, too.
[[nodiscard]] std::string printed_probability_beside(double probability, double limit);

/// The limit that a p is held against where so many directions are judged side by side, gum::chance_in_family(): three digits.
[[nodiscard]] std::string printed_limit_in_family(double chance, std::size_t family);
/// printed_probability() of one of several directions: on its side of that limit, as it is and as it is printed, and not of
/// those of a single set of points.
[[nodiscard]] std::string printed_probability_in_family(const std::optional<double>& probability, double chance,
                                                        std::size_t family);

/// A number with the text that one of these functions makes of it.
template <class Number>
[[nodiscard]] reports::Shown<Number> shown(const Number& number,
                                           std::string (*printed)(const std::optional<double>& number)) {
    return {number, printed(number)};
}

/// What is said of angles that lie a full turn apart.
inline constexpr const char* k_turn_apart = "GC-COMPARE-0131";
inline constexpr const char* k_turn_rule =
    "angles are compared as numbers, and a direction is the same one after each full turn";
inline constexpr const char* k_turn_action =
    "Where these are directions, state them within half a turn of each other: -0.0001 for 359.9999 in degrees. Where "
    "turns are counted, look for one that is missing.";
/// Whether two angles in a unit are nine tenths of a turn apart, or more.
[[nodiscard]] bool is_turn_apart(double first, double second, const gum::Unit& unit);

}  // namespace gumcert::reports
