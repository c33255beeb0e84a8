#include "reports/record/make/rotary_table/rotary_monte_carlo_record.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/trials/rotary_table_trials.h"
#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/rotary_table/document_units.h"
#include "reports/record/stated_values.h"
#include "text/degrees_of_freedom.h"

namespace gumcert::reports {

namespace {

using TrialPlace = reports::StatedPlace<reports::StatedValue>;
using reports::StatedGroup;

/// Which output of the trials a stated value is; none where they hold none for it.
/// \param position  among the stated values of the table, where the error motions come first as in the outputs
std::optional<Eigen::Index> output_of(const TrialPlace& place, std::size_t position,
                                      const gum::RotaryTableResult& result) {
    const engine::ReportedQuantities& quantities = result.solution.quantities;
    const auto derived = static_cast<Eigen::Index>(quantities.outputs.size());
    const engine::TableParameters& parameters = *result.parameter_model->parameters();
    const auto index = static_cast<Eigen::Index>(place.index);
    switch (place.group) {
        case StatedGroup::error_motions:
            return quantities.errors + static_cast<Eigen::Index>(position);
        case StatedGroup::reversal:
            return quantities.reversal + index;
        case StatedGroup::ranges:
            return derived + parameters.layout().ranges + index;
        case StatedGroup::axis_line:
            return derived + parameters.layout().axis_line + index;
        case StatedGroup::location_errors:
            return std::nullopt;
        case StatedGroup::positioning:
            break;
    }
    const std::vector<std::string>& names = parameters.short_names();
    const auto found = std::find(names.begin() + parameters.layout().positioning, names.end(), place.name);
    return derived + (found - names.begin());
}

/// "EXA at 30°", "range of EXA", "axis_y".
std::string quantity_name(const TrialPlace& place, const reports::RotaryTable& rotary) {
    switch (place.group) {
        case StatedGroup::error_motions:
            return place.name + " at " + rotary.errors[place.index].angle_deg.text + "°";
        case StatedGroup::reversal:
            return "reversal of " + place.name;
        case StatedGroup::ranges:
            return "range of " + place.name;
        default:
            return place.name;
    }
}

}  // namespace

void fill_monte_carlo(reports::EvaluationRecord& record, const jobs::RotaryTableJob& job,
                      const gum::RotaryTableResult& result) {
    const gum::RotaryTableMonteCarlo& monte_carlo = *result.monte_carlo;
    reports::RotaryTable& rotary = *record.rotary;
    const engine::ReportedQuantities& quantities = result.solution.quantities;
    reports::RotaryMonteCarlo summary;
    summary.trials = static_cast<std::int64_t>(monte_carlo.result.trials);
    summary.seed = static_cast<std::int64_t>(monte_carlo.result.seed);
    summary.most_steps = monte_carlo.most_steps;
    summary.mean_steps = monte_carlo.mean_steps;
    std::int64_t undecided = 0;
    std::int64_t law_stands = 0;
    std::int64_t hold_noise = 0;

    const auto of = [&](Eigen::Index output, const DocumentUnit& unit,
                        const std::string& name) -> std::optional<MonteCarloSummary> {
        const auto at = static_cast<std::size_t>(output);
        if (!monte_carlo.compared[at]) {
            ++hold_noise;
            return std::nullopt;
        }
        if (monte_carlo.law_stands[at]) {
            ++law_stands;
            return std::nullopt;
        }
        const auto scaled = [&unit](double value) { return value / unit.si; };
        const std::optional<gum::Validation>& validation = monte_carlo.validations[at];
        if (validation) {
            ++summary.compared;
            if (!validation->precise_enough) {
                ++undecided;
            } else if (validation->validated) {
                ++summary.validated;
            } else {
                summary.not_validated.push_back(name);
            }
        }
        return monte_carlo_summary(monte_carlo.result.outputs[at], *job.monte_carlo,
                                   {monte_carlo.result.trials, monte_carlo.result.stabilised}, {scaled, scaled},
                                   validation);
    };

    const reports::StatedPlaces places = reports::stated_values(rotary);
    const auto fill = [&](bool error_motions) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const TrialPlace& place = places[i];
            if ((place.group == reports::StatedGroup::error_motions) == error_motions) {
                if (const auto output = output_of(place, i, result)) {
                    place.stated.monte_carlo = of(*output, unit_of(place.unit), quantity_name(place, rotary));
                }
            }
        }
    };
    fill(true);
    for (std::size_t i = 0; i < record.results.size(); ++i) {
        const Eigen::Index output = quantities.set_up + static_cast<Eigen::Index>(i);
        record.results[i].monte_carlo =
            of(output, unit_of(quantities.outputs[static_cast<std::size_t>(output)]), record.results[i].name);
    }
    fill(false);

    summary.statement =
        "Every input was drawn from its own distribution and the adjustment was solved again, with the exact "
        "kinematics, in each of " +
        std::to_string(summary.trials) + " trials; every trial converged, in " +
        gum::round_to_quantum(summary.mean_steps, 1) + " steps on average and " + std::to_string(summary.most_steps) +
        " at most.";
    for (const engine::VarianceComponent& component : result.solution.components) {
        if (component.used && component.estimated &&
            component.degrees_of_freedom <= engine::RotaryTableTrials::k_least_degrees_of_freedom) {
            summary.statement += " The variance of the component \"" + component.name + "\" is estimated with " +
                                 text::degrees_of_freedom(gum::round_significant(component.degrees_of_freedom, 2)) +
                                 ", and was not drawn: the trials took its estimate as known.";
        }
    }
    if (law_stands > 0) {
        summary.statement += " For " + std::to_string(law_stands) +
                             " quantities, which contain such a component, no Monte Carlo comparison is stated: their "
                             "U is that of the law of propagation.";
    }
    if (hold_noise > 0) {
        summary.statement +=
            " For " + std::to_string(hold_noise) +
            " quantities that are an extreme of deviations or rest on their scatter, ranges among them, nothing of "
            "Monte "
            "Carlo is stated: the deviations hold the noise already, and trials would add it once more.";
    }
    if (summary.compared > 0) {
        const auto contradicted = static_cast<std::int64_t>(summary.not_validated.size());
        summary.statement += " Of " + std::to_string(summary.compared) + " quantities the law of propagation is " +
                             "validated for " + std::to_string(summary.validated) + " (JCGM 101:2008, clause 8, to " +
                             (job.monte_carlo->digits == 1 ? "one significant digit" : "two significant digits") +
                             " of u)";
        if (contradicted > 0) {
            summary.statement +=
                ", and not for " + std::to_string(contradicted) + ": their coverage interval is that of Monte Carlo";
        }
        if (undecided > 0) {
            summary.statement += "; for " + std::to_string(undecided) +
                                 " the trials are too few to decide at the stated number of digits";
        }
        summary.statement += ".";
    }
    if (result.validation_failed) {
        const auto contradicted = summary.not_validated.size();
        record.diagnostics.push_back(
            {"GC-VALIDATION-0001", "validation of the law of propagation",
             "not validated for " + std::to_string(contradicted) + " of " + std::to_string(summary.compared) +
                 " quantities, and not decided for " + std::to_string(undecided + law_stands),
             "the job demands that Monte Carlo confirms every expanded uncertainty (JCGM 101:2008, clause 8)",
             law_stands > 0 ? "measure more visits of the table, so that every variance is estimated with more than 4 "
                              "degrees of freedom, or state it"
             : undecided > 0
                 ? "state more trials; use the Monte Carlo intervals of the quantities that are not validated"
                 : "use the Monte Carlo intervals of the quantities that are not validated",
             gum::Severity::warning});
    }
    rotary.monte_carlo = std::move(summary);
}

}  // namespace gumcert::reports
