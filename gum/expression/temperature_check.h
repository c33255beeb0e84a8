#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "gum/expression/syntax_tree.h"
#include "gum/expression/unit_check.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

/// In which powers a sub-expression holds Celsius temperatures t (their values, not differences of two).
///
/// A number in °C is a difference from 0 °C. A polynomial 1 + A t + B t² is written for that difference and is right
/// with t in °C (Callendar-Van Dusen, density of water, …); so is b/(c + t) with a constant shift c of the scale
/// (Magnus). What is proportional to t alone, or to t⁴, what is divided by t, and √t, is nearly always meant for the
/// thermodynamic temperature: p M/(R t), σ t⁴; also in a sum with others, n R t/p − b. Both have the same units, so the
/// unit check cannot tell; the shape can.
struct TemperatureContent {
    /// Bit n: a term with tⁿ; bit 0: a term without.
    std::uint32_t powers = 1;
    bool shifted = false;     ///< plus a constant of some 273.15 K: the zero of the scale was moved on purpose
    std::string where;        ///< of the product
    std::string product;      ///< "Rg*t"
    std::string temperature;  ///< "t"
    std::string zero;         ///< a free name for an input of 0 °C, in the cures
    bool fahrenheit = false;  ///< the temperature is stated in °F
    /// The product has the shape of a law of physics: another quantity per kelvin that is no plain 1/K, as a gas
    /// constant or a heat capacity, and one more with a unit.
    bool law = false;
    std::set<std::string> factors;  ///< names in the product

    /// The highest power that stands without lower ones beside it, which would make it a polynomial; 0: none.
    [[nodiscard]] int lone_power() const;
};

/// The content of an equation, from those of its names (read where a name has its own equation).
///
/// Adds GC-MODEL-0040 to `warnings` for a quotient by, a root, a logarithm or a power of something proportional to a
/// Celsius temperature, and GC-MODEL-0041 for a law in a larger sum, with the two cures.
/// \param kinds     of every node, from check_units()
/// \param contents  of each of tree.names; null for inputs and unknowns
[[nodiscard]] TemperatureContent check_temperatures(const SyntaxTree& tree, std::span<const QuantityKind> kinds,
                                                    std::span<const TemperatureContent* const> contents,
                                                    std::vector<Diagnostic>& warnings);

/// GC-MODEL-0041 where a result is proportional to a power of a Celsius temperature.
void check_result(const TemperatureContent& content, const QuantityKind& kind, std::vector<Diagnostic>& warnings);

/// Where no unit is declared for a result with the dimension of temperature that Celsius temperatures enter with a
/// weight that is not known, e.g. w*t + (1 - w)*t2: "K" would be a guess. Adds GC-MODEL-0036.
void check_default_unit(const std::string& name, const TemperatureContent& content, const QuantityKind& kind,
                        const std::string& where, std::vector<Diagnostic>& problems);

}  // namespace gumcert::gum
