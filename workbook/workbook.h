#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::workbook {

inline constexpr std::uint32_t k_most_rows = 1'048'576;  ///< of a sheet (ECMA-376)
inline constexpr std::uint32_t k_most_columns = 16'384;  ///< A to XFD

/// Row and column of a cell, both from 1. Cells are ordered row by row.
struct CellAddress {
    std::uint32_t row = 1, column = 1;

    friend auto operator<=>(const CellAddress&, const CellAddress&) = default;
};

/// A rectangle of cells, both corners with it.
struct CellRange {
    CellAddress first, last;

    friend bool operator==(const CellRange&, const CellRange&) = default;
};

/// "A", "XFD".
/// \param column  1 to k_most_columns
[[nodiscard]] std::string column_letters(std::uint32_t column);
/// "B5".
[[nodiscard]] std::string a1_text(const CellAddress& address);
/// "B5:C9"; "B5" where it is one cell.
[[nodiscard]] std::string a1_text(const CellRange& range);
/// The address that a text like "B5" or "$B$5" means; nothing where it is none, or lies outside of a sheet.
[[nodiscard]] std::optional<CellAddress> read_a1(std::string_view text);
/// The name of a sheet as formulas write it: `Budget`, `'My sheet'`.
[[nodiscard]] std::string quoted_sheet(std::string_view name);
/// "Budget!B5".
[[nodiscard]] std::string sheet_a1(std::string_view sheet, const CellAddress& address);

enum class CellKind : std::uint8_t { blank, number, text, boolean, error };
enum class CellError : std::uint8_t { null, division_by_zero, value, reference, name, number, not_available, other };

/// "#DIV/0!"; "#OTHER!" for one that this program does not make itself.
[[nodiscard]] std::string_view error_text(CellError error);
/// The error that a text like "#N/A" names; `other` for any other word that begins with #, nothing for the rest.
[[nodiscard]] std::optional<CellError> read_error(std::string_view text);

/// What a cell holds, or what its formula gave when the file was stored.
struct CellValue {
    CellKind kind = CellKind::blank;
    CellError error = CellError::null;
    double number = 0.0;  ///< boolean: 1 or 0
    std::string text{};   ///< of a number: its digits as the file has them, which are evidence of what was typed

    friend bool operator==(const CellValue&, const CellValue&) = default;
};

/// none: a constant. array: entered as an array formula, or one that the program stored as such.
enum class FormulaKind : std::uint8_t { none, plain, array, data_table };

struct Cell {
    CellAddress address;
    CellValue value;      ///< of a formula: the stored value, blank where the file has none
    std::string formula;  ///< without the equals sign; empty for a constant
    FormulaKind formula_kind = FormulaKind::none;
    std::uint32_t number_format = 0;  ///< place in Workbook::number_formats
};

enum class SheetState : std::uint8_t { visible, hidden, very_hidden };

/// Rows or columns from first to last.
struct Span {
    std::uint32_t first = 1, last = 1;

    friend bool operator==(const Span&, const Span&) = default;
};

struct Sheet {
    std::string name;
    SheetState state = SheetState::visible;
    bool is_protected = false;
    std::vector<Cell> cells;              ///< that hold anything, row by row; no address occurs twice
    std::vector<CellRange> array_ranges;  ///< of more than one cell, filled by the array formula of their first one
    std::vector<Span> hidden_rows, hidden_columns;
};

struct DefinedName {
    std::string name;
    std::string formula;               ///< what it stands for
    std::optional<std::size_t> sheet;  ///< on which alone it holds; nothing: in the whole workbook
    bool is_hidden = false;
};

/// Another file that formulas read, `[1]Sheet!A1` for the first one.
struct ExternalLink {
    std::string kind;    ///< workbook, dde or ole
    std::string target;  ///< as the file states it; "" where it does not. Never opened.
};

struct WorkbookMetadata {
    std::string application, application_version;  ///< that stored the file, as the file says
    std::string created, modified;                 ///< ISO 8601, as the file says
    bool structure_is_protected = false;
    bool dates_from_1904 = false;           ///< day 0 is 1904-01-01
    bool precision_as_displayed = false;    ///< the program computed with rounded values
    bool iterates = false;                  ///< circular references were allowed
    std::vector<std::string> not_examined;  ///< parts of the file that nobody here looked at: macros, charts
};

struct Workbook {
    std::vector<Sheet> sheets;
    std::vector<DefinedName> defined_names;
    std::vector<ExternalLink> external_links;
    std::vector<std::string> number_formats{"General"};
    WorkbookMetadata metadata;
    char csv_separator = '\0';  ///< between the columns of the CSV file that it was read from; '\0': of a workbook
};

/// The cell of an address; nullptr where it is blank.
[[nodiscard]] const Cell* find_cell(const Sheet& sheet, const CellAddress& address);
/// The sheet of a name, capitals of ASCII counting as small letters; nothing where there is none.
[[nodiscard]] std::optional<std::size_t> find_sheet(const Workbook& workbook, std::string_view name);

}  // namespace gumcert::workbook
