#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gum/rotary_table/evaluate_rotary_table.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Parts of the record of a rotary table that are made of budgets and comparisons.
struct RotaryRecordParts {
    FixtureBudget fixture_budget;
    std::optional<Comparison> comparison;  ///< with the reference method of the job
};

/// The record of a rotary-table evaluation: units of documents, rounding, names; nothing is computed.
///
/// \param covariance_file  name that the covariance file will have beside the record; "" when there is none
[[nodiscard]] reports::EvaluationRecord rotary_table_record(const jobs::RotaryTableJob& job,
                                                            const gum::RotaryTableResult& result,
                                                            const RotaryRecordParts& parts,
                                                            const std::vector<reports::InputFile>& files,
                                                            const std::string& covariance_file);

/// Names of the rows and columns of the covariance file: "EXA@30" … angle by angle, then set-up errors and reversals.
[[nodiscard]] std::vector<std::string> covariance_order(const jobs::RotaryTableJob& job,
                                                        const engine::ReportedQuantities& quantities);

}  // namespace gumcert::reports
