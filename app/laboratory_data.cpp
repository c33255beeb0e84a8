#include "app/laboratory_data.h"

#include <algorithm>
#include <cmath>

#include "app/laboratory_covariance.h"
#include "app/method_side.h"
#include "app/record_parts.h"
#include "gum/argument_check.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"

namespace gumcert::app {

namespace {

/// Value, uncertainty and sources of a result from its budget.
void take_over(const engine::ComparisonJob& job, engine::ComparisonResult& result) {
    const std::string where = result.where + " (" + result.budget_file + ")";
    const MethodBudget budget{*result.budget, where, job.participants[result.participant].id, {0}, {""}};
    MethodSide side = side_of_budget(budget, job.items[result.item].unit, job.coverage_probability);
    result.value = side.value.front();
    result.uncertainty = side.uncertainty.front();
    std::vector<engine::UncertaintySource>& sources = side.sources.all.front();
    result.sources.insert(result.sources.end(), sources.begin(), sources.end());
}

void tell(const gum::Progress& progress, const std::string& text) {
    if (progress) {
        progress(text);
    }
}

std::string place_of(const engine::ComparisonJob& job, const engine::ComparisonItem& item, const std::string& round) {
    std::string place = job.items.size() > 1 || !item.id.empty() ? "item \"" + item.id + "\"" : "item";
    return round.empty() ? place : place + ", round \"" + round + "\"";
}

/// The reference laboratory apart, those that are left out aside.
/// \throws InputError  GC-COMPARE-0106
void find_contributing(const engine::ComparisonJob& job, LaboratoryData& data) {
    const engine::AssignedValueRequest& request = data.item->assigned_value;
    const bool by_reference = request.method == engine::AssignedValueMethod::reference;
    for (std::size_t i = 0; i < data.size(); ++i) {
        if (by_reference && job.participants[data.results[i]->participant].id == request.participant) {
            data.reference = i;
        } else if (data.results[i]->contributes) {
            data.contributing.push_back(i);
        }
    }
    if (by_reference && (!data.reference || !data.has_u(*data.reference))) {
        gum::refuse("GC-COMPARE-0106", data.where,
                    "participant \"" + request.participant + "\" has no result" +
                        (data.reference ? " with an uncertainty" : ""),
                    "the assigned value is the result of this participant",
                    "State it, or take another assigned value.");
    }
}

}  // namespace

bool LaboratoryData::all_have_u(const std::vector<std::size_t>& positions) const {
    return std::all_of(positions.begin(), positions.end(), [&](std::size_t i) { return has_u(i); });
}

std::vector<std::size_t> LaboratoryData::with_u() const {
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < size(); ++i) {
        if (has_u(i)) {
            positions.push_back(i);
        }
    }
    return positions;
}

gum::LaboratoryResults LaboratoryData::at(const std::vector<std::size_t>& positions) const {
    gum::LaboratoryResults chosen;
    chosen.x = x(positions);
    chosen.u = u(positions);
    if (covariance.size() > 0) {
        chosen.covariance = covariance(positions, positions);
        const Eigen::MatrixXd variances = chosen.covariance.diagonal().asDiagonal();
        if (chosen.covariance == variances) {
            chosen.covariance.resize(0, 0);
        }
    }
    return chosen;
}

Eigen::VectorXd LaboratoryData::values(const std::vector<std::size_t>& positions) const {
    return x(positions);
}

std::vector<engine::ComparisonResult> results_with_budgets(const engine::ComparisonJob& job,
                                                           const gum::Progress& progress,
                                                           engine::RefusedItems& refused) {
    std::vector<engine::ComparisonResult> results = job.results;
    for (engine::ComparisonResult& result : results) {
        if (result.budget == nullptr) {
            continue;
        }
        tell(progress, "budget " + result.budget_file);
        try {
            take_over(job, result);
        } catch (const gum::DiagnosedError& error) {
            if (job.items.size() * job.rounds.size() == 1) {
                throw;
            }
            refused.emplace(std::pair(result.item, result.round), error.diagnostics().front());
        }
    }
    return results;
}

std::vector<LaboratoryData> laboratory_data(const engine::ComparisonJob& job,
                                            const std::vector<engine::ComparisonResult>& results) {
    std::vector<LaboratoryData> all(job.items.size() * job.rounds.size());
    for (const engine::ComparisonResult& result : results) {
        all[result.item * job.rounds.size() + result.round].results.push_back(&result);
    }
    for (std::size_t at = 0; at < all.size(); ++at) {
        LaboratoryData& data = all[at];
        data.item = &job.items[at / job.rounds.size()];
        data.round = job.rounds[at % job.rounds.size()];
        data.where = place_of(job, *data.item, data.round);
        std::stable_sort(data.results.begin(), data.results.end(),
                         [](const auto* a, const auto* b) { return a->participant < b->participant; });
        data.x.resize(static_cast<Eigen::Index>(data.size()));
        data.u = Eigen::VectorXd::Zero(data.x.size());
        for (std::size_t i = 0; i < data.size(); ++i) {
            data.x[static_cast<Eigen::Index>(i)] = data.results[i]->value;
            if (data.results[i]->uncertainty) {
                data.u[static_cast<Eigen::Index>(i)] = data.results[i]->uncertainty->u;
            }
        }
    }
    std::erase_if(all, [](const LaboratoryData& data) { return data.results.empty(); });
    return all;
}

void relate_results(const engine::ComparisonJob& job, LaboratoryData& data,
                    std::vector<reports::SharedSource>& shared) {
    find_contributing(job, data);
    data.covariance = laboratory_covariance(job, data, shared, data.ambiguous_sources);
    if (data.covariance.size() > 0) {
        at_place(data.where, [&] { gum::require_results(data.at(data.with_u())); });
    }
}

}  // namespace gumcert::app
