#include "app/laboratory_scores.h"

#include <algorithm>
#include <cmath>

#include "app/comparison_print.h"
#include "app/laboratory_covariance.h"
#include "app/record_parts.h"
#include "gum/comparison.h"
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
};

const char* word_of(gum::Signal signal) {
    return signal == gum::Signal::none ? "none" : signal == gum::Signal::warning ? "warning" : "action";
}

/// D over a scale, settled.
double score_of(const ComparisonPoint& point, double scale) {
    return gum::settled_score(point.value, point.reference_value, scale);
}

/// u_D, U_D and with them E_n and ζ.
void score_with_uncertainty(const Scene& scene, std::size_t position, ComparisonPoint& point) {
    const double u_X = *scene.item.u;
    const double covariance = scene.assigned.covariance[static_cast<Eigen::Index>(position)];
    const double r = u_X > 0.0 ? std::clamp(covariance / (*point.u * u_X), -1.0, 1.0) : 0.0;
    point.u_D = gum::uncertainty_of_difference(*point.u, u_X, r);
    point.U_D = gum::uncertainty_of_difference(*point.U, *scene.item.U, r);
    if (scene.assigned.correlation_known) {
        point.correlation = r;
    }
    if (*point.u_D > 0.0 && *point.U_D > 0.0) {
        point.En = score_of(point, *point.U_D);
        point.zeta = score_of(point, *point.u_D);
    }
}

/// E_n with the least variance that what the members of a group may share can leave.
void score_with_unknown_group(const Scene& scene, double variance_change, ComparisonPoint& point) {
    const double u_X = *scene.item.u;
    if (scene.data.reference && scene.item.U == scene.assigned.stated->U) {
        point.En_worst =
            gum::worst_plausible_en({point.value, *point.u, *point.U}, {point.reference_value, u_X, *scene.item.U});
        return;
    }
    const double least = *point.u_D * *point.u_D + variance_change;
    const double r = u_X > 0.0 ? (*point.u * *point.u + u_X * u_X - least) / (2.0 * *point.u * u_X) : 0.0;
    if (least > 0.0 && std::abs(r) <= 1.0) {
        const double U = gum::uncertainty_of_difference(*point.U, *scene.item.U, r);
        if (U > 0.0) {
            point.En_worst = score_of(point, U);
        }
    }
}

/// What an audit changes of the square of an expanded uncertainty; 0 without a finding.
double audited_change(const ComparisonResult& result, double stated_U) {
    const double audited_U = result.audited ? result.audited->uncertainty.U : stated_U;
    return audited_U * audited_U - stated_U * stated_U;
}

/// E_n once the findings on the result, and on that of the reference laboratory, are corrected. What is shared stays.
void score_audited(const Scene& scene, std::size_t position, ComparisonPoint& point) {
    const ComparisonResult& result = *scene.data.results[position];
    const ComparisonResult* reference = scene.data.reference ? scene.data.results[*scene.data.reference] : nullptr;
    if (!point.U_D || !(result.audited || (reference != nullptr && reference->audited))) {
        return;
    }
    const double weight =
        scene.assigned.weights.size() > 0 ? scene.assigned.weights[static_cast<Eigen::Index>(position)] : 0.0;
    double square = *point.U_D * *point.U_D + (1.0 - weight) * (1.0 - weight) * audited_change(result, *point.U);
    if (reference != nullptr) {
        square += audited_change(*reference, reference->uncertainty->U);
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

std::string signal_of(const Scene& scene, const ComparisonPoint& point) {
    const std::string& score = scene.item.score;
    if (score == "z" && point.z) {
        return word_of(gum::signal_of_z(*point.z));
    }
    if (score == "z_prime" && point.z_prime) {
        return word_of(gum::signal_of_z(*point.z_prime));
    }
    if (score == "En" && point.En) {
        return word_of(gum::signal_of_en(*point.En));
    }
    if (score == "D" && point.P_A) {
        constexpr double k_all_that_is_allowed = 100.0;  // %
        return std::abs(*point.P_A) > k_all_that_is_allowed ? "action" : "none";
    }
    return "";
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
        if (const std::optional<double>& cmc = scene.job.participants[result.participant].cmc_U; cmc && *cmc > 0.0) {
            point.U_over_CMC = *point.U / *cmc;
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
    point.signal = signal_of(scene, point);
    point.realism = realism_of(scene, point);
    return point;
}

/// U of every result over the median of the U of all others.
void hold_against_others(std::vector<ComparisonPoint>& points) {
    std::vector<double> sorted;
    for (const ComparisonPoint& point : points) {
        if (point.U) {
            sorted.push_back(*point.U);
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
        const auto own =
            static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), *point.U) - sorted.begin());
        const auto other = [&](std::size_t i) { return sorted[i < own ? i : i + 1]; };
        const double median = 0.5 * (other((others - 1) / 2) + other(others / 2));
        point.U_over_median = *point.U / median;
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
