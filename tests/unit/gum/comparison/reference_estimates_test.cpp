#include "gum/comparison/reference_estimates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/gum/comparison/stated_comparison.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::prints_as;
using testing::ElementsAre;

const ReferenceEstimate& estimate(const std::vector<ReferenceEstimate>& all, const std::string& method) {
    for (const ReferenceEstimate& one : all) {
        if (one.method == method) {
            return one;
        }
    }
    ADD_FAILURE() << method;
    return all.front();
}

TEST(ReferenceEstimates, OfResultsWithoutUncertaintyAreTheRobustOnes) {
    test::StatedComparison stated = test::results_of_iso_13528_e1();
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::algorithm_a;
    const LaboratoryData data = stated.data();
    const std::vector<ReferenceEstimate> all = reference_estimates(data, assigned_value(stated.scheme, data), 0.9545);
    std::vector<std::string> methods;
    for (const ReferenceEstimate& one : all) {
        methods.push_back(one.method);
        EXPECT_EQ(one.used, one.method == "algorithm_a");
    }
    EXPECT_THAT(methods, ElementsAre("arithmetic_mean", "median", "niqr", "algorithm_a", "q_hampel"));
    EXPECT_TRUE(prints_as(estimate(all, "algorithm_a").value, "26.81"));
    EXPECT_NEAR(*estimate(all, "algorithm_a").scale, 5.29458866760596, 1e-7);
    EXPECT_EQ(estimate(all, "median").value, 28.0);
    EXPECT_NEAR(robust_standard_deviation(data).value(), 5.29458866760596, 1e-7);
    EXPECT_FALSE(consistency_of(data, assigned_value(stated.scheme, data)));
}

// 473 612 353 604 000.0225 Hz lies between two doubles: the list says what the assigned value says.
TEST(ReferenceEstimates, HaveTheRestOfAMean) {
    for (const AssignedValueMethod method :
         {AssignedValueMethod::weighted_mean, AssignedValueMethod::arithmetic_mean, AssignedValueMethod::mandel_paule,
          AssignedValueMethod::dersimonian_laird, AssignedValueMethod::median, AssignedValueMethod::algorithm_a}) {
        test::StatedComparison stated =
            test::comparison_of({473612353604000.0, 473612353604000.0625, 473612353604000.0625, 473612353603999.9375},
                                {0.1, 0.1, 0.1, 0.1});
        stated.scheme.items[0].assigned_value.method = method;
        const LaboratoryData data = stated.data();
        const AssignedValue assigned = assigned_value(stated.scheme, data);
        const std::vector<ReferenceEstimate> all = reference_estimates(data, assigned, 0.9545);
        const ReferenceEstimate& mean = estimate(all, "arithmetic_mean");
        EXPECT_EQ((mean.value - 473612353604000.0) + mean.rest, 0.015625);
        EXPECT_EQ(estimate(all, "niqr").rest, estimate(all, "median").rest);
        for (const ReferenceEstimate& one : all) {
            if (one.used) {
                EXPECT_EQ(one.value, assigned.value) << one.method;
                EXPECT_EQ(one.rest, assigned.rest) << one.method;
            }
        }
    }
}

TEST(ReferenceEstimates, ConsistencyOfAKeyComparison) {
    const test::StatedComparison stated = test::five_results_of_cox();
    const LaboratoryData data = stated.data();
    const ResultConsistency consistency = consistency_of(data, assigned_value(stated.scheme, data)).value();
    EXPECT_NEAR(consistency.test.chi_square, 1.77859404317893, 1.8e-6);
    EXPECT_NEAR(consistency.test.p_value, 0.77639628860821, 1e-6);
    EXPECT_TRUE(consistency.test.consistent);
    EXPECT_EQ(consistency.pairs, 10U);
    EXPECT_EQ(consistency.incompatible_pairs, 0U);
}

TEST(ReferenceEstimates, PooledStandardDeviationOfThePublishedExample) {
    // ISO 13528:2022, E.13: 25 standard deviations of four observations, w* = 0.34.
    const std::vector<double> s{0.13, 0.21, 0.08, 0.24, 0.36, 0.32, 0.14, 0.26, 0.39, 0.53, 0.25, 0.24, 0.72,
                                0.26, 0.17, 0.32, 0.40, 0.36, 0.33, 0.43, 0.40, 0.55, 0.39, 0.30, 0.22};
    test::StatedComparison stated = test::comparison_of(std::vector<double>(s.size(), 1.5), {});
    for (std::size_t i = 0; i < s.size(); ++i) {
        stated.results[i].standard_deviation = s[i];
        stated.results[i].observations = 4;
    }
    EXPECT_TRUE(prints_as(pooled_standard_deviation(stated.data()).value(), "0.34"));
    stated.results[3].observations = 5;
    EXPECT_FALSE(pooled_standard_deviation(stated.data())) << "not all with the same number of observations";
}

TEST(PairEquivalences, AreThoseOfTheStatedUncertainties) {
    const test::StatedComparison stated = test::key_comparison();
    const LaboratoryData data = stated.data();
    EXPECT_EQ(count_pairs(data), 15U);
    const std::vector<PairEquivalence> pairs = pair_equivalences(data, 0.9545);
    ASSERT_EQ(pairs.size(), 15U);
    EXPECT_EQ(pairs[3].first, 0U);
    EXPECT_EQ(pairs[3].second, 4U);
    EXPECT_NEAR(pairs[3].d, -0.64, 1e-14);
    EXPECT_NEAR(pairs[3].en.value(), -0.64 / (2.0 * std::hypot(0.10, 0.15)), 1e-12);
    const test::StatedComparison without_u = test::results_of_iso_13528_e1();
    EXPECT_EQ(count_pairs(without_u.data()), 0U);
}

}  // namespace
}  // namespace gumcert::gum
