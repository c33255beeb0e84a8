#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "audit/sentence.h"
#include "audit/stated_number.h"
#include "audit/words/column_heads.h"
#include "workbook/evaluate.h"
#include "workbook/workbook.h"

namespace gumcert::audit {

/// A number of a cell with what stands behind it.
struct NumberWithUnit {
    StatedNumber number;
    std::string unit;      ///< "" where none stands there
    bool is_open = false;  ///< nobody can know its decimal sign
};

/// A number without dimension: of a divisor, k, or E_n.
[[nodiscard]] StatedNumber without_dimension(NumberWithUnit read);

/// The decimal sign of a file, where its numbers show one: "1.200" alone may be 1.2 or 1200, and beside "0,5" it is 1200.
///
/// The numbers of cells decide, and where they show none, those in its words. In a workbook numbers are no texts, and show
/// nothing. Between columns that commas separate, a number without quotes has no comma: it has a point, if any sign.
[[nodiscard]] DecimalSign decimal_sign_of(const workbook::Workbook& workbook);

/// A block of a sheet that is read with rows and columns changed: its heads stand below each other in its first column, and
/// each further column is a row of the table. Where its first cell is blank, the others of that row are the quantities.
struct TurnedBlock {
    workbook::CellAddress first, last;
};

/// The cells of a sheet row by row, with the values that formulas give.
class SheetView {
public:
    using Row = std::vector<const workbook::Cell*>;
    using Rows = std::map<std::uint32_t, Row>;

    /// \param sign    of the file
    /// \param turned  what of it is read as a table with its rows in columns
    SheetView(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation, std::size_t sheet,
              DecimalSign sign, const std::optional<TurnedBlock>& turned = std::nullopt);
    SheetView(const SheetView&) = delete;
    SheetView& operator=(const SheetView&) = delete;

    [[nodiscard]] const Rows& rows() const { return rows_; }
    [[nodiscard]] std::string place(const workbook::CellAddress& address) const {
        return name_ + "!" + workbook::a1_text(in_file(address));
    }
    /// What the cell shows: of a formula the value that we computed, where we did.
    [[nodiscard]] workbook::CellValue value(const workbook::Cell& cell) const;
    /// A number of a cell. One that a formula gave is exact; one that was typed has the digits that were typed, of
    /// which a spreadsheet computes as if they were exact.
    [[nodiscard]] std::optional<StatedNumber> number(const workbook::Cell& cell) const;
    /// The number that a cell begins with, and the unit behind it: "0.36 µm" and "5 %"; of a number that its format shows with one,
    /// 0.000" µm", too.
    [[nodiscard]] std::optional<NumberWithUnit> number_with_unit(const workbook::Cell& cell) const;
    /// The same of a text that stands in a cell.
    [[nodiscard]] std::optional<NumberWithUnit> number_in_text(std::string_view text, const workbook::Cell& cell) const;
    /// A number that its cell shows in percent, as it is shown: 0.0014 is 0.14 %.
    [[nodiscard]] NumberWithUnit as_shown(NumberWithUnit read, const workbook::Cell& cell) const;
    [[nodiscard]] DecimalSign decimal_sign() const { return sign_; }
    [[nodiscard]] std::string words(const workbook::Cell& cell) const;
    /// Whether a cell has a text, and which column it heads, if it is a head.
    struct HeadCell {
        bool is_text = false;
        std::optional<Column> column;
    };
    /// Each cell is looked at once, however often its row is.
    [[nodiscard]] const HeadCell& head(const workbook::Cell& cell) const;
    /// A table of values alone was computed elsewhere and rounded.
    [[nodiscard]] bool has_formulas() const { return !evaluation_.cells.empty(); }

private:
    /// Copies of all cells with the addresses that they have where a block is turned.
    void turn();
    /// The unit that the format of its numbers writes behind them.
    [[nodiscard]] const std::string& unit_shown(const workbook::Cell& cell) const;
    /// Where a cell stands in the file.
    [[nodiscard]] workbook::CellAddress in_file(const workbook::CellAddress& address) const;

    const workbook::Workbook& workbook_;
    const workbook::Evaluation& evaluation_;
    std::optional<TurnedBlock> turned_;
    std::vector<workbook::Cell> turned_cells_;
    std::size_t sheet_;
    DecimalSign sign_;
    std::string name_;  ///< of the sheet, as formulas write it
    Rows rows_;
    mutable std::unordered_map<const workbook::Cell*, HeadCell> heads_;        ///< that were asked for
    mutable std::unordered_map<std::uint32_t, std::string> units_of_formats_;  ///< that were asked for
};

/// The cell of a row in a column; nullptr where it holds nothing.
[[nodiscard]] const workbook::Cell* cell_in(const SheetView::Row& row, std::uint32_t column);

/// Whether a cell that could have a number says that there is none: a dash, "n/a", or nothing.
[[nodiscard]] bool says_nothing(std::string_view text);

/// What is said of a number whose decimal sign nobody can know.
[[nodiscard]] Sentence open_sign(const std::string& place, const std::string& held);

}  // namespace gumcert::audit
