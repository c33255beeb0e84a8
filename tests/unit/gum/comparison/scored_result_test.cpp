#include "gum/comparison/scored_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "gum/comparison/laboratory_comparison.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/comparison/stated_comparison.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::prints_as;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<ScoredResult> scores_of(const test::StatedComparison& stated) {
    const LaboratoryData data = stated.data();
    const AssignedValue assigned = assigned_value(stated.scheme, data);
    return scored_results(stated.scheme, data, assigned, item_result(stated.scheme, data, assigned));
}

TEST(ScoredResults, OfThePublishedScheme) {
    // ISO 13528:2022, table E.4: laboratories 15, 9, 16 and 1.
    const std::vector<ScoredResult> scores = scores_of(test::results_of_iso_13528_e4());
    ASSERT_EQ(scores.size(), 4U);
    const ScoredResult& first = scores.front();
    EXPECT_TRUE(prints_as(*first.percent, "-68.2"));
    EXPECT_TRUE(prints_as(*first.percent_of_allowed, "-151.5"));
    EXPECT_TRUE(prints_as(*first.z, "-4.55"));
    EXPECT_TRUE(prints_as(*first.z_prime, "-3.86"));
    EXPECT_TRUE(prints_as(*first.zeta, "-7.30"));
    EXPECT_TRUE(prints_as(*first.en, "-3.65"));
    EXPECT_EQ(first.verdict, Verdict::action);
    EXPECT_THAT(first.verdict_by, ElementsAre(Score::z_prime, Score::en, Score::zeta, Score::difference))
        << "z' in place of z";
    EXPECT_EQ(scores[2].verdict, Verdict::none);
    EXPECT_THAT(scores[2].verdict_by, IsEmpty());
}

TEST(ScoredResults, DegreesOfEquivalenceOfAKeyComparison) {
    const std::vector<ScoredResult> scores = scores_of(test::five_results_of_cox());
    EXPECT_NEAR(scores[0].difference, -105.380389232552, 1e-4);
    EXPECT_NEAR(*scores[0].U_difference, 161.853953745782, 2e-4);
    EXPECT_NEAR(std::abs(*scores[0].en), 0.651083194409137, 1e-6);
    EXPECT_NEAR(scores[1].difference, 32.6196107674477, 1e-4);
    EXPECT_NEAR(*scores[1].U_difference, 168.999119356113, 2e-4);
}

TEST(ScoredResults, OfAnInconsistentKeyComparison) {
    const std::array<double, 6> expected{-0.384, -0.696, 0.125, -0.583, 2.090, -0.548};
    const std::vector<ScoredResult> scores = scores_of(test::key_comparison());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(*scores[i].en, expected[i], 6e-4) << i;
        EXPECT_EQ(scores[i].participant, i);
    }
    EXPECT_EQ(scores[4].verdict, Verdict::action);
}

TEST(ScoredResults, CorrectedByAnAudit) {
    // The maximum permissible error taken as a standard uncertainty, and as it should be.
    test::StatedComparison stated = test::comparison_of({118.0, 101.0}, {10.0, 2.5});
    AssignedValueRequest& request = stated.scheme.items[0].assigned_value;
    request.method = AssignedValueMethod::given;
    request.value = 100.0;
    request.uncertainty = test::u_with_k_2(2.5);
    stated.results[0].audited = AuditedUncertainty{test::u_with_k_2(10.0 / std::sqrt(3.0)), "MPE is a limit"};
    stated.scheme.participants[0].cmc_U = 5.0;
    const std::vector<ScoredResult> scores = scores_of(stated);
    EXPECT_TRUE(prints_as(*scores[0].en, "0.873"));
    EXPECT_TRUE(prints_as(*scores[0].U_difference, "20.62"));
    EXPECT_TRUE(prints_as(*scores[0].en_audited, "1.430"));
    EXPECT_THAT(scores[0].verdict_by, ElementsAre(Score::en_audited));
    EXPECT_DOUBLE_EQ(*scores[0].U_over_cmc, 4.0);
    EXPECT_DOUBLE_EQ(*scores[0].U_over_median, 4.0);
    EXPECT_FALSE(scores[1].en_audited);
}

TEST(ScoredResults, AReferenceThatIsWorseClearsNobody) {
    test::StatedComparison stated = test::comparison_of({10.1, 10.2}, {0.1, 0.4});
    AssignedValueRequest& request = stated.scheme.items[0].assigned_value;
    request.method = AssignedValueMethod::given;
    request.value = 10.0;
    request.uncertainty = test::u_with_k_2(0.2);
    const std::vector<ScoredResult> scores = scores_of(stated);
    EXPECT_EQ(scores[0].verdict, Verdict::inconclusive);
    EXPECT_EQ(scores[1].verdict, Verdict::none);
}

TEST(ScoredResults, AResultFarOffDoesNotMakeTheOthersUncertain) {
    test::StatedComparison stated =
        test::comparison_of({10.0, 10.1, 9.9, 10.05, 9.95, 13.02}, {0.1, 0.1, 0.1, 0.1, 0.1, 3.0});
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::mandel_paule;
    const std::vector<ScoredResult> scores = scores_of(stated);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(scores[i].verdict, Verdict::none) << i;
    }
}

TEST(ScoredResults, DifferencesHaveIntervalsWhereTheValueHasOne) {
    // A check of the items that finds nothing adds nothing: both keep the intervals of the trials. One that finds
    // something takes them from both.
    const auto intervals = [](const std::vector<double>& between) {
        test::StatedComparison stated = test::key_comparison();
        ComparisonItem& item = stated.scheme.items[0];
        item.assigned_value.method = AssignedValueMethod::median;
        item.assigned_value.median_by_trials = true;
        item.assigned_value.trials = 2000;
        item.delta_E = 3.0;
        if (!between.empty()) {
            Eigen::MatrixXd& tested = item.homogeneity.emplace();
            tested.resize(static_cast<Eigen::Index>(between.size()), 2);
            for (std::size_t i = 0; i < between.size(); ++i) {
                tested(static_cast<Eigen::Index>(i), 0) = 12.3 + between[i] - 0.01;
                tested(static_cast<Eigen::Index>(i), 1) = 12.3 + between[i] + 0.01;
            }
        }
        const LaboratoryData data = stated.data();
        const AssignedValue assigned = assigned_value(stated.scheme, data);
        const ItemResult result = item_result(stated.scheme, data, assigned);
        const std::vector<ScoredResult> scores = scored_results(stated.scheme, data, assigned, result);
        for (const ScoredResult& score : scores) {
            EXPECT_EQ(score.low.has_value(), result.low.has_value());
            EXPECT_EQ(score.high.has_value(), result.high.has_value());
        }
        EXPECT_EQ(result.low.has_value(), result.u_of_item() == 0.0);
        return result.low.has_value();
    };
    EXPECT_TRUE(intervals({}));
    EXPECT_TRUE(intervals({0.0, 0.0, 0.0, 0.0})) << "s_s = 0";
    EXPECT_FALSE(intervals({-0.3, 0.1, 0.3, 0.2}));
}

TEST(ScoredResults, TheReferenceLaboratoryHasNoScore) {
    test::StatedComparison stated = test::key_comparison();
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::reference;
    stated.scheme.items[0].assigned_value.participant = "L1";
    const std::vector<ScoredResult> scores = scores_of(stated);
    EXPECT_FALSE(scores[0].en);
    EXPECT_EQ(scores[0].verdict, Verdict::no_score);
    EXPECT_NEAR(*scores[1].en, -0.13 / (2.0 * std::hypot(0.10, 0.15)), 1e-12);
}

TEST(ScoredResults, AnotherCoverageFactorIsBroughtTo95Percent) {
    test::StatedComparison stated = test::results_of_iso_13528_e4();
    stated.results[3].uncertainty = stated_expanded(0.0035 * 1.73, 1.73);
    const std::vector<ScoredResult> scores = scores_of(stated);
    ASSERT_TRUE(scores[3].of_scores);
    EXPECT_NEAR(scores[3].U_of_scores(), 0.007, 1e-5);
    EXPECT_FALSE(scores[2].of_scores);
}

TEST(ScoredResults, ADifferenceWithoutUncertaintyIsNotPassedOver) {
    for (const double value : {10.25, 9.9999, 10.0, 10.0 + 1e-15}) {
        test::StatedComparison stated = test::comparison_of({10.0, value, 9.9}, {0.1, 0.1, 0.2});
        stated.scheme.items[0].assigned_value.method = AssignedValueMethod::reference;
        stated.scheme.items[0].assigned_value.participant = "L1";
        stated.scheme.correlations.push_back({.first = 0, .second = 1, .r = 1.0});
        if (std::abs(value - 10.0) > 1e-9) {
            try {
                (void)scores_of(stated);
                ADD_FAILURE() << value;
            } catch (const InputError& refused) {
                EXPECT_EQ(refused.diagnostics().front().code, "GC-GUM-0031");
                if (value == 10.25 || value == 9.9999) {  // 9.9999 - 10 is -9.9999999999766942E-5
                    const std::string D = value == 10.25 ? "D = 0.25 " : "D = -1e-04 ";
                    EXPECT_EQ(refused.diagnostics().front().what.substr(0, D.size()), D);
                }
                EXPECT_NE(refused.diagnostics().front().where.find("result of L2"), std::string::npos);
            }
        } else {
            EXPECT_FALSE(scores_of(stated)[1].en) << value;
        }
    }
}

/// A result of a budget: what its distribution says of U goes before its u and degrees of freedom.
TEST(ScoredResults, TakeUOfADistributionAsItIs) {
    test::StatedComparison stated = test::results_of_iso_13528_e4();
    stated.scheme.items[0].sigma_pt.reset();
    stated.scheme.items[0].delta_E.reset();
    ResultUncertainty& heavy = *stated.results[0].uncertainty;  // D = −0.030
    heavy = {.u = 0.0045, .U = 0.0405, .k = 9.0, .degrees_of_freedom = 5.4};
    heavy.coverage_probability = 0.9545;
    heavy.of_scores = EnUncertainty{.U = 0.0405, .k = 9.0, .converted = false};
    const std::vector<ScoredResult> scores = scores_of(stated);
    EXPECT_FALSE(scores[0].of_scores);
    EXPECT_NEAR(*scores[0].en, -0.030 / std::hypot(0.0405, 0.0082), 1e-9);
    EXPECT_GT(std::abs(*scores[0].zeta), 3.0);
    EXPECT_EQ(scores[0].verdict, Verdict::none) << "the limits of zeta are those of a normal distribution";
    heavy.of_scores.reset();
    EXPECT_EQ(scores_of(stated)[0].verdict, Verdict::action) << "by k and nu alone it is brought to t";
}

/// The law: with stated correlations u_D is that of the stated covariance or larger, the correlation with the value is one,
/// and U_D is not below u_D, for every value that is made of all results alike.
TEST(ScoredResults, StrongCorrelationsHideNoDifference) {
    const std::vector<double> x{10.02, 9.97, 10.05, 9.99, 10.0, 9.94};
    for (const double r : {0.0, 0.3, 0.6, 0.9, 0.99}) {
        for (const AssignedValueMethod method : {AssignedValueMethod::arithmetic_mean, AssignedValueMethod::median,
                                                 AssignedValueMethod::algorithm_a, AssignedValueMethod::q_hampel}) {
            test::StatedComparison stated = test::comparison_of(x, std::vector<double>(6, 0.1));
            stated.scheme.items[0].assigned_value.method = method;
            for (std::size_t i = 0; i < 6 && r > 0.0; ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    stated.scheme.correlations.push_back({.first = j, .second = i, .r = r});
                }
            }
            // u²(x_i − mean) = u² (1 − r) 5/6
            const double least = 0.1 * std::sqrt((1.0 - r) * 5.0 / 6.0);
            for (const ScoredResult& score : scores_of(stated)) {
                const std::string where = std::to_string(r) + " method " + std::to_string(static_cast<int>(method));
                EXPECT_LE(std::abs(*score.correlation), 1.0) << where;
                EXPECT_GE(*score.U_difference, *score.u_difference) << where;
                if (r == 0.0) {
                    continue;
                }
                EXPECT_GE(*score.u_difference, least * (1.0 - 1e-9)) << where;
                EXPECT_GE(*score.U_assigned, 1.9 * *score.u_assigned) << where;
                const bool scatter_is_smaller = r >= 0.6;
                if (method == AssignedValueMethod::arithmetic_mean && scatter_is_smaller) {
                    EXPECT_NEAR(*score.u_difference, least, 1e-9) << where;
                    EXPECT_NEAR(*score.u_assigned, 0.1 * std::sqrt((1.0 + 5.0 * r) / 6.0), 1e-9) << where;
                }
            }
        }
    }
}

TEST(ScoredResults, ACorrelationBeyond1IsRefused) {
    test::StatedComparison stated = test::comparison_of({10.0, 10.1}, {0.1, 0.1});
    AssignedValueRequest& request = stated.scheme.items[0].assigned_value;
    request.method = AssignedValueMethod::given;
    request.value = 10.0;
    request.uncertainty = test::u_with_k_2(0.05);
    const LaboratoryData data = stated.data();
    AssignedValue assigned = assigned_value(stated.scheme, data);
    assigned.covariance[1] = 0.0051;  // more than u u(X)
    EXPECT_EQ(test::code_of<InputError>([&] {
                  (void)scored_results(stated.scheme, data, assigned, item_result(stated.scheme, data, assigned));
              }),
              "GC-GUM-0030");
}

TEST(ScoredResults, AGroupOfUnknownCorrelationLeavesAResultOpen) {
    test::StatedComparison stated = test::comparison_of({10.0, 10.32, 10.0}, {0.1, 0.15, 0.15});
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::reference;
    stated.scheme.items[0].assigned_value.participant = "L1";
    stated.scheme.participants[0].group = stated.scheme.participants[1].group = "NMI-X";
    const std::vector<ScoredResult> scores = scores_of(stated);
    EXPECT_LT(std::abs(*scores[1].en), 1.0);
    EXPECT_GT(std::abs(*scores[1].en_worst), 1.0);
    EXPECT_EQ(scores[1].verdict, Verdict::inconclusive);
    EXPECT_THAT(scores[1].verdict_by, ElementsAre(Score::en_worst));
    EXPECT_EQ(scores[2].verdict, Verdict::none);
}

// (e − w)ᵀ V (e − w) with cov = u² within the group: u_D of the third of four equal results is 0.1 √(1/8).
TEST(ScoredResults, WhatAGroupSharesChangesTheUncertaintyOfAWeightedMeanToo) {
    test::StatedComparison stated = test::comparison_of({10.0, 10.02, 10.16, 9.9}, {0.1, 0.1, 0.1, 0.1});
    for (const std::size_t i : {0U, 1U, 2U}) {
        stated.scheme.participants[i].group = "G";
    }
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::weighted_mean;
    const std::vector<ScoredResult> scores = scores_of(stated);
    EXPECT_TRUE(prints_as(*scores[2].en, "0.81"));
    EXPECT_NEAR(*scores[2].en_worst, 0.14 / (2.0 * 0.1 * std::sqrt(0.125)), 1e-9);
    EXPECT_EQ(scores[2].verdict, Verdict::inconclusive);
    EXPECT_THAT(scores[2].verdict_by, ElementsAre(Score::en_worst));
    EXPECT_FALSE(scores[3].en_worst);
}

// The law: whatever makes the assigned value out of the results, a member of a group of which nobody knows what it shares
// has a worst E_n, and that is not smaller than its E_n.
TEST(ScoredResults, EveryConsensusKnowsItsWorstCorrelation) {
    using Method = AssignedValueMethod;
    for (const Method method : {Method::arithmetic_mean, Method::weighted_mean, Method::median, Method::algorithm_a,
                                Method::q_hampel, Method::dersimonian_laird, Method::mandel_paule,
                                Method::power_moderated_mean, Method::largest_consistent_subset}) {
        for (const double u : {0.1, 0.2, 0.4}) {
            test::StatedComparison stated =
                test::comparison_of({10.0, 10.05, 10.13, 9.87, 9.95, 10.21, 9.9}, {u, 0.1, 0.12, 0.1, 0.15, 0.1, 0.11});
            for (const std::size_t i : {0U, 1U, 2U, 3U, 4U}) {
                stated.scheme.participants[i].group = "G";
            }
            stated.scheme.items[0].assigned_value.method = method;
            const std::vector<ScoredResult> scores = scores_of(stated);
            for (std::size_t i = 0; i < scores.size(); ++i) {
                const std::string what = std::to_string(static_cast<int>(method)) + " " + std::to_string(i);
                EXPECT_EQ(scores[i].in_unknown_group, i < 5) << what;
                ASSERT_EQ(scores[i].en_worst.has_value(), i < 5) << what;
                if (i < 5) {
                    EXPECT_GE(std::abs(*scores[i].en_worst), std::abs(*scores[i].en) * (1.0 - 1e-12)) << what;
                    EXPECT_FALSE(scores[i].verdict == Verdict::none && std::abs(*scores[i].en_worst) > 1.0) << what;
                }
            }
        }
    }
}

// The nearer both uncertainties are to each other, the larger the worst E_n. At equality it has no limit, and does not
// vanish.
TEST(ScoredResults, EqualUncertaintiesHaveNoWorstEn) {
    const auto worst = [](double u, double value) {
        test::StatedComparison stated = test::comparison_of({10.0, value, 10.0}, {0.1, u, 0.2});
        stated.scheme.items[0].assigned_value.method = AssignedValueMethod::reference;
        stated.scheme.items[0].assigned_value.participant = "L1";
        stated.scheme.participants[0].group = stated.scheme.participants[1].group = "G";
        return scores_of(stated)[1];
    };
    EXPECT_TRUE(std::isinf(*worst(0.1, 10.1).en_worst));
    EXPECT_EQ(worst(0.1, 10.1).verdict, Verdict::inconclusive);
    EXPECT_LT(*worst(0.1, 9.9).en_worst, -1e300);
    EXPECT_EQ(*worst(0.1, 10.0).en_worst, 0.0);
    EXPECT_EQ(worst(0.1, 10.0).verdict, Verdict::none);
    double before = 0.0;
    for (const double apart : {0.01, 1e-3, 1e-4, 1e-6, 0.0}) {
        const double en = *worst(0.1 + apart, 10.1).en_worst;
        EXPECT_GT(en, before) << apart;
        before = en;
    }
}

// The law: where zero is does not matter. A mean that rounds to the nearest double is off by 1/32 Hz at 4.7e14 Hz, which
// made a failure of the most precise result an E_n of 0, and a false one of another.
TEST(ScoredResults, AConstantChangesNoScore) {
    using Method = AssignedValueMethod;
    const std::vector<double> offsets{0.0, 13.5, -20.125, 31.0, 7.25, -3.5};
    for (const Method method : {Method::weighted_mean, Method::arithmetic_mean, Method::median, Method::algorithm_a,
                                Method::q_hampel, Method::dersimonian_laird, Method::mandel_paule,
                                Method::power_moderated_mean, Method::largest_consistent_subset}) {
        const auto scores = [&](double constant) {
            std::vector<double> x;
            for (const double offset : offsets) {
                x.push_back(offset + constant);
            }
            test::StatedComparison stated = test::comparison_of(x, {0.3, 30.0, 30.0, 30.0, 30.0, 30.0});
            stated.scheme.items[0].assigned_value.method = method;
            return scores_of(stated);
        };
        const std::vector<ScoredResult> about_zero = scores(0.0);
        for (const double constant : {1e6, 1e12, 473612353604000.0, -473612353604000.0}) {
            const std::vector<ScoredResult> moved = scores(constant);
            for (std::size_t i = 0; i < moved.size(); ++i) {
                const std::string what = std::to_string(static_cast<int>(method)) + " " + std::to_string(i);
                EXPECT_NEAR(*moved[i].en, *about_zero[i].en, 1e-4) << what;
                EXPECT_NEAR(*moved[i].zeta, *about_zero[i].zeta, 1e-4) << what;
                EXPECT_EQ(moved[i].verdict, about_zero[i].verdict) << what;
            }
        }
    }
}

// ζ of a u with 2 degrees of freedom is a t: 3.5 has a probability of 7 %, and calls for nothing.
TEST(ScoredResults, ZetaOfFewDegreesOfFreedomIsJudgedAsT) {
    const auto scored = [](double nu, double value) {
        test::StatedComparison stated;
        ComparisonItem& item = stated.scheme.items.emplace_back();
        item.id = "block";
        item.unit = Unit::parse("mm");
        item.assigned_value.method = AssignedValueMethod::given;
        item.assigned_value.value = 10.0;
        item.assigned_value.uncertainty = test::u_with_k_2(0.01);
        stated.add("A", value,
                   ResultUncertainty{.u = 0.1,
                                     .U = coverage_factor(0.9545, nu) * 0.1,
                                     .k = coverage_factor(0.9545, nu),
                                     .degrees_of_freedom = nu});
        return scores_of(stated)[0];
    };
    const ScoredResult two = scored(2.0, 10.35);
    EXPECT_NEAR(*two.zeta, 3.4827, 1e-3);
    EXPECT_LT(*two.en, 1.0);
    EXPECT_EQ(two.verdict, Verdict::none);
    EXPECT_EQ(scored(std::numeric_limits<double>::infinity(), 10.35).verdict, Verdict::action);
    // The law: with the same D, fewer degrees of freedom never call for more; and ζ speaks where E_n nearly does.
    for (double value = 10.0; value < 12.0; value += 0.05) {
        int before = 0;
        for (const double nu : {1.0, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0, std::numeric_limits<double>::infinity()}) {
            const ScoredResult result = scored(nu, value);
            const double judged = result.zeta_as_normal.value_or(*result.zeta);
            const int signal = static_cast<int>(signal_of_z(judged));
            EXPECT_GE(signal, before) << nu << " " << value;
            before = signal;
            EXPECT_NEAR(std::abs(judged) > 2.0, std::abs(*result.en) > 1.0, std::abs(judged - 2.0) < 0.03 ? 1.0 : 0.0)
                << nu << " " << value;
        }
    }
}

/// A result that is most of the value has little of its own u in D, and little of its few degrees of freedom.
TEST(ScoredResults, ZetaCountsWhatAResultHasInTheDifference) {
    const auto scored = [](double nu) {
        test::StatedComparison stated;
        ComparisonItem& item = stated.scheme.items.emplace_back();
        item.id = "weight";
        item.unit = Unit::parse("mg");
        item.assigned_value.method = AssignedValueMethod::weighted_mean;
        stated.add("A", 10.00, ResultUncertainty{.u = 0.01, .U = 0.02, .k = 2.0, .degrees_of_freedom = nu});
        stated.add("B", 10.11, test::u_with_k_2(0.03));
        stated.add("C", 10.09, test::u_with_k_2(0.03));
        return scores_of(stated)[0];
    };
    const double infinite = *scored(std::numeric_limits<double>::infinity()).zeta;
    EXPECT_NEAR(infinite, -4.264, 1e-3);
    // D = (1 − w)(x − mean of the others): of u_D² x has 1 − w = 0.182, so that ν = 5/0.182² = 151.
    const double judged = scored(5.0).zeta_as_normal.value_or(0.0);
    EXPECT_NEAR(judged, normal_score(infinite, 5.0 / (0.18182 * 0.18182)), 1e-3);
}

// D of two laboratories from their weighted mean are parts of one difference: −0.145 and 0.145 of 0.29. Both U in one
// root, with r and factors that differ, gave E_n = −0.41 and 1.01.
TEST(ScoredResults, OneDifferenceHasOneEnWhateverTheDegreesOfFreedom) {
    const auto of = [](double u, double nu) {
        const double k = coverage_factor(0.9545, nu);
        return ResultUncertainty{.u = u, .U = k * u, .k = k, .degrees_of_freedom = nu};
    };
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    for (const double nu : {1.0, 2.0, 3.0, 5.0, 10.0, 30.0, k_infinite}) {
        for (const double u : {0.02, 0.1, 0.3}) {
            for (const double r : {0.0, 0.4, -0.4}) {
                test::StatedComparison stated = test::comparison_of({}, {});
                stated.scheme.items[0].assigned_value.method = AssignedValueMethod::weighted_mean;
                stated.add("A", 1.0, of(u, nu));
                stated.add("B", 1.29, of(0.1, k_infinite));
                if (r != 0.0) {
                    stated.scheme.correlations.push_back({0, 1, r});
                }
                const LaboratoryComparison found = evaluate_laboratories(stated.scheme, stated.results);
                // Of correlated results a weight may be negative: both D have one sign then.
                const double a = std::abs(*found.results[0].en);
                const double b = std::abs(*found.results[1].en);
                EXPECT_NEAR(a, b, 1e-9 * b) << nu << " " << u << " " << r;
                EXPECT_NEAR(a, std::abs(*found.items[0].pairs[0].en), 1e-9 * b) << nu << " " << u << " " << r;
            }
        }
    }
    // The law: U(D) lies between the factors of its parts, as often as results differ in them and correlate.
    for (int seed = 0; seed < 40; ++seed) {
        test::StatedComparison stated = test::comparison_of({}, {});
        stated.scheme.items[0].assigned_value.method =
            seed % 2 == 0 ? AssignedValueMethod::weighted_mean : AssignedValueMethod::reference;
        stated.scheme.items[0].assigned_value.participant = "L2";
        const std::array<double, 4> degrees = {1.0 + seed % 5, 3.0, k_infinite, 4.0 + seed};
        for (std::size_t i = 0; i < degrees.size(); ++i) {
            stated.add("L" + std::to_string(i), 1.0 + 0.1 * static_cast<double>(i),
                       of(0.05 + 0.01 * static_cast<double>((seed * 7 + static_cast<int>(i) * 3) % 11), degrees[i]));
        }
        stated.scheme.correlations = {{0, 1, 0.3}, {0, 2, 0.5}};
        const double largest = coverage_factor(0.9545, std::min(degrees[0], 3.0));
        for (const ScoredResult& point : scores_of(stated)) {
            if (point.en) {
                EXPECT_LE(*point.U_difference, (1.0 + 1e-9) * largest * *point.u_difference) << seed;
                EXPECT_GE(*point.U_difference, (1.0 - 1e-9) * coverage_factor(0.9545, k_infinite) * *point.u_difference)
                    << seed;
            }
        }
    }
}

TEST(ScoredResults, NoSignalRestsOnTheChoiceOfASubset) {
    // The first three of the five are consistent, and so are the second, third and fourth.
    test::StatedComparison stated = test::comparison_of({10.0, 10.15, 10.3, 10.45, 20.0}, {0.1, 0.1, 0.1, 0.1, 0.1});
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::largest_consistent_subset;
    const std::vector<ScoredResult> scores = scores_of(stated);
    EXPECT_GT(std::max(std::abs(*scores[0].en), std::abs(*scores[3].en)), 1.0);
    for (const std::size_t in_one_of_them : {0U, 1U, 2U, 3U}) {
        EXPECT_EQ(scores[in_one_of_them].verdict, Verdict::inconclusive) << in_one_of_them;
        EXPECT_TRUE(scores[in_one_of_them].verdict_by.empty());
    }
    EXPECT_EQ(scores[4].verdict, Verdict::action) << "no consistent three of them hold it";
}

}  // namespace
}  // namespace gumcert::gum
