#include "reports/record/make/comparison/method_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {
namespace {

using Eigen::MatrixXd;
using gum::ComparedPoint;
using gum::MethodComparison;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Points without correlation: D, U of the method and U of the reference, k = 2.
struct Stated {
    double D = 0.0, U = 0.0, U_reference = 0.0;
    std::string direction = {};
};

MethodComparison comparison_of(const std::vector<Stated>& points) {
    MethodComparison comparison;
    const auto m = static_cast<Eigen::Index>(points.size());
    comparison.covariance = MatrixXd::Zero(m, m);
    comparison.reference_covariance = MatrixXd::Zero(m, m);
    for (Eigen::Index i = 0; i < m; ++i) {
        const Stated& of = points[static_cast<std::size_t>(i)];
        const double reference = 100.0 * static_cast<double>(i);
        comparison.points.push_back({.name = std::to_string(i + 1),
                                     .direction = of.direction,
                                     .position = reference,
                                     .value = reference + of.D,
                                     .u = 0.5 * of.U,
                                     .U = of.U,
                                     .reference_value = reference,
                                     .reference_u = 0.5 * of.U_reference,
                                     .reference_U = of.U_reference});
        comparison.covariance(i, i) = 0.25 * of.U * of.U;
        comparison.reference_covariance(i, i) = 0.25 * of.U_reference * of.U_reference;
    }
    return comparison;
}

reports::Comparison compared(const MethodComparison& comparison) {
    reports::Comparison record;
    add_method_comparison(comparison, "um", record);
    return record;
}

/// Differences of the size that their uncertainties let expect, with a reference that is far better.
std::vector<Stated> sound() {
    return {{0.9, 2.0, 0.2}, {-1.1, 2.0, 0.2}, {0.4, 2.0, 0.2}, {-0.7, 2.0, 0.2}, {1.3, 2.0, 0.2}, {-0.5, 2.0, 0.2}};
}

/// So many points of that kind that their uncertainty can be confirmed.
std::vector<Stated> many(int times) {
    std::vector<Stated> points;
    for (int i = 0; i < times; ++i) {
        const std::vector<Stated> six = sound();
        points.insert(points.end(), six.begin(), six.end());
    }
    return points;
}

std::string joined_remarks(const reports::Comparison& record) {
    std::string text;
    for (const std::string& remark : record.remarks) {
        text += remark + "\n";
    }
    return text;
}

TEST(MethodRecord, ADifferenceThatIsItsUncertaintyButForRoundingIsNotAboveIt) {
    // 10.3 − 10.1 over 0.2 is 1, which double precision makes 1.0000000000000053.
    MethodComparison comparison = comparison_of({{0.0, 0.2, 0.0}});
    comparison.points.front().value = 10.3;
    comparison.points.front().reference_value = 10.1;
    const reports::Comparison record = compared(comparison);
    EXPECT_EQ(*record.points.front().En.number, 1.0);
    EXPECT_EQ(record.points.front().D.number, *record.points.front().U_D.number);
    EXPECT_EQ(record.points.front().signal, "none");
    EXPECT_EQ(record.summary.front().count_above_1, 0);
    EXPECT_EQ(record.summary.front().max_abs_En.number, 1.0);
    EXPECT_NE(record.summary.front().verdict, "disagreement");
}

TEST(MethodRecord, MaximumPermissibleErrorAsOnlyTerm) {
    // Golden vector 8: D = 18, U_X = 5; MPE = 10 as u gives U = 20. An audit corrects it to MPE/√3.
    MethodComparison comparison = comparison_of({{18.0, 20.0, 5.0}});
    comparison.audited_factor = 1.0 / std::sqrt(3.0);
    const reports::Comparison record = compared(comparison);
    ASSERT_EQ(record.points.size(), 1U);
    const reports::ComparisonPoint& point = record.points.front();
    EXPECT_NEAR(*point.En.number, 0.873, 5e-4);
    EXPECT_NEAR(*point.En_audited.number, 1.430, 5e-4);
    EXPECT_EQ(point.D.text, "18");
    EXPECT_EQ(point.U_D.text, "21");
    EXPECT_EQ(point.En.text, "0.87");
    EXPECT_EQ(point.zeta.text, "1.75");
    EXPECT_EQ(point.En_audited.text, "1.43");
    EXPECT_EQ(point.signal, "action") << "by the corrected uncertainty";
    EXPECT_EQ(point.signal_by, std::vector<std::string>{"En_audited"});
    ASSERT_EQ(record.summary.size(), 1U);
    EXPECT_EQ(record.summary.front().direction, "all");
    EXPECT_EQ(*record.summary.front().count_above_1_audited, 1);
    EXPECT_EQ(record.summary.front().D_fail.text, "21");
    EXPECT_THAT(joined_remarks(record), HasSubstr("corrected, |Eₙ| is above 1 at 1 of 1 point instead of 0."));
}

TEST(MethodRecord, FillsEveryNumberOfASoundComparison) {
    const reports::Comparison record = compared(comparison_of(sound()));
    ASSERT_EQ(record.summary.size(), 1U);
    const reports::ComparisonSummary& all = record.summary.front();
    EXPECT_EQ(all.verdict, "agreement_few_points");
    EXPECT_EQ(all.points, 6);
    EXPECT_EQ(all.count_above_1, 0);
    EXPECT_EQ(all.ratio_reference.text, "0.100");
    EXPECT_EQ(all.effective_points.text, "6.0");
    EXPECT_EQ(*all.rank, 6);
    EXPECT_LT(*all.rms_En_low.number, all.rms_En.number);
    EXPECT_LT(all.rms_En.number, *all.rms_En_high.number);
    EXPECT_NEAR(*all.p_low.number + *all.p_high.number, 1.0, 1e-9);
    EXPECT_FALSE(all.max_abs_En_worst.number);
    EXPECT_FALSE(all.mean_abs_En_audited.number);
    ASSERT_TRUE(all.bias);
    EXPECT_EQ(all.bias->against, "reference_value");
    EXPECT_EQ(all.bias->centre.text, "250.0");
    EXPECT_EQ(record.points[1].reference_value.text, "100.00");
    EXPECT_EQ(record.points[1].value.text, "98.9");
    EXPECT_EQ(record.points[1].D.text, "-1.1");
    EXPECT_EQ(record.points[1].k.text, "2.00");
    EXPECT_EQ(*record.points[1].correlation, 0.0);
}

TEST(MethodRecord, DirectionsInTheOrderOfThePointsAndThenAll) {
    std::vector<Stated> points = sound();
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].direction = i % 2 == 0 ? "y" : "x";
    }
    MethodComparison comparison = comparison_of(points);
    const reports::Comparison record = compared(comparison);
    ASSERT_EQ(record.summary.size(), 3U);
    EXPECT_EQ(record.summary[0].direction, "y");
    EXPECT_EQ(record.summary[1].direction, "x");
    EXPECT_EQ(record.summary[2].direction, "all");
    EXPECT_EQ(record.summary[0].points, 3);
    EXPECT_EQ(record.summary[2].points, 6);
    EXPECT_TRUE(record.summary[0].bias);
    EXPECT_FALSE(record.summary[2].bias);
}

TEST(MethodRecord, OneNamedDirectionHasNoRowForAll) {
    const reports::Comparison record = compared(comparison_of({{0.5, 2.0, 0.2, "x"}, {0.8, 2.0, 0.2, "x"}}));
    ASSERT_EQ(record.summary.size(), 1U);
    EXPECT_EQ(record.summary.front().direction, "x");
}

TEST(MethodRecord, CorrelationOfBothMethodsMakesTheDifferenceMoreCertain) {
    // D = 1, U_x = 1, U_X = 0.8, r = 0.5: E_n 1.091, which r = 0 hides (0.781).
    MethodComparison comparison = comparison_of({{1.0, 1.0, 0.8}});
    EXPECT_EQ(compared(comparison).points.front().En.text, "0.78");
    comparison.cross_covariance = MatrixXd::Constant(1, 1, 0.5 * 0.5 * 0.4);
    const reports::Comparison record = compared(comparison);
    EXPECT_EQ(record.points.front().En.text, "1.09");
    EXPECT_NEAR(*record.points.front().correlation, 0.5, 1e-15);
    EXPECT_NEAR(*record.points.front().u_D, std::sqrt(0.25 + 0.16 - 2.0 * 0.1), 1e-15);
    EXPECT_EQ(record.summary.front().verdict, "disagreement");
}

TEST(MethodRecord, CrossCovarianceOfDifferentPointsCounts) {
    // V = W = I, C with c off its diagonal: cov(D_1, D_2) = −2c and r_12 = −c.
    MethodComparison comparison = comparison_of({{1.0, 2.0, 2.0}, {1.0, 2.0, 2.0}});
    comparison.cross_covariance = MatrixXd::Zero(2, 2);
    comparison.cross_covariance(0, 1) = comparison.cross_covariance(1, 0) = 0.5;
    const reports::Comparison record = compared(comparison);
    EXPECT_NEAR(*record.summary.front().effective_points.number, 4.0 / (2.0 + 2.0 * 0.25), 1e-12);
    // dᵀV⁻¹d with V = [[2, −1], [−1, 2]] is 2.
    EXPECT_NEAR(*record.summary.front().mahalanobis_square, 2.0, 1e-12);
}

TEST(MethodRecord, CorrelatedPointsAreCountedAsWhatTheyAre) {
    std::vector<Stated> points(20, {0.3, 2.0, 0.2});
    MethodComparison comparison = comparison_of(points);
    const double p_independent = *compared(comparison).summary.front().p_low.number;
    comparison.covariance.setConstant(0.99);
    comparison.covariance.diagonal().setConstant(1.0);
    const reports::Comparison record = compared(comparison);
    EXPECT_LT(p_independent, 1e-6);
    EXPECT_GT(*record.summary.front().p_low.number, 0.025);
    EXPECT_LT(*record.summary.front().effective_points.number, 1.1);
    EXPECT_THAT(joined_remarks(record), HasSubstr("they tell as much as about 1.0 independent points."));
}

TEST(MethodRecord, UnknownCorrelationIsShownForTheWorst) {
    std::vector<Stated> points = sound();
    points[0] = {1.9, 2.0, 1.9};  // E_n 0.69; for the worst r 3.04
    MethodComparison comparison = comparison_of(points);
    comparison.correlation_unknown = true;
    const reports::Comparison record = compared(comparison);
    EXPECT_EQ(record.points[0].En.text, "0.69");
    EXPECT_EQ(record.points[0].En_worst.text, "3.04");
    EXPECT_EQ(record.summary.front().max_abs_En_worst.text, "3.04");
    EXPECT_EQ(*record.summary.front().count_above_1_worst, 1);
    EXPECT_EQ(record.summary.front().verdict, "correlation_unknown");
    EXPECT_THAT(joined_remarks(record), HasSubstr("It is not known whether both methods share"));
    EXPECT_THAT(joined_remarks(record), HasSubstr("|Eₙ| would be above 1 at 1 of 6 points."));
}

TEST(MethodRecord, EqualUncertaintiesOfUnknownCorrelationHaveNoBound) {
    std::vector<Stated> points = sound();
    points[0] = {1.9, 2.0, 2.0};
    MethodComparison comparison = comparison_of(points);
    comparison.correlation_unknown = true;
    const reports::Comparison record = compared(comparison);
    EXPECT_FALSE(record.points[0].En_worst.number);
    EXPECT_EQ(record.points[0].En_worst.text, "∞");
    EXPECT_FALSE(record.summary.front().max_abs_En_worst.number);
    EXPECT_EQ(*record.summary.front().count_above_1_worst, 1);
    EXPECT_EQ(record.summary.front().verdict, "correlation_unknown");
    EXPECT_THAT(joined_remarks(record), HasSubstr("no finite Eₙ bounds"));
}

TEST(MethodRecord, WordsNeverPraiseWhatIsNotShown) {
    std::vector<Stated> too_large(20, {0.05, 2.0, 0.2});
    too_large[1].D = -0.05;
    std::vector<Stated> poor_reference = sound();
    std::vector<Stated> limited = many(6);
    for (Stated& point : limited) {
        point.U_reference = 1.0;
    }
    std::vector<Stated> far = sound();
    for (std::size_t i = 0; i < poor_reference.size(); ++i) {
        poor_reference[i].U_reference = 2.0;
    }
    far[0].D = 7.0;
    struct Case {
        std::vector<Stated> points;
        std::string verdict, remark;
    };
    for (const Case& of : {Case{too_large, "uncertainty_too_large", "smaller than their uncertainties let expect"},
                           Case{poor_reference, "reference_not_better", "cannot confirm the uncertainty of the method"},
                           Case{limited, "agreement_reference_limited", "more than a third"},
                           Case{far, "disagreement", "larger than their uncertainties let expect"}}) {
        const reports::Comparison record = compared(comparison_of(of.points));
        EXPECT_EQ(record.summary.front().verdict, of.verdict);
        EXPECT_THAT(joined_remarks(record), HasSubstr(of.remark));
        EXPECT_THAT(joined_remarks(record), Not(HasSubstr("validated")));
    }
    EXPECT_THAT(joined_remarks(compared(comparison_of(sound()))), Not(HasSubstr("validated")));
}

TEST(MethodRecord, SinglePointsAbove1AreHeldAgainstChance) {
    std::vector<Stated> points = sound();
    points[0].D = 2.2;  // E_n 1.09; the largest of 6 points exceeds 1.57 in 1 of 100 comparisons
    reports::Comparison record = compared(comparison_of(points));
    EXPECT_EQ(record.summary.front().verdict, "agreement_few_points") << "one of six is no objection";
    EXPECT_EQ(record.points.front().signal, "action");
    EXPECT_THAT(joined_remarks(record), HasSubstr(": 1.09 against a limit of 1.57 for 6 points."));
    MethodComparison unknown = comparison_of(points);
    unknown.points[1].reference_u = 0.95;
    unknown.points[1].reference_U = 1.9;
    unknown.reference_covariance(1, 1) = 0.95 * 0.95;
    unknown.correlation_unknown = true;
    record = compared(unknown);
    EXPECT_EQ(record.summary.front().verdict, "correlation_unknown");
    EXPECT_THAT(joined_remarks(record), HasSubstr("share nothing: with the worst plausible correlation |Eₙ| would be "
                                                  "above 1 at 2 of 6 points."));
    std::vector<Stated> three = sound();  // two of six may be chance
    three[0].D = 2.05;
    three[1].D = -2.05;
    three[2].D = 2.05;
    three[3].D = three[4].D = three[5].D = 0.1;
    EXPECT_EQ(compared(comparison_of(three)).summary.front().verdict, "points_above_1");
    points[0].D = 3.2;
    EXPECT_EQ(compared(comparison_of(points)).summary.front().verdict, "disagreement");
    EXPECT_EQ(compared(comparison_of({points[0]})).summary.front().verdict, "disagreement");
    EXPECT_THAT(joined_remarks(compared(comparison_of(sound()))), Not(HasSubstr("limit")));
}

/// "Whatever share" is said of a verdict only where no share gives another one: differences that are too small for methods that
/// share nothing need not be so for others, and a finding may leave a verdict for which the correlation has to be known.
TEST(MethodRecord, AVerdictHoldsForAnyCorrelationOrIsNotSaidTo) {
    const auto says_so = [](MethodComparison comparison) {
        comparison.correlation_unknown = true;
        return testing::Value(joined_remarks(compared(comparison)), HasSubstr("whatever share"));
    };
    EXPECT_TRUE(says_so(comparison_of(many(3))));
    std::vector<Stated> small = many(3);
    for (Stated& point : small) {
        point.D *= 0.8;
        point.U_reference = 1.2;
    }
    MethodComparison too_small = comparison_of(small);
    EXPECT_FALSE(says_so(too_small));
    too_small.correlation_unknown = true;
    EXPECT_EQ(compared(too_small).summary.front().verdict, "uncertainty_too_large");
    MethodComparison with_finding = comparison_of(many(3));
    with_finding.audited_factor = 0.2;
    with_finding.correlation_unknown = true;
    EXPECT_EQ(compared(with_finding).summary.front().verdict, "falls_with_finding");
    EXPECT_FALSE(says_so(with_finding));
}

TEST(MethodRecord, AgreementThatFallsWithAFinding) {
    MethodComparison comparison = comparison_of(many(3));
    EXPECT_EQ(compared(comparison).summary.front().verdict_audited, "");
    comparison.audited_factor = 0.577;
    const reports::ComparisonSummary falls = compared(comparison).summary.front();
    EXPECT_EQ(falls.verdict, "falls_with_finding");
    EXPECT_EQ(falls.verdict_audited, "disagreement");
    EXPECT_EQ(falls.verdict_by, "");
    comparison.audited_factor = 0.95;
    EXPECT_EQ(compared(comparison).summary.front().verdict, "validated");
    comparison.audited_factor = 0.2;
    comparison.points[0].value += 9.0;
    EXPECT_EQ(compared(comparison).summary.front().verdict, "disagreement") << "it does not stand as stated";
}

TEST(MethodRecord, SaysWhatItsJointNumbersRestOn) {
    MethodComparison comparison = comparison_of(many(3));
    EXPECT_THAT(joined_remarks(compared(comparison)), Not(HasSubstr("finite degrees of freedom")));
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        comparison.points[i].nu = 4.0 + static_cast<double>(i);
    }
    EXPECT_THAT(joined_remarks(compared(comparison)), HasSubstr("are those of Student's distribution"));
    EXPECT_FALSE(compared(comparison).summary.front().p_high_least.number);
    comparison.covariance.array() += 0.25;
    EXPECT_THAT(joined_remarks(compared(comparison)), HasSubstr("no exact joint distribution is known"));
    EXPECT_TRUE(compared(comparison).summary.front().p_high_least.number);
}

TEST(MethodRecord, FewPointsConfirmNoUncertainty) {
    EXPECT_EQ(compared(comparison_of(many(3))).summary.front().verdict, "validated");
    EXPECT_EQ(compared(comparison_of(many(2))).summary.front().verdict, "agreement_few_points");
    MethodComparison shared = comparison_of(many(3));
    shared.covariance.setConstant(0.8);
    shared.covariance.diagonal().setConstant(1.0);
    EXPECT_EQ(compared(shared).summary.front().verdict, "disagreement") << "they differ by more than they may";
    EXPECT_EQ(compared(shared).summary.front().verdict_by, "pattern");
    EXPECT_THAT(joined_remarks(compared(shared)), HasSubstr("do not vary together as their covariance lets expect"));
    for (ComparedPoint& point : shared.points) {
        point.value = point.reference_value + 0.5 + 0.45 * (point.value - point.reference_value);
    }
    EXPECT_EQ(compared(shared).summary.front().verdict, "agreement_few_points");
}

TEST(MethodRecord, CoverageFactorsOfBothSidesAreBroughtToOne) {
    MethodComparison comparison = comparison_of(sound());
    const reports::Comparison with_2 = compared(comparison);
    for (ComparedPoint& point : comparison.points) {
        point.U = 3.0 * point.u;
        point.k = 3.0;
        point.reference_U = point.reference_u;
        point.reference_k = 1.0;
    }
    const reports::Comparison brought = compared(comparison);
    for (std::size_t i = 0; i < brought.points.size(); ++i) {
        EXPECT_NEAR(*brought.points[i].En.number, *with_2.points[i].En.number, 1e-4);
        EXPECT_DOUBLE_EQ(*brought.points[i].U.number, 3.0 * *brought.points[i].u) << "as stated";
    }
    EXPECT_THAT(joined_remarks(brought), HasSubstr("At 6 of 6 points a coverage factor is not that of about 95 %"));
    EXPECT_THAT(joined_remarks(with_2), Not(HasSubstr("a coverage factor is not")));
}

TEST(MethodRecord, RemarksNameTheDirection) {
    std::vector<Stated> points = sound();
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].direction = i < 3 ? "x" : "y";
        points[i].U_reference = i < 3 ? 3.0 : 0.2;
    }
    const std::string remarks = joined_remarks(compared(comparison_of(points)));
    EXPECT_THAT(remarks, HasSubstr("(rms ratio 1.50 of the direction x, 1.06 of all directions together)"));
}

TEST(MethodRecord, DeviationsThatAreFoundAreHeldAgainstTheTolerance) {
    reports::Comparison record;
    record.tolerance = {2.0, "2"};
    add_method_comparison(comparison_of(sound()), "um", record);
    EXPECT_THAT(joined_remarks(record),
                HasSubstr("tolerance of 2 µm would not have been found at every point with a probability of 80 %"));
    // U = 2 √1.01, u = U/2: U + 0.842 u and U + 1.645 u
    EXPECT_THAT(joined_remarks(record), HasSubstr("A deviation of 2.9 µm is found at every single point"));
    EXPECT_THAT(joined_remarks(record), HasSubstr("one of 3.7 µm with 95 %"));
    record.remarks.clear();
    record.tolerance = {3.0, "3"};
    add_method_comparison(comparison_of(sound()), "um", record);
    EXPECT_THAT(joined_remarks(record), HasSubstr("with a probability of 80 % or more, but not with 95 %"));
    record.remarks.clear();
    record.tolerance = {5.0, "5"};
    add_method_comparison(comparison_of(sound()), "um", record);
    EXPECT_THAT(joined_remarks(record), HasSubstr("tolerance of 5 µm would have been found at every point with a "
                                                  "probability of 95 % or more."));
}

TEST(MethodRecord, BiasLineAgainstThePosition) {
    std::vector<Stated> points;
    for (int i = 0; i < 6; ++i) {
        points.push_back({1.0 + 0.5 * i, 2.0, 0.2});
    }
    MethodComparison comparison = comparison_of(points);
    comparison.bias_against_position = true;
    const reports::Comparison record = compared(comparison);
    const reports::BiasLineSummary& bias = *record.summary.front().bias;
    EXPECT_EQ(bias.against, "position");
    EXPECT_NEAR(bias.slope.number, 0.005, 1e-15);
    EXPECT_NEAR(bias.constant.number, 2.25, 1e-12);
    EXPECT_NEAR(bias.chi_square, 0.0, 1e-20);
    // u of one D is √(1 + 0.01); u(a) = u/√6, u(b) = u/√175000.
    EXPECT_NEAR(bias.u_constant, std::sqrt(1.01 / 6.0), 1e-12);
    EXPECT_NEAR(bias.u_slope, std::sqrt(1.01 / 175000.0), 1e-12);
    EXPECT_EQ(bias.slope.text, "0.0050");
    EXPECT_EQ(bias.U_slope.text, "0.0048");
    EXPECT_EQ(record.summary.front().verdict, "disagreement");
    EXPECT_EQ(bias.p_no_bias.number, bias.p_no_bias_least);
    EXPECT_THAT(joined_remarks(record), HasSubstr("have a systematic part"));
    EXPECT_THAT(joined_remarks(record), HasSubstr("Chance does not explain constant and slope of the bias line"));
    EXPECT_THAT(joined_remarks(record), Not(HasSubstr("no evidence of a scale error")));
    comparison.points[2].position.reset();
    EXPECT_FALSE(compared(comparison).summary.front().bias);
}

TEST(MethodRecord, SlopeAgainstReferenceValuesThatAreNoise) {
    MethodComparison comparison = comparison_of(sound());
    for (ComparedPoint& point : comparison.points) {
        point.reference_value *= 1e-3;
        point.value = point.reference_value + 0.1;
        point.reference_u = 0.1;
    }
    EXPECT_THAT(joined_remarks(compared(comparison)), HasSubstr("no evidence of a scale error"));
}

TEST(MethodRecord, SlopeThatTheReferenceAloneExplains) {
    // t = 0, 1 … 19, reference noise of variance 0.25: −Σ(19/20) 0.25 / Σ(t − t̄)² = −4.75/665.
    std::vector<Stated> points(20, {0.0, 0.2, 1.0});
    MethodComparison comparison = comparison_of(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        comparison.points[i].reference_value = static_cast<double>(i);
        comparison.points[i].value = comparison.points[i].reference_value * 0.93;
    }
    reports::Comparison record = compared(comparison);
    EXPECT_GT(std::abs(record.summary.front().bias->slope.number), record.summary.front().bias->U_slope.number);
    EXPECT_THAT(joined_remarks(record), HasSubstr("turns the bias line by about this slope: -0.0071."));
    EXPECT_THAT(joined_remarks(record), HasSubstr("have a systematic part"));
    // A slope above its U that the noise explains is not called systematic.
    comparison.reference_covariance *= 16.0;
    for (ComparedPoint& point : comparison.points) {
        point.reference_u *= 4.0;
        point.reference_U *= 4.0;
        point.value = 1.615 + point.reference_value * 0.83;
    }
    record = compared(comparison);
    EXPECT_GT(std::abs(record.summary.front().bias->slope.number), record.summary.front().bias->U_slope.number);
    EXPECT_THAT(joined_remarks(record), Not(HasSubstr("have a systematic part")));
    EXPECT_THAT(joined_remarks(record), HasSubstr("about this slope: -0.11."));
    // What all points share turns nothing.
    comparison.reference_covariance.setConstant(4.0);
    comparison.reference_covariance.diagonal().setConstant(4.0 + 1e-9);
    EXPECT_THAT(joined_remarks(compared(comparison)), Not(HasSubstr("about this slope")));
}

TEST(MethodRecord, SingularCovariances) {
    // Both methods fully correlated between their points: one difference, told six times.
    MethodComparison comparison = comparison_of(std::vector<Stated>(6, {1.0, 2.0, 0.2}));
    comparison.covariance.setConstant(1.0);
    comparison.reference_covariance.setConstant(0.01);
    const reports::Comparison record = compared(comparison);
    const reports::ComparisonSummary& all = record.summary.front();
    EXPECT_EQ(*all.rank, 1);
    EXPECT_EQ(all.effective_points.text, "1.0");
    EXPECT_FALSE(all.bias);
    EXPECT_THAT(joined_remarks(record), HasSubstr("has rank 1 for 6 points"));
    EXPECT_THAT(joined_remarks(record), Not(HasSubstr("share less than the covariance says")));
    comparison.points[0].value += 2.0;
    EXPECT_THAT(joined_remarks(compared(comparison)), HasSubstr("share less than the covariance says"));
}

TEST(MethodRecord, PrintsNoUncertaintyWhereOneSideHasNone) {
    const reports::Comparison record = compared(comparison_of({{0.25, 0.5, 0.0}, {0.5, 0.0, 1.0}}));
    EXPECT_EQ(record.points[0].reference_U.text, "0");
    EXPECT_EQ(record.points[0].reference_value.text, "0");
    EXPECT_EQ(record.points[1].value.text, "100.5");
}

TEST(MethodRecord, Refusals) {
    const auto code_of = [](const MethodComparison& comparison) -> std::string {
        try {
            (void)compared(comparison);
        } catch (const gum::InputError& refused) {
            return refused.diagnostics().front().code;
        }
        return "";
    };
    EXPECT_EQ(code_of({}), "GC-COMPARE-0201");
    MethodComparison bad = comparison_of(sound());
    bad.cross_covariance = MatrixXd::Identity(2, 2);
    EXPECT_EQ(code_of(bad), "GC-COMPARE-0201");
    bad = comparison_of(sound());
    bad.cross_covariance = MatrixXd::Identity(6, 6);
    EXPECT_EQ(code_of(bad), "GC-COMPARE-0202");
    bad = comparison_of({{0.1, 1.0, 1.0, "all"}});
    EXPECT_EQ(code_of(bad), "GC-COMPARE-0203");
    EXPECT_EQ(code_of(comparison_of({{0.1, 0.0, 0.0}})), "GC-GUM-0031");
    bad = comparison_of(sound());
    bad.covariance(0, 1) = bad.covariance(1, 0) = 3.0;
    EXPECT_EQ(code_of(bad), "GC-GUM-0053");
}

}  // namespace
}  // namespace gumcert::reports
