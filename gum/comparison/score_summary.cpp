#include "gum/comparison/score_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gum/comparison/robust_statistics.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

namespace {

/// More points than this are not held against the distribution of their sum of squares: a full matrix.
constexpr std::size_t k_most_points_of_distribution = 400;

std::vector<const ScoredResult*> with_en(const std::vector<EvaluatedItem>& items) {
    std::vector<const ScoredResult*> points;
    for (const EvaluatedItem& item : items) {
        for (const ScoredResult& point : item.scores) {
            if (point.en) {
                points.push_back(&point);
            }
        }
    }
    return points;
}

ComparisonSummary summary_of(const std::vector<const ScoredResult*>& points) {
    std::vector<ComparisonScore> scores;
    for (const ScoredResult* point : points) {
        scores.push_back({.difference = point->difference,
                          .u_difference = *point->u_difference,
                          .U_difference = *point->U_difference,
                          .en = *point->en,
                          .zeta = *point->zeta});
    }
    return summarise(scores);
}

/// Differences of one item with their covariance: cov(D_i, D_j) = V_ij − c_i − c_j + u²(X).
MethodDifferences differences_of(const std::vector<const ScoredResult*>& points,
                                 const std::vector<std::size_t>& positions, const EvaluatedItem& item) {
    const auto m = static_cast<Eigen::Index>(points.size());
    MethodDifferences differences;
    differences.d.resize(m);
    differences.U.resize(m);
    differences.degrees_of_freedom.resize(m);
    differences.U_method.resize(m);
    differences.U_reference.resize(m);
    differences.covariance.resize(m, m);
    const double u_X = *points.front()->u_assigned;
    // D_i = x_i − X, c_i = cov(x_i, X): all differences have X in common, and c_i where the result is part of X.
    const double variance_of_X = u_X * u_X;
    for (Eigen::Index i = 0; i < m; ++i) {
        const ScoredResult& point = *points[static_cast<std::size_t>(i)];
        const auto a = static_cast<Eigen::Index>(positions[static_cast<std::size_t>(i)]);
        differences.d[i] = point.difference;
        differences.U[i] = *point.U_difference;
        differences.degrees_of_freedom[i] =
            degrees_of_freedom_of_difference(item.data, positions[static_cast<std::size_t>(i)], point, item.assigned);
        differences.U_method[i] = point.U_of_scores();
        differences.U_reference[i] = *point.U_assigned;
        for (Eigen::Index j = 0; j < m; ++j) {
            const auto b = static_cast<Eigen::Index>(positions[static_cast<std::size_t>(j)]);
            const double between = i == j                            ? point.uncertainty->u * point.uncertainty->u
                                   : item.data.covariance.size() > 0 ? item.data.covariance(a, b)
                                                                     : 0.0;
            differences.covariance(i, j) =
                between - item.assigned.covariance[a] - item.assigned.covariance[b] + variance_of_X;
        }
        // The u_D that the score has. Where it comes from the scatter of the others, it is not that of the stated
        // uncertainties.
        differences.covariance(i, i) = *point.u_difference * *point.u_difference;
    }
    return differences;
}

/// What the scores of one item say together, where it is known how they hang together.
/// \param probability  for which E_n is formed: en_coverage_probability()
std::optional<Agreement> agreement_of(const EvaluatedItem& item, double probability) {
    std::vector<const ScoredResult*> points;
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < item.scores.size(); ++i) {
        const ScoredResult& point = item.scores[i];
        if (point.en) {
            points.push_back(&point);
            positions.push_back(i);
        }
        if (point.en && point.in_unknown_group) {
            return std::nullopt;  // nobody knows what the group shares
        }
    }
    // With an unknown correlation no joint distribution of the scores exists; single scores stand all the same.
    if (!item.assigned.correlation_known || points.size() < 2 || points.size() > k_most_points_of_distribution) {
        return std::nullopt;
    }
    try {
        return agreement(differences_of(points, positions, item), probability);
    } catch (const DiagnosedError&) {
        return std::nullopt;  // correlations of different origin need not make a covariance together
    }
}

/// E_n of all points, with another number in place of E_n where a point has one.
std::optional<EnVariant> variant_of(const std::vector<const ScoredResult*>& points,
                                    std::optional<double> ScoredResult::*number) {
    bool any = false;
    double sum = 0.0;
    EnVariant variant;
    for (const ScoredResult* point : points) {
        const double en = std::abs((point->*number).value_or(*point->en));
        any = any || (point->*number).has_value();
        sum += en;
        variant.largest_absolute_en = std::max(variant.largest_absolute_en, en);
        variant.count_above_1 += en > 1.0 ? 1U : 0U;
    }
    variant.mean_absolute_en = sum / static_cast<double>(points.size());
    return any ? std::optional(variant) : std::nullopt;
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
            // Equal values get one rank: else the order in which the laboratories are listed would make a correlation.
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
std::optional<double> scale_of_z(const ItemResult& item) {
    if (!item.sigma_pt) {
        return std::nullopt;
    }
    return item.score == DecidingScore::z_prime ? std::hypot(*item.sigma_pt, item.u.value_or(0.0)) : *item.sigma_pt;
}

/// With MADe as scale, which one value has not.
RobustEstimate median_with_scale(const std::vector<double>& values) {
    return values.size() > 1 ? median_with_made(values) : RobustEstimate{.location = values.front()};
}

void add_ellipse(YoudenDiagram& diagram) {
    constexpr std::size_t k_least_points = 3;
    constexpr std::size_t k_corners = 72;
    constexpr double k_probability = 0.95;
    std::vector<double> first;
    std::vector<double> second;
    for (const YoudenPoint& point : diagram.points) {
        first.push_back(point.first);
        second.push_back(point.second);
    }
    const RobustEstimate of_first = median_with_scale(first);
    const RobustEstimate of_second = median_with_scale(second);
    diagram.centre_first = of_first.location;
    diagram.centre_second = of_second.location;
    diagram.scale_first = of_first.scale;
    diagram.scale_second = of_second.scale;
    // By ranks and medians: one outlier, which the diagram is to show, would stretch an ellipse of moments until it is
    // inside. 2 sin(π ρ/6) is the coefficient of two normal quantities whose ranks have ρ.
    diagram.correlation =
        std::clamp(2.0 * std::sin(std::numbers::pi / 6.0 * rank_correlation(first, second)), -1.0, 1.0);
    if (diagram.points.size() < k_least_points || !(diagram.scale_first > 0.0) || !(diagram.scale_second > 0.0)) {
        return;
    }
    const double radius = ellipsoid_coverage_factor(k_probability, 2, std::numeric_limits<double>::infinity());
    // (1, 0; r, √(1 − r²)) is the root of the correlation matrix: it takes the circle of radius √χ²_0.95(2) to the
    // ellipse.
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

/// The evaluations of all items and rounds by their positions; null where there is none.
class Table {
public:
    Table(const ComparisonScheme& scheme, const std::vector<EvaluatedItem>& items)
        : rounds_(scheme.rounds.size()), cells_(scheme.items.size() * rounds_, nullptr) {
        for (const EvaluatedItem& item : items) {
            cells_[item.result.item * rounds_ + item.result.round] = &item;
        }
    }

    [[nodiscard]] const EvaluatedItem* at(std::size_t item, std::size_t round) const {
        return cells_[item * rounds_ + round];
    }

private:
    std::size_t rounds_;
    std::vector<const EvaluatedItem*> cells_;
};

/// The result of a participant, of which there is one at most in the order of the participants; null without.
const ScoredResult* score_of(const EvaluatedItem& item, std::size_t participant) {
    const auto found =
        std::lower_bound(item.scores.begin(), item.scores.end(), participant,
                         [](const ScoredResult& point, std::size_t wanted) { return point.participant < wanted; });
    return found != item.scores.end() && found->participant == participant ? &*found : nullptr;
}

/// Covariance of the differences of one participant's vector: of its results, of the assigned values, and less what
/// both have in common, r_b of item b carried over to item a with the correlation of the results.
Eigen::MatrixXd covariance_of_vector(const ComparisonVector& vector, const std::vector<const ScoredResult*>& points) {
    const auto m = static_cast<Eigen::Index>(points.size());
    const auto u = [&](Eigen::Index a) { return points[static_cast<std::size_t>(a)]->uncertainty->u; };
    const auto u_X = [&](Eigen::Index a) { return *points[static_cast<std::size_t>(a)]->u_assigned; };
    const auto r = [&](Eigen::Index a) { return points[static_cast<std::size_t>(a)]->correlation.value_or(0.0); };
    Eigen::MatrixXd covariance(m, m);
    for (Eigen::Index a = 0; a < m; ++a) {
        for (Eigen::Index b = 0; b < m; ++b) {
            // cov(D_a, D_b) = cov(x_a, x_b) + cov(X_a, X_b) − cov(x_a, X_b) − cov(X_a, x_b)
            const double own = a == b ? 1.0 : vector.correlation.size() > 0 ? vector.correlation(a, b) : 0.0;
            const double reference = a == b                                    ? 1.0
                                     : vector.reference_correlation.size() > 0 ? vector.reference_correlation(a, b)
                                                                               : 0.0;
            covariance(a, b) =
                own * u(a) * u(b) + reference * u_X(a) * u_X(b) - own * (r(b) * u(a) * u_X(b) + r(a) * u(b) * u_X(a));
        }
        // Also where no correlation coefficient describes what both have in common.
        const double u_D = *points[static_cast<std::size_t>(a)]->u_difference;
        covariance(a, a) = u_D * u_D;
    }
    return covariance;
}

/// \param probability  for which E_n is formed: en_coverage_probability()
std::optional<VectorScore> vector_score(const ComparisonVector& vector, const std::vector<const ScoredResult*>& points,
                                        double probability) {
    constexpr double k_normal = std::numeric_limits<double>::infinity();
    const auto m = static_cast<Eigen::Index>(points.size());
    const double k_one = coverage_factor(probability, k_normal);
    Eigen::VectorXd d(m);
    Eigen::VectorXd of_scores(m);
    VectorScore score{
        .participant = points.front()->participant, .round = points.front()->round, .quantities = points.size()};
    for (Eigen::Index a = 0; a < m; ++a) {
        const ScoredResult& point = *points[static_cast<std::size_t>(a)];
        d[a] = point.difference;
        // With U_D/k_one in place of u_D: a U_D of few degrees of freedom, or of a stated k, has another factor than
        // the normal distribution, and a vector of one quantity would contradict its E_n.
        of_scores[a] = *point.en * k_one * *point.u_difference;
        score.largest_absolute_en = std::max(score.largest_absolute_en, std::abs(*point.en));
    }
    try {
        const Eigen::MatrixXd covariance = covariance_of_vector(vector, points);
        // E_n of one quantity is settled at 1, and a sum of one square would only round it.
        score.vector_en = m == 1 ? score.largest_absolute_en : vector_en(of_scores, covariance, probability);
        // √(Dᵀ V⁻¹ D)/k_p, and Dᵀ V⁻¹ D again.
        const double distance =
            vector_en(d, covariance, probability) * ellipsoid_coverage_factor(probability, points.size(), k_normal);
        score.mahalanobis_square = distance * distance;
    } catch (const DiagnosedError&) {
        return std::nullopt;
    }
    return score;
}

}  // namespace

std::optional<ScoreSummary> summary_of_scores(const ComparisonScheme& scheme, const std::vector<EvaluatedItem>& items) {
    const std::vector<const ScoredResult*> points = with_en(items);
    if (points.empty()) {
        return std::nullopt;
    }
    ScoreSummary summary{.scores = summary_of(points)};
    summary.worst = variant_of(points, &ScoredResult::en_worst);
    summary.audited = variant_of(points, &ScoredResult::en_audited);
    const auto unit_of = [&](const EvaluatedItem& item) {
        return unit_of_difference(scheme.items[item.result.item].unit.text());
    };
    if (std::all_of(items.begin(), items.end(),
                    [&](const EvaluatedItem& item) { return unit_of(item) == unit_of(items.front()); })) {
        const auto [smallest, largest] = std::minmax_element(
            points.begin(), points.end(),
            [](const ScoredResult* a, const ScoredResult* b) { return *a->U_difference < *b->U_difference; });
        summary.d_fail_smallest = (*smallest)->U_difference;
        summary.d_fail_largest = (*largest)->U_difference;
    }
    // Results of several items come from the same laboratories, and how they correlate is not stated: nothing joint is
    // computed for them.
    if (items.size() == 1) {
        summary.agreement = agreement_of(items.front(), en_coverage_probability(scheme.coverage_probability));
    }
    return summary;
}

std::vector<ParticipantSummary> participant_summaries(const ComparisonScheme& scheme,
                                                      const std::vector<EvaluatedItem>& items) {
    std::vector<ParticipantSummary> summaries(scheme.participants.size());
    std::vector<std::vector<const ScoredResult*>> scored(summaries.size());
    for (const EvaluatedItem& item : items) {
        for (const ScoredResult& point : item.scores) {
            ParticipantSummary& summary = summaries[point.participant];
            ++summary.results;
            summary.scored += point.verdict == Verdict::no_score ? 0U : 1U;
            summary.warnings += point.verdict == Verdict::warning ? 1U : 0U;
            summary.actions += point.verdict == Verdict::action ? 1U : 0U;
            summary.inconclusive += point.verdict == Verdict::inconclusive ? 1U : 0U;
            if (point.en) {
                scored[point.participant].push_back(&point);
            }
        }
    }
    for (std::size_t p = 0; p < summaries.size(); ++p) {
        if (!scored[p].empty()) {
            summaries[p].scores = summary_of(scored[p]);
        }
    }
    return summaries;
}

std::vector<VectorScore> vector_scores(const ComparisonScheme& scheme, const std::vector<EvaluatedItem>& items,
                                       std::size_t& left_out) {
    left_out = 0;
    const Table table(scheme, items);
    const double probability = en_coverage_probability(scheme.coverage_probability);
    std::vector<VectorScore> scores;
    for (std::size_t v = 0; v < scheme.vectors.size(); ++v) {
        const ComparisonVector& vector = scheme.vectors[v];
        for (std::size_t round = 0; round < scheme.rounds.size(); ++round) {
            for (std::size_t participant = 0; participant < scheme.participants.size(); ++participant) {
                std::vector<const ScoredResult*> chosen;
                for (const std::size_t item : vector.items) {
                    const EvaluatedItem* evaluated = table.at(item, round);
                    const ScoredResult* point = evaluated != nullptr ? score_of(*evaluated, participant) : nullptr;
                    if (point == nullptr || !point->en) {
                        break;
                    }
                    chosen.push_back(point);
                }
                // A vector with a quantity missing is another vector: k_p and the region belong to all of its
                // quantities.
                if (chosen.empty() || chosen.size() != vector.items.size()) {
                    continue;
                }
                if (std::optional<VectorScore> score = vector_score(vector, chosen, probability)) {
                    score->vector = v;
                    scores.push_back(*score);
                } else {
                    ++left_out;
                }
            }
        }
    }
    return scores;
}

std::vector<YoudenDiagram> youden_diagrams(const ComparisonScheme& scheme, const std::vector<EvaluatedItem>& items) {
    const Table table(scheme, items);
    std::vector<YoudenDiagram> diagrams;
    for (const auto& [first, second] : scheme.youden) {
        for (std::size_t round = 0; round < scheme.rounds.size(); ++round) {
            const EvaluatedItem* of_first = table.at(first, round);
            const EvaluatedItem* of_second = table.at(second, round);
            if (of_first == nullptr || of_second == nullptr) {
                continue;
            }
            YoudenDiagram diagram{.first_item = first, .second_item = second, .round = round};
            diagram.sigma_first = scale_of_z(of_first->result);
            diagram.sigma_second = scale_of_z(of_second->result);
            // Limits of z on one axis alone would read as limits of both.
            if (!diagram.sigma_first || !diagram.sigma_second) {
                diagram.sigma_first = diagram.sigma_second = std::nullopt;
            }
            for (const ScoredResult& a : of_first->scores) {
                if (const ScoredResult* b = score_of(*of_second, a.participant)) {
                    diagram.points.push_back({a.participant, a.difference, b->difference});
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

}  // namespace gumcert::gum
