#pragma once

#include <string>

#include "gum/quantity/unit.h"
#include "text/rounded_number.h"

namespace gumcert::jobs {

/// Numbers of one unit in another one, and as they are where the two are one text.
class UnitChange {
public:
    UnitChange(const std::string& from, const std::string& to)
        : is_same_(from == to), from_(gum::Unit::parse(from)), to_(gum::Unit::parse(to)) {}

    [[nodiscard]] bool is_possible() const {
        return from_.dimension() == to_.dimension() && from_.is_celsius_temperature() == to_.is_celsius_temperature();
    }
    [[nodiscard]] double value(double v) const { return is_same_ ? v : in_decimals(to_.from_si(from_.to_si(v))); }
    [[nodiscard]] double difference(double v) const {
        return is_same_ ? v : in_decimals(to_.difference_from_si(from_.difference_to_si(v)));
    }

private:
    /// Without what two conversions leave behind the last digit of a decimal number.
    static double in_decimals(double v) { return text::rounded_number(v, text::k_digits_held); }

    bool is_same_;
    gum::Unit from_, to_;
};

}  // namespace gumcert::jobs
