#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gum/expression/syntax_tree.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::gum {

/// What the unit check knows of a quantity or a sub-expression.
struct QuantityKind {
    Dimension dimension;
    /// How many Celsius temperatures a temperature is the sum of: 1 is a Celsius temperature, 0 a difference or a
    /// thermodynamic temperature, others are steps on the way, e.g. t1 + t2 in (t1 + t2)/2.
    double celsius = 0.0;
    bool fahrenheit = false;         ///< with the zero of degF, where `celsius` is not 0
    bool known = true;               ///< false after a problem that was already reported
    bool zero = false;               ///< the literal 0, which is 0 in every unit
    std::optional<double> constant;  ///< its value, when it is a constant; coherent SI
    std::string unit;                ///< as the user wrote it; empty for sub-expressions

    [[nodiscard]] static QuantityKind unknown();
    [[nodiscard]] static QuantityKind of(const Unit& unit, std::optional<double> constant = {});
    /// The unit for messages: "mm", "degC", "kg m s-2", "1".
    [[nodiscard]] std::string unit_text() const;
};

/// The kind of every node of an equation; every breach is added to `problems`.
/// \param quantities  kind of each of tree.names
[[nodiscard]] std::vector<QuantityKind> check_units(const SyntaxTree& tree,
                                                    std::span<const QuantityKind* const> quantities,
                                                    std::vector<Diagnostic>& problems);

/// "0 = …" of temperatures must be a difference.
void check_balance(const SyntaxTree& tree, const QuantityKind& kind, std::vector<Diagnostic>& problems);

/// The unit of an output, from what its equation gives and what was declared.
[[nodiscard]] Unit output_unit(const std::string& name, const QuantityKind& kind, const std::optional<Unit>& declared,
                               const std::string& where, std::vector<Diagnostic>& problems);

/// The unit of an output for which none was declared: that of the first input of the same kind, so that a difference of
/// readings in mV is in mV; else the SI unit with a name of its own ("ohm" for V/mA); else `coherent`. A number stays a
/// number, whatever percentages are among its inputs.
/// \param used  units of the inputs, in the order in which they stand in the equation
[[nodiscard]] Unit preferred_unit(const Unit& coherent, std::span<const Unit* const> used);

}  // namespace gumcert::gum
