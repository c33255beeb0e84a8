#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "audit/sentence.h"
#include "audit/tables/named_line.h"
#include "audit/tables/sheet_view.h"
#include "audit/tables/stated_results.h"
#include "audit/tables/table_heads.h"

namespace gumcert::audit {

/// Takes what a line states. Where several numbers stand under the heads of the table, each is what its head says: u_c and U under
/// contributions or u, k under the divisors, ν_eff under degrees of freedom; else the first number is it.
/// \param heads  of the table whose lines go on to this one; nullptr elsewhere
/// \return what the line states; nothing where it states nothing
[[nodiscard]] std::optional<Statement> take_statement(const SheetView& sheet, const SheetView::Row& row,
                                                      const Heads* heads, Statements& statements,
                                                      std::vector<Sentence>& not_read);

/// Takes results that stand beside each other below a line of their names, "u_c | k | U".
/// \param below  the lines that follow without an empty one
/// \return how many of the lines are such results, from the first one; of several points nothing is taken, and that is said
[[nodiscard]] std::size_t take_results_below(const SheetView& sheet, const SheetView::Row& heads,
                                             const std::vector<SheetView::Row>& below, Statements& statements,
                                             std::vector<Sentence>& not_read);

/// A number of a cell as a statement has it; nothing where it has none, or one whose decimal sign nobody can know.
[[nodiscard]] std::optional<StatedResult> result_in(const SheetView& sheet, const workbook::Cell& cell,
                                                    Statement statement, std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
