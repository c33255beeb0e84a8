#include "reports/record/make/comparison/method_record.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "gum/rounding.h"
#include "reports/record/make/comparison/comparison_print.h"
#include "reports/record/make/comparison/method_remarks.h"

namespace gumcert::reports {

namespace {

using reports::ComparisonPoint;
using reports::ComparisonSummary;

constexpr int k_digits_of_U = 2;
constexpr int k_digits_of_ratio = 3;             // so that 0.996 does not print as 1.0
constexpr int k_decimals_of_points = 1;          // of the number of independent points
constexpr double k_resolution_of_centre = 0.01;  // of the span of the positions, to two digits

/// Value and U to the same decimal place; all digits of the value where U is 0.
gum::RoundedPair printed_pair(double value, double U) {
    if (U > 0.0) {
        return gum::round_to_uncertainty(value, U, k_digits_of_U);
    }
    return {printed_as_stated(value), "0"};
}

std::optional<double> finite(const std::optional<double>& number) {
    return number && std::isfinite(*number) ? number : std::nullopt;
}

bool calls_for_action(const std::optional<double>& en) {
    return en && gum::signal_of_en(*en) == gum::Signal::action;
}

/// Value and U to the same decimal place.
void put_pair(double value, double U, reports::Shown<double>& shown_value,
              reports::Shown<std::optional<double>>& shown_U) {
    const gum::RoundedPair pair = printed_pair(value, U);
    shown_value = {value, pair.value};
    shown_U = {U, pair.U};
}

ComparisonPoint point_record(const gum::ComparedPoint& from, const gum::MethodScore& score) {
    ComparisonPoint point;
    point.name = from.name;
    point.direction = from.direction;
    point.angle_deg = from.angle_deg;
    point.position = from.position;
    point.printed_angle = printed_as_stated(from.angle_deg ? from.angle_deg : from.position);
    put_pair(from.value, from.U, point.value, point.U);
    point.u = from.u;
    point.k = shown(from.k, printed_score);
    point.nu = from.nu;
    put_pair(from.reference_value, from.reference_U, point.reference_value, point.reference_U);
    point.reference_u = from.reference_u;
    point.coverage_probability = from.p;
    point.reference_coverage_probability = from.reference_p;
    point.reference_k = from.reference_k;
    if (score.of_scores) {
        point.U_of_scores = shown(score.of_scores->U, printed_uncertainty);
        point.k_of_scores = shown(score.of_scores->k, printed_score);
    }
    if (score.reference_of_scores) {
        point.reference_U_of_scores = score.reference_of_scores->U;
    }
    point.correlation = score.correlation;
    put_pair(score.difference, score.U_difference, point.D, point.U_D);
    point.u_D = score.u_difference;
    point.En = shown(score.en, printed_en);
    point.zeta = shown(score.zeta, printed_z);
    point.En_worst = shown_worst_en(score.en_worst);
    point.En_audited = shown(score.en_audited, printed_en);
    point.signal = calls_for_action(score.en) || calls_for_action(score.en_audited) ? "action" : "none";
    if (calls_for_action(score.en)) {
        point.signal_by.emplace_back("En");
    }
    if (calls_for_action(score.en_audited)) {
        point.signal_by.emplace_back("En_audited");
    }
    return point;
}

// ---- summary of a direction -----------------------------------------------------------------------------------------

const char* word_of(gum::AgreementVerdict verdict) {
    switch (verdict) {
        case gum::AgreementVerdict::disagreement:
            return "disagreement";
        case gum::AgreementVerdict::points_above_1:
            return "points_above_1";
        case gum::AgreementVerdict::joint_test_open:
            return "joint_test_open";
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

std::string printed_points(const std::optional<double>& points) {
    return gum::round_to_quantum(*points, k_decimals_of_points);
}

std::string printed_ratio(const std::optional<double>& ratio) {
    return ratio ? gum::round_significant(*ratio, k_digits_of_ratio) : "";
}

std::string printed_power(const std::optional<double>& power) {
    return power ? gum::percent(*power) + " %" : "";
}

void add_method_agreement(const gum::Agreement& agreement, ComparisonSummary& row) {
    row.points = static_cast<std::int64_t>(agreement.points);
    row.count_above_1 = static_cast<std::int64_t>(agreement.count_above_1);
    row.mean_abs_En = shown(agreement.mean_absolute_en, printed_score);
    row.max_abs_En = shown(agreement.largest_absolute_en, printed_en);
    row.rms_En = shown(agreement.rms_en, printed_score);
    row.rms_En_low = shown(agreement.rms_en_low, printed_score);
    row.rms_En_high = shown(agreement.rms_en_high, printed_score);
    const auto beside = [&](double chance) {
        return [&agreement, chance](double p) -> Shown<std::optional<double>> {
            return {p, printed_probability_in_family(p, chance, agreement.family)};
        };
    };
    const auto of_size = beside(gum::k_chance_of_size), of_pattern = beside(gum::k_chance_of_bias_and_pattern);
    row.p_low = of_size(agreement.p_low);
    row.p_high = of_size(agreement.p_high);
    if (agreement.is_bounded) {
        row.p_low_least = of_size(agreement.p_low_least);
        row.p_high_least = of_size(agreement.p_high_least);
        row.p_mahalanobis_least = agreement.p_mahalanobis_least;
    }
    row.D_fail = shown(agreement.d_fail_smallest, printed_uncertainty);
    row.D_fail_largest = shown(agreement.d_fail_largest, printed_uncertainty);
    row.effective_points = shown(agreement.effective_points, printed_points);
    row.p_if_too_small = agreement.p_if_too_small;
    row.p_if_too_large = agreement.p_if_too_large;
    row.power_to_confirm = shown(agreement.power_to_confirm, printed_power);
    row.power_lacks_degrees = agreement.power_lacks_degrees;
    row.count_by_chance = static_cast<std::int64_t>(agreement.count_by_chance);
    row.found_with_80_percent = shown(agreement.found_with_80_percent, printed_uncertainty);
    row.found_with_95_percent = shown(agreement.found_with_95_percent, printed_uncertainty);
    row.mahalanobis_square = agreement.mahalanobis_square;
    row.p_mahalanobis = of_pattern(agreement.p_mahalanobis);
    row.p_pattern = of_pattern(agreement.p_pattern);
    row.vector_En = shown(agreement.vector_en, printed_en);
    row.rank = static_cast<std::int64_t>(agreement.rank);
    row.ratio_reference = shown(finite(agreement.ratio_reference), printed_ratio);
}

reports::BiasLineSummary bias_record(const gum::MethodBias& from, std::size_t family) {
    reports::BiasLineSummary bias;
    bias.against = from.against_position ? "position" : "reference_value";
    const gum::RoundedPair constant = printed_pair(from.line.constant, from.U_constant);
    const gum::RoundedPair slope = printed_pair(from.line.slope, from.U_slope);
    bias.centre = {from.line.centre, printed_pair(from.line.centre, k_resolution_of_centre * from.span).value};
    bias.constant = {from.line.constant, constant.value};
    bias.u_constant = from.line.u_constant;
    bias.U_constant = {from.U_constant, constant.U};
    bias.slope = {from.line.slope, slope.value};
    bias.u_slope = from.line.u_slope;
    bias.U_slope = {from.U_slope, slope.U};
    bias.chi_square = from.line.chi_square;
    bias.p_value = shown(from.line.p_value, printed_probability);
    if (from.test) {
        bias.p_no_bias = {from.test->p,
                          printed_probability_in_family(from.test->p, gum::k_chance_of_bias_and_pattern, family)};
        bias.p_no_bias_least = from.test->p_least;
    }
    return bias;
}

ComparisonSummary summary_record(const gum::MethodSummary& from) {
    ComparisonSummary row;
    row.direction = from.direction;
    add_method_agreement(from.agreement, row);
    if (from.worst) {
        row.count_above_1_worst = static_cast<std::int64_t>(from.worst->count_above_1);
        row.max_abs_En_worst = shown_worst_en(from.worst->largest_absolute_en);
    }
    if (from.audited) {
        row.mean_abs_En_audited = shown(from.audited->mean_absolute_en, printed_score);
        row.max_abs_En_audited = shown(from.audited->largest_absolute_en, printed_en);
        row.count_above_1_audited = static_cast<std::int64_t>(from.audited->count_above_1);
    }
    row.verdict = word_of(from.verdict);
    if (from.verdict == gum::AgreementVerdict::disagreement) {
        row.verdict_by = gum::is_too_large(from.agreement)         ? "size"
                         : gum::is_refuted_pattern(from.agreement) ? "pattern"
                                                                   : "bias";
    }
    if (from.verdict_audited) {
        row.verdict_audited = word_of(*from.verdict_audited);
        // The verdicts are in the order of the objections. A method is no better than what it is with its faults
        // corrected.
        if (*from.verdict_audited < from.verdict) {
            row.verdict = "falls_with_finding";
        }
    }
    if (from.bias) {
        row.bias = bias_record(*from.bias, from.agreement.family);
    }
    return row;
}

}  // namespace

void add_method_comparison(const gum::MethodComparison& comparison, const std::string& unit,
                           reports::Comparison& record) {
    const gum::MethodResult result = gum::compare_methods(comparison);
    record.score_probability = result.score_probability;
    record.points.clear();
    record.summary.clear();
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        record.points.push_back(point_record(comparison.points[i], result.scores[i]));
    }
    for (const gum::MethodSummary& row : result.summaries) {
        record.summary.push_back(summary_record(row));
    }
    add_method_remarks(comparison, result, unit, record);
}

}  // namespace gumcert::reports
