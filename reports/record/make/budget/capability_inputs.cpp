#include "reports/record/make/budget/capability_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gum/budget/budget_model.h"
#include "gum/monte_carlo/convolution.h"
#include "jobs/budget/budget_results.h"

namespace gumcert::reports {

namespace {

certificate::InputValues values_of(const jobs::BudgetJob& job, std::size_t input) {
    certificate::InputValues out{.unit = job.inputs[input].unit.text(), .values = {}};
    const auto add = [&](std::optional<std::size_t> point) {
        out.values.push_back(job.inputs[input].unit.from_si(gum::input_total(gum::input_at(job, input, point)).value));
    };
    if (job.points.empty()) {
        add(std::nullopt);
    }
    for (std::size_t p = 0; p < job.points.size(); ++p) {
        add(p);
    }
    return out;
}

/// P(Y ≤ x) and P(Y < x) of an output whose k comes from the convolution, x in its unit.
void add_convolution(const gum::BudgetPointResult& point, Eigen::Index output, const gum::Unit& unit,
                     const std::string& name, certificate::CapabilityInputs& inputs) {
    const auto terms = gum::convolution_terms(*point.model, point.propagation, output);
    if (!terms) {
        return;
    }
    const gum::ConvolutionDistribution distribution(*terms);
    const double centre = point.propagation.value(output);
    // A limit that is a possible value differs from it by roundings alone.
    constexpr double k_roundings = 8.0;
    const auto rounding = [centre](double x) {
        return k_roundings * std::numeric_limits<double>::epsilon() * std::max(std::abs(x), std::abs(centre));
    };
    inputs.distributions.emplace(name, [=](double x) {
        const double at = unit.to_si(x);
        return distribution(at - centre + rounding(at));
    });
    inputs.distributions_below.emplace(name, [=](double x) {
        const double at = unit.to_si(x);
        return distribution.below(at - centre - rounding(at));
    });
}

}  // namespace

certificate::CapabilityInputs capability_inputs(const jobs::BudgetJob& job, const gum::BudgetResult& result,
                                                unsigned threads) {
    certificate::CapabilityInputs inputs;
    inputs.rounding = job.rounding;
    for (std::size_t i = 0; i < job.inputs.size(); ++i) {
        inputs.values.emplace(job.inputs[i].name, values_of(job, i));
    }
    for (const certificate::PointColumn& column : job.point_columns) {
        if (column.unit.empty() || std::any_of(column.values.begin(), column.values.end(),
                                               [](const auto& value) { return !value.has_value(); })) {
            continue;
        }
        certificate::InputValues values{.unit = column.unit, .values = {}};
        for (const std::optional<double>& value : column.values) {
            values.values.push_back(*value);
        }
        inputs.values.emplace(column.name, std::move(values));  // those of inputs are there already
    }
    if (!job.certificate || job.certificate->specifications.empty()) {
        return inputs;
    }
    const std::vector<std::string> names = gum::budget_result_names(job, result);
    const std::size_t outputs = result.output_names.size();
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const gum::BudgetPointResult& point = result.points[p];
        for (std::size_t i = 0; i < outputs; ++i) {
            const std::string& name = names[p * outputs + i];
            const gum::Unit& unit = jobs::result_unit(job, p, result.output_names[i], result.output_units[i]);
            const auto output = static_cast<Eigen::Index>(i);
            if (point.outputs[i].by_monte_carlo && point.monte_carlo) {
                inputs.trials.emplace(name, gum::TrialsOfOutput{.model = point.model,
                                                                .output = output,
                                                                .unit = unit,
                                                                .seed = point.monte_carlo->seed,
                                                                .streams = point.streams,
                                                                .trials = point.outputs[i].trials,
                                                                .threads = threads});
            } else if (point.outputs[i].coverage == "convolution") {
                add_convolution(point, output, unit, name, inputs);
            }
        }
    }
    return inputs;
}

}  // namespace gumcert::reports
