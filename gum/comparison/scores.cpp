#include "gum/comparison/scores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "gum/argument_check.h"
#include "gum/coverage.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

constexpr double k_warning_limit_of_z = 2.0;
constexpr double k_action_limit_of_z = 3.0;

double difference_of(double value, double reference, double reference_rest = 0.0) {
    require_finite(value, "laboratory value");
    require_finite(reference, "reference value");
    const double difference = (value - reference) - reference_rest;
    require_finite(difference, "difference of laboratory and reference value");
    return difference;
}

double difference_uncertainty_for_score(double combined, double laboratory, double reference, double correlation,
                                        const char* symbol) {
    // U of a difference that is 0 says that both values are the same quantity with all of its uncertainty in common:
    // then no difference is explained by chance, and no score exists.
    if (!(combined > 0.0) || !std::isfinite(combined)) {
        refuse("GC-GUM-0031", std::string(symbol) + " of the difference",
               text::shortest(combined) + " from laboratory " + text::shortest(laboratory) + " and reference " +
                   text::shortest(reference) + " with correlation " + text::shortest(correlation),
               "a score divides by it, so it must be greater than 0",
               laboratory > 0.0 && reference > 0.0
                   ? "State a smaller correlation: with this one both values have all of their uncertainty in common."
                   : "State the uncertainty of at least one side.");
    }
    return combined;
}

}  // namespace

double uncertainty_of_difference(double laboratory, double reference, double correlation) {
    require_not_negative(laboratory, "uncertainty of the laboratory value");
    require_not_negative(reference, "uncertainty of the reference value");
    if (!(correlation >= -1.0 && correlation <= 1.0)) {
        refuse("GC-GUM-0030", "correlation of laboratory and reference", text::shortest(correlation),
               "must lie between -1 and 1", "Correct the correlation coefficient.");
    }
    // Squares of numbers below 1e-154 vanish, and 0 would say that both are one.
    constexpr double k_least = 1e-150;
    const double larger = std::max(laboratory, reference);
    if (larger > 0.0 && larger < k_least) {
        return larger * uncertainty_of_difference(laboratory / larger, reference / larger, correlation);
    }
    if (correlation == 0.0) {
        return std::sqrt(laboratory * laboratory + reference * reference);
    }
    // u_x² + u_X² − 2 r u_x u_X, written so that nothing cancels when r is close to 1 and the two are nearly equal.
    const double gap = laboratory - reference;
    return std::sqrt(gap * gap + 2.0 * (1.0 - correlation) * laboratory * reference);
}

bool have_different_factors(const ComparedValue& first, const ComparedValue& second) {
    const double of_first = first.expanded_uncertainty * second.standard_uncertainty;
    const double of_second = second.expanded_uncertainty * first.standard_uncertainty;
    return std::max(of_first, of_second) > (1.0 + k_same_coverage_factor) * std::min(of_first, of_second);
}

double expanded_uncertainty_of_difference(const ComparedValue& laboratory, const ComparedValue& reference,
                                          double correlation) {
    const double by_both =
        uncertainty_of_difference(laboratory.expanded_uncertainty, reference.expanded_uncertainty, correlation);
    if (correlation == 0.0 || !(laboratory.standard_uncertainty > 0.0) || !(reference.standard_uncertainty > 0.0) ||
        !have_different_factors(laboratory, reference)) {
        return by_both;
    }
    const double u =
        uncertainty_of_difference(laboratory.standard_uncertainty, reference.standard_uncertainty, correlation);
    return u * (std::hypot(laboratory.expanded_uncertainty, reference.expanded_uncertainty) /
                std::hypot(laboratory.standard_uncertainty, reference.standard_uncertainty));
}

double settled_score(double value, double reference, double scale, double reference_rest) {
    constexpr double k_most_settled = 1e-6;  // values that are stated too coarsely for more are not helped
    constexpr double k_roundings = 8.0;      // of the two values, their difference, the scale and the quotient
    const double difference = difference_of(value, reference, reference_rest);
    require_positive(scale, "scale of a score");
    const double score = difference / scale;
    // The stated decimal numbers are meant: a score that misses a limit by what binary numbers lose is on the limit.
    const double rounding =
        std::min(k_most_settled, k_roundings * std::numeric_limits<double>::epsilon() *
                                     (std::abs(score) + (std::abs(value) + std::abs(reference)) / scale));
    for (const double limit : {1.0, 2.0, 3.0}) {
        if (std::abs(std::abs(score) - limit) <= rounding) {
            return std::copysign(limit, score);
        }
    }
    return score;
}

ComparisonScore score(const ComparedValue& laboratory, const ComparedValue& reference, double correlation) {
    static_cast<void>(difference_of(laboratory.value, reference.value));  // a fault of the values is reported first
    const double u = difference_uncertainty_for_score(
        uncertainty_of_difference(laboratory.standard_uncertainty, reference.standard_uncertainty, correlation),
        laboratory.standard_uncertainty, reference.standard_uncertainty, correlation, "u");
    const double U = difference_uncertainty_for_score(
        expanded_uncertainty_of_difference(laboratory, reference, correlation), laboratory.expanded_uncertainty,
        reference.expanded_uncertainty, correlation, "U");
    return *score_of_difference(laboratory.value, reference.value, u, U);
}

std::optional<ComparisonScore> score_of_difference(double value, double reference, double u_difference,
                                                   double U_difference, double reference_rest) {
    const double difference = difference_of(value, reference, reference_rest);
    if (!(u_difference > 0.0) || !(U_difference > 0.0)) {
        return std::nullopt;
    }
    return ComparisonScore{.difference = difference,
                           .u_difference = u_difference,
                           .U_difference = U_difference,
                           .en = settled_score(value, reference, U_difference, reference_rest),
                           .zeta = settled_score(value, reference, u_difference, reference_rest)};
}

std::optional<double> worst_plausible_en(const ComparedValue& laboratory, const ComparedValue& reference) {
    static_cast<void>(score(laboratory, reference));  // refuses what is no comparison
    const double larger = std::max(laboratory.expanded_uncertainty, reference.expanded_uncertainty);
    const double smaller = std::min(laboratory.expanded_uncertainty, reference.expanded_uncertainty);
    if (larger == smaller) {
        return std::nullopt;
    }
    // With r = smaller/larger: larger² + smaller² − 2 smaller², written so that nothing cancels.
    return settled_score(laboratory.value, reference.value, std::sqrt(larger - smaller) * std::sqrt(larger + smaller));
}

double z_score(double value, double assigned_value, double sigma_pt, double assigned_rest) {
    return z_prime_score(value, assigned_value, sigma_pt, 0.0, assigned_rest);
}

double z_prime_score(double value, double assigned_value, double sigma_pt, double u_assigned_value,
                     double assigned_rest) {
    require_positive(sigma_pt, "standard deviation for proficiency assessment");
    require_not_negative(u_assigned_value, "uncertainty of the assigned value");
    return settled_score(value, assigned_value, std::hypot(sigma_pt, u_assigned_value), assigned_rest);
}

std::optional<double> percent_difference(double value, double assigned_value, double assigned_rest) {
    const double difference = difference_of(value, assigned_value, assigned_rest);
    if (assigned_value == 0.0) {
        return std::nullopt;
    }
    return 100.0 * difference / std::abs(assigned_value);
}

double percent_of_allowed(double value, double assigned_value, double largest_allowed, double assigned_rest) {
    require_positive(largest_allowed, "largest error allowed");
    return 100.0 * settled_score(value, assigned_value, largest_allowed, assigned_rest);
}

double normal_score(double t, double degrees_of_freedom) {
    require_finite(t, "score");
    if (std::isinf(degrees_of_freedom)) {
        return t;
    }
    constexpr double k_least_tail = 1e-300;
    const double tail = std::clamp(two_sided_tail_of_t(std::abs(t), degrees_of_freedom), k_least_tail, 1.0);
    return tail < 1.0 ? std::copysign(two_sided_normal_critical_value(tail), t) : 0.0;
}

Signal signal_of_z(double score) {
    require_finite(score, "score");
    // 2.0 is still acceptable and 3.0 is not: that the limits are on different sides is meant.
    if (std::abs(score) >= k_action_limit_of_z) {
        return Signal::action;
    }
    return std::abs(score) > k_warning_limit_of_z ? Signal::warning : Signal::none;
}

EnUncertainty en_uncertainty(double u, double U, double k, double degrees_of_freedom, double coverage_probability) {
    require_not_negative(u, "standard uncertainty");
    require_not_negative(U, "expanded uncertainty");
    require_positive(k, "coverage factor");
    const double wanted = coverage_factor(en_coverage_probability(coverage_probability), degrees_of_freedom);
    // E_n compares intervals of one probability: a U with another k is taken back to u and multiplied anew.
    if (std::abs(k / wanted - 1.0) <= k_same_coverage_factor) {
        return {.U = U, .k = k, .converted = false};
    }
    return {.U = wanted * u, .k = wanted, .converted = true};
}

double en_coverage_probability(double coverage_probability) {
    constexpr double k_least = 0.94;
    constexpr double k_most = 0.96;
    constexpr double k_usual = 0.9545;
    require_probability(coverage_probability, "coverage probability");
    return coverage_probability >= k_least && coverage_probability <= k_most ? coverage_probability : k_usual;
}

Signal signal_of_en(double score) {
    require_finite(score, "E_n");
    return std::abs(score) > 1.0 ? Signal::action : Signal::none;
}

ComparisonSummary summarise(std::span<const ComparisonScore> scores) {
    if (scores.empty()) {
        refuse("GC-GUM-0032", "comparison", "no points", "a summary needs at least 1 point",
               "Give the points that both sides measured.");
    }
    ComparisonSummary summary;
    summary.points = scores.size();
    double sum_of_absolute_en = 0.0;
    double sum_of_squared_en = 0.0;
    for (const ComparisonScore& point : scores) {
        require_finite(point.en, "E_n");
        require_finite(point.zeta, "zeta");
        const double absolute_en = std::abs(point.en);
        sum_of_absolute_en += absolute_en;
        sum_of_squared_en += point.en * point.en;
        summary.sum_of_squared_zeta += point.zeta * point.zeta;
        summary.largest_absolute_en = std::max(summary.largest_absolute_en, absolute_en);
        summary.count_above_1 += absolute_en > 1.0 ? 1 : 0;
    }
    const auto m = static_cast<double>(summary.points);
    summary.mean_absolute_en = sum_of_absolute_en / m;
    summary.rms_en = std::sqrt(sum_of_squared_en / m);
    // Both tails: a sum that is too small tells of overstated uncertainties, or of points that are correlated.
    summary.p_low = chi_square_lower_tail(summary.sum_of_squared_zeta, m);
    summary.p_high = chi_square_upper_tail(summary.sum_of_squared_zeta, m);
    return summary;
}

}  // namespace gumcert::gum
