#include "app/simulate_job.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/simulation_document.h"
#include "app/simulation_study.h"
#include "engine/campaign_layout.h"
#include "engine/rotary_table_evaluation.h"
#include "gum/quantity/units.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "gum/rotary_table/fixture_budget.h"

namespace gumcert::app {

namespace {

using engine::RotaryTableMeasurement;
using engine::SimulationRequest;
using simulation::Basis;

constexpr std::size_t k_most_runs = 1'000'000;

bool all_stations_known(const RotaryTableMeasurement& measurement) {
    return std::all_of(measurement.station_start.begin(), measurement.station_start.end(),
                       [](const auto& start) { return start.has_value(); });
}

Basis basis_of(const engine::RotaryTableJob& job, std::optional<std::size_t> runs, std::optional<std::uint64_t> seed,
               const gum::Progress& progress) {
    Basis basis;
    basis.layout = job.measurement;
    basis.layout.reversal = engine::ReversalModel::constant;  // as it is simulated
    basis.request = job.simulation.value_or(SimulationRequest{});
    basis.request.runs = runs.value_or(basis.request.runs);
    basis.request.seed = seed.value_or(basis.request.seed);
    if (basis.request.runs < 1 || basis.request.runs > k_most_runs) {
        throw gum::InputError(gum::Diagnostic{"GC-SIMULATE-0001", "runs", std::to_string(basis.request.runs),
                                              "a study has 1 to 1000000 campaigns", "state another number of runs",
                                              gum::Severity::error});
    }
    RotaryTableMeasurement& layout = basis.layout;
    basis.table = basis.request.table_repeatability.value_or(layout.table_repeatability);
    const bool table_unknown = !basis.request.table_repeatability &&
                               basis.table.mode == engine::RepeatabilityMode::estimate && basis.table.u_linear <= 0.0 &&
                               basis.table.u_axial <= 0.0 && basis.table.u_tilt <= 0.0;
    if (basis.table.mode == engine::RepeatabilityMode::none) {
        basis.table.u_linear = basis.table.u_axial = basis.table.u_tilt = 0.0;
    }
    basis.table_from = basis.request.table_repeatability ? "stated for the simulation" : "stated by the job";
    basis.stations_from = "stations file";
    const bool measured = !layout.lengths.empty();
    if (measured && (table_unknown || !all_stations_known(layout))) {
        if (progress) {
            progress("joint adjustment of the measured lengths");
        }
        RotaryTableMeasurement measurement = layout;
        measurement.method = engine::AdjustmentMethod::joint;
        measurement.reversal = job.measurement.reversal;
        const engine::RotaryTableSolution solution =
            engine::evaluate_jointly(measurement, gum::evaluation_options(measurement));
        if (table_unknown) {
            basis.table.u_linear = std::sqrt(solution.stochastic.variance_linear);
            basis.table.u_axial = std::sqrt(solution.stochastic.variance_axial);
            basis.table.u_tilt = std::sqrt(solution.stochastic.variance_tilt);
            basis.table_from = "estimated from the measured lengths";
        }
        if (!all_stations_known(layout)) {
            for (std::size_t j = 0; j < layout.stations.size(); ++j) {
                layout.station_start[j] = solution.stations[j].position;
            }
            basis.stations_from = "joint adjustment of the measured lengths";
        }
    } else if (table_unknown) {
        basis.table_from = "a perfect table, because the job states none";
    }
    if (!measured) {
        const engine::PlanRequest plan = job.plan.value_or(engine::PlanRequest{});
        if (layout.angles.empty() && !plan.angles_deg.empty()) {
            layout.angles_deg = plan.angles_deg;
            for (const double angle : plan.angles_deg) {
                layout.angles.push_back(angle * gum::k_degree);
            }
        }
        if (layout.angles.empty() && !basis.request.angle_counts.empty()) {
            layout = engine::with_full_turn(layout, basis.request.angle_counts.front());
        }
        engine::lay_out(layout, plan.both_senses, plan.dead_path_per_reflector);
    }
    return basis;
}

void require_a_result(const std::vector<AngleStudy>& studies) {
    for (const AngleStudy& study : studies) {
        for (const CampaignResults* results : {&study.exact, &study.noisy}) {
            if (study.adjusted > 0 && results->evaluated[0] == 0 && results->failure[0]) {
                throw gum::NoResultError(*results->failure[0]);
            }
        }
    }
}

}  // namespace

reports::StudyDocument simulate_job(const std::filesystem::path& job, std::optional<std::size_t> runs,
                                    std::optional<std::uint64_t> seed, unsigned threads,
                                    const gum::Progress& progress) {
    const engine::RotaryTableJob read = engine::read_rotary_table_job(job, engine::JobUse::simulate);
    return simulate_job(read, job.filename().string(), runs, seed, threads, progress);
}

reports::StudyDocument simulate_job(const engine::RotaryTableJob& stated, const std::string& job_name,
                                    std::optional<std::size_t> runs, std::optional<std::uint64_t> seed,
                                    unsigned threads, const gum::Progress& progress) {
    engine::RotaryTableJob job = stated;
    (void)gum::apply_fixture_budget(job);
    const Basis basis = basis_of(job, runs, seed, progress);
    const SimulationRequest& request = basis.request;
    gum::WorkerThreads workers(threads);
    std::vector<AngleStudy> studies;
    if (request.angle_counts.empty()) {
        studies.push_back(
            study_layout(basis.layout, request, basis.table, job.coverage_probability, 0, workers, progress));
    }
    for (const std::size_t count : request.angle_counts) {
        studies.push_back(study_layout(engine::with_full_turn(basis.layout, count), request, basis.table,
                                       job.coverage_probability, count, workers, progress));
    }
    require_a_result(studies);
    return simulation::document_of(job, job_name, basis, studies);
}

}  // namespace gumcert::app
