#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"
#include "audit/tables/named_line.h"
#include "audit/tables/product_of_rows.h"
#include "audit/tables/row_units.h"
#include "audit/tables/sheet_view.h"
#include "audit/tables/stated_results.h"
#include "audit/tables/table_heads.h"
#include "audit/tables/table_sums.h"

namespace gumcert::audit {

inline constexpr std::size_t k_most_rows_of_table = 2'000;  ///< a part of them would give another u_c

/// A line that states a correlation.
struct CorrelationLine {
    const SheetView::Row* row;
    double r;
    std::vector<std::pair<std::string, std::string>> pairs;  ///< what may be the symbols of its rows
};

/// What was read of a table so far. Rows below heads that are headed again before any result ("Type A" and "Type B", the next page)
/// are set apart as such.
struct TableSoFar {
    std::optional<Heads> heads;
    AuditedBudget budget;
    std::vector<RowUnits> units;  ///< of its rows
    Statements statements;
    std::set<const workbook::Cell*> with_numbers;  ///< unknown heads of columns of numbers
    std::string title;                             ///< the line of words alone above the heads
    std::string unit_in_words;                     ///< that a line above or below the table has for all of it
    bool is_too_long = false;
    bool is_unusable = false;                           ///< a row has an uncertainty that could not be read
    bool is_open = false;                               ///< nobody can know what the result is, and it was said
    bool is_told = false;                               ///< why the table is not looked at
    bool lost_a_row = false;                            ///< its uncertainty has digits, and was not read
    bool have_coefficients = false;                     ///< rows state them
    std::optional<NumbersUnderHeads> result_line;       ///< states the value, and more
    std::optional<ProductOfRows> product;               ///< that the values of the rows make up, where they do
    std::vector<const SheetView::Row*> last_constants;  ///< behind the last row so far
    std::vector<CorrelationLine> correlation_lines;
    const SheetView::Row* covariance_line = nullptr;  ///< the first one with a covariance
    std::optional<std::uint32_t> last_unread;         ///< line that was named as not read, or follows such
    std::size_t looks = 0;                            ///< at sums of the rows, for lines that look like rows

    /// The rows and statements so far.
    [[nodiscard]] TableSums sums() { return {budget.rows, units, *heads, statements}; }
    /// Whether what is stated follows from the rows: u_c, or U where no u_c is.
    [[nodiscard]] bool follows_from_rows() const;
};

/// Names a line with a number of which nothing is used, and the first of several together.
void note_unread(const SheetView& sheet, const SheetView::Row& row, TableSoFar& table, std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
