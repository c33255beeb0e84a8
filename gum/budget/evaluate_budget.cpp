#include "gum/budget/evaluate_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "gum/budget/budget_coverage.h"
#include "gum/budget/evaluation_choice.h"
#include "gum/budget/fit_scatter.h"
#include "gum/budget/joint_region.h"
#include "gum/budget/other_choice.h"
#include "gum/budget/zero_uncertainty.h"
#include "gum/monte_carlo/validation_in_unit.h"
#include "gum/quantity/progress.h"
#include "text/counts.h"

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
    // Without such a parameter the residuals need not have the mean 0, and R² about the mean of the data could be
    // negative.
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
        // Of an equation that is linear in its parameters any start leads to the solution in one step.
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
    // Small residuals by luck would make the uncertainty of the parameters smaller than that of the data behind them:
    // the stated uncertainties hold then.
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
void run_monte_carlo(const Budget& budget, const std::optional<EquationSystem>& system, const MonteCarloRequest& asked,
                     unsigned threads, const Progress& progress, BudgetPointResult& point) {
    MonteCarloOptions options = monte_carlo_options(asked, threads, budget.points.empty() ? progress : Progress());
    if (!budget.monte_carlo && options.adaptive) {
        // Trials that decide whether the law holds need a numerical error that is small beside the tolerance they are
        // compared with.
        options.adaptive->tolerance_divisor = k_automatic_divisor;
    }
    options.streams = point.streams;
    options.has_no_variance = [&](Eigen::Index output, std::uint64_t trials) {
        return has_no_variance(system, point, output, asked.seed, trials, threads);
    };
    // What is drawn of simultaneous observations is right for one result at a time, not for a region of several.
    options.regions = budget.points.empty() && budget.simultaneous.empty();
    options.histogram = budget.points.size() <= k_most_points_with_histogram;
    std::map<double, MonteCarloResult> results;
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        BudgetOutputResult& output = point.outputs[i];
        // The same seed and the same streams: results for other probabilities rest on the same trials.
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
        output.stabilised = output.monte_carlo->stabilised;
    }
}

/// Monte Carlo that the job did not ask for: where it fails, the message gives the reason why it was run.
void run_monte_carlo_unasked(const Budget& budget, const std::optional<EquationSystem>& system,
                             const std::vector<std::string>& evidence, const std::string& where, unsigned threads,
                             const Progress& progress, BudgetPointResult& point, BudgetResult& result) {
    result.automatic_monte_carlo = automatic_monte_carlo();
    try {
        run_monte_carlo(budget, system, *result.automatic_monte_carlo, threads, progress, point);
    } catch (const NoResultError& error) {
        std::vector<Diagnostic> all = error.diagnostics();
        for (Diagnostic& problem : all) {
            for (std::size_t i = 0; i < evidence.size(); ++i) {
                if (!evidence[i].empty()) {
                    problem.where = "result " + point.outputs[i].name + where + ", " + problem.where;
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

/// Trials beside a law that the budget asks for against evidence: they tell by how much it is wrong, and may refute what is only
/// feared. Where they fail, as outside of the domain of the model, the law is stated without them.
void run_monte_carlo_beside(const Budget& budget, const std::optional<EquationSystem>& system, unsigned threads,
                            const Progress& progress, BudgetPointResult& point, BudgetResult& result) {
    try {
        run_monte_carlo(budget, system, automatic_monte_carlo(), threads, progress, point);
        result.automatic_monte_carlo = automatic_monte_carlo();
    } catch (const NoResultError&) {
        point.monte_carlo.reset();
        for (BudgetOutputResult& output : point.outputs) {
            output.monte_carlo.reset();
            output.trials = 0;
            output.stabilised = true;
        }
    }
}

/// What Monte Carlo adds to the outputs: validation, where the budget demands it.
void validate_outputs(const Budget& budget, BudgetPointResult& point, BudgetResult& result) {
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        BudgetOutputResult& output = point.outputs[i];
        const double u = output.standard_uncertainty;
        const double y = point.propagation.value(static_cast<Eigen::Index>(i));
        // Without U of the law there is nothing that trials could confirm: validation was demanded, and is not reached.
        if (!output.expanded_uncertainty) {
            result.validation_failed = true;
        } else if (u > 0.0) {
            const Unit& unit = output.unit;
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
        in_unit(j) = point.outputs[static_cast<std::size_t>(j)].unit.difference_from_si(1.0);
    }
    point.joint_validation = validate_jointly(
        point.propagation, law_ellipsoid(budget, point, point.monte_carlo->coverage_probability).ellipsoid_factor,
        *point.monte_carlo, in_unit, budget.monte_carlo->digits);
    result.validation_failed = result.validation_failed || !point.joint_validation->validated;
}

Diagnostic not_stabilised_message(std::string where, std::uint64_t trials) {
    return {.code = "GC-BUDGET-0022",
            .where = std::move(where),
            .what = text::count_of(trials, "trial") + ", and the results have not stabilised",
            .rule =
                "adaptive Monte Carlo ends when twice the standard deviation of each result "
                "is within its tolerance (JCGM 101:2008, 7.9.4)",
            .action = "Raise adaptive.max_trials, or ask for one digit.",
            .severity = Severity::warning};
}

void warn(const Budget& budget, const BudgetPointResult& point, const std::string& where, BudgetResult& result) {
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        const BudgetOutputResult& output = point.outputs[i];
        const std::string place = "result " + output.name + where;
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
        // Of trials that nobody asked for, beside a law that is stated all the same, nothing is to be raised.
        if (!output.stabilised && (output.by_monte_carlo || budget.monte_carlo)) {
            result.notes.push_back(not_stabilised_message(place, output.trials));
        }
    }
    const bool all_by_trials = std::all_of(point.outputs.begin(), point.outputs.end(), [](const BudgetOutputResult& o) {
        return o.by_monte_carlo && o.stabilised;
    });
    if (all_by_trials && point.monte_carlo && !point.monte_carlo->stabilised) {
        result.notes.push_back(not_stabilised_message("joint region" + where, point.monte_carlo->trials));
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
    bool is_forced = false;
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        choices.push_back(coverage_choice_of(budget, point.outputs[i].name));
        is_forced = is_forced || (choices[i] == CoverageChoice::law_of_propagation && !evidence[i].empty());
        needed = needed || needs_monte_carlo(choices[i], evidence[i]);
    }
    if (budget.monte_carlo) {
        run_monte_carlo(budget, system, *budget.monte_carlo, threads, progress, point);
        if (budget.monte_carlo->validate) {
            validate_outputs(budget, point, result);
        }
    } else if (needed) {
        run_monte_carlo_unasked(budget, system, evidence, where, threads, progress, point, result);
    } else if (is_forced) {
        run_monte_carlo_beside(budget, system, threads, progress, point, result);
    }
    if (point.monte_carlo) {
        const std::vector<double> shares = shares_of_other_choices(point, point.monte_carlo->seed);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            point.outputs[i].other_choice = shares[i];
        }
    }
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        BudgetOutputResult& output = point.outputs[i];
        const auto index = static_cast<Eigen::Index>(i);
        if (output.monte_carlo) {
            const ExistingMoments exist = existing_moments(system, point, index, threads);
            output.has_mean = exist.mean;
            output.has_u = exist.u;
            // Ended by the ends of its interval, because a look at fewer trials found no variance.
            output.stabilised = output.stabilised && !(output.monte_carlo->without_variance && exist.u);
        }
        decide_reported(choices[i], evidence[i], output.unit, point.propagation.value(index),
                        budget.monte_carlo ? budget.monte_carlo->digits : 2, output);
        if (trials_do_not_vary(point, index)) {
            output.by_monte_carlo = false;  // what the law says of u = 0 holds for the trials too
            output.because.clear();
        }
        if (i < point.without_derivative.size() && point.without_derivative[i] && output.monte_carlo && output.has_u) {
            // The law has no u where there is no derivative; budgets and correlations beside the result take that of
            // the trials.
            output.standard_uncertainty = output.monte_carlo->standard_uncertainty;
        }
    }
    if (budget.monte_carlo && budget.monte_carlo->validate) {
        validate_together(budget, point, result);
    }
}

/// What is evaluated by one set of equations: a whole budget, or a section of it.
struct Part {
    const Budget& whole;
    const Budget& budget;  ///< of the section
    std::optional<std::size_t> section;
    std::size_t first_point = 0;  ///< in the whole
    std::optional<EquationSystem> system;
    std::vector<std::size_t> results;         ///< without equations: symbols
    std::vector<BudgetOutputResult> outputs;  ///< names, units, and what is asked for
};

/// \param at  position in the points of the part
BudgetPointResult evaluate_point(const Part& part, std::optional<std::size_t> at, unsigned threads,
                                 const Progress& progress, BudgetResult& result) {
    const Budget& budget = part.budget;
    BudgetPointResult point;
    point.section = part.section;
    if (at) {
        point.point = part.first_point + *at;
    }
    // Of the whole budget, not of the section: random numbers go by the position of an input, so that results of two
    // sections share what they have in common.
    BudgetInputs inputs = budget_inputs(part.whole, result.fits, point.point);
    if (result.points.empty()) {
        result.notes.insert(result.notes.end(), inputs.notes.begin(), inputs.notes.end());
    }
    point.streams = std::move(inputs.streams);
    point.model = std::make_shared<const BudgetModel>(part.system, result.symbols, std::move(inputs.groups),
                                                      std::move(inputs.quantities), part.results);
    PointPropagation propagated = propagate_where_possible(budget, part.system, *point.model, result.symbols);
    point.propagation = std::move(propagated.propagation);
    point.without_derivative = std::move(propagated.without_derivative);
    if (part.system && !is_linear(*part.system) && point.propagation.jacobian.cols() <= k_most_inputs_of_second_order) {
        point.second_order = second_order_of(point);
    }
    for (const BudgetOutputResult& asked : part.outputs) {
        BudgetOutputResult output = asked;
        const auto index = static_cast<Eigen::Index>(point.outputs.size());
        point.propagation.coverage_probability = output.coverage_probability;
        expand_by_propagation(budget, point, index, output);
        state_zero_uncertainty(budget, point, output.name, output);
        output.second_order_matters = changes(point, index, k_reported_change, k_reported_shift);
        point.outputs.push_back(std::move(output));
    }
    const std::string where = at ? " at point " + budget.points[*at].name : "";
    report(budget, part.system, where, threads, progress, point, result);
    warn(budget, point, where, result);
    return point;
}

/// What the equations give, or the symbols themselves: of a section those that it asks for.
void set_outputs(const std::vector<InputSymbol>& symbols, Part& part) {
    const auto add = [&](const std::string& name, const Unit& unit) {
        BudgetOutputResult& output = part.outputs.emplace_back();
        output.name = name;
        output.unit = unit;
        output.coverage_probability = coverage_probability_of(part.budget, name);
    };
    if (part.system) {
        for (std::size_t i = 0; i < part.system->output_count(); ++i) {
            add(part.system->output_name(i), part.system->output_unit(i));
        }
        return;
    }
    for (std::size_t i = 0; i < symbols.size(); ++i) {
        // An input that is a result has the unit that it is asked for in.
        const auto stated = std::find_if(part.budget.outputs.begin(), part.budget.outputs.end(),
                                         [&](const auto& output) { return output.name == symbols[i].name; });
        const bool is_stated = stated != part.budget.outputs.end();
        if (is_stated || !part.section) {
            part.results.push_back(i);
            add(symbols[i].name, is_stated && stated->unit ? *stated->unit : symbols[i].unit);
        }
    }
}

void evaluate_part(const Budget& whole, const Budget& budget, std::optional<std::size_t> section, unsigned threads,
                   const Progress& progress, BudgetResult& result) {
    Part part{.whole = whole,
              .budget = budget,
              .section = section,
              .first_point = section ? first_point_of(whole, *section) : 0,
              .system = compile_model(budget),
              .results = {},
              .outputs = {}};
    set_outputs(result.symbols, part);
    if (budget.points.empty()) {
        if (progress && budget.monte_carlo) {
            progress("Monte Carlo");
        }
        result.points.push_back(evaluate_point(part, std::nullopt, threads, progress, result));
    }
    for (std::size_t p = 0; p < budget.points.size(); ++p) {
        if (progress) {
            progress("point " + std::to_string(part.first_point + p + 1) + " of " +
                     std::to_string(whole.points.size()));
        }
        result.points.push_back(evaluate_point(part, p, threads, progress, result));
    }
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
            // Rounding is no scatter: what it left would be printed with twenty decimals.
            result.fits.back().covariance.setZero();
            result.fits.back().factor.setZero();
        } else if (auto lost = lost_digits_message(fit, result.fits.back())) {
            result.notes.push_back(std::move(*lost));
        }
    }
    if (budget.sections.empty()) {
        evaluate_part(budget, budget, std::nullopt, threads, progress, result);
    }
    for (std::size_t s = 0; s < budget.sections.size(); ++s) {
        evaluate_part(budget, budget_of_section(budget, s), s, threads, progress, result);
    }
    note_reported(budget, result);
    return result;
}

std::vector<std::string> budget_result_names(const Budget& budget, const BudgetResult& result) {
    std::vector<std::string> names;
    for (const BudgetPointResult& point : result.points) {
        for (const BudgetOutputResult& output : point.outputs) {
            names.push_back(point.point ? output.name + "[" + budget.points[*point.point].name + "]" : output.name);
        }
    }
    return names;
}

std::size_t budget_result_count(const BudgetResult& result) {
    std::size_t count = 0;
    for (const BudgetPointResult& point : result.points) {
        count += point.outputs.size();
    }
    return count;
}

}  // namespace gumcert::gum
