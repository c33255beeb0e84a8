#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"
#include "audit/tables/sheet_view.h"
#include "audit/tables/table_heads.h"
#include "audit/words/column_heads.h"
#include "audit/words/named_statement.h"

namespace gumcert::audit {

/// A number that a statement gives.
struct StatedResult {
    StatedNumber number;
    std::string unit;          ///< "" where none stands beside it
    std::uint32_t column = 0;  ///< where the number stands
    bool is_relative = false;  ///< its name calls it so: a part of the value
};

/// Statements on a result, from the lines above and below its table.
struct Statements {
    std::map<Statement, StatedResult> numbers;
    std::map<Statement, StatedResult>
        parts;  ///< of the value, beside numbers in its unit: "U | 0.4 | mV" and "U | 0.004 | %"
    std::map<Statement, std::string> words;
    std::string unit_of_parts;  ///< "%": that of all rows, which are parts of the value; "" where they are not
    std::string coverage;       ///< what stands beside U of it: "k = 2, 95 %"
    std::string coverage_place;
    std::string other_k;  ///< of "U = k·u_c = 2.65·2": what may be k as well as the number that `coverage` begins with
};

/// Whether a statement is a number with the dimension of the result.
[[nodiscard]] bool is_of_result(Statement statement);

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

/// Puts statements into a budget, in the unit of its result.
/// \param of_contributions  the unit that contributions state
/// \param of_rows  the unit "1" where all rows that are added as they are have it; else ""
void state_claims(AuditedBudget& budget, const Statements& statements, const std::string& of_contributions,
                  const std::string& of_rows, std::vector<Sentence>& not_read);

/// How the table comes from u_c to U: by the k that it claims. Whether that is t_p of its ν_eff, note_unexplained() sees.
void state_coverage(AuditedBudget& budget);

}  // namespace gumcert::audit
