#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "certificate/localised_text.h"

namespace gumcert::certificate {

// Calibration and measurement capability (CMC) in the forms of ILAC-P14:09/2020, section 4. All numbers are in the
// units that the scope states: a scope is a document, and its digits are compared as printed.

/// What a capability depends on, e.g. a length or an angle.
struct CapabilityArgument {
    std::string name = {};  ///< in expressions and messages: "L"
    std::string unit = {};  ///< UDUNITS-2
    /// Where its value comes from: "value" (magnitude of the result itself), "argument" (angle of a rotary table), or
    /// the name of an input quantity of a budget, or of an entry of CertificateData::parameters
    std::string of = "value";
};

/// A finite value of the argument and the capability there.
struct CapabilityPoint {
    double at = 0.0;
    double U = 0.0;
};

struct Capability {
    /// "value": one U over the whole range, or with a share of the one argument ("2 µV + 10 ppm of the value"). "range": two ends, linear between them. "function": an expression of the
    /// arguments, where Q[a, b*L] means sqrt(a^2 + (b*L)^2). "table": points of one argument; the digitised curve of a
    /// graph is one. "matrix": a table of two.
    std::string form = {};
    std::string unit = {};                                           ///< of U, UDUNITS-2
    double U = 0.0;                                                  ///< form "value"; may be 0 beside a share
    std::optional<double> percent_of_value = {}, ppm_of_value = {};  ///< form "value": added to U; one of the two
    /// None for "value", one where it has a share; one for "range", "table"; two for "matrix"
    std::vector<CapabilityArgument> arguments = {};
    /// form "function", written as scopes are: "0.5 + 0.7*L" with U in um and L in m. Arguments and U are plain numbers
    /// there, in the units that they state; a number in the text carries its unit silently, so none can be checked. An
    /// angle in a function is L*rad: sin(L*rad)
    std::string expression = {};
    std::vector<CapabilityPoint> points = {};      ///< "range" (two), "table" (two or more, rising)
    std::vector<double> rows = {}, columns = {};   ///< "matrix": values of the first and of the second argument, rising
    std::vector<std::vector<double>> matrix = {};  ///< rows × columns
    /// "table", "matrix": "linear" (bilinear) or "next_worse", the largest U of the neighbours; must be stated. A value
    /// on a point has the U of this point. "range" is linear, with or without saying so
    std::string lookup = {};
    double coverage_probability = 0.95;  ///< of the capability
};

/// Value of an argument of a capability, in the unit that the capability states for it.
struct ArgumentValue {
    std::string name;
    double value = 0.0;
};

/// What the scope says for one result.
struct CapabilityAt {
    std::optional<double> U = {};  ///< in Capability::unit, greater than 0; none: `reason` says why, in English
    std::string reason = {};
};

/// A capability ready for many results: its expression is compiled once. Copies share it, and so may threads.
class CapabilityEvaluator {
public:
    /// \throws gum::InputError  GC-CERT-0201 for every problem that `check_capability` finds: ambiguous or open
    explicit CapabilityEvaluator(const Capability& capability);

    /// Never extrapolates. An argument that differs from an end of the range by rounding alone is on it.
    /// \param arguments  one value for each argument of the capability; others are not looked at
    /// \throws gum::InputError  GC-CERT-0202 for an argument without a value, or with one that is not finite
    [[nodiscard]] CapabilityAt at(const std::vector<ArgumentValue>& arguments) const;

private:
    struct Prepared;
    std::shared_ptr<const Prepared> prepared_;
};

/// The same for one result.
/// \throws gum::InputError  as the class
/// Example: examples/api/records.cpp
[[nodiscard]] CapabilityAt capability_at(const Capability& capability, const std::vector<ArgumentValue>& arguments);

/// Why a capability cannot be used: an open interval, no rule between the points, an expression that does not compile,
/// U not greater than 0, points that do not rise, statements that belong to another form. Empty: it can.
struct CapabilityProblem {
    std::string key;  ///< pointer relative to the capability, "/expression"
    std::string what, rule, action;
};
[[nodiscard]] std::vector<CapabilityProblem> check_capability(const Capability& capability);

/// An expression of a scope as the equation language has it: each Q[a, b, …] is sqrt((a)^2+(b)^2+…). Brackets may stand
/// in each other.
/// \param problem  set to a phrase where the brackets do not fit; the result is "" then
[[nodiscard]] std::string expanded_capability_expression(const std::string& expression, std::string& problem);

}  // namespace gumcert::certificate
