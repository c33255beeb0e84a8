#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "certificate/capability.h"
#include "certificate/certified_results.h"
#include "certificate/gates/finding_list.h"
#include "gum/quantity/unit.h"

namespace gumcert::certificate {

// A scope may hold its ranges and take its capabilities against a number that is not the result itself: a nominal
// value, an input of the budget. That number has to be the one of what was measured: the result, or, of an error, a
// deviation or a correction, the value at which it was measured.

/// A number that the author of a certificate or of a budget states.
struct HeldAgainst {
    std::string name;
    double value = 0.0;
    std::string unit;
};

/// Whether a range holds numbers with their signs: temperatures in degrees Celsius, and what begins below 0, such as levels
/// from -70 dB.
/// \param low  lower end of the range, in its unit
[[nodiscard]] bool has_sign(const gum::Unit& unit, double low);

/// A number in the unit of a scope: its magnitude, or the number itself where the range has signs.
[[nodiscard]] double value_for_scope(double value, const gum::Unit& of, const gum::Unit& unit, double low);

/// What was measured where a result stands.
struct Measured : HeldAgainst {
    std::string in_words;   ///< "the result "l" is 50000838 nm", "the result "E" was measured at "V_s" = 10.0 mV"
    bool is_place = false;  ///< where an error was measured, and not the result itself
};
/// The result itself. Of one whose column is an error, a deviation or a correction by its role, what its row has of the
/// kind of a scope: the nominal value, else the setting, the reference, the indication or the measured value, in this
/// order, before and after an adjustment each its own.
/// \param unit  of the scope
[[nodiscard]] Measured measured_at(const CertifiedTable& table, const CertifiedColumn& column, std::size_t row,
                                   const gum::Unit& unit);

/// Whether a number can be the nominal value of what was measured: within a tenth.
[[nodiscard]] bool is_nominal_of(double claimed, double value);

/// The same of one that a range holds: within a hundredth of the range as well, for nominal values near 0.
[[nodiscard]] bool is_nominal_in(double claimed, double value, double low, double high);

/// Whether what was measured lies beyond a range that its nominal value keeps. What is measured may lie a little beyond its
/// nominal value at the end of a range: a hundredth of the range.
[[nodiscard]] bool is_beyond(double value, double low, double high);

/// What to do where a range is held against a number beyond which was measured. A result whose place was found has its role
/// and its point.
[[nodiscard]] std::string action_of_range(const Measured& measured);

/// Tells of a capability that is taken at another number than what was measured (X12): critical where that is the larger
/// one, unless the capability is the same there.
/// \param i  index of the entry in the scope
[[nodiscard]] std::optional<Finding> capability_taken_elsewhere(const ScopeEntry& entry, std::size_t i,
                                                                const CapabilityArgument& argument,
                                                                const HeldAgainst& held, const Measured& measured);

}  // namespace gumcert::certificate
