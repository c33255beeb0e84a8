#include "gum/rotary_table/studies/plan_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/studies/measurement_plan.h"
#include "engine/rotary_table/variance_components.h"
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
    return expected_parameters(layout, engine::start_variances(layout.table_repeatability), targets, k);
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
        EXPECT_NEAR(*half.all[i].U / *whole.all[i].U, 0.5, 1e-6) << whole.all[i].name;
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

}  // namespace
}  // namespace gumcert::gum::plan
