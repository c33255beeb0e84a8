#include "reports/record/make/rotary_table/table_parameter_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/rotary_table/document_units.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

// Runs of each sense that ISO 230-2 asks for; fewer give its parameters with less to rest on.
constexpr std::size_t k_runs_of_the_standard = 5;

reports::TableParameter parameter_of(const engine::TableParameters& parameters,
                                     const gum::UncertaintyBudget& propagation, Eigen::Index index) {
    const auto at = static_cast<std::size_t>(index);
    return table_parameter(propagation, index, unit_of(parameters.outputs()[at]), parameters.short_names()[at],
                           parameters.descriptions()[at]);
}

/// Smallest and largest number of runs of one sense over the targets that have any.
std::pair<std::size_t, std::size_t> run_counts(const std::vector<std::vector<Eigen::Index>>& runs) {
    std::pair<std::size_t, std::size_t> counts{std::numeric_limits<std::size_t>::max(), 0};
    for (const std::vector<Eigen::Index>& of_target : runs) {
        counts.first = std::min(counts.first, of_target.size());
        counts.second = std::max(counts.second, of_target.size());
    }
    return counts.second == 0 ? std::pair<std::size_t, std::size_t>{0, 0} : counts;
}

reports::PositioningTarget target_of(double angle_deg, const engine::PositioningTarget& from, double u) {
    reports::PositioningTarget target;
    target.angle_deg = {angle_deg, text::shortest(angle_deg)};
    const auto shown = [u](const std::optional<double>& si) -> Shown<std::optional<double>> {
        if (!si) {
            return {};
        }
        const double value = *si / k_arcsec.si;
        // Digits down to those of the uncertainty of one deviation.
        return {value, u > 0.0 ? gum::round_to_uncertainty(value, u, 2).value : gum::round_significant(value, 3)};
    };
    target.mean_up = shown(from.mean_up);
    target.mean_down = shown(from.mean_down);
    target.s_up = shown(from.s_up);
    target.s_down = shown(from.s_down);
    target.reversal = shown(from.reversal);
    return target;
}

reports::PositioningAccuracy positioning_of(const engine::TableParameterModel& model,
                                            const engine::RotaryTableMeasurement& measurement,
                                            const gum::UncertaintyBudget& propagation,
                                            const gum::PositioningScope& scope) {
    const engine::TableParameters& parameters = *model.parameters();
    const engine::TableParameterLayout& layout = parameters.layout();
    reports::PositioningAccuracy accuracy;
    const auto [least_up, most_up] = run_counts(parameters.runs().up);
    const auto [least_down, most_down] = run_counts(parameters.runs().down);
    accuracy.runs_up = static_cast<std::int64_t>(least_up);
    accuracy.runs_down = static_cast<std::int64_t>(least_down);
    for (Eigen::Index i = layout.positioning; i < layout.positioning + layout.positioning_count; ++i) {
        if (scope.states(parameters.short_names()[static_cast<std::size_t>(i)])) {
            accuracy.parameters.push_back(parameter_of(parameters, propagation, i));
        }
    }
    accuracy.u_deviation = shown_significant(scope.u_deviation / k_arcsec.si, 2);
    const engine::PositioningAccuracy positioning = model.positioning();
    for (std::size_t i = 0; i < positioning.targets.size(); ++i) {
        const engine::PositioningTarget& from = positioning.targets[i];
        accuracy.targets.push_back(target_of(measurement.angles_deg[i], from, accuracy.u_deviation.number));
    }
    accuracy.remarks.push_back(
        "One pass of the table at one station is one run. The deviation of a run is the axial rotation of the table in "
        "that run, found from the distances of the run with everything else as adjusted.");
    const double share = scope.s_runs > 0.0 ? std::pow(scope.u_deviation / scope.s_runs, 2) : 0.0;
    if (scope.s_runs > 0.0) {
        accuracy.remarks.push_back("Standard uncertainty of one deviation: " + accuracy.u_deviation.text +
                                   " ″; standard deviation of the runs at one target (rms): " +
                                   gum::round_significant(scope.s_runs / k_arcsec.si, 2) + " ″.");
    }
    if (!scope.stated) {
        accuracy.remarks.push_back(
            "No parameter is stated: the uncertainty of one deviation is more than " +
            gum::percent(scope.largest_ratio) +
            " % of the range of the mean deviations, and the largest of many uncertain deviations says nothing of the "
            "table. Measure several reflectors at every visit of an angle.");
    } else if (!scope.scatter_stated) {
        accuracy.remarks.push_back("R and A are not stated: " + gum::percent(std::min(share, 1.0)) +
                                   " % of the variance of the runs comes from the measurement and not from the table. "
                                   "The variance components state the repeatability of the table.");
    } else if (scope.s_runs > 0.0) {
        accuracy.remarks.push_back(
            "R and A hold the scatter of the measurement, " + gum::percent(share) +
            " % of the variance of the runs: the table is not worse than they say. Monte Carlo would add that scatter "
            "a second time; it is not stated for them.");
    }
    if (scope.stated && positioning[engine::PositioningParameter::reversal]) {
        const std::string percent = gum::percent(std::min(scope.reversal_share, 1.0));
        accuracy.remarks.push_back(
            scope.reversal_stated
                ? "B holds the scatter of the measurement, " + percent +
                      " % of the variance of the reversals about their mean: the table is not worse than it says."
                : "B is not stated: " + percent +
                      " % of the variance of the reversals about their mean comes from the measurement and not from "
                      "the "
                      "table, and the largest of them grows with it. B_mean states the reversal.");
    }
    const bool one_sense = most_up == 0 || most_down == 0;
    if (one_sense) {
        accuracy.remarks.push_back("The angles were approached in one sense only: there are no bidirectional values.");
    }
    const std::size_t least = one_sense ? std::max(least_up, least_down) : std::min(least_up, least_down);
    if (least < k_runs_of_the_standard) {
        accuracy.remarks.push_back("ISO 230-2 asks for five runs of each sense; there are " + std::to_string(least) +
                                   " at the target with the fewest.");
    }
    return accuracy;
}

}  // namespace

reports::TableParameter table_parameter(const gum::UncertaintyBudget& propagation, Eigen::Index index,
                                        const DocumentUnit& unit, const std::string& name,
                                        const std::string& description) {
    return {.name = name,
            .description = description,
            .unit = unit.record,
            .stated = stated_value(propagation, index, unit)};
}

void fill_table_parameters(reports::RotaryTable& rotary, const engine::TableParameterModel& model,
                           const engine::RotaryTableMeasurement& measurement, const gum::UncertaintyBudget& parameters,
                           const gum::PositioningScope& scope) {
    const engine::TableParameters& from = *model.parameters();
    const engine::TableParameterLayout& layout = from.layout();
    for (std::size_t c = 0; c < 6; ++c) {
        const Eigen::Index index = layout.ranges + static_cast<Eigen::Index>(c);
        rotary.ranges.push_back(
            {.name = rotary.error_names[c],
             .stated = stated_value(parameters, index, unit_of(from.outputs()[static_cast<std::size_t>(index)]))});
    }
    for (Eigen::Index i = 0; i < 4; ++i) {
        rotary.axis_line.push_back(parameter_of(from, parameters, layout.axis_line + i));
    }
    if (layout.positioning_count > 0) {
        rotary.iso230_2 = positioning_of(model, measurement, parameters, scope);
    }
}

}  // namespace gumcert::reports
