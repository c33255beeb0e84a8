#include "gum/rotary_table/fixture_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"
#include "tests/support/campaign.h"

namespace gumcert::gum {
namespace {

using jobs::RotaryTableJob;
using jobs::test::Files;
using jobs::test::replace;
using testing::HasSubstr;

constexpr double k_micro = 1e-6;

Files campaign_with_budget() {
    Files files = jobs::test::small_campaign();
    replace(files.at("job.json"), "\"coordinates\"", "\"budget\": \"fixture_budget.json\", \"coordinates\"");
    files["fixture_budget.json"] = jobs::test::small_fixture_budget();
    files["fixture_points.csv"] = jobs::test::small_fixture_points();
    return files;
}

/// Covariance of the results of the joint model by the law of propagation, from its own inputs and Jacobian.
Eigen::MatrixXd propagated(const MeasurementModel& model) {
    return propagate(model, 0.9545).covariance;
}

double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST(FixtureBudget, GivesTheCovarianceOfTheCoordinates) {
    RotaryTableJob job = jobs::test::read(campaign_with_budget());
    const FixtureUncertainty fixture = apply_fixture_budget(job);
    const Eigen::MatrixXd& V = job.measurement.fixture_covariance;
    ASSERT_EQ(V.rows(), 12);
    // u² = 0.3² + (1e-6 l)², covariances l_i l_j 1e-12: by hand.
    for (Eigen::Index i = 0; i < 12; ++i) {
        for (Eigen::Index j = 0; j < 12; ++j) {
            const double expected =
                1e-12 * job.measurement.fixture(i / 3, i % 3) * job.measurement.fixture(j / 3, j % 3) +
                (i == j ? 0.09 * k_micro * k_micro : 0.0);
            EXPECT_NEAR(V(i, j), expected, 1e-12 * 0.09 * k_micro * k_micro) << i << ", " << j;
        }
    }
    EXPECT_EQ(fixture.largest, 6U);  // R3.x
    EXPECT_THAT(fixture.notes, testing::IsEmpty());
}

TEST(FixtureBudget, FollowsTheOrderOfTheCoordinatesNotOfThePoints) {
    Files files = campaign_with_budget();
    RotaryTableJob first = jobs::test::read(files);
    const FixtureUncertainty in_order = apply_fixture_budget(first);
    std::string& points = files.at("fixture_points.csv");
    replace(points, "R1.x,33.25\n", "");
    points += "R1.x,33.25\n";
    RotaryTableJob second = jobs::test::read(files);
    const FixtureUncertainty other = apply_fixture_budget(second);
    EXPECT_EQ(first.measurement.fixture_covariance, second.measurement.fixture_covariance);
    ASSERT_EQ(other.model->outputs().size(), 12U);
    EXPECT_EQ(other.model->outputs().front().name, "R1.x");
    EXPECT_EQ(other.model->outputs().front().unit, "m");
    EXPECT_EQ(in_order.model->evaluate(input_estimates(*in_order.model)),
              other.model->evaluate(input_estimates(*other.model)));
}

TEST(FixtureBudget, JointModelHasTheCovarianceAndTheValuesOfThePoints) {
    RotaryTableJob job = jobs::test::read(campaign_with_budget());
    const FixtureUncertainty fixture = apply_fixture_budget(job);
    EXPECT_LT(largest_difference(propagated(*fixture.model), job.measurement.fixture_covariance), 1e-12);
    const Eigen::VectorXd y = fixture.model->evaluate(input_estimates(*fixture.model));
    for (Eigen::Index i = 0; i < 12; ++i) {
        EXPECT_NEAR(y(i), job.measurement.fixture(i / 3, i % 3), 1e-12);
    }
}

TEST(FixtureBudget, JointModelDrawsWhatThePointsHaveInCommonTogether) {
    RotaryTableJob job = jobs::test::read(campaign_with_budget());
    const FixtureUncertainty fixture = apply_fixture_budget(job);
    MonteCarloOptions options;
    options.trials = 100'000;
    options.threads = 1;
    const MonteCarloResult result = run_monte_carlo(*fixture.model, options);
    const Eigen::MatrixXd& V = job.measurement.fixture_covariance;
    for (Eigen::Index i = 0; i < 12; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) {
            // Standard deviation of an estimated covariance of normal quantities, five times.
            const double tolerance = 5.0 * std::sqrt((V(i, i) * V(j, j) + V(i, j) * V(i, j)) / 1e5);
            EXPECT_NEAR(result.covariance(i, j), V(i, j), tolerance) << i << ", " << j;
        }
    }
}

TEST(FixtureBudget, JointModelTakesOneProbabilityWhereACommonInputDiffersBetweenPoints) {
    // A common error in percent of the coordinate: another half-width at each point.
    Files files = campaign_with_budget();
    replace(files.at("fixture_budget.json"), "\"d_scale\": {\"value\": 0, \"u\": 1e-6}",
            "\"d_scale\": {\"value\": 0, \"u\": 1e-6}, \"d_p\": {\"unit\": \"mm\", "
            "\"specification\": {\"of\": \"l\", \"percent_of_reading\": 0.001}, \"between_points\": \"common\"}");
    replace(files.at("fixture_budget.json"), "l * d_scale", "l * d_scale + d_p");
    replace(files.at("fixture_budget.json"), "\"l\": {\"value\": 0", "\"l\": {\"value\": 1");
    RotaryTableJob job = jobs::test::read(files);
    const FixtureUncertainty fixture = apply_fixture_budget(job);
    const Eigen::MatrixXd& V = job.measurement.fixture_covariance;
    const auto l = [&](Eigen::Index i) { return std::abs(job.measurement.fixture(i / 3, i % 3)); };
    EXPECT_NEAR(V(0, 1), 1e-12 * l(0) * l(1) + 1e-10 / 3.0 * l(0) * l(1), 1e-12 * V(0, 0));
    EXPECT_LT(largest_difference(propagated(*fixture.model), V), 1e-12);
    MonteCarloOptions options;
    options.trials = 100'000;
    options.threads = 1;
    const MonteCarloResult result = run_monte_carlo(*fixture.model, options);
    for (Eigen::Index i = 0; i < 12; ++i) {
        EXPECT_NEAR(result.covariance(i, 1), V(i, 1), 5.0 * std::sqrt(2.0 * V(i, i) * V(1, 1) / 1e5)) << i;
    }
}

TEST(FixtureBudget, RefusesOutputsThatAreNoLength) {
    Files files = campaign_with_budget();
    replace(files.at("fixture_budget.json"), "\"x = l + d_cmm + l * d_scale\"",
            "\"x = l + d_cmm + l * d_scale\", \"y = 2*d_scale\"");
    replace(files.at("fixture_budget.json"), "\"outputs\": {\"x\": {\"unit\": \"mm\"}}",
            "\"outputs\": {\"x\": {\"unit\": \"mm\"}, \"y\": {}}");
    RotaryTableJob job = jobs::test::read(files);
    try {
        (void)apply_fixture_budget(job);
        FAIL() << "two outputs were accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-INPUT-0230");
        EXPECT_THAT(message(error.diagnostics().front()), HasSubstr("the results are x [mm], y [1]"));
    }
}

TEST(FixtureBudget, RefusesValuesThatAreNotThoseOfTheCoordinatesFile) {
    Files files = campaign_with_budget();
    replace(files.at("fixture_points.csv"), "R2.x,85.5", "R2.x,85.5002");
    replace(files.at("fixture_points.csv"), "R4.z,-0.75", "R4.z,-0.75009");  // 0.09 µm is within the tolerance
    RotaryTableJob job = jobs::test::read(files);
    try {
        (void)apply_fixture_budget(job);
        FAIL() << "another coordinate was accepted";
    } catch (const InputError& error) {
        ASSERT_EQ(error.diagnostics().size(), 1U);
        EXPECT_EQ(error.diagnostics().front().code, "GC-INPUT-0231");
        EXPECT_THAT(message(error.diagnostics().front()), HasSubstr("R2.x is 85.5002 mm in the budget and 85.5 mm"));
    }
}

TEST(FixtureBudget, WarnsOfColumnsThatAreFarOff) {
    Files files = campaign_with_budget();
    replace(files.at("fixture.csv"), "5.25,0.4,0.5,0.4", "5.25,0.4,5,0.4");
    RotaryTableJob job = jobs::test::read(files);
    const FixtureUncertainty fixture = apply_fixture_budget(job);
    ASSERT_EQ(fixture.notes.size(), 1U);
    EXPECT_EQ(fixture.notes[0].code, "GC-WARN-0012");
    EXPECT_THAT(message(fixture.notes[0]), HasSubstr("u of R1.y is 5 µm"));
}

TEST(FixtureBudget, LeavesAFixtureWithoutBudgetAlone) {
    RotaryTableJob job = jobs::test::read(jobs::test::small_campaign());
    const Eigen::MatrixXd before = job.measurement.fixture_covariance;
    const FixtureUncertainty fixture = apply_fixture_budget(job);
    EXPECT_EQ(job.measurement.fixture_covariance, before);
    EXPECT_FALSE(fixture.model);
    EXPECT_FALSE(fixture.budget);
}

TEST(FixtureBudget, RefusesPointsThatAreNotTheCoordinates) {
    const auto what = [](auto change) {
        RotaryTableJob job = jobs::test::read(campaign_with_budget());
        Budget budget = *job.fixture_budget;
        change(budget.points);
        job.fixture_budget = std::make_shared<const Budget>(std::move(budget));
        try {
            (void)apply_fixture_budget(job);
        } catch (const InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-FIXTURE-0003");
            return error.diagnostics().front().what;
        }
        return std::string("accepted");
    };
    EXPECT_EQ(what([](auto& points) { points[4].name = "R2.w"; }), "the coordinate R2.y has no point");
    EXPECT_EQ(what([](auto& points) { points.push_back(points.front()); }), "13 points for 12 coordinates");
    EXPECT_EQ(what([](auto& points) { points.clear(); }), "the coordinate R1.x has no point");
}

TEST(FixtureBudget, UncertaintyOfTheSourcePaperIsThatOfItsEquation) {
    EXPECT_DOUBLE_EQ(source_paper_fixture_uncertainty(0.0), 0.401e-6);
    EXPECT_NEAR(source_paper_fixture_uncertainty(1.0), 0.52060061e-6, 1e-14);
    EXPECT_NEAR(2.0 * source_paper_fixture_uncertainty(-1.0), 1.04120123e-6, 2e-14);
}

TEST(FixtureBudget, OfTheShippedExampleIsThatOfItsTerms) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/rotary_table";
    RotaryTableJob job = jobs::read_rotary_table_job(folder / "job_with_fixture_budget.json");
    const FixtureUncertainty fixture = apply_fixture_budget(job);
    const Eigen::MatrixXd& V = job.measurement.fixture_covariance;
    const auto l = [&](Eigen::Index i) { return job.measurement.fixture(i / 3, i % 3); };
    // Of the fixture temperature and of the expansion coefficient, the same for all coordinates.
    const double common = std::pow(1.15e-5 * 0.027, 2) + std::pow(0.2 * 5e-7, 2);
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        for (Eigen::Index j = 0; j < V.rows(); ++j) {
            double expected = l(i) * l(j) * common;
            if (i == j) {
                // The bound of the points file has six decimals; a uniform one of full width 0.1 µm is the step.
                const double bound = 0.4 * k_micro + 1.176e-7 * std::abs(l(i));
                expected += (bound * bound + std::pow(0.05 * k_micro, 2)) / 3.0;
            }
            EXPECT_NEAR(V(i, j), expected, 1e-5 * 0.06 * k_micro * k_micro) << i << ", " << j;
        }
    }
    EXPECT_LT(largest_difference(propagated(*fixture.model), V), 1e-12);
}

}  // namespace
}  // namespace gumcert::gum
