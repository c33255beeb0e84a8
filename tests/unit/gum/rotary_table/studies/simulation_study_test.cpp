#include "gum/rotary_table/studies/simulation_study.h"

#include <gtest/gtest.h>

#include "gum/quantity/diagnostic.h"
#include "gum/rotary_table/studies/campaign_draws.h"
#include "gum/rotary_table/studies/simulation_basis.h"
#include "tests/support/planned_layout.h"

namespace gumcert::gum::simulation {
namespace {

RotaryTableRequest layout_to_simulate() {
    engine::synthetic::CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(6);
    plan.table_linear = 0.05e-6;
    plan.table_axial = plan.table_tilt = 0.2e-6;
    RotaryTableRequest request;
    request.measurement = engine::planned::layout_of(plan);
    return request;
}

TEST(SimulationBasis, TakesTheTableThatIsStated) {
    const RotaryTableRequest request = layout_to_simulate();
    const Basis of_job = basis_of(request, {}, {}, {});
    EXPECT_EQ(of_job.table_from, "stated by the job");
    EXPECT_EQ(of_job.stations_from, "stations file");
    EXPECT_DOUBLE_EQ(of_job.table.u_linear, 0.05e-6);
    SimulationRequest asked;
    asked.table_repeatability = {engine::RepeatabilityMode::given, 1e-6, 0.0, 0.0};
    const Basis of_simulation = basis_of(request, asked, {}, {});
    EXPECT_EQ(of_simulation.table_from, "stated for the simulation");
    EXPECT_DOUBLE_EQ(of_simulation.table.u_linear, 1e-6);
}

TEST(SimulationBasis, RefusesAStudyWithoutCampaigns) {
    SimulationRequest asked;
    asked.runs = 0;
    try {
        (void)basis_of(layout_to_simulate(), asked, {}, {});
        FAIL() << "it was accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-SIMULATE-0001");
    }
}

TEST(CampaignDraws, AreTheSameWhoeverAsks) {
    const RotaryTableRequest request = layout_to_simulate();
    const CampaignDraws draws(request.measurement, {}, request.measurement.table_repeatability, 7, 0);
    const CampaignDraws again(request.measurement, {}, request.measurement.table_repeatability, 7, 0);
    const auto third = draws.campaign(3, true);
    (void)again.campaign(1, true);
    EXPECT_EQ(again.campaign(3, true).truth.errors, third.truth.errors);
    EXPECT_EQ(again.campaign(3, true).measurement.lengths[5].length, third.measurement.lengths[5].length);
    EXPECT_NE(draws.campaign(4, true).truth.errors, third.truth.errors);
    EXPECT_LE(third.truth.errors.topRows(3).cwiseAbs().maxCoeff(), SimulationRequest{}.error_linear);
}

TEST(SimulationStudy, ErrorsOfTheCampaignsAreAsLargeAsTheirUncertainties) {
    const RotaryTableRequest request = layout_to_simulate();
    SimulationRequest asked;
    asked.runs = 20;
    const Basis basis = basis_of(request, asked, {}, {});
    WorkerThreads workers(2);
    const AngleStudy study = study_layout(basis.layout, basis.request, basis.table, 0.9545, 0, workers);
    EXPECT_EQ(study.angles, 6U);
    EXPECT_EQ(study.adjusted, 20U);
    EXPECT_EQ(study.noisy.evaluated[0], 20U);
    const DifferenceTally& joint = study.noisy.tallies[0][k_linear_tally];
    EXPECT_EQ(joint.count, 20U * 3U * 6U);
    EXPECT_NEAR(joint.normalised_rms(), 1.0, 0.25);  // 360 values of 20 campaigns, correlated within each
    // Without noise nothing but the datum is between calculated and assumed values.
    const DifferenceTally& exact = study.exact.tallies[0][k_linear_tally];
    EXPECT_LT(exact.measurement_rms(), 1e-9);
}

}  // namespace
}  // namespace gumcert::gum::simulation
