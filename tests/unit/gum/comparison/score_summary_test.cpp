#include "gum/comparison/score_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/unit/gum/comparison/stated_comparison.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

std::vector<EvaluatedItem> evaluated_items(const test::StatedComparison& stated) {
    std::vector<EvaluatedItem> items;
    for (LaboratoryData& data : laboratory_data(stated.scheme, stated.results)) {
        std::vector<SharedSource> shared;
        relate_results(stated.scheme, data, shared);
        EvaluatedItem item{.data = data, .assigned = assigned_value(stated.scheme, data), .result = {}, .scores = {}};
        item.result = item_result(stated.scheme, data, item.assigned);
        item.scores = scored_results(stated.scheme, data, item.assigned, item.result);
        items.push_back(std::move(item));
    }
    return items;
}

/// Two items with given values 10 and D of 1, 2, 3 times `first` and `second` for three laboratories, U_D = 1.
test::StatedComparison two_items(double first, double second) {
    test::StatedComparison stated;
    for (const char* id : {"A", "B"}) {
        ComparisonItem& item = stated.scheme.items.emplace_back();
        item.id = id;
        item.unit = Unit::parse("mm");
        item.assigned_value.method = AssignedValueMethod::given;
        item.assigned_value.value = 10.0;
        item.assigned_value.uncertainty = test::u_with_k_2(0.3);
    }
    for (int i = 1; i <= 3; ++i) {
        ParticipantResult of_b = stated.add("L" + std::to_string(i), 10.0 + first * i, test::u_with_k_2(0.4));
        of_b.item = 1;
        of_b.value = 10.0 + second * i;
        stated.results.push_back(of_b);
    }
    return stated;
}

TEST(ScoreSummary, CountsAndSizesOfAllResults) {
    const test::StatedComparison stated = two_items(0.4, 0.2);
    const ScoreSummary summary = summary_of_scores(stated.scheme, evaluated_items(stated)).value();
    EXPECT_EQ(summary.scores.points, 6U);
    EXPECT_EQ(summary.scores.count_above_1, 1U);
    EXPECT_NEAR(summary.scores.mean_absolute_en, (0.4 + 0.8 + 1.2 + 0.2 + 0.4 + 0.6) / 6.0, 1e-12);
    EXPECT_NEAR(summary.scores.largest_absolute_en, 1.2, 1e-12);
    EXPECT_NEAR(*summary.d_fail_smallest, 1.0, 1e-12);
    EXPECT_FALSE(summary.worst);
    EXPECT_FALSE(summary.agreement) << "two items share their laboratories";
}

TEST(ScoreSummary, ProbabilityOfTheScoresOfOneItem) {
    const test::StatedComparison stated = test::key_comparison();
    const ScoreSummary summary = summary_of_scores(stated.scheme, evaluated_items(stated)).value();
    ASSERT_TRUE(summary.agreement);
    EXPECT_LT(summary.agreement->p_high, 0.01) << "chi-square has p = 0.0018";
    EXPECT_LT(summary.agreement->effective_points, 6.0);
}

TEST(ScoreSummary, NothingWithoutEn) {
    test::StatedComparison stated = test::results_of_iso_13528_e1();
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::algorithm_a;
    EXPECT_FALSE(summary_of_scores(stated.scheme, evaluated_items(stated)));
    EXPECT_FALSE(participant_summaries(stated.scheme, evaluated_items(stated))[0].scores);
}

TEST(ParticipantSummaries, OverAllItems) {
    const test::StatedComparison stated = two_items(0.4, 0.2);
    const std::vector<ParticipantSummary> summaries = participant_summaries(stated.scheme, evaluated_items(stated));
    ASSERT_EQ(summaries.size(), 3U);
    EXPECT_EQ(summaries[2].results, 2U);
    EXPECT_EQ(summaries[2].scored, 2U);
    EXPECT_EQ(summaries[2].actions, 1U);
    EXPECT_NEAR(summaries[2].scores->largest_absolute_en, 1.2, 1e-12);
    EXPECT_NEAR(summaries[0].scores->rms_en, std::sqrt((0.16 + 0.04) / 2.0), 1e-12);
}

TEST(VectorScores, OfIndependentQuantities) {
    test::StatedComparison stated = two_items(0.3, 0.4);
    stated.scheme.vectors = {{.name = "xy", .items = {0, 1}, .correlation = {}, .reference_correlation = {}}};
    std::size_t left_out = 7;
    const std::vector<VectorScore> scores = vector_scores(stated.scheme, evaluated_items(stated), left_out);
    ASSERT_EQ(scores.size(), 3U);
    EXPECT_EQ(left_out, 0U);
    EXPECT_EQ(scores[1].participant, 1U);
    EXPECT_EQ(scores[1].quantities, 2U);
    // (0.6² + 0.8²)/u_D² with u_D = 0.5, over k² = −2 ln(1 − p).
    EXPECT_NEAR(scores[1].mahalanobis_square, 4.0, 1e-9);
    EXPECT_NEAR(scores[1].vector_en, std::sqrt(4.0 / (-2.0 * std::log(1.0 - 0.9545))), 1e-9);
    stated.scheme.vectors[0].correlation = Eigen::MatrixXd::Ones(2, 2);
    stated.scheme.vectors[0].reference_correlation = Eigen::MatrixXd::Ones(2, 2);
    EXPECT_TRUE(vector_scores(stated.scheme, evaluated_items(stated), left_out).empty());
    EXPECT_EQ(left_out, 3U) << "singular";
}

TEST(YoudenDiagrams, EllipseAboutTheMedians) {
    test::StatedComparison stated = two_items(0.3, 0.6);
    stated.scheme.youden = {{0, 1}};
    const std::vector<YoudenDiagram> diagrams = youden_diagrams(stated.scheme, evaluated_items(stated));
    ASSERT_EQ(diagrams.size(), 1U);
    const YoudenDiagram& diagram = diagrams.front();
    EXPECT_NEAR(diagram.centre_first, 0.6, 1e-12);
    EXPECT_NEAR(diagram.scale_second, 1.483 * 0.6, 1e-12);
    EXPECT_NEAR(diagram.correlation, 1.0, 1e-12) << "the same order in both";
    EXPECT_FALSE(diagram.sigma_first);
    ASSERT_EQ(diagram.points.size(), 3U);
    EXPECT_NEAR(diagram.points[2].second, 1.8, 1e-12);
    ASSERT_EQ(diagram.ellipse.size(), 73U);
    EXPECT_EQ(diagram.ellipse.front(), diagram.ellipse.back());
    // k = √(−2 ln 0.05) along the first axis.
    EXPECT_NEAR(diagram.ellipse[0].first, 0.6 + 1.483 * 0.3 * std::sqrt(-2.0 * std::log(0.05)), 1e-9);
}

}  // namespace
}  // namespace gumcert::gum
