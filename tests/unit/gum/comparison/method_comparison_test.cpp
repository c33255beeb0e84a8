#include "gum/comparison/method_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/support/case_count.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;

/// Points 0, 100, 200 … with these differences, all with U = 2 of the method and 0.2 of the reference, k = 2.
MethodComparison methods_with(const std::vector<double>& differences) {
    MethodComparison comparison;
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const double reference = 100.0 * static_cast<double>(i);
        comparison.points.push_back({.name = std::to_string(i + 1),
                                     .value = reference + differences[i],
                                     .u = 1.0,
                                     .U = 2.0,
                                     .reference_value = reference,
                                     .reference_u = 0.1,
                                     .reference_U = 0.2});
    }
    const auto m = static_cast<Eigen::Index>(differences.size());
    comparison.covariance = Eigen::MatrixXd::Identity(m, m);
    comparison.reference_covariance = 0.01 * Eigen::MatrixXd::Identity(m, m);
    return comparison;
}

TEST(MethodScores, OfIndependentMethods) {
    const MethodResult result = compare_methods(methods_with({0.9, -1.1, 2.5}));
    ASSERT_EQ(result.scores.size(), 3U);
    EXPECT_NEAR(result.scores[2].en, 2.5 / std::sqrt(4.04), 1e-12);
    EXPECT_NEAR(result.scores[2].zeta, 2.5 / std::sqrt(1.01), 1e-12);
    EXPECT_FALSE(result.scores[0].en_worst);
    EXPECT_FALSE(result.scores[0].en_audited);
    ASSERT_EQ(result.summaries.size(), 1U);
    EXPECT_EQ(result.summaries[0].direction, "all");
    EXPECT_EQ(result.summaries[0].agreement.count_above_1, 1U);
    EXPECT_EQ(result.score_probability, 0.9545);
}

TEST(MethodScores, WhereTheCorrelationIsNotKnown) {
    MethodComparison comparison = methods_with({0.9, -1.1});
    comparison.correlation_unknown = true;
    const MethodResult result = compare_methods(comparison);
    EXPECT_NEAR(result.scores[0].en_worst.value(), 0.9 / std::sqrt(4.0 - 0.04), 1e-12);
    EXPECT_NEAR(result.summaries[0].worst->largest_absolute_en, 1.1 / std::sqrt(3.96), 1e-12);
    comparison.points[0].reference_U = 2.0;
    comparison.points[0].reference_u = 1.0;
    EXPECT_TRUE(std::isinf(compare_methods(comparison).summaries[0].worst->largest_absolute_en)) << "nothing bounds it";
}

TEST(MethodScores, WithFindingsCorrected) {
    MethodComparison comparison = methods_with({0.9, -1.1});
    comparison.audited_factor = 0.5;
    const MethodResult result = compare_methods(comparison);
    EXPECT_NEAR(result.scores[1].en_audited.value(), -1.1 / std::hypot(1.0, 0.2), 1e-12);
    EXPECT_EQ(result.summaries[0].audited->count_above_1, 1U);
    EXPECT_EQ(result.summaries[0].agreement.count_above_1, 0U);
}

TEST(MethodSummaries, DirectionsInTheOrderOfThePointsAndThenAll) {
    MethodComparison comparison = methods_with({0.9, -1.1, 0.4, -0.7, 1.3, -0.5});
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        comparison.points[i].direction = i % 2 == 0 ? "y" : "x";
    }
    const MethodResult result = compare_methods(comparison);
    ASSERT_EQ(result.summaries.size(), 3U);
    EXPECT_EQ(result.summaries[0].direction, "y");
    EXPECT_EQ(result.summaries[1].direction, "x");
    EXPECT_EQ(result.summaries[2].agreement.points, 6U);
    EXPECT_TRUE(result.summaries[0].bias);
    EXPECT_FALSE(result.summaries[2].bias) << "directions of their own have no line in common";
}

/// 20 points of a method with u = 1 and a reference with u = 0.25 that share a part of the variance of the reference.
/// \param scatter  of the method, in u: 1 where its u is right
MethodComparison methods_that_share(std::mt19937& random, double share, double scatter) {
    constexpr double k_u_reference = 0.25;
    const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
    const auto normal = [&] {
        return std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform());
    };
    std::vector<double> differences;
    for (int i = 0; i < 20; ++i) {
        const double common = share * k_u_reference * k_u_reference;  // what cancels in the difference
        differences.push_back(std::sqrt(scatter * scatter - common) * normal() +
                              std::sqrt(k_u_reference * k_u_reference - common) * normal());
    }
    MethodComparison comparison = methods_with(differences);
    for (ComparedPoint& point : comparison.points) {
        point.reference_u = k_u_reference;
        point.reference_U = 2.0 * k_u_reference;
    }
    comparison.reference_covariance = k_u_reference * k_u_reference * Eigen::MatrixXd::Identity(20, 20);
    comparison.correlation_unknown = true;
    return comparison;
}

/// The law of a verdict without a known correlation: whatever both methods share, right uncertainties are accused as rarely
/// as those of a known correlation (4.5 %), most of them have a verdict, and wrong ones are validated in 5 % of all
/// comparisons at most. By |E_n| ≤ 1 for the worst correlation alone two of three right comparisons had none.
TEST(MethodVerdicts, HoldForAnyCorrelationAsOftenAsTheyPromise) {
    const int runs = gumcert::test::cases(40, 80);
    for (const double share : {0.0, 0.5, 1.0}) {
        std::mt19937 random(11U + static_cast<unsigned>(10.0 * share));
        int accused = 0;
        int without = 0;
        int validated_too_small = 0;
        int validated_too_large = 0;
        for (int run = 0; run < runs; ++run) {
            const AgreementVerdict right = compare_methods(methods_that_share(random, share, 1.0)).summaries[0].verdict;
            accused += right == AgreementVerdict::disagreement || right == AgreementVerdict::points_above_1 ? 1 : 0;
            without += right == AgreementVerdict::correlation_unknown ? 1 : 0;
            const auto is_validated = [&](double scatter) {
                return compare_methods(methods_that_share(random, share, scatter)).summaries[0].verdict ==
                       AgreementVerdict::validated;
            };
            validated_too_small += is_validated(2.0) ? 1 : 0;
            validated_too_large += is_validated(0.5) ? 1 : 0;
        }
        // Four standard deviations of a count above what is promised.
        EXPECT_LE(accused, 0.055 * runs + 4.0 * std::sqrt(0.055 * runs)) << share;
        EXPECT_LE(without, 0.15 * runs) << share;
        EXPECT_LE(validated_too_small, 0.05 * runs + 4.0 * std::sqrt(0.05 * runs)) << share;
        EXPECT_LE(validated_too_large, 0.05 * runs + 4.0 * std::sqrt(0.05 * runs)) << share;
    }
}

/// No correlation between none and the worst one objects to a verdict that is given for any.
TEST(MethodVerdicts, ForAnyCorrelationAreThoseOfEachCorrelation) {
    std::mt19937 random(5);
    int given = 0;
    for (int run = 0; run < 40; ++run) {
        MethodComparison comparison = methods_that_share(random, 0.1 * (run % 11), 1.0);
        const MethodSummary row = compare_methods(comparison).summaries[0];
        EXPECT_TRUE(row.for_any_correlation);
        if (row.verdict <= AgreementVerdict::correlation_unknown) {
            continue;
        }
        ++given;
        comparison.correlation_unknown = false;
        for (int tenth = 0; tenth <= 10; ++tenth) {
            comparison.cross_covariance = 0.1 * tenth * comparison.reference_covariance;
            const AgreementVerdict known = compare_methods(comparison).summaries[0].verdict;
            EXPECT_GT(known, AgreementVerdict::correlation_unknown) << run << ", " << tenth;
            EXPECT_GE(known, row.verdict) << run << ", " << tenth;
        }
    }
    EXPECT_GT(given, 30);
}

/// A direction is judged for itself: that nothing would be left of the uncertainty in another one neither refuses the
/// comparison nor changes its verdict.
TEST(MethodVerdicts, ForAnyCorrelationLookAtNoOtherDirection) {
    std::mt19937 random(5);
    MethodComparison comparison = methods_that_share(random, 0.0, 1.0);
    for (std::size_t i = 0; i < 20; ++i) {
        comparison.points[i].direction = i < 10 ? "x" : "y";
    }
    const MethodResult before = compare_methods(comparison);
    for (Eigen::Index i = 10; i < 20; ++i) {
        comparison.points[static_cast<std::size_t>(i)].reference_u = 1.0;
        comparison.points[static_cast<std::size_t>(i)].reference_U = 2.0;
        comparison.reference_covariance(i, i) = 1.0;
    }
    const MethodResult result = compare_methods(comparison);
    ASSERT_EQ(result.summaries.size(), 3U);
    EXPECT_TRUE(result.summaries[0].for_any_correlation);
    EXPECT_FALSE(result.summaries[1].for_any_correlation);
    EXPECT_FALSE(result.summaries[2].for_any_correlation);
    EXPECT_EQ(result.summaries[0].verdict, before.summaries[0].verdict);
}

/// What points share with each other may be common to both sides in any way: then each |E_n| counts by itself, as where ν
/// is finite or nothing is left of the uncertainty.
TEST(MethodVerdicts, ForAnyCorrelationNeedPointsOfTheirOwn) {
    std::mt19937 random(5);
    MethodComparison comparison = methods_that_share(random, 0.0, 1.0);
    MethodComparison shared = comparison;
    shared.covariance(0, 1) = shared.covariance(1, 0) = 0.1;
    MethodComparison finite = comparison;
    finite.points[3].nu = 9.0;
    MethodComparison equal = comparison;
    equal.points[3].reference_u = 1.0;
    equal.points[3].reference_U = 2.0;
    equal.reference_covariance(3, 3) = 1.0;
    EXPECT_TRUE(compare_methods(comparison).summaries[0].for_any_correlation);
    for (const MethodComparison* one : {&shared, &finite, &equal}) {
        EXPECT_FALSE(compare_methods(*one).summaries[0].for_any_correlation);
    }
}

/// A verdict of points that share effects rests on more than each |E_n| for the worst correlation: with it 20 of them at
/// 0.98 at most may be far too many (Σ ζ² of 35.5, p = 0.018, and 12.2 without a correlation: "agreement").
TEST(MethodVerdicts, OfPointsThatShareEffectsAreThoseOfEachPlausibleCorrelation) {
    std::mt19937 random(3);
    const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
    int given = 0;
    int without = 0;
    for (int run = 0; run < 18; ++run) {
        const double u_reference = 0.3 + 0.05 * run / 2.0;
        const double limit = 2.0 * std::sqrt(1.0 - u_reference * u_reference);
        std::vector<double> differences;
        for (int i = 0; i < 20; ++i) {
            differences.push_back(std::copysign((0.2 + 0.78 * uniform()) * limit, uniform() - 0.5));
        }
        MethodComparison comparison = methods_with(differences);
        for (ComparedPoint& point : comparison.points) {
            point.reference_u = u_reference;
            point.reference_U = 2.0 * u_reference;
            point.nu = run % 2 == 0 ? std::optional<double>() : 200.0;
        }
        comparison.reference_covariance = u_reference * u_reference * Eigen::MatrixXd::Identity(20, 20);
        comparison.covariance.array() += 0.02;
        comparison.covariance.diagonal().setOnes();
        comparison.correlation_unknown = true;
        const MethodSummary row = compare_methods(comparison).summaries[0];
        EXPECT_FALSE(row.for_any_correlation);
        without += row.verdict == AgreementVerdict::correlation_unknown ? 1 : 0;
        if (row.verdict <= AgreementVerdict::correlation_unknown) {
            continue;
        }
        ++given;
        comparison.correlation_unknown = false;
        for (const double share : {0.0, 0.5, 1.0}) {
            comparison.cross_covariance = share * comparison.reference_covariance;
            EXPECT_GT(compare_methods(comparison).summaries[0].verdict, AgreementVerdict::correlation_unknown) << run;
        }
    }
    EXPECT_GT(given, 0);
    EXPECT_GT(without, 0);
}

/// Right uncertainties in directions of a few points, and a shift of the first of them.
MethodComparison right_in_directions(std::mt19937& random, std::size_t directions, std::size_t points, double shift) {
    // Polar method: std::normal_distribution is not the same in every library.
    const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
    std::vector<double> differences;
    for (std::size_t i = 0; i < directions * points; ++i) {
        const double normal = std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform());
        differences.push_back(normal * std::sqrt(1.01) + (i < points ? shift : 0.0));
    }
    MethodComparison comparison = methods_with(differences);
    for (std::size_t i = 0; i < differences.size(); ++i) {
        comparison.points[i].direction = "d" + std::to_string(i / points);
    }
    return comparison;
}

/// The law: the gravest verdict of all directions counts, and it is a disagreement of right uncertainties as rarely as
/// that of one direction: 4.5 % by all limits on a direction, as much again by the row of all points. With a limit of
/// its own for each, 48 % of 24 directions were one.
TEST(MethodSummaries, ManyDirectionsMakeNoDisagreement) {
    constexpr int k_runs = 40;
    for (const auto& [directions, points] : {std::pair<std::size_t, std::size_t>{24, 3}, {24, 1}, {3, 12}}) {
        std::mt19937 random(7U + static_cast<unsigned>(directions));
        int objections = 0;
        for (int run = 0; run < k_runs; ++run) {
            const MethodResult result = compare_methods(right_in_directions(random, directions, points, 0.0));
            bool is_one = false;
            for (const MethodSummary& row : result.summaries) {
                is_one = is_one || row.verdict == AgreementVerdict::disagreement ||
                         row.verdict == AgreementVerdict::points_above_1;
                EXPECT_EQ(row.agreement.family, row.direction == "all" ? 1U : directions);
            }
            objections += is_one ? 1 : 0;
        }
        EXPECT_LE(objections, 8) << directions << " directions of " << points;  // 9 % and 2 standard deviations
        // One direction that is off is found among all of them.
        int found = 0;
        for (int run = 0; run < 5; ++run) {
            const MethodResult result = compare_methods(right_in_directions(random, directions, points, 5.0));
            found += result.summaries.front().verdict == AgreementVerdict::disagreement ? 1 : 0;
        }
        EXPECT_GE(found, 4) << directions << " directions of " << points;
    }
    EXPECT_EQ(chance_in_family(0.025, 1), 0.025);
    EXPECT_NEAR(1.0 - std::pow(1.0 - chance_in_family(0.025, 24), 24), 0.025, 1e-14);
}

TEST(MethodSummaries, BiasLineAndWhatNoiseMakesOfIt) {
    // D = 0.002 t − 0.2: the line is met exactly.
    const MethodResult result = compare_methods(methods_with({-0.2, 0.0, 0.2}));
    const MethodBias& bias = result.summaries[0].bias.value();
    EXPECT_NEAR(bias.line.slope, 0.002, 1e-12);
    EXPECT_NEAR(bias.line.constant, 0.0, 1e-12);
    EXPECT_EQ(bias.span, 200.0);
    EXPECT_NEAR(bias.U_slope, 2.0 * std::sqrt(1.01 / 20000.0), 1e-5);
    // −(trace − sum/n)/Σ(t − t̄)² of the reference covariance.
    EXPECT_NEAR(result.summaries[0].slope_of_noise, -(0.03 - 0.01) / 20000.0, 1e-15);
}

TEST(MethodSummaries, DegreesOfFreedomReachTheJointTests) {
    // Σζ² = 42.4 of 20 points, by χ² a disagreement; every u of the method was estimated from 5 readings.
    MethodComparison comparison = methods_with(std::vector<double>(20, std::sqrt(1.01 * 42.4 / 20.0)));
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        comparison.points[i].value -= i % 2 == 0 ? 2.0 * std::sqrt(1.01 * 42.4 / 20.0) : 0.0;
    }
    EXPECT_EQ(compare_methods(comparison).summaries[0].verdict, AgreementVerdict::disagreement);
    for (std::size_t i = 0; i < comparison.points.size(); ++i) {
        comparison.points[i].nu = 4.0 + 1e-6 * static_cast<double>(i);
    }
    const MethodSummary apart = compare_methods(comparison).summaries[0];
    EXPECT_FALSE(apart.agreement.is_bounded);
    EXPECT_NEAR(apart.agreement.p_high, 0.2988, 0.0005);  // nu of D is 4.08
    EXPECT_NE(apart.verdict, AgreementVerdict::disagreement);
    for (ComparedPoint& point : comparison.points) {
        point.nu = 4.0;
    }
    EXPECT_TRUE(compare_methods(comparison).summaries[0].agreement.is_bounded) << "one u and one nu are one estimate";
}

TEST(MethodSummaries, VerdictOfCorrectedUncertainties) {
    // Σζ² fits u as it stands, and not u · 0.577.
    std::vector<double> differences;
    for (int i = 0; i < 20; ++i) {
        differences.push_back(i % 2 == 0 ? 1.0 : -1.0);
    }
    MethodComparison comparison = methods_with(differences);
    EXPECT_EQ(compare_methods(comparison).summaries[0].verdict, AgreementVerdict::validated);
    EXPECT_FALSE(compare_methods(comparison).summaries[0].verdict_audited);
    comparison.audited_factor = 0.577;
    const MethodSummary audited = compare_methods(comparison).summaries[0];
    EXPECT_EQ(audited.verdict, AgreementVerdict::validated);
    EXPECT_EQ(audited.verdict_audited, AgreementVerdict::disagreement);
    MethodComparison corrected = methods_with(differences);
    for (ComparedPoint& point : corrected.points) {
        point.u *= 0.577;
        point.U *= 0.577;
    }
    corrected.covariance *= 0.577 * 0.577;
    EXPECT_EQ(compare_methods(corrected).summaries[0].verdict, *audited.verdict_audited);
}

TEST(MethodRefusals, SizesCorrelationsAndNames) {
    MethodComparison sizes = methods_with({0.9, -1.1});
    sizes.covariance.resize(1, 1);
    EXPECT_EQ(code_of<InputError>([&] { (void)compare_methods(sizes); }), "GC-COMPARE-0201");
    MethodComparison beyond = methods_with({0.9, -1.1});
    beyond.cross_covariance = 0.2 * Eigen::MatrixXd::Identity(2, 2);
    EXPECT_EQ(code_of<InputError>([&] { (void)compare_methods(beyond); }), "GC-COMPARE-0202");
    MethodComparison all = methods_with({0.9, -1.1});
    all.points[1].direction = "all";
    EXPECT_EQ(code_of<InputError>([&] { (void)compare_methods(all); }), "GC-COMPARE-0203");
}

}  // namespace
}  // namespace gumcert::gum
