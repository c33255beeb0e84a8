// A rotary table: what a layout will give, and a simulated measurement with a tracking interferometer, evaluated as the
// program evaluates a job. Six
// stations measure the distances of six reflectors on the table at twelve angles; the error motions are known, because
// they were drawn.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "engine/rotary_table/studies/campaign_layout.h"
#include "engine/rotary_table/studies/campaign_simulation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rotary_table/document_units.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "gum/rotary_table/studies/campaign_draws.h"
#include "gum/rotary_table/studies/plan_study.h"
#include "gum/rounding.h"

using namespace gumcert;

namespace {

/// Everything in SI: metres, radians. The axis of the table is x.
engine::RotaryTableMeasurement layout() {
    engine::RotaryTableMeasurement table;
    table.axis = engine::RotaryAxis::a;
    for (int angle = 0; angle < 360; angle += 30) {
        table.angles_deg.push_back(angle);
        table.angles.push_back(angle * std::numbers::pi / 180.0);
    }
    const std::vector<Eigen::Vector3d> stations{{0.70, 0.45, 0.10},   {0.75, -0.40, 0.35}, {0.55, 0.10, -0.60},
                                                {1.20, -0.55, -0.45}, {1.10, 0.60, 0.70},  {0.45, -0.75, 0.05}};
    for (std::size_t j = 0; j < stations.size(); ++j) {
        table.stations.push_back("P" + std::to_string(j + 1));
        table.station_start.emplace_back(stations[j]);
    }
    table.reflectors = {"R1", "R2", "R3", "R4", "R5", "R6"};
    table.fixture.resize(6, 3);
    table.fixture << 0.030, 0.120, 0.000, 0.150, 0.050, 0.100, 0.060, -0.085, 0.090, 0.180, -0.070, -0.050, 0.040,
        0.010, -0.120, 0.220, 0.020, 0.010;
    table.fixture_covariance = std::pow(0.4e-6, 2) * Eigen::MatrixXd::Identity(18, 18);
    table.length_uncertainty = {.u_constant = 0.1e-6, .u_proportional = 0.15e-6};
    table.table_repeatability = {.mode = engine::RepeatabilityMode::given,
                                 .u_linear = 0.05e-6,
                                 .u_axial = 0.2 * gum::k_arcsecond,
                                 .u_tilt = 0.05 * gum::k_arcsecond};
    engine::lay_out(table, false, false);  // every station to every reflector at every angle
    return table;
}

}  // namespace

int main() try {
    const engine::RotaryTableMeasurement planned = layout();
    gum::RotaryTableRequest to_plan;
    to_plan.measurement = planned;
    to_plan.coverage_probability = 0.95;
    const gum::plan::Setting setting = gum::plan::setting_of(to_plan, {}, {});
    const gum::plan::Expected expected = gum::plan::expect(setting, setting.layout);
    for (const std::size_t c : {0U, 3U}) {
        const gum::DocumentUnit& unit = gum::plan::unit_of_motion(c);
        std::printf("before anything is measured: U of %s at most %.2f %s\n", setting.names[c].c_str(),
                    expected.motions[c].largest / unit.si, unit.print);
    }

    const gum::SimulationRequest simulation;  // error motions within ±10 µm and ±20″, set-up errors of 10 µm and 20″
    const gum::CampaignDraws draws(planned, simulation, planned.table_repeatability, simulation.seed, 0);
    const gum::CampaignDraws::Campaign campaign = draws.campaign(0, true);

    gum::RotaryTableRequest request;
    request.measurement = campaign.measurement;
    request.coverage_probability = 0.95;
    const gum::RotaryTableResult result = gum::evaluate_rotary_table(request, 0);

    const gum::UncertaintyBudget& budget = result.reported.budget;
    const std::vector<gum::OutputQuantity>& outputs = result.solution.quantities.outputs;
    const Eigen::VectorXd truth = engine::truth_in_datum(planned, campaign.truth, planned.datum, false);
    const auto motions = engine::error_motion_names(planned.axis);
    int covered = 0;
    for (Eigen::Index i = 0; i < truth.size(); ++i) {
        const gum::OutputQuantity& output = outputs[static_cast<std::size_t>(i)];
        const gum::DocumentUnit& unit = gum::unit_of(output);
        const double error = std::abs(budget.value(i) - truth(i));
        covered += error <= budget.expanded_uncertainty(i) ? 1 : 0;
        if (i < 12) {  // the six error motions at the first two angles
            const gum::RoundedPair pair =
                gum::round_to_uncertainty(budget.value(i) / unit.si, budget.expanded_uncertainty(i) / unit.si);
            std::printf("%s at %2.0f°: %s %s, U = %s, true %.2f\n", motions[static_cast<std::size_t>(i % 6)].c_str(),
                        planned.angles_deg[static_cast<std::size_t>(i / 6)], pair.value.c_str(), unit.print,
                        pair.U.c_str(), truth(i) / unit.si);
        }
    }
    std::printf("%d of %d true values lie within U (p = 95 %%)\n", covered, static_cast<int>(truth.size()));
    for (const gum::BudgetContribution& source : budget.shares_by_source) {
        std::printf("%s: %.1f %% of the variance of %s at 0°\n", source.name.c_str(), 100.0 * source.share(0),
                    motions.front().c_str());
    }
    return 0;
} catch (const gum::DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
