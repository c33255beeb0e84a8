#include "reports/record/make/budget/budget_fit_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "gum/budget/budget_covariance.h"
#include "gum/budget/evaluate_budget.h"
#include "reports/record/make/budget/budget_record.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/case_count.h"

namespace gumcert::reports {
namespace {

using reports::BudgetRow;
using reports::EvaluationRecord;

EvaluationRecord record_of_fit(const jobs::BudgetJob& job) {
    const gum::BudgetResult result = gum::evaluate_budget(job, 1);
    return budget_record(job, result, {}, gum::budget_covariance(result), "");
}

/// A straight line through points with u_y 0.1 and residuals of a given size.
std::string line(double residual, const std::string& more = "", const std::string& data = "\"u_y\": 0.1") {
    const std::string r = std::to_string(residual);
    return R"("model": ["z = a + b*q"], "inputs": {"q": {"value": 2, "u": 0.001}}, "fits": {"f": {
        "equation": "y = a + b*x", "parameters": {"a": {}, "b": {}}, )" +
           more + R"("data": {"x": [0, 1, 2, 3, 4, 5], "y": [)" + r + ", " + std::to_string(1.0 - residual) + ", " +
           std::to_string(2.0 - residual) + ", " + std::to_string(3.0 + residual) + ", " +
           std::to_string(4.0 + residual) + ", " + std::to_string(5.0 - residual) + "], " + data + "}}}";
}

TEST(BudgetFitRecord, TestsTheStatedUncertainties) {
    const auto consistency = [](double residual, const std::string& more = "") {
        return record_of_fit(jobs::test::read_budget(line(residual, more))).fits.at(0).consistency;
    };
    EXPECT_EQ(consistency(0.1), "consistent");
    EXPECT_EQ(consistency(1.0), "refuted");
    EXPECT_EQ(consistency(0.0001), "overstated");
    EXPECT_EQ(consistency(1.0, R"("scale_by_residuals": true, )"), "");
}

TEST(BudgetFitRecord, OffersWhatScalingByTheResidualsGives) {
    const EvaluationRecord refuted = record_of_fit(jobs::test::read_budget(line(1.0)));
    const EvaluationRecord scaled =
        record_of_fit(jobs::test::read_budget(line(1.0, R"("scale_by_residuals": true, )")));
    for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_TRUE(refuted.fits[0].parameters[i].scaled_u.number);
        EXPECT_NEAR(*refuted.fits[0].parameters[i].scaled_u.number, scaled.fits[0].parameters[i].u.number,
                    1e-12 * scaled.fits[0].parameters[i].u.number);
        EXPECT_FALSE(scaled.fits[0].parameters[i].scaled_u.number);
    }
}

TEST(BudgetFitRecord, LeavesOutWhatHasNoMeaning) {
    const EvaluationRecord both = record_of_fit(jobs::test::read_budget(line(0.1, "", R"("u_y": 0.1, "u_x": 0.05)")));
    EXPECT_FALSE(both.fits[0].r_squared.number);
    EXPECT_EQ(both.fits[0].r_squared.text, "");
    EXPECT_TRUE(record_of_fit(jobs::test::read_budget(line(0.1))).fits[0].r_squared.number);
}

TEST(BudgetFitRecord, PrintsTheDataWithTheirUncertainties) {
    const reports::FitSummary fit =
        record_of_fit(jobs::test::read_budget(line(0.1, "", R"("u_y": 0.1, "u_x": 0.05)"))).fits.at(0);
    EXPECT_EQ(fit.x.text, (std::vector<std::string>{"0", "1", "2", "3", "4", "5"}));
    EXPECT_EQ(fit.y.text,
              (std::vector<std::string>{"0.100000", "0.900000", "1.900000", "3.100000", "4.100000", "4.900000"}))
        << "as they are written";
    EXPECT_EQ(fit.u_x.text, std::vector<std::string>(6, "0.050"));
    EXPECT_EQ(fit.u_y.text, std::vector<std::string>(6, "0.10"));
    EXPECT_EQ(fit.residual.text.size(), 6U);
}

/// Over generated fits: the row of a fit is what the variance has beyond the inputs, its data add up to it, and no
/// share exceeds 100 %.
TEST(BudgetFitRecord, RowsOfFitsAddUpToTheVariance) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int trial = 0; trial < gumcert::test::cases(24, 60); ++trial) {  // of six kinds
        std::string x;
        std::string y;
        std::string u_x;
        std::string u_y;
        const int n = 4 + static_cast<int>(6.0 * uniform(random));
        for (int i = 0; i < n; ++i) {
            const std::string comma = i == 0 ? "" : ", ";
            x += comma + std::to_string(i + 0.3 * uniform(random));
            y += comma + std::to_string(2.0 + 3.0 * i + uniform(random));
            u_x += comma + std::to_string(0.01 + uniform(random));
            u_y += comma + std::to_string(0.01 + uniform(random));
        }
        std::string data = "\"x\": [" + x + "], \"y\": [" + y + "]";
        data += trial % 3 > 0 ? ", \"u_y\": [" + u_y + "]" : "";
        data += trial % 3 == 2 ? ", \"u_x\": [" + u_x + "]" : "";
        const bool quadratic = trial % 2 == 0;
        const std::string q = std::to_string(10.0 * uniform(random));
        const jobs::BudgetJob job = jobs::test::read_budget(
            std::string(R"("model": ["z = a + b*q)") + (quadratic ? " + c*q^2" : "") +
            R"("], "inputs": {"q": {"value": )" + q + R"(, "u": 0.1}}, "fits": {"f": {"equation": "y = a + b*x)" +
            (quadratic ? " + c*x^2" : "") + R"(", "parameters": {"a": {}, "b": {})" +
            (quadratic ? R"(, "c": {})" : "") + R"(}, "data": {)" + data + "}}}");
        const EvaluationRecord record = record_of_fit(job);
        const reports::Result& z = record.results.at(0);
        ASSERT_EQ(z.budget.size(), 2U);
        EXPECT_FALSE(z.correlation);
        const BudgetRow& fit = z.budget[1];
        ASSERT_EQ(fit.role, "fit");
        EXPECT_NEAR(std::hypot(z.budget[0].contribution.number, fit.contribution.number), z.u, 1e-10 * z.u);
        EXPECT_LE(fit.share.number, 1.0 + 1e-12);
        double squares = 0.0;
        std::size_t sources = 0;
        for (const BudgetRow& part : fit.components) {
            if (part.role == "fit_data") {
                squares += part.contribution.number * part.contribution.number;
                EXPECT_GT(part.contribution.number, 0.0);
                ++sources;
            }
        }
        EXPECT_EQ(sources, trial % 3 == 2 ? 2U : 1U);
        EXPECT_NEAR(std::sqrt(squares), fit.contribution.number, 1e-10 * fit.contribution.number);
        EXPECT_EQ(fit.components.size(), sources + (quadratic ? 3U : 2U));
    }
}

/// The part of the abscissae is what is left when the ordinates get exact, and the other way round.
TEST(BudgetFitRecord, SplitsTheVarianceByColumn) {
    const auto part_of = [](const std::string& data, std::size_t part) {
        const EvaluationRecord record = record_of_fit(jobs::test::read_budget(line(0.1, "", data)));
        return record.results.at(0).budget.at(1).components.at(part).contribution.number;
    };
    const double alone = part_of(R"("u_y": 0.1)", 0);
    EXPECT_NEAR(part_of(R"("u_y": 0.1, "u_x": 0.0001)", 0), alone, 1e-5 * alone);
    EXPECT_LT(part_of(R"("u_y": 0.1, "u_x": 0.0001)", 1), 0.0011 * alone);
    // Equal standard uncertainties of y and of b x, b near 1: halves of the variance.
    const double y = part_of(R"("u_y": 0.1, "u_x": 0.1)", 0);
    const double x = part_of(R"("u_y": 0.1, "u_x": 0.1)", 1);
    EXPECT_NEAR(x / y, 1.0, 0.05);
}

TEST(BudgetFitRecord, ParametersAreResultsOfTheirData) {
    const jobs::BudgetJob job = jobs::test::read_budget(R"("fits": {"f": {"equation": "y = a + b*x",
        "parameters": {"a": {}, "b": {}}, "data": {"x": [0, 1, 2, 3], "y": [0, 1.1, 1.9, 3.2], "u_y": 0.1, "u_x": 0.1}}})");
    const EvaluationRecord record = record_of_fit(job);
    ASSERT_EQ(record.results.size(), 2U);
    for (const reports::Result& result : record.results) {
        ASSERT_EQ(result.budget.size(), 1U) << result.name;
        const BudgetRow& row = result.budget[0];
        EXPECT_EQ(row.input, "f");
        EXPECT_NEAR(row.contribution.number, result.u, 1e-12 * result.u);
        ASSERT_EQ(row.components.size(), 3U);
        EXPECT_EQ(row.components[0].input, "y");
        EXPECT_EQ(row.components[1].input, "x");
        EXPECT_EQ(row.components[2].input, result.name);
    }
}

/// Where x lies far from 0 the rows are those of the same fit: no share of 196 %, and no contribution of 0 beside u.
TEST(BudgetFitRecord, RowsOfFitsFarFromZeroAddUpToTheVariance) {
    for (const char* more : {"", R"(, "u_y": 0.1)", R"(, "u_y": 0.1, "u_x": 0.001)"}) {
        for (const double centre : {100.0, 1550.0, 245900.0}) {
            const bool quadratic = std::string(more).find("u_x") == std::string::npos;
            if (quadratic && centre > 1e5) {
                continue;  // refused: its points do not determine three parameters (GC-FIT-0010)
            }
            const auto at = [&](int i) { return std::to_string(centre + 0.02 * i); };
            std::string x = at(0);
            for (int i = 1; i < 6; ++i) {
                x += ", " + at(i);
            }
            const std::string q = quadratic ? "a + b*q + c*q^2" : "a + b*q";
            const std::string curve = quadratic ? "a + b*x + c*x^2" : "a + b*x";
            const EvaluationRecord record = record_of_fit(jobs::test::read_budget(
                "\"model\": [\"z = " + q + R"("], "inputs": {"q": {"value": )" + at(2) +
                R"(, "constant": true}}, "fits": {"f": {"equation": "y = )" + curve +
                R"(", "parameters": {"a": {}, "b": {})" + (quadratic ? R"(, "c": {})" : "") + R"(}, "data": {"x": [)" +
                x + R"(], "y": [1.2, 1.5, 1.9, 2.1, 2.6, 2.9])" + more + "}}}"));
            const reports::Result& z = record.results.at(0);
            double squares = 0.0;
            double of_data = 0.0;
            for (const BudgetRow& row : z.budget) {
                squares += row.contribution.number * row.contribution.number;
                for (const BudgetRow& part : row.components) {
                    of_data += part.role == "fit_data" ? part.contribution.number * part.contribution.number : 0.0;
                }
            }
            EXPECT_GT(z.u, 0.01);
            EXPECT_LT(z.u, 0.2);
            const double rounding = (1e-15 * record.fits.at(0).condition_number + 1e-12) * z.u;
            EXPECT_NEAR(std::sqrt(squares), z.u, rounding) << curve << more << centre;
            EXPECT_NEAR(std::sqrt(of_data), z.u, rounding) << curve << more << centre;
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
