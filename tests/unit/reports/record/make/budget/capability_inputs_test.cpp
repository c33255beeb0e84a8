#include "reports/record/make/budget/capability_inputs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "gum/distribution_quantile.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/sample_certificate.h"

namespace gumcert::reports {
namespace {

jobs::BudgetJob certified_budget(const std::string& inputs, const std::string& model, const std::string& more = "") {
    jobs::BudgetJob job =
        jobs::test::read_budget("\"model\": [\"" + model + "\"], \"inputs\": {" + inputs + "}" + more);
    job.certificate = test::sample_certificate_data();
    return job;
}

TEST(CapabilityInputs, HoldTheValuesOfTheInputsInTheirUnits) {
    const jobs::BudgetJob job = certified_budget(R"("x": {"value": 10, "unit": "mm", "u": 0.1},
                                            "t": {"value": 23, "unit": "degC", "u": 0.1})",
                                                 "y = x + 0*t*x/t", R"(, "points": [{"x": 20}, {"x": 30}])");
    const certificate::CapabilityInputs inputs = capability_inputs(job, gum::evaluate_budget(job, 1));
    EXPECT_EQ(inputs.values.at("x").unit, "mm");
    ASSERT_EQ(inputs.values.at("x").values.size(), 2U);
    EXPECT_NEAR(inputs.values.at("x").values[0].value(), 20.0, 1e-12);
    EXPECT_NEAR(inputs.values.at("x").values[1].value(), 30.0, 1e-12);
    EXPECT_NEAR(inputs.values.at("t").values[1].value(), 23.0, 1e-12);
    EXPECT_TRUE(inputs.distributions.empty());
}

// A capability at an input of one section is none for the results of another.
TEST(CapabilityInputs, HoldWhatTheResultsOfASectionRestOn) {
    jobs::BudgetJob job = jobs::test::read_budget(
        R"("inputs": {"x": {"unit": "mm"}, "t": {"value": 23, "unit": "degC", "u": 0.1}, "w": {"value": 5, "unit": "1", "u": 1}},
           "sections": {"a": {"model": ["y = x + 0*t*x/t"], "points": {"columns": {"f": "Hz"},
                              "list": [{"x": {"value": 20, "u": 0.1}, "f": 50}, {"x": {"value": 30, "u": 0.1}, "f": 60}]}},
                        "b": {"model": ["z = w"], "points": [{"w": {"value": 7, "u": 1}}]},
                        "c": {"model": ["v = t"]}})");
    job.certificate = test::sample_certificate_data();
    const certificate::CapabilityInputs inputs = capability_inputs(job, gum::evaluate_budget(job, 1));
    ASSERT_EQ(inputs.values.at("x").values.size(), 3U);
    EXPECT_NEAR(inputs.values.at("x").values[1].value(), 30.0, 1e-12);
    EXPECT_EQ(inputs.values.at("x").values[2], std::nullopt);
    EXPECT_EQ(inputs.values.at("x").without_point, std::nullopt);
    EXPECT_EQ(inputs.values.at("w").values[0], std::nullopt);
    EXPECT_EQ(inputs.values.at("f").values[1], 60.0);
    EXPECT_EQ(inputs.values.at("f").values[2], std::nullopt);
    EXPECT_NEAR(inputs.values.at("t").without_point.value(), 23.0, 1e-12);
}

// Whether a result is a small difference of large inputs is told by what each makes of it.
TEST(CapabilityInputs, HoldWhatEachInputMakesOfAResult) {
    jobs::BudgetJob job = jobs::test::read_budget(
        R"("inputs": {"n": {"unit": "mm", "constant": true, "role": "nominal"}, "x": {"unit": "mm"},
                      "r": {"value": 10, "unit": "cm", "u": 0.1}, "d": {"value": 0, "unit": "mm", "u": 0.1}},
           "model": ["E = x - r + d", "q = 0.25*x"], "outputs": {"E": {"unit": "um"}, "q": {"unit": "mm"}},
           "points": [{"n": 20, "x": {"value": 20.1, "u": 0.1}}, {"n": 30, "x": {"value": 30.1, "u": 0.1}}])");
    job.certificate = test::sample_certificate_data();
    const auto all = capability_inputs(job, gum::evaluate_budget(job, 1)).sensitivities;
    ASSERT_EQ(all.size(), 4U);
    const std::map<std::string, double> of_error{{"d", 1.0}, {"r", -1.0}, {"x", 1.0}};
    EXPECT_EQ(all.at("E[2]"), of_error) << "the nominal value may be what it is an error of: none";
    const std::map<std::string, double> of_share{{"d", 0.0}, {"r", 0.0}, {"x", 0.25}};
    EXPECT_EQ(all.at("q[1]"), of_share);
    job.certificate->accreditation.reset();
    EXPECT_TRUE(capability_inputs(job, gum::evaluate_budget(job, 1)).sensitivities.empty());
}

// A nominal value that no equation of the section needs says where in the scope a result lies, as it says which limits it has.
TEST(CapabilityInputs, HoldWhatThePointsOfASectionState) {
    jobs::BudgetJob job = jobs::test::read_budget(
        R"("inputs": {"n": {"unit": "mm", "constant": true, "role": "nominal"}, "x": {"unit": "mm"}, "w": {"unit": "1"}},
           "sections": {"a": {"model": ["y = 2*x"], "points": [{"n": 20, "x": {"value": 20.1, "u": 0.1}},
                                                               {"n": 30, "x": {"value": 30.1, "u": 0.1}}]},
                        "b": {"model": ["z = w"], "points": [{"w": {"value": 7, "u": 1}}]},
                        "c": {"model": ["v = x/2"], "points": [{"n": 40, "x": {"value": 40.1, "u": 0.1}}]}})");
    job.certificate = test::sample_certificate_data();
    const std::vector<std::optional<double>> nominal =
        capability_inputs(job, gum::evaluate_budget(job, 1)).values.at("n").values;
    ASSERT_EQ(nominal.size(), 4U);
    EXPECT_NEAR(nominal[0].value(), 20.0, 1e-12);
    EXPECT_NEAR(nominal[1].value(), 30.0, 1e-12);
    EXPECT_EQ(nominal[2], std::nullopt);
    EXPECT_NEAR(nominal[3].value(), 40.0, 1e-12);
}

// The trials that are drawn again are those of the evaluation: its interval has its ends at the same ranks.
TEST(CapabilityInputs, HoldTheTrialsWhereMonteCarloIsReported) {
    const jobs::BudgetJob job = certified_budget(
        R"("a": {"value": 0, "unit": "mm", "u": 0.002}, "b": {"value": 0, "unit": "1", "u": 1})", "y = a*b",
        R"(, "outputs": {"y": {"unit": "um"}}, "monte_carlo": {"trials": 30000, "seed": 5})");
    const gum::BudgetResult result = gum::evaluate_budget(job, 1);
    ASSERT_TRUE(result.points.at(0).outputs.at(0).by_monte_carlo);
    const certificate::CapabilityInputs inputs = capability_inputs(job, result);
    const gum::TrialDistribution trials = gum::count_trials(inputs.trials.at("y"));
    EXPECT_EQ(trials.counted, 30000U);
    const gum::CoverageInterval& interval = result.points[0].outputs[0].monte_carlo->symmetric;  // [m]
    const gum::Unit um = gum::Unit::parse("um");
    const double low = trials.function(um.from_si(interval.low) - 1e-9);
    const double high = trials.function(um.from_si(interval.high) + 1e-9);
    EXPECT_NEAR(high - low, 0.9545, 2.0 / 30000.0);
    EXPECT_NEAR(low, 0.02275, 2.0 / 30000.0);
}

// Three readings beside a rectangular contribution: what the one adds to k the other takes off, and k of t_p(ν_eff) agrees
// within 1 %. Five u away are 0.086 %, where t_p(ν_eff) has 0.00003 %.
TEST(CapabilityInputs, HoldTheDistributionWhereKAgreesWithThatOfT) {
    const std::string normal = R"("x": {"value": 10, "unit": "mm", "u": 0.03})";
    const std::string others = R"(, "d": {"value": 0, "unit": "mm", "half_width": 0.12},
                                    "r": {"value": 0, "unit": "mm", "u": 0.015, "nu": 2})";
    const jobs::BudgetJob job = certified_budget(normal + others, "y = x + d + r");
    const gum::BudgetResult result = gum::evaluate_budget(job, 1);
    EXPECT_EQ(result.points.at(0).outputs.at(0).coverage, "student_t");
    const certificate::CapabilityInputs inputs = capability_inputs(job, result);
    ASSERT_EQ(inputs.distributions.size(), 1U);
    const certificate::ResultDistribution y = inputs.distributions.at("y")();
    const gum::Unit unit = result.points.at(0).outputs.at(0).unit;
    const gum::Distribution of_x = gum::Distribution::normal(0.0, 0.03);
    const double far = 5.0 * std::sqrt(0.03 * 0.03 + 0.12 * 0.12 / 3.0 + 0.015 * 0.015);
    double total = 0.0;
    for (double b = -0.5; b <= 0.5; b += 0.001) {
        const double density =
            (gum::upper_tail_probability(of_x, b - 0.12) - gum::upper_tail_probability(of_x, b + 0.12)) / 0.24;
        total += 0.001 * density * gum::upper_tail_probability(gum::Distribution::student_t(0.0, 0.015, 2.0), far - b);
    }
    EXPECT_NEAR(y.function(unit.from_si(1e-3 * (10.0 - far))), total, 1e-9);
    EXPECT_NEAR(total, 8.6e-4, 0.05e-4);
    EXPECT_LT(y.least_probability, 1e-8);
    // One of them alone is what its k says.
    for (const std::string& alone : {normal, std::string(R"("x": {"value": 10, "unit": "mm", "u": 0.02, "nu": 2})")}) {
        const jobs::BudgetJob one = certified_budget(alone, "y = x");
        EXPECT_TRUE(capability_inputs(one, gum::evaluate_budget(one, 1)).distributions.empty()) << alone;
    }
}

// 10 MHz with u of 6e-8 Hz: roundings of a limit that is a possible value would move it by a third of u.
TEST(CapabilityInputs, MoveNoLimitOfAContinuousDistribution) {
    const jobs::BudgetJob job = certified_budget(
        R"("x": {"value": 1e7, "unit": "mm", "u": 5e-8}, "d": {"value": 0, "unit": "mm", "half_width": 3e-8})",
        "y = x + d");
    const gum::BudgetResult result = gum::evaluate_budget(job, 1);
    const certificate::ResultDistribution y = capability_inputs(job, result).distributions.at("y")();
    const gum::Unit unit = result.points.at(0).outputs.at(0).unit;
    EXPECT_FALSE(y.below);
    EXPECT_NEAR(y.function(unit.from_si(1e-3 * 1e7)), 0.5, 1e-6);
}

TEST(CapabilityInputs, HoldTheDistributionOfAConvolution) {
    const jobs::BudgetJob job =
        certified_budget(R"("x": {"value": 10, "unit": "mm", "half_width": 0.1, "distribution": "uniform"})", "y = x");
    const certificate::CapabilityInputs inputs = capability_inputs(job, gum::evaluate_budget(job, 1));
    ASSERT_EQ(inputs.distributions.size(), 1U);
    const auto P = inputs.distributions.at("y")().function;  // x in millimetres, or in what the model gives
    const gum::Unit unit = gum::evaluate_budget(job, 1).points.at(0).outputs.at(0).unit;
    const auto at = [&](double mm) { return P(unit.from_si(1e-3 * mm)); };
    EXPECT_NEAR(at(10.0), 0.5, 1e-6);
    EXPECT_NEAR(at(10.05), 0.75, 1e-6);
    EXPECT_NEAR(at(9.89), 0.0, 1e-6);
    EXPECT_NEAR(at(10.11), 1.0, 1e-6);
}

}  // namespace
}  // namespace gumcert::reports
