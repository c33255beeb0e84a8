#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The results of a record as tables of columns: unrounded values, the printed texts that the record holds, no scope
/// and no verdicts. What a certificate starts from, and what a document without certificate data shows.
///
/// Budget: tables "results"; results of the same points share one, with the argument "point" (names, no numbers); those
/// without points are columns of one value. Rotary table: "set_up", "error_motions" (argument "angle" in deg),
/// "reversal" (columns `reversal_EXA` …), "ranges" (`range_EXA` …), "axis_line", "positioning"; those that the
/// record has.
///
/// Values of a rotary table, but for those of its set-up, stand in the order of stated_values(…, by_motion).
///
/// k and effective degrees of freedom are printed as certificate/statement_of_uncertainty.h says. Coverage intervals
/// are left to whoever certifies.
[[nodiscard]] std::vector<certificate::CertifiedTable> certified_tables(const EvaluationRecord& record);

/// The result that a value of a column stands for: of a budget, or the set-up of a rotary table.
/// \param name  of the column
/// \return in the record; none for the other tables of a rotary table
[[nodiscard]] Result* result_of(EvaluationRecord& record, const certificate::CertifiedTable& table,
                                const std::string& name, std::size_t row);
[[nodiscard]] const Result* result_of(const EvaluationRecord& record, const certificate::CertifiedTable& table,
                                      const std::string& name, std::size_t row);

/// Whether a table of results shows limits and verdict of a result: then the certificate has no table of verdicts for it.
[[nodiscard]] bool shows_verdict(const certificate::CertifiedTable& table, const std::string& result);

}  // namespace gumcert::reports
