#include "app/laboratory_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "app/comparison_print.h"
#include "gum/comparison/agreement.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

namespace {

using reports::ComparisonPoint;

/// More points than this are not held against the distribution of their sum of squares: a full matrix.
constexpr std::size_t k_most_points_of_distribution = 400;

gum::ComparisonScore score_of(const ComparisonPoint& point) {
    return {.difference = point.D,
            .u_difference = *point.u_D,
            .U_difference = *point.U_D,
            .en = *point.En,
            .zeta = *point.zeta};
}

std::vector<gum::ComparisonScore> scores_of(const std::vector<const ComparisonPoint*>& points) {
    std::vector<gum::ComparisonScore> scores;
    for (const ComparisonPoint* point : points) {
        scores.push_back(score_of(*point));
    }
    return scores;
}

/// Differences of one item with their covariance: cov(D_i, D_j) = V_ij − c_i − c_j + u²(X).
gum::MethodDifferences differences_of(const std::vector<const ComparisonPoint*>& points,
                                      const std::vector<std::size_t>& positions, const EvaluatedItem& item) {
    const auto m = static_cast<Eigen::Index>(points.size());
    gum::MethodDifferences differences;
    differences.d.resize(m);
    differences.U.resize(m);
    differences.U_method.resize(m);
    differences.U_reference.resize(m);
    differences.covariance.resize(m, m);
    const double u_X = *points.front()->reference_u;
    const double variance_of_X = u_X * u_X;
    for (Eigen::Index i = 0; i < m; ++i) {
        const ComparisonPoint& point = *points[static_cast<std::size_t>(i)];
        const auto a = static_cast<Eigen::Index>(positions[static_cast<std::size_t>(i)]);
        differences.d[i] = point.D;
        differences.U[i] = *point.U_D;
        differences.U_method[i] = point.U_of_scores.value_or(*point.U);
        differences.U_reference[i] = *point.reference_U;
        for (Eigen::Index j = 0; j < m; ++j) {
            const auto b = static_cast<Eigen::Index>(positions[static_cast<std::size_t>(j)]);
            const double between = i == j                             ? *point.u * *point.u
                                   : item.data->covariance.size() > 0 ? item.data->covariance(a, b)
                                                                      : 0.0;
            differences.covariance(i, j) =
                between - item.assigned.covariance[a] - item.assigned.covariance[b] + variance_of_X;
        }
        differences.covariance(i, i) = *point.u_D * *point.u_D;
    }
    return differences;
}

/// What the scores of one item say together, where it is known how they hang together.
void add_distribution(const reports::Comparison& comparison, const EvaluatedItem& item, double coverage_probability,
                      reports::ComparisonSummary& row) {
    std::vector<const ComparisonPoint*> points;
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < item.data->size(); ++i) {
        const ComparisonPoint& point = comparison.points[item.first_point + i];
        if (point.En) {
            points.push_back(&point);
            positions.push_back(i);
        }
        if (point.En_worst) {
            return;  // nobody knows what the group shares
        }
    }
    if (!item.assigned.correlation_known || points.size() < 2 || points.size() > k_most_points_of_distribution) {
        return;
    }
    try {
        const gum::Agreement agreement = gum::agreement(differences_of(points, positions, item), coverage_probability);
        row.rms_En_low = agreement.rms_en_low;
        row.rms_En_high = agreement.rms_en_high;
        row.p_low = agreement.p_low;
        row.p_high = agreement.p_high;
        row.effective_points = agreement.effective_points;
        row.ratio_reference = agreement.ratio_reference;
    } catch (const gum::DiagnosedError&) {
        return;  // correlations of different origin need not make a covariance together: nothing is said then
    }
    row.printed.rms_En_low = printed_score(row.rms_En_low);
    row.printed.rms_En_high = printed_score(row.rms_En_high);
    row.printed.p_low = printed_probability(row.p_low);
    row.printed.p_high = printed_probability(row.p_high);
    row.printed.effective_points = printed_uncertainty(row.effective_points);
    row.printed.ratio_reference = printed_uncertainty(row.ratio_reference);
}

void add_limits_of_failure(const std::vector<const ComparisonPoint*>& points, reports::ComparisonSummary& row) {
    for (const ComparisonPoint* point : points) {
        row.D_fail = std::min(row.D_fail.value_or(*point->U_D), *point->U_D);
        row.D_fail_largest = std::max(row.D_fail_largest.value_or(*point->U_D), *point->U_D);
    }
    row.printed.D_fail = printed_uncertainty(row.D_fail);
    row.printed.D_fail_largest = printed_uncertainty(row.D_fail_largest);
}

/// E_n of all points, with another number in place of E_n where a point has one.
void add_variants(const std::vector<const ComparisonPoint*>& points, reports::ComparisonSummary& row) {
    bool any_worst = false;
    bool any_audited = false;
    double worst = 0.0;
    double audited = 0.0;
    double sum_audited = 0.0;
    std::int64_t above_worst = 0;
    std::int64_t above_audited = 0;
    for (const ComparisonPoint* point : points) {
        const double of_worst = std::abs(point->En_worst.value_or(*point->En));
        const double of_audited = std::abs(point->En_audited.value_or(*point->En));
        any_worst = any_worst || point->En_worst;
        any_audited = any_audited || point->En_audited;
        worst = std::max(worst, of_worst);
        audited = std::max(audited, of_audited);
        sum_audited += of_audited;
        above_worst += of_worst > 1.0 ? 1 : 0;
        above_audited += of_audited > 1.0 ? 1 : 0;
    }
    if (any_worst) {
        row.max_abs_En_worst = worst;
        row.count_above_1_worst = above_worst;
        row.printed.max_abs_En_worst = printed_score(worst);
    }
    if (any_audited) {
        row.mean_abs_En_audited = sum_audited / static_cast<double>(points.size());
        row.max_abs_En_audited = audited;
        row.count_above_1_audited = above_audited;
        row.printed.mean_abs_En_audited = printed_score(row.mean_abs_En_audited);
        row.printed.max_abs_En_audited = printed_score(row.max_abs_En_audited);
    }
}

/// Ranks from 0, those of equal values averaged.
std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin + 1;
        while (end < order.size() && values[order[end]] == values[order[begin]]) {
            ++end;
        }
        for (std::size_t i = begin; i < end; ++i) {
            ranks[order[i]] = 0.5 * static_cast<double>(begin + end - 1);
        }
        begin = end;
    }
    return ranks;
}

/// Spearman's coefficient of rank correlation; 0 where one side has no spread.
double rank_correlation(const std::vector<double>& first, const std::vector<double>& second) {
    const std::vector<double> a = ranks_of(first);
    const std::vector<double> b = ranks_of(second);
    const double mean = 0.5 * static_cast<double>(a.size() - 1);
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean) * (a[i] - mean);
        bb += (b[i] - mean) * (b[i] - mean);
        ab += (a[i] - mean) * (b[i] - mean);
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

/// What D is divided by for z, or for z' where that decides.
std::optional<double> scale_of_z(const reports::Comparison& comparison, const std::string& id,
                                 const std::string& round) {
    for (const reports::ComparisonItemEvaluation& item : comparison.items) {
        if (item.id == id && item.round == round && item.sigma_pt) {
            return item.score == "z_prime" ? std::hypot(*item.sigma_pt, item.u.value_or(0.0)) : *item.sigma_pt;
        }
    }
    return std::nullopt;
}

/// With MADe as scale, which one value has not.
gum::RobustEstimate median_of(const std::vector<double>& values) {
    return values.size() > 1 ? gum::median_with_made(values) : gum::RobustEstimate{.location = values.front()};
}

void add_ellipse(reports::YoudenDiagram& diagram) {
    constexpr std::size_t k_least_points = 3;
    constexpr std::size_t k_corners = 72;
    constexpr double k_probability = 0.95;
    std::vector<double> first;
    std::vector<double> second;
    for (const reports::YoudenPoint& point : diagram.points) {
        first.push_back(point.first);
        second.push_back(point.second);
    }
    const gum::RobustEstimate of_first = median_of(first);
    const gum::RobustEstimate of_second = median_of(second);
    diagram.centre_first = of_first.location;
    diagram.centre_second = of_second.location;
    diagram.scale_first = of_first.scale;
    diagram.scale_second = of_second.scale;
    diagram.correlation =
        std::clamp(2.0 * std::sin(std::numbers::pi / 6.0 * rank_correlation(first, second)), -1.0, 1.0);
    if (diagram.points.size() < k_least_points || !(diagram.scale_first > 0.0) || !(diagram.scale_second > 0.0)) {
        return;
    }
    const double radius = gum::ellipsoid_coverage_factor(k_probability, 2, std::numeric_limits<double>::infinity());
    const double across = std::sqrt(1.0 - diagram.correlation * diagram.correlation);
    for (std::size_t i = 0; i <= k_corners; ++i) {
        const double angle =
            2.0 * std::numbers::pi * static_cast<double>(i % k_corners) / static_cast<double>(k_corners);
        const double a = radius * std::cos(angle);
        const double b = radius * std::sin(angle);
        diagram.ellipse.emplace_back(
            diagram.centre_first + diagram.scale_first * a,
            diagram.centre_second + diagram.scale_second * (diagram.correlation * a + across * b));
    }
}

/// Points by item, round and participant (ids).
using PointsOfItem = std::map<std::string, const ComparisonPoint*>;
std::map<std::pair<std::string, std::string>, PointsOfItem> by_item_and_round(const engine::ComparisonJob& job,
                                                                              const std::set<std::size_t>& items,
                                                                              const reports::Comparison& comparison) {
    std::set<std::string> ids;
    for (const std::size_t item : items) {
        ids.insert(job.items[item].id);
    }
    std::map<std::pair<std::string, std::string>, PointsOfItem> points;
    for (const ComparisonPoint& point : comparison.points) {
        if (ids.contains(point.item)) {
            points[{point.item, point.round}][point.participant] = &point;
        }
    }
    return points;
}

/// Covariance of the differences of one participant's vector: of its results, of the assigned values, and less what
/// both have in common, r_b of item b carried over to item a with the correlation of the results.
Eigen::MatrixXd covariance_of_vector(const engine::ComparisonVector& vector,
                                     const std::vector<const ComparisonPoint*>& points) {
    const auto m = static_cast<Eigen::Index>(points.size());
    const auto u = [&](Eigen::Index a) { return *points[static_cast<std::size_t>(a)]->u; };
    const auto u_X = [&](Eigen::Index a) { return *points[static_cast<std::size_t>(a)]->reference_u; };
    const auto r = [&](Eigen::Index a) { return points[static_cast<std::size_t>(a)]->correlation.value_or(0.0); };
    Eigen::MatrixXd covariance(m, m);
    for (Eigen::Index a = 0; a < m; ++a) {
        for (Eigen::Index b = 0; b < m; ++b) {
            const double own = a == b ? 1.0 : vector.correlation.size() > 0 ? vector.correlation(a, b) : 0.0;
            const double reference = a == b                                    ? 1.0
                                     : vector.reference_correlation.size() > 0 ? vector.reference_correlation(a, b)
                                                                               : 0.0;
            covariance(a, b) =
                own * u(a) * u(b) + reference * u_X(a) * u_X(b) - own * (r(b) * u(a) * u_X(b) + r(a) * u(b) * u_X(a));
        }
        // Also where no correlation coefficient describes what both have in common.
        const double u_D = *points[static_cast<std::size_t>(a)]->u_D;
        covariance(a, a) = u_D * u_D;
    }
    return covariance;
}

std::optional<reports::VectorScore> vector_score(const engine::ComparisonVector& vector,
                                                 const std::vector<const ComparisonPoint*>& points,
                                                 double coverage_probability) {
    const auto m = static_cast<Eigen::Index>(points.size());
    Eigen::VectorXd d(m);
    reports::VectorScore score;
    for (Eigen::Index a = 0; a < m; ++a) {
        const ComparisonPoint& point = *points[static_cast<std::size_t>(a)];
        d[a] = point.D;
        score.max_abs_En = std::max(score.max_abs_En, std::abs(*point.En));
    }
    try {
        const Eigen::MatrixXd covariance = covariance_of_vector(vector, points);
        score.vector_En = gum::vector_en(d, covariance, coverage_probability);
        const double k_p = gum::ellipsoid_coverage_factor(coverage_probability, points.size(),
                                                          std::numeric_limits<double>::infinity());
        score.mahalanobis_square = score.vector_En * score.vector_En * k_p * k_p;
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
    score.name = vector.name;
    score.participant = points.front()->participant;
    score.round = points.front()->round;
    score.quantities = m;
    score.printed.vector_En = printed_score(score.vector_En);
    score.printed.max_abs_En = printed_score(score.max_abs_En);
    return score;
}

}  // namespace

std::optional<reports::ComparisonSummary> summary_of_scores(const reports::Comparison& comparison,
                                                            const std::vector<EvaluatedItem>& items,
                                                            double coverage_probability) {
    std::vector<const ComparisonPoint*> points;
    for (const ComparisonPoint& point : comparison.points) {
        if (point.En) {
            points.push_back(&point);
        }
    }
    if (points.empty()) {
        return std::nullopt;
    }
    const gum::ComparisonSummary numbers = gum::summarise(scores_of(points));
    reports::ComparisonSummary row;
    row.direction = "all";
    row.points = static_cast<std::int64_t>(numbers.points);
    row.count_above_1 = static_cast<std::int64_t>(numbers.count_above_1);
    row.mean_abs_En = numbers.mean_absolute_en;
    row.max_abs_En = numbers.largest_absolute_en;
    row.rms_En = numbers.rms_en;
    row.printed.mean_abs_En = printed_score(row.mean_abs_En);
    row.printed.max_abs_En = printed_score(row.max_abs_En);
    row.printed.rms_En = printed_score(row.rms_En);
    add_variants(points, row);
    const bool one_unit = std::all_of(comparison.items.begin(), comparison.items.end(), [&](const auto& item) {
        return item.difference_unit == comparison.items.front().difference_unit;
    });
    if (one_unit) {
        add_limits_of_failure(points, row);
    }
    if (items.size() == 1) {
        add_distribution(comparison, items.front(), coverage_probability, row);
    }
    return row;
}

std::vector<reports::ParticipantSummary> participant_summaries(const engine::ComparisonJob& job,
                                                               const reports::Comparison& comparison) {
    std::map<std::string, std::size_t> position;
    std::vector<reports::ParticipantSummary> summaries(job.participants.size());
    std::vector<std::vector<const ComparisonPoint*>> scored(job.participants.size());
    for (std::size_t p = 0; p < job.participants.size(); ++p) {
        position[job.participants[p].id] = p;
        summaries[p].id = job.participants[p].id;
        summaries[p].name = job.participants[p].name;
        summaries[p].group = job.participants[p].group;
    }
    for (const ComparisonPoint& point : comparison.points) {
        const std::size_t p = position.at(point.participant);
        ++summaries[p].results;
        summaries[p].scored += point.signal.empty() ? 0 : 1;
        summaries[p].warnings += point.signal == "warning" ? 1 : 0;
        summaries[p].actions += point.signal == "action" ? 1 : 0;
        summaries[p].inconclusive += point.signal == "inconclusive" ? 1 : 0;
        if (point.En) {
            scored[p].push_back(&point);
        }
    }
    for (std::size_t p = 0; p < summaries.size(); ++p) {
        if (scored[p].empty()) {
            continue;
        }
        const gum::ComparisonSummary numbers = gum::summarise(scores_of(scored[p]));
        summaries[p].mean_abs_En = numbers.mean_absolute_en;
        summaries[p].max_abs_En = numbers.largest_absolute_en;
        summaries[p].rms_En = numbers.rms_en;
        summaries[p].printed.mean_abs_En = printed_score(summaries[p].mean_abs_En);
        summaries[p].printed.max_abs_En = printed_score(summaries[p].max_abs_En);
        summaries[p].printed.rms_En = printed_score(summaries[p].rms_En);
    }
    return summaries;
}

std::vector<reports::VectorScore> vector_scores(const engine::ComparisonJob& job, const reports::Comparison& comparison,
                                                std::size_t& left_out) {
    left_out = 0;
    std::set<std::size_t> items;
    for (const engine::ComparisonVector& vector : job.vectors) {
        items.insert(vector.items.begin(), vector.items.end());
    }
    std::vector<reports::VectorScore> scores;
    if (items.empty()) {
        return scores;
    }
    const auto points = by_item_and_round(job, items, comparison);
    for (const engine::ComparisonVector& vector : job.vectors) {
        for (const std::string& round : job.rounds) {
            for (const engine::ComparisonParticipant& participant : job.participants) {
                std::vector<const ComparisonPoint*> chosen;
                for (const std::size_t item : vector.items) {
                    const auto of_item = points.find({job.items[item].id, round});
                    if (of_item == points.end()) {
                        break;
                    }
                    const auto point = of_item->second.find(participant.id);
                    if (point != of_item->second.end() && point->second->En) {
                        chosen.push_back(point->second);
                    }
                }
                if (chosen.size() == vector.items.size() && !chosen.empty()) {
                    if (std::optional<reports::VectorScore> score =
                            vector_score(vector, chosen, job.coverage_probability)) {
                        scores.push_back(std::move(*score));
                    } else {
                        ++left_out;
                    }
                }
            }
        }
    }
    return scores;
}

std::vector<reports::YoudenDiagram> youden_diagrams(const engine::ComparisonJob& job,
                                                    const reports::Comparison& comparison) {
    std::set<std::size_t> items;
    for (const auto& [first, second] : job.youden) {
        items.insert(first);
        items.insert(second);
    }
    std::vector<reports::YoudenDiagram> diagrams;
    if (items.empty()) {
        return diagrams;
    }
    const auto points = by_item_and_round(job, items, comparison);
    for (const auto& [first, second] : job.youden) {
        for (const std::string& round : job.rounds) {
            const auto of_first = points.find({job.items[first].id, round});
            const auto of_second = points.find({job.items[second].id, round});
            if (of_first == points.end() || of_second == points.end()) {
                continue;
            }
            reports::YoudenDiagram diagram;
            diagram.first_item = job.items[first].id;
            diagram.second_item = job.items[second].id;
            diagram.round = round;
            diagram.first_unit = gum::unit_of_difference(job.items[first].unit.text());
            diagram.second_unit = gum::unit_of_difference(job.items[second].unit.text());
            diagram.sigma_first = scale_of_z(comparison, diagram.first_item, round);
            diagram.sigma_second = scale_of_z(comparison, diagram.second_item, round);
            if (!diagram.sigma_first || !diagram.sigma_second) {
                diagram.sigma_first = diagram.sigma_second = std::nullopt;
            }
            for (const engine::ComparisonParticipant& participant : job.participants) {
                const auto a = of_first->second.find(participant.id);
                const auto b = of_second->second.find(participant.id);
                if (a != of_first->second.end() && b != of_second->second.end()) {
                    diagram.points.push_back({participant.id, a->second->D, b->second->D});
                }
            }
            if (!diagram.points.empty()) {
                add_ellipse(diagram);
                diagrams.push_back(std::move(diagram));
            }
        }
    }
    return diagrams;
}

}  // namespace gumcert::app
