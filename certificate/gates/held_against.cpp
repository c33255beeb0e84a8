#include "certificate/gates/held_against.h"

#include <algorithm>
#include <cmath>

#include "gum/argument_check.h"
#include "text/numbers.h"

namespace gumcert::certificate {

using gum::Unit;

bool of_one_kind(const Unit& a, const Unit& b) {
    return a.dimension() == b.dimension() && a.is_celsius_temperature() == b.is_celsius_temperature();
}

double value_for_scope(const CertifiedValue& value, const Unit& column, const Unit& unit) {
    const double in_unit = unit.from_si(column.to_si(value.value));
    return unit.is_celsius_temperature() ? in_unit : std::abs(in_unit);
}

bool is_nominal_of(double claimed, double value) {
    constexpr double k_same = 0.1;
    return std::abs(value - claimed) <= k_same * std::max(std::abs(value), std::abs(claimed));
}

bool is_beyond(double value, double low, double high) {
    constexpr double k_a_little = 0.01;
    const double little = k_a_little * (high - low);
    return value > high + little || value < low - little;
}

bool capability_taken_elsewhere(FindingList& found, const ScopeEntry& entry, std::size_t i,
                                const CapabilityArgument& argument, const HeldAgainst& held,
                                const CertifiedColumn& column, const CertifiedValue& value) {
    const Unit unit = Unit::parse(argument.unit);
    const Unit result = Unit::parse(column.unit);
    const Unit stated = Unit::parse(held.unit);
    if (!of_one_kind(result, unit) || !of_one_kind(stated, unit)) {
        return false;
    }
    const double measured = value_for_scope(value, result, unit);
    const double claimed = unit.from_si(stated.to_si(held.value));
    if (is_nominal_of(claimed, measured)) {
        return false;
    }
    const bool larger = std::abs(measured) > std::abs(claimed);
    found.add(larger ? FindingSeverity::critical : FindingSeverity::minor, "X12", "ILAC-P14:09/2020",
              place_in("/accreditation/scope", i, "capability"),
              "the capability of \"" + entry.id + "\" is taken at \"" + held.name +
                  "\" = " + text::shortest(held.value) + " " + held.unit + ", and the result \"" + column.result +
                  "\" is " + value.printed_value + " " + column.unit,
              "Take it at the result (\"of\": \"value\"), or state the true parameter.");
    return true;
}

}  // namespace gumcert::certificate
