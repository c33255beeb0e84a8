#include "gum/budget/evaluation_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "gum/budget/other_choice.h"
#include "gum/linearity_check.h"
#include "gum/monte_carlo/trial_distribution.h"
#include "gum/monte_carlo/validation_in_unit.h"
#include "text/lists.h"

namespace gumcert::gum {

namespace {

constexpr double k_largest_change = 0.05;     // of u by second-order terms
constexpr double k_largest_shift = 0.1;       // of the estimate by them, in terms of u
constexpr double k_vanishing = 0.01;          // u of first order beside that of the second
constexpr double k_vanished = 1e-6;           // u of first order beside the spread of the model itself
constexpr double k_largest_asymmetry = 0.05;  // shift of the ends by the skewness, in terms of U
constexpr std::uint64_t k_most_trials = 20'000'000;
constexpr double k_suspicious_share = 0.005;   // of one deviation in the sum of all squares
constexpr double k_suspicious_in_few = 30.0;   // divided by the trials: what a normal distribution shows
constexpr double k_least_with_variance = 2.0;  // exponent of tails that fall off like a power law
constexpr double k_least_with_mean = 1.0;
constexpr double k_unknown_error = 0.25;  // of u: no digit of it is held

bool is_without(const std::vector<bool>& flags, std::size_t output) {
    return output < flags.size() && flags[output];
}

/// A model whose sensitivities are known already.
class KnownJacobian final : public MeasurementModel {
public:
    KnownJacobian(const MeasurementModel& of, Eigen::MatrixXd jacobian) : of_(of), jacobian_(std::move(jacobian)) {}
    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return of_.inputs(); }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return of_.outputs(); }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override { return of_.evaluate(x); }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& /*x*/) const override { return jacobian_; }

private:
    const MeasurementModel& of_;
    Eigen::MatrixXd jacobian_;
};

/// Whether a message says that a derivative is missing, and nothing else.
bool tells_missing_derivative(const NoResultError& error) {
    return std::all_of(error.diagnostics().begin(), error.diagnostics().end(), [](const Diagnostic& d) {
        return d.code == "GC-MODEL-0063" || d.code == "GC-MODEL-0064" || d.code == "GC-GUM-0056";
    });
}

/// Exponent with which the trials of an output thin out: P(|Y − median| > a) ~ a^−α.
TailIndex tail_of(const BudgetPointResult& point, Eigen::Index output, std::uint64_t seed, std::uint64_t trials,
                  unsigned threads) {
    return tail_index({.model = point.model,
                       .output = output,
                       .unit = {},
                       .seed = seed,
                       .streams = point.streams,
                       .trials = trials,
                       .threads = threads});
}

/// Whether an output is an affine function of all inputs.
bool is_affine(const std::optional<EquationSystem>& system, Eigen::Index output) {
    if (!system) {
        return true;
    }
    std::vector<std::size_t> all(system->input_count());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return system->is_affine_in(all, static_cast<std::size_t>(output));
}

/// What the distributions of the inputs say: an expectation or a standard deviation that one lacks and that enters
/// linearly.
ExistingMoments moments_by_inputs(const std::optional<EquationSystem>& system, const BudgetPointResult& point,
                                  Eigen::Index output) {
    ExistingMoments exist;
    const std::vector<BudgetQuantity>& quantities = point.model->quantities();
    for (const InputWithoutVariance& input : inputs_without_variance(point, output)) {
        const std::array<std::size_t, 1> symbol{quantities[static_cast<std::size_t>(input.column)].symbol};
        // Linear: the tails of the input are those of the result. Through another function, 1/x say, they may be cut
        // off or become longer; then the trials themselves are asked.
        if (!system || system->is_affine_in(symbol, static_cast<std::size_t>(output))) {
            exist.u = false;
            exist.mean = exist.mean && input.nu > 1.0;
        }
    }
    return exist;
}

/// How far the ends of the interval lie aside, in parts of U: from the convolution of all distributions, correlated
/// ones among them. Where it is not known the ends move by γ (k² − 1)/6 u, the first term of the expansion of Cornish
/// and Fisher (1938).
double asymmetry_of(const BudgetPointResult& point, std::size_t output) {
    const BudgetOutputResult& of = point.outputs[output];
    if (of.asymmetry) {
        return std::abs(*of.asymmetry);
    }
    const double k = of.coverage_factor.value_or(2.0);
    const double skewness = linear_skewness(*point.model, point.propagation, static_cast<Eigen::Index>(output));
    return std::abs(skewness) * std::abs(k * k - 1.0) / (6.0 * k);
}

}  // namespace

CoverageChoice coverage_choice_of(const Budget& budget, const std::string& output) {
    for (const BudgetOutput& stated : budget.outputs) {
        if (stated.name == output && stated.coverage) {
            return *stated.coverage;
        }
    }
    return budget.coverage;
}

std::string reason_in_words(const std::string& reason) {
    static const std::map<std::string, std::string> k_words = {
        {"asked", "the job asks for it"},
        {"second_order", "second-order terms change u by more than 5 % or the estimate by more than 0.1 u"},
        {"vanishing", "the first derivatives of the model vanish at the estimates"},
        {"no_derivative", "the model has no derivative at the estimates"},
        {"not_linear", "the model is not linear over the uncertainties of its inputs"},
        {"asymmetric", "an input whose distribution is not symmetric dominates"},
        {"contradicted", "Monte Carlo contradicts the law of propagation (JCGM 101:2008, clause 8)"}};
    const auto found = k_words.find(reason);
    return found == k_words.end() ? "" : found->second;
}

PointPropagation propagate_where_possible(const Budget& budget, const std::optional<EquationSystem>& system,
                                          const BudgetModel& model, const std::vector<InputSymbol>& symbols) {
    try {
        return {.propagation = propagate(model, budget.coverage_probability), .without_derivative = {}};
    } catch (const NoResultError& refused) {
        // Any other failure is one of the model itself, and no trial would help.
        if (!system || !tells_missing_derivative(refused)) {
            throw;
        }
        // Each output has a model of its own: only some of them may be without a derivative.
        const Eigen::VectorXd x = input_estimates(model);
        PointPropagation result;
        Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(system->output_count()), x.size());
        for (std::size_t i = 0; i < system->output_count(); ++i) {
            const OutputSymbol output{.name = system->output_name(i), .unit = system->output_unit(i), .where = {}};
            bool exists = true;
            try {
                const BudgetModel alone(
                    EquationSystem::compile(budget.model, model_inputs(budget), budget.unknowns, {&output, 1}), symbols,
                    model.inputs(), model.quantities());
                const Eigen::MatrixXd row = alone.jacobian(x);
                exists = row.allFinite();
                if (exists) {
                    jacobian.row(static_cast<Eigen::Index>(i)) = row.row(0);
                }
            } catch (const NoResultError& error) {
                exists = false;
                if (coverage_choice_of(budget, output.name) == CoverageChoice::law_of_propagation) {
                    throw;
                }
            }
            result.without_derivative.push_back(!exists);
        }
        result.propagation = propagate(KnownJacobian(model, std::move(jacobian)), budget.coverage_probability);
        return result;
    }
}

std::vector<std::string> evidence_against_law(BudgetPointResult& point, bool linear_model) {
    const std::size_t outputs = point.outputs.size();
    std::vector<std::string> evidence(outputs);
    std::vector<LinearityCheck> checks;
    if (!linear_model) {
        std::vector<std::optional<double>> factors;
        for (const BudgetOutputResult& output : point.outputs) {
            factors.push_back(output.coverage_factor);
        }
        checks = check_linearity(*point.model, point.propagation, factors);
        for (std::size_t i = 0; i < outputs; ++i) {
            if (checks[i].leaps) {
                // Whatever draws trials of the point draws them from its model: all of them see the same angle.
                point.model = point.model->turned(static_cast<Eigen::Index>(i), point.propagation.value);
            }
        }
    }
    for (std::size_t i = 0; i < outputs; ++i) {
        const auto index = static_cast<Eigen::Index>(i);
        const double u = point.propagation.standard_uncertainty(index);
        if (is_without(point.without_derivative, i)) {
            evidence[i] = "no_derivative";
            continue;
        }
        if (point.second_order) {
            const double second = point.second_order->standard_uncertainty(index);
            const double shift = std::abs(point.second_order->shift(index));
            // Second-order terms come first: of several reasons they are the one that names a size.
            if (std::abs(second - u) > k_largest_change * u || shift > k_largest_shift * std::max(u, second)) {
                // At a pole, tan(x) at 90°, terms of any order are infinite: nothing vanishes there.
                const bool is_small = checks.empty() || u <= checks[i].spread;
                evidence[i] = u < k_vanishing * second && is_small ? "vanishing" : "second_order";
                continue;
            }
        }
        // Derivatives at one point do not see a kink, an inflection or a limit inside of ± U; the model is asked there.
        if (!checks.empty() && !checks[i].adequate) {
            evidence[i] = u < k_vanished * checks[i].spread ? "vanishing" : "not_linear";
            continue;
        }
        if (asymmetry_of(point, i) > k_largest_asymmetry) {
            evidence[i] = "asymmetric";
        }
    }
    return evidence;
}

bool needs_monte_carlo(CoverageChoice choice, const std::string& evidence) {
    return choice == CoverageChoice::monte_carlo || (choice == CoverageChoice::as_validated && !evidence.empty());
}

MonteCarloRequest automatic_monte_carlo() {
    MonteCarloRequest request;
    request.most_trials = k_most_trials;
    return request;
}

std::vector<InputWithoutVariance> inputs_without_variance(const BudgetPointResult& point, Eigen::Index output) {
    std::vector<InputWithoutVariance> found;
    Eigen::Index column = 0;
    for (const InputGroup& group : point.model->inputs()) {
        for (Eigen::Index i = 0; i < group.size(); ++i, ++column) {
            const auto at = static_cast<std::size_t>(i);
            if (at < group.marginals.size() && group.marginals[at].kind == DistributionKind::student_t &&
                // ∫ x² f(x) dx of a t-distribution is finite for ν > 2 only: trials give a number all the same, which
                // grows with their count.
                group.marginals[at].shape <= 2.0 && point.propagation.jacobian(output, column) != 0.0) {
                found.push_back({.column = column, .nu = group.marginals[at].shape});
            }
        }
    }
    return found;
}

ExistingMoments existing_moments(const std::optional<EquationSystem>& system, const BudgetPointResult& point,
                                 Eigen::Index output, unsigned threads) {
    ExistingMoments exist = moments_by_inputs(system, point, output);
    // A sum has a variance exactly where its terms have: no trial is asked, however long their tails look.
    if (!exist.u || is_affine(system, output)) {
        return exist;
    }
    const BudgetOutputResult& of = point.outputs[static_cast<std::size_t>(output)];
    // Parts of the trials that disagree on u by a quarter of it know none: exp(x) of a t-distribution has no variance, and
    // where one trial in a million lies far out their number does not tell which it is.
    const double u = of.monte_carlo->standard_uncertainty;
    if (of.monte_carlo->numerical_error.standard_uncertainty > k_unknown_error * u) {
        return {.mean = tail_of(point, output, point.monte_carlo->seed, of.trials, threads).is_above(k_least_with_mean),
                .u = false};
    }
    const double share = of.monte_carlo->largest_share;
    // Of a distribution with a variance no single trial makes a share of Σ d² that does not fall with their number.
    if (!of.monte_carlo->without_variance &&
        share <= k_suspicious_share + k_suspicious_in_few / static_cast<double>(of.trials)) {
        return exist;
    }
    TailIndex tail = tail_of(point, output, point.monte_carlo->seed, of.trials, threads);
    // Open: tails that are longer than those of a power law with a variance, where trials reach, may still fall off
    // faster farther out. More trials reach farther; in a table of points that would take too long.
    if (!tail.is_above(k_least_with_variance) && !tail.is_below(k_least_with_variance) && !point.point &&
        of.trials < k_most_counted_trials) {
        tail = tail_of(point, output, point.monte_carlo->seed, k_most_counted_trials, threads);
    }
    return {.mean = tail.is_above(k_least_with_mean), .u = tail.is_above(k_least_with_variance)};
}

bool has_no_variance(const std::optional<EquationSystem>& system, const BudgetPointResult& point, Eigen::Index output,
                     std::uint64_t seed, std::uint64_t trials, unsigned threads) {
    if (!moments_by_inputs(system, point, output).u) {
        return true;
    }
    return !is_affine(system, output) && tail_of(point, output, seed, trials, threads).is_below(k_least_with_variance);
}

void decide_reported(CoverageChoice choice, const std::string& evidence, const Unit& unit, double value, int digits,
                     BudgetOutputResult& output) {
    bool contradicted = false;
    bool confirmed = false;
    if (output.monte_carlo && output.expanded_uncertainty && output.standard_uncertainty > 0.0) {
        const Validation compared =
            validation_in_unit(value, output.standard_uncertainty, *output.expanded_uncertainty, *output.monte_carlo,
                               {[&](double v) { return unit.from_si(v); },
                                [&](double difference) { return unit.difference_from_si(difference); }},
                               digits);
        // Trials whose own numerical error is as large as the tolerance prove neither.
        contradicted = compared.precise_enough && !compared.validated;
        confirmed = compared.precise_enough && compared.validated;
    }
    // What a probe or the skewness of an input gives reason to fear, trials can refute.
    const bool only_feared = evidence == "not_linear" || evidence == "asymmetric";
    const std::string against = only_feared && confirmed           ? ""
                                : evidence.empty() && contradicted ? "contradicted"
                                                                   : evidence;
    output.by_monte_carlo = false;
    output.because.clear();
    output.against.clear();
    if (choice == CoverageChoice::law_of_propagation) {
        output.against = against;
    } else if (output.monte_carlo && (choice == CoverageChoice::monte_carlo || !against.empty())) {
        output.by_monte_carlo = true;
        output.because = choice == CoverageChoice::monte_carlo ? "asked" : against;
    }
}

void note_reported(const Budget& budget, BudgetResult& result) {
    struct Places {
        std::vector<std::string> points;
        bool any = false;
    };
    const auto places_of = [&](const std::string& output, const auto& holds) {
        Places places;
        for (const BudgetPointResult& point : result.points) {
            for (const BudgetOutputResult& of : point.outputs) {
                if (of.name == output && holds(of)) {
                    places.any = true;
                    if (point.point) {
                        places.points.push_back(budget.points[*point.point].name);
                    }
                }
            }
        }
        return places;
    };
    constexpr std::size_t k_most_names = 5;
    const auto where_of = [&](const std::string& output, const Places& places) {
        const std::string name = "result " + output;
        return places.points.empty() ? name
                                     : name + " at " + (places.points.size() == 1 ? "point " : "points ") +
                                           text::listed(places.points, k_most_names);
    };
    static constexpr std::array<const char*, 6> k_reasons{"second_order", "vanishing",  "no_derivative",
                                                          "not_linear",   "asymmetric", "contradicted"};
    std::vector<std::string> outputs;  // each once, in the order of the results
    std::set<std::string> known;
    for (const BudgetPointResult& point : result.points) {
        for (const BudgetOutputResult& of : point.outputs) {
            if (known.insert(of.name).second) {
                outputs.push_back(of.name);
            }
        }
    }
    for (const std::string& output : outputs) {
        for (const char* reason : k_reasons) {
            const Places reported = places_of(output, [&](const BudgetOutputResult& o) { return o.because == reason; });
            if (reported.any) {
                result.notes.push_back(
                    {.code = "GC-BUDGET-0025",
                     .where = where_of(output, reported),
                     .what = "the result of Monte Carlo is reported, because " + reason_in_words(reason),
                     .rule = "the law of propagation holds for models that are nearly linear and results that are "
                             "nearly normal (JCGM 101:2008, clause 8)",
                     .action = budget.monte_carlo
                                   ? "The law of propagation stands beside it in the record."
                                   : "State \"monte_carlo\" in the job to choose seed and number of trials.",
                     .severity = Severity::note});
            }
            const Places forced = places_of(output, [&](const BudgetOutputResult& o) { return o.against == reason; });
            if (forced.any) {
                result.notes.push_back(
                    {.code = "GC-BUDGET-0026",
                     .where = where_of(output, forced),
                     .what = "the law of propagation is reported because the job asks for it, although " +
                             reason_in_words(reason) + law_beside_trials(budget, result, output, reason),
                     .rule = "a result is stated by the evaluation that holds (JCGM 101:2008, clause 8)",
                     .action = "Leave out \"coverage\": \"law_of_propagation\": then Monte Carlo is reported.",
                     .severity = Severity::warning});
            }
        }
        for (auto message :
             {other_choice_message(budget, result, output), value_outside_message(budget, result, output)}) {
            if (message) {
                result.notes.push_back(std::move(*message));
            }
        }
        // Where the law is reported its U stands, and that the trials have none speaks of the trials alone.
        const Places beside = places_of(
            output, [](const BudgetOutputResult& o) { return o.monte_carlo && !o.has_u && !o.by_monte_carlo; });
        if (beside.any) {
            result.notes.push_back(
                {.code = "GC-BUDGET-0043",
                 .where = where_of(output, beside),
                 .what =
                     "the trials of Monte Carlo beside the reported result give no standard uncertainty: their tails "
                     "fall off so slowly that the distribution has no variance, or none that trials can find",
                 .rule =
                     "the law of propagation takes u as it is stated, and k from the degrees of freedom; a standard "
                     "deviation of trials exists only where the distribution has one (JCGM 101:2008, 6.4.9.4)",
                 .action = "Nothing; the result of the law of propagation is stated.",
                 .severity = Severity::note});
        }
        const Places without = places_of(
            output, [](const BudgetOutputResult& o) { return o.monte_carlo && !o.has_u && o.by_monte_carlo; });
        if (without.any) {
            result.notes.push_back(
                {.code = "GC-BUDGET-0027",
                 .where = where_of(output, without),
                 .what = "the trials of Monte Carlo give no standard uncertainty: their tails fall off so slowly that "
                         "the distribution has no variance, or none that trials can find",
                 .rule = "a standard deviation of trials estimates u only where the distribution has one; coverage "
                         "intervals always exist (JCGM 101:2008, 6.4.9.4 and clause 7.7)",
                 .action =
                     "State the coverage interval; take more readings (ν above 2), or keep a divisor away from 0.",
                 .severity = Severity::warning});
        }
    }
}

}  // namespace gumcert::gum
