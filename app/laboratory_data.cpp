#include "app/laboratory_data.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/evaluate_budget.h"
#include "app/laboratory_covariance.h"
#include "app/shared_sources.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

namespace {

[[noreturn]] void refuse(const std::string& code, const std::string& where, const std::string& what,
                         const std::string& rule, const std::string& action) {
    throw gum::InputError(gum::Diagnostic{.code = code, .where = where, .what = what, .rule = rule, .action = action});
}

/// Value, uncertainty and sources of a result from its budget.
void take_over(const BudgetResult& budget, double coverage_probability, const gum::Unit& unit,
               engine::ComparisonResult& result) {
    const std::string where = result.where + " (" + result.budget_file + ")";
    if (budget.points.size() != 1 || budget.output_names.size() != 1) {
        refuse("GC-COMPARE-0110", where,
               std::to_string(budget.points.size() * budget.output_names.size()) + " results in the budget",
               "a budget stands for one result of a participant",
               "Leave one output and no table of points in the budget.");
    }
    if (!(budget.output_units.front().dimension() == unit.dimension()) ||
        budget.output_units.front().is_celsius_temperature() != unit.is_celsius_temperature()) {
        refuse("GC-COMPARE-0110", where, "the budget gives a value in " + budget.output_units.front().text(),
               "the item is compared in " + unit.text(), "Correct the unit of the item, or the budget.");
    }
    const BudgetPointResult& point = budget.points.front();
    const BudgetOutputResult& output = point.outputs.front();
    if (!output.coverage_factor || !output.expanded_uncertainty || !(output.standard_uncertainty > 0.0)) {
        refuse("GC-COMPARE-0111", where, "the budget gives no expanded uncertainty",
               "a result is compared with its uncertainty", "Evaluate the budget alone and see what it says.");
    }
    engine::ResultUncertainty uncertainty;
    uncertainty.u = unit.difference_from_si(output.standard_uncertainty);
    uncertainty.degrees_of_freedom = output.degrees_of_freedom;
    uncertainty.k = *output.coverage_factor;
    if (output.coverage_probability != coverage_probability) {
        if (!(output.degrees_of_freedom > 0.0)) {
            refuse("GC-COMPARE-0111", where, "the budget has no degrees of freedom",
                   "its coverage probability is not that of the comparison",
                   "State the coverage probability of the comparison in the budget.");
        }
        uncertainty.k = gum::coverage_factor(coverage_probability, output.degrees_of_freedom);
    }
    uncertainty.U = uncertainty.k * uncertainty.u;
    result.uncertainty = uncertainty;
    result.value = unit.from_si(point.propagation.value(0));
}

void tell(const std::function<void(const std::string&)>& progress, const std::string& text) {
    if (progress) {
        progress(text);
    }
}

std::string place_of(const engine::ComparisonJob& job, const engine::ComparisonItem& item, const std::string& round) {
    std::string place = job.items.size() > 1 || !item.id.empty() ? "item \"" + item.id + "\"" : "item";
    return round.empty() ? place : place + ", round \"" + round + "\"";
}

/// The reference laboratory apart, those that are left out aside.
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
        refuse("GC-COMPARE-0106", data.where,
               "participant \"" + request.participant + "\" has no result" +
                   (data.reference ? " with an uncertainty" : ""),
               "the assigned value is the result of this participant", "State it, or take another assigned value.");
    }
}

}  // namespace

bool LaboratoryData::all_have_u(const std::vector<std::size_t>& positions) const {
    return std::all_of(positions.begin(), positions.end(), [&](std::size_t i) { return has_u(i); });
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

std::vector<engine::ComparisonResult> results_with_budgets(const engine::ComparisonJob& job, unsigned threads,
                                                           const std::function<void(const std::string&)>& progress) {
    std::vector<engine::ComparisonResult> results = job.results;
    for (engine::ComparisonResult& result : results) {
        if (result.budget == nullptr) {
            continue;
        }
        tell(progress, "budget " + result.budget_file);
        const gum::Unit& unit = job.items[result.item].unit;
        const BudgetResult budget = evaluate_budget(*result.budget, threads, {});
        take_over(budget, job.coverage_probability, unit, result);
        std::vector<engine::UncertaintySource> sources = uncertainty_sources(*result.budget, budget, 0, 0, unit);
        result.sources.insert(result.sources.end(), sources.begin(), sources.end());
    }
    return results;
}

std::vector<LaboratoryData> laboratory_data(const engine::ComparisonJob& job,
                                            const std::vector<engine::ComparisonResult>& results,
                                            std::vector<reports::SharedSource>& shared) {
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
    for (LaboratoryData& data : all) {
        find_contributing(job, data);
        data.covariance = laboratory_covariance(job, data, shared, data.ambiguous_sources);
        if (data.covariance.size() > 0) {
            std::vector<std::size_t> with_u;
            for (std::size_t i = 0; i < data.size(); ++i) {
                if (data.has_u(i)) {
                    with_u.push_back(i);
                }
            }
            at_item(data.where, [&] { gum::require_results(data.at(with_u)); });
        }
    }
    return all;
}

void at_item(const std::string& where, const std::function<void()>& work) {
    const auto placed = [&](std::vector<gum::Diagnostic> problems) {
        for (gum::Diagnostic& problem : problems) {
            if (!problem.where.starts_with(where)) {
                problem.where = where + ", " + problem.where;
            }
        }
        return problems;
    };
    try {
        work();
    } catch (const gum::InputError& refused) {
        throw gum::InputError(placed(refused.diagnostics()));
    } catch (const gum::NoResultError& failed) {
        throw gum::NoResultError(placed(failed.diagnostics()));
    }
}

}  // namespace gumcert::app
