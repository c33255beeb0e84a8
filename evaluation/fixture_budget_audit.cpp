#include "evaluation/fixture_budget_audit.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "audit/sources/record_subject.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "reports/record/make/rotary_table/fixture_budget_record.h"
#include "reports/record/make/rotary_table/reference_comparison.h"
#include "reports/record/make/rotary_table/rotary_table_record.h"

namespace gumcert::evaluation {

namespace {

using audit::AuditedBudget;
using audit::AuditedRow;
using audit::RowFactors;

void scale_input(gum::BudgetInput& input, const AuditedRow& row, double factor) {
    for (std::size_t c = 0; c < input.components.size(); ++c) {
        if (row.part_of.empty() || row.component == c) {
            input.components[c] = gum::with_scaled_uncertainty(std::move(input.components[c]), factor);
        }
    }
}

/// The measurement with other uncertainties of its fixture, each evaluated once.
class CorrectedMeasurements {
public:
    CorrectedMeasurements(const jobs::RotaryTableJob& job, std::vector<AuditedBudget> coordinates, bool by_trials,
                          unsigned threads)
        : job_(job), coordinates_(std::move(coordinates)), threads_(threads) {
        if (!by_trials) {
            job_.monte_carlo.reset();
        }
    }

    /// \param compared_point  as of audit::subject_of()
    /// \return the budgets of results and of the sides of the comparison
    const std::vector<AuditedBudget>& of(const RowFactors& factors, std::optional<std::size_t> compared_point) {
        const auto known = known_.find(factors);
        return known != known_.end() ? known->second
                                     : known_.emplace(factors, evaluated(factors, compared_point)).first->second;
    }

private:
    jobs::RotaryTableJob job_;
    std::vector<AuditedBudget> coordinates_;
    unsigned threads_;
    std::map<RowFactors, std::vector<AuditedBudget>> known_;

    [[nodiscard]] std::vector<AuditedBudget> evaluated(const RowFactors& factors,
                                                       std::optional<std::size_t> compared_point) const {
        jobs::RotaryTableJob job = job_;
        gum::Budget in_order = *job.fixture_budget;
        in_order.points = gum::in_order_of_coordinates(std::move(in_order.points), job.measurement.reflectors,
                                                       job.fixture_budget_file);
        std::optional<gum::Budget> scaled = with_scaled_uncertainties(std::move(in_order), coordinates_, factors);
        if (!scaled) {
            return {};
        }
        job.fixture_budget = std::make_shared<const gum::Budget>(std::move(*scaled));
        const gum::RotaryTableResult result = gum::evaluate_rotary_table(job, threads_);
        reports::RotaryRecordParts parts;
        if (result.contact_point) {
            parts.comparison = reports::reference_comparison(job, *result.contact_point);
        }
        return audit::subject_of(reports::rotary_table_record(job, result, parts, {}, ""), "", compared_point).budgets;
    }
};

/// Results, and the laboratory's side of the comparison.
bool rests_on_fixture(const AuditedBudget& budget) {
    return budget.place.starts_with("/results/") || budget.place == "/comparison/method_budget";
}

void name_after_fixture(AuditedBudget& budget, const std::string& file) {
    budget.name = "fixture, " + budget.name;
    budget.place = file + "#" + budget.place;
    for (AuditedRow& row : budget.rows) {
        row.place = file + "#" + row.place;
    }
}

}  // namespace

std::optional<gum::Budget> with_scaled_uncertainties(gum::Budget budget, const std::vector<AuditedBudget>& rows,
                                                     const RowFactors& factors) {
    for (std::size_t p = 0; p < budget.points.size(); ++p) {
        std::vector<std::pair<std::size_t, gum::BudgetInput>>& of_point = budget.points[p].inputs;
        for (std::size_t r = 0; r < rows[p].rows.size(); ++r) {
            const AuditedRow& row = rows[p].rows[r];
            if (factors[p][r] == 1.0) {
                continue;
            }
            const auto input = std::find_if(budget.inputs.begin(), budget.inputs.end(),
                                            [&row](const gum::BudgetInput& one) { return one.name == row.input; });
            if (input == budget.inputs.end()) {
                return std::nullopt;
            }
            const auto position = static_cast<std::size_t>(input - budget.inputs.begin());
            auto own = std::find_if(of_point.begin(), of_point.end(),
                                    [position](const auto& stated) { return stated.first == position; });
            if (own == of_point.end()) {
                own = of_point.insert(of_point.end(), {position, *input});
            }
            scale_input(own->second, row, factors[p][r]);
        }
    }
    return budget;
}

std::function<void(audit::AuditSubject&)> audit_of_fixture_budget(const jobs::RotaryTableJob& job,
                                                                  const gum::FixtureUncertainty& fixture,
                                                                  const reports::EvaluationRecord& record,
                                                                  unsigned threads) {
    const std::string file = job.fixture_budget_file;
    std::vector<AuditedBudget> coordinates =
        audit::subject_of(reports::record_of_fixture_budget(job, fixture, record.job_files), file).budgets;
    const bool by_trials = std::any_of(record.results.begin(), record.results.end(), [](const reports::Result& result) {
        return result.reported.method == "monte_carlo";
    });
    auto measurements = std::make_shared<CorrectedMeasurements>(job, coordinates, by_trials, threads);
    for (AuditedBudget& coordinate : coordinates) {
        name_after_fixture(coordinate, file);
    }
    return [measurements, coordinates](audit::AuditSubject& subject) {
        audit::NestedBudgets nested{
            .first = subject.budgets.size(), .count = coordinates.size(), .dependent = {}, .evaluate_again = {}};
        std::optional<std::size_t> compared_point;
        for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
            if (rests_on_fixture(subject.budgets[i])) {
                nested.dependent.push_back(i);
            }
            if (subject.budgets[i].reference) {
                compared_point = subject.budgets[i].reference->point;
            }
        }
        nested.evaluate_again = [measurements, compared_point, count = subject.budgets.size(),
                                 dependent = nested.dependent](const RowFactors& factors) {
            const std::vector<AuditedBudget>& all = measurements->of(factors, compared_point);
            std::vector<AuditedBudget> again;
            for (const std::size_t position : dependent) {
                if (all.size() == count) {
                    again.push_back(all[position]);
                }
            }
            return again;
        };
        subject.budgets.insert(subject.budgets.end(), coordinates.begin(), coordinates.end());
        subject.nested = std::move(nested);
    };
}

}  // namespace gumcert::evaluation
