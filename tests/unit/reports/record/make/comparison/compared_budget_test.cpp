// What a comparison takes from a budget is what the budget reports by itself.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/make/budget/budget_record.h"
#include "reports/record/make/comparison/evaluate_comparison.h"
#include "reports/record/make/comparison/method_side.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/case_count.h"
#include "tests/support/comparison_campaign.h"
#include "text/numbers.h"

namespace gumcert::reports {
namespace {

using jobs::BudgetJob;
using jobs::test::read_budget;
using testing::Contains;
using testing::HasSubstr;

const gum::Unit k_mm_of_budgets = gum::Unit::parse("mm");

MethodSide compared(const BudgetJob& job, double coverage_probability = 0.9545) {
    MethodBudget budget{job, "budget.json", "Method", {}, {}};
    for (std::size_t i = 0; i < std::max<std::size_t>(job.points.size(), 1); ++i) {
        budget.point.push_back(i);
        budget.name.push_back(job.points.empty() ? "" : job.points[i].name);
    }
    return side_of_budget(budget, k_mm_of_budgets, coverage_probability);
}

/// Models and inputs of every kind that is reported in its own way: normal, t, convolution, and Monte Carlo because of
/// second order, kinks, asymmetry, a missing derivative, or because the job asks for it.
std::string generated_budget(std::uint64_t seed) {
    std::mt19937_64 draw(seed);
    const auto any = [&](double low, double high) {
        return text::shortest(std::uniform_real_distribution<double>(low, high)(draw));
    };
    const auto one_of = [&](const std::vector<std::string>& choices) { return choices[draw() % choices.size()]; };
    const std::string model =
        one_of({"y = a + b", "y = a * cos(f) + b", "y = a + abs(b)", "y = a + 0.02 * exp(30 * c) * b", "y = a + b",
                "y = a + sqrt(b * b + 4 * b * b)"});
    const std::string a =
        one_of({R"({"value": 100, "unit": "mm", "u": )" + any(0.0001, 0.1) + "}",
                R"({"value": 100, "unit": "mm", "u": )" + any(0.001, 0.01) + R"(, "nu": 3})",
                R"({"observations": [100.01, 100.012, )" + any(100.0, 100.02) + R"(], "unit": "mm"})"});
    const std::string b =
        one_of({R"({"value": 0.1, "unit": "mm", "half_width": )" + any(0.001, 0.09) + R"(, "distribution": "uniform"})",
                R"({"unit": "mm", "distribution": {"kind": "exponential", "mean": )" + any(0.001, 0.05) + "}}",
                R"({"observations": [0.1, )" + any(0.101, 0.2) + R"(], "unit": "mm"})",
                R"({"value": 0, "unit": "mm", "u": )" + any(0.001, 0.05) + "}"});
    std::string keys = "\"model\": [\"" + model + "\"], \"inputs\": {\"a\": " + a + ", \"b\": " + b;
    if (model.find('f') != std::string::npos) {
        keys +=
            R"(, "f": {"value": 0, "unit": "deg", "half_width": )" + any(0.1, 1.0) + R"(, "distribution": "uniform"})";
    }
    if (model.find('c') != std::string::npos && model.find("exp") != std::string::npos) {
        keys += R"(, "c": {"value": 0.01, "u": )" + any(0.001, 0.02) + "}";
    }
    keys += R"(}, "outputs": {"y": {"unit": "mm"}})";
    keys += R"(, "coverage_probability": )" + one_of({"0.95", "0.9545", "0.99", "0.6827"});
    keys += one_of({"", R"(, "coverage": "monte_carlo")", R"(, "coverage": "law_of_propagation")", ""});
    keys += R"(, "monte_carlo": {"trials": 20000, "seed": )" + std::to_string(seed + 1) + "}";
    if (draw() % 3 == 0) {
        std::string at_point = a;  // in the unit of the input
        at_point.erase(at_point.find(R"(, "unit": "mm")"), std::string(R"(, "unit": "mm")").size());
        keys += R"(, "points": [{"point": "P", "a": )" + at_point + R"(}, {"point": "Q", "a": )" + at_point + "}]";
    }
    return keys;
}

TEST(ComparedBudget, IsWhatTheBudgetReports) {
    std::size_t by_trials = 0, of_interval = 0, by_convolution = 0, refused = 0, converted = 0;
    const std::uint64_t budgets = test::cases(60U, 120U);
    for (std::uint64_t seed = 1; seed <= budgets; ++seed) {
        const std::string keys = generated_budget(seed);
        SCOPED_TRACE(keys);
        BudgetJob job = read_budget(keys);
        job.warnings.clear();  // of its reader, which the comparison has from its own
        gum::BudgetResult result;
        try {
            result = gum::evaluate_budget(job, 1);
        } catch (const gum::NoResultError&) {
            EXPECT_THROW((void)compared(job), gum::NoResultError);
            continue;
        }
        const EvaluationRecord run = budget_record(job, result, {}, {}, "");
        const bool lacks_u = std::any_of(run.results.begin(), run.results.end(), [](const Result& of) {
            return !of.reported.u || !(*of.reported.u > 0.0) || !of.reported.interval;
        });
        if (lacks_u) {
            ++refused;
            EXPECT_THROW((void)compared(job), gum::NoResultError);
            continue;
        }
        const MethodSide side = compared(job);
        ASSERT_EQ(side.value.size(), run.results.size());
        for (std::size_t i = 0; i < side.value.size(); ++i) {
            const ReportedResult& reported = run.results[i].reported;
            const gum::ResultUncertainty& taken = side.uncertainty[i];
            EXPECT_EQ(side.value[i], reported.value);
            EXPECT_EQ(taken.u, *reported.u);
            EXPECT_EQ(taken.coverage_probability, reported.coverage_probability);
            EXPECT_NEAR(std::sqrt(side.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i))), taken.u,
                        1e-9 * taken.u);
            if (reported.U) {
                EXPECT_EQ(taken.U, *reported.U);
                EXPECT_NEAR(taken.k, *reported.k, 1e-12 * taken.k);
            } else {
                // value ± U holds p: it reaches at least to the nearer end, and not beyond the farther one.
                ++of_interval;
                const double low = reported.value - (*reported.interval)[0];
                const double high = (*reported.interval)[1] - reported.value;
                EXPECT_GE(taken.U, 0.99 * std::min(low, high));
                EXPECT_LE(taken.U, 1.01 * std::max(low, high));
            }
            ASSERT_TRUE(taken.of_scores);
            const bool is_about_95 = reported.coverage_probability >= 0.94 && reported.coverage_probability <= 0.96;
            EXPECT_EQ(taken.of_scores->converted, !is_about_95);
            if (is_about_95) {
                EXPECT_EQ(taken.of_scores->U, taken.U);
            } else {
                ++converted;
                EXPECT_EQ(taken.of_scores->U > taken.U, reported.coverage_probability < 0.9);
                if (reported.method == "law_of_propagation") {
                    BudgetJob of_scores = job;
                    of_scores.coverage_probability = 0.9545;
                    EXPECT_EQ(taken.of_scores->U,
                              *budget_record(of_scores, gum::evaluate_budget(of_scores, 1), {}, {}, "").results[i].U);
                }
            }
            by_trials += reported.method == "monte_carlo" ? 1U : 0U;
            by_convolution += run.results[i].coverage == "convolution" ? 1U : 0U;
        }
        std::set<std::string> said;
        for (const gum::Diagnostic& of_run : run.diagnostics) {
            if (said.insert(of_run.code).second) {  // one of a kind stands for all of them
                EXPECT_THAT(side.remarks, Contains(HasSubstr(gum::message(of_run)))) << of_run.code;
            }
        }
        for (const std::string& remark : side.remarks) {
            if (keys.find("law_of_propagation") == std::string::npos) {
                EXPECT_THAT(remark, testing::Not(HasSubstr("because the job asks for it, although")));
            }
        }
    }
    // Each way of reporting is among them.
    EXPECT_GT(by_trials, budgets / 12U);
    EXPECT_GT(of_interval, budgets / 120U);
    EXPECT_GT(by_convolution, budgets / 24U);
    EXPECT_GT(converted, budgets / 12U);
    EXPECT_GT(refused, 0U);
}

// ---- verdicts that this turns ---------------------------------------------------------------------------------------

/// A gauge that stands askew by up to half a degree, measured by its projection.
std::string askew(const std::string& of_angle = "") {
    return jobs::test::budget_text(
        R"j("model": ["h = L * cos(f)"], "inputs": {"L": {"value": 100, "u": 5e-05, "unit": "mm"},
            "f": {"value": 0, "half_width": 0.5, "unit": "deg")j" +
        of_angle + R"(}}, "outputs": {"h": {"unit": "mm"}})");
}

TEST(ComparedBudget, ScoresAgainstTheMeanOfTrials) {
    const jobs::ComparisonJob job = jobs::test::read_comparison(
        R"("unit": "mm", "participants": [{"id": "A", "budget": "a.json"}, {"id": "B", "value": 100.0005, "u": 0.0003}],
           "assigned_value": {"value": 100.001, "u": 0.00015})",
        {{"a.json", askew()}});
    const Comparison comparison = evaluate_laboratories(job, {});
    // E cos f = sin a / a and its variance for f uniform within a.
    const double a = 0.5 * std::acos(-1.0) / 180.0;
    const double mean = std::sin(a) / a;
    const double u = 100.0 * std::sqrt(0.5 + std::sin(2.0 * a) / (4.0 * a) - mean * mean);
    const ComparisonPoint& point = comparison.points.front();
    EXPECT_NEAR(point.D.number, 100.0 * mean - 100.001, 3e-5);
    EXPECT_NEAR(*point.u, u, 2e-5);
    EXPECT_NEAR(*point.zeta.number, (100.0 * mean - 100.001) / std::hypot(u, 0.00015), 0.05);
    EXPECT_LT(std::abs(*point.En.number), 1.3);  // −3.2 against the estimate of the law
    EXPECT_THAT(comparison.remarks,
                Contains(HasSubstr("the result of Monte Carlo is reported, because second-order terms")));
    EXPECT_THAT(comparison.remarks, Contains(HasSubstr("does not lie symmetric")));
}

TEST(ComparedBudget, MethodsAgreeWithTheResultOfTrials) {
    const jobs::ComparisonJob job = jobs::test::read_comparison(
        R"("unit": "mm", "correlation": "none", "lab": {"name": "m", "budget": "a.json"},
           "reference": {"name": "r", "points": [{"point": "1", "value": 99.99873, "u": 0.0001}]})",
        {{"a.json", askew()}});
    const Comparison comparison = evaluate_methods(job);
    EXPECT_LT(std::abs(*comparison.points.front().En.number), 0.2);
    EXPECT_EQ(comparison.summary.front().count_above_1, 0);
}

TEST(ComparedBudget, RefusesASharedSourceThatFirstOrderTermsDoNotTellOf) {
    const std::string shared = R"(, "source": "level")";
    const auto read = [&](const std::string& keys) {
        return jobs::test::read_comparison(
            R"("unit": "mm", "participants": [{"id": "A", "budget": "a.json"}, {"id": "B", "value": 100, "u": 0.001,
               "sources": [{"source": "level", "u": 0.0005}]}], "assigned_value": {"value": 100, "u": 0.001})" +
                keys,
            {{"a.json", askew(shared)}});
    };
    try {
        (void)evaluate_laboratories(read(""), {});
        ADD_FAILURE();
    } catch (const gum::InputError& refused) {
        EXPECT_EQ(refused.diagnostics().front().code, "GC-COMPARE-0210");
        EXPECT_THAT(refused.diagnostics().front().what, HasSubstr("level"));
    }
    EXPECT_NO_THROW((void)evaluate_laboratories(read(R"(, "independent_sources": ["level"])"), {}));
}

TEST(ComparedBudget, RefusesADistributionWithoutAVariance) {
    const BudgetJob job =
        read_budget(R"("model": ["y = a"], "coverage": "monte_carlo", "outputs": {"y": {"unit": "mm"}},
        "inputs": {"a": {"observations": [1.0, 1.1], "unit": "mm"}})");
    try {
        (void)compared(job);
        ADD_FAILURE();
    } catch (const gum::NoResultError& refused) {
        EXPECT_EQ(refused.diagnostics().front().code, "GC-COMPARE-0208");
    }
}

/// k of a convolution: two readings that dominate, and a rectangle that does.
TEST(ComparedBudget, TakesUWithTheFactorOfItsDistribution) {
    const std::string readings = jobs::test::budget_text(
        R"("model": ["y = a + b"], "inputs": {"a": {"observations": [10.7, 10.9], "unit": "mg"},
           "b": {"value": 0, "half_width": 0.2, "unit": "mg", "distribution": "uniform"}}, "outputs": {"y": {"unit": "mg"}})");
    const std::string rectangle = jobs::test::budget_text(
        R"("model": ["y = a + b"], "inputs": {"a": {"value": 10.26, "u": 0.01, "unit": "mg"},
           "b": {"value": 0, "half_width": 0.2, "unit": "mg", "distribution": "uniform"}}, "outputs": {"y": {"unit": "mg"}})");
    const jobs::ComparisonJob job = jobs::test::read_comparison(
        R"("unit": "mg", "participants": [{"id": "A", "budget": "a.json"}, {"id": "B", "budget": "b.json"}],
           "assigned_value": {"value": 10.05, "u": 0.02})",
        {{"a.json", readings}, {"b.json", rectangle}});
    const Comparison comparison = evaluate_laboratories(job, {});
    const double U_X = *comparison.items.front().U.number;
    for (std::size_t i = 0; i < 2; ++i) {
        const ComparisonPoint& point = comparison.points[i];
        EXPECT_FALSE(point.U_of_scores.number);
        EXPECT_EQ(point.coverage_probability, 0.9545);
        EXPECT_NEAR(*point.En.number, point.D.number / std::hypot(*point.U.number, U_X), 1e-9);
    }
    EXPECT_GT(*comparison.points[0].k.number, 5.0);
    EXPECT_EQ(comparison.points[0].signal, "none");
    EXPECT_LT(*comparison.points[1].k.number, 1.8);
    EXPECT_EQ(comparison.points[1].signal, "action");
    EXPECT_THAT(comparison.remarks, testing::Not(Contains(HasSubstr("not those of about 95 %"))));
    EXPECT_THAT(comparison.remarks, Contains(HasSubstr("Budget of A: U = ")));
}

}  // namespace
}  // namespace gumcert::reports
