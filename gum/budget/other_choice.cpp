#include "gum/budget/other_choice.h"

#include <algorithm>
#include <cmath>

#include "gum/monte_carlo/random_draws.h"
#include "gum/rounding.h"

namespace gumcert::gum {

namespace {

constexpr std::uint64_t k_trials_looked_at = 4096;
constexpr Eigen::Index k_trials_in_a_block = 512;
constexpr double k_same = 0.01;  // of half the width of the interval: no printed digit
// Of it, too, about a tenth of u: what is added again in some trials is taken off in others.
constexpr double k_same_on_mean = 0.05;

double half_width(const MonteCarloOutput& trials) {
    return 0.5 * (trials.symmetric.high - trials.symmetric.low);
}

std::string in_unit(double si, double u, const Unit& unit) {
    const std::string people = unit_for_people(unit.text());
    const double difference = unit.difference_from_si(u);
    const std::string number = difference > 0.0 ? round_to_uncertainty(unit.from_si(si), difference, 2).value
                                                : round_significant(unit.from_si(si), 6);
    return people.empty() ? number : number + (people.starts_with("°") && people.size() == 2 ? "" : " ") + people;
}

/// What numbers beside a result are rounded by.
double digits_by(const BudgetOutputResult& of) {
    return of.has_u ? of.monte_carlo->standard_uncertainty : 0.5 * half_width(*of.monte_carlo);
}

/// The point at which something is told of an output, where it is worst, and how many there are.
struct WorstPoint {
    const BudgetPointResult* at = nullptr;  ///< null: nothing is told
    std::size_t column = 0;                 ///< of the output
    std::size_t points = 0;

    [[nodiscard]] double value() const { return at->propagation.value(static_cast<Eigen::Index>(column)); }
};

/// \param measure  of a point and a column: how bad it is, 0 where nothing is told
template <class Measure>
WorstPoint worst_point(const BudgetResult& result, const std::string& output, const Measure& measure) {
    WorstPoint worst;
    double most = 0.0;
    for (const BudgetPointResult& point : result.points) {
        for (std::size_t i = 0; i < point.outputs.size(); ++i) {
            const BudgetOutputResult& of = point.outputs[i];
            const double here = of.name == output ? measure(point, i) : 0.0;
            if (here > most) {
                most = here;
                worst.at = &point;
                worst.column = i;
            }
            worst.points += here > 0.0 ? 1 : 0;
        }
    }
    return worst;
}

std::string place_of(const Budget& budget, const WorstPoint& worst, const std::string& output) {
    return "result " + output + (worst.at->point ? " at point " + budget.points[*worst.at->point].name : "") +
           (worst.points > 1 ? ", and at " + std::to_string(worst.points - 1) + " more" : "");
}

/// By how much the value of the equations at the estimates lies outside of the interval of the trials, in halves of its width.
double outside(const BudgetPointResult& point, std::size_t column) {
    const MonteCarloOutput& trials = *point.outputs[column].monte_carlo;
    const double value = point.propagation.value(static_cast<Eigen::Index>(column));
    const double half = half_width(trials);
    return half > 0.0 ? std::max(trials.symmetric.low - value, value - trials.symmetric.high) / half : 0.0;
}

}  // namespace

std::vector<double> shares_of_other_choices(const BudgetPointResult& point, std::uint64_t seed) {
    const std::size_t outputs = point.outputs.size();
    std::vector<double> shares(outputs, 0.0);
    std::vector<double> without_value(outputs, 0.0);
    std::vector<double> moved(outputs, 0.0);  // sum of what the choices move
    const BudgetModel& model = *point.model;
    if (!model.has_choices()) {
        return shares;
    }
    const InputDraws draws(model.inputs(), seed, point.streams);
    Eigen::MatrixXd x(k_trials_in_a_block, draws.size());
    Eigen::MatrixXd y(k_trials_in_a_block, static_cast<Eigen::Index>(outputs));
    Eigen::MatrixXd as_chosen(y.rows(), y.cols());
    for (std::uint64_t first = 0; first < k_trials_looked_at; first += static_cast<std::uint64_t>(x.rows())) {
        draws.draw(first, x);
        model.evaluate_trials(x, y);
        model.evaluate_as_chosen(x, as_chosen);
        for (std::size_t i = 0; i < outputs; ++i) {
            const auto& trials = point.outputs[i].monte_carlo;
            if (!trials) {
                continue;
            }
            const double same = k_same * half_width(*trials);
            const auto column = static_cast<Eigen::Index>(i);
            const auto by_choice = (y.col(column) - as_chosen.col(column)).array();
            // What has no value without the choice is another one, too.
            shares[i] += static_cast<double>(x.rows() - (by_choice.abs() <= same).count());
            without_value[i] += static_cast<double>(by_choice.isNaN().count());
            moved[i] += by_choice.isNaN().select(0.0, by_choice).sum();
        }
    }
    for (std::size_t i = 0; i < outputs; ++i) {
        const auto& trials = point.outputs[i].monte_carlo;
        const double count = static_cast<double>(k_trials_looked_at);
        const bool is_moved = trials && std::abs(moved[i]) > count * k_same_on_mean * half_width(*trials);
        shares[i] = is_moved || without_value[i] >= count * k_other_choice_matters ? shares[i] / count : 0.0;
    }
    return shares;
}

std::optional<Diagnostic> other_choice_message(const Budget& budget, const BudgetResult& result,
                                               const std::string& output) {
    const WorstPoint worst = worst_point(result, output, [](const BudgetPointResult& point, std::size_t column) {
        const BudgetOutputResult& of = point.outputs[column];
        return of.by_monte_carlo && of.other_choice >= k_other_choice_matters ? of.other_choice : 0.0;
    });
    if (worst.at == nullptr) {
        return std::nullopt;
    }
    const BudgetOutputResult& of = worst.at->outputs[worst.column];
    const double u = digits_by(of);
    const std::string value = in_unit(worst.value(), u, of.unit);
    return Diagnostic{
        .code = "GC-BUDGET-0044",
        .where = place_of(budget, worst, output),
        .what = "max, min or abs takes another of its values than at the estimates in " +
                round_significant(100.0 * of.other_choice, 2) + " % of the trials of Monte Carlo" +
                (of.has_u ? ": the equations give " + value + " at the estimates, and the mean of the trials is " +
                                in_unit(of.monte_carlo->mean, u, of.unit)
                          : ": the equations give " + value + " at the estimates"),
        .rule =
            "Monte Carlo takes distributions as what is known of the inputs (JCGM 101:2008, 7.6); the largest of "
            "estimates that were measured holds their errors already, and trials add such errors once more",
        .action =
            "Where these inputs were measured, state them as results with their U in place of what is chosen from "
            "them, or add readings until they differ by more than their uncertainties; where they are limits or "
            "settings, the result holds.",
        .severity = Severity::warning};
}

std::optional<Diagnostic> value_outside_message(const Budget& budget, const BudgetResult& result,
                                                const std::string& output) {
    const WorstPoint worst = worst_point(result, output, [](const BudgetPointResult& point, std::size_t column) {
        const BudgetOutputResult& of = point.outputs[column];
        const double beyond = of.by_monte_carlo ? outside(point, column) : 0.0;
        return of.other_choice < k_other_choice_matters && beyond > k_same_on_mean ? beyond : 0.0;
    });
    if (worst.at == nullptr) {
        return std::nullopt;
    }
    const BudgetOutputResult& of = worst.at->outputs[worst.column];
    const double u = digits_by(of);
    return Diagnostic{
        .code = "GC-BUDGET-0045",
        .where = place_of(budget, worst, output),
        .what = "the equations give " + in_unit(worst.value(), u, of.unit) +
                " at the estimates, outside of the interval of Monte Carlo, " +
                in_unit(of.monte_carlo->symmetric.low, u, of.unit) + " to " +
                in_unit(of.monte_carlo->symmetric.high, u, of.unit),
        .rule =
            "Monte Carlo takes distributions as what is known of the inputs (JCGM 101:2008, 7.6); near the least "
            "or the largest value of a model all trials lie on one side of the value at the estimates",
        .action =
            "Where these inputs were measured, state them as results with their U in place of what is computed from "
            "them; where they are settings that are known to lie about their estimates, the result holds.",
        .severity = Severity::warning};
}

bool is_mean_in_doubt(const BudgetPointResult& point, std::size_t output) {
    const BudgetOutputResult& of = point.outputs[output];
    return of.by_monte_carlo && of.has_u &&
           (of.other_choice >= k_other_choice_matters || outside(point, output) > k_same_on_mean);
}

std::string law_beside_trials(const Budget& budget, const BudgetResult& result, const std::string& output,
                              const std::string& reason) {
    const WorstPoint worst = worst_point(result, output, [&reason](const BudgetPointResult& point, std::size_t column) {
        const BudgetOutputResult& of = point.outputs[column];
        if (of.against != reason || !of.has_u || !of.monte_carlo || !of.expanded_uncertainty) {
            return 0.0;
        }
        const double value = point.propagation.value(static_cast<Eigen::Index>(column));
        const double U = *of.expanded_uncertainty;
        const CoverageInterval& interval = of.monte_carlo->symmetric;
        const double apart = std::max(std::abs(value - U - interval.low), std::abs(value + U - interval.high));
        const double scale = half_width(*of.monte_carlo);
        return scale > 0.0 ? apart / scale : 0.0;
    });
    if (worst.at == nullptr) {
        return "";
    }
    const BudgetOutputResult& of = worst.at->outputs[worst.column];
    const double u = digits_by(of);
    const auto print = [&](double si) { return in_unit(si, u, of.unit); };
    const double value = worst.value();
    const bool is_one_of_many = worst.at->point && result.points.size() > 1;
    const double U = *of.expanded_uncertainty;
    return (is_one_of_many ? ": at point " + budget.points[*worst.at->point].name + " the law" : ": the law") +
           " gives " + print(value) + ", from " + print(value - U) + " to " + print(value + U) + ", and Monte Carlo " +
           print(of.monte_carlo->mean) + ", from " + print(of.monte_carlo->symmetric.low) + " to " +
           print(of.monte_carlo->symmetric.high);
}

}  // namespace gumcert::gum
