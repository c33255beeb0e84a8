#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "gum/quantity/unit.h"

namespace gumcert::gum {

/// A unit of the program's own table: everything that is known of a name.
///
/// Its size is mantissa · 10^exp10 / divisor · π^pi coherent SI units, exactly: no factor is a rounded one. Units whose
/// size is itself measured (dalton) or differs from country to country (gallon, ton, calorie, year) are not in the
/// table; of the latter the names that say which one is meant are.
struct UnitDefinition {
    std::string_view symbols;  ///< separated by spaces; take prefixes such as "k" where `multiples`
    std::string_view names;    ///< separated by spaces; take prefixes such as "kilo" where `multiples`
    std::string_view people;   ///< in print; "" = as it was written
    std::string_view d_si;     ///< in D-SI; "" = D-SI has none
    bool multiples = false;
    std::array<std::int8_t, Dimension::k_base_units> exponents{};  ///< m, kg, s, A, K, mol, cd, rad, dB
    std::int64_t mantissa = 1;
    int exp10 = 0;
    std::int64_t divisor = 1;
    int pi = 0;
    enum class Scale { from_zero, celsius, fahrenheit } scale = Scale::from_zero;
};

struct PrefixDefinition {
    std::string_view symbols;  ///< separated by spaces
    std::string_view name;     ///< also the one of D-SI
    std::string_view people;
    int exp10 = 0;
};

/// A name that is refused because it means different units to different people.
struct AmbiguousUnit {
    std::string_view name;
    std::string_view meanings;  ///< "knot (kn…)", and what to write
};

/// SI base and derived units, prefixes and accepted units: SI Brochure, 9th edition (2019), tables 2, 4, 7 and 8. The
/// others follow from exact definitions: the international inch and pound (1959), 9.80665 m/s² and 101 325 Pa.
[[nodiscard]] std::span<const UnitDefinition> unit_definitions();
[[nodiscard]] std::span<const PrefixDefinition> prefix_definitions();
[[nodiscard]] std::span<const AmbiguousUnit> ambiguous_units();

/// What a name stands for: a unit with or without a prefix.
struct NamedUnit {
    const UnitDefinition* unit = nullptr;      ///< none: the name is not known
    const PrefixDefinition* prefix = nullptr;  ///< none: the unit itself
};
/// A name as it stands in the table, else a prefix and a name: "min" is the minute and no milli-inch.
[[nodiscard]] NamedUnit find_unit(std::string_view name);

/// The whole table as text, one definition a line: what a digest of the table is made of. The record states it, so that
/// it says by which sizes of units its numbers were found.
[[nodiscard]] std::string unit_table_text();

}  // namespace gumcert::gum
