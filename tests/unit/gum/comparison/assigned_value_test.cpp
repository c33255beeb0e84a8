#include "gum/comparison/assigned_value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/comparison/stated_comparison.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::prints_as;
using testing::ElementsAre;

AssignedValue value_of(const test::StatedComparison& stated) {
    return assigned_value(stated.scheme, stated.data());
}

TEST(AssignedValue, WeightedMeanOfAKeyComparison) {
    const AssignedValue mean = value_of(test::five_results_of_cox());
    EXPECT_TRUE(prints_as(mean.value, "43877"));
    EXPECT_TRUE(prints_as(*mean.u, "53"));
    EXPECT_NEAR(mean.weights.sum(), 1.0, 1e-14);
    // cov(x_i, y) of a weighted mean is u²(y) for every result in it.
    EXPECT_NEAR(mean.covariance[3], *mean.u * *mean.u, 1e-9);
    EXPECT_FALSE(mean.scatter);
}

TEST(AssignedValue, RobustMeanOfThePublishedExample) {
    test::StatedComparison stated = test::results_of_iso_13528_e1();
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::algorithm_a;
    const AssignedValue robust = value_of(stated);
    EXPECT_TRUE(prints_as(robust.value, "26.81"));
    EXPECT_NEAR(*robust.u, 1.25 * 5.29458866760596 / std::sqrt(18.0), 1e-7);
    EXPECT_FALSE(robust.correlation_known);
    ASSERT_TRUE(robust.scatter);
    EXPECT_EQ(robust.scatter->others.size(), 18U);
}

TEST(AssignedValue, LargestConsistentSubsetSaysWhoIsOutside) {
    test::StatedComparison stated = test::key_comparison();
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::largest_consistent_subset;
    const AssignedValue subset = value_of(stated);
    EXPECT_NEAR(subset.value, 12.26967, 5e-6);
    EXPECT_NEAR(*subset.u, 0.06325, 5e-6);
    EXPECT_THAT(subset.not_consistent, ElementsAre(4));
    EXPECT_NEAR(subset.covariance[4], 0.0, 1e-18);
}

TEST(AssignedValue, ReferenceLaboratoryAndGivenValueAreAsStated) {
    test::StatedComparison stated = test::key_comparison();
    AssignedValueRequest& request = stated.scheme.items[0].assigned_value;
    request.method = AssignedValueMethod::reference;
    request.participant = "L2";
    const AssignedValue reference = value_of(stated);
    EXPECT_EQ(reference.value, 12.18);
    EXPECT_EQ(reference.stated->U, 0.30);
    EXPECT_DOUBLE_EQ(reference.covariance[1], 0.0225);
    request.method = AssignedValueMethod::given;
    request.value = 12.3;
    request.uncertainty = test::u_with_k_2(0.05);
    request.sources = {{"NMI", "", 0.04}};
    stated.results[0].sources = {{"NMI", "", 0.02}};
    const AssignedValue given = value_of(stated);
    EXPECT_EQ(*given.u, 0.05);
    EXPECT_DOUBLE_EQ(given.covariance[0], 0.0008);
    EXPECT_EQ(given.covariance[1], 0.0);
}

TEST(AssignedValue, WhatAMethodNeedsIsAskedFor) {
    test::StatedComparison nobody = test::key_comparison();
    for (ParticipantResult& result : nobody.results) {
        result.contributes = false;
    }
    EXPECT_EQ(code_of<InputError>([&] { (void)value_of(nobody); }), "GC-COMPARE-0100");
    EXPECT_EQ(code_of<InputError>([&] { (void)value_of(test::results_of_iso_13528_e1()); }), "GC-COMPARE-0101");
    test::StatedComparison correlated = test::key_comparison();
    correlated.scheme.items[0].assigned_value.method = AssignedValueMethod::mandel_paule;
    correlated.scheme.correlations = {{0, 1, 0.5}};
    EXPECT_EQ(code_of<InputError>([&] { (void)value_of(correlated); }), "GC-COMPARE-0102");
    test::StatedComparison single = test::key_comparison();
    single.scheme.items[0].assigned_value.method = AssignedValueMethod::vangel_rukhin;
    EXPECT_EQ(code_of<InputError>([&] { (void)value_of(single); }), "GC-COMPARE-0105");
    EXPECT_FALSE(replicates(single.data()));
}

}  // namespace
}  // namespace gumcert::gum
