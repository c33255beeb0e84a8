#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gumcert::audit {

/// The numbers that a printed number may stand for.
struct Interval {
    double low = 0.0, high = 0.0;

    [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
    [[nodiscard]] bool meets(const Interval& other) const { return low <= other.high && other.low <= high; }
};

/// A number of somebody else's table: as it is printed, and what its digits leave open.
///
/// "0.29" may be the rounding of any number from 0.285 to 0.295. An audit that recomputes a table of rounded numbers
/// must not take the rounding for an error.
struct StatedNumber {
    double value = 0.0;
    double half_step = 0.0;  ///< half a unit of the last printed digit; 0: the number is exact
    std::string text;        ///< as it stands there, without its unit; in another unit after convert()
    std::string place;       ///< "row 3, u" or "Budget!D5"
    double scale = 1.0;      ///< what the number that stands there was multiplied by to be in the unit it is used in

    [[nodiscard]] Interval interval() const { return {value - half_step, value + half_step}; }
};

/// Half a unit of the last digit that a printed number is meant to have: half_step, and for a whole number the half unit of
/// its last digit that is not 0, of two digits at most: "120" stands for 115 to 125, "100" for 95 to 105. 0 for a number
/// without text, and for 0.
[[nodiscard]] double printed_half_step(const StatedNumber& number);

/// A number that is known to all of its digits.
[[nodiscard]] StatedNumber exact_number(double value, std::string place);

/// Brings a number to another unit: value, what its digits leave open, and, where the factor is a power of ten, its digits,
/// as many as they were. Else it has no text any more.
/// \param factor  finite, not 0
void convert(StatedNumber& number, double factor);

/// What a percent sign behind a number is.
enum class Percent {
    hundredth,  ///< "5 %" is 0.05
    unit,       ///< "5 %" is 5, and what follows it "%"
};

/// What the sign in a number like "1.200" is, whose only sign has three digits behind it: in "0.5", "1.20" and "1.500,2" the
/// sign speaks for itself.
enum class DecimalSign {
    each,   ///< nothing is known of the others: it is the decimal sign
    point,  ///< '.' is the decimal sign, and ',' sets thousands apart
    comma,  ///< the other way round
    open,   ///< nobody can know
};

/// Reads a printed number: decimal point or comma, groups of digits by space or apostrophe, "±0.5", "1.2E-3",
/// "1.2·10^-3", "1.2 × 10-3", "5 %" (0.05), "∞", "inf", "√3", "sqrt(6)", "2√3", U+2212 as minus sign.
///
/// Whole numbers are exact: as divisors, sensitivities and degrees of freedom they are meant so.
/// \return nothing where the text is no number, or one whose decimal sign nobody can know; text behind the number (a unit)
///         makes it none
[[nodiscard]] std::optional<StatedNumber> read_number(std::string_view text, std::string place,
                                                      DecimalSign sign = DecimalSign::each);

/// The decimal sign that the numbers of a text show, each beside what is around it: "U = 1.500,0 Pa"; `open` where they
/// contradict each other, `each` where they show none.
[[nodiscard]] DecimalSign decimal_sign_in(std::string_view text);

/// A number at the beginning of a text, and what follows it: "0.36 µm, k = 2" gives 0.36 and "µm, k = 2".
struct LeadingNumber {
    StatedNumber number;
    std::string rest;                       ///< without spaces at its ends
    DecimalSign shows = DecimalSign::each;  ///< the decimal sign, where this number alone shows which one it is
    bool is_open = false;                   ///< its value is not known, as nobody can know its decimal sign
};
[[nodiscard]] std::optional<LeadingNumber> read_leading_number(std::string_view text, std::string place,
                                                               Percent percent = Percent::hundredth,
                                                               DecimalSign sign = DecimalSign::each);

}  // namespace gumcert::audit
