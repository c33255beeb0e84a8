#include "gum/rotary_table/studies/plan_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/rotary_table_contributions.h"
#include "engine/rotary_table/rotary_table_model.h"
#include "engine/rotary_table/studies/measurement_plan.h"
#include "engine/rotary_table/variance_components.h"
#include "gum/monte_carlo/extreme_uncertainty.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "gum/rotary_table/positioning_scope.h"
#include "tests/support/planned_layout.h"

namespace gumcert::gum::plan {
namespace {

using testing::ElementsAre;

/// A table that scatters by `u_axial` about its axis, to be measured by uncertainties of `factor` times the usual.
engine::RotaryTableMeasurement layout_of_parameters(double u_axial, double factor = 1.0) {
    engine::synthetic::CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(6);
    plan.u_constant *= factor;
    plan.u_proportional *= factor;
    plan.cmm_factor = factor;
    plan.table_linear = factor * 0.05e-6;
    plan.table_tilt = factor * 0.2e-6;
    plan.table_axial = factor * u_axial;
    return engine::planned::layout_of(plan);
}

ExpectedParameters parameters_of(const engine::RotaryTableMeasurement& layout, const ParameterTargets& targets = {},
                                 double k = 2.0) {
    return expected_parameters(layout, engine::start_variances(layout.table_repeatability), targets, k, 0.9545);
}

std::vector<std::string> names_of(const ExpectedParameters& expected) {
    std::vector<std::string> names;
    for (const PlannedParameter& parameter : expected.all) {
        names.push_back(parameter.name);
    }
    return names;
}

TEST(PlannedParameter, IsMissedWhereItIsNotStatedOrTooUncertain) {
    const auto missed = [](std::optional<double> U, std::optional<double> target) {
        return PlannedParameter{"E", true, U, target}.missed();
    };
    EXPECT_FALSE(missed(std::nullopt, std::nullopt)) << "nothing is wanted";
    EXPECT_FALSE(missed(1e-6, std::nullopt));
    EXPECT_TRUE(missed(std::nullopt, 1e-6));
    EXPECT_TRUE(missed(1.001e-6, 1e-6));
    EXPECT_FALSE(missed(1e-6, 1e-6)) << "the target itself is within it";
    EXPECT_EQ(&(PlannedParameter{"E", true, {}, {}}.unit()), &k_arcsec);
    EXPECT_EQ(&(PlannedParameter{"axis_y", false, {}, {}}.unit()), &k_um);
}

TEST(ExpectedParameters, NameRangesAxisAndPositioningWithTheirTargets) {
    ParameterTargets targets;
    targets.range_linear = 1.0;
    targets.range_angular = 2.0;
    targets.location_linear = 3.0;
    targets.location_angular = 4.0;
    targets.systematic = 5.0;
    targets.accuracy = 7.0;
    const ExpectedParameters expected = parameters_of(layout_of_parameters(5e-6), targets);
    EXPECT_THAT(names_of(expected),
                ElementsAre("range of EXA", "range of EYA", "range of EZA", "range of EAA", "range of EBA",
                            "range of ECA", "axis_y", "axis_z", "axis_b", "axis_c", "E_up", "R_up", "A_up"));
    std::vector<double> wanted;
    for (const PlannedParameter& parameter : expected.all) {
        wanted.push_back(parameter.target.value_or(0.0));
        ASSERT_TRUE(parameter.U) << parameter.name;
        EXPECT_GT(*parameter.U, 0.0) << parameter.name;
    }
    EXPECT_THAT(wanted, ElementsAre(1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 5.0, 0.0, 7.0));
    for (std::size_t i = 0; i < expected.all.size(); ++i) {
        EXPECT_EQ(expected.all[i].angular, (i >= 3 && i < 6) || i >= 8) << expected.all[i].name;
    }
}

TEST(ExpectedParameters, AxisIsAsUncertainAsTheSetUp) {
    const engine::RotaryTableMeasurement layout = layout_of_parameters(5e-6);
    const engine::StochasticModel stochastic = engine::start_variances(layout.table_repeatability);
    const engine::ExpectedUncertainty reported = engine::expected_uncertainty(layout, stochastic, {});
    const ExpectedParameters expected = parameters_of(layout, {}, 3.0);
    // The axis line is -O and -S of T_s to first order; a tilt about y is a direction along z.
    const Eigen::Index set_up = reported.quantities.set_up;
    for (Eigen::Index c = 0; c < 4; ++c) {
        const double u = std::sqrt(reported.covariance(set_up + c, set_up + c));
        EXPECT_NEAR(*expected.all[static_cast<std::size_t>(6 + c)].U / (3.0 * u), 1.0, 1e-6) << c;
    }
}

TEST(ExpectedParameters, HalfOfEveryUncertaintyIsHalfOfEveryParameter) {
    const ExpectedParameters whole = parameters_of(layout_of_parameters(5e-6));
    const ExpectedParameters half = parameters_of(layout_of_parameters(5e-6, 0.5));
    ASSERT_EQ(half.all.size(), whole.all.size());
    for (std::size_t i = 0; i < whole.all.size(); ++i) {
        const double ratio = *half.all[i].U / *whole.all[i].U;
        if (i < 3) {  // of linear motions that are drawn as large as before: fewer angles come near the extreme
            EXPECT_LT(ratio, 0.5 + 1e-6) << whole.all[i].name;
            EXPECT_GT(ratio, 0.45) << whole.all[i].name;
        } else {
            EXPECT_NEAR(ratio, 0.5, 1e-6) << whole.all[i].name;
        }
    }
    EXPECT_NEAR(half.u_deviation / whole.u_deviation, 0.5, 1e-6);
    EXPECT_NEAR(half.share_of_the_noise, whole.share_of_the_noise, 1e-6);
}

TEST(ExpectedParameters, RunsThatScatterByTheirMeasurementHaveNoRepeatability) {
    ParameterTargets targets;
    targets.repeatability = 1.0;
    const ExpectedParameters expected = parameters_of(layout_of_parameters(1e-9), targets);
    EXPECT_GT(expected.share_of_the_noise, k_largest_scatter_share);
    const ExpectedParameters scattered = parameters_of(layout_of_parameters(5e-6), targets);
    EXPECT_LT(scattered.share_of_the_noise, k_largest_scatter_share);
    for (const ExpectedParameters* const one : {&expected, &scattered}) {
        const double noise = std::pow(one->u_deviation, 2);
        const double table = std::pow(one == &expected ? 1e-9 : 5e-6, 2);
        EXPECT_NEAR(one->share_of_the_noise, noise / (noise + table), 1e-12);
        for (const PlannedParameter& parameter : one->all) {
            const bool scatter = parameter.name == "R_up" || parameter.name == "A_up";
            EXPECT_EQ(parameter.U.has_value(), !scatter || one == &scattered) << parameter.name;
            EXPECT_EQ(parameter.missed(), parameter.name == "R_up" && one == &expected) << parameter.name;
        }
    }
}

/// Ratios of what a plan states of the table that an evaluation found to what the evaluation states, "name ratio"; and how many
/// of them the extremes make larger than the law of propagation does.
std::vector<std::pair<std::string, double>> planned_to_evaluated(const engine::synthetic::CampaignPlan& campaign_plan,
                                                                 int& widened) {
    RotaryTableRequest request;
    request.measurement = engine::synthetic::simulate(campaign_plan).measurement;
    const RotaryTableResult evaluated = evaluate_rotary_table(request, 1);
    const engine::RotaryTableMeasurement layout = engine::planned::layout_of(campaign_plan);
    const engine::StochasticModel stochastic = engine::start_variances(layout.table_repeatability);
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    const engine::JointAdjustment adjustment = engine::planned_adjustment(layout, stochastic);
    const auto table = std::make_shared<engine::RotaryTableModel>(
        layout, adjustment, stochastic,
        engine::SourceDegreesOfFreedom{k_infinite, k_infinite, k_infinite, k_infinite, k_infinite});
    const engine::TableParameterModel model(
        table, engine::transform_to_datum(layout, adjustment.poses(), adjustment.set_up(), layout.datum));
    const Eigen::VectorXd u =
        uncertainties_of_table(
            model, motion_covariances(engine::contributions_of(*table).covariance, layout.angles.size()),
            {.reported = evaluated.reported.budget.value, .positions = evaluated.parameter_model->nominal_positions()},
            {.scatter_stated = evaluated.positioning.scatter_stated, .u_deviation = model.rms_position_uncertainty()},
            request.coverage_probability)
            .stated;
    std::vector<std::pair<std::string, double>> ratios;
    const bool both = campaign_plan.both_senses;
    for (std::size_t i = 0; i < model.parameters()->short_names().size(); ++i) {
        const std::string& name = model.parameters()->short_names()[i];
        const auto at = static_cast<Eigen::Index>(i);
        const bool is_planned =
            at < 10 || name == (both ? "E" : "E_up") || name == (both ? "R" : "R_up") || name == (both ? "A" : "A_up");
        if (is_planned && (at < 10 || evaluated.positioning.states(name))) {
            ratios.emplace_back(name, u[at] / evaluated.parameters.standard_uncertainty[at]);
            widened += share_of_extremes(evaluated.parameters, at) > 0.0 ? 1 : 0;
        }
    }
    return ratios;
}

// The law: of one table a plan and an evaluation state the same, whether its extremes are clear or lost in the noise.
TEST(ExpectedParameters, AreThoseOfAnEvaluationOfTheSameTable) {
    int widened = 0;
    std::size_t compared = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        engine::synthetic::CampaignPlan plan;
        plan.angles_deg = engine::synthetic::full_turn(12);
        plan.start_values = true;
        plan.seed = seed;
        plan.error_factor = seed % 3 == 0 ? 3.0 : seed % 3 == 1 ? 0.3 : 0.0;
        plan.table_linear = 0.05e-6;
        plan.table_tilt = 0.2e-6;
        plan.table_axial = 4e-6;
        plan.both_senses = seed % 2 == 0;
        for (const auto& [name, ratio] : planned_to_evaluated(plan, widened)) {
            EXPECT_NEAR(ratio, 1.0, 0.06) << name << ", seed " << seed;
            ++compared;
        }
    }
    EXPECT_GT(compared, 60U);
    EXPECT_GT(widened, 20);
}

}  // namespace
}  // namespace gumcert::gum::plan
