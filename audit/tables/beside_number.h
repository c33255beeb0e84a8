#pragma once

#include <cstddef>
#include <string>

#include "audit/tables/named_line.h"
#include "audit/tables/sheet_view.h"
#include "audit/tables/table_heads.h"

namespace gumcert::audit {

/// What stands beside the number of a statement in its line.
class BesideNumber {
public:
    BesideNumber(const SheetView& sheet, const SheetView::Row& row, const Heads* heads, const NamedLine& line)
        : sheet_(sheet), row_(row), heads_(heads), named_(line.cell), from_(line.from) {}

    /// \param number  the cell that has it; nullptr where the name has it
    /// \param by_head whether its column said so
    [[nodiscard]] std::string unit(const workbook::Cell* number, bool by_head) const;
    /// "1" beside a number: of a quantity without dimension. Under a head of numbers it may be a divisor or a coefficient.
    [[nodiscard]] std::string one(const workbook::Cell* number, bool by_head) const;
    [[nodiscard]] bool is_under(Column column, const workbook::Cell& cell) const;

private:
    [[nodiscard]] bool is_under_words(const workbook::Cell& cell) const;
    /// Whether a cell is the next one to the number that holds anything.
    [[nodiscard]] bool is_next(const workbook::Cell* number, std::size_t i) const;

    const SheetView& sheet_;
    const SheetView::Row& row_;
    const Heads* heads_;
    std::size_t named_, from_;
};

}  // namespace gumcert::audit
