#include "gum/comparison/item_result.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/comparison/stated_comparison.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::prints_as;

ItemResult result_of(const test::StatedComparison& stated) {
    const LaboratoryData data = stated.data();
    return item_result(stated.scheme, data, assigned_value(stated.scheme, data));
}

TEST(ItemResult, OfAKeyComparison) {
    const ItemResult item = result_of(test::key_comparison());
    EXPECT_NEAR(item.value, 12.37236, 5e-6);
    EXPECT_NEAR(*item.u, 0.05828, 5e-6);
    EXPECT_NEAR(*item.U, 2.0 * *item.u, 1e-4 * *item.u) << "k = 2.00 for 95.45 %";
    EXPECT_EQ(item.expanded_by, ExpandedBy::uncertainties);
    EXPECT_EQ(item.score, DecidingScore::en);
    EXPECT_EQ(item.contributing, 6U);
    EXPECT_EQ(item.weights.size(), 6U);
    EXPECT_FALSE(item.consistency->test.consistent);
    EXPECT_NEAR(item.consistency->test.chi_square, 19.1142, 5e-5);
}

TEST(ItemResult, OfAScheme) {
    const ItemResult item = result_of(test::results_of_iso_13528_e4());
    EXPECT_EQ(item.value, 0.044);
    EXPECT_EQ(*item.U, 0.0082) << "as stated";
    EXPECT_EQ(item.expanded_by, ExpandedBy::statement);
    EXPECT_NEAR(*item.criterion, 0.0041 / 0.0066, 1e-15);
    EXPECT_FALSE(item.criterion_met);
    EXPECT_EQ(item.score, DecidingScore::z_prime);
    EXPECT_TRUE(item.weights.empty());
    EXPECT_EQ(item.contributing, 0U);
}

TEST(ItemResult, AConsensusIsComparedWithAReferenceValue) {
    test::StatedComparison stated = test::key_comparison();
    ComparisonItem& item = stated.scheme.items.front();
    const ItemResult plain = result_of(stated);
    EXPECT_FALSE(plain.consensus);
    for (const double in_u : {-3.0, -1.9, 0.5, 1.9, 3.0}) {
        item.u_reference_value = 0.03;
        const double u = std::hypot(*plain.u, 0.03);
        item.reference_value = plain.value - in_u * u;
        const ItemResult result = result_of(stated);
        ASSERT_TRUE(result.consensus);
        EXPECT_NEAR(result.consensus->difference, in_u * u, 1e-13);
        EXPECT_NEAR(result.consensus->u_difference, u, 1e-14);
        EXPECT_NEAR(result.consensus->ratio, in_u, 1e-11);
        EXPECT_EQ(result.consensus->consistent, std::abs(in_u) <= 2.0) << in_u;
    }
}

TEST(ItemResult, WhatTheItemsAddIsInTheUncertainty) {
    test::StatedComparison stated = test::results_of_iso_13528_e4();
    ComparisonItem& item = stated.scheme.items.front();
    // Means 1.5, 3.5, 5.5: s_x = 2, s_w² = 0.5, s_s = √(4 − 0.25).
    item.homogeneity = (Eigen::MatrixXd(3, 2) << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0).finished();
    const ItemResult result = result_of(stated);
    EXPECT_NEAR(*result.u_homogeneity, std::sqrt(3.75), 1e-14);
    EXPECT_NEAR(*result.u, std::hypot(0.0041, std::sqrt(3.75)), 1e-14);
    EXPECT_NEAR(result.u_of_item(), std::sqrt(3.75), 1e-14);
    EXPECT_FALSE(result.homogeneity->sufficient_expanded);
}

TEST(ItemResult, StandardDeviationsForAssessment) {
    test::StatedComparison stated = test::results_of_iso_13528_e1();
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::algorithm_a;
    SigmaPtRequest& sigma = stated.scheme.items[0].sigma_pt.emplace();
    sigma.method = SigmaPtMethod::robust;
    EXPECT_NEAR(*result_of(stated).sigma_pt, 5.29458866760596, 1e-7);
    sigma = {.method = SigmaPtMethod::percent_of_assigned, .value = 10.0};
    EXPECT_NEAR(*result_of(stated).sigma_pt, 2.68125, 1e-6);
}

TEST(ItemResult, Refusals) {
    test::StatedComparison stated = test::key_comparison();
    stated.scheme.items[0].homogeneity = (Eigen::MatrixXd(2, 2) << 1.0, 2.0, 3.0, 4.0).finished();
    EXPECT_EQ(code_of<InputError>([&] { (void)result_of(stated); }), "GC-COMPARE-0104");
    stated.scheme.items[0].sigma_pt.emplace().value = 0.0;
    EXPECT_EQ(code_of<InputError>([&] { (void)result_of(stated); }), "GC-COMPARE-0107");
    stated.scheme.items[0].sigma_pt->value = 1.0;
    std::swap(stated.scheme.items[0].homogeneity, stated.scheme.items[0].stability);
    EXPECT_EQ(code_of<InputError>([&] { (void)result_of(stated); }), "GC-COMPARE-0108");
    // 3 % of 20 °C and of 293 K are not one number, and neither has a level a percentage.
    stated = test::key_comparison();
    stated.scheme.items[0].sigma_pt = SigmaPtRequest{.method = SigmaPtMethod::percent_of_assigned, .value = 3.0};
    for (const char* unit : {"degC", "degF", "dB"}) {
        stated.scheme.items[0].unit = Unit::parse(unit);
        EXPECT_EQ(code_of<InputError>([&] { (void)result_of(stated); }), "GC-COMPARE-0130") << unit;
    }
    for (const char* unit : {"K", "mg", "1", "deg"}) {
        stated.scheme.items[0].unit = Unit::parse(unit);
        EXPECT_NEAR(*result_of(stated).sigma_pt, 0.03 * result_of(stated).value, 1e-12) << unit;
    }
    test::StatedComparison equal = test::comparison_of({10.3, 10.3, 10.3, 10.4}, {0.1, 0.2, 0.1, 0.1});
    equal.scheme.items[0].assigned_value.method = AssignedValueMethod::median;
    EXPECT_EQ(code_of<InputError>([&] { (void)result_of(equal); }), "GC-COMPARE-0109");
}

}  // namespace
}  // namespace gumcert::gum
