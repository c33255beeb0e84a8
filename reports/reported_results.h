#pragma once

#include "certificate/certified_results.h"
#include "reports/document_text.h"
#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

#include <optional>
#include <vector>

namespace gumcert::reports {

/// Sentences that say why Monte Carlo is reported of which results, one a reason; and those that say what speaks
/// against the law of propagation where the job asked for it. Empty where nothing needs saying.
[[nodiscard]] std::vector<Text> reasons_for_monte_carlo(const std::vector<Result>& results, const Wording& words);
[[nodiscard]] std::vector<Text> reasons_for_monte_carlo(const EvaluationRecord& record, const Wording& words);

/// U as printed, or "low … high" where only the coverage interval of Monte Carlo holds.
[[nodiscard]] Text stated_uncertainty(const ReportedResult& reported, const Wording& words);
[[nodiscard]] Text stated_uncertainty(const StatedValue& value, const Wording& words);

/// Coverage probabilities of the values of a certified column: of its result, or of its point, where that states its own.
[[nodiscard]] std::vector<double> coverage_probabilities(const EvaluationRecord& record,
                                                         const certificate::CertifiedTable& table,
                                                         const certificate::CertifiedColumn& column);

/// That the values of a certified column are means of trials, and what the model gives at the estimates; empty where that is the
/// same.
[[nodiscard]] Text values_of_model(const EvaluationRecord& record, const certificate::CertifiedTable& table,
                                   const certificate::CertifiedColumn& column, const Wording& words);

}  // namespace gumcert::reports
