#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "workbook/sheet_index.h"
#include "workbook/workbook.h"

namespace gumcert::workbook {

struct OperandArray;

/// What an operator or a function works on and gives back.
struct Operand {
    enum class Kind : std::uint8_t {
        blank,
        number,
        text,
        boolean,
        error,
        missing,        ///< an argument that is left out
        area,           ///< cells, not read yet
        array,          ///< values in rows and columns
        not_evaluated,  ///< with the place of its reason
        stands_for_all  ///< of the cell that is computed: its stored value is taken, for it holds a volatile function
    };
    Kind kind = Kind::blank;
    CellError error = CellError::null;
    std::uint32_t reason = 0;
    double number = 0.0;
    std::string text;
    Area area;
    std::shared_ptr<const OperandArray> array;

    [[nodiscard]] static Operand of(double number);  ///< #NUM! where it is not finite
    [[nodiscard]] static Operand of(bool truth);
    [[nodiscard]] static Operand of(CellError error);
    [[nodiscard]] static Operand of(std::string text);
    [[nodiscard]] static Operand of(const Area& area);

    /// An error, or no value at all: what goes on to the result of whatever reads it.
    [[nodiscard]] bool stops() const {
        return kind == Kind::error || kind == Kind::not_evaluated || kind == Kind::stands_for_all;
    }
    [[nodiscard]] bool is_number() const { return kind == Kind::number; }
};

using OperandKind = Operand::Kind;

/// Of nominal size; behind what is stored everything is blank, so that whole columns take no memory.
struct OperandArray {
    std::size_t rows = 1, columns = 1;
    std::size_t stored_rows = 1, stored_columns = 1;
    std::vector<Operand> items;  ///< row by row, stored_rows × stored_columns

    [[nodiscard]] const Operand& at(std::size_t row, std::size_t column) const;
    [[nodiscard]] std::size_t size() const { return rows * columns; }
};

/// What functions ask of the evaluation.
class CellReader {
public:
    CellReader() = default;
    CellReader(const CellReader&) = delete;
    CellReader& operator=(const CellReader&) = delete;
    virtual ~CellReader() = default;

    [[nodiscard]] virtual Operand cell(std::size_t sheet, const CellAddress& address) = 0;
    /// Tells the cells of an area that hold anything, until one answers false.
    virtual void each_cell(const Area& area, const std::function<bool(const Operand&)>& tell) = 0;
    /// The values of an area or array, or of a single value; an operand that stops where they cannot be had.
    [[nodiscard]] virtual Operand values(const Operand& operand) = 0;
    /// One value: of an area the one beside the cell that is computed, as spreadsheets take it; of an array the first.
    [[nodiscard]] virtual Operand single(const Operand& operand) = 0;
    /// The last row and column of a sheet that hold anything.
    [[nodiscard]] virtual CellAddress last_used(std::size_t sheet) const = 0;
    [[nodiscard]] virtual Operand not_evaluated(const std::string& what) = 0;
    /// Counts work, and ends it where there was too much.
    virtual void spend(std::size_t steps) = 0;
    [[nodiscard]] virtual bool dates_from_1904() const = 0;
};

/// A single value as a number: truth values are 1 and 0, blank is 0. Text that is plainly a number is one; text without a
/// digit is #VALUE!; what only a language decides (1,5 or 2024-01-24) is not evaluated.
[[nodiscard]] Operand as_number(const Operand& value, CellReader& reader);
/// The same as a truth value.
[[nodiscard]] Operand as_truth(const Operand& value, CellReader& reader);
/// The same as a text, as `&` puts it together.
[[nodiscard]] Operand as_text(const Operand& value, CellReader& reader);

/// x^y: 0^0 and a root of a negative number are #NUM!, 0 to a negative power is #DIV/0!.
[[nodiscard]] Operand power_of(double x, double y);

/// −1, 0 or 1: numbers before texts before truth values; blank is 0, "" or FALSE, as the other asks for.
[[nodiscard]] int compared(const Operand& a, const Operand& b);
/// Whether two numbers differ so little that spreadsheets, which compare the digits that they show, may call them equal.
[[nodiscard]] bool only_rounding_decides(const Operand& a, const Operand& b);

/// One function of spreadsheets.
struct SheetFunction {
    using Compute = Operand (*)(std::span<const Operand> arguments, CellReader& reader);

    /// values: each argument is a single value; errors go on without a call. whole: areas and arrays are handed over as
    /// they are. arrays: the same, and operators inside of the arguments work on each element.
    enum class Takes : std::uint8_t { values, values_and_errors, whole, arrays };

    std::string_view name;
    Takes takes;
    std::size_t least, most;  ///< number of arguments
    Compute compute;
};

inline constexpr std::size_t k_any_number = 255;

[[nodiscard]] std::span<const SheetFunction> mathematical_functions();
[[nodiscard]] std::span<const SheetFunction> statistical_functions();
[[nodiscard]] std::span<const SheetFunction> distribution_functions();
[[nodiscard]] std::span<const SheetFunction> lookup_functions();
[[nodiscard]] std::span<const SheetFunction> logical_functions();

}  // namespace gumcert::workbook
