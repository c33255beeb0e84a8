#include "evaluation/simulate_job.h"

#include <string>
#include <vector>

#include "gum/rotary_table/fixture_budget.h"
#include "gum/rotary_table/studies/simulation_basis.h"
#include "gum/rotary_table/studies/simulation_study.h"
#include "reports/studies/simulation_document.h"

namespace gumcert::evaluation {

namespace {

void require_a_result(const std::vector<gum::AngleStudy>& studies) {
    for (const gum::AngleStudy& study : studies) {
        for (const gum::CampaignResults* results : {&study.exact, &study.noisy}) {
            if (study.adjusted > 0 && results->evaluated[0] == 0 && results->failure[0]) {
                throw gum::NoResultError(*results->failure[0]);
            }
        }
    }
}

}  // namespace

reports::StudyDocument simulate_job(const jobs::RotaryTableJob& stated, const std::string& job_name,
                                    std::optional<std::size_t> runs, std::optional<std::uint64_t> seed,
                                    unsigned threads, const gum::Progress& progress) {
    jobs::RotaryTableJob job = stated;
    (void)gum::apply_fixture_budget(job);
    gum::SimulationRequest asked = job.simulation.value_or(gum::SimulationRequest{});
    asked.runs = runs.value_or(asked.runs);
    asked.seed = seed.value_or(asked.seed);
    const gum::simulation::Basis basis =
        gum::simulation::basis_of(job, asked, job.plan.value_or(gum::PlanRequest{}), progress);
    const gum::SimulationRequest& request = basis.request;
    gum::WorkerThreads workers(threads);
    std::vector<gum::AngleStudy> studies;
    const std::vector<std::size_t> of_job{0};
    for (const std::size_t count : request.angle_counts.empty() ? of_job : request.angle_counts) {
        studies.push_back(gum::study_layout(gum::simulation::simulated_layout(basis, count), request, basis.table,
                                            job.coverage_probability, count, workers, progress));
    }
    require_a_result(studies);
    return reports::simulation::document_of({.name = job_name,
                                             .title = job.title.in("en"),
                                             .coverage_probability = job.coverage_probability,
                                             .warnings = job.warnings},
                                            basis, studies);
}

}  // namespace gumcert::evaluation
