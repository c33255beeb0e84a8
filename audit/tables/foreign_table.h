#pragma once

#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"
#include "workbook/evaluate.h"
#include "workbook/workbook.h"

namespace gumcert::audit {

/// What was found in a workbook, or in the one sheet of a CSV file.
struct ForeignTables {
    std::vector<AuditedBudget> budgets;  ///< one a table, in the order of the sheets
    bool has_unusable = false;           ///< there was a budget whose numbers could not be read
    std::vector<Sentence> not_read;      ///< cells that belong to a table and could not be understood, as sentences
};

/// Finds the uncertainty budgets in a workbook.
///
/// A table begins where one row heads a column of quantities and a column of uncertainties (u, what is divided, or
/// contributions), in words of budget_words.h. Its rows follow until a row that names a result (u_c, ν_eff, k, U …) or two
/// empty rows; statements on the result stand below, up to the next table. Numbers of formulas are those that we evaluate;
/// where we do not, the stored ones.
/// \param evaluation  of the same workbook
/// \param file        its name, for the names of results
[[nodiscard]] ForeignTables budgets_in(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation,
                                       const std::string& file);

}  // namespace gumcert::audit
