#include "reports/record/make/comparison/laboratory_budgets.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "reports/record/make/comparison/method_side.h"

namespace gumcert::reports {

namespace {

/// Value, uncertainty and sources of a result from its budget.
/// \return sources in which the result is not linear
std::set<std::string> take_over(const jobs::ComparisonJob& job, const jobs::ComparisonResult& stated,
                                gum::ParticipantResult& result, std::vector<std::string>& remarks) {
    const std::string where = stated.where + " (" + stated.budget_file + ")";
    const MethodBudget budget{*stated.budget, where, job.participants[stated.participant].id, {0}, {""}};
    MethodSide side = side_of_budget(budget, job.items[stated.item].unit, job.coverage_probability);
    result.value = side.value.front();
    result.uncertainty = side.uncertainty.front();
    std::vector<gum::UncertaintySource>& sources = side.sources.all.front();
    result.sources.insert(result.sources.end(), sources.begin(), sources.end());
    remarks.insert(remarks.end(), side.remarks.begin(), side.remarks.end());
    return std::move(side.not_linear_in);
}

/// Whether the job states the correlation of two participants, which takes the place of what their sources say.
bool is_correlation_stated(const jobs::ComparisonJob& job, std::size_t first, std::size_t second) {
    const std::string& group = job.participants[first].group;
    if (!group.empty() && group == job.participants[second].group && job.group_correlation.contains(group)) {
        return true;
    }
    return std::any_of(job.correlations.begin(), job.correlations.end(), [&](const gum::ParticipantCorrelation& of) {
        return (of.first == first && of.second == second) || (of.first == second && of.second == first);
    });
}

/// A source that another result of the item names too, or its assigned value, and that a result is not linear in.
std::optional<gum::Diagnostic> unknown_covariance(const jobs::ComparisonJob& job,
                                                  const std::vector<gum::ParticipantResult>& results, std::size_t of,
                                                  const std::set<std::string>& not_linear_in) {
    const auto names = [&](const std::vector<gum::UncertaintySource>& sources) -> std::optional<std::string> {
        for (const gum::UncertaintySource& source : sources) {
            if (not_linear_in.contains(source.source) &&
                std::find(job.independent_sources.begin(), job.independent_sources.end(), source.source) ==
                    job.independent_sources.end()) {
                return source.source;
            }
        }
        return std::nullopt;
    };
    std::optional<std::string> found = names(job.items[results[of].item].assigned_value.sources);
    for (std::size_t i = 0; i < results.size() && !found; ++i) {
        if (i != of && results[i].item == results[of].item && results[i].round == results[of].round &&
            !is_correlation_stated(job, results[of].participant, results[i].participant)) {
            found = names(results[i].sources);
        }
    }
    if (!found) {
        return std::nullopt;
    }
    return covariance_not_known(job.results[of].where + " (" + job.results[of].budget_file + ")",
                                job.participants[results[of].participant].id, *found);
}

}  // namespace

std::vector<gum::ParticipantResult> results_with_budgets(const jobs::ComparisonJob& job, const gum::Progress& progress,
                                                         jobs::RefusedItems& refused,
                                                         std::vector<std::string>& remarks) {
    std::vector<gum::ParticipantResult> results;
    results.reserve(job.results.size());
    std::map<std::size_t, std::set<std::string>> not_linear_in;  // of results
    const bool is_one = job.items.size() * job.rounds.size() == 1;
    for (const jobs::ComparisonResult& stated : job.results) {
        gum::ParticipantResult& result = results.emplace_back(stated);
        if (stated.budget == nullptr) {
            continue;
        }
        if (progress) {
            progress("budget " + stated.budget_file);
        }
        try {
            not_linear_in[results.size() - 1] = take_over(job, stated, result, remarks);
        } catch (const gum::DiagnosedError& error) {
            if (is_one) {
                throw;
            }
            refused.emplace(std::pair(stated.item, stated.round), error.diagnostics().front());
        }
    }
    for (const auto& [i, sources] : not_linear_in) {
        if (std::optional<gum::Diagnostic> unknown = unknown_covariance(job, results, i, sources)) {
            if (is_one) {
                throw gum::InputError(std::move(*unknown));
            }
            refused.emplace(std::pair(results[i].item, results[i].round), std::move(*unknown));
        }
    }
    return results;
}

}  // namespace gumcert::reports
