#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string_view>

#include "audit/tables/sheet_view.h"
#include "audit/tables/table_heads.h"
#include "audit/words/column_heads.h"
#include "audit/words/named_statement.h"

namespace gumcert::audit {

/// What the first cells of a line name.
struct NamedLine {
    NamedStatement named;
    std::size_t cell = 0;  ///< the one that names it
    std::size_t from =
        1;  ///< the first one that may have a number: behind the name, but where heads say where names stand
};
/// \param heads  of the table above the line, whose quantities may stand in any column; nullptr elsewhere
[[nodiscard]] std::optional<NamedLine> name_of_line(const SheetView& sheet, const SheetView::Row& row,
                                                    const Heads* heads);

/// The numbers of a line that stand under heads of numbers.
using NumbersUnderHeads = std::map<Column, const workbook::Cell*>;
[[nodiscard]] NumbersUnderHeads numbers_under(const SheetView& sheet, const Heads& heads, const SheetView::Row& row);

/// Whether all that a line has beside its name is a number and "1" next to it, the unit of a quantity without dimension.
[[nodiscard]] bool is_number_with_one(const SheetView& sheet, const SheetView::Row& row, const NamedLine& line);

/// "10.002 bar ± 4.9 mbar (k = 2)", "(10.0020 ± 0.0047) bar; k = 2": a value and its U (JCGM 100:2008, 7.2.4).
struct ValueWithU {
    NumberWithUnit value, U;
    std::string_view behind;  ///< U, with what is said of coverage
};
[[nodiscard]] std::optional<ValueWithU> value_with_U(const SheetView& sheet, const workbook::Cell& cell,
                                                     std::string_view text);

}  // namespace gumcert::audit
