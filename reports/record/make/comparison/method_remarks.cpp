#include "reports/record/make/comparison/method_remarks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/make/comparison/comparison_print.h"
#include "text/lists.h"

namespace gumcert::reports {

namespace {

using reports::Comparison;
using reports::ComparisonSummary;

constexpr double k_all = 1.0 - 1e-9;
constexpr double k_nearly_all = 0.95;  // of the points count as independent
constexpr double k_negligible_reference = 1.0 / 3.0;
constexpr double k_visible_slope = 0.1;    // of U of the slope
constexpr double k_visible_beyond = 0.05;  // of a standard uncertainty, a point

/// The sentences of one comparison.
class Remarks {
public:
    Remarks(const gum::MethodComparison& comparison, const gum::MethodResult& result, const std::string& unit,
            Comparison& record)
        : comparison_(comparison), result_(result), record_(record) {
        const std::string for_people = gum::unit_for_people(gum::unit_of_difference(unit));
        unit_ = for_people.empty() ? "" : " " + for_people;
    }

    void add() {
        number_of_points();
        directions();
        single_points();
        unknown_correlation();
        reference_uncertainty();
        too_small_differences();
        too_large_differences();
        joint_distribution();
        pattern();
        singular_covariance();
        failing_differences();
        test_of_uncertainty();
        coverage_factors();
        bias_lines();
        audit();
    }

private:
    using Holds = std::function<bool(const gum::Agreement&)>;

    void say(const std::string& sentence) { record_.remarks.push_back(sentence); }

    [[nodiscard]] const gum::MethodSummary& whole() const { return result_.summaries.back(); }
    /// Its texts.
    [[nodiscard]] const ComparisonSummary& printed_whole() const { return record_.summary.back(); }

    [[nodiscard]] std::string count_of_points() const {
        return text::count_of(static_cast<std::int64_t>(whole().agreement.points), "point");
    }

    /// "" where there is one row only.
    [[nodiscard]] std::string direction_of(const gum::MethodSummary& row) const {
        if (result_.summaries.size() == 1) {
            return "";
        }
        return row.direction == "all" ? " of all directions together" : " of the direction " + row.direction;
    }

    /// One clause for every row that it holds for, one after the other; "" where it holds for none.
    [[nodiscard]] std::string clauses(const Holds& holds,
                                      const std::function<std::string(const ComparisonSummary&)>& number) const {
        std::string text;
        for (std::size_t i = 0; i < result_.summaries.size(); ++i) {
            const gum::MethodSummary& row = result_.summaries[i];
            if (holds(row.agreement)) {
                text += (text.empty() ? "" : ", ") + number(record_.summary[i]) + direction_of(row);
            }
        }
        return text;
    }

    void number_of_points() {
        const gum::Agreement& row = whole().agreement;
        if (row.points < 2) {
            return;
        }
        const std::string points = count_of_points();
        if (row.effective_points < k_nearly_all * static_cast<double>(row.points)) {
            say("The " + points + " are not as many independent proofs: they share effects of their set-up, and by " +
                "their covariance they tell as much as about " + printed_whole().effective_points.text +
                " independent points. The band of the rms Eₙ, p_low and p_high take the covariance into account.");
        } else {
            say("The covariances say that the " + points + " are independent of each other, or nearly so. Effects of " +
                "a common set-up that are not in the covariances would make them fewer.");
        }
    }

    /// The limit of a p in the family of its row.
    [[nodiscard]] static double limit_of(double chance, const gum::Agreement& row) {
        return gum::chance_in_family(chance, row.family);
    }

    /// What a direction is held against, one of several.
    void directions() {
        const gum::Agreement& row = result_.summaries.front().agreement;
        if (row.family > 1) {
            say("Of " + std::to_string(row.family) +
                " directions the gravest verdict counts. Each is held against limits that right uncertainties of all "
                "directions miss as rarely as those of one: p_low and p_high of a direction against " +
                printed_limit_in_family(gum::k_chance_of_size, row.family) +
                ", p of its bias and of its pattern against " +
                printed_limit_in_family(gum::k_chance_of_bias_and_pattern, row.family) + ".");
        }
    }

    /// How large the largest of several |E_n| becomes by chance.
    void single_points() {
        std::string text;
        for (std::size_t i = 0; i < result_.summaries.size(); ++i) {
            const gum::Agreement& row = result_.summaries[i].agreement;
            if (row.count_above_1 > 0 && row.points > 1) {
                text += (text.empty() ? "" : "; ") + record_.summary[i].max_abs_En.text + " against a limit of " +
                        printed_score(row.largest_en_by_chance) + " for " +
                        text::count_of(static_cast<std::int64_t>(row.points), "point") +
                        direction_of(result_.summaries[i]);
            }
        }
        if (!text.empty()) {
            say("The largest of several |Eₙ| is above 1 more often than that of one point, also where all "
                "uncertainties are right. The limit that the largest of so many points exceeds in 1 of 100 comparisons "
                "is the one to hold it against: " +
                text + ".");
        }
    }

    /// That differences are too small for their uncertainties is found for methods that share nothing: with what they may
    /// share U(D) is smaller. A finding that is corrected may leave a verdict for which the correlation has to be known.
    [[nodiscard]] bool holds_for_any_correlation() const {
        const gum::AgreementVerdict audited = whole().verdict_audited.value_or(whole().verdict);
        const auto holds = [](gum::AgreementVerdict verdict) {
            return verdict > gum::AgreementVerdict::correlation_unknown &&
                   verdict != gum::AgreementVerdict::uncertainty_too_large;
        };
        return whole().for_any_correlation && holds(whole().verdict) && holds(audited);
    }

    void unknown_correlation() {
        if (!comparison_.correlation_unknown) {
            return;
        }
        say("It is not known whether both methods share a standard, a sensor or another source of uncertainty. Eₙ is " +
            std::string("stated for no correlation, and for the worst plausible one, where the whole of the smaller ") +
            "uncertainty is common to both; the truth lies between them. p_low, p_high and the band of the rms Eₙ " +
            "hold for no correlation.");
        if (std::any_of(result_.summaries.begin(), result_.summaries.end(), [](const gum::MethodSummary& of) {
                return of.worst && !std::isfinite(of.worst->largest_absolute_en);
            })) {
            say("Where both methods have the same expanded uncertainty, all of it could be common to both, and no "
                "finite Eₙ bounds what that would do.");
        }
        if (holds_for_any_correlation()) {
            say("The verdict holds whatever share of the smaller uncertainty is common to both methods: none, half and "
                "the whole of it were judged, each with what chance makes.");
        }
        const bool rests_on_it = whole().verdict == gum::AgreementVerdict::correlation_unknown;
        if (rests_on_it && whole().worst && whole().worst->count_above_1 == 0) {
            say("No |Eₙ| is above 1 for the worst plausible correlation, either; but with what both methods may share, "
                "it "
                "is not excluded that the differences together contradict what is left of their uncertainty.");
        }
        const std::size_t above = whole().agreement.count_above_1;
        const std::size_t above_for_worst = whole().worst ? whole().worst->count_above_1 : 0;
        if (above_for_worst > above) {
            const std::string rests = above == 0 && rests_on_it
                                          ? "The agreement rests on the assumption that both methods share nothing: "
                                          : "The number of points above 1 is that of methods that share nothing: ";
            say(rests + "with the worst plausible correlation |Eₙ| would be above 1 at " +
                std::to_string(above_for_worst) + " of " + count_of_points() + ".");
        }
    }

    void reference_uncertainty() {
        const auto ratio = [](const ComparisonSummary& row) { return row.ratio_reference.text; };
        const std::string larger = clauses(
            [](const gum::Agreement& row) {
                return std::isfinite(row.ratio_reference) && !(row.ratio_reference < 1.0);
            },
            ratio);
        if (!larger.empty()) {
            say("The expanded uncertainty of the reference is not smaller than that of the method (rms ratio " +
                larger +
                "): |Eₙ| at or below 1 shows no contradiction, and cannot confirm the uncertainty of the "
                "method.");
        }
        const std::string limited = clauses(
            [](const gum::Agreement& row) {
                return row.ratio_reference < 1.0 && row.ratio_reference > k_negligible_reference;
            },
            ratio);
        if (!limited.empty()) {
            say("The expanded uncertainty of the reference is more than a third of that of the method (rms ratio " +
                limited + "): part of the agreement is the doing of the reference.");
        }
    }

    void too_small_differences() {
        const std::string rows =
            clauses([](const gum::Agreement& row) { return row.p_low < limit_of(gum::k_chance_of_size, row); },
                    [](const ComparisonSummary& row) { return row.p_low.text; });
        if (!rows.empty()) {
            say("The differences are smaller than their uncertainties let expect (p_low " + rows +
                "): the uncertainties are too large, or the points share more than their covariance says. Such an "
                "agreement says little about the method.");
        }
    }

    void too_large_differences() {
        const std::string rows =
            clauses([](const gum::Agreement& row) { return row.p_high < limit_of(gum::k_chance_of_size, row); },
                    [](const ComparisonSummary& row) { return row.p_high.text; });
        if (!rows.empty()) {
            say("The differences are larger than their uncertainties let expect (p_high " + rows +
                "): an uncertainty is too small, or an effect is missing.");
        }
    }

    /// What the joint numbers rest on where uncertainties have finite degrees of freedom.
    void joint_distribution() {
        const bool finite =
            std::any_of(comparison_.points.begin(), comparison_.points.end(), [](const gum::ComparedPoint& point) {
                return (point.nu && std::isfinite(*point.nu)) ||
                       (point.reference_nu && std::isfinite(*point.reference_nu));
            });
        if (!finite || whole().agreement.points < 2) {
            return;
        }
        if (!whole().agreement.is_bounded) {
            say("The uncertainties have finite degrees of freedom: p_low, p_high, the band of the rms Eₙ, the power "
                "and "
                "the limits of single points are those of Student's distribution, for uncertainties that were "
                "estimated "
                "each by itself.");
            return;
        }
        say("The uncertainties have finite degrees of freedom, and the points correlate or rest on one estimate: no "
            "exact joint distribution is known.");
        say("p_low, p_high and the p of the Mahalanobis distance are the largest of "
            "those for normal scores, for uncertainties that were estimated each by itself, and for one estimate "
            "behind "
            "all of them, and the band of the rms Eₙ is the widest.");
        const auto open = [&](const std::string& name, double largest, double least, double limit) {
            if (largest >= limit && least < limit) {
                say(name + " lies between " + printed_probability(least) + " and " + printed_probability(largest) +
                    ", on both sides of its limit: no verdict rests on it.");
            }
        };
        const gum::Agreement& row = whole().agreement;
        open("p_low", row.p_low, row.p_low_least, gum::k_chance_of_size);
        open("p_high", row.p_high, row.p_high_least, gum::k_chance_of_size);
        open("The p of the Mahalanobis distance", row.p_mahalanobis, row.p_mahalanobis_least,
             gum::k_chance_of_bias_and_pattern);
    }

    /// Points that do not correlate have no pattern but their sizes.
    static bool is_of_pattern(const gum::Agreement& row) {
        return row.effective_points < k_all * static_cast<double>(row.points);
    }

    /// Differences that contradict their covariance, whatever their sizes.
    void pattern() {
        const std::string refuted =
            clauses([](const gum::Agreement& row) { return is_of_pattern(row) && gum::is_refuted_pattern(row); },
                    [](const ComparisonSummary& row) { return row.p_pattern.text; });
        if (!refuted.empty()) {
            say("The differences do not vary together as their covariance lets expect (p " + refuted +
                "): an effect is missing, or correlations are stated "
                "that "
                "there are not.");
        }
        const std::string by_rounding = clauses(
            [](const gum::Agreement& row) {
                return is_of_pattern(row) && !gum::is_refuted_pattern(row) &&
                       row.p_mahalanobis < limit_of(gum::k_chance_of_bias_and_pattern, row);
            },
            [](const ComparisonSummary& row) { return row.p_mahalanobis.text; });
        if (!by_rounding.empty()) {
            say("The p of the Mahalanobis distance is small (" + by_rounding +
                "), but rounding of the stated numbers by 5 % of u would explain it: no verdict rests on it.");
        }
    }

    void singular_covariance() {
        const gum::Agreement& row = whole().agreement;
        if (row.rank >= row.points) {
            return;
        }
        say("The covariance of the differences has rank " + std::to_string(row.rank) + " for " + count_of_points() +
            ": some differences follow from others. The joint numbers (vector Eₙ, p of the Mahalanobis distance) are "
            "those of what is free to vary.");
        if (row.beyond_covariance > k_visible_beyond * std::sqrt(static_cast<double>(row.points))) {
            say("The differences vary in ways in which their covariance lets them not vary at all: the points share "
                "less than the covariance says.");
        }
    }

    /// What a deviation must be to be found, in place of the difference that would have been observed.
    void failing_differences() {
        const gum::Agreement& row = whole().agreement;
        const ComparisonSummary& texts = printed_whole();
        say("A deviation of " + texts.found_with_80_percent.text + unit_ +
            " is found at every single point with a probability of 80 %, one of " + texts.found_with_95_percent.text +
            unit_ + " with 95 %. D_fail is smaller: it bounds the difference that is observed, and a deviation as " +
            "large as D_fail is found in about half of all comparisons.");
        if (!record_.tolerance.number) {
            return;
        }
        const std::string tolerance = record_.tolerance.text + unit_;
        if (row.found_with_95_percent <= *record_.tolerance.number) {
            say("A deviation as large as the tolerance of " + tolerance +
                " would have been found at every point with a probability of 95 % or more.");
        } else if (row.found_with_80_percent <= *record_.tolerance.number) {
            say("A deviation as large as the tolerance of " + tolerance +
                " would have been found at every point with a probability of 80 % or more, but not with 95 %.");
        } else {
            say("A deviation as large as the tolerance of " + tolerance +
                " would not have been found at every point with a probability of 80 %.");
        }
    }

    /// Whether so many points could confirm the uncertainty at all.
    void test_of_uncertainty() {
        say("To confirm an uncertainty the differences must refute one that should be twice as large, and one that "
            "should be half as large, each with an error of 5 %. Where all uncertainties are right these points do so "
            "with a probability of " +
            printed_whole().power_to_confirm.text + ".");
    }

    /// Coverage factors that E_n cannot take as stated.
    void coverage_factors() {
        const auto converted =
            std::count_if(result_.scores.begin(), result_.scores.end(), [](const gum::MethodScore& score) {
                return score.of_scores.has_value() || score.reference_of_scores.has_value();
            });
        if (converted > 0) {
            say("At " + std::to_string(converted) + " of " + count_of_points() +
                " a coverage factor is not that of about 95 %: Eₙ takes U = k u with the factor for " +
                certificate::printed_coverage_probability(result_.score_probability) + " %" +
                " and the degrees of freedom of u there.");
            if (std::any_of(comparison_.points.begin(), comparison_.points.end(), [](const gum::ComparedPoint& point) {
                    return (point.of_scores && point.of_scores->converted) ||
                           (point.reference_of_scores && point.reference_of_scores->converted);
                })) {
                say("Of a budget, Eₙ takes U for this probability from its distribution.");
            }
        }
    }

    /// p₀ of the bias lines that something holds for, as clauses().
    template <class HoldsForLine>
    [[nodiscard]] std::string bias_clauses(const HoldsForLine& holds) const {
        std::string text;
        for (std::size_t i = 0; i < result_.summaries.size(); ++i) {
            const gum::MethodSummary& row = result_.summaries[i];
            const std::optional<BiasLineSummary>& printed = record_.summary[i].bias;
            if (row.bias && row.bias->test && printed &&
                holds(*row.bias, limit_of(gum::k_chance_of_bias_and_pattern, row.agreement))) {
                text += (text.empty() ? "" : ", ") + printed->p_no_bias.text + direction_of(row);
            }
        }
        return text;
    }

    /// Whether chance explains the bias lines.
    void bias_by_chance() {
        const std::string refuted =
            bias_clauses([](const gum::MethodBias& bias, double limit) { return bias.test->p < limit; });
        if (!refuted.empty()) {
            say("Chance does not explain constant and slope of the bias line (p\u2080 " + refuted + ").");
        }
        const std::string open = bias_clauses([](const gum::MethodBias& bias, double limit) {
            return bias.test->p >= limit && bias.test->p_least < limit;
        });
        if (!open.empty()) {
            say("Whether chance explains constant and slope of the bias line is open: one bound of p\u2080 is below "
                "its "
                "limit, and another is not (" +
                open + ").");
        }
        const std::string chance = bias_clauses([](const gum::MethodBias& bias, double limit) {
            return bias.test->p_least >= limit &&
                   (std::abs(bias.line.constant) > bias.U_constant || std::abs(bias.line.slope) > bias.U_slope);
        });
        if (!chance.empty()) {
            say("A constant or a slope of the bias line is larger than its expanded uncertainty, and chance explains "
                "that (p\u2080 " +
                chance + ").");
        }
    }

    void bias_lines() {
        std::string noisy;
        std::string turned;
        for (std::size_t i = 0; i < result_.summaries.size(); ++i) {
            const gum::MethodSummary& row = result_.summaries[i];
            if (!row.bias) {
                continue;
            }
            const gum::MethodBias& bias = *row.bias;
            const double of_noise = row.slope_of_noise;
            if (std::abs(of_noise) > k_visible_slope * bias.U_slope) {
                turned += (turned.empty() ? "" : ", ") + gum::round_significant(of_noise, 2) + direction_of(row);
            }
            const bool constant = std::abs(bias.line.constant) > bias.U_constant;
            const bool slope =
                std::abs(bias.line.slope) > bias.U_slope && std::abs(bias.line.slope - of_noise) > bias.U_slope;
            if ((constant || slope) && bias.test &&
                bias.test->p < limit_of(gum::k_chance_of_bias_and_pattern, row.agreement)) {
                say("The differences" + direction_of(row) + " have a systematic part: the " +
                    (constant && slope ? "constant and the slope"
                     : constant        ? "constant"
                                       : "slope") +
                    " of the bias line " + (constant && slope ? "are" : "is") +
                    " larger than the expanded uncertainty.");
            }
            if (bias.slope_is_noise) {
                noisy += (noisy.empty() ? "" : ", ") + (row.direction == "all" ? std::string() : row.direction);
            }
        }
        bias_by_chance();
        if (!turned.empty()) {
            say("Errors of the reference values stand in the reference value, and with the other sign in the "
                "difference. Their uncertainty alone turns the bias line by about this slope: " +
                turned + ". A slope is evidence of a scale error only as far as it differs from that.");
        }
        if (std::any_of(result_.summaries.begin(), result_.summaries.end(),
                        [](const gum::MethodSummary& row) { return row.bias && row.bias->slope_is_noise; })) {
            say("The reference values" + (noisy.empty() || result_.summaries.size() == 1 ? "" : " (" + noisy + ")") +
                " spread by less than five times their standard uncertainty: the slope of a bias line against them "
                "contains their own uncertainty, and is no evidence of a scale error.");
        }
    }

    void audit() {
        if (whole().audited) {
            say("With the findings of the audit on the uncertainties corrected, |Eₙ| is above 1 at " +
                std::to_string(whole().audited->count_above_1) + " of " + count_of_points() + " instead of " +
                std::to_string(whole().agreement.count_above_1) + ".");
        }
    }

    const gum::MethodComparison& comparison_;
    const gum::MethodResult& result_;
    Comparison& record_;
    std::string unit_;
};

}  // namespace

void add_method_remarks(const gum::MethodComparison& comparison, const gum::MethodResult& result,
                        const std::string& unit, Comparison& record) {
    Remarks(comparison, result, unit, record).add();
}

}  // namespace gumcert::reports
