#include "reports/record/comparison_scores.h"

#include <gtest/gtest.h>

namespace gumcert::reports {
namespace {

ComparisonPoint scored_point() {
    ComparisonPoint point;
    point.D = {0.3, "0.30"};
    point.En = {0.5, "0.50"};
    point.zeta = {1.25, "1.25"};
    point.z = {-1.5, "-1.50"};
    point.z_prime = {-0.75, "-0.75"};
    point.P_A = {12.0, "12"};
    return point;
}

TEST(ComparisonScores, EachNameHasItsOwnNumberAndText) {
    const ComparisonPoint point = scored_point();
    const auto expect = [&](const char* name, double number, const char* text) {
        EXPECT_EQ(score_of(point, name).number, number) << name;
        EXPECT_EQ(score_of(point, name).text, text) << name;
    };
    expect("D", 0.3, "0.30");
    expect("En", 0.5, "0.50");
    expect("zeta", 1.25, "1.25");
    expect("z", -1.5, "-1.50");
    expect("z_prime", -0.75, "-0.75");
}

TEST(ComparisonScores, WhatIsNoScoreOrIsNotThereIsEmpty) {
    for (const char* const name : {"", "P_A", "none", "en"}) {
        EXPECT_FALSE(score_of(scored_point(), name).number) << name;
        EXPECT_EQ(score_of(scored_point(), name).text, "") << name;
    }
    EXPECT_FALSE(score_of(ComparisonPoint{}, "En").number);
    EXPECT_EQ(score_of(ComparisonPoint{}, "En").text, "");
}

}  // namespace
}  // namespace gumcert::reports
