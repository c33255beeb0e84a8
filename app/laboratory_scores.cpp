#include "app/laboratory_scores.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/comparison_print.h"
#include "app/laboratory_covariance.h"
#include "app/record_parts.h"
#include "gum/comparison/scores.h"
#include "gum/rounding.h"

namespace gumcert::app {

namespace {

using engine::ComparisonResult;
using reports::ComparisonItemEvaluation;
using reports::ComparisonPoint;

/// Everything that the scores of one item have in common.
struct Scene {
    const engine::ComparisonJob& job;
    const LaboratoryData& data;
    const AssignedValue& assigned;
    const ComparisonItemEvaluation& item;

    [[nodiscard]] double score_probability() const { return gum::en_coverage_probability(job.coverage_probability); }
};

const char* word_of(gum::Signal signal) {
    return signal == gum::Signal::none ? "none" : signal == gum::Signal::warning ? "warning" : "action";
}

/// D over a scale, settled.
double score_of(const ComparisonPoint& point, double scale) {
    return gum::settled_score(point.value, point.reference_value, scale);
}

/// U of a result as E_n takes it.
gum::EnUncertainty of_scores(const Scene& scene, const engine::ResultUncertainty& uncertainty) {
    return gum::en_uncertainty(uncertainty.u, uncertainty.U, uncertainty.k, uncertainty.degrees_of_freedom,
                               scene.job.coverage_probability);
}

/// Scores against what the scatter of all other results says.
gum::SpreadDifference difference_by_scatter(const Scene& scene, std::size_t position,
                                            const engine::ResultUncertainty& laboratory) {
    const ConsensusScatter& scatter = *scene.assigned.scatter;
    const auto at = static_cast<Eigen::Index>(position);
    const double of_item = std::hypot(scene.item.u_homogeneity.value_or(0.0), scene.item.u_stability.value_or(0.0));
    return gum::spread_difference({laboratory.u, laboratory.degrees_of_freedom}, scatter.others[position], of_item,
                                  scatter.covariance[at], scatter.share[at],
                                  scatter.share[at] > 0.0 ? scatter.factor : 1.0, scene.score_probability());
}

bool is_scored_by_scatter(const Scene& scene) {
    return scene.assigned.scatter && !scene.assigned.scatter->others.empty();
}

/// u_D, U_D and with them E_n and ζ.
void score_with_uncertainty(const Scene& scene, std::size_t position, ComparisonPoint& point) {
    const double u_X = *scene.item.u;
    const double covariance = scene.assigned.covariance[static_cast<Eigen::Index>(position)];
    const double r = u_X > 0.0 ? std::clamp(covariance / (*point.u * u_X), -1.0, 1.0) : 0.0;
    point.u_D = gum::uncertainty_of_difference(*point.u, u_X, r);
    point.correlation = r;
    if (is_scored_by_scatter(scene)) {
        const ConsensusScatter& scatter = *scene.assigned.scatter;
        const auto at = static_cast<Eigen::Index>(position);
        const gum::SpreadDifference difference =
            difference_by_scatter(scene, position, *scene.data.results[position]->uncertainty);
        point.U_D = difference.U;
        point.nu_D = finite_or_none(difference.degrees_of_freedom);
        point.u_others = scatter.others[position].u;
        point.nu_others = finite_or_none(scatter.others[position].degrees_of_freedom);
        point.covariance_others = scatter.covariance[at];
        point.share = scatter.share[at];
        point.factor_D = scatter.share[at] > 0.0 ? scatter.factor : 1.0;
    } else {
        point.U_D = gum::uncertainty_of_difference(point.U_of_scores.value_or(*point.U),
                                                   scene.item.U_of_scores.value_or(*scene.item.U), r);
    }
    if (*point.u_D > 0.0 && *point.U_D > 0.0) {
        point.En = score_of(point, *point.U_D);
        point.zeta = score_of(point, *point.u_D);
    }
    if (scene.assigned.intervals && !scene.item.u_homogeneity) {
        const auto at = static_cast<Eigen::Index>(position);
        const double low = scene.assigned.intervals->d_low[at];
        if (std::isfinite(low)) {
            point.D_low = low;
            point.D_high = scene.assigned.intervals->d_high[at];
        }
    }
}

/// E_n with the least variance that what the members of a group may share can leave.
void score_with_unknown_group(const Scene& scene, double variance_change, ComparisonPoint& point) {
    const double u_X = *scene.item.u;
    if (scene.data.reference && scene.item.U == scene.assigned.stated->U) {
        point.En_worst =
            gum::worst_plausible_en({point.value, *point.u, point.U_of_scores.value_or(*point.U)},
                                    {point.reference_value, u_X, scene.item.U_of_scores.value_or(*scene.item.U)});
        return;
    }
    const double least = *point.u_D * *point.u_D + variance_change;
    if (is_scored_by_scatter(scene)) {
        if (least > 0.0) {
            point.En_worst = score_of(point, *point.U_D * std::sqrt(least) / *point.u_D);
        }
        return;
    }
    const double r = u_X > 0.0 ? (*point.u * *point.u + u_X * u_X - least) / (2.0 * *point.u * u_X) : 0.0;
    if (least > 0.0 && std::abs(r) <= 1.0) {
        const double U = gum::uncertainty_of_difference(point.U_of_scores.value_or(*point.U),
                                                        scene.item.U_of_scores.value_or(*scene.item.U), r);
        if (U > 0.0) {
            point.En_worst = score_of(point, U);
        }
    }
}

/// What an audit changes of the square of an expanded uncertainty; 0 without a finding.
double audited_change(const Scene& scene, const ComparisonResult& result) {
    const double stated_U = of_scores(scene, *result.uncertainty).U;
    const double audited_U = result.audited ? of_scores(scene, result.audited->uncertainty).U : stated_U;
    return audited_U * audited_U - stated_U * stated_U;
}

/// E_n once the findings on the result, and on that of the reference laboratory, are corrected. What is shared stays.
void score_audited(const Scene& scene, std::size_t position, ComparisonPoint& point) {
    const ComparisonResult& result = *scene.data.results[position];
    const ComparisonResult* reference = scene.data.reference ? scene.data.results[*scene.data.reference] : nullptr;
    if (!point.U_D || !(result.audited || (reference != nullptr && reference->audited))) {
        return;
    }
    if (is_scored_by_scatter(scene)) {
        const double U = difference_by_scatter(scene, position, result.audited->uncertainty).U;
        if (U > 0.0) {
            point.En_audited = score_of(point, U);
        }
        return;
    }
    const double weight =
        scene.assigned.weights.size() > 0 ? scene.assigned.weights[static_cast<Eigen::Index>(position)] : 0.0;
    double square = *point.U_D * *point.U_D + (1.0 - weight) * (1.0 - weight) * audited_change(scene, result);
    if (reference != nullptr) {
        square += audited_change(scene, *reference);
    }
    if (square > 0.0) {
        point.En_audited = score_of(point, std::sqrt(square));
    }
}

void score_without_uncertainty(const Scene& scene, ComparisonPoint& point) {
    if (scene.item.sigma_pt) {
        const double sigma = *scene.item.sigma_pt;
        point.z = gum::z_score(point.value, point.reference_value, sigma);
        if (scene.item.u) {
            point.z_prime = gum::z_prime_score(point.value, point.reference_value, sigma, *scene.item.u);
        }
    }
    if (scene.item.delta_E) {
        point.P_A = gum::percent_of_allowed(point.value, point.reference_value, *scene.item.delta_E);
    }
    if (!scene.data.item->unit.is_celsius_temperature()) {
        point.D_percent = gum::percent_difference(point.value, point.reference_value);
    }
}

/// The signals of all scores that a result has, by the name of the score. Of z and z' the one that holds.
std::vector<std::pair<std::string, gum::Signal>> signals_of(const Scene& scene, const ComparisonPoint& point) {
    std::vector<std::pair<std::string, gum::Signal>> signals;
    const auto add = [&](const char* name, const std::optional<double>& score, gum::Signal (*signal)(double)) {
        if (score) {
            signals.emplace_back(name, signal(*score));
        }
    };
    if (scene.item.criterion_met.value_or(true)) {
        add("z", point.z, gum::signal_of_z);
    } else {
        add("z_prime", point.z_prime, gum::signal_of_z);
    }
    add("En", point.En, gum::signal_of_en);
    add("zeta", point.zeta, gum::signal_of_z);
    add("En_audited", point.En_audited, gum::signal_of_en);
    if (point.P_A) {
        constexpr double k_all_that_is_allowed = 100.0;  // %
        signals.emplace_back("D",
                             std::abs(*point.P_A) > k_all_that_is_allowed ? gum::Signal::action : gum::Signal::none);
    }
    return signals;
}

/// U(X) for the probability of the scores.
double expanded_value_of_scores(const Scene& scene) {
    if (!scene.assigned.scatter) {
        return scene.item.U_of_scores.value_or(*scene.item.U);
    }
    const double of_item = std::hypot(scene.item.u_homogeneity.value_or(0.0), scene.item.u_stability.value_or(0.0));
    return gum::spread_difference({}, scene.assigned.scatter->of_value, of_item, 0.0, 0.0, 1.0,
                                  scene.score_probability())
        .U;
}

/// Whether the score that decides could not have found a fault of the size that it is to find: a small score clears
/// nobody then. Nor does one where it is not known how uncertain the assigned value is.
bool is_too_uncertain_to_clear(const Scene& scene, const ComparisonPoint& point) {
    constexpr double k_rounding = 1.0 + 1e-9;
    const std::string& score = scene.item.score;
    if (score == "En") {
        return point.u && (point.u_others.value_or(*scene.item.u) > *point.u * k_rounding ||
                           expanded_value_of_scores(scene) > point.U_of_scores.value_or(*point.U) * k_rounding);
    }
    if (!scene.item.u) {
        return true;
    }
    if (score == "z_prime") {
        return *scene.item.u > *scene.item.sigma_pt * k_rounding;
    }
    return score == "D" && scene.item.U && *scene.item.U > *scene.item.delta_E * k_rounding;
}

/// The strongest signal of all scores, and who gives it.
void add_signal(const Scene& scene, ComparisonPoint& point) {
    const std::vector<std::pair<std::string, gum::Signal>> signals = signals_of(scene, point);
    if (scene.item.score.empty() || signals.empty()) {
        return;
    }
    gum::Signal strongest = gum::Signal::none;
    for (const auto& [name, signal] : signals) {
        strongest = std::max(strongest, signal);
    }
    point.signal = word_of(strongest);
    for (const auto& [name, signal] : signals) {
        if (signal == strongest && signal != gum::Signal::none) {
            point.signal_by.push_back(name);
        }
    }
    if (strongest == gum::Signal::none && is_too_uncertain_to_clear(scene, point)) {
        point.signal = "inconclusive";
    }
}

/// A stated u outside u(X) … 1.5 s* is not what a laboratory of this kind reaches.      (after ISO 13528:2022, clause
/// 9)
std::string realism_of(const Scene& scene, const ComparisonPoint& point) {
    constexpr double k_largest_in_s_star = 1.5;
    if (!point.u || !scene.item.u || !scene.item.s_star || !(*scene.item.s_star > 0.0) ||
        *scene.item.u > k_largest_in_s_star * *scene.item.s_star) {
        return "";
    }
    if (*point.u < *scene.item.u) {
        return "small";
    }
    return *point.u > k_largest_in_s_star * *scene.item.s_star ? "large" : "plausible";
}

void print(const Scene& scene, ComparisonPoint& point) {
    const std::optional<double> scale = scene.item.U && *scene.item.U > 0.0 ? scene.item.U : scene.item.sigma_pt;
    point.printed.value = printed_value(point.value, point.U);
    point.printed.U = printed_uncertainty(point.U);
    point.printed.k = printed_score(point.k);
    point.printed.U_of_scores = printed_uncertainty(point.U_of_scores);
    point.printed.k_of_scores = printed_score(point.k_of_scores);
    if (point.D_low) {
        point.printed.D_low = printed_difference(*point.D_low, point.U_D, scale);
        point.printed.D_high = printed_difference(*point.D_high, point.U_D, scale);
    }
    point.printed.reference_value = scene.item.printed.value;
    point.printed.reference_U = scene.item.printed.U;
    point.printed.D = printed_difference(point.D, point.U_D, scale);
    point.printed.U_D = printed_uncertainty(point.U_D);
    point.printed.En = printed_score(point.En);
    point.printed.zeta = printed_score(point.zeta);
    point.printed.z = printed_score(point.z);
    point.printed.z_prime = printed_score(point.z_prime);
    point.printed.P_A = printed_score(point.P_A);
    point.printed.En_audited = printed_score(point.En_audited);
    point.printed.En_worst = printed_score(point.En_worst);
    if (point.D_percent) {
        const double to_percent = 100.0 / std::abs(point.reference_value);
        const auto in_percent = [&](const std::optional<double>& number) {
            return number ? std::optional(*number * to_percent) : std::nullopt;
        };
        point.printed.D_percent = printed_difference(*point.D_percent, in_percent(point.U_D), in_percent(scale));
    }
}

ComparisonPoint point_of(const Scene& scene, std::size_t position) {
    const ComparisonResult& result = *scene.data.results[position];
    const bool is_reference = scene.data.reference == position;
    ComparisonPoint point;
    point.participant = scene.job.participants[result.participant].id;
    point.item = scene.item.id;
    point.round = scene.item.round;
    point.contributes = result.contributes;
    point.reason = result.reason;
    point.value = result.value;
    point.reference_value = scene.item.value;
    point.reference_u = scene.item.u;
    point.reference_U = scene.item.U;
    point.reference_k = scene.item.k;
    point.D = result.value - scene.item.value;
    if (result.uncertainty) {
        point.u = result.uncertainty->u;
        point.U = result.uncertainty->U;
        point.k = result.uncertainty->k;
        point.nu = finite_or_none(result.uncertainty->degrees_of_freedom);
        if (const gum::EnUncertainty taken = of_scores(scene, *result.uncertainty); taken.converted) {
            point.U_of_scores = taken.U;
            point.k_of_scores = taken.k;
        }
        if (const std::optional<double>& cmc = scene.job.participants[result.participant].cmc_U; cmc && *cmc > 0.0) {
            point.U_over_CMC = point.U_of_scores.value_or(*point.U) / *cmc;
        }
    }
    if (is_reference) {
        return point;
    }
    score_without_uncertainty(scene, point);
    if (point.u && scene.item.u) {
        score_with_uncertainty(scene, position, point);
        score_audited(scene, position, point);
    }
    add_signal(scene, point);
    point.realism = realism_of(scene, point);
    return point;
}

/// U of every result over the median of the U of all others, all of them for the probability of the scores.
void hold_against_others(std::vector<ComparisonPoint>& points) {
    std::vector<double> sorted;
    for (const ComparisonPoint& point : points) {
        if (point.U) {
            sorted.push_back(point.U_of_scores.value_or(*point.U));
        }
    }
    if (sorted.size() < 2) {
        return;
    }
    std::sort(sorted.begin(), sorted.end());
    const std::size_t others = sorted.size() - 1;
    for (ComparisonPoint& point : points) {
        if (!point.U) {
            continue;
        }
        const double U = point.U_of_scores.value_or(*point.U);
        const auto own = static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), U) - sorted.begin());
        const auto other = [&](std::size_t i) { return sorted[i < own ? i : i + 1]; };
        const double median = 0.5 * (other((others - 1) / 2) + other(others / 2));
        point.U_over_median = U / median;
    }
}

}  // namespace

std::vector<ComparisonPoint> laboratory_scores(const engine::ComparisonJob& job, const LaboratoryData& data,
                                               const AssignedValue& assigned,
                                               const ComparisonItemEvaluation& evaluation) {
    const Scene scene{job, data, assigned, evaluation};
    std::vector<ComparisonPoint> points;
    points.reserve(data.size());
    for (std::size_t i = 0; i < data.size(); ++i) {
        points.push_back(point_of(scene, i));
    }
    if (assigned.weights.size() > 0) {
        const std::vector<std::optional<double>> change = least_variance_of_unknown_groups(job, data, assigned.weights);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (change[i] && *change[i] < 0.0 && points[i].En) {
                score_with_unknown_group(scene, *change[i], points[i]);
            }
        }
    }
    hold_against_others(points);
    for (ComparisonPoint& point : points) {
        print(scene, point);
    }
    return points;
}

}  // namespace gumcert::app
