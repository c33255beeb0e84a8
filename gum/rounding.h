#pragma once

#include <string>
#include <vector>

namespace gumcert::gum {

// The one place that rounds numbers for documents.
//
// All rounding is decimal. A double is first written with its shortest digits that read back as the same double, the
// number that a person would see and check by hand; those digits are then rounded as a person would. So 2.675 to two
// decimals is a tie and gives 2.68 (half-even), although the nearest double lies a little below 2.675. A tie goes to
// the even digit: 1.25 gives 1.2, 1.35 gives 1.4. Digits from the 15th on are the rounding of a computation and do not
// break a tie: 3139.674 + 223.676, which double precision makes 3363.3499999999995, gives 3363.4.
//
// Text: '.' as the decimal sign, ASCII '-', no group separators, never a negative zero. Where the last rounded digit
// stands above the unit digit, a power of ten keeps zeros out that are not significant: 1.23E+3, 1.0E+2, 0E+2. Where it
// stands behind the 18th decimal, a power of ten keeps the zeros out that nobody counts: 2.01E-25.

enum class RoundingMode {
    half_even,  ///< to the nearest, ties to the even digit
    up  ///< an uncertainty is never printed smaller than it is (JCGM 100:2008, 7.2.6); the value stays half-even
};

/// A value and its expanded (or standard) uncertainty, ending at the same decimal place.
struct RoundedPair {
    std::string value;
    std::string U;

    friend bool operator==(const RoundedPair&, const RoundedPair&) = default;
};

/// Rounds U to `digits` significant digits and the value to the same decimal place (JCGM 100:2008, 7.2.6).
///
/// The number of digits holds after a carry: 0.0996 gives 0.10, 99.6 gives 1.0E+2.
/// \param value   finite
/// \param U       greater than 0, in the unit of the value; a quantity without uncertainty is not printed by this
/// \param digits  1 to 15 significant digits of U
/// \param mode    for U only; `up` ignores an excess in or after the 13th significant digit, which is noise of the
///                computation: 0.12000000000000001 stays 0.12
/// \throws InputError  GC-GUM-0001, -0003 or -0040
/// Accuracy: half a unit of the last digit, ties to the even one (docs/accuracy.md#rounding-and-printing).
/// Example: examples/api/budget_by_hand.cpp
[[nodiscard]] RoundedPair round_to_uncertainty(double value, double U, int digits = 2,
                                               RoundingMode mode = RoundingMode::half_even);

/// Rounds half-even to a number of decimals: (0.12345, 2) gives "0.12", (1234.5, -1) gives "1.23E+3".
/// \param decimals  −300 to 400
/// \throws InputError  GC-GUM-0001 or -0041
[[nodiscard]] std::string round_to_quantum(double value, int decimals);

/// A number that somebody wrote, with the decimals with which it was written (text::most_decimals): (2e-12, 13) gives
/// "0.0000000000020". From 1e15 on with a power of ten and the digits that it has: 1.5E+20. Reads back as what was written,
/// where that had 15 significant digits at most.
/// \param decimals  0 to 400
/// \throws InputError  GC-GUM-0001 or -0041
[[nodiscard]] std::string round_as_written(double value, int decimals);

/// The decimal number that a computed one stands for. A difference of decimal numbers is a decimal number, and in binary
/// it carries what the rounding of its terms leaves: 4.00295 − 4.00000 gives 0.0029500000000002302. Such a number is on the
/// wrong side of every tie and every limit in half of the cases. Where exactly one decimal number whose last place is far
/// above that rounding lies within it, it is the number that was meant; else `value` comes back as it is.
/// \param lost  how far `value` may be off by rounding, in its unit; 0 or not finite: nothing is settled
[[nodiscard]] double settled_decimal(double value, double lost);

/// Rounds half-even to significant digits, for numbers that stand alone: u, χ², condition number, p-value.
///
/// Plain decimal from 1e-4 up to below 1e6 while the last digit stands at or below the unit digit, else a power of ten:
/// 0.000123, 12.3, 1.2E+3 (two digits), 1.23E-5. Zero gives "0".
/// \param digits  1 to 15
/// \throws InputError  GC-GUM-0001 or -0040
[[nodiscard]] std::string round_significant(double value, int digits);

/// round_significant() of a number that is held against limits, with as many more digits as it takes for what is printed to be
/// below, at or above each of them as the number is: 0.0498 beside a limit of 0.05 gives "0.0498", not "0.050".
/// \param limits  finite; one that differs from the number by the rounding of a computation asks for nothing
/// \throws InputError  GC-GUM-0001 or -0040
[[nodiscard]] std::string round_significant_beside(double value, int digits, const std::vector<double>& limits);

/// Texts of a number and of the limits that it is held against, each with as many more digits than `digits` as it takes for the
/// first text to be below, at or above each of the others as the number is: χ² = 5.9917 exceeds 5.9915.
/// \param numbers  the number, and behind it the limits; finite
/// \param rounded  a function that rounds one of them to significant digits, or to decimals
/// \throws InputError  what `rounded` throws
[[nodiscard]] std::vector<std::string> round_in_order(const std::vector<double>& numbers, int digits,
                                                      std::string (*rounded)(double number, int digits));

/// A share of a variance in percent with one decimal, half-even, without the sign: 0.1234 gives "12.3".
/// \throws InputError  GC-GUM-0001
[[nodiscard]] std::string percent(double share);

}  // namespace gumcert::gum
