#include "reports/record/make/budget/budget_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "gum/analysis_of_variance.h"
#include "gum/budget/budget_model.h"
#include "gum/outlying_readings.h"
#include "gum/rounding.h"
#include "gum/type_a.h"
#include "reports/record/make/budget/budget_texts.h"
#include "reports/record/make/record_parts.h"

namespace gumcert::reports {

namespace {

using gum::BudgetInput;
using gum::StatedQuantity;
using jobs::BudgetJob;

constexpr double k_test_level = 0.05;  // of the F test
constexpr std::size_t k_longest_lag_list = 100;

/// A statement of readings, and where it is in force.
struct Stated {
    const BudgetInput& input;
    const StatedQuantity& quantity;
    std::string point;  ///< "" for the statement of the job
};

/// In the unit of the input, so that what is printed can be checked by hand.
std::vector<double> in_unit(const BudgetInput& input, const std::vector<double>& si) {
    std::vector<double> values;
    values.reserve(si.size());
    for (const double value : si) {
        values.push_back(input.unit.from_si(value));
    }
    return values;
}

/// The step of the display that a component of the input states, in the unit of the input; 0 without one.
double stated_resolution(const BudgetInput& input) {
    double step = 0.0;
    for (const StatedQuantity& component : input.components) {
        if (component.statement == "resolution") {
            step = std::max(step, 2.0 * input.unit.difference_from_si(component.distribution.scale));
        }
    }
    return step;
}

/// The scatter of readings beside the one that they are stated to have.
void add_pool(const Stated& stated, reports::ReadingsSummary& summary) {
    const double s = stated.input.unit.difference_from_si(*stated.quantity.pooled_standard_deviation);
    summary.pooled_standard_deviation = s;
    if (std::isfinite(stated.quantity.degrees_of_freedom)) {
        summary.pooled_degrees_of_freedom = stated.quantity.degrees_of_freedom;
    }
    if (summary.n >= 2) {
        // Readings between two steps of a display show one step or the other: a variance of n/(n - 1) q²/4 at most.
        const auto n = static_cast<double>(summary.n);
        const double step = stated_resolution(stated.input);
        const double of_steps = n / (n - 1.0) * 0.25 * step * step;
        const double variance = summary.standard_deviation.number * summary.standard_deviation.number;
        summary.pooled_F = std::max(0.0, variance - of_steps) / (s * s);
    }
}

reports::ReadingsSummary readings_summary(const Stated& stated) {
    const std::vector<double> readings = in_unit(stated.input, stated.quantity.observations);
    reports::ReadingsSummary summary;
    summary.input = stated.input.name;
    summary.component = stated.quantity.name;
    summary.unit = stated.input.unit.text();
    summary.point = stated.point;
    summary.observations = series_as_stated(readings, stated.quantity.observation_decimals);
    summary.n = static_cast<std::int64_t>(readings.size());
    summary.mean.number = readings.front();
    if (readings.size() >= 2) {
        const gum::ObservationSummary of = gum::evaluate_type_a(readings);
        summary.mean.number = of.mean;
        summary.standard_deviation.number = of.standard_deviation;
        // Where nothing is pooled, s/√n is what entered the budget.
        summary.standard_deviation_of_mean.number = stated.quantity.pooled_standard_deviation
                                                        ? of.standard_deviation_of_mean
                                                        : stated.input.unit.difference_from_si(stated.quantity.u);
        if (of.standard_deviation > 0.0) {
            const std::size_t lags = std::min(k_longest_lag_list, readings.size() / 4 + 1);
            summary.autocorrelation = gum::autocorrelation(readings, std::min(lags, readings.size() - 1));
            const gum::AutocorrelationCheck check = gum::autocorrelation_check(readings);
            summary.autocorrelation_limit.number = check.limit;
            summary.dependent = !check.independent;
            summary.printed_r1 = gum::round_to_quantum(check.lag_one, 2);
            summary.autocorrelation_limit.text = gum::round_to_quantum(check.limit, 2);
        }
    }
    if (stated.quantity.pooled_standard_deviation) {
        add_pool(stated, summary);
    }
    summary.mean.text = printed_estimate(summary.mean.number, summary.standard_deviation_of_mean.number);
    summary.standard_deviation.text = rounded(summary.standard_deviation.number, reports::k_digits_of_u);
    summary.standard_deviation_of_mean.text =
        rounded(summary.standard_deviation_of_mean.number, reports::k_digits_of_u);
    return summary;
}

gum::OneWayAnalysis analysis_of(const BudgetInput& input, const gum::GroupedReadings& from, double alpha) {
    if (!from.readings.empty()) {
        std::vector<std::vector<double>> groups;
        for (const std::vector<double>& group : from.readings) {
            groups.push_back(in_unit(input, group));
        }
        return gum::one_way_analysis(groups, alpha);
    }
    std::vector<gum::ObservationGroup> groups;
    for (std::size_t i = 0; i < from.means.size(); ++i) {
        groups.push_back({.observations = from.sizes[i],
                          .mean = input.unit.from_si(from.means[i]),
                          .standard_deviation = input.unit.difference_from_si(from.standard_deviations[i])});
    }
    return gum::one_way_analysis(groups, alpha);
}

reports::VarianceAnalysis variance_analysis(const Stated& stated) {
    const gum::OneWayAnalysis from = analysis_of(stated.input, *stated.quantity.groups, k_test_level);
    reports::VarianceAnalysis out;
    out.input = stated.input.name;
    out.component = stated.quantity.name;
    out.unit = stated.input.unit.text();
    out.point = stated.point;
    out.groups = static_cast<std::int64_t>(from.groups.size());
    out.readings = static_cast<std::int64_t>(from.observations);
    out.mean.number = from.mean_of_group_means;
    out.sum_of_squares_between = from.between.sum_of_squares;
    out.sum_of_squares_within = from.within.sum_of_squares;
    out.degrees_of_freedom_between = from.between.degrees_of_freedom;
    out.degrees_of_freedom_within = from.within.degrees_of_freedom;
    out.mean_square_between = from.between.mean_square;
    out.mean_square_within = from.within.mean_square;
    // A ratio to nothing is not a number that a record may hold; the largest one says the same.
    out.F.number = std::isfinite(from.ratio.f) ? from.ratio.f : std::numeric_limits<double>::max();
    out.p_value.number = from.ratio.p_value;
    out.F_critical.number = from.ratio.critical_value;
    out.r_squared = from.r_squared;
    out.standard_deviation_within.number = from.within_standard_deviation;
    out.standard_deviation_of_group_means.number = from.standard_deviation_of_group_means;
    out.standard_deviation_between.number = from.between_standard_deviation;
    out.u_with_between_effect = from.u_with_between_effect;
    out.u_without_between_effect = from.u_without_between_effect;
    out.conclusion = from.ratio.significant ? "significant" : "not significant";
    out.mean.text = printed_estimate(out.mean.number, out.u_with_between_effect);
    out.F.text = rounded(out.F.number, 3);
    out.F_critical.text = rounded(out.F_critical.number, 3);
    out.p_value.text = rounded(out.p_value.number, 2);
    out.standard_deviation_within.text = rounded(out.standard_deviation_within.number, reports::k_digits_of_u);
    out.standard_deviation_between.text = rounded(out.standard_deviation_between.number, reports::k_digits_of_u);
    out.standard_deviation_of_group_means.text =
        rounded(out.standard_deviation_of_group_means.number, reports::k_digits_of_u);
    out.printed_mean_square = {rounded(out.mean_square_between, 3), rounded(out.mean_square_within, 3)};
    return out;
}

void add_outliers(const Stated& stated, const char* of, std::size_t group, std::span<const double> readings,
                  reports::EvaluationRecord& record) {
    const double step = stated_resolution(stated.input);
    const std::vector<std::string> printed = series_as_stated(readings, stated.quantity.observation_decimals);
    for (const gum::OutlyingReading& found : gum::outlying_readings(readings, step)) {
        reports::OutlyingReading out;
        out.input = stated.input.name;
        out.component = stated.quantity.name;
        out.unit = stated.input.unit.text();
        out.point = stated.point;
        out.of = of;
        out.group = static_cast<std::int64_t>(group);
        out.position = static_cast<std::int64_t>(found.position + 1);
        out.n = static_cast<std::int64_t>(found.tested);
        out.value.number = found.value;
        out.G.number = found.G;
        out.p_value.number = found.p_value;
        out.value.text = printed[found.position];
        out.G.text = rounded(found.G, 3);
        out.p_value.text = printed_p_value(found.p_value);
        record.outliers.push_back(std::move(out));
    }
}

void add_statement(const Stated& stated, reports::EvaluationRecord& record) {
    if (!stated.quantity.observations.empty()) {
        record.readings.push_back(readings_summary(stated));
        add_outliers(stated, "observations", 0, in_unit(stated.input, stated.quantity.observations), record);
    }
    if (stated.quantity.groups) {
        const gum::GroupedReadings& groups = *stated.quantity.groups;
        record.variance_analyses.push_back(variance_analysis(stated));
        for (std::size_t i = 0; i < groups.readings.size(); ++i) {
            add_outliers(stated, "group", i + 1, in_unit(stated.input, groups.readings[i]), record);
        }
        add_outliers(stated, "group_means", 0, in_unit(stated.input, groups.means), record);
    }
}

/// Where a point takes a whole input over from the job (a specification that was read anew), its readings are those of
/// the job.
bool is_of_job(const BudgetInput& base, const StatedQuantity& quantity) {
    return std::any_of(base.components.begin(), base.components.end(),
                       [&](const StatedQuantity& own) { return own.where == quantity.where; });
}

}  // namespace

void add_readings(const BudgetJob& job, reports::EvaluationRecord& record) {
    for (std::size_t i = 0; i < job.inputs.size(); ++i) {
        const BudgetInput& base = job.inputs[i];
        // Statements of the job that hold somewhere, by their place.
        std::set<std::string> in_force;
        for (std::size_t p = 0; p < std::max<std::size_t>(job.points.size(), 1); ++p) {
            const std::optional<std::size_t> at = job.points.empty() ? std::nullopt : std::optional{p};
            for (const StatedQuantity& quantity : gum::input_at(job, i, at).components) {
                if (base.stated && is_of_job(base, quantity)) {
                    in_force.insert(quantity.where);
                }
            }
        }
        for (const StatedQuantity& quantity : base.components) {
            if (in_force.contains(quantity.where)) {
                add_statement({.input = base, .quantity = quantity, .point = ""}, record);
            }
        }
        for (std::size_t p = 0; p < job.points.size(); ++p) {
            const BudgetInput& own = gum::input_at(job, i, p);
            if (&own == &base) {
                continue;
            }
            for (const StatedQuantity& quantity : own.components) {
                if (!(base.stated && is_of_job(base, quantity))) {
                    add_statement({.input = own, .quantity = quantity, .point = job.points[p].name}, record);
                }
            }
        }
    }
}

}  // namespace gumcert::reports
