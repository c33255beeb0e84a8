#pragma once

#include <optional>
#include <string_view>

namespace gumcert::reports {

/// A number as it is printed in a certificate, and half a unit of its last digit: what rounding may have taken away.
struct PrintedNumber {
    double value = 0.0, half_unit = 0.0;
};

/// Nothing for a text that is no finite number.
[[nodiscard]] std::optional<PrintedNumber> printed_number(std::string_view text);

}  // namespace gumcert::reports
