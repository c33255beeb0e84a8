#pragma once

#include <cstddef>
#include <string>

#include "certificate/capability.h"
#include "certificate/certified_results.h"
#include "certificate/gates/finding_list.h"
#include "gum/quantity/unit.h"

namespace gumcert::certificate {

// A scope may hold its ranges and take its capabilities against a number that is not the result itself: a nominal
// value, an input of the budget. That number has to be the one of what was measured.

/// A number that the author of a certificate or of a budget states.
struct HeldAgainst {
    std::string name;
    double value = 0.0;
    std::string unit;
};

/// Same dimension, and both or neither a Celsius temperature.
[[nodiscard]] bool of_one_kind(const gum::Unit& a, const gum::Unit& b);

/// A result in the unit of a scope: its magnitude, or the temperature itself in degrees Celsius.
[[nodiscard]] double value_for_scope(const CertifiedValue& value, const gum::Unit& column, const gum::Unit& unit);

/// Whether a number can be the nominal value of what was measured: within a tenth.
[[nodiscard]] bool is_nominal_of(double claimed, double value);

/// Whether a result lies beyond a range that its nominal value keeps. What is measured may lie a little beyond its
/// nominal value at the end of a range: a hundredth of the range.
[[nodiscard]] bool is_beyond(double value, double low, double high);

/// Tells of a capability that is taken at another number than the result (X12): critical where the result is the larger
/// one.
/// \return whether it reported something
bool capability_taken_elsewhere(FindingList& found, const ScopeEntry& entry, std::size_t i,
                                const CapabilityArgument& argument, const HeldAgainst& held,
                                const CertifiedColumn& column, const CertifiedValue& value);

}  // namespace gumcert::certificate
