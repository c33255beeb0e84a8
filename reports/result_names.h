#pragma once

#include "certificate/certified_results.h"
#include "reports/document_text.h"
#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

#include <string>

namespace gumcert::reports {

// Names that the program itself gives to results, sources of uncertainty and distributions are in the wording; every
// other text is printed as the record holds it.

/// What a result of a rotary table stands for: "O_y" of "set_up", "axis_y" of "axis_line", "E_up" of "positioning".
/// \param table     id of the certified table
/// \param recorded  what is printed for any other result, in the languages of the document
[[nodiscard]] Text result_meaning(const std::string& table, const std::string& result, const Text& recorded,
                                  const Wording& words);
[[nodiscard]] Text result_meaning(const certificate::CertifiedTable& table, const certificate::CertifiedColumn& column,
                                  const Wording& words);

/// What the program itself describes a result as: "deviation of the table"; any other text is printed as it is.
[[nodiscard]] Text described_result(const std::string& recorded, const Wording& words);

/// Name of a result where its table stands: "EXA" for "range_EXA" in the table of the ranges.
[[nodiscard]] std::string name_in_table(const std::string& table, const std::string& result);

/// Name of a result anywhere else: "range of EXA".
[[nodiscard]] Text name_of_result(const std::string& table, const std::string& result, const Wording& words);

/// A source or an input quantity of the budget of a rotary table: "length noise".
[[nodiscard]] Text source_name(const std::string& recorded, const Wording& words);

/// A row of a budget: an input as the job names it, and in the languages of the document what the program named: "scatter of the
/// readings", "fit of b", "calibration of STD-1".
[[nodiscard]] Text name_of_budget_row(const BudgetRow& row, const Wording& words);
/// The same of its source; none where it is the row itself.
[[nodiscard]] Text source_of_budget_row(const BudgetRow& row, const Wording& words);

/// A distribution of the record: "rectangular" for "uniform".
[[nodiscard]] Text distribution_name(const std::string& recorded, const Wording& words);

}  // namespace gumcert::reports
