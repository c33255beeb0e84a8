#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "workbook/formula.h"

namespace gumcert::workbook {

/// A formula as text from which parse_formula() reads the same tree, with no brackets that it does not need.
[[nodiscard]] std::string print_formula(const Formula& formula);

/// A formula in R1C1 style: relative references as their distance from the cell, `R[-1]C[2]`, absolute ones as `R3C2`.
/// Formulas that were copied from a cell to its neighbours are equal in this style, and one that was changed stands out.
/// \param at  the cell that holds the formula
[[nodiscard]] std::string r1c1_text(const Formula& formula, const CellAddress& at);

/// The text of a formula after it was copied to another cell: references move where they are relative, and everything
/// else keeps its bytes. Beyond the edge of the sheet they come in at the opposite one, as spreadsheets do it.
/// \param text     the text that `formula` was read from
[[nodiscard]] std::string copied_formula(std::string_view text, const Formula& formula, const CellAddress& from,
                                         const CellAddress& to);

/// A number that stands in a formula itself.
struct FormulaLiteral {
    std::uint32_t node = 0;    ///< place in Formula::nodes
    std::uint32_t parent = 0;  ///< of the operator or function that it belongs to; its own place where there is none
    std::size_t argument = 0;  ///< which operand of the parent it is, from 0
    double number = 0.0;       ///< with the sign before it
    std::string text;          ///< as written, "1.73"
};

/// The numbers of a formula in the order in which they stand, those of arrays with them. A sign that stands before a
/// number belongs to it.
[[nodiscard]] std::vector<FormulaLiteral> literal_numbers(const Formula& formula);

}  // namespace gumcert::workbook
