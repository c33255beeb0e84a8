#include "gum/comparison/scored_result.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "gum/argument_check.h"
#include "gum/comparison/laboratory_covariance.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/rounding.h"
#include "text/numbers.h"

namespace gumcert::gum {

namespace {

/// Everything that the scores of one item have in common.
struct Scene {
    const ComparisonScheme& scheme;
    const LaboratoryData& data;
    const AssignedValue& assigned;
    const ItemResult& item;
    Eigen::VectorXd U = {};  ///< of the results as E_n takes them; 0 without. Where the value has weights

    [[nodiscard]] double score_probability() const { return en_coverage_probability(scheme.coverage_probability); }
};

/// D over a scale, settled.
double score_of(const ScoredResult& point, double scale) {
    return settled_score(point.value, point.assigned_value, scale, point.assigned_rest);
}

/// U of a result as E_n takes it.
EnUncertainty of_scores(const Scene& scene, const ResultUncertainty& uncertainty) {
    return en_uncertainty(uncertainty, scene.scheme.coverage_probability);
}

/// u of a result as it meets the scatter of others: where its own distribution says U, the u that gives this U with its
/// degrees of freedom. A result against a value that is exactly known then has its own U, by whatever way it is scored.
double u_beside_scatter(const Scene& scene, const ResultUncertainty& laboratory) {
    return laboratory.of_scores
               ? laboratory.of_scores->U / coverage_factor(scene.score_probability(), laboratory.degrees_of_freedom)
               : laboratory.u;
}

/// Scores against what the scatter of all other results says.
SpreadDifference difference_by_scatter(const Scene& scene, std::size_t position, const ResultUncertainty& laboratory) {
    const ConsensusScatter& scatter = *scene.assigned.scatter;
    const auto at = static_cast<Eigen::Index>(position);
    return spread_difference({u_beside_scatter(scene, laboratory), laboratory.degrees_of_freedom},
                             scatter.others[position], scene.item.u_of_item(), scatter.covariance[at],
                             scatter.share[at], scatter.share[at] > 0.0 ? scatter.factor : 1.0,
                             scene.score_probability());
}

bool is_scored_by_scatter(const Scene& scene) {
    return scene.assigned.scatter && !scene.assigned.scatter->others.empty();
}

/// What rounding alone makes of a D of 0.
double rounding_of_difference(const ScoredResult& point) {
    constexpr double k_roundings = 64.0;  // of the values and of the weights of a mean
    constexpr double k_of_u = 1e-9;
    return k_roundings * std::numeric_limits<double>::epsilon() *
               (std::abs(point.value) + std::abs(point.assigned_value)) +
           k_of_u * point.uncertainty->u;
}

/// A number without the digits that rounding alone has made: 0.3 of 0.30000000000000426.
double without_rounding(double number, double rounding) {
    if (!(rounding > 0.0) || !(std::abs(number) > rounding)) {
        return number;
    }
    constexpr double k_most = 300.0;
    const double decimals = std::clamp(-std::floor(std::log10(rounding)), -k_most, k_most);
    const std::string digits = round_to_quantum(number, static_cast<int>(decimals));
    double rounded = number;
    std::from_chars(digits.data(), digits.data() + digits.size(), rounded);
    return rounded != 0.0 ? rounded : number;
}

/// A difference that has no uncertainty and is not 0: the result and the assigned value are stated to be one quantity
/// with all of their uncertainty in common, and they differ. No score says so, and none of the two can stand.
void require_explained_difference(const Scene& scene, const ScoredResult& point) {
    if (*point.u_difference > 0.0 && *point.U_difference > 0.0) {
        return;
    }
    if (std::abs(point.difference) > rounding_of_difference(point)) {
        refuse("GC-GUM-0031",
               (scene.data.where.empty() ? "result of " : scene.data.where + ", result of ") +
                   scene.scheme.participants[point.participant].id,
               "D = " + text::shortest(without_rounding(point.difference, rounding_of_difference(point))) +
                   " beside an uncertainty of D of 0, from u = " + text::shortest(point.uncertainty->u) +
                   " and u(X) = " + text::shortest(*scene.item.u) + " with correlation " +
                   text::shortest(*point.correlation),
               "a score divides by it, so it must be greater than 0",
               "State a smaller correlation: with this one both values have all of their uncertainty in common.");
    }
}

/// r of a result and the assigned value. Beyond 1 it is refused, and not made 1: u_D would be that of no quantity.
double correlation_with_value(const Scene& scene, std::size_t position, double u, double u_X, double covariance) {
    constexpr double k_rounding = 1e-6;            // of the covariance of stated numbers
    constexpr double k_rounding_of_trials = 0.02;  // where all three variances come from trials
    if (!(u_X > 0.0) || !(u > 0.0) || covariance == 0.0) {
        return 0.0;
    }
    const double r = covariance / (u * u_X);
    if (!(std::abs(r) <= 1.0 + (scene.assigned.intervals ? k_rounding_of_trials : k_rounding))) {
        refuse("GC-GUM-0030",
               (scene.data.where.empty() ? "result of " : scene.data.where + ", result of ") +
                   scene.scheme.participants[scene.data.results[position]->participant].id,
               "a covariance of " + text::shortest(covariance) +
                   " with the assigned value, beside u = " + text::shortest(u) + " and u(X) = " + text::shortest(u_X),
               "must lie between -1 and 1",
               "Correct the covariance or the sources of the result and of the assigned value.");
    }
    return std::clamp(r, -1.0, 1.0);
}

/// The parts of D = Σ c_j x_j: c is 1 − w for the result itself, −w for the others that the value is made of, and what
/// the value has beyond them.
struct PartsOfDifference {
    double u_square = 0.0, U_square = 0.0;
    double least_factor = std::numeric_limits<double>::infinity(), largest_factor = 0.0;  // U/u

    void add(double u, double U) {
        if (u > 0.0) {
            u_square += u * u;
            U_square += U * U;
            least_factor = std::min(least_factor, U / u);
            largest_factor = std::max(largest_factor, U / u);
        }
    }
    [[nodiscard]] bool have_one_factor() const {
        return !(u_square > 0.0) || largest_factor <= (1.0 + k_same_coverage_factor) * least_factor;
    }
};

PartsOfDifference parts_of_difference(const Scene& scene, std::size_t position, const ScoredResult& point,
                                      double covariance) {
    const double k_normal = coverage_factor(scene.score_probability(), std::numeric_limits<double>::infinity());
    PartsOfDifference parts;
    if (scene.U.size() == 0) {
        // No weights: what the value has beyond its regression on the result does not correlate with it.
        const double u = point.uncertainty->u;
        const double share = covariance / (u * u);
        const double rest = *scene.item.u * *scene.item.u - share * covariance;
        const double k_of_value = scene.item.U_of_scores.value_or(*scene.item.U) / *scene.item.u;
        parts.add(std::abs(1.0 - share) * u, std::abs(1.0 - share) * point.U_of_scores());
        parts.add(std::sqrt(std::max(rest, 0.0)), std::sqrt(std::max(rest, 0.0)) * k_of_value);
        return parts;
    }
    const Eigen::VectorXd& w = scene.assigned.weights;
    for (Eigen::Index j = 0; j < w.size(); ++j) {
        const double c = std::abs(static_cast<std::size_t>(j) == position ? 1.0 - w[j] : w[j]);
        parts.add(c * scene.data.u[j], c * scene.U[j]);
    }
    // A variance between laboratories, and that of the items.
    constexpr double k_rounding = 1e-9;
    const double of_value = *scene.assigned.u * *scene.assigned.u;
    const double of_weights = scene.data.covariance.size() == 0 ? (w.array() * scene.data.u.array()).square().sum()
                                                                : w.dot(scene.data.covariance * w);
    const double between = of_value - of_weights > k_rounding * of_value ? std::sqrt(of_value - of_weights) : 0.0;
    const double beyond = std::hypot(between, scene.item.u_of_item());
    parts.add(beyond, k_normal * beyond);
    return parts;
}

/// U_D of a result against a value that does not go by scatter. Both U with r, as E_n is defined; where they correlate
/// and have factors that differ, as those of a result with few degrees of freedom and of the mean that it is part of,
/// u_D with the factor of the parts of D together: one difference has one E_n, from whichever side it is looked at.
double expanded_difference(const Scene& scene, std::size_t position, const ScoredResult& point, double covariance) {
    const double U_of_value = scene.item.U_of_scores.value_or(*scene.item.U);
    if (*point.correlation != 0.0 && *scene.item.u > 0.0) {
        const PartsOfDifference parts = parts_of_difference(scene, position, point, covariance);
        if (!parts.have_one_factor()) {
            return *point.u_difference * std::sqrt(parts.U_square / parts.u_square);
        }
    }
    return uncertainty_of_difference(point.U_of_scores(), U_of_value, *point.correlation);
}

/// u_D, U_D and with them E_n and ζ.
void score_with_uncertainty(const Scene& scene, std::size_t position, ScoredResult& point) {
    const auto at = static_cast<Eigen::Index>(position);
    const double u = point.uncertainty->u;
    const double u_X = *scene.item.u;
    const double covariance = scene.assigned.covariance[at];
    // A result that is part of the value, or shares a source with it, correlates with it. With r = 0 the uncertainty of
    // D would be too large for r > 0: a failure would stay hidden.
    const double r = correlation_with_value(scene, position, u, u_X, covariance);
    point.u_difference = uncertainty_of_difference(u, u_X, r);
    point.correlation = r;
    if (is_scored_by_scatter(scene)) {
        const ConsensusScatter& scatter = *scene.assigned.scatter;
        const SpreadDifference difference = difference_by_scatter(scene, position, *point.uncertainty);
        point.U_difference = difference.U;
        point.scatter = ScatterOfOthers{.others = scatter.others[position],
                                        .covariance = scatter.covariance[at],
                                        .share = scatter.share[at],
                                        .factor = scatter.share[at] > 0.0 ? scatter.factor : 1.0,
                                        .degrees_of_freedom = difference.degrees_of_freedom};
    } else {
        point.U_difference = expanded_difference(scene, position, point, covariance);
    }
    require_explained_difference(scene, point);
    if (const std::optional<ComparisonScore> score = score_of_difference(
            point.value, point.assigned_value, *point.u_difference, *point.U_difference, point.assigned_rest)) {
        point.en = score->en;
        point.zeta = score->zeta;
        if (const double nu = degrees_of_freedom_of_difference(scene.data, position, point, scene.assigned);
            std::isfinite(nu)) {
            point.zeta_as_normal = normal_score(score->zeta, nu);
        }
    }
    // The trials drew the value and the results, and not the items: what the items add is not in these intervals.
    if (scene.assigned.intervals && scene.item.u_of_item() == 0.0) {
        const double low = scene.assigned.intervals->d_low[at];
        if (std::isfinite(low)) {
            point.low = low;
            point.high = scene.assigned.intervals->d_high[at];
        }
    }
}

/// E_n of a difference of which all uncertainty may be common to both sides.
double en_without_limit(const ScoredResult& point) {
    return std::abs(point.difference) > rounding_of_difference(point)
               ? std::copysign(std::numeric_limits<double>::infinity(), point.difference)
               : 0.0;
}

/// E_n with the least variance that what the members of a group may share can leave.
void score_with_unknown_group(const Scene& scene, double variance_change, ScoredResult& point) {
    constexpr double k_rounding = 1e-12;  // of variances of which all may be common
    const double u_x = point.uncertainty->u;
    const double u_X = *scene.item.u;
    // One result against one result: the bound is known in closed form. As soon as the items add to U(X) it is no
    // longer that of the reference laboratory alone.
    if (scene.data.reference && scene.item.U == scene.assigned.stated->U) {
        const std::optional<double> worst =
            worst_plausible_en({point.value, u_x, point.U_of_scores()},
                               {point.assigned_value, u_X, scene.item.U_of_scores.value_or(*scene.item.U)});
        point.en_worst = worst ? *worst : en_without_limit(point);
        return;
    }
    const double least = *point.u_difference * *point.u_difference + variance_change;
    // What a group shares changes u(X) as well as what x and X have in common: no correlation coefficient with the u(X)
    // of results that share nothing describes it, but the variance of D does, and U(D) follows u(D).
    point.en_worst = least > k_rounding * (u_x * u_x + u_X * u_X)
                         ? score_of(point, *point.U_difference * std::sqrt(least) / *point.u_difference)
                         : en_without_limit(point);
}

/// What an audit changes of the square of an expanded uncertainty; 0 without a finding.
double audited_change(const Scene& scene, const ParticipantResult& result) {
    const double stated_U = of_scores(scene, *result.uncertainty).U;
    const double audited_U = result.audited ? of_scores(scene, result.audited->uncertainty).U : stated_U;
    return audited_U * audited_U - stated_U * stated_U;
}

/// E_n once the findings on the result, and on that of the reference laboratory, are corrected. What is shared stays.
void score_audited(const Scene& scene, std::size_t position, ScoredResult& point) {
    const ParticipantResult& result = *scene.data.results[position];
    const ParticipantResult* reference = scene.data.reference ? scene.data.results[*scene.data.reference] : nullptr;
    if (!point.U_difference || !(result.audited || (reference != nullptr && reference->audited))) {
        return;
    }
    if (is_scored_by_scatter(scene)) {
        const double U = difference_by_scatter(scene, position, result.audited->uncertainty).U;
        if (U > 0.0) {
            point.en_audited = score_of(point, U);
        }
        return;
    }
    const double weight =
        scene.assigned.weights.size() > 0 ? scene.assigned.weights[static_cast<Eigen::Index>(position)] : 0.0;
    // u²(D) has (1 − w)² u_i²: a finding on the result changes that part of U_D² and leaves the rest.
    double square =
        *point.U_difference * *point.U_difference + (1.0 - weight) * (1.0 - weight) * audited_change(scene, result);
    if (reference != nullptr) {
        square += audited_change(scene, *reference);
    }
    if (square > 0.0) {
        point.en_audited = score_of(point, std::sqrt(square));
    }
}

void score_without_uncertainty(const Scene& scene, ScoredResult& point) {
    if (scene.item.sigma_pt) {
        const double sigma = *scene.item.sigma_pt;
        point.z = z_score(point.value, point.assigned_value, sigma, point.assigned_rest);
        if (scene.item.u) {
            point.z_prime = z_prime_score(point.value, point.assigned_value, sigma, *scene.item.u, point.assigned_rest);
        }
    }
    if (scene.item.delta_E) {
        point.percent_of_allowed =
            percent_of_allowed(point.value, point.assigned_value, *scene.item.delta_E, point.assigned_rest);
    }
    if (!has_conventional_zero(scene.data.item->unit)) {
        point.percent = percent_difference(point.value, point.assigned_value, point.assigned_rest);
    }
}

/// Whether the distribution of a result reaches farther out than its u and degrees of freedom tell, so that the limits
/// of ζ do not hold for it: they are those of a normal distribution.
bool is_beyond_zeta(const Scene& scene, const ScoredResult& point) {
    if (!point.uncertainty || !point.uncertainty->of_scores) {
        return false;
    }
    const double expected = coverage_factor(scene.score_probability(), point.uncertainty->degrees_of_freedom);
    return point.uncertainty->of_scores->k > expected * (1.0 + k_same_coverage_factor);
}

/// The signals of all scores that a result has. Of z and z' the one that holds.
std::vector<std::pair<Score, Signal>> signals_of(const Scene& scene, const ScoredResult& point) {
    std::vector<std::pair<Score, Signal>> signals;
    const auto add = [&](Score score, const std::optional<double>& number, Signal (*signal)(double)) {
        if (number) {
            signals.emplace_back(score, signal(*number));
        }
    };
    // One of z and z' only: both would count one fact twice.
    if (scene.item.criterion_met) {
        add(Score::z, point.z, signal_of_z);
    } else {
        add(Score::z_prime, point.z_prime, signal_of_z);
    }
    add(Score::en, point.en, signal_of_en);
    if (!is_beyond_zeta(scene, point)) {
        add(Score::zeta, point.zeta_as_normal ? point.zeta_as_normal : point.zeta, signal_of_z);
    }
    add(Score::en_audited, point.en_audited, signal_of_en);
    if (point.percent_of_allowed) {
        constexpr double k_all_that_is_allowed = 100.0;  // %
        signals.emplace_back(Score::difference, std::abs(*point.percent_of_allowed) > k_all_that_is_allowed
                                                    ? Signal::action
                                                    : Signal::none);
    }
    return signals;
}

/// U(X) for the probability of the scores; by scatter as the other results show it.
double expanded_value_of_scores(const Scene& scene, const ScoredResult& point) {
    if (!scene.assigned.scatter) {
        return scene.item.U_of_scores.value_or(*scene.item.U);
    }
    const SpreadUncertainty& of_value = point.scatter ? point.scatter->others : scene.assigned.scatter->of_value;
    return spread_difference({}, of_value, scene.item.u_of_item(), 0.0, 0.0, 1.0, scene.score_probability()).U;
}

/// Whether the score that decides could not have found a fault of the size that it is to find: a small score clears
/// nobody then. Nor does one where it is not known how uncertain the assigned value is.
bool is_too_uncertain_to_clear(const Scene& scene, const ScoredResult& point) {
    constexpr double k_rounding = 1.0 + 1e-9;
    const ItemResult& item = scene.item;
    if (item.score == DecidingScore::en) {
        if (!point.uncertainty) {
            return false;
        }
        // As the others show it: the scatter of all would let a result far off widen the limit that it is held against.
        const double u_of_value = point.scatter ? point.scatter->others.u : *item.u;
        return u_of_value > point.uncertainty->u * k_rounding ||
               expanded_value_of_scores(scene, point) > point.U_of_scores() * k_rounding;
    }
    if (!item.u) {
        return true;
    }
    if (item.score == DecidingScore::z_prime) {
        return *item.u > *item.sigma_pt * k_rounding;
    }
    return item.score == DecidingScore::difference && item.U && *item.U > *item.delta_E * k_rounding;
}

/// Whether a result is in the largest consistent subset, or in another one of that size that is consistent as well: the
/// value that it is held against is one of several then.
bool rests_on_choice(const Scene& scene, std::size_t position) {
    const AssignedValue& assigned = scene.assigned;
    const auto holds = [&](const std::vector<std::size_t>& positions) {
        return std::find(positions.begin(), positions.end(), position) != positions.end();
    };
    return !assigned.in_another_subset.empty() &&
           (holds(assigned.in_another_subset) || (holds(scene.data.contributing) && !holds(assigned.not_consistent)));
}

/// The strongest signal of all scores, and who gives it.
void add_verdict(const Scene& scene, std::size_t position, ScoredResult& point) {
    const std::vector<std::pair<Score, Signal>> signals = signals_of(scene, point);
    if (scene.item.score == DecidingScore::none || signals.empty()) {
        return;
    }
    Signal strongest = Signal::none;
    for (const auto& [score, signal] : signals) {
        strongest = std::max(strongest, signal);
    }
    // No signal is as much a statement as one is: with the other subset the result might have one.
    if (rests_on_choice(scene, position)) {
        point.verdict = Verdict::inconclusive;
        return;
    }
    for (const auto& [score, signal] : signals) {
        if (signal == strongest && signal != Signal::none) {
            point.verdict_by.push_back(score);
        }
    }
    switch (strongest) {
        case Signal::none:
            point.verdict = is_too_uncertain_to_clear(scene, point) ? Verdict::inconclusive : Verdict::none;
            break;
        case Signal::warning:
            point.verdict = Verdict::warning;
            break;
        case Signal::action:
            point.verdict = Verdict::action;
            break;
    }
}

/// A stated u outside u(X) … 1.5 s* is not what a laboratory of this kind reaches.      (after ISO 13528:2022, clause
/// 9)
UncertaintyRealism realism_of(const Scene& scene, const ScoredResult& point) {
    constexpr double k_largest_in_s_star = 1.5;
    const ItemResult& item = scene.item;
    // u(X) above 1.5 s* leaves no range for a plausible u.
    if (!point.uncertainty || !item.u || !item.s_star || !(*item.s_star > 0.0) ||
        *item.u > k_largest_in_s_star * *item.s_star) {
        return UncertaintyRealism::not_judged;
    }
    if (point.uncertainty->u < *item.u) {
        return UncertaintyRealism::small;
    }
    return point.uncertainty->u > k_largest_in_s_star * *item.s_star ? UncertaintyRealism::large
                                                                     : UncertaintyRealism::plausible;
}

ScoredResult scored(const Scene& scene, std::size_t position) {
    const ParticipantResult& result = *scene.data.results[position];
    ScoredResult point;
    point.participant = result.participant;
    point.item = result.item;
    point.round = result.round;
    point.result = scene.data.result_positions[position];
    point.value = result.value;
    point.uncertainty = result.uncertainty;
    point.assigned_value = scene.item.value;
    point.assigned_rest = scene.item.rest;
    point.u_assigned = scene.item.u;
    point.U_assigned = scene.item.U;
    point.k_assigned = scene.item.k;
    point.difference = (result.value - scene.item.value) - scene.item.rest;
    if (result.uncertainty) {
        if (const EnUncertainty taken = of_scores(scene, *result.uncertainty); taken.converted) {
            point.of_scores = taken;
        }
        if (const std::optional<double>& cmc = scene.scheme.participants[result.participant].cmc_U; cmc && *cmc > 0.0) {
            point.U_over_cmc = point.U_of_scores() / *cmc;
        }
    }
    if (scene.data.reference == position) {
        return point;
    }
    score_without_uncertainty(scene, point);
    if (point.uncertainty && scene.item.u) {
        score_with_uncertainty(scene, position, point);
        score_audited(scene, position, point);
    }
    add_verdict(scene, position, point);
    point.realism = realism_of(scene, point);
    return point;
}

/// The share of each result in the assigned value. A robust value follows its results as their mean does, as its
/// covariance with them is taken.
Eigen::VectorXd shares_in_value(const LaboratoryData& data, const AssignedValue& assigned) {
    if (assigned.weights.size() > 0) {
        return assigned.weights;
    }
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.size()));
    if (data.item->assigned_value.method != AssignedValueMethod::given) {
        for (const std::size_t i : data.contributing) {
            shares[static_cast<Eigen::Index>(i)] = 1.0 / static_cast<double>(data.contributing.size());
        }
    }
    return shares;
}

/// Where what a group shares is not known, a result that would be above 1 with it is not cleared by a smaller E_n.
void leave_open(ScoredResult& point) {
    const bool is_above_1 =
        point.en_worst && (std::isinf(*point.en_worst) || signal_of_en(*point.en_worst) != Signal::none);
    if (point.verdict == Verdict::none && is_above_1) {
        point.verdict = Verdict::inconclusive;
        point.verdict_by.push_back(Score::en_worst);
    }
}

/// U of every result over the median of the U of all others, all of them for the probability of the scores.
void hold_against_others(std::vector<ScoredResult>& points) {
    std::vector<double> sorted;
    for (const ScoredResult& point : points) {
        if (point.uncertainty) {
            sorted.push_back(point.U_of_scores());
        }
    }
    if (sorted.size() < 2) {
        return;
    }
    std::sort(sorted.begin(), sorted.end());
    // Without the own one: of few laboratories, a U that is far too large would move the median that it is held
    // against. One sorted list with a gap in it does for all of them.
    const std::size_t others = sorted.size() - 1;
    for (ScoredResult& point : points) {
        if (!point.uncertainty) {
            continue;
        }
        const double U = point.U_of_scores();
        const auto own = static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), U) - sorted.begin());
        const auto other = [&](std::size_t i) { return sorted[i < own ? i : i + 1]; };
        const double median = 0.5 * (other((others - 1) / 2) + other(others / 2));
        point.U_over_median = U / median;
    }
}

}  // namespace

double degrees_of_freedom_of_difference(const LaboratoryData& data, std::size_t position, const ScoredResult& point,
                                        const AssignedValue& assigned) {
    double inverse = 0.0;
    // No part is larger than the whole: where parts correlate the formula does not hold, and they may be.
    const auto add = [&](double u, double nu) {
        inverse += std::pow(std::min(1.0, std::abs(u) / *point.u_difference), 4) / nu;
    };
    double of_result = 1.0;  // of x in D = x − Σ w_j x_j
    if (assigned.weights.size() > 0 && !assigned.scatter) {
        for (std::size_t j = 0; j < data.size(); ++j) {
            const double weight = assigned.weights[static_cast<Eigen::Index>(j)];
            if (j == position) {
                of_result -= weight;
            } else if (weight != 0.0 && data.results[j]->uncertainty) {
                add(weight * data.u[static_cast<Eigen::Index>(j)], data.results[j]->uncertainty->degrees_of_freedom);
            }
        }
    } else if (!assigned.scatter) {
        add(*assigned.u, assigned.degrees_of_freedom);  // what the items add to u(X) is exactly known
    }
    add(of_result * point.uncertainty->u, point.uncertainty->degrees_of_freedom);
    constexpr double k_least = 1.0;
    return inverse > 0.0 ? std::max(k_least, 1.0 / inverse) : std::numeric_limits<double>::infinity();
}

double ScoredResult::U_of_scores() const {
    return of_scores ? of_scores->U : uncertainty->U;
}

std::vector<ScoredResult> scored_results(const ComparisonScheme& scheme, const LaboratoryData& data,
                                         const AssignedValue& assigned, const ItemResult& item) {
    Scene scene{scheme, data, assigned, item};
    // Scores by the scatter of the others have a U_D of their own.
    if (assigned.weights.size() > 0 && !is_scored_by_scatter(scene)) {
        scene.U = Eigen::VectorXd::Zero(assigned.weights.size());
        for (std::size_t i = 0; i < data.size(); ++i) {
            if (data.results[i]->uncertainty) {
                scene.U[static_cast<Eigen::Index>(i)] = of_scores(scene, *data.results[i]->uncertainty).U;
            }
        }
    }
    std::vector<ScoredResult> points;
    points.reserve(data.size());
    for (std::size_t i = 0; i < data.size(); ++i) {
        points.push_back(scored(scene, i));
    }
    const std::vector<std::optional<double>> change =
        least_variance_of_unknown_groups(scheme, data, shares_in_value(data, assigned));
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].in_unknown_group = change[i].has_value();
        if (change[i] && *change[i] < 0.0 && points[i].en) {
            score_with_unknown_group(scene, *change[i], points[i]);
            leave_open(points[i]);
        }
    }
    hold_against_others(points);
    return points;
}

}  // namespace gumcert::gum
