#include "app/method_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/comparison_print.h"
#include "app/method_remarks.h"
#include "app/record_parts.h"
#include "gum/argument_check.h"
#include "gum/comparison/agreement.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "gum/rounding.h"
#include "text/numbers.h"

namespace gumcert::app {

namespace {

using Eigen::Index;
using reports::ComparisonPoint;
using reports::ComparisonSummary;

constexpr double k_rounding_of_correlation = 1e-9;
constexpr int k_digits_of_U = 2;
constexpr int k_digits_of_ratio = 3;             // so that 0.996 does not print as 1.0
constexpr int k_decimals_of_points = 1;          // of the number of independent points
constexpr double k_resolution_of_centre = 0.01;  // of the span of the positions, to two digits

/// The differences of all points, and what both sides contribute to their uncertainty.
struct Differences {
    gum::MethodDifferences all;
    std::vector<gum::ComparedValue> method, reference;
    std::vector<double> correlation;                          ///< of both values at a point
    std::vector<gum::EnUncertainty> of_method, of_reference;  ///< expanded uncertainties as E_n takes them
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
        gum::refuse("GC-COMPARE-0201", "comparison of methods",
                    std::to_string(m) + " points and a covariance of " + std::to_string(comparison.covariance.rows()) +
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
        gum::refuse(
            "GC-COMPARE-0202", place_of(point, i),
            "the covariance of both methods is " + text::shortest(comparison.cross_covariance(at, at)) +
                ", with standard uncertainties " + text::shortest(point.u) + " and " +
                text::shortest(point.reference_u),
            "a correlation coefficient lies between -1 and 1",
            "State the same uncertainty of a shared source in both budgets, or list it in \"independent_sources\".");
    }
    return std::clamp(r, -1.0, 1.0);
}

Differences differences_of(const MethodComparison& comparison) {
    const auto m = static_cast<Index>(comparison.points.size());
    Differences differences;
    gum::MethodDifferences& all = differences.all;
    all.d.resize(m);
    all.U.resize(m);
    all.U_method.resize(m);
    all.U_reference.resize(m);
    all.covariance = comparison.covariance + comparison.reference_covariance;
    if (comparison.cross_covariance.size() > 0) {
        all.covariance -= comparison.cross_covariance + comparison.cross_covariance.transpose();
    }
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        const ComparedPoint& point = comparison.points[i];
        const auto at = static_cast<Index>(i);
        const double p = comparison.coverage_probability;
        const gum::EnUncertainty of_method =
            gum::en_uncertainty(point.u, point.U, point.k, point.nu.value_or(gum::k_infinity), p);
        const gum::EnUncertainty of_reference = gum::en_uncertainty(
            point.reference_u, point.reference_U, point.reference_k, point.reference_nu.value_or(gum::k_infinity), p);
        differences.of_method.push_back(of_method);
        differences.of_reference.push_back(of_reference);
        differences.method.push_back({point.value, point.u, of_method.U});
        differences.reference.push_back({point.reference_value, point.reference_u, of_reference.U});
        differences.correlation.push_back(correlation_of(comparison, i));
        gum::ComparisonScore score;
        at_place(place_of(point, i), [&] {
            score = gum::score(differences.method.back(), differences.reference.back(), differences.correlation.back());
        });
        // A settled E_n of 1 is one in every number that is computed from the differences.
        const bool at_limit = std::abs(score.en) == 1.0;
        all.d(at) = at_limit ? std::copysign(score.U_difference, score.en) : score.difference;
        all.U(at) = score.U_difference;
        all.U_method(at) = of_method.U;
        all.U_reference(at) = of_reference.U;
        all.covariance(at, at) = score.u_difference * score.u_difference;
    }
    all.method_covariance = comparison.covariance;
    all.reference_covariance = comparison.reference_covariance;
    return differences;
}

/// Value and U to the same decimal place; all digits of the value where U is 0.
gum::RoundedPair printed_pair(double value, double U) {
    if (U > 0.0) {
        return gum::round_to_uncertainty(value, U, k_digits_of_U);
    }
    return {printed_as_stated(value), "0"};
}

/// E_n for the worst plausible correlation; infinite where no finite number bounds it.
double worst_en(const gum::ComparedValue& method, const gum::ComparedValue& reference) {
    const std::optional<double> worst = gum::worst_plausible_en(method, reference);
    const double difference = method.value - reference.value;
    return worst ? *worst : difference == 0.0 ? 0.0 : std::copysign(gum::k_infinity, difference);
}

bool is_audited(const MethodComparison& comparison) {
    return comparison.audited_factor != 1.0 || comparison.reference_audited_factor != 1.0;
}

double audited_en(const MethodComparison& comparison, const Differences& differences, std::size_t i) {
    const auto corrected = [](gum::ComparedValue value, double factor) {
        value.standard_uncertainty *= factor;
        value.expanded_uncertainty *= factor;
        return value;
    };
    return gum::score(corrected(differences.method[i], comparison.audited_factor),
                      corrected(differences.reference[i], comparison.reference_audited_factor),
                      differences.correlation[i])
        .en;
}

ComparisonPoint point_of(const MethodComparison& comparison, const Differences& differences, std::size_t i) {
    const ComparedPoint& from = comparison.points[i];
    const auto at = static_cast<Index>(i);
    ComparisonPoint point;
    point.name = from.name;
    point.direction = from.direction;
    point.angle_deg = from.angle_deg;
    point.position = from.position;
    point.value = from.value;
    point.u = from.u;
    point.U = from.U;
    point.k = from.k;
    point.nu = from.nu;
    point.reference_value = from.reference_value;
    point.reference_u = from.reference_u;
    point.reference_U = from.reference_U;
    point.reference_k = from.reference_k;
    if (differences.of_method[i].converted) {
        point.U_of_scores = differences.of_method[i].U;
        point.k_of_scores = differences.of_method[i].k;
    }
    if (differences.of_reference[i].converted) {
        point.reference_U_of_scores = differences.of_reference[i].U;
    }
    point.correlation = differences.correlation[i];
    point.D = differences.all.d(at);
    point.u_D = std::sqrt(differences.all.covariance(at, at));
    point.U_D = differences.all.U(at);
    point.En = point.D / *point.U_D;
    point.zeta = point.D / *point.u_D;
    point.signal = gum::signal_of_en(*point.En) == gum::Signal::action ? "action" : "none";
    if (comparison.correlation_unknown) {
        const double worst = worst_en(differences.method[i], differences.reference[i]);
        point.En_worst = std::isfinite(worst) ? std::optional(worst) : std::nullopt;
    }
    if (is_audited(comparison)) {
        point.En_audited = audited_en(comparison, differences, i);
    }

    const auto audited_above = [](const std::optional<double>& en) {
        return en && gum::signal_of_en(*en) == gum::Signal::action;
    };
    if (point.signal == "action") {
        point.signal_by.emplace_back("En");
    }
    if (audited_above(point.En_audited)) {
        point.signal = "action";
        point.signal_by.emplace_back("En_audited");
    }

    const gum::RoundedPair value = printed_pair(point.value, from.U);
    const gum::RoundedPair reference = printed_pair(point.reference_value, from.reference_U);
    const gum::RoundedPair difference = printed_pair(point.D, *point.U_D);
    point.printed.angle = printed_as_stated(from.angle_deg ? from.angle_deg : from.position);
    point.printed.value = value.value;
    point.printed.U = value.U;
    point.printed.reference_value = reference.value;
    point.printed.reference_U = reference.U;
    point.printed.D = difference.value;
    point.printed.U_D = difference.U;
    point.printed.k = printed_score(point.k);
    point.printed.U_of_scores = printed_uncertainty(point.U_of_scores);
    point.printed.k_of_scores = printed_score(point.k_of_scores);
    point.printed.En = printed_score(point.En);
    point.printed.zeta = printed_score(point.zeta);
    point.printed.En_worst = printed_score(point.En_worst);
    point.printed.En_audited = printed_score(point.En_audited);
    return point;
}

// ---- summary of a direction -----------------------------------------------------------------------------------------

struct Row {
    std::string direction;
    std::vector<Index> points;
};

/// Directions in the order of the points, then all of them together.
std::vector<Row> rows_of(const MethodComparison& comparison) {
    std::vector<Row> rows;
    Row all{.direction = "all", .points = {}};
    bool has_unnamed = false;
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        const std::string& direction = comparison.points[i].direction;
        all.points.push_back(static_cast<Index>(i));
        if (direction == "all") {
            gum::refuse("GC-COMPARE-0203", place_of(comparison.points[i], i), "the direction is called \"all\"",
                        "\"all\" stands for all directions together", "Give the direction another name.");
        }
        if (direction.empty()) {
            has_unnamed = true;
            continue;
        }
        auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.direction == direction; });
        if (row == rows.end()) {
            rows.push_back({.direction = direction, .points = {}});
            row = std::prev(rows.end());
        }
        row->points.push_back(static_cast<Index>(i));
    }
    if (has_unnamed || rows.size() > 1) {
        rows.push_back(std::move(all));
    }
    return rows;
}

gum::MethodDifferences selected(const gum::MethodDifferences& all, const std::vector<Index>& points) {
    gum::MethodDifferences chosen;
    chosen.d = all.d(points);
    chosen.covariance = all.covariance(points, points);
    chosen.U = all.U(points);
    chosen.U_method = all.U_method(points);
    chosen.U_reference = all.U_reference(points);
    chosen.method_covariance = all.method_covariance(points, points);
    chosen.reference_covariance = all.reference_covariance(points, points);
    return chosen;
}

const char* word_of(gum::AgreementVerdict verdict) {
    switch (verdict) {
        case gum::AgreementVerdict::disagreement:
            return "disagreement";
        case gum::AgreementVerdict::points_above_1:
            return "points_above_1";
        case gum::AgreementVerdict::correlation_unknown:
            return "correlation_unknown";
        case gum::AgreementVerdict::reference_not_better:
            return "reference_not_better";
        case gum::AgreementVerdict::uncertainty_too_large:
            return "uncertainty_too_large";
        case gum::AgreementVerdict::agreement_few_points:
            return "agreement_few_points";
        case gum::AgreementVerdict::uncertainty_not_confirmed:
            return "uncertainty_not_confirmed";
        case gum::AgreementVerdict::agreement_reference_limited:
            return "agreement_reference_limited";
        case gum::AgreementVerdict::validated:
            break;
    }
    return "validated";
}

void add_agreement(const gum::Agreement& agreement, ComparisonSummary& row) {
    row.points = static_cast<std::int64_t>(agreement.points);
    row.count_above_1 = static_cast<std::int64_t>(agreement.count_above_1);
    row.mean_abs_En = agreement.mean_absolute_en;
    row.max_abs_En = agreement.largest_absolute_en;
    row.rms_En = agreement.rms_en;
    row.rms_En_low = agreement.rms_en_low;
    row.rms_En_high = agreement.rms_en_high;
    row.p_low = agreement.p_low;
    row.p_high = agreement.p_high;
    row.D_fail = agreement.d_fail_smallest;
    row.D_fail_largest = agreement.d_fail_largest;
    row.effective_points = agreement.effective_points;
    row.p_if_too_small = agreement.p_if_too_small;
    row.p_if_too_large = agreement.p_if_too_large;
    row.power_to_confirm = agreement.power_to_confirm;
    row.count_by_chance = static_cast<std::int64_t>(agreement.count_by_chance);
    row.found_with_80_percent = agreement.found_with_80_percent;
    row.found_with_95_percent = agreement.found_with_95_percent;
    row.mahalanobis_square = agreement.mahalanobis_square;
    row.p_mahalanobis = agreement.p_mahalanobis;
    row.vector_En = agreement.vector_en;
    row.rank = static_cast<std::int64_t>(agreement.rank);
    if (std::isfinite(agreement.ratio_reference)) {
        row.ratio_reference = agreement.ratio_reference;
    }
}

/// The largest |E_n| for the worst plausible correlation, infinite where nothing bounds it; nothing where r is known.
std::optional<double> add_worst(const MethodComparison& comparison, const Differences& differences, const Row& of,
                                ComparisonSummary& row) {
    if (!comparison.correlation_unknown) {
        return std::nullopt;
    }
    double largest = 0.0;
    std::int64_t above = 0;
    for (const Index i : of.points) {
        const auto at = static_cast<std::size_t>(i);
        const double worst = std::abs(worst_en(differences.method[at], differences.reference[at]));
        largest = std::max(largest, worst);
        above += worst > 1.0 ? 1 : 0;
    }
    row.count_above_1_worst = above;
    if (std::isfinite(largest)) {
        row.max_abs_En_worst = largest;
    }
    return largest;
}

void add_audited(const reports::Comparison& record, const Row& of, ComparisonSummary& row) {
    double sum = 0.0;
    double largest = 0.0;
    std::int64_t above = 0;
    for (const Index i : of.points) {
        const double en = std::abs(*record.points[static_cast<std::size_t>(i)].En_audited);
        sum += en;
        largest = std::max(largest, en);
        above += en > 1.0 ? 1 : 0;
    }
    row.mean_abs_En_audited = sum / static_cast<double>(of.points.size());
    row.max_abs_En_audited = largest;
    row.count_above_1_audited = above;
}

/// The differences as a line is fitted to them. Where the mean was taken off, their covariance is singular in its
/// direction: a variance there, as large as that of a point, leaves the slope as it is and makes the constant 0.
gum::MethodDifferences for_bias_line(const MethodComparison& comparison, gum::MethodDifferences differences) {
    if (comparison.mean_taken_off) {
        const auto n = static_cast<double>(differences.covariance.rows());
        differences.covariance.array() += differences.covariance.trace() / (n * n);
    }
    return differences;
}

std::optional<reports::BiasLineSummary> bias_of(const MethodComparison& comparison,
                                                const gum::MethodDifferences& differences, const Row& of) {
    Eigen::VectorXd t(differences.d.size());
    for (std::size_t i = 0; i < of.points.size(); ++i) {
        const ComparedPoint& point = comparison.points[static_cast<std::size_t>(of.points[i])];
        if (comparison.bias_against_position && !point.position) {
            return std::nullopt;
        }
        t(static_cast<Index>(i)) = comparison.bias_against_position ? *point.position : point.reference_value;
    }
    const std::optional<gum::BiasLine> line = gum::bias_line(for_bias_line(comparison, differences), t);
    if (!line) {
        return std::nullopt;
    }
    const double k = gum::coverage_factor(comparison.coverage_probability, gum::k_infinity);
    reports::BiasLineSummary bias;
    bias.against = comparison.bias_against_position ? "position" : "reference_value";
    bias.centre = line->centre;
    bias.constant = line->constant;
    bias.u_constant = line->u_constant;
    bias.U_constant = k * line->u_constant;
    bias.slope = line->slope;
    bias.u_slope = line->u_slope;
    bias.U_slope = k * line->u_slope;
    bias.chi_square = line->chi_square;
    bias.p_value = line->p_value;
    const gum::RoundedPair constant = printed_pair(bias.constant, bias.U_constant);
    const gum::RoundedPair slope = printed_pair(bias.slope, bias.U_slope);
    bias.printed.centre = printed_pair(bias.centre, k_resolution_of_centre * (t.maxCoeff() - t.minCoeff())).value;
    bias.printed.constant = constant.value;
    bias.printed.U_constant = constant.U;
    bias.printed.slope = slope.value;
    bias.printed.U_slope = slope.U;
    bias.printed.p_value = printed_probability(bias.p_value);
    return bias;
}

/// Slope of the bias line that the uncertainty of the reference values alone makes: their errors stand in t, and with
/// the other sign in D. Expected value of Σ (t − t̄)(D − D̄) from the covariance of both, over Σ (t − t̄)²; what all
/// points share moves t̄ and turns nothing. To first order, for equal weights.
double slope_of_noise(const MethodComparison& comparison, const Row& of) {
    if (comparison.bias_against_position || of.points.empty()) {
        return 0.0;
    }
    const auto n = static_cast<double>(of.points.size());
    Eigen::VectorXd t(static_cast<Index>(of.points.size()));
    for (std::size_t i = 0; i < of.points.size(); ++i) {
        t(static_cast<Index>(i)) = comparison.points[static_cast<std::size_t>(of.points[i])].reference_value;
    }
    Eigen::MatrixXd covariance = -comparison.reference_covariance(of.points, of.points);
    if (comparison.cross_covariance.size() > 0) {
        covariance += comparison.cross_covariance(of.points, of.points);
    }
    const double spread = (t.array() - t.mean()).square().sum();
    return spread > 0.0 ? (covariance.trace() - covariance.sum() / n) / spread : 0.0;
}

void print(ComparisonSummary& row) {
    row.printed.mean_abs_En = printed_score(row.mean_abs_En);
    row.printed.max_abs_En = printed_score(row.max_abs_En);
    row.printed.rms_En = printed_score(row.rms_En);
    row.printed.rms_En_low = printed_score(row.rms_En_low);
    row.printed.rms_En_high = printed_score(row.rms_En_high);
    row.printed.p_low = printed_probability(row.p_low);
    row.printed.p_high = printed_probability(row.p_high);
    row.printed.D_fail = printed_uncertainty(row.D_fail);
    row.printed.D_fail_largest = printed_uncertainty(row.D_fail_largest);
    row.printed.found_with_80_percent = printed_uncertainty(row.found_with_80_percent);
    row.printed.found_with_95_percent = printed_uncertainty(row.found_with_95_percent);
    row.printed.power_to_confirm = row.power_to_confirm ? gum::percent(*row.power_to_confirm) + " %" : "";
    row.printed.effective_points = gum::round_to_quantum(*row.effective_points, k_decimals_of_points);
    row.printed.p_mahalanobis = printed_probability(row.p_mahalanobis);
    row.printed.vector_En = printed_score(row.vector_En);
    row.printed.ratio_reference =
        row.ratio_reference ? gum::round_significant(*row.ratio_reference, k_digits_of_ratio) : "";
    row.printed.max_abs_En_worst = printed_score(row.max_abs_En_worst);
    row.printed.mean_abs_En_audited = printed_score(row.mean_abs_En_audited);
    row.printed.max_abs_En_audited = printed_score(row.max_abs_En_audited);
    row.printed.published_mean_abs_En = printed_as_stated(row.published_mean_abs_En);
}

}  // namespace

void compare_methods(reports::Comparison& record, const MethodComparison& comparison) {
    require_sizes(comparison);
    const Differences differences = differences_of(comparison);
    const std::vector<Row> rows = rows_of(comparison);
    record.score_probability = gum::en_coverage_probability(comparison.coverage_probability);
    record.points.clear();
    record.summary.clear();
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        record.points.push_back(point_of(comparison, differences, i));
    }
    MethodFindings findings{.unit = comparison.printed_unit, .correlation_unknown = comparison.correlation_unknown};
    for (const Row& of : rows) {
        const gum::MethodDifferences chosen = selected(differences.all, of.points);
        const gum::Agreement agreement =
            gum::agreement(chosen, gum::en_coverage_probability(comparison.coverage_probability));
        ComparisonSummary row;
        row.direction = of.direction;
        add_agreement(agreement, row);
        const std::optional<double> worst = add_worst(comparison, differences, of, row);
        if (is_audited(comparison)) {
            add_audited(record, of, row);
        }
        const auto published = comparison.published_mean_abs_En.find(of.direction);
        if (published != comparison.published_mean_abs_En.end()) {
            row.published_mean_abs_En = published->second;
        }
        row.verdict = word_of(gum::agreement_verdict(agreement, worst));
        if (of.direction != "all" || rows.size() == 1) {  // directions of their own have no line in common
            row.bias = bias_of(comparison, chosen, of);
        }
        print(row);
        record.summary.push_back(std::move(row));
        findings.largest_en_by_chance.push_back(agreement.largest_en_by_chance);
        findings.slope_of_noise.push_back(slope_of_noise(comparison, of));
        findings.beyond_covariance.push_back(agreement.beyond_covariance);
        findings.worst_has_no_bound.push_back(worst && !std::isfinite(*worst));
    }
    add_method_remarks(findings, record);
}

}  // namespace gumcert::app
