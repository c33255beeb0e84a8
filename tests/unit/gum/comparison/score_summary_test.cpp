#include "gum/comparison/score_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "gum/comparison/scores.h"
#include "gum/coverage.h"
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

// What results share with each other makes their joint distribution unknown, whatever it does to the scores one by one.
TEST(ScoreSummary, NoJointProbabilityWhereAGroupIsUnknown) {
    for (const AssignedValueMethod method : {AssignedValueMethod::weighted_mean, AssignedValueMethod::given,
                                             AssignedValueMethod::reference, AssignedValueMethod::arithmetic_mean}) {
        test::StatedComparison stated = test::comparison_of({10.0, 10.1, 10.2, 9.9}, {0.1, 0.1, 0.1, 0.1});
        AssignedValueRequest& request = stated.scheme.items[0].assigned_value;
        request.method = method;
        request.participant = "L1";
        request.value = 10.0;
        request.uncertainty = test::u_with_k_2(0.05);
        EXPECT_TRUE(summary_of_scores(stated.scheme, evaluated_items(stated))->agreement);
        stated.scheme.participants[0].group = stated.scheme.participants[1].group = "G";
        EXPECT_FALSE(summary_of_scores(stated.scheme, evaluated_items(stated))->agreement) << static_cast<int>(method);
        stated.scheme.correlations = {{0, 1, 0.0}};
        EXPECT_TRUE(summary_of_scores(stated.scheme, evaluated_items(stated))->agreement) << "stated, as none";
    }
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
    // (0.6² + 0.8²)/u_D² with u_D = 0.5, over k² = −2 ln(1 − p). U_D has the stated k = 2, which is 2.00002 for p.
    const double k_1 = coverage_factor(0.9545, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(scores[1].mahalanobis_square, 4.0, 1e-9);
    EXPECT_NEAR(scores[1].vector_en, k_1 / 2.0 * std::sqrt(4.0 / (-2.0 * std::log(1.0 - 0.9545))), 1e-9);
    stated.scheme.vectors[0].correlation = Eigen::MatrixXd::Ones(2, 2);
    stated.scheme.vectors[0].reference_correlation = Eigen::MatrixXd::Ones(2, 2);
    EXPECT_TRUE(vector_scores(stated.scheme, evaluated_items(stated), left_out).empty());
    EXPECT_EQ(left_out, 3U) << "singular";
}

/// One item of five laboratories, of which two have few degrees of freedom, and a vector of nothing else.
test::StatedComparison single_quantity(AssignedValueMethod method, double coverage_probability) {
    test::StatedComparison stated = test::key_comparison();
    stated.scheme.coverage_probability = coverage_probability;
    AssignedValueRequest& request = stated.scheme.items[0].assigned_value;
    request.method = method;
    if (method == AssignedValueMethod::given) {
        request.value = 12.3;
        request.uncertainty = test::u_with_k_2(0.05);
    } else if (method == AssignedValueMethod::reference) {
        request.participant = "L1";
    } else if (method == AssignedValueMethod::median) {
        request.median_by_trials = true;
        request.trials = 20000;
    }
    stated.results[1].uncertainty = stated_expanded(0.15 * 2.57, 2.57);
    stated.results[1].uncertainty->degrees_of_freedom = 5.0;
    stated.results[2].uncertainty = stated_expanded(0.20, 1.0);
    stated.scheme.vectors = {{.name = "x", .items = {0}, .correlation = {}, .reference_correlation = {}}};
    return stated;
}

TEST(VectorScores, OfASingleQuantityAreItsEn) {
    // For every coverage probability and whatever E_n is formed from: stated or converted U, few degrees of freedom,
    // the scatter of the others.
    using enum AssignedValueMethod;
    for (const AssignedValueMethod method :
         {given, reference, weighted_mean, arithmetic_mean, median, algorithm_a, largest_consistent_subset,
          dersimonian_laird, mandel_paule, power_moderated_mean}) {
        for (const double p : {0.5, 0.90, 0.95, 0.9545, 0.99, 0.9973}) {
            const test::StatedComparison stated = single_quantity(method, p);
            const std::vector<EvaluatedItem> items = evaluated_items(stated);
            std::size_t left_out = 0;
            const std::vector<VectorScore> scores = vector_scores(stated.scheme, items, left_out);
            ASSERT_GE(scores.size(), 5U);
            EXPECT_EQ(left_out, 0U);
            for (const VectorScore& score : scores) {
                const double en = std::abs(*items[0].scores[score.participant].en);
                EXPECT_NEAR(score.vector_en, en, 1e-12 * en)
                    << "method " << static_cast<int>(method) << ", p = " << p << ", laboratory " << score.participant;
                EXPECT_EQ(score.largest_absolute_en, en);
            }
        }
    }
}

TEST(ScoreSummary, ChanceIsThatOfTheProbabilityOfEn) {
    // E_n is formed for 95.45 % where the comparison states another probability: so are the limits of what chance
    // explains of it.
    const ScoreSummary usual = [] {
        const test::StatedComparison stated = test::key_comparison();
        return summary_of_scores(stated.scheme, evaluated_items(stated)).value();
    }();
    for (const double p : {0.5, 0.90, 0.95, 0.99, 0.9973}) {
        test::StatedComparison stated = test::key_comparison();
        stated.scheme.coverage_probability = p;
        const ScoreSummary summary = summary_of_scores(stated.scheme, evaluated_items(stated)).value();
        ASSERT_TRUE(summary.agreement);
        const double of_scores = en_coverage_probability(p);
        const double n = static_cast<double>(summary.agreement->points);
        const auto k = [](double probability) {
            return coverage_factor(probability, std::numeric_limits<double>::infinity());
        };
        EXPECT_NEAR(summary.agreement->largest_en_by_chance, k(std::pow(0.99, 1.0 / n)) / k(of_scores), 1e-9) << p;
        if (of_scores == 0.9545) {
            EXPECT_EQ(summary.agreement->count_by_chance, usual.agreement->count_by_chance) << p;
            EXPECT_NEAR(summary.agreement->largest_en_by_chance, usual.agreement->largest_en_by_chance, 1e-9) << p;
            EXPECT_NEAR(summary.agreement->vector_en, usual.agreement->vector_en, 1e-9) << p;
        }
    }
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
