#include "reports/record/make/rotary_table/rotary_monte_carlo_record.h"

#include <algorithm>
#include <string>
#include <vector>

#include "engine/rotary_table_trials.h"
#include "gum/rotary_table/positioning_scope.h"
#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/rotary_table/document_units.h"

namespace gumcert::reports {

void fill_monte_carlo(reports::EvaluationRecord& record, const engine::RotaryTableJob& job,
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

    const auto of = [&](Eigen::Index output, const DocumentUnit& unit, const std::string& name) {
        const auto at = static_cast<std::size_t>(output);
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

    Eigen::Index next = quantities.errors;
    for (reports::ErrorsAtAngle& row : rotary.errors) {
        for (std::size_t c = 0; c < 6; ++c, ++next) {
            row.errors[c].monte_carlo =
                of(next, c < 3 ? k_um : k_arcsec, rotary.error_names[c] + " at " + row.printed_angle + "°");
        }
    }
    for (std::size_t i = 0; i < record.results.size(); ++i) {
        const Eigen::Index output = quantities.set_up + static_cast<Eigen::Index>(i);
        record.results[i].monte_carlo =
            of(output, unit_of(quantities.outputs[static_cast<std::size_t>(output)]), record.results[i].name);
    }
    for (std::size_t c = 0; c < rotary.reversal.size(); ++c) {
        rotary.reversal[c].value.monte_carlo = of(quantities.reversal + static_cast<Eigen::Index>(c),
                                                  c < 3 ? k_um : k_arcsec, "reversal of " + rotary.reversal[c].name);
    }
    const auto first = static_cast<Eigen::Index>(quantities.outputs.size());
    const engine::TableParameterLayout& layout = result.parameter_model->parameters()->layout();
    const auto parameter_unit = [&](const reports::TableParameter& parameter) -> const DocumentUnit& {
        return parameter.unit == k_um.record ? k_um : k_arcsec;
    };
    for (std::size_t c = 0; c < rotary.ranges.size(); ++c) {
        rotary.ranges[c].monte_carlo = of(first + layout.ranges + static_cast<Eigen::Index>(c), c < 3 ? k_um : k_arcsec,
                                          "range of " + rotary.ranges[c].name);
    }
    for (std::size_t i = 0; i < rotary.axis_line.size(); ++i) {
        reports::TableParameter& parameter = rotary.axis_line[i];
        parameter.monte_carlo =
            of(first + layout.axis_line + static_cast<Eigen::Index>(i), parameter_unit(parameter), parameter.name);
    }
    const std::vector<std::string>& names = result.parameter_model->parameters()->short_names();
    for (std::size_t i = 0; rotary.iso230_2 && i < rotary.iso230_2->parameters.size(); ++i) {
        reports::TableParameter& parameter = rotary.iso230_2->parameters[i];
        if (!gum::rests_on_scatter(parameter.name)) {
            const auto found = std::find(names.begin() + layout.positioning, names.end(), parameter.name);
            parameter.monte_carlo = of(first + (found - names.begin()), parameter_unit(parameter), parameter.name);
        }
    }

    summary.statement =
        "Every input was drawn from its own distribution and the adjustment was solved again, with the exact "
        "kinematics, in each of " +
        std::to_string(summary.trials) + " trials; every trial converged, in " +
        gum::round_to_quantum(summary.mean_steps, 1) + " steps on average and " + std::to_string(summary.most_steps) +
        " at most.";
    for (const engine::VarianceComponent& component : result.solution.components) {
        if (component.used && component.estimated &&
            component.degrees_of_freedom <= engine::RotaryTableTrials::k_least_degrees_of_freedom) {
            summary.statement += " The component \"" + component.name +
                                 "\" is too small for its variance to be told from the residuals; it was drawn as "
                                 "normal with its estimate.";
        }
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
                 " quantities, and not decided for " + std::to_string(undecided),
             "the job demands that Monte Carlo confirms every expanded uncertainty (JCGM 101:2008, clause 8)",
             undecided > 0 ? "state more trials; use the Monte Carlo intervals of the quantities that are not validated"
                           : "use the Monte Carlo intervals of the quantities that are not validated",
             gum::Severity::warning});
    }
    rotary.monte_carlo = std::move(summary);
}

}  // namespace gumcert::reports
