#include "gum/comparison/laboratory_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/comparison/stated_comparison.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::prints_as;

TEST(EvaluateLaboratories, AllThatFollowsFromAKeyComparison) {
    const test::StatedComparison stated = test::five_results_of_cox();
    const LaboratoryComparison comparison = evaluate_laboratories(stated.scheme, stated.results);
    ASSERT_EQ(comparison.items.size(), 1U);
    EXPECT_TRUE(prints_as(comparison.items[0].value, "43877"));
    EXPECT_EQ(comparison.items[0].pairs.size(), 10U);
    ASSERT_EQ(comparison.results.size(), 5U);
    EXPECT_NEAR(std::abs(*comparison.results[0].en), 0.651083194409137, 1e-6);
    EXPECT_EQ(comparison.results[4].result, 4U);
    EXPECT_EQ(comparison.score_probability, 0.9545);
    EXPECT_EQ(comparison.summary->scores.points, 5U);
    EXPECT_EQ(comparison.participants.size(), 5U);
    EXPECT_TRUE(comparison.without_result.empty());
}

TEST(EvaluateLaboratories, OneItemDoesNotLoseTheOthers) {
    test::StatedComparison stated = test::key_comparison();
    stated.scheme.items.push_back(stated.scheme.items.front());
    stated.scheme.items[1].id = "ring";
    ParticipantResult alone = stated.results.front();
    alone.item = 1;
    stated.results.push_back(alone);
    std::vector<std::string> told;
    const LaboratoryComparison comparison =
        evaluate_laboratories(stated.scheme, stated.results, [&](const std::string& text) { told.push_back(text); });
    ASSERT_EQ(comparison.items.size(), 1U);
    EXPECT_EQ(comparison.items[0].item, 0U);
    ASSERT_EQ(comparison.without_result.size(), 1U);
    EXPECT_EQ(comparison.without_result[0].item, 1U);
    EXPECT_TRUE(comparison.without_result[0].refused_input);
    EXPECT_EQ(comparison.without_result[0].because.front().code, "GC-GUM-0131");
    EXPECT_THAT(told, testing::Contains("item 1 of 2"));
}

TEST(EvaluateLaboratories, PairsOfTooManyItemsAreLeftOut) {
    test::StatedComparison stated = test::comparison_of(std::vector<double>(40, 1.0), std::vector<double>(40, 0.1));
    const std::vector<ParticipantResult> once = stated.results;
    for (std::size_t item = 1; item < 13; ++item) {  // 13 times 780 pairs
        stated.scheme.items.push_back(stated.scheme.items.front());
        for (ParticipantResult result : once) {
            result.item = item;
            stated.results.push_back(std::move(result));
        }
    }
    const LaboratoryComparison comparison = evaluate_laboratories(stated.scheme, stated.results);
    EXPECT_TRUE(comparison.pairs_left_out);
    EXPECT_TRUE(comparison.items[0].pairs.empty());
}

/// Items of four laboratories with u = 0.1 whose results scatter by so many times ±(1, −1, 1, −1) u: χ² = 4 times the
/// square of it.
LaboratoryComparison with_scatter(const std::vector<double>& scatter) {
    test::StatedComparison stated = test::comparison_of({}, {});
    for (int i = 0; i < 4; ++i) {
        stated.scheme.participants.push_back(
            {.id = "L" + std::to_string(i), .name = "", .group = "", .cmc_U = std::nullopt});
    }
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::weighted_mean;
    stated.scheme.items.resize(scatter.size(), stated.scheme.items[0]);
    for (std::size_t item = 0; item < scatter.size(); ++item) {
        for (std::size_t p = 0; p < 4; ++p) {
            ParticipantResult& result = stated.results.emplace_back();
            result.participant = p;
            result.item = item;
            result.value = 5.0 + (p % 2 == 0 ? 0.1 : -0.1) * scatter[item];
            result.uncertainty = test::u_with_k_2(0.1);
        }
    }
    return evaluate_laboratories(stated.scheme, stated.results);
}

// One of 20 items with p = 0.03 is what chance makes at α = 5 %; one with p = 0.0003 is not, nor are six.
TEST(EvaluateLaboratories, AFewOfManyItemsFailByChance) {
    const double fails = 1.5;  // χ² = 9.0 of 3 degrees of freedom, p = 0.029
    std::vector<double> scatter(20, 0.5);
    scatter[7] = fails;
    const LaboratoryComparison one = with_scatter(scatter);
    EXPECT_FALSE(one.items[7].consistency->test.consistent);
    EXPECT_TRUE(one.items[7].consistency->by_chance);
    EXPECT_FALSE(one.items[6].consistency->by_chance);
    scatter[7] = 2.2;
    EXPECT_FALSE(with_scatter(scatter).items[7].consistency->by_chance);
    std::fill_n(scatter.begin(), 6, fails);
    scatter[7] = 0.5;
    EXPECT_FALSE(with_scatter(scatter).items[0].consistency->by_chance);
    // An item alone is no family: its test has the level that it states.
    EXPECT_FALSE(with_scatter({fails}).items[0].consistency->by_chance);
    EXPECT_FALSE(with_scatter({fails, fails}).items[0].consistency->by_chance);
}

TEST(EvaluateLaboratories, RefusesNoResults) {
    const test::StatedComparison stated = test::key_comparison();
    EXPECT_EQ(code_of<InputError>([&] { (void)evaluate_laboratories(stated.scheme, {}); }), "GC-COMPARE-0112");
}

TEST(EvaluateLaboratories, RefusesAResultOfNobody) {
    test::StatedComparison stated = test::key_comparison();
    stated.results[2].participant = 6;
    EXPECT_EQ(code_of<InputError>([&] { (void)evaluate_laboratories(stated.scheme, stated.results); }),
              "GC-COMPARE-0113");
}

}  // namespace
}  // namespace gumcert::gum
