#pragma once

#include <optional>
#include <string>

#include "certificate/profile.h"
#include "gum/rounding.h"

namespace gumcert::certificate {

// How numbers stand on a certificate (ILAC-P14:09/2020; JCGM 100:2008, 7.2.6). Every form of the document prints these
// texts. All rounding is done by gum/rounding.

/// How a profile wants uncertainties rounded.
struct PrintRule {
    int digits = 2;  ///< significant digits of U
    gum::RoundingMode rounding = gum::RoundingMode::half_even;
};
[[nodiscard]] PrintRule print_rule(const Profile& profile);

/// A value and its expanded uncertainty as a certificate states them, ending at the same decimal place.
struct StatedPair {
    std::string value, U;
    bool below = false;   ///< U as printed is smaller than the capability (only without raising)
    bool raised = false;  ///< `U` is the capability, because U as printed would be smaller
};

/// Rounds U, and then holds the capability against what is printed: the floor of ILAC-P14 is applied after rounding.
///
/// The capability is taken as the scope states it: U is below it if the printed number is, so 1450 printed as 1.4E+3 is
/// below 1.45E+3. If U itself is not below, it is rounded upwards. If it is, the capability is printed in its place, to
/// two significant digits and never less than it is (1.45E+3 gives 1.5E+3; 0.50 gives 0.50). What is_below_capability()
/// leaves out is no reason to raise it: 0.1 + 0.002·m is 0.30000006 at a mass of 100.00003 g, and printed 0.30.
/// \param value       finite
/// \param U           greater than 0, in the unit of the value; with a capability also 0
/// \param capability  in the same unit; differences in and after the 13th significant digit are noise of a conversion
/// \param raise       false: U is printed as it is, and `below` says that it is too small
/// \throws gum::InputError  GC-GUM-0001, -0003 or -0040
[[nodiscard]] StatedPair state_uncertainty(double value, double U, std::optional<double> capability,
                                           const PrintRule& rule, bool raise = true);

/// Whether a printed U is smaller than a capability. One of at most four significant digits is the number of the scope,
/// and held as it is. One with more digits was computed from measured values: less than a hundredth of a unit of its
/// second digit, to which scopes state capabilities, is the scatter of these values and leaves U equal to it.
[[nodiscard]] bool is_below_capability(const std::string& printed_U, double capability);

/// Whether the printed U stands for the capability in place of a smaller U, put there or reached by rounding alone.
[[nodiscard]] bool states_capability(double U, const std::string& printed_U, std::optional<double> capability);

/// k with two decimals.
[[nodiscard]] std::string printed_coverage_factor(double k);
/// The next lower whole number (JCGM 100:2008, G.4.1, note 1), where 3.999…9 is 4; ">9999" from 10 000 on, where the
/// digits say nothing.
[[nodiscard]] std::string whole_degrees_of_freedom(double nu_eff);
/// Degrees of freedom with one decimal below 100, so that k can be looked up for them: k is taken for ν_eff as it is,
/// and t(16.8) is not t(16). Else as whole_degrees_of_freedom; "∞" for none (infinite).
[[nodiscard]] std::string printed_degrees_of_freedom(std::optional<double> nu_eff);

/// A capability as the scope states it; rounded to four significant digits where it was computed and has more, without
/// zeros at its end but for those of two digits: 55.9017 gives "55.9", 0.30000006 gives "0.30".
[[nodiscard]] std::string printed_capability(double capability);

/// A probability in percent: two significant digits of it or of its complement, whichever is smaller. 0.02275 gives
/// "2.3", 0.97725 gives "97.7"; "<0.01" and ">99.99" where it rests on the tail of an assumed distribution.
[[nodiscard]] std::string printed_probability(double probability);

/// Decimal place at which a printed number ends: "1.23" 2, "50" 0, "1.2E+3" −2.
[[nodiscard]] int decimals_of(const std::string& printed);
/// The number that a text of gum/rounding stands for; nothing for another text.
[[nodiscard]] std::optional<double> number_of(const std::string& printed);
/// Significant digits of a text of gum/rounding: "0.10" has 2.
[[nodiscard]] int significant_digits(const std::string& printed);
/// Shortest text of a limit as it was stated, noise of a unit conversion left out, and not fewer decimals than asked.
/// A coverage probability in percent, without the sign: four digits, and as many more as two digits of 1 − p need, so that
/// none is printed as 100: 0.9545 gives "95.45", 0.99 "99.00", 0.99999 "99.999".
[[nodiscard]] std::string printed_coverage_probability(double p);

[[nodiscard]] std::string printed_limit(double limit, int decimals);

/// Acceptance limits, guard bands and ratios, to a decimal place and always to the safe side: a value that ends at this
/// place or before lies inside of the printed limit where it lies inside of the limit itself. Noise of a computation (a
/// millionth of the place) is left out.
[[nodiscard]] std::string printed_at_least(double number, int decimals);
[[nodiscard]] std::string printed_at_most(double number, int decimals);

}  // namespace gumcert::certificate
