#include "app/evaluate_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "app/budget_coverage.h"
#include "app/record_parts.h"
#include "app/zero_uncertainty.h"

namespace gumcert::app {

namespace {

using engine::BudgetFit;
using Progress = std::function<void(const std::string&)>;
using engine::BudgetJob;
using gum::Diagnostic;

// Second-order terms are reported where they change the standard uncertainty by half a percent or the estimate by a
// hundredth of it, and warned about where they change what a document prints.
constexpr double k_reported_change = 0.005;
constexpr double k_reported_shift = 0.01;
constexpr double k_warned_change = 0.05;
constexpr double k_warned_shift = 0.1;
constexpr Eigen::Index k_most_inputs_of_second_order = 1000;  // the matrices of second derivatives grow with the square
constexpr std::size_t k_most_points_with_histogram = 4;       // documents draw no more
constexpr double k_numerical_errors = 5.0;                    // beyond doubt
constexpr double k_most_of_the_variance = 0.5;
constexpr double k_accepted_asymmetry = 0.02;  // of half the width: below what two digits of U show

/// The equation of a fit as the curve of the adjustment.
class EquationCurve final : public engine::Curve {
public:
    EquationCurve(gum::EquationSystem system, std::size_t parameters)
        : system_(std::move(system)), parameters_(static_cast<Eigen::Index>(parameters)) {
        std::vector<std::size_t> positions(parameters);
        for (std::size_t i = 0; i < parameters; ++i) {
            positions[i] = i;
        }
        linear_ = system_.is_affine_in(positions);
    }

    double evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& parameters, Eigen::VectorXd& by_parameter,
                    Eigen::VectorXd& by_x) const override {
        Eigen::VectorXd all(parameters_ + x.size());
        all << parameters, x;
        try {
            const Eigen::MatrixXd derivative = system_.jacobian(all);
            by_parameter = derivative.row(0).head(parameters_).transpose();
            by_x = derivative.row(0).tail(x.size()).transpose();
            return system_.evaluate(all)(0);
        } catch (const gum::NoResultError&) {  // the adjustment tries other parameters then
            by_parameter = Eigen::VectorXd::Zero(parameters_);
            by_x = Eigen::VectorXd::Zero(x.size());
            return std::numeric_limits<double>::quiet_NaN();
        }
    }
    [[nodiscard]] bool is_linear() const override { return linear_; }

private:
    gum::EquationSystem system_;
    Eigen::Index parameters_;
    bool linear_ = false;
};

/// True when one parameter is added to the curve as it is: R² is then taken about the mean.
bool has_intercept(const EquationCurve& curve, const engine::CurveData& data, Eigen::Index parameters) {
    Eigen::VectorXd by_parameter;
    Eigen::VectorXd by_x;
    const Eigen::VectorXd at = Eigen::VectorXd::Constant(parameters, 1.0);
    std::vector<bool> constant(static_cast<std::size_t>(parameters), true);
    Eigen::VectorXd first;
    for (Eigen::Index i = 0; i < data.x.rows(); ++i) {
        (void)curve.evaluate(data.x.row(i).transpose(), at, by_parameter, by_x);
        if (i == 0) {
            first = by_parameter;
        }
        for (Eigen::Index p = 0; p < parameters; ++p) {
            if (by_parameter(p) != first(p) || first(p) == 0.0) {
                constant[static_cast<std::size_t>(p)] = false;
            }
        }
    }
    return std::find(constant.begin(), constant.end(), true) != constant.end();
}

engine::CurveFit evaluate_fit(const BudgetFit& fit) {
    std::vector<gum::InputSymbol> symbols;
    std::vector<std::string> names;
    Eigen::VectorXd start(static_cast<Eigen::Index>(fit.parameters.size()));
    for (const BudgetFit::Parameter& parameter : fit.parameters) {
        start(static_cast<Eigen::Index>(names.size())) = parameter.start.value_or(1.0);
        symbols.push_back({.name = parameter.name, .unit = parameter.unit, .constant = {}});
        names.push_back(parameter.name);
    }
    for (std::size_t i = 0; i < fit.regressors.size(); ++i) {
        symbols.push_back({.name = fit.regressors[i], .unit = fit.regressor_units[i], .constant = {}});
    }
    const gum::OutputSymbol output{.name = fit.ordinate, .unit = fit.ordinate_unit, .where = fit.where};
    const EquationCurve curve(gum::EquationSystem::compile({&fit.equation, 1}, symbols, {}, {&output, 1}),
                              fit.parameters.size());
    const engine::CurveData data{.x = fit.x,
                                 .y = fit.y,
                                 .y_uncertainty = fit.y_uncertainty,
                                 .x_uncertainty = fit.x_uncertainty,
                                 .scale_by_residuals = fit.scale_by_residuals};
    return engine::fit_curve(curve, data, start, names,
                             has_intercept(curve, data, static_cast<Eigen::Index>(names.size())));
}

std::optional<gum::EquationSystem> compile_model(const BudgetJob& job) {
    if (job.model.empty()) {
        return std::nullopt;
    }
    return gum::EquationSystem::compile(job.model, engine::model_inputs(job), job.unknowns, engine::model_outputs(job));
}

bool is_linear(const gum::EquationSystem& system) {
    std::vector<std::size_t> all(system.input_count());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] = i;
    }
    return system.is_affine_in(all);
}

double coverage_probability_of(const BudgetJob& job, const std::string& output) {
    for (const engine::BudgetOutput& stated : job.outputs) {
        if (stated.name == output && stated.coverage_probability) {
            return *stated.coverage_probability;
        }
    }
    return job.coverage_probability;
}

bool changes(const BudgetPointResult& point, Eigen::Index output, double change, double shift) {
    if (!point.second_order) {
        return false;
    }
    const double first = point.propagation.standard_uncertainty(output);
    const double second = point.second_order->standard_uncertainty(output);
    return std::abs(second - first) > change * first ||
           std::abs(point.second_order->shift(output)) > shift * std::max(first, second);
}

/// Monte Carlo of one point for each coverage probability that its outputs ask for.
void run_monte_carlo(const BudgetJob& job, unsigned threads, const Progress& progress, BudgetPointResult& point) {
    const engine::MonteCarloRequest& asked = *job.monte_carlo;
    gum::MonteCarloOptions options = monte_carlo_options(asked, threads);
    if (progress && job.points.empty()) {
        options.progress = [&progress](double done) {
            progress("Monte Carlo, " + std::to_string(static_cast<int>(100.0 * done)) + " %");
        };
    }
    options.streams = point.streams;
    options.regions = job.points.empty();
    options.histogram = job.points.size() <= k_most_points_with_histogram;
    std::map<double, gum::MonteCarloResult> results;
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        BudgetOutputResult& output = point.outputs[i];
        auto found = results.find(output.coverage_probability);
        if (found == results.end()) {
            options.coverage_probability = output.coverage_probability;
            found = results.emplace(output.coverage_probability, gum::run_monte_carlo(*point.model, options)).first;
            if (!point.monte_carlo) {
                point.monte_carlo = found->second;
            }
        }
        output.monte_carlo = found->second.outputs[i];
        output.trials = found->second.trials;
        output.stabilised = found->second.stabilised;
    }
}

/// What Monte Carlo adds to the outputs: an expanded uncertainty where the law of propagation has none, validation.
void use_monte_carlo(const BudgetJob& job, BudgetPointResult& point, BudgetResult& result) {
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        BudgetOutputResult& output = point.outputs[i];
        const auto index = static_cast<Eigen::Index>(i);
        const double u = output.standard_uncertainty;
        const double y = point.propagation.value(index);
        if (job.monte_carlo->validate && output.expanded_uncertainty && u > 0.0) {
            const gum::Unit& unit = result.output_units[i];
            output.validation =
                validation_in_unit(y, u, *output.expanded_uncertainty, *output.monte_carlo,
                                   {[&](double value) { return unit.from_si(value); },
                                    [&](double difference) { return unit.difference_from_si(difference); }},
                                   job.monte_carlo->digits);
            if (!output.validation->validated || !output.validation->precise_enough) {
                result.validation_failed = true;
            }
        } else if (job.monte_carlo->validate && !output.expanded_uncertainty) {
            result.validation_failed = true;
        }
        const bool nothing_spreads = u == 0.0 && output.monte_carlo->standard_uncertainty == 0.0;
        if (!output.expanded_uncertainty && output.coverage == "none" && !nothing_spreads) {
            // Half the width of the interval is an expanded uncertainty about its middle, not about any other value.
            const gum::CoverageInterval& interval = output.monte_carlo->symmetric;
            const double half_width = 0.5 * (interval.high - interval.low);
            const double off_centre = std::abs(y - 0.5 * (interval.high + interval.low));
            if (off_centre > k_accepted_asymmetry * half_width) {
                output.coverage_note +=
                    "; the Monte Carlo interval is not symmetric about the value, and stands in place "
                    "of an expanded uncertainty";
            } else {
                output.coverage = "monte_carlo";
                output.coverage_note += "; the expanded uncertainty is half the width of the Monte Carlo interval";
                output.expanded_uncertainty = half_width;
                if (u > 0.0) {
                    output.coverage_factor = half_width / u;
                }
            }
        }
    }
}

/// JCGM 102:2011, clause 8, where there are several outputs whose first order does not vanish.
void validate_together(const BudgetJob& job, BudgetPointResult& point, BudgetResult& result) {
    const auto m = static_cast<Eigen::Index>(point.outputs.size());
    if (m < 2 || !job.points.empty() || job.model.empty() ||
        !(point.propagation.standard_uncertainty.minCoeff() > 0.0)) {
        return;
    }
    Eigen::VectorXd in_unit(m);
    for (Eigen::Index j = 0; j < m; ++j) {
        in_unit(j) = result.output_units[static_cast<std::size_t>(j)].difference_from_si(1.0);
    }
    point.joint_validation = gum::validate_jointly(
        point.propagation, gum::joint_effective_degrees_of_freedom(*point.model, point.propagation), *point.monte_carlo,
        in_unit, job.monte_carlo->digits);
    result.validation_failed = result.validation_failed || !point.joint_validation->validated;
}

/// The input with a distribution that is not symmetric which makes up most of the variance of an output; "" if none
/// does.
std::string dominating_asymmetric_input(const BudgetPointResult& point, Eigen::Index output) {
    for (std::size_t g = 0; g < point.model->inputs().size(); ++g) {
        const gum::InputGroup& group = point.model->inputs()[g];
        if (group.marginals.size() == 1 && !gum::is_symmetric(group.marginals.front()) &&
            point.propagation.budget[g].share(output) > k_most_of_the_variance) {
            return group.name;
        }
    }
    return "";
}

/// Whether y ± U of the law of propagation and the Monte Carlo interval are two statements, beyond numerical error.
bool differs_from_monte_carlo(const BudgetPointResult& point, Eigen::Index output) {
    const BudgetOutputResult& result = point.outputs[static_cast<std::size_t>(output)];
    if (!result.monte_carlo || !result.expanded_uncertainty || result.coverage == "monte_carlo") {
        return false;
    }
    const double y = point.propagation.value(output);
    const double U = *result.expanded_uncertainty;
    const gum::CoverageInterval& interval = result.monte_carlo->symmetric;
    const gum::CoverageInterval& error = result.monte_carlo->numerical_error.symmetric;
    const double accepted = k_warned_change * 0.5 * (interval.high - interval.low);
    return std::abs(y - U - interval.low) > accepted + k_numerical_errors * error.low ||
           std::abs(y + U - interval.high) > accepted + k_numerical_errors * error.high;
}

void warn(const BudgetJob& job, const BudgetPointResult& point, const std::string& where, BudgetResult& result) {
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        const auto index = static_cast<Eigen::Index>(i);
        const std::string place = "result " + result.output_names[i] + where;
        if (point.outputs[i].standard_uncertainty == 0.0 && point.outputs[i].coverage != "monte_carlo") {
            result.notes.push_back(zero_uncertainty_message(point.outputs[i], place));
        } else if (point.outputs[i].coverage == "none") {
            result.notes.push_back({.code = "GC-BUDGET-0020",
                                    .where = place,
                                    .what = "no expanded uncertainty can be stated: " + point.outputs[i].coverage_note,
                                    .rule = "a coverage factor needs the distribution of the result",
                                    .action = job.monte_carlo ? "Use the coverage interval of Monte Carlo."
                                                              : "Add \"monte_carlo\" to the job.",
                                    .severity = gum::Severity::warning});
        } else if (changes(point, index, k_warned_change, k_warned_shift) && !job.monte_carlo) {
            result.notes.push_back({.code = "GC-BUDGET-0021",
                                    .where = place,
                                    .what = "the model is not linear over the uncertainties of its inputs",
                                    .rule = "higher-order terms must be included then (JCGM 100:2008, 5.1.2 note)",
                                    .action = "See the second-order terms of the result, and add \"monte_carlo\" with "
                                              "\"validate\": true to the job.",
                                    .severity = gum::Severity::warning});
        }
        if (const std::string input = dominating_asymmetric_input(point, index);
            !input.empty() && !job.monte_carlo && point.outputs[i].coverage != "none") {
            result.notes.push_back(
                {.code = "GC-BUDGET-0023",
                 .where = place,
                 .what = "the distribution of " + input + " is not symmetric and dominates",
                 .rule = "k of a normal or t-distribution holds for results that are nearly symmetric",
                 .action = "Add \"monte_carlo\" to the job, and state its coverage interval.",
                 .severity = gum::Severity::warning});
        }
        if (differs_from_monte_carlo(point, index)) {
            result.notes.push_back(
                {.code = "GC-BUDGET-0024",
                 .where = place,
                 .what = "the expanded uncertainty of the law of propagation differs from the Monte Carlo "
                         "interval by more than 5 % of half its width",
                 .rule = "the law of propagation holds for models that are nearly linear and results that "
                         "are nearly normal (JCGM 101:2008, clause 8)",
                 .action = "Use the coverage interval of Monte Carlo.",
                 .severity = gum::Severity::warning});
        }
        if (!point.outputs[i].stabilised) {
            result.notes.push_back(
                {.code = "GC-BUDGET-0022",
                 .where = place,
                 .what = std::to_string(point.outputs[i].trials) + " trials, and the results have not stabilised",
                 .rule = "adaptive Monte Carlo ends when twice the standard deviation of each result "
                         "is within its tolerance (JCGM 101:2008, 7.9.4)",
                 .action = "Raise adaptive.max_trials, or ask for one digit.",
                 .severity = gum::Severity::warning});
        }
    }
}

BudgetPointResult evaluate_point(const BudgetJob& job, const std::optional<gum::EquationSystem>& system,
                                 std::optional<std::size_t> at, unsigned threads, const Progress& progress,
                                 BudgetResult& result) {
    BudgetInputs inputs = budget_inputs(job, result.fits, at);
    if (!at || *at == 0) {
        result.notes.insert(result.notes.end(), inputs.notes.begin(), inputs.notes.end());
    }
    BudgetPointResult point;
    point.streams = std::move(inputs.streams);
    point.model = std::make_shared<const BudgetModel>(system, result.symbols, std::move(inputs.groups),
                                                      std::move(inputs.quantities));
    point.propagation = gum::propagate(*point.model, job.coverage_probability);
    if (system && !is_linear(*system) && point.propagation.jacobian.cols() <= k_most_inputs_of_second_order) {
        point.second_order = gum::propagate_to_second_order(*point.model, point.propagation);
    }
    for (std::size_t i = 0; i < result.output_names.size(); ++i) {
        BudgetOutputResult output;
        output.coverage_probability = coverage_probability_of(job, result.output_names[i]);
        const auto index = static_cast<Eigen::Index>(i);
        point.propagation.coverage_probability = output.coverage_probability;
        expand_by_propagation(job, point, index, output);
        state_zero_uncertainty(job, point, result.output_names[i], output);
        output.second_order_matters = changes(point, index, k_reported_change, k_reported_shift);
        point.outputs.push_back(std::move(output));
    }
    if (job.monte_carlo) {
        run_monte_carlo(job, threads, progress, point);
        use_monte_carlo(job, point, result);
        if (job.monte_carlo->validate) {
            validate_together(job, point, result);
        }
    }
    warn(job, point, at ? " at point " + job.points[*at].name : "", result);
    return point;
}

}  // namespace

BudgetResult evaluate_budget(const BudgetJob& job, unsigned threads,
                             const std::function<void(const std::string&)>& progress) {
    BudgetResult result;
    result.symbols = budget_symbols(job);
    for (const BudgetFit& fit : job.fits) {
        if (progress) {
            progress("fit of " + fit.name);
        }
        result.fits.push_back(evaluate_fit(fit));
    }
    const std::optional<gum::EquationSystem> system = compile_model(job);
    if (system) {
        for (std::size_t i = 0; i < system->output_count(); ++i) {
            result.output_names.push_back(system->output_name(i));
            result.output_units.push_back(system->output_unit(i));
        }
    } else {
        for (const BudgetSymbol& symbol : result.symbols) {
            result.output_names.push_back(symbol.name);
            // An input that is a result has the unit that it is asked for in.
            const auto stated = std::find_if(job.outputs.begin(), job.outputs.end(), [&](const auto& output) {
                return output.name == symbol.name && output.unit;
            });
            result.output_units.push_back(stated != job.outputs.end() ? *stated->unit : symbol.unit);
        }
    }
    if (job.points.empty()) {
        if (progress && job.monte_carlo) {
            progress("Monte Carlo");
        }
        result.points.push_back(evaluate_point(job, system, std::nullopt, threads, progress, result));
    }
    for (std::size_t p = 0; p < job.points.size(); ++p) {
        if (progress) {
            progress("point " + std::to_string(p + 1) + " of " + std::to_string(job.points.size()));
        }
        result.points.push_back(evaluate_point(job, system, p, threads, progress, result));
    }
    return result;
}

}  // namespace gumcert::app
