#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "audit/subject.h"
#include "gum/budget/budget.h"
#include "gum/rotary_table/fixture_budget.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::evaluation {

/// A budget with other standard uncertainties of its inputs at each point.
/// \param rows     the audit's budgets of its points, in their order
/// \param factors  of the rows of each, ≥ 0, [1]
/// \return nothing where a row is no input of the budget, but the parameter of a fit
[[nodiscard]] std::optional<gum::Budget> with_scaled_uncertainties(gum::Budget budget,
                                                                   const std::vector<audit::AuditedBudget>& rows,
                                                                   const audit::RowFactors& factors);

/// Puts the budget of the fixture of a rotary table beside the results that rest on it, one budget a coordinate. Where
/// the audit corrects it, the whole measurement is evaluated again: adjustment, uncertainties, comparison with the
/// reference method.
/// \param job        that was evaluated, with a budget of its fixture
/// \param fixture    as its evaluation gave it
/// \param record     of this evaluation, with the files of the job
/// \param threads    of Monte Carlo, which is repeated where results come from it
[[nodiscard]] std::function<void(audit::AuditSubject&)> audit_of_fixture_budget(const jobs::RotaryTableJob& job,
                                                                                const gum::FixtureUncertainty& fixture,
                                                                                const reports::EvaluationRecord& record,
                                                                                unsigned threads);

}  // namespace gumcert::evaluation
