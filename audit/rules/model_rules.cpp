#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/rules/budget_model.h"
#include "audit/rules/constant_ranges.h"
#include "audit/rules/registry.h"
#include "gum/expression/name.h"
#include "gum/expression/name_spelling.h"
#include "gum/nearest_correlation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

std::optional<BudgetOutcome> outcome_of(const AuditedBudget& budget) {
    try {
        return evaluate(budget);
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

std::optional<gum::Unit> unit_in(const std::string& text) {
    if (text.empty()) {
        return std::nullopt;
    }
    try {
        return gum::Unit::parse(text == "-" ? "1" : text);
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

/// The model of a budget that somebody else evaluated; our own evaluation differentiated it already.
std::optional<BudgetModel> foreign_model(const AuditedBudget& budget) {
    return budget.evaluated_here ? std::nullopt : BudgetModel::of(budget);
}

/// Whether u is a part of a value, in percent or parts per million: with a coefficient of 1 it is added to a result in
/// another unit as if it were of that unit. Relative humidity is a quantity in percent of its own, and what else acts on the
/// measurement may be.
bool is_part_of_value(const AuditedRow& row) {
    static const std::array<std::string_view, 8> k_parts = {"%",   "percent", "\u2030",  "permille",
                                                            "ppm", "ppb",     "\u00B5%", "pct"};
    const std::string unit = text::in_small_letters(row.unit);
    return std::find(k_parts.begin(), k_parts.end(), unit) != k_parts.end() &&
           row.contributor != Contributor::environment && row.contributor != Contributor::temperature &&
           row.contributor != Contributor::other &&
           !mentions(row, {"humid",        "feucht",       "humedad",     "moisture", "concentration", "konzentration",
                           "purity",       "reinheit",     "slope",       "steigung", "load",          "concentraci",
                           "pureza",       "puret",        "pendiente",   "\u6FD5",   "\u6E7F",        "\u7D14\u5EA6",
                           "\u7EAF\u5EA6", "\u6FC3\u5EA6", "\u6D53\u5EA6"});
}

/// Whether a row has its contribution, and neither u nor what it was divided from.
bool is_contribution_alone(const AuditedRow& row) {
    return row.contribution && !row.u && !(row.stated && row.divisor);
}

/// S01
void unit_of_sensitivity(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const std::optional<gum::Unit> x = unit_in(at.is.unit), y = unit_in(at.of.unit);
        if (!x || !y || !(at.is.used_u > 0.0) || !at.is.in_sum) {
            return;
        }
        // c = ∂f/∂x has the unit of the result per unit of the quantity; any other coefficient adds numbers of
        // different kinds.
        const gum::Dimension expected = y->dimension() / x->dimension();
        if (const std::optional<gum::Unit> c = unit_in(at.is.sensitivity_unit)) {
            if (c->dimension() == expected) {
                return;
            }
            AuditFinding finding =
                finding_at(at, "sensitivity coefficient",
                           say("the unit {unit} does not turn {from} into {to}", at.is.sensitivity_unit,
                               printed_unit(at.is.unit), printed_unit(at.of.unit)));
            finding.evidence = {equals("c", in_words(at.is.used_sensitivity, at.is.sensitivity_unit))};
            finding.expected =
                say("the dimension of {result} per {quantity}", printed_unit(at.of.unit), printed_unit(at.is.unit));
            finding.actual = at.is.sensitivity_unit;
            findings.add(std::move(finding));
            return;
        }
        // A contribution is in the unit of the result already. Where u is nothing but that, it has no unit of its own.
        if (is_contribution_alone(at.is)) {
            return;
        }
        // u is added as it stands: no coefficient, or 1.
        const double scale = at.is.sensitivity ? at.is.sensitivity->scale : 1.0;
        if (!is_about(at.is.used_sensitivity, scale, 1e-9)) {
            return;
        }
        if (!expected.is_one()) {
            const bool has_coefficient = at.is.sensitivity || at.is.contribution;
            // 1 of the unit of the result per percent may be right, and nobody states it.
            if (has_coefficient && !is_part_of_value(at.is)) {
                return;  // 1 of a unit per another may be right
            }
            AuditFinding finding = finding_at(
                at, "sensitivity coefficient",
                has_coefficient ? say("u in {unit} is added to a budget in {other} with a sensitivity coefficient of "
                                      "1, as if it were "
                                      "of that unit",
                                      printed_unit(at.is.unit), printed_unit(at.of.unit))
                                : say("u in {unit} is added to a budget in {other} without a sensitivity coefficient",
                                      printed_unit(at.is.unit), printed_unit(at.of.unit)));
            finding.evidence = {equals("u", in_words(at.is.used_u, at.is.unit))};
            finding.expected =
                say("a coefficient in {result} per {quantity}", printed_unit(at.of.unit), printed_unit(at.is.unit));
            finding.actual = has_coefficient ? Sentence("c = 1") : say("none");
            if (has_coefficient) {
                findings.add(std::move(finding), FindingSeverity::major);
            } else {
                findings.add(std::move(finding));
            }
            return;
        }
        const double factor = y->difference_from_si(x->difference_to_si(1.0));
        if (is_about(factor, scale, 1e-9)) {
            return;
        }
        AuditFinding finding = finding_at(at, "sensitivity coefficient",
                                          say("u in {unit} is added to a budget in {other} as if both were one unit",
                                              printed_unit(at.is.unit), printed_unit(at.of.unit)));
        finding.evidence = {equals("u", in_words(at.is.used_u, at.is.unit))};
        finding.expected =
            equals("c", say("{factor:number} per {unit}", in_words(factor, at.of.unit), printed_unit(at.is.unit)));
        finding.actual = "c = 1";
        finding.correct = set_sensitivity(at.row, factor);
        findings.add(std::move(finding));
    });
}

/// A stated sensitivity coefficient that is not the derivative of the equation.
struct OtherDerivative {
    std::size_t row = 0;
    double stated = 0.0, derivative = 0.0;
    std::optional<std::size_t> of_budget = {};  ///< the budget of another point where the stated one is the derivative
};

bool agrees(double stated, double derivative, double digits) {
    // Tables state |c| as often as c: the sign counts for correlated rows only.
    return std::abs(std::abs(stated) - std::abs(derivative)) <= digits + 0.01 * std::abs(derivative);
}

std::vector<OtherDerivative> other_derivatives(const AuditSubject& subject, std::size_t position) {
    const AuditedBudget& budget = subject.budgets[position];
    const std::optional<BudgetModel> model = foreign_model(budget);
    if (!model || !model->can_be_evaluated()) {
        return {};
    }
    const std::vector<double> x = model->estimates(budget);
    const std::optional<std::vector<double>> c = model->derivatives(x), h = model->second_derivatives(x);
    if (!c || !h) {
        return {};
    }
    const std::size_t n = c->size();
    std::vector<OtherDerivative> others;
    for (std::size_t i = 0; i < n; ++i) {
        const AuditedRow& row = budget.rows[model->rows()[i]];
        if (!row.in_sum || !(row.used_u > 0.0) || (!row.sensitivity && !row.contribution)) {
            continue;
        }
        // The estimates were rounded, too.
        double digits = row.sensitivity_half_step;
        for (std::size_t j = 0; j < n; ++j) {
            // How far the derivative may move within the rounding of the estimates at which it was taken.
            digits += std::abs((*h)[i * n + j]) * budget.rows[model->rows()[j]].estimate->half_step;
        }
        if (agrees(row.used_sensitivity, (*c)[i], digits)) {
            continue;
        }
        OtherDerivative other{.row = model->rows()[i], .stated = row.used_sensitivity, .derivative = (*c)[i]};
        for (std::size_t b = 0; b < subject.budgets.size() && !other.of_budget; ++b) {
            if (b == position || subject.budgets[b].equation != budget.equation ||
                subject.budgets[b].rows.size() != budget.rows.size()) {
                continue;
            }
            const std::optional<std::vector<double>> there = model->derivatives(model->estimates(subject.budgets[b]));
            if (there && agrees(row.used_sensitivity, (*there)[i], row.sensitivity_half_step)) {
                other.of_budget = b;
            }
        }
        others.push_back(other);
    }
    return others;
}

void add_other_derivative(const AuditSubject& subject, std::size_t position, const OtherDerivative& other,
                          FindingCollector& findings) {
    const AuditedBudget& budget = subject.budgets[position];
    const RowAt at{.budget = position, .row = other.row, .of = budget, .is = budget.rows[other.row]};
    AuditFinding finding = finding_at(
        at, "sensitivity coefficient",
        other.of_budget
            ? say("the coefficient {stated:number} belongs to another point ({point}); here it is "
                  "{derivative:number}",
                  in_words(other.stated), subject.budgets[*other.of_budget].name, in_words(other.derivative))
            : say("the coefficient {stated:number} is not the derivative of the equation, {derivative:number}",
                  in_words(other.stated), in_words(other.derivative)));
    finding.evidence = {say("equation {equation}", budget.equation),
                        equals(say("estimate"), in_words(at.is.estimate->value, at.is.unit))};
    finding.expected = equals("c", in_words(other.derivative));
    finding.actual = equals("c", in_words(other.stated));
    finding.correct = set_sensitivity(other.row, other.derivative);
    findings.add(std::move(finding));
}

/// S02
void wrong_sensitivity(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        for (const OtherDerivative& other : other_derivatives(subject, b)) {
            if (!other.of_budget) {
                add_other_derivative(subject, b, other, findings);
            }
        }
    }
}

/// S17
void sensitivity_of_another_point(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        for (const OtherDerivative& other : other_derivatives(subject, b)) {
            if (other.of_budget) {
                add_other_derivative(subject, b, other, findings);
            }
        }
    }
}

/// S03
void model_and_rows(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        const std::optional<BudgetModel> model = foreign_model(budget);
        // A table that names its rows in words says nothing about the quantities of the equation.
        if (!model || model->without_row().size() > model->quantities().size()) {
            continue;
        }
        for (const std::string& name : model->without_row()) {
            AuditFinding finding =
                finding_of(subject, b, say("the equation has {name}, and no row stands for it", name));
            finding.kind = "without row: " + name;
            finding.evidence = {say("equation {equation}", budget.equation)};
            finding.contribution_missing = true;
            findings.add(std::move(finding));
        }
        for (std::size_t r = 0; r < budget.rows.size(); ++r) {
            const std::string& name = budget.rows[r].quantity;
            const bool used = std::find(model->rows().begin(), model->rows().end(), r) != model->rows().end();
            constexpr std::size_t k_symbol = 6;  // bytes: longer names are words for contributions beside the equation
            if (used || name.empty() || name.size() > k_symbol || gum::reason_against_name(name) ||
                !(contribution_of(budget.rows[r]) > 0.0)) {
                continue;
            }
            AuditFinding finding = finding_at({.budget = b, .row = r, .of = budget, .is = budget.rows[r]}, "",
                                              say("the row stands for {name}, which the equation does not have", name));
            finding.evidence = {say("equation {equation}", budget.equation)};
            findings.add(std::move(finding));
        }
    }
}

/// What the second-order terms of a budget add to u_c² (JCGM 100:2008, note to 5.1.2):
/// Σ_i Σ_j [½ (∂²f/∂x_i∂x_j)² + ∂f/∂x_i ∂³f/(∂x_i∂x_j²)] u_i² u_j².
struct SecondOrder {
    double vanishing = 0.0;  ///< of pairs of which one has no first-order term
    double others = 0.0;
    double shift = 0.0;  ///< ½ Σ ∂²f/∂x_i∂x_j u_i u_j r_ij: what the mean of y lies beside f of the estimates
    std::vector<std::string> pairs;  ///< of `vanishing`
};
std::optional<SecondOrder> second_order(const AuditedBudget& budget) {
    const std::optional<BudgetModel> model = foreign_model(budget);
    const std::optional<BudgetOutcome> outcome = outcome_of(budget);
    if (!model || !model->can_be_evaluated() || !outcome) {
        return std::nullopt;
    }
    const std::vector<double> x = model->estimates(budget);
    const std::optional<std::vector<double>> c = model->derivatives(x), h = model->second_derivatives(x);
    if (!c || !h) {
        return std::nullopt;
    }
    const std::size_t n = x.size();
    std::vector<double> u(n);
    for (std::size_t i = 0; i < n; ++i) {
        const AuditedRow& row = budget.rows[model->rows()[i]];
        u[i] = row.in_sum ? row.used_u : 0.0;
    }
    // ∂³f/(∂x_i∂x_j²) by differences of the second derivatives over half of u_i on either side.
    std::vector<double> third(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        if (!(u[i] > 0.0) || (*c)[i] == 0.0) {
            continue;
        }
        std::vector<double> above = x, below = x;
        // The difference is central: what it leaves out is smaller by u_i² once more, and so beyond second order.
        above[i] += 0.5 * u[i];
        below[i] -= 0.5 * u[i];
        const std::optional<std::vector<double>> up = model->second_derivatives(above),
                                                 down = model->second_derivatives(below);
        if (!up || !down) {
            return std::nullopt;
        }
        for (std::size_t j = 0; j < n; ++j) {
            third[i * n + j] = ((*up)[j * n + j] - (*down)[j * n + j]) / u[i];
        }
    }
    SecondOrder order;
    const auto vanishes = [&](std::size_t i) { return std::abs((*c)[i]) * u[i] < 1e-6 * outcome->u_c; };
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double curved = (*h)[i * n + j];
            const double term = (0.5 * curved * curved + (*c)[i] * third[i * n + j]) * u[i] * u[i] * u[j] * u[j];
            // Pairs with a first-order term of 0 are told as a contribution that is missing; the others say how far the
            // law of propagation is off where it has its terms.
            const bool missing = curved != 0.0 && u[i] > 0.0 && u[j] > 0.0 && (vanishes(i) || vanishes(j));
            (missing ? order.vanishing : order.others) += term;
            if (missing && j >= i) {
                order.pairs.push_back(i == j ? model->quantities()[i] + "²"
                                             : model->quantities()[i] + "·" + model->quantities()[j]);
            }
        }
        order.shift += 0.5 * (*h)[i * n + i] * u[i] * u[i];
    }
    for (const RowCorrelation& pair : budget.correlations) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                if (model->rows()[i] == pair.first && model->rows()[j] == pair.second) {
                    order.shift += (*h)[i * n + j] * u[i] * u[j] * pair.r;
                }
            }
        }
    }
    return order;
}

/// A row for terms of second order, or for the product of two quantities, may be there already.
bool has_second_order_row(const AuditedBudget& budget) {
    return std::any_of(budget.rows.begin(), budget.rows.end(), [](const AuditedRow& row) {
        return mentions(row, {"second order", "second-order", "2nd order", "zweiter ordnung", "higher order",
                              "product of", "·", "×"});
    });
}

/// S04
void vanishing_first_order(const AuditSubject& subject, FindingCollector& findings) {
    constexpr double k_share = 0.05;
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        const std::optional<SecondOrder> order = second_order(budget);
        if (!order || !(order->vanishing > 0.0) || has_second_order_row(budget)) {
            continue;
        }
        const double u_c = evaluate(budget).u_c;
        if (order->vanishing <= k_share * (u_c * u_c + order->vanishing)) {
            continue;
        }
        const double u = std::sqrt(order->vanishing);
        AuditFinding finding = finding_of(
            subject, b,
            say("an estimate is 0, so first-order terms vanish, and the terms of second order {pairs} are left out",
                all_of(sentences_of(order->pairs))));
        finding.evidence = {say("second order u = {u:number}", in_words(u, budget.unit)),
                            say("u_c of the rows = {u_c:number}", in_words(u_c, budget.unit)),
                            say("threshold 5 % of u_c²")};
        finding.expected = say("a term u = {u:number}", in_words(u, budget.unit));
        finding.actual = say("none");
        finding.correct = add_contribution(u, "terms of second order: " + text::all_of(order->pairs));
        findings.add(std::move(finding));
    }
}

/// Half a unit of the last digit of U with the digits of the budget.
double half_digit(const AuditedBudget& budget, double U) {
    return 0.5 * std::pow(10.0, std::floor(std::log10(U)) - budget.digits + 1);
}

/// S05
void not_linear(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        const std::optional<SecondOrder> order = second_order(budget);
        if (!order || !(order->others > 0.0) || budget.monte_carlo || has_second_order_row(budget)) {
            continue;
        }
        const BudgetOutcome outcome = evaluate(budget);
        const double u_both = std::sqrt(outcome.u_c * outcome.u_c + order->others);
        const double change = outcome.k * (u_both - outcome.u_c), delta = half_digit(budget, outcome.k * outcome.u_c);
        if (change <= delta) {
            continue;
        }
        AuditFinding finding = finding_of(subject, b,
                                          say("the equation is not linear over the uncertainties, and nothing says "
                                              "that the law of propagation was validated"));
        finding.evidence = {say("U by first order = {U:number}", in_words(outcome.k * outcome.u_c, budget.unit)),
                            say("U with second order = {U:number}", in_words(outcome.k * u_both, budget.unit)),
                            say("half a unit of the last digit = {delta:number}", in_words(delta, budget.unit))};
        finding.correct = add_contribution(std::sqrt(order->others), "terms of second order");
        findings.add(std::move(finding));
    }
}

/// S18
void value_beside_mean(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        const std::optional<SecondOrder> order = second_order(budget);
        if (!order || !budget.value || budget.monte_carlo) {
            continue;
        }
        const BudgetOutcome outcome = evaluate(budget);
        const double delta = half_digit(budget, outcome.U), shift = order->shift;
        if (std::abs(shift) <= delta) {
            continue;
        }
        AuditFinding finding = finding_of(subject, b,
                                          say("the equation bends over the uncertainties: the mean of the values lies "
                                              "{shift:number} beside the stated value",
                                              in_words(shift, budget.unit)));
        finding.evidence = {
            equals(say("value"), in_words(*budget.value, budget.unit)),
            say("half the sum of second derivatives times covariances = {shift:number}", in_words(shift, budget.unit)),
            say("half a unit of the last digit = {delta:number}", in_words(delta, budget.unit))};
        finding.expected = say_number(in_words(*budget.value + shift, budget.unit));
        finding.actual = say_number(in_words(*budget.value, budget.unit));
        finding.correct = [shift](AuditedBudget& corrected) {
            if (corrected.value) {
                *corrected.value += shift;
            }
        };
        findings.add(std::move(finding));
    }
}

/// S06
void too_few_trials(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        const std::optional<StatedMonteCarlo>& trials = budget.monte_carlo;
        const std::optional<BudgetOutcome> outcome = outcome_of(budget);
        if (!trials || !outcome) {
            continue;
        }
        // 10⁴/(1 − p) trials are a rule of thumb (JCGM 101:2008, 7.2), and the last criterion: it counts where neither
        // a numerical error nor stability is stated.
        const double least = 1e4 / (1.0 - budget.coverage.probability);
        const double delta = half_digit(budget, outcome->U);
        Sentence what;
        if (trials->numerical_error) {
            // JCGM 101:2008, 7.9: two standard deviations within the numerical tolerance.
            what = 2.0 * *trials->numerical_error > delta ? say("the numerical error of U moves its last digit")
                                                          : Sentence();
        } else if (trials->converged && !*trials->converged) {
            what = say("the trials did not become stable");
        } else if (!trials->converged && trials->trials && *trials->trials < least) {
            what = say("few trials, and no numerical error of U is stated");
        }
        if (what.empty()) {
            continue;
        }
        AuditFinding finding = finding_of(subject, b, std::move(what));
        if (trials->trials) {
            finding.evidence.push_back(say("M = {trials:number}, 10⁴/(1 − p) = {least:number}",
                                           text::shortest_plain(*trials->trials), text::significant(least, 6)));
        }
        if (trials->numerical_error) {
            finding.evidence.push_back(
                say("numerical error of U = {error:number}", in_words(*trials->numerical_error, budget.unit)));
        }
        finding.evidence.push_back(say("half a unit of the last digit = {delta:number}", in_words(delta, budget.unit)));
        findings.add(std::move(finding));
    }
}

/// S07
void not_repeatable(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        if (subject.budgets[b].monte_carlo && !subject.budgets[b].monte_carlo->repeatable) {
            AuditFinding finding = finding_of(
                subject, b,
                say("the trials cannot be repeated: seed, generator or version of the program is not on record"));
            finding.evidence = {say("budget {name}", subject.budgets[b].name)};
            findings.add(std::move(finding));
        }
    }
}

/// S08
void known_correction(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (!at.is.unapplied_correction || *at.is.unapplied_correction == 0.0) {
            return;
        }
        const double correction = *at.is.unapplied_correction, shift = at.is.used_sensitivity * correction;
        AuditFinding finding = finding_at(
            at, "estimate",
            say("a correction of {correction:number} is known and not applied; the result is off by {shift:number}",
                in_words(correction, at.is.unit), in_words(shift, at.of.unit)));
        finding.evidence = {equals("c", in_words(at.is.used_sensitivity)),
                            equals("u", in_words(at.is.used_u, at.is.unit))};
        finding.correct = [shift](AuditedBudget& budget) {
            if (budget.value) {
                *budget.value += shift;
            }
        };
        findings.add(std::move(finding));
    });
}

/// Two rows with one source.
struct SharedSource {
    std::size_t budget = 0, first = 0, second = 0;
};
bool have_correlation(const AuditedBudget& budget, std::size_t a, std::size_t b) {
    const std::string &one = budget.rows[a].input, &other = budget.rows[b].input;
    return std::any_of(budget.correlations.begin(), budget.correlations.end(),
                       [a, b](const RowCorrelation& pair) {
                           return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
                       }) ||
           (one != other && std::any_of(budget.inputs_with_correlation.begin(), budget.inputs_with_correlation.end(),
                                        [&](const std::set<std::string>& inputs) {
                                            return inputs.contains(one) && inputs.contains(other);
                                        }));
}
/// What a row comes from: its source; in a table without such a column the whole comment, where it has words enough and
/// a number to be that of one document or one history.
std::string source_of(const AuditedRow& row) {
    if (!row.source.empty()) {
        return gum::without_spelling(row.source);
    }
    constexpr std::size_t k_least = 20;  // bytes
    const bool is_source = row.comment.size() >= k_least &&
                           row.comment.find_first_of("0123456789") != std::string::npos &&
                           (row.origin == Origin::certificate || row.contributor == Contributor::reference_drift);
    return is_source ? gum::without_spelling(row.comment) : std::string();
}
const std::string& named_source(const AuditedRow& row) {
    return row.source.empty() ? row.comment : row.source;
}
/// Pairs of rows from one source. Of a source with many rows each is paired with the first of them only.
std::vector<SharedSource> shared_sources(const AuditSubject& subject) {
    constexpr std::size_t k_many = 20;
    std::vector<SharedSource> shared;
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const std::vector<AuditedRow>& rows = subject.budgets[b].rows;
        std::map<std::string, std::vector<std::size_t>> by_source;
        std::vector<const std::vector<std::size_t>*> groups;  // by their first rows
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::string source = contribution_of(rows[i]) > 0.0 ? source_of(rows[i]) : std::string();
            if (!source.empty()) {
                std::vector<std::size_t>& group = by_source[source];
                if (group.empty()) {
                    groups.push_back(&group);
                }
                group.push_back(i);
            }
        }
        const std::size_t before = shared.size();
        for (const std::vector<std::size_t>* group : groups) {
            // All pairs of hundreds of rows would be tens of thousands of findings that say one thing.
            for (std::size_t i = 0; i < (group->size() > k_many ? 1 : group->size()); ++i) {
                for (std::size_t j = i + 1; j < group->size(); ++j) {
                    shared.push_back({b, (*group)[i], (*group)[j]});
                }
            }
        }
        std::sort(shared.begin() + static_cast<std::ptrdiff_t>(before), shared.end(),
                  [](const SharedSource& x, const SharedSource& y) {
                      return std::pair(x.first, x.second) < std::pair(y.first, y.second);
                  });
    }
    return shared;
}

/// Whether two rows are the drift of one standard twice, or its drift beside its limit of error, which holds it.
bool counts_twice(const AuditedRow& a, const AuditedRow& b) {
    const bool two_drifts =
        a.contributor == Contributor::reference_drift && b.contributor == Contributor::reference_drift;
    const bool within_limit = a.origin == Origin::specification && b.contributor == Contributor::reference_drift &&
                              b.origin != Origin::specification;
    return a.unit == b.unit && (two_drifts || within_limit);
}

/// S09
void counted_twice(const AuditSubject& subject, FindingCollector& findings) {
    for (const SharedSource& pair : shared_sources(subject)) {
        const AuditedBudget& budget = subject.budgets[pair.budget];
        std::size_t kept = pair.first, left = pair.second;
        if (!counts_twice(budget.rows[kept], budget.rows[left])) {
            std::swap(kept, left);
            if (!counts_twice(budget.rows[kept], budget.rows[left])) {
                continue;
            }
        }
        const bool drifts = budget.rows[kept].contributor == Contributor::reference_drift;
        const std::string& name = named_source(budget.rows[left]);
        AuditFinding finding = finding_at(
            {.budget = pair.budget, .row = left, .of = budget, .is = budget.rows[left]}, "",
            drifts ? say("the drift of {source} stands in the budget twice, also as {row}", name,
                         name_of_row(budget, kept))
                   : say("the drift of {source} is within the limit of error, {row}", name, name_of_row(budget, kept)));
        finding.evidence = {
            say("|c| u = {first:number} and {second:number}", in_words(contribution_of(budget.rows[kept]), budget.unit),
                in_words(contribution_of(budget.rows[left]), budget.unit)),
            say("source {name}", name)};
        finding.correct = leave_out(left);
        findings.add(std::move(finding));
    }
}

/// What the rows of a budget give by themselves, whatever is claimed.
AuditedBudget of_rows(AuditedBudget budget) {
    budget.u_c_over_rows = budget.k_over_rows = budget.U_over_k_u_c = budget.within_digits = budget.U_within_digits =
        1.0;
    return budget;
}

/// What u_c is where two rows are correlated.
std::string u_with_correlation(const AuditedBudget& budget, std::size_t a, std::size_t b, double r) {
    AuditedBudget with = of_rows(budget);
    with.correlations.push_back({.first = a, .second = b, .r = r});
    const std::optional<BudgetOutcome> outcome = outcome_of(with);
    return outcome ? in_words(outcome->u_c, budget.unit) : "0";
}

/// \param of_fit  the rows are parameters of one fit
void add_neglected_correlation(const AuditSubject& subject, const SharedSource& pair, bool of_fit,
                               FindingCollector& findings) {
    const AuditedBudget& budget = subject.budgets[pair.budget];
    const std::optional<BudgetOutcome> outcome = outcome_of(of_rows(budget));
    const std::string& source = named_source(budget.rows[pair.second]);
    const Sentence other = name_of_row(budget, pair.first);
    AuditFinding finding = finding_at(
        {.budget = pair.budget, .row = pair.second, .of = budget, .is = budget.rows[pair.second]}, "",
        of_fit
            ? say("the parameter comes from the same fit {source} as {row}, and no correlation is stated", source,
                  other)
            : say("the row comes from the same source {source} as {row}, and no correlation is stated", source, other));
    finding.evidence = {
        say("u_c with r = 0: {u_c:number}", outcome ? Sentence(in_words(outcome->u_c, budget.unit)) : say("none")),
        say("with r = 1: {u_c:number}", u_with_correlation(budget, pair.first, pair.second, 1.0)),
        say("with r = -1: {u_c:number}", u_with_correlation(budget, pair.first, pair.second, -1.0))};
    findings.add(std::move(finding));
}

/// S10
void neglected_correlation(const AuditSubject& subject, FindingCollector& findings) {
    for (const SharedSource& pair : shared_sources(subject)) {
        const AuditedBudget& budget = subject.budgets[pair.budget];
        if (!budget.unread_correlations.empty()) {
            findings.leave_unchecked(
                say("{table}: a correlation is stated, and it was not read of which rows", budget.place));
            continue;
        }
        const AuditedRow &a = budget.rows[pair.first], &b = budget.rows[pair.second];
        // One certificate, one sensor: the same error is in both. A drift or a resolution is an effect of its own.
        const bool certificates = a.origin == Origin::certificate && b.origin == Origin::certificate;
        const bool sensors = a.contributor == Contributor::temperature && b.contributor == Contributor::temperature &&
                             a.origin != Origin::resolution && b.origin != Origin::resolution &&
                             !a.type_a.value_or(false) && !b.type_a.value_or(false);
        const bool fits = a.contributor == Contributor::fit && b.contributor == Contributor::fit;
        if ((certificates || sensors) && !fits && !have_correlation(budget, pair.first, pair.second)) {
            add_neglected_correlation(subject, pair, false, findings);
        }
    }
}

/// S13
void neglected_fit_covariance(const AuditSubject& subject, FindingCollector& findings) {
    for (const SharedSource& pair : shared_sources(subject)) {
        const AuditedBudget& budget = subject.budgets[pair.budget];
        if (!budget.unread_correlations.empty()) {
            findings.leave_unchecked(
                say("{table}: a correlation is stated, and it was not read of which rows", budget.place));
            continue;
        }
        if (budget.rows[pair.first].contributor == Contributor::fit &&
            budget.rows[pair.second].contributor == Contributor::fit &&
            !have_correlation(budget, pair.first, pair.second)) {
            add_neglected_correlation(subject, pair, true, findings);
        }
    }
}

/// S11
void impossible_correlations(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        bool outside = false;
        const auto n = static_cast<Eigen::Index>(budget.rows.size());
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
        for (const RowCorrelation& pair : budget.correlations) {
            if (!(std::abs(pair.r) <= 1.0)) {
                outside = true;
                AuditFinding finding =
                    finding_of(subject, b,
                               say("the correlation of {first} and {second} lies outside of -1 to 1",
                                   name_of_row(budget, pair.first), name_of_row(budget, pair.second)));
                finding.evidence = {equals("r", in_words(pair.r))};
                findings.add(std::move(finding));
            }
            const auto i = static_cast<Eigen::Index>(pair.first), j = static_cast<Eigen::Index>(pair.second);
            matrix(i, j) = matrix(j, i) = pair.r;
        }
        if (outside || budget.correlations.empty() || gum::is_positive_semidefinite(matrix)) {
            continue;
        }
        // Printed coefficients may miss by their rounding: what two decimals leave open is forgiven.
        constexpr double k_printed = 0.005;
        Eigen::MatrixXd tolerance = Eigen::MatrixXd::Zero(n, n);
        for (const RowCorrelation& pair : budget.correlations) {
            const auto i = static_cast<Eigen::Index>(pair.first), j = static_cast<Eigen::Index>(pair.second);
            tolerance(i, j) = tolerance(j, i) = k_printed;
        }
        if (gum::nearest_correlation(matrix, tolerance)) {
            continue;
        }
        AuditFinding finding = finding_of(
            subject, b, say("the correlations contradict each other: the matrix is not positive semi-definite"));
        for (const RowCorrelation& pair : budget.correlations) {
            finding.evidence.push_back(say("r = {r:number} of {first} and {second}", in_words(pair.r),
                                           name_of_row(budget, pair.first), name_of_row(budget, pair.second)));
        }
        findings.add(std::move(finding));
    }
}

/// S12
void degrees_of_freedom_of_correlated_rows(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        const std::optional<BudgetOutcome> outcome = outcome_of(budget);
        // A claimed k that is that of the correlated rows as one contribution is right.
        const bool is_right = budget.claims.k && budget.coverage.correlated == CorrelatedRows::one_contribution;
        if (!outcome || budget.evaluated_here || budget.coverage.kind != CoverageRule::Kind::student_t || is_right ||
            !std::isfinite(outcome->nu_eff)) {
            continue;
        }
        for (const RowCorrelation& pair : budget.correlations) {
            const AuditedRow &first = budget.rows[pair.first], &second = budget.rows[pair.second];
            // With infinite degrees of freedom the formula has nothing to combine, and correlation does no harm to it.
            if (pair.r == 0.0 || (!std::isfinite(first.used_nu) && !std::isfinite(second.used_nu)) ||
                contribution_of(first) == 0.0 || contribution_of(second) == 0.0) {
                continue;
            }
            AuditFinding finding = finding_of(subject, b,
                                              say("ν_eff comes from the Welch-Satterthwaite formula, which holds for "
                                                  "independent rows; {first} and {second} are correlated",
                                                  name_of_row(budget, pair.first), name_of_row(budget, pair.second)));
            finding.kind = name_of_row(budget, pair.first).english() + name_of_row(budget, pair.second).english();
            finding.evidence = {
                equals("r", in_words(pair.r)),
                say("ν = {first:number} and {second:number}", in_words(first.used_nu), in_words(second.used_nu)),
                equals("ν_eff", in_words(outcome->nu_eff)), equals("k", in_words(outcome->k))};
            findings.add(std::move(finding));
        }
    }
}

/// S15 of a specification that grows with the length. Coordinate measuring machines have A + L/K with K from 100 to 2000
/// mm/µm: a relative part from 5E-7 to 1E-5.
void implausible_length_part(const AuditSubject& subject, FindingCollector& findings) {
    constexpr double k_least = 5e-7, k_most = 1e-5;
    for_each_row(subject, [&findings](const RowAt& at) {
        if (!at.is.limit_constant || !at.is.limit_per_length || !(*at.is.limit_per_length > 0.0)) {
            return;
        }
        // "L in mm" beside micrometres makes the number a thousand times as large.
        const double stated = *at.is.limit_per_length;
        const double relative = mentions(at.is, {"l in mm"}) ? stated * 1e-3 : stated;
        if (relative >= k_least && relative <= k_most) {
            return;
        }
        double factor = 0.0;
        for (const double tried : {10.0, 0.1, 100.0, 0.01, 1000.0, 0.001}) {
            if (factor == 0.0 && relative * tried >= k_least && relative * tried <= k_most) {
                factor = tried;
            }
        }
        AuditFinding finding = finding_at(at, "specification",
                                          say("the part {stated:number} of the specification that grows with the "
                                              "length is not that of a coordinate measuring machine",
                                              in_words(stated)));
        finding.evidence = {say("specification {constant:number} + {growing:number} L", in_words(*at.is.limit_constant),
                                in_words(stated)),
                            say("known specifications: 5E-7 to 1E-5 of the length")};
        finding.expected =
            factor > 0.0 ? say("{factor:number}, if one power of ten is wrong", in_words(stated * factor)) : "";
        finding.actual = say_number(in_words(stated));
        finding.question = "Which exponent does the data sheet of the machine state, and in which unit is L?";
        if (factor > 0.0 && at.is.origin_value && *at.is.origin_value > *at.is.limit_constant) {
            const double growing = *at.is.origin_value - *at.is.limit_constant;
            finding.correct = scale_u(at.row, (*at.is.limit_constant + factor * growing) / *at.is.origin_value);
        }
        findings.add(std::move(finding));
    });
}

/// S15 of the words of a row: a rate per year times days, divided by the months of a year.
void days_over_months(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        if (!mentions(at.is, {"/yr", "/year", "per year", "/a ", "/a)", "/jahr", "pro jahr"}) ||
            !mentions(at.is, {"days/12", "days / 12", "d/12", "tage/12", "tage / 12"})) {
            return;
        }
        AuditFinding finding =
            finding_at(at, "u", say("a rate per year times days divided by 12: the units of time do not close"));
        finding.evidence = {equals("u", in_words(at.is.used_u, at.is.unit))};
        finding.expected = say("days/365");
        finding.actual = say("days/12");
        finding.question = "Is the age of the calibration meant in days, months or years?";
        finding.correct = scale_u(at.row, 12.0 / 365.0);
        findings.add(std::move(finding));
    });
}

/// S15
void implausible_constant(const AuditSubject& subject, FindingCollector& findings) {
    implausible_length_part(subject, findings);
    days_over_months(subject, findings);
    for_each_row(subject, [&findings](const RowAt& at) {
        const ConstantRange* range = constant_range(at.is);
        const std::optional<gum::Unit> unit = unit_in(at.is.unit);
        if (range == nullptr || !unit || !at.is.estimate || at.is.estimate->value == 0.0 ||
            mentions(at.is, {"difference", "differenz", "δ", "Δ", "delta", "unterschied", "unsicherheit"})) {
            return;
        }
        const gum::Unit si = gum::Unit::parse(range->unit);
        if (!(si.dimension() == unit->dimension())) {
            return;
        }
        // The ranges are of the constants themselves. A difference of two of them, which the words above tell, may have
        // any size.
        const double value = unit->to_si(at.is.estimate->value);
        const double digits = unit->difference_to_si(at.is.estimate->half_step);
        if (value + digits >= range->low && value - digits <= range->high) {
            return;
        }
        Sentence power;
        for (int exponent = -6; exponent <= 6 && power.empty(); ++exponent) {
            const double moved = value * std::pow(10.0, exponent);
            if (exponent != 0 && moved >= range->low && moved <= range->high) {
                power = say("times 10^{exponent:number} it would be plausible", std::to_string(exponent));
            }
        }
        AuditFinding finding = finding_at(at, "estimate", say("not a plausible value for the {kind}", range->kind));
        finding.evidence = {equals(say("estimate"), in_words(at.is.estimate->value, at.is.unit))};
        if (!power.empty()) {
            finding.evidence.push_back(power);
        }
        finding.expected = say("{low:number} to {high:number}", in_words(unit->from_si(range->low)),
                               in_words(unit->from_si(range->high), at.is.unit));
        finding.actual = say_number(in_words(at.is.estimate->value, at.is.unit));
        findings.add(std::move(finding));
    });
}

/// A name without "(2)" at its end, and with its words or factors in alphabetical order.
std::string order_free_name(const std::string& name) {
    std::string bare = name;
    const std::size_t open = bare.rfind('(');
    if (open != std::string::npos && open > 0 && bare.back() == ')' &&
        bare.find_first_not_of("0123456789", open + 1) == bare.size() - 1) {
        bare.resize(open);
    }
    for (const std::string_view sign : {"·", "×", "*"}) {
        for (std::size_t at = bare.find(sign); at != std::string::npos; at = bare.find(sign)) {
            bare.replace(at, sign.size(), " ");
        }
    }
    std::vector<std::string> words;
    for (std::size_t at = 0; at < bare.size();) {
        const std::size_t end = std::min(bare.find(' ', at), bare.size());
        if (end > at) {
            words.push_back(gum::without_spelling(bare.substr(at, end - at)));
        }
        at = end + 1;
    }
    std::sort(words.begin(), words.end());
    std::string all;
    for (const std::string& word : words) {
        all += word + " ";
    }
    return all;
}

/// Whether two rows of one name are one contribution.
bool is_same_contribution(const AuditedRow& a, const AuditedRow& b) {
    const bool resolution = a.origin == Origin::resolution || b.origin == Origin::resolution ||
                            a.contributor == Contributor::item_resolution ||
                            a.contributor == Contributor::reference_resolution;
    const bool other_source = !a.source.empty() && !b.source.empty() && a.source != b.source;
    const bool other_estimate = a.estimate && b.estimate && a.estimate->value != b.estimate->value;
    // Two displays of one step have equal rows rightly; so have two standards of one kind, where source or estimate
    // differ.
    return !resolution && !other_source && !other_estimate && contribution_of(a) > 0.0 && a.used_u == b.used_u &&
           std::abs(a.used_sensitivity) == std::abs(b.used_sensitivity) && a.unit == b.unit && b.in_sum &&
           a.used_nu == b.used_nu;
}

/// S16: each row against the first that it is the same as.
void equal_rows(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        std::map<std::string, std::vector<std::size_t>> by_name;  // rows that are the same as none before them
        for (std::size_t j = 0; j < budget.rows.size(); ++j) {
            const AuditedRow& row = budget.rows[j];
            if (row.quantity.empty()) {
                continue;
            }
            std::vector<std::size_t>& others = by_name[order_free_name(row.quantity)];
            const auto same = std::find_if(others.begin(), others.end(), [&](std::size_t i) {
                return is_same_contribution(budget.rows[i], row) && !have_correlation(budget, i, j);
            });
            if (same == others.end()) {
                others.push_back(j);
                continue;
            }
            AuditFinding finding = finding_at({.budget = b, .row = j, .of = budget, .is = row}, "",
                                              say("the same contribution as {row}", name_of_row(budget, *same)));
            finding.evidence = {equals("u", in_words(row.used_u, row.unit)),
                                equals("c", in_words(row.used_sensitivity))};
            finding.correct = leave_out(j);
            findings.add(std::move(finding));
        }
    }
}

}  // namespace

std::vector<Rule> model_rules() {
    using enum SeverityPolicy;
    using enum FindingSeverity;
    return {
        {.id = "S01",
         .title = "Sensitivity coefficient with a wrong unit",
         .clause = {.text = "JCGM 100:2008, 5.1.3", .verified = true},
         .severity = critical,
         .needs = {Need::rows},
         .detection =
             "the unit of a coefficient is not that of the result per that of the row; or no coefficient and two "
             "units; or 1 and two units of one kind, or a part of a value (percent, ppm) in a budget of another "
             "unit, which is major: 1 per percent may be right",
         .correction = "State the coefficient in the unit of the result per unit of the row.",
         .question = "How does a number in the unit of the row become one in the unit of the result?",
         .examine = unit_of_sensitivity},
        {.id = "S02",
         .title = "Sensitivity coefficient is not the derivative",
         .clause = {.text = "JCGM 100:2008, 5.1.3", .verified = true},
         .severity = critical,
         .needs = {Need::model},
         .detection =
             "exact derivative of the stated equation at the estimates, against the stated coefficient: more than "
             "1 % beyond the printed digits of coefficient and estimates",
         .correction = "Take the derivative of the equation at the estimates.",
         .question = "Equation and coefficient contradict each other. Which of the two describes the measurement?",
         .examine = wrong_sensitivity},
        {.id = "S03",
         .title = "Equation and rows have different quantities",
         .clause = {.text = "JCGM 100:2008, 4.1.2", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::model},
         .detection =
             "a quantity of the equation without a row, or a row with a symbol that the equation does not have",
         .correction = "Give each quantity of the equation its row, or say with a number why it does not count.",
         .question =
             "Is the quantity known so well that it needs no row, or was it forgotten in one of the two places?",
         .examine = model_and_rows},
        {.id = "S04",
         .title = "Terms of second order left out where first-order terms vanish",
         .clause = {.text = "JCGM 100:2008, 5.1.2 (note) and H.1.7", .verified = true},
         .severity = major,
         .needs = {Need::model},
         .detection =
             "an estimate of 0 makes a coefficient 0, and the products of second order are more than 5 % of u_c²",
         .correction = "Add the terms of second order to the budget.",
         .question = "The estimate of a factor is 0, but its uncertainty is not. Where in the budget is their product?",
         .examine = vanishing_first_order},
        {.id = "S05",
         .title = "Non-linear equation, law of propagation not validated",
         .clause = {.text = "JCGM 101:2008, 8.1", .verified = false},
         .severity = major,
         .needs = {Need::model},
         .detection =
             "the terms of second order change U by more than half a unit of its last digit, and no Monte Carlo "
             "result is stated",
         .correction = "Validate U by the propagation of distributions, or add the terms of second order.",
         .question = "The equation bends within the uncertainties. Was U compared with a Monte Carlo result?",
         .examine = not_linear},
        {.id = "S06",
         .title = "Monte Carlo with too few trials",
         .clause = {.text = "JCGM 101:2008, 7.2 and 7.9", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows},
         .detection =
             "twice the numerical error of U above half a unit of its last digit; where none is stated, trials that "
             "were not stable, or fewer than 10⁴/(1 − p)",
         .correction = "State the numerical error of U, and increase the number of trials until it is small enough.",
         .question = "How far would U move if the trials were repeated with another seed?",
         .examine = too_few_trials},
        {.id = "S07",
         .title = "Monte Carlo result that cannot be repeated",
         .clause = {.text = "ISO/IEC 17025:2017, 7.5.1", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows},
         .detection = "seed, generator or version of the program is not on record",
         .correction = "Record seed, generator and version.",
         .question = "How would the laboratory show the same number again?",
         .examine = not_repeatable},
        {.id = "S08",
         .title = "Known correction not applied",
         .clause = {.text = "JCGM 100:2008, 3.2.4", .verified = true},
         .severity = major,
         .needs = {Need::rows},
         .detection = "a comment that names a correction and says that it is not applied",
         .correction = "Apply the correction, and state the uncertainty of the correction.",
         .question = "The error is known. Why does the result carry it?",
         .examine = known_correction},
        {.id = "S09",
         .title = "Same effect counted twice",
         .clause = {.text = "JCGM 100:2008, 4.3.10", .verified = true},
         .severity = major,
         .needs = {Need::rows},
         .detection = "two rows of drift with one source, or a drift beside the limit of error of the same instrument",
         .correction = "Leave one of them out.",
         .question = "Do the two rows stand for two effects, or for one effect that was found in two ways?",
         .examine = counted_twice},
        {.id = "S10",
         .title = "Correlation neglected",
         .clause = {.text = "JCGM 100:2008, 5.2.2 and F.1.2", .verified = true},
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows},
         .detection = "two rows from one certificate or one sensor, and no correlation between them",
         .correction = "State the correlation, or have the common source as a quantity of the equation.",
         .question = "An error of the common source is in both rows at once. Do they add or cancel?",
         .examine = neglected_correlation},
        {.id = "S11",
         .title = "Impossible correlations",
         .clause = {.text = "JCGM 100:2008, 5.2.2", .verified = true},
         .severity = critical,
         .needs = {Need::rows},
         .detection = "a coefficient outside of −1 to 1, or a matrix that is not positive semi-definite even where two "
                      "decimals of every coefficient are left open",
         .correction = "Take the coefficients from one covariance matrix.",
         .question = "Where do the coefficients come from?",
         .examine = impossible_correlations},
        {.id = "S12",
         .title = "Welch–Satterthwaite formula with correlated rows",
         .clause = {.text = "JCGM 100:2008, G.4.1", .verified = true},
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows},
         .detection = "k = t_p(ν_eff) where correlated rows have finite ν",
         .correction = "Let correlated quantities enter as one contribution with the ν of their covariance matrix.",
         .question =
             "The formula holds for independent rows. How many degrees of freedom have the correlated ones together?",
         .examine = degrees_of_freedom_of_correlated_rows},
        {.id = "S13",
         .title = "Parameters of a fit treated as independent",
         .clause = {.text = "JCGM 100:2008, H.3", .verified = true},
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows},
         .detection = "two rows of one fit without a correlation",
         .correction = "State the covariance of the parameters, or refer the fit to the middle of its points.",
         .question = "Slope and intercept of one fit depend on each other. Where is their covariance?",
         .examine = neglected_fit_covariance},
        {.id = "S15",
         .title = "Implausible constant",
         .clause = {.text = "JCGM 100:2008, 4.3.1", .verified = false},
         .severity = major,
         .needs = {Need::rows},
         .detection = "a constant whose words name material and kind, outside of the range that any grade of it has; "
                      "in the words "
                      "of a row a rate per year times days/12",
         .correction = "Correct the power of ten or the unit.",
         .question = "Is the number in the unit that the table states?",
         .examine = implausible_constant},
        {.id = "S16",
         .title = "Two rows are the same contribution",
         .clause = {.text = "JCGM 100:2008, 4.3.10", .verified = true},
         .severity = major,
         .needs = {Need::rows},
         .detection = "equal u, coefficient, unit and ν under one name, or the same factors in another order",
         .correction = "Leave one of them out.",
         .question = "Are these two effects of the same size, or one effect twice?",
         .examine = equal_rows},
        {.id = "S17",
         .title = "Sensitivity coefficient of another point",
         .clause = {.text = "JCGM 100:2008, 5.1.3", .verified = true},
         .severity = major,
         .needs = {Need::model},
         .detection =
             "a stated coefficient that is the derivative at another point of the same table, and not at its own",
         .correction = "Take the derivative at the estimates of the point.",
         .question = "Was the row copied from another point without its coefficient?",
         .examine = sensitivity_of_another_point},
        {.id = "S18",
         .title = "Value beside the mean of a non-linear equation",
         .clause = {.text = "JCGM 100:2008, 4.1.4 (note)", .verified = false},
         .severity = major,
         .needs = {Need::model},
         .detection =
             "half the sum of second derivatives times covariances above half a unit of the last printed digit",
         .correction = "Correct the value by the term of second order, or say that it stands for f of the estimates.",
         .question = "Is the stated value meant as f of the estimates or as the mean of what the quantity may be?",
         .examine = value_beside_mean},
        certified_bound_rule(),
    };
}

}  // namespace gumcert::audit
