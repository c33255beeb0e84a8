#include "reports/record/make/comparison/laboratory_budgets.h"

#include <utility>

#include "gum/quantity/diagnostic.h"
#include "reports/record/make/comparison/method_side.h"

namespace gumcert::reports {

namespace {

/// Value, uncertainty and sources of a result from its budget.
void take_over(const jobs::ComparisonJob& job, const jobs::ComparisonResult& stated, gum::ParticipantResult& result) {
    const std::string where = stated.where + " (" + stated.budget_file + ")";
    const MethodBudget budget{*stated.budget, where, job.participants[stated.participant].id, {0}, {""}};
    MethodSide side = side_of_budget(budget, job.items[stated.item].unit, job.coverage_probability);
    result.value = side.value.front();
    result.uncertainty = side.uncertainty.front();
    std::vector<gum::UncertaintySource>& sources = side.sources.all.front();
    result.sources.insert(result.sources.end(), sources.begin(), sources.end());
}

}  // namespace

std::vector<gum::ParticipantResult> results_with_budgets(const jobs::ComparisonJob& job, const gum::Progress& progress,
                                                         jobs::RefusedItems& refused) {
    std::vector<gum::ParticipantResult> results;
    results.reserve(job.results.size());
    for (const jobs::ComparisonResult& stated : job.results) {
        gum::ParticipantResult& result = results.emplace_back(stated);
        if (stated.budget == nullptr) {
            continue;
        }
        if (progress) {
            progress("budget " + stated.budget_file);
        }
        try {
            take_over(job, stated, result);
        } catch (const gum::DiagnosedError& error) {
            if (job.items.size() * job.rounds.size() == 1) {
                throw;
            }
            refused.emplace(std::pair(stated.item, stated.round), error.diagnostics().front());
        }
    }
    return results;
}

}  // namespace gumcert::reports
