#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "workbook/workbook.h"

namespace gumcert::workbook {

/// One corner of a reference. What is not absolute moves with the formula when it is copied.
struct ReferenceCorner {
    CellAddress address;
    bool row_is_absolute = false, column_is_absolute = false;

    friend bool operator==(const ReferenceCorner&, const ReferenceCorner&) = default;
};

/// columns: `A:C`, all rows. rows: `1:3`, all columns.
enum class ReferenceShape : std::uint8_t { cell, range, columns, rows };

/// Cells that a formula names. The corners stand as they are written; area() puts them in order.
struct Reference {
    std::string workbook;    ///< number or name between [ ] of another workbook; "" for this one
    std::string sheet;       ///< "" for the sheet of the formula
    std::string last_sheet;  ///< of `first:last!A1`, which reads all sheets between; else ""
    ReferenceShape shape = ReferenceShape::cell;
    ReferenceCorner first, last;  ///< of one cell: equal

    friend bool operator==(const Reference&, const Reference&) = default;
};

/// The rectangle of a reference, corners in order.
[[nodiscard]] CellRange area(const Reference& reference);

enum class FormulaNodeKind : std::uint8_t {
    number,
    text,
    boolean,
    error,
    missing,  ///< an argument that is left out: IF(A1,,2)
    reference,
    name,        ///< a defined name; `text` may begin with `[1]!` or a sheet
    structured,  ///< a reference to a table: Table1[u]
    negate,
    plus,
    percent,
    power,
    multiply,
    divide,
    add,
    subtract,
    concatenate,
    equal,
    not_equal,
    less,
    less_equal,
    greater,
    greater_equal,
    range,         ///< A1:INDEX(…), of two operands that are no plain cells
    intersection,  ///< the blank between two references
    reunion,       ///< the comma between two references in brackets
    call,
    array  ///< {1,2;3,4}
};

/// A sign of one operand: −x, +x, x %.
[[nodiscard]] constexpr bool is_sign(FormulaNodeKind kind) {
    return kind >= FormulaNodeKind::negate && kind <= FormulaNodeKind::percent;
}

[[nodiscard]] constexpr bool is_binary(FormulaNodeKind kind) {
    return kind >= FormulaNodeKind::power && kind <= FormulaNodeKind::reunion;
}

struct FormulaNode {
    FormulaNodeKind kind = FormulaNodeKind::missing;
    CellError error = CellError::null;
    double number = 0.0;                          ///< boolean: 1 or 0
    std::string text{};                           ///< number: as written; text; call: name in capitals; name
    std::uint32_t reference = 0;                  ///< place in Formula::references
    std::uint32_t first_child = 0, children = 0;  ///< places in Formula::children
    std::uint32_t columns = 0;                    ///< of an array, which is stored row by row
    std::uint32_t offset = 0, length = 0;         ///< bytes of the formula that it was read from
};

/// A formula as a tree: children stand before their parents, the root is last.
struct Formula {
    std::vector<FormulaNode> nodes;
    std::vector<std::uint32_t> children;  ///< places of nodes
    std::vector<Reference> references;

    [[nodiscard]] std::uint32_t root() const { return static_cast<std::uint32_t>(nodes.size() - 1); }
    [[nodiscard]] std::span<const std::uint32_t> children_of(const FormulaNode& node) const {
        return std::span(children).subspan(node.first_child, node.children);
    }
};

/// Reads the formula of a cell as files store it (ECMA-376 Part 1, 18.17): English names of functions, comma between
/// arguments, with or without the equals sign before it. The prefixes `_xlfn.` and `_xlws.` of later functions are
/// taken off. A sign binds closer than a power, -2^2 = 4, and powers go from the left, 2^3^2 = 64, as in spreadsheets.
/// \param where  cell, for messages
/// \throws gum::InputError  GC-WORKBOOK-0013 longer than 8192 characters, -0014 not understood, -0015 nested deeper than
///                          64 levels
[[nodiscard]] Formula parse_formula(std::string_view text, std::string_view where);

/// Whether two trees mean the same: kinds, values, names and references; not where they stand in their texts, nor how a
/// number was written.
[[nodiscard]] bool same_formula(const Formula& a, const Formula& b);

}  // namespace gumcert::workbook
