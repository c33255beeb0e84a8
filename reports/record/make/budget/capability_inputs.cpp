#include "reports/record/make/budget/capability_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gum/budget/budget_model.h"
#include "gum/budget/other_choice.h"
#include "gum/monte_carlo/convolution.h"
#include "jobs/budget/budget_results.h"

namespace gumcert::reports {

namespace {

/// Whether a point states an input, which no equation may need: a nominal value.
bool is_stated_at(const jobs::BudgetJob& job, std::optional<std::size_t> point, std::size_t input) {
    return point &&
           std::ranges::any_of(job.points[*point].inputs, [&](const auto& stated) { return stated.first == input; });
}

certificate::InputValues values_of(const jobs::BudgetJob& job, const gum::BudgetResult& result, std::size_t input) {
    certificate::InputValues out{.unit = job.inputs[input].unit.text(), .values = {}};
    const auto value_at = [&](std::optional<std::size_t> point) {
        return job.inputs[input].unit.from_si(gum::input_total(gum::input_at(job, input, point)).value);
    };
    if (job.points.empty()) {
        out.values.emplace_back(value_at(std::nullopt));
        return out;
    }
    for (const gum::BudgetPointResult& point : result.points) {
        const bool is_used = !point.section || point.model->uses(input) || is_stated_at(job, point.point, input);
        if (point.point) {
            out.values.push_back(is_used ? std::optional(value_at(point.point)) : std::nullopt);
        } else if (is_used) {
            out.without_point = value_at(std::nullopt);
        }
    }
    return out;
}

/// What of an output comes from which input. One that a point states and the output does not rest on may be its nominal
/// value: it has no coefficient.
std::map<std::string, double> sensitivities_of(const jobs::BudgetJob& job, const gum::BudgetPointResult& point,
                                               Eigen::Index output) {
    std::map<std::string, double> all;
    const std::vector<gum::BudgetQuantity>& quantities = point.model->quantities();
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        const std::size_t input = quantities[q].symbol;
        if (input >= job.inputs.size() || !point.model->uses(input)) {
            continue;  // a parameter of a fit
        }
        const double c = point.propagation.jacobian(output, static_cast<Eigen::Index>(q));
        if (c != 0.0 || !is_stated_at(job, point.point, input)) {
            all[job.inputs[input].name] = c;
        }
    }
    return all;
}

/// A column of numbers, where every point of a section has one, or none.
std::optional<certificate::InputValues> values_of(const jobs::BudgetJob& job, const certificate::PointColumn& column) {
    if (column.unit.empty()) {
        return std::nullopt;
    }
    std::map<std::size_t, std::size_t> stated;  // by section
    for (std::size_t p = 0; p < column.values.size(); ++p) {
        stated[gum::section_of_point(job, p).value_or(0)] += column.values[p] ? 1U : 0U;
    }
    for (const auto& [section, count] : stated) {
        const std::size_t all = job.sections.empty() ? column.values.size() : job.sections[section].points;
        if (count != all && (count > 0 || job.sections.empty())) {
            return std::nullopt;
        }
    }
    return certificate::InputValues{.unit = column.unit, .values = column.values};
}

/// The distribution of an output by the convolution of its contributions, x in its unit.
certificate::ResultDistribution convolved(const gum::MeasurementModel& model, const gum::Propagation& propagation,
                                          Eigen::Index output, const gum::Unit& unit) {
    const auto terms = gum::convolution_terms(model, propagation, output);
    if (!terms) {
        return {};
    }
    const gum::ConvolutionDistribution distribution(*terms);
    const double centre = propagation.value(output);
    if (!distribution.has_single_values()) {
        return {.function = [=](double x) { return distribution(unit.to_si(x) - centre); },
                .below = {},
                .least_probability = distribution.least_probability(),
                .draws = distribution.draws()};
    }
    // A limit that is a possible value differs from it by roundings alone. Of other distributions the same roundings would
    // move a limit, where u is small against the value.
    constexpr double k_roundings = 8.0;
    const auto rounding = [centre](double x) {
        return k_roundings * std::numeric_limits<double>::epsilon() * std::max(std::abs(x), std::abs(centre));
    };
    return {.function =
                [=](double x) {
                    const double at = unit.to_si(x);
                    return distribution(at - centre + rounding(at));
                },
            .below =
                [=](double x) {
                    const double at = unit.to_si(x);
                    return distribution.below(at - centre - rounding(at));
                },
            .least_probability = distribution.least_probability(),
            .draws = distribution.draws()};
}

/// Whether the law of propagation gives a k of an output, and its distribution is another one than that of this k.
bool needs_convolution(const gum::BudgetPointResult& point, std::size_t output) {
    const std::string& coverage = point.outputs[output].coverage;
    return coverage == "convolution" ||
           ((coverage == "normal" || coverage == "student_t") &&
            !gum::is_normal_or_student(*point.model, point.propagation, static_cast<Eigen::Index>(output)));
}

/// Where documents print both values, and wherever the mean of the trials is in doubt.
std::optional<certificate::ModelValue> model_value(const gum::BudgetPointResult& point, std::size_t output,
                                                   const gum::Unit& unit) {
    constexpr double k_least_shift = 0.1;  // of u, from which on documents print both
    const gum::BudgetOutputResult& of = point.outputs[output];
    const double value = point.propagation.value(static_cast<Eigen::Index>(output));
    const bool is_in_doubt = gum::is_mean_in_doubt(point, output);
    const bool is_other = of.by_monte_carlo && of.has_u && of.monte_carlo &&
                          std::abs(of.monte_carlo->mean - value) > k_least_shift * of.monte_carlo->standard_uncertainty;
    return is_in_doubt || is_other
               ? std::optional(certificate::ModelValue{.value = unit.from_si(value), .is_in_doubt = is_in_doubt})
               : std::nullopt;
}

}  // namespace

certificate::CapabilityInputs capability_inputs(const jobs::BudgetJob& job, const gum::BudgetResult& result,
                                                unsigned threads) {
    certificate::CapabilityInputs inputs;
    inputs.rounding = job.rounding;
    for (std::size_t i = 0; i < job.inputs.size(); ++i) {
        inputs.values.emplace(job.inputs[i].name, values_of(job, result, i));
    }
    for (const certificate::PointColumn& column : job.point_columns) {
        if (auto values = values_of(job, column)) {
            inputs.values.emplace(column.name, std::move(*values));  // those of inputs are there already
        }
    }
    const bool is_decided = job.certificate && !job.certificate->specifications.empty();
    const bool has_scope = job.certificate && job.certificate->accreditation;
    if (!is_decided && !has_scope) {
        return inputs;
    }
    const std::vector<std::string> names = gum::budget_result_names(job, result);
    auto next = names.begin();
    for (const gum::BudgetPointResult& point : result.points) {
        std::shared_ptr<const gum::Propagation> propagation;
        for (std::size_t i = 0; i < point.outputs.size(); ++i) {
            const std::string& name = *next++;
            const gum::Unit& unit = jobs::result_unit(job, point, i);
            const auto output = static_cast<Eigen::Index>(i);
            if (has_scope) {
                inputs.sensitivities.emplace(name, sensitivities_of(job, point, output));
            }
            if (!is_decided) {
                continue;
            }
            if (const auto value = model_value(point, i, unit)) {
                inputs.at_estimates.emplace(name, *value);
            }
            if (point.outputs[i].by_monte_carlo && point.monte_carlo) {
                inputs.trials.emplace(name, gum::TrialsOfOutput{.model = point.model,
                                                                .output = output,
                                                                .unit = unit,
                                                                .seed = point.monte_carlo->seed,
                                                                .streams = point.streams,
                                                                .trials = point.outputs[i].trials,
                                                                .threads = threads});
            } else if (needs_convolution(point, i)) {
                if (!propagation) {  // one copy for all that ask it
                    propagation = std::make_shared<const gum::Propagation>(point.propagation);
                }
                inputs.distributions.emplace(name, [model = point.model, propagation, output, unit] {
                    return convolved(*model, *propagation, output, unit);
                });
            }
        }
    }
    return inputs;
}

}  // namespace gumcert::reports
