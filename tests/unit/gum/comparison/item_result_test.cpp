#include "gum/comparison/item_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

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

class NormalNumbers {
public:
    explicit NormalNumbers(unsigned seed) : random_(seed) {}
    // Polar method: std::normal_distribution is not the same in every library.
    double operator()() {
        const double radius = std::sqrt(-2.0 * std::log(uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

private:
    double uniform() { return (static_cast<double>(random_()) + 0.5) / 4294967296.0; }
    std::mt19937 random_;
};

/// Right results of nine laboratories with u = 0.1, of items that differ by s, and ten such items measured twice.
test::StatedComparison of_different_items(NormalNumbers& normal, double s, AssignedValueMethod method) {
    std::vector<double> x(9);
    for (double& value : x) {
        value = 10.0 + s * normal() + 0.1 * normal();
    }
    test::StatedComparison stated = test::comparison_of(x, std::vector<double>(x.size(), 0.1));
    ComparisonItem& item = stated.scheme.items.front();
    item.assigned_value.method = method;
    item.sigma_pt.emplace().value = 1.0;
    Eigen::MatrixXd measured(10, 2);
    for (Eigen::Index i = 0; i < measured.rows(); ++i) {
        const double value = 10.0 + s * normal();
        measured(i, 0) = value + 0.03 * normal();
        measured(i, 1) = value + 0.03 * normal();
    }
    item.homogeneity = measured;
    return stated;
}

// By the stated uncertainties alone nearly all sets of right results would contradict each other where s is 3 u.
TEST(ItemResult, ItemsThatDifferAreNoContradiction) {
    constexpr int k_sets = 200;
    for (const double s : {0.0, 0.05, 0.1, 0.3, 1.0}) {
        NormalNumbers normal(static_cast<unsigned>(1000.0 * s) + 5U);
        int refuted = 0;
        int by_statements = 0;
        int left_out = 0;
        for (int set = 0; set < k_sets; ++set) {
            const test::StatedComparison stated = of_different_items(normal, s, AssignedValueMethod::weighted_mean);
            const ItemResult item = result_of(stated);
            refuted += item.consistency->test.consistent ? 0 : 1;
            const LaboratoryData data = stated.data();
            by_statements += consistency_test(data.at(data.contributing)).consistent ? 0 : 1;
            EXPECT_EQ(item.consistency->u_items, *item.u_homogeneity);
            if (set < 50) {
                test::StatedComparison asked = stated;
                asked.scheme.items.front().assigned_value.method = AssignedValueMethod::largest_consistent_subset;
                left_out += result_of(asked).not_consistent.empty() ? 0 : 1;
            }
        }
        EXPECT_LE(refuted, 0.09 * k_sets) << s;
        EXPECT_LE(left_out, 9) << s;
        if (s >= 0.3) {
            EXPECT_GE(by_statements, 0.9 * k_sets) << s;
        }
    }
}

TEST(ItemResult, AContradictionIsOneWhateverItsItemsAre) {
    NormalNumbers normal(3);
    for (const double s : {0.0, 0.1, 0.3}) {
        test::StatedComparison stated = of_different_items(normal, s, AssignedValueMethod::weighted_mean);
        stated.results[4].value = stated.results[4].value + 20.0 * std::hypot(s, 0.1);
        EXPECT_FALSE(result_of(stated).consistency->test.consistent) << s;
        stated.scheme.items.front().assigned_value.method = AssignedValueMethod::largest_consistent_subset;
        const ItemResult item = result_of(stated);
        EXPECT_EQ(item.not_consistent, std::vector<std::size_t>{4}) << s;
        EXPECT_NEAR(*item.u_characterisation, 0.1 / std::sqrt(8.0), 1e-12) << "the mean of the stated uncertainties";
    }
}

TEST(ItemResult, ADriftAndDifferentItemsAreInTheTestAndInThePairs) {
    test::StatedComparison stated = test::comparison_of({10.0, 10.6, 10.1}, {0.1, 0.2, 0.1});
    ComparisonItem& item = stated.scheme.items.front();
    item.assigned_value.method = AssignedValueMethod::weighted_mean;
    item.sigma_pt.emplace().value = 0.1;
    item.homogeneity = (Eigen::MatrixXd(3, 2) << 1.0, 1.2, 1.4, 1.2, 1.5, 1.7).finished();
    item.stability = (Eigen::MatrixXd(2, 2) << 2.4, 2.5, 2.3, 2.6).finished();
    const ItemResult result = result_of(stated);
    ASSERT_GT(*result.u_stability, 0.0);
    ASSERT_GT(*result.u_homogeneity, 0.0);
    const double u = result.u_of_item();
    EXPECT_NEAR(result.consistency->u_items, u, 1e-15);
    // About the mean with these weights.
    const std::vector<double> x = {10.0, 10.6, 10.1};
    const std::vector<double> variance = {0.01 + u * u, 0.04 + u * u, 0.01 + u * u};
    double weights = 0.0;
    double mean = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        weights += 1.0 / variance[i];
        mean += x[i] / variance[i];
    }
    mean /= weights;
    double chi_square = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        chi_square += (x[i] - mean) * (x[i] - mean) / variance[i];
    }
    EXPECT_NEAR(result.consistency->test.chi_square, chi_square, 1e-12);
    const LaboratoryData data = stated.data();
    EXPECT_EQ(*result.consistency->chi_square_of_statements, consistency_test(data.at(data.contributing)).chi_square);
    const PairEquivalence pair = pair_equivalences(data, 0.9545, u).front();
    EXPECT_NEAR(pair.u, std::sqrt(0.05 + 2.0 * u * u), 1e-12);
    EXPECT_NEAR(pair.U, 2.0 * pair.u, 1e-4 * pair.U);
}

TEST(ItemResult, StandardDeviationsForAssessment) {
    test::StatedComparison stated = test::results_of_iso_13528_e1();
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::algorithm_a;
    SigmaPtRequest& sigma = stated.scheme.items[0].sigma_pt.emplace();
    sigma.method = SigmaPtMethod::robust;
    EXPECT_NEAR(*result_of(stated).sigma_pt, 5.29458866760596, 1e-7);
    // The scale of algorithm A that σ_pt asks for is none of the Q method, whatever the assigned value is.
    test::StatedComparison equal = test::comparison_of({10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.5, 9.0}, {});
    equal.scheme.items[0].assigned_value.method = AssignedValueMethod::q_hampel;
    equal.scheme.items[0].sigma_pt.emplace().method = SigmaPtMethod::robust;
    try {
        (void)result_of(equal);
        ADD_FAILURE();
    } catch (const InputError& refused) {
        EXPECT_EQ(refused.diagnostics().front().code, "GC-GUM-0102");
        EXPECT_EQ(refused.diagnostics().front().action.find("Q method"), std::string::npos);
        EXPECT_NE(refused.diagnostics().front().action.find("need no such scale"), std::string::npos);
    }
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
