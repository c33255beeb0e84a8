#include "gum/budget/evaluate_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "gum/budget/budget_coverage.h"
#include "gum/budget/evaluation_choice.h"
#include "gum/budget/fit_scatter.h"
#include "gum/budget/zero_uncertainty.h"
#include "gum/monte_carlo/validation_in_unit.h"
#include "gum/quantity/progress.h"

namespace gumcert::gum {

namespace {

// Second-order terms are reported where they change the standard uncertainty by half a percent or the estimate by a
// hundredth of it.
constexpr double k_reported_change = 0.005;
constexpr double k_reported_shift = 0.01;
constexpr Eigen::Index k_most_inputs_of_second_order = 1000;  // the matrices of second derivatives grow with the square
constexpr std::size_t k_most_points_with_histogram = 4;       // documents draw no more
constexpr double k_automatic_divisor = 2.0;                   // of the tolerance of trials that nobody asked for

/// The equation of a fit as the curve of the adjustment.
class EquationCurve final : public engine::Curve {
public:
    EquationCurve(EquationSystem system, std::size_t parameters)
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
        } catch (const NoResultError&) {  // the adjustment tries other parameters then
            by_parameter = Eigen::VectorXd::Zero(parameters_);
            by_x = Eigen::VectorXd::Zero(x.size());
            return std::numeric_limits<double>::quiet_NaN();
        }
    }
    [[nodiscard]] bool is_linear() const override { return linear_; }

private:
    EquationSystem system_;
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
    std::vector<InputSymbol> symbols;
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
    const OutputSymbol output{.name = fit.ordinate, .unit = fit.ordinate_unit, .where = fit.where};
    const EquationCurve curve(EquationSystem::compile({&fit.equation, 1}, symbols, {}, {&output, 1}),
                              fit.parameters.size());
    engine::CurveData data{.x = fit.x,
                           .y = fit.y,
                           .y_uncertainty = fit.y_uncertainty,
                           .x_uncertainty = fit.x_uncertainty,
                           .scale_by_residuals = fit.scale_by_residuals};
    const bool intercept = has_intercept(curve, data, static_cast<Eigen::Index>(names.size()));
    engine::CurveFit solved = engine::fit_curve(curve, data, start, names, intercept);
    if (keeps_stated_uncertainties(fit, solved)) {
        data.scale_by_residuals = false;
        solved = engine::fit_curve(curve, data, start, names, intercept);
    }
    return solved;
}

std::optional<EquationSystem> compile_model(const Budget& budget) {
    if (budget.model.empty()) {
        return std::nullopt;
    }
    return EquationSystem::compile(budget.model, model_inputs(budget), budget.unknowns, model_outputs(budget));
}

bool is_linear(const EquationSystem& system) {
    std::vector<std::size_t> all(system.input_count());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] = i;
    }
    return system.is_affine_in(all);
}

double coverage_probability_of(const Budget& budget, const std::string& output) {
    for (const BudgetOutput& stated : budget.outputs) {
        if (stated.name == output && stated.coverage_probability) {
            return *stated.coverage_probability;
        }
    }
    return budget.coverage_probability;
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
void run_monte_carlo(const Budget& budget, const MonteCarloRequest& asked, unsigned threads, const Progress& progress,
                     BudgetPointResult& point) {
    MonteCarloOptions options = monte_carlo_options(asked, threads, budget.points.empty() ? progress : Progress());
    if (!budget.monte_carlo && options.adaptive) {
        options.adaptive->tolerance_divisor = k_automatic_divisor;
    }
    options.streams = point.streams;
    // What is drawn of simultaneous observations is right for one result at a time, not for a region of several.
    options.regions = budget.points.empty() && budget.simultaneous.empty();
    options.histogram = budget.points.size() <= k_most_points_with_histogram;
    std::map<double, MonteCarloResult> results;
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        BudgetOutputResult& output = point.outputs[i];
        auto found = results.find(output.coverage_probability);
        if (found == results.end()) {
            options.coverage_probability = output.coverage_probability;
            found = results.emplace(output.coverage_probability, run_monte_carlo(*point.model, options)).first;
            if (!point.monte_carlo) {
                point.monte_carlo = found->second;
            }
        }
        output.monte_carlo = found->second.outputs[i];
        output.trials = found->second.trials;
        output.stabilised = found->second.stabilised;
    }
}

/// Monte Carlo that the job did not ask for: where it fails, the message gives the reason why it was run.
void run_monte_carlo_unasked(const Budget& budget, const std::vector<std::string>& evidence, const std::string& where,
                             unsigned threads, const Progress& progress, BudgetPointResult& point,
                             BudgetResult& result) {
    result.automatic_monte_carlo = automatic_monte_carlo();
    try {
        run_monte_carlo(budget, *result.automatic_monte_carlo, threads, progress, point);
    } catch (const NoResultError& error) {
        std::vector<Diagnostic> all = error.diagnostics();
        for (Diagnostic& problem : all) {
            for (std::size_t i = 0; i < evidence.size(); ++i) {
                if (!evidence[i].empty()) {
                    problem.where = "result " + result.output_names[i] + where + ", " + problem.where;
                    problem.rule += "; Monte Carlo is needed here, because " + reason_in_words(evidence[i]);
                    break;
                }
            }
            problem.action +=
                " \"coverage\": \"law_of_propagation\" states the result of the law all the same, with a "
                "warning, and is no ground for an accredited certificate.";
        }
        throw NoResultError(std::move(all));
    }
}

/// What Monte Carlo adds to the outputs: validation, where the budget demands it.
void validate_outputs(const Budget& budget, BudgetPointResult& point, BudgetResult& result) {
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        BudgetOutputResult& output = point.outputs[i];
        const double u = output.standard_uncertainty;
        const double y = point.propagation.value(static_cast<Eigen::Index>(i));
        if (!output.expanded_uncertainty) {
            result.validation_failed = true;
        } else if (u > 0.0) {
            const Unit& unit = result.output_units[i];
            output.validation =
                validation_in_unit(y, u, *output.expanded_uncertainty, *output.monte_carlo,
                                   {[&](double value) { return unit.from_si(value); },
                                    [&](double difference) { return unit.difference_from_si(difference); }},
                                   budget.monte_carlo->digits);
            if (!output.validation->validated || !output.validation->precise_enough) {
                result.validation_failed = true;
            }
        }
    }
}

/// JCGM 102:2011, clause 8, where there are several outputs whose first order does not vanish.
void validate_together(const Budget& budget, BudgetPointResult& point, BudgetResult& result) {
    const auto m = static_cast<Eigen::Index>(point.outputs.size());
    if (m < 2 || !budget.points.empty() || budget.model.empty() || !budget.simultaneous.empty() ||
        !(point.propagation.standard_uncertainty.minCoeff() > 0.0)) {
        return;
    }
    Eigen::VectorXd in_unit(m);
    for (Eigen::Index j = 0; j < m; ++j) {
        in_unit(j) = result.output_units[static_cast<std::size_t>(j)].difference_from_si(1.0);
    }
    point.joint_validation =
        validate_jointly(point.propagation, joint_effective_degrees_of_freedom(*point.model, point.propagation),
                         *point.monte_carlo, in_unit, budget.monte_carlo->digits);
    result.validation_failed = result.validation_failed || !point.joint_validation->validated;
}

void warn(const Budget& budget, const BudgetPointResult& point, const std::string& where, BudgetResult& result) {
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        const std::string place = "result " + result.output_names[i] + where;
        const BudgetOutputResult& output = point.outputs[i];
        if (output.standard_uncertainty == 0.0 && !output.by_monte_carlo) {
            result.notes.push_back(zero_uncertainty_message(output, place));
        } else if (output.coverage == "none" && !output.by_monte_carlo) {
            result.notes.push_back({.code = "GC-BUDGET-0020",
                                    .where = place,
                                    .what = "no expanded uncertainty can be stated: " + output.coverage_note,
                                    .rule = "a coverage factor needs the distribution of the result",
                                    .action = budget.coverage == CoverageChoice::law_of_propagation
                                                  ? "Leave out \"coverage\": \"law_of_propagation\"."
                                                  : "Add \"coverage\": \"monte_carlo\" to the job.",
                                    .severity = Severity::warning});
        }
        if (!output.stabilised && output.has_u) {
            result.notes.push_back(
                {.code = "GC-BUDGET-0022",
                 .where = place,
                 .what = std::to_string(output.trials) + " trials, and the results have not stabilised",
                 .rule = "adaptive Monte Carlo ends when twice the standard deviation of each result "
                         "is within its tolerance (JCGM 101:2008, 7.9.4)",
                 .action = "Raise adaptive.max_trials, or ask for one digit.",
                 .severity = Severity::warning});
        }
    }
}

/// Second-order terms, unless the model has no second derivatives at the estimates.
std::optional<SecondOrderPropagation> second_order_of(const BudgetPointResult& point) {
    if (!point.without_derivative.empty()) {
        return std::nullopt;
    }
    try {
        return propagate_to_second_order(*point.model, point.propagation);
    } catch (const NoResultError&) {
        return std::nullopt;  // the probes of the model see what there is to see
    }
}

/// Where the law gives u = 0, and the trials differ by no more than rounding does.
bool trials_do_not_vary(const BudgetPointResult& point, Eigen::Index index) {
    constexpr double k_roundings = 64.0;
    const BudgetOutputResult& output = point.outputs[static_cast<std::size_t>(index)];
    const double rounding =
        k_roundings * std::numeric_limits<double>::epsilon() * std::abs(point.propagation.value(index));
    return output.standard_uncertainty == 0.0 && output.by_monte_carlo && output.has_u &&
           output.monte_carlo->standard_uncertainty <= rounding;
}

/// Which result of each output is reported, with the Monte Carlo that this takes.
void report(const Budget& budget, const std::optional<EquationSystem>& system, const std::string& where,
            unsigned threads, const Progress& progress, BudgetPointResult& point, BudgetResult& result) {
    const std::vector<std::string> evidence = evidence_against_law(point, !system || is_linear(*system));
    std::vector<CoverageChoice> choices;
    bool needed = false;
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        choices.push_back(coverage_choice_of(budget, result.output_names[i]));
        needed = needed || needs_monte_carlo(choices[i], evidence[i]);
    }
    if (budget.monte_carlo) {
        run_monte_carlo(budget, *budget.monte_carlo, threads, progress, point);
        if (budget.monte_carlo->validate) {
            validate_outputs(budget, point, result);
        }
    } else if (needed) {
        run_monte_carlo_unasked(budget, evidence, where, threads, progress, point, result);
    }
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        BudgetOutputResult& output = point.outputs[i];
        const auto index = static_cast<Eigen::Index>(i);
        if (output.monte_carlo) {
            const ExistingMoments exist = existing_moments(system, point, index, threads);
            output.has_mean = exist.mean;
            output.has_u = exist.u;
        }
        decide_reported(choices[i], evidence[i], result.output_units[i], point.propagation.value(index),
                        budget.monte_carlo ? budget.monte_carlo->digits : 2, output);
        if (trials_do_not_vary(point, index)) {
            output.by_monte_carlo = false;  // what the law says of u = 0 holds for the trials too
            output.because.clear();
        }
        if (i < point.without_derivative.size() && point.without_derivative[i] && output.monte_carlo && output.has_u) {
            output.standard_uncertainty = output.monte_carlo->standard_uncertainty;
        }
    }
    if (budget.monte_carlo && budget.monte_carlo->validate) {
        validate_together(budget, point, result);
    }
}

BudgetPointResult evaluate_point(const Budget& budget, const std::optional<EquationSystem>& system,
                                 std::optional<std::size_t> at, unsigned threads, const Progress& progress,
                                 BudgetResult& result) {
    BudgetInputs inputs = budget_inputs(budget, result.fits, at);
    if (!at || *at == 0) {
        result.notes.insert(result.notes.end(), inputs.notes.begin(), inputs.notes.end());
    }
    BudgetPointResult point;
    point.streams = std::move(inputs.streams);
    point.model = std::make_shared<const BudgetModel>(system, result.symbols, std::move(inputs.groups),
                                                      std::move(inputs.quantities));
    PointPropagation propagated = propagate_where_possible(budget, system, *point.model, result.symbols);
    point.propagation = std::move(propagated.propagation);
    point.without_derivative = std::move(propagated.without_derivative);
    if (system && !is_linear(*system) && point.propagation.jacobian.cols() <= k_most_inputs_of_second_order) {
        point.second_order = second_order_of(point);
    }
    for (std::size_t i = 0; i < result.output_names.size(); ++i) {
        BudgetOutputResult output;
        output.coverage_probability = coverage_probability_of(budget, result.output_names[i]);
        const auto index = static_cast<Eigen::Index>(i);
        point.propagation.coverage_probability = output.coverage_probability;
        expand_by_propagation(budget, point, index, output);
        state_zero_uncertainty(budget, point, result.output_names[i], output);
        output.second_order_matters = changes(point, index, k_reported_change, k_reported_shift);
        point.outputs.push_back(std::move(output));
    }
    const std::string where = at ? " at point " + budget.points[*at].name : "";
    report(budget, system, where, threads, progress, point, result);
    warn(budget, point, where, result);
    return point;
}

}  // namespace

BudgetResult evaluate_budget(const Budget& budget, unsigned threads, const Progress& progress) {
    BudgetResult result;
    result.symbols = budget_symbols(budget);
    for (const BudgetFit& fit : budget.fits) {
        if (progress) {
            progress("fit of " + fit.name);
        }
        result.fits.push_back(evaluate_fit(fit));
        if (fit.scale_by_residuals && !result.fits.back().covariance_scaled) {
            result.notes.push_back(kept_uncertainties_message(fit));
        }
        if (is_without_scatter(fit, result.fits.back())) {
            result.notes.push_back(no_scatter_message(fit));
        } else if (auto lost = lost_digits_message(fit, result.fits.back())) {
            result.notes.push_back(std::move(*lost));
        }
    }
    const std::optional<EquationSystem> system = compile_model(budget);
    if (system) {
        for (std::size_t i = 0; i < system->output_count(); ++i) {
            result.output_names.push_back(system->output_name(i));
            result.output_units.push_back(system->output_unit(i));
        }
    } else {
        for (const BudgetSymbol& symbol : result.symbols) {
            result.output_names.push_back(symbol.name);
            // An input that is a result has the unit that it is asked for in.
            const auto stated = std::find_if(budget.outputs.begin(), budget.outputs.end(), [&](const auto& output) {
                return output.name == symbol.name && output.unit;
            });
            result.output_units.push_back(stated != budget.outputs.end() ? *stated->unit : symbol.unit);
        }
    }
    if (budget.points.empty()) {
        if (progress && budget.monte_carlo) {
            progress("Monte Carlo");
        }
        result.points.push_back(evaluate_point(budget, system, std::nullopt, threads, progress, result));
    }
    for (std::size_t p = 0; p < budget.points.size(); ++p) {
        if (progress) {
            progress("point " + std::to_string(p + 1) + " of " + std::to_string(budget.points.size()));
        }
        result.points.push_back(evaluate_point(budget, system, p, threads, progress, result));
    }
    note_reported(budget, result);
    return result;
}

std::vector<std::string> budget_result_names(const Budget& budget, const BudgetResult& result) {
    std::vector<std::string> names;
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        for (const std::string& output : result.output_names) {
            names.push_back(budget.points.empty() ? output : output + "[" + budget.points[p].name + "]");
        }
    }
    return names;
}

}  // namespace gumcert::gum
