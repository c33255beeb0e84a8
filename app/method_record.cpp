#include "app/method_record.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "app/comparison_print.h"
#include "app/method_remarks.h"
#include "gum/rounding.h"

namespace gumcert::app {

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

ComparisonPoint point_record(const gum::ComparedPoint& from, const gum::MethodScore& score) {
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
    if (score.of_scores) {
        point.U_of_scores = score.of_scores->U;
        point.k_of_scores = score.of_scores->k;
    }
    if (score.reference_of_scores) {
        point.reference_U_of_scores = score.reference_of_scores->U;
    }
    point.correlation = score.correlation;
    point.D = score.difference;
    point.u_D = score.u_difference;
    point.U_D = score.U_difference;
    point.En = score.en;
    point.zeta = score.zeta;
    point.En_worst = finite(score.en_worst);
    point.En_audited = score.en_audited;
    point.signal = calls_for_action(score.en) || calls_for_action(score.en_audited) ? "action" : "none";
    if (calls_for_action(score.en)) {
        point.signal_by.emplace_back("En");
    }
    if (calls_for_action(score.en_audited)) {
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

reports::BiasLineSummary bias_record(const gum::MethodBias& from) {
    reports::BiasLineSummary bias;
    bias.against = from.against_position ? "position" : "reference_value";
    bias.centre = from.line.centre;
    bias.constant = from.line.constant;
    bias.u_constant = from.line.u_constant;
    bias.U_constant = from.U_constant;
    bias.slope = from.line.slope;
    bias.u_slope = from.line.u_slope;
    bias.U_slope = from.U_slope;
    bias.chi_square = from.line.chi_square;
    bias.p_value = from.line.p_value;
    const gum::RoundedPair constant = printed_pair(bias.constant, bias.U_constant);
    const gum::RoundedPair slope = printed_pair(bias.slope, bias.U_slope);
    bias.printed.centre = printed_pair(bias.centre, k_resolution_of_centre * from.span).value;
    bias.printed.constant = constant.value;
    bias.printed.U_constant = constant.U;
    bias.printed.slope = slope.value;
    bias.printed.U_slope = slope.U;
    bias.printed.p_value = printed_probability(bias.p_value);
    return bias;
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
}

ComparisonSummary summary_record(const gum::MethodSummary& from) {
    ComparisonSummary row;
    row.direction = from.direction;
    add_agreement(from.agreement, row);
    if (from.worst) {
        row.count_above_1_worst = static_cast<std::int64_t>(from.worst->count_above_1);
        row.max_abs_En_worst = finite(from.worst->largest_absolute_en);
    }
    if (from.audited) {
        row.mean_abs_En_audited = from.audited->mean_absolute_en;
        row.max_abs_En_audited = from.audited->largest_absolute_en;
        row.count_above_1_audited = static_cast<std::int64_t>(from.audited->count_above_1);
    }
    row.verdict = word_of(from.verdict);
    if (from.bias) {
        row.bias = bias_record(*from.bias);
    }
    print(row);
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

}  // namespace gumcert::app
