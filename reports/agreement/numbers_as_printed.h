#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// A decimal number as a document prints it: "−4,90", "1.40 × 10⁻³", or as a record does: "-4.90", "1.40E-3".
struct NumberAsPrinted {
    std::string digits;        ///< of its mantissa, without the decimal sign
    std::size_t decimals = 0;  ///< digits behind the decimal sign
    int exponent = 0;          ///< of ten
    bool negative = false;
    std::size_t first_digit = 0;  ///< among all ASCII digits of the text

    /// Whether both are the same number with the same digits.
    [[nodiscard]] bool is(const NumberAsPrinted& other) const {
        return digits == other.digits && decimals == other.decimals && exponent == other.exponent &&
               negative == other.negative;
    }
};

/// Whether a number of this sign begins with a digit of a document, and no longer one.
/// \param begin  of the digit
[[nodiscard]] bool begins_a_number(std::string_view text, std::size_t begin, bool negative);

/// Whether a document prints a number where a digit of it stands, as it is: neither as a part of a longer one, nor with
/// another sign, decimal sign or exponent. A number may be drawn in pieces (k_end_of_drawn_text): where two of them
/// meet, it is not known whether a number ends.
/// \param begin  of its first digit
[[nodiscard]] bool is_printed_at(std::string_view text, std::size_t begin, const NumberAsPrinted& number);

/// All numbers of a text in their order. Both decimal signs, and both minus signs: U+2212, and a hyphen that stands right
/// before the number and behind no letter or digit. What has several decimal signs ("17.2.1") is no number.
[[nodiscard]] std::vector<NumberAsPrinted> numbers_as_printed(std::string_view text);

/// The number of a text that has one; none where there is none or several.
[[nodiscard]] std::optional<NumberAsPrinted> only_number_as_printed(std::string_view text);

}  // namespace gumcert::reports
