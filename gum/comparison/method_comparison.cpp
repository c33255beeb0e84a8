#include "gum/comparison/method_comparison.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "gum/argument_check.h"
#include "gum/comparison/agreement.h"
#include "gum/comparison/method_correlation.h"
#include "gum/comparison/refusal_place.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {

namespace {

using Eigen::Index;

constexpr double k_rounding_of_correlation = 1e-9;
constexpr double k_clearly_smaller = 0.99;    // a smaller uncertainty, of the larger one
constexpr double k_noise_of_positions = 5.0;  // spread of reference values over their u, for a slope to mean much

/// The differences of all points, and what both sides contribute to their uncertainty.
struct Differences {
    MethodDifferences all;
    std::vector<ComparedValue> method, reference;
    std::vector<double> correlation;                     ///< of both values at a point
    std::vector<EnUncertainty> of_method, of_reference;  ///< expanded uncertainties as E_n takes them
};

std::string place_of(const ComparedPoint& point, std::size_t i) {
    std::string place = "point " + (point.name.empty() ? std::to_string(i + 1) : point.name);
    if (point.name.empty() && point.angle_deg) {
        place = "point at " + text::shortest(*point.angle_deg) + "°";
    }
    return point.direction.empty() ? place : place + ", direction " + point.direction;
}

void require_sizes(const MethodComparison& comparison) {
    const auto m = static_cast<Index>(comparison.points.size());
    const auto fits = [&](const Eigen::MatrixXd& matrix) { return matrix.rows() == m && matrix.cols() == m; };
    if (m == 0 || !fits(comparison.covariance) || !fits(comparison.reference_covariance) ||
        (comparison.cross_covariance.size() > 0 && !fits(comparison.cross_covariance))) {
        refuse("GC-COMPARE-0201", "comparison of methods",
               text::count_of(m, "point") + " and a covariance of " + std::to_string(comparison.covariance.rows()) +
                   " and " + std::to_string(comparison.reference_covariance.rows()),
               "every point has its row in the covariance of both methods",
               "Give at least 1 point and all covariances.");
    }
}

double correlation_of(const MethodComparison& comparison, std::size_t i) {
    const auto at = static_cast<Index>(i);
    const ComparedPoint& point = comparison.points[i];
    if (comparison.cross_covariance.size() == 0 || comparison.cross_covariance(at, at) == 0.0) {
        return 0.0;
    }
    const double r = comparison.cross_covariance(at, at) / (point.u * point.reference_u);
    if (!(std::abs(r) <= 1.0 + k_rounding_of_correlation)) {
        refuse("GC-COMPARE-0202", place_of(point, i),
               "the covariance of both methods is " + text::shortest(comparison.cross_covariance(at, at)) +
                   ", with standard uncertainties " + text::shortest(point.u) + " and " +
                   text::shortest(point.reference_u),
               "a correlation coefficient lies between -1 and 1",
               "State the same uncertainty of a shared source in both budgets, or list it in \"independent_sources\".");
    }
    return std::clamp(r, -1.0, 1.0);
}

/// ν of u(D) by Welch and Satterthwaite. What both sides share cancels in u(D), but not in what is estimated.
double degrees_of_difference(const ComparedPoint& point, double u_difference) {
    constexpr double k_least = 1.0;
    const double nu = point.nu.value_or(k_infinity);
    const double reference_nu = point.reference_nu.value_or(k_infinity);
    const double of_method = point.u / u_difference;
    const double of_reference = point.reference_u / u_difference;
    const double inverse = std::pow(of_method, 4) / nu + std::pow(of_reference, 4) / reference_nu;
    return inverse > 0.0 ? std::max(k_least, 1.0 / inverse) : k_infinity;
}

/// Whether several points have the same u with the same finite ν: estimates that were made apart are never equal.
bool is_one_estimate(const std::vector<ComparedPoint>& points) {
    std::set<std::pair<double, double>> of_method;
    std::set<std::pair<double, double>> of_reference;
    return std::any_of(points.begin(), points.end(), [&](const ComparedPoint& point) {
        return (point.nu && std::isfinite(*point.nu) && !of_method.emplace(*point.nu, point.u).second) ||
               (point.reference_nu && std::isfinite(*point.reference_nu) &&
                !of_reference.emplace(*point.reference_nu, point.reference_u).second);
    });
}

Differences differences_of(const MethodComparison& comparison) {
    const auto m = static_cast<Index>(comparison.points.size());
    Differences differences;
    MethodDifferences& all = differences.all;
    all.d.resize(m);
    all.degrees_of_freedom.resize(m);
    all.one_estimate = is_one_estimate(comparison.points);
    all.U.resize(m);
    all.U_method.resize(m);
    all.U_reference.resize(m);
    // D = method − reference, so V = V_method + V_ref − C − Cᵀ. Taking C as 0 would hide failures: what both share
    // cancels in D, but would still count in its uncertainty.
    all.covariance = comparison.covariance + comparison.reference_covariance;
    if (comparison.cross_covariance.size() > 0) {
        all.covariance -= comparison.cross_covariance + comparison.cross_covariance.transpose();
    }
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        const ComparedPoint& point = comparison.points[i];
        const auto at = static_cast<Index>(i);
        const double p = comparison.coverage_probability;
        const EnUncertainty of_method =
            point.of_scores ? *point.of_scores
                            : en_uncertainty(point.u, point.U, point.k, point.nu.value_or(k_infinity), p);
        const EnUncertainty of_reference = point.reference_of_scores
                                               ? *point.reference_of_scores
                                               : en_uncertainty(point.reference_u, point.reference_U, point.reference_k,
                                                                point.reference_nu.value_or(k_infinity), p);
        differences.of_method.push_back(of_method);
        differences.of_reference.push_back(of_reference);
        differences.method.push_back({point.value, point.u, of_method.U});
        differences.reference.push_back({point.reference_value, point.reference_u, of_reference.U});
        differences.correlation.push_back(correlation_of(comparison, i));
        ComparisonScore at_point;
        at_place(place_of(point, i), [&] {
            at_point = score(differences.method.back(), differences.reference.back(), differences.correlation.back());
        });
        // A settled E_n of 1 is one in every number that is computed from the differences.
        const bool at_limit = std::abs(at_point.en) == 1.0;
        all.d(at) = at_limit ? std::copysign(at_point.U_difference, at_point.en) : at_point.difference;
        all.U(at) = at_point.U_difference;
        all.degrees_of_freedom(at) = degrees_of_difference(point, at_point.u_difference);
        all.U_method(at) = of_method.U;
        all.U_reference(at) = of_reference.U;
        // The u of the score itself, which does not cancel for r close to 1: ζ of the point and the joint tests use one
        // number.
        all.covariance(at, at) = at_point.u_difference * at_point.u_difference;
    }
    all.method_covariance = comparison.covariance;
    all.reference_covariance = comparison.reference_covariance;
    return differences;
}

/// E_n for the worst plausible correlation; infinite where no finite number bounds it.
double worst_en(const ComparedValue& method, const ComparedValue& reference) {
    const std::optional<double> worst = worst_plausible_en(method, reference);
    const double difference = method.value - reference.value;
    return worst ? *worst : difference == 0.0 ? 0.0 : std::copysign(k_infinity, difference);
}

double audited_en(const MethodComparison& comparison, const Differences& differences, std::size_t i) {
    const auto corrected = [](ComparedValue value, double factor) {
        value.standard_uncertainty *= factor;
        value.expanded_uncertainty *= factor;
        return value;
    };
    return score(corrected(differences.method[i], comparison.audited_factor),
                 corrected(differences.reference[i], comparison.reference_audited_factor), differences.correlation[i])
        .en;
}

MethodScore score_at(const MethodComparison& comparison, const Differences& differences, std::size_t i) {
    const auto at = static_cast<Index>(i);
    const auto if_converted = [](const EnUncertainty& taken) {
        return taken.converted ? std::optional(taken) : std::nullopt;
    };
    MethodScore score;
    score.difference = differences.all.d(at);
    score.u_difference = std::sqrt(differences.all.covariance(at, at));
    score.U_difference = differences.all.U(at);
    score.en = score.difference / score.U_difference;
    score.zeta = score.difference / score.u_difference;
    score.correlation = differences.correlation[i];
    score.of_scores = if_converted(differences.of_method[i]);
    score.reference_of_scores = if_converted(differences.of_reference[i]);
    if (comparison.correlation_unknown) {
        score.en_worst = worst_en(differences.method[i], differences.reference[i]);
    }
    if (comparison.is_audited()) {
        score.en_audited = audited_en(comparison, differences, i);
    }
    return score;
}

// ---- summary of a direction -----------------------------------------------------------------------------------------

/// Directions in the order of the points, then all of them together.
std::vector<MethodSummary> rows_of(const MethodComparison& comparison) {
    std::vector<MethodSummary> rows;
    MethodSummary all{.direction = "all", .points = {}, .agreement = {}};
    bool has_unnamed = false;
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        const std::string& direction = comparison.points[i].direction;
        all.points.push_back(static_cast<Index>(i));
        if (direction == "all") {
            refuse("GC-COMPARE-0203", place_of(comparison.points[i], i), "the direction is called \"all\"",
                   "\"all\" stands for all directions together", "Give the direction another name.");
        }
        if (direction.empty()) {
            has_unnamed = true;
            continue;
        }
        auto row =
            std::find_if(rows.begin(), rows.end(), [&](const MethodSummary& r) { return r.direction == direction; });
        if (row == rows.end()) {
            rows.push_back({.direction = direction, .points = {}, .agreement = {}});
            row = std::prev(rows.end());
        }
        row->points.push_back(static_cast<Index>(i));
    }
    if (has_unnamed || rows.size() > 1) {
        rows.push_back(std::move(all));
    }
    return rows;
}

MethodDifferences selected(const MethodDifferences& all, const std::vector<Index>& points) {
    MethodDifferences chosen;
    chosen.d = all.d(points);
    chosen.covariance = all.covariance(points, points);
    chosen.U = all.U(points);
    chosen.degrees_of_freedom = all.degrees_of_freedom(points);
    chosen.one_estimate = all.one_estimate;
    chosen.U_method = all.U_method(points);
    chosen.U_reference = all.U_reference(points);
    chosen.method_covariance = all.method_covariance(points, points);
    chosen.reference_covariance = all.reference_covariance(points, points);
    return chosen;
}

/// \param number  of E_n, one a point
std::optional<EnVariant> variant_of(const std::vector<MethodScore>& scores, const std::vector<Index>& points,
                                    std::optional<double> MethodScore::*number) {
    double sum = 0.0;
    EnVariant variant;
    for (const Index i : points) {
        const std::optional<double>& en = scores[static_cast<std::size_t>(i)].*number;
        if (!en) {
            return std::nullopt;
        }
        sum += std::abs(*en);
        variant.largest_absolute_en = std::max(variant.largest_absolute_en, std::abs(*en));
        variant.count_above_1 += std::abs(*en) > 1.0 ? 1U : 0U;
    }
    variant.mean_absolute_en = sum / static_cast<double>(points.size());
    return variant;
}

/// The differences as a line is fitted to them. Where the mean was taken off, their covariance is singular in its
/// direction: a variance there, as large as that of a point, leaves the slope as it is and makes the constant 0.
MethodDifferences for_bias_line(const MethodComparison& comparison, MethodDifferences differences) {
    if (comparison.mean_taken_off) {
        const auto n = static_cast<double>(differences.covariance.rows());
        differences.covariance.array() += differences.covariance.trace() / (n * n);
    }
    return differences;
}

/// Slope of the bias line that the uncertainty of the reference values alone makes: their errors stand in t, and with
/// the other sign in D. Expected value of Σ (t − t̄)(D − D̄) from the covariance of both, over Σ (t − t̄)²; what all
/// points share moves t̄ and turns nothing. To first order, for equal weights.
double slope_of_noise(const MethodComparison& comparison, const std::vector<Index>& points) {
    if (comparison.bias_against_position || points.empty()) {
        return 0.0;
    }
    const auto n = static_cast<double>(points.size());
    Eigen::VectorXd t(static_cast<Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        t(static_cast<Index>(i)) = comparison.points[static_cast<std::size_t>(points[i])].reference_value;
    }
    // cov(D, t) point by point, D = method − reference and t = reference.
    Eigen::MatrixXd covariance = -comparison.reference_covariance(points, points);
    if (comparison.cross_covariance.size() > 0) {
        covariance += comparison.cross_covariance(points, points);
    }
    const double spread = (t.array() - t.mean()).square().sum();
    return spread > 0.0 ? (covariance.trace() - covariance.sum() / n) / spread : 0.0;
}

/// Whether the reference values spread so little that a line against them shows their own noise.
bool is_noise(const MethodComparison& comparison, const std::vector<Index>& points) {
    double sum = 0.0;
    double squares = 0.0;
    double variance = 0.0;
    const double first = comparison.points[static_cast<std::size_t>(points.front())].reference_value;
    for (const Index i : points) {
        const ComparedPoint& point = comparison.points[static_cast<std::size_t>(i)];
        const double value = point.reference_value - first;  // large values would lose their digits
        sum += value;
        squares += value * value;
        variance += point.reference_u * point.reference_u;
    }
    const auto count = static_cast<double>(points.size());
    const double spread = std::max(0.0, squares / count - sum * sum / (count * count));
    return spread < k_noise_of_positions * k_noise_of_positions * variance / count;
}

std::optional<MethodBias> bias_of(const MethodComparison& comparison, const MethodDifferences& differences,
                                  const std::vector<Index>& points) {
    Eigen::VectorXd t(differences.d.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ComparedPoint& point = comparison.points[static_cast<std::size_t>(points[i])];
        if (comparison.bias_against_position && !point.position) {
            return std::nullopt;
        }
        t(static_cast<Index>(i)) = comparison.bias_against_position ? *point.position : point.reference_value;
    }
    const MethodDifferences of_line = for_bias_line(comparison, differences);
    const std::optional<BiasLine> line = bias_line(of_line, t);
    if (!line) {
        return std::nullopt;
    }
    // Normal: the covariance of the differences is stated, not estimated from what the line leaves.
    const double k = coverage_factor(comparison.coverage_probability, k_infinity);
    const bool slope_is_noise = !comparison.bias_against_position && is_noise(comparison, points);
    const BiasQuestion question{.constant = !comparison.mean_taken_off,
                                .slope = !slope_is_noise,
                                .slope_of_noise = slope_of_noise(comparison, points)};
    return MethodBias{.line = *line,
                      .U_constant = k * line->u_constant,
                      .U_slope = k * line->u_slope,
                      .against_position = comparison.bias_against_position,
                      .span = t.maxCoeff() - t.minCoeff(),
                      .slope_is_noise = slope_is_noise,
                      .test = bias_test(of_line, t, question)};
}

/// The comparison with the findings on the uncertainties corrected.
MethodComparison corrected(const MethodComparison& comparison) {
    MethodComparison result = comparison;
    const double f = comparison.audited_factor;
    const double of_reference = comparison.reference_audited_factor;
    const auto scale = [](double factor, double& u, double& U, std::optional<EnUncertainty>& of_scores) {
        u *= factor;
        U *= factor;
        if (of_scores) {
            of_scores->U *= factor;
        }
    };
    for (ComparedPoint& point : result.points) {
        scale(f, point.u, point.U, point.of_scores);
        scale(of_reference, point.reference_u, point.reference_U, point.reference_of_scores);
    }
    result.covariance *= f * f;
    result.reference_covariance *= of_reference * of_reference;
    result.cross_covariance *= f * of_reference;
    result.audited_factor = result.reference_audited_factor = 1.0;
    return result;
}

std::optional<double> largest_of(const std::optional<EnVariant>& variant) {
    return variant ? std::optional(variant->largest_absolute_en) : std::nullopt;
}

/// Directions that are judged side by side; the row of all of them is one.
std::size_t family_of(const MethodSummary& row, const MethodResult& result) {
    return row.direction != "all" && result.summaries.size() > 1 ? result.summaries.size() - 1 : 1;
}

/// Directions of their own have no line in common.
bool has_bias_line(const MethodSummary& row, const MethodResult& result) {
    return row.direction != "all" || result.summaries.size() == 1;
}

/// Whether points of both sides can be judged for every plausible correlation of the methods: each pair of values for
/// itself, with an uncertainty that is left where the whole of the smaller one is common. What points share with each
/// other could be common to both sides in any way, and of finite ν it is not known how they would be.
bool can_be_judged_for_any_correlation(const MethodComparison& comparison, const Differences& differences,
                                       const std::vector<Index>& points) {
    constexpr double k_equal_factors = 0.025;
    const auto is_diagonal = [&](const Eigen::MatrixXd& covariance) {
        const Eigen::MatrixXd chosen = covariance(points, points);
        const Eigen::MatrixXd variances = chosen.diagonal().asDiagonal();
        return chosen == variances;
    };
    const auto is_judged = [&](Index i) {
        const auto at = static_cast<std::size_t>(i);
        const ComparedPoint& point = comparison.points[at];
        const double larger = std::max(point.u, point.reference_u);
        const double factor = differences.of_method[at].U / point.u;
        const double of_reference = differences.of_reference[at].U / point.reference_u;
        return std::isinf(point.nu.value_or(k_infinity)) && std::isinf(point.reference_nu.value_or(k_infinity)) &&
               std::min(point.u, point.reference_u) < k_clearly_smaller * larger &&
               std::abs(factor - of_reference) < k_equal_factors * of_reference;
    };
    return is_diagonal(comparison.covariance) && is_diagonal(comparison.reference_covariance) &&
           std::all_of(points.begin(), points.end(), is_judged);
}

/// What both methods share if it is `common` of the variance of each point: an effect of each point apart, or, where the
/// points of a side share too much for that, one of all points. None where it can be neither.
std::optional<Eigen::MatrixXd> shared_covariance(const MethodComparison& comparison, const std::vector<Index>& points,
                                                 const Eigen::VectorXd& common) {
    const Eigen::VectorXd root = common.cwiseSqrt();
    for (const Eigen::MatrixXd& covariance :
         {Eigen::MatrixXd(common.asDiagonal()), Eigen::MatrixXd(root * root.transpose())}) {
        if (is_possible_covariance(comparison.covariance(points, points),
                                   comparison.reference_covariance(points, points), covariance(points, points))) {
            return covariance;
        }
    }
    return std::nullopt;
}

/// The verdict where it is not known what both methods share: one that none, half or the whole of the smaller uncertainty
/// objects to, as far as both can share it. What a right U is confirmed with, and what refutes a wrong one, is the least
/// of all.
/// \param row    of no correlation
/// \param worst  largest |E_n| for the worst plausible correlation, where it must not be above 1
AgreementVerdict verdict_for_any_correlation(const MethodComparison& comparison, const MethodSummary& row,
                                             double probability, const std::optional<BiasTest>& test, bool has_line,
                                             std::optional<double> worst, Agreement& agreement_of_row) {
    const AgreementVerdict without = agreement_verdict(agreement_of_row, worst, test);
    if (without <= AgreementVerdict::correlation_unknown) {
        return without;
    }
    const bool has_equal = std::any_of(row.points.begin(), row.points.end(), [&](Index i) {
        const ComparedPoint& point = comparison.points[static_cast<std::size_t>(i)];
        return std::min(point.u, point.reference_u) >= k_clearly_smaller * std::max(point.u, point.reference_u);
    });
    for (const double share : {0.5, 1.0}) {
        if (share == 1.0 && has_equal) {
            break;  // nothing would be left of the uncertainty of a difference that is 0
        }
        MethodComparison shared = comparison;
        shared.correlation_unknown = false;
        // Of other directions nothing is asked here: where both uncertainties are equal, the whole of it would leave none.
        Eigen::VectorXd common = Eigen::VectorXd::Zero(static_cast<Index>(comparison.points.size()));
        for (const Index i : row.points) {
            const ComparedPoint& point = comparison.points[static_cast<std::size_t>(i)];
            const double smaller = std::min(point.u, point.reference_u);
            common(i) = share * smaller * smaller;
        }
        const std::optional<Eigen::MatrixXd> covariance = shared_covariance(comparison, row.points, common);
        if (!covariance) {
            continue;
        }
        shared.cross_covariance = *covariance;
        const MethodDifferences chosen = selected(differences_of(shared).all, row.points);
        const Agreement judged = agreement(chosen, probability, agreement_of_row.family);
        const std::optional<MethodBias> bias = has_line ? bias_of(shared, chosen, row.points) : std::nullopt;
        if (agreement_verdict(judged, std::nullopt, bias ? bias->test : std::nullopt) <
            AgreementVerdict::correlation_unknown) {
            return AgreementVerdict::correlation_unknown;
        }
        agreement_of_row.power_to_confirm = std::min(agreement_of_row.power_to_confirm, judged.power_to_confirm);
        agreement_of_row.p_if_too_small = std::max(agreement_of_row.p_if_too_small, judged.p_if_too_small);
        agreement_of_row.p_if_too_large = std::max(agreement_of_row.p_if_too_large, judged.p_if_too_large);
    }
    return agreement_verdict(agreement_of_row, worst, test);
}

/// What a comparison with these findings corrected is judged to be.
void add_corrected_verdicts(const MethodComparison& comparison, MethodResult& result) {
    const MethodComparison better = corrected(comparison);
    const Differences differences = differences_of(better);
    for (MethodSummary& row : result.summaries) {
        const MethodDifferences chosen = selected(differences.all, row.points);
        std::optional<double> worst;
        for (const Index i : row.points) {
            if (comparison.correlation_unknown) {
                const auto at = static_cast<std::size_t>(i);
                worst = std::max(worst.value_or(0.0),
                                 std::abs(worst_en(differences.method[at], differences.reference[at])));
            }
        }
        std::optional<BiasTest> test;
        if (has_bias_line(row, result)) {
            const std::optional<MethodBias> bias = bias_of(better, chosen, row.points);
            test = bias ? bias->test : std::nullopt;
        }
        Agreement judged = agreement(chosen, result.score_probability, family_of(row, result));
        const bool by_chance = worst && can_be_judged_for_any_correlation(better, differences, row.points);
        row.verdict_audited =
            worst ? verdict_for_any_correlation(better, row, result.score_probability, test, has_bias_line(row, result),
                                                by_chance ? std::nullopt : worst, judged)
                  : agreement_verdict(judged, std::nullopt, test);
    }
}

}  // namespace

MethodResult compare_methods(const MethodComparison& comparison) {
    require_sizes(comparison);
    const Differences differences = differences_of(comparison);
    const double p = en_coverage_probability(comparison.coverage_probability);
    MethodResult result{.score_probability = p, .scores = {}, .summaries = rows_of(comparison)};
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        result.scores.push_back(score_at(comparison, differences, i));
    }
    for (MethodSummary& row : result.summaries) {
        const MethodDifferences chosen = selected(differences.all, row.points);
        row.agreement = agreement(chosen, p, family_of(row, result));
        row.worst = variant_of(result.scores, row.points, &MethodScore::en_worst);
        row.audited = variant_of(result.scores, row.points, &MethodScore::en_audited);
        if (has_bias_line(row, result)) {
            row.bias = bias_of(comparison, chosen, row.points);
        }
        row.slope_of_noise = slope_of_noise(comparison, row.points);
        const std::optional<BiasTest> test = row.bias ? row.bias->test : std::nullopt;
        row.for_any_correlation = row.worst && can_be_judged_for_any_correlation(comparison, differences, row.points);
        row.verdict = row.worst ? verdict_for_any_correlation(
                                      comparison, row, p, test, has_bias_line(row, result),
                                      row.for_any_correlation ? std::nullopt : largest_of(row.worst), row.agreement)
                                : agreement_verdict(row.agreement, std::nullopt, test);
    }
    if (comparison.is_audited()) {
        add_corrected_verdicts(comparison, result);
    }
    return result;
}

}  // namespace gumcert::gum
