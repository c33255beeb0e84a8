#include "gum/rotary_table/studies/plan_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "gum/coverage.h"
#include "gum/quantity/units.h"
#include "tests/support/planned_layout.h"

namespace gumcert::gum::plan {
namespace {

RotaryTableRequest layout_to_plan() {
    engine::synthetic::CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(12);
    plan.table_linear = 0.05e-6;
    plan.table_axial = plan.table_tilt = 0.2e-6;
    RotaryTableRequest request;
    request.measurement = engine::planned::layout_of(plan);
    return request;
}

TEST(PlanStudy, ExpectsWhatALayoutGives) {
    const Setting setting = setting_of(layout_to_plan(), {}, {});
    EXPECT_EQ(setting.distances_from, "those of the lengths file");
    EXPECT_NEAR(setting.k, coverage_factor(0.9545, INFINITY), 1e-12);
    const Expected expected = expect(setting, setting.layout);
    double ratio = 0.0;
    for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_LE(expected.motions[c].rms, expected.motions[c].largest * (1.0 + 1e-12)) << c;
        ratio = std::fmax(ratio, expected.motions[c].largest / target_of(setting, c));
    }
    EXPECT_DOUBLE_EQ(expected.ratio, ratio);
    EXPECT_EQ(unit_of_motion(2).si, k_micrometre);
    EXPECT_EQ(unit_of_motion(3).si, k_arcsecond);
}

TEST(PlanStudy, HalfOfEveryUncertaintyIsHalfOfEveryResult) {
    RotaryTableRequest request = layout_to_plan();
    const Expected whole = expect(setting_of(request, {}, {}), setting_of(request, {}, {}).layout);
    engine::RotaryTableMeasurement& m = request.measurement;
    m.length_uncertainty.u_constant /= 2.0;
    m.length_uncertainty.u_proportional /= 2.0;
    m.table_repeatability.u_linear /= 2.0;
    m.table_repeatability.u_axial /= 2.0;
    m.table_repeatability.u_tilt /= 2.0;
    m.fixture_covariance /= 4.0;
    const Setting setting = setting_of(request, {}, {});
    const Expected half = expect(setting, setting.layout);
    for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_NEAR(half.motions[c].largest / whole.motions[c].largest, 0.5, 1e-6) << c;
    }
}

TEST(PlanStudy, TellsComponentsThatALayoutHardlyDetermines) {
    const auto notes = [](std::size_t stations, engine::RepeatabilityMode mode) {
        engine::synthetic::CampaignPlan plan;
        plan.angles_deg = engine::synthetic::full_turn(stations > 3 ? 24 : 12);
        plan.stations.resize(stations);
        plan.u_constant = 0.1e-6;
        plan.u_proportional = 0.0;
        RotaryTableRequest request;
        request.measurement = engine::planned::layout_of(plan);
        request.measurement.table_repeatability = {mode, 0.3e-6, 2e-6, 2e-6};
        Setting setting = setting_of(std::move(request), {}, {});
        setting.notes.clear();
        note_undetermined_repeatability(setting);
        return setting.notes;
    };
    EXPECT_THAT(notes(3, engine::RepeatabilityMode::estimate),
                testing::ElementsAre(testing::HasSubstr("degrees of freedom: table linear (")));
    EXPECT_THAT(notes(6, engine::RepeatabilityMode::estimate), testing::IsEmpty());
    EXPECT_THAT(notes(3, engine::RepeatabilityMode::given), testing::IsEmpty());
}

TEST(PlanStudy, SharesOfTheSourcesAddUp) {
    const Setting setting = setting_of(layout_to_plan(), {}, {});
    const Expected expected = expect(setting, setting.layout);
    const SourceShares shares = source_shares(setting, expected.motions);
    for (const std::array<double, 6>& of_motion : shares.of_motion) {
        double sum = 0.0;
        for (const double share : of_motion) {
            EXPECT_GE(share, 0.0);
            sum += share;
        }
        EXPECT_NEAR(sum, 1.0, 1e-9);
    }
}

TEST(PlanStudy, TellsTargetsThatAreMet) {
    PlanRequest wanted;
    wanted.target_linear = 1e-3;
    wanted.target_angular = 1e-9;
    wanted.parameter_targets.range_linear = 1e-3;
    const Setting setting = setting_of(layout_to_plan(), wanted, {});
    const std::vector<Target> targets = targets_of(setting, expect(setting, setting.layout));
    ASSERT_EQ(targets.size(), 9U);  // six error motions and three ranges
    for (std::size_t i = 0; i < targets.size(); ++i) {
        EXPECT_EQ(targets[i].met, i < 3 || i >= 6) << targets[i].name;
    }
}

TEST(PlanStudy, LaysOutPlannedAnglesWithoutLengths) {
    RotaryTableRequest request = layout_to_plan();
    request.measurement.lengths.clear();
    PlanRequest plan;
    plan.both_senses = true;
    const Setting setting = setting_of(request, plan, {});
    EXPECT_EQ(setting.distances_from, "every station to every reflector at every planned angle");
    EXPECT_EQ(setting.layout.lengths.size(), 2U * 12U * 6U * 6U);
}

}  // namespace
}  // namespace gumcert::gum::plan
