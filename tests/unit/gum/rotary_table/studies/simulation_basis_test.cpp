#include "gum/rotary_table/studies/simulation_basis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::gum::simulation {
namespace {

using engine::RepeatabilityMode;
using engine::synthetic::Campaign;
using testing::ElementsAre;
using testing::IsEmpty;

/// A measured table of which the job states neither repeatability nor, unless asked to, stations.
Campaign measured_table(bool stations) {
    engine::synthetic::CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(8);
    plan.start_values = stations;
    plan.table_linear = 0.5e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 3e-6;
    Campaign campaign = engine::synthetic::simulate(plan);
    campaign.measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    return campaign;
}

RotaryTableRequest basis_request(const Campaign& campaign) {
    RotaryTableRequest request;
    request.measurement = campaign.measurement;
    return request;
}

/// The same without a distance, pass or angle.
RotaryTableRequest nothing_measured() {
    RotaryTableRequest request = basis_request(measured_table(true));
    request.measurement.lengths.clear();
    request.measurement.passes.clear();
    request.measurement.dead_paths.clear();
    request.measurement.angles.clear();
    request.measurement.angles_deg.clear();
    return request;
}

SimulationRequest turns_of_three() {
    SimulationRequest asked;
    asked.angle_counts = {3};
    return asked;
}

TEST(BasisOfASimulation, FindsTableAndStationsInTheMeasuredLengths) {
    const Campaign campaign = measured_table(false);
    std::vector<std::string> said;
    const Basis basis =
        basis_of(basis_request(campaign), {}, {}, [&](const std::string& sentence) { said.push_back(sentence); });
    EXPECT_THAT(said, ElementsAre("joint adjustment of the measured lengths"));
    EXPECT_EQ(basis.table_from, "estimated from the measured lengths");
    EXPECT_EQ(basis.stations_from, "joint adjustment of the measured lengths");
    // Of 48 visits, less what the poses of eight angles take: estimated to about a seventh.
    EXPECT_NEAR(basis.table.u_linear, 0.5e-6, 0.25e-6);
    EXPECT_NEAR(basis.table.u_axial, 5e-6, 2.5e-6);
    EXPECT_NEAR(basis.table.u_tilt, 3e-6, 1.5e-6);
    for (std::size_t j = 0; j < campaign.truth.stations.size(); ++j) {
        ASSERT_TRUE(basis.layout.station_start[j]);
        EXPECT_LT((*basis.layout.station_start[j] - campaign.truth.stations[j]).norm(), 1e-4) << j;
    }
    EXPECT_EQ(basis.layout.lengths.size(), campaign.measurement.lengths.size());
}

TEST(BasisOfASimulation, StationsOfTheFileStayWhereTheTableIsEstimated) {
    const Campaign campaign = measured_table(true);
    const Basis basis = basis_of(basis_request(campaign), {}, {}, {});
    EXPECT_EQ(basis.table_from, "estimated from the measured lengths");
    EXPECT_EQ(basis.stations_from, "stations file");
    EXPECT_EQ(basis.layout.station_start, campaign.measurement.station_start);
}

TEST(BasisOfASimulation, AdjustsNothingWhereEverythingIsStated) {
    RotaryTableRequest request = basis_request(measured_table(true));
    request.measurement.reversal = engine::ReversalModel::by_angle;
    request.measurement.table_repeatability.u_tilt = 2e-6;  // a start value, which the job states
    std::vector<std::string> said;
    const Basis basis = basis_of(request, {}, {}, [&](const std::string& sentence) { said.push_back(sentence); });
    EXPECT_THAT(said, IsEmpty());
    EXPECT_EQ(basis.table_from, "stated by the job");
    EXPECT_EQ(basis.table.u_tilt, 2e-6);
    EXPECT_EQ(basis.table.u_axial, 0.0);
    EXPECT_EQ(basis.layout.reversal, engine::ReversalModel::constant) << "as it is simulated";
}

TEST(BasisOfASimulation, ATableWithoutRepeatabilityHasNone) {
    RotaryTableRequest request = basis_request(measured_table(true));
    request.measurement.table_repeatability = {RepeatabilityMode::none, 1e-6, 2e-6, 3e-6};
    const Basis basis = basis_of(request, {}, {}, {});
    EXPECT_EQ(basis.table_from, "stated by the job");
    EXPECT_EQ(basis.table.u_linear, 0.0);
    EXPECT_EQ(basis.table.u_axial, 0.0);
    EXPECT_EQ(basis.table.u_tilt, 0.0);
    const Basis unmeasured = basis_of(nothing_measured(), turns_of_three(), {}, {});
    EXPECT_EQ(unmeasured.table_from, "a perfect table, because the job states none");
    EXPECT_EQ(unmeasured.table.u_axial, 0.0);
}

TEST(BasisOfASimulation, WithoutLengthsTheLayoutIsThatOfAPlan) {
    PlanRequest plan;
    plan.angles_deg = {0.0, 45.0, 180.0};
    plan.both_senses = true;
    plan.dead_path_per_reflector = true;
    SimulationRequest asked;
    asked.angle_counts = {4, 5};
    const Basis planned = basis_of(nothing_measured(), asked, plan, {});
    EXPECT_EQ(planned.layout.angles_deg, plan.angles_deg);
    ASSERT_EQ(planned.layout.angles.size(), 3U);
    EXPECT_DOUBLE_EQ(planned.layout.angles[1], std::numbers::pi / 4.0);
    EXPECT_EQ(planned.layout.lengths.size(), 2U * 3U * 6U * 6U);
    EXPECT_EQ(planned.layout.dead_paths.size(), 6U * 6U);
    // Without angles of a plan, those of the first full turn that is asked for.
    const Basis turned = basis_of(nothing_measured(), asked, {}, {});
    EXPECT_THAT(turned.layout.angles_deg, ElementsAre(0.0, 90.0, 180.0, 270.0));
    EXPECT_EQ(turned.layout.lengths.size(), 4U * 6U * 6U);
    EXPECT_EQ(turned.layout.dead_paths.size(), 6U);
}

TEST(BasisOfASimulation, RefusesNumbersOfCampaignsOutsideItsLimits) {
    SimulationRequest asked = turns_of_three();
    asked.runs = 1'000'000;
    EXPECT_EQ(basis_of(nothing_measured(), asked, {}, {}).request.runs, 1'000'000U);
    asked.runs = 1'000'001;
    try {
        (void)basis_of(nothing_measured(), asked, {}, {});
        FAIL() << "it was accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  message({"GC-SIMULATE-0001", "runs", "1000001", "a study has 1 to 1000000 campaigns",
                           "state another number of runs", Severity::error}));
    }
}

TEST(BasisOfASimulation, RefusesALayoutWithoutAnglesOrStations) {
    const auto code_of = [](const RotaryTableRequest& request, const SimulationRequest& asked) {
        try {
            (void)basis_of(request, asked, {}, {});
        } catch (const InputError& error) {
            return error.diagnostics().front().code;
        }
        return std::string();
    };
    EXPECT_EQ(code_of(nothing_measured(), {}), "GC-LAYOUT-0002");
    RotaryTableRequest unknown = nothing_measured();
    unknown.measurement.station_start[3].reset();
    EXPECT_EQ(code_of(unknown, turns_of_three()), "GC-LAYOUT-0001");
}

}  // namespace
}  // namespace gumcert::gum::simulation
