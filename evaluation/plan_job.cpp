#include "evaluation/plan_job.h"

#include <optional>
#include <utility>
#include <vector>

#include "gum/monte_carlo/worker_threads.h"
#include "gum/rotary_table/studies/plan_study.h"
#include "reports/studies/plan_document.h"

namespace gumcert::evaluation {

reports::StudyDocument plan_job(const jobs::RotaryTableJob& job, const std::string& job_name, unsigned threads,
                                const gum::Progress& progress) {
    const auto report = [&](const char* text) {
        if (progress) {
            progress(text);
        }
    };
    gum::plan::Setting setting = gum::plan::setting_of(job, job.plan.value_or(gum::PlanRequest{}), progress);
    gum::WorkerThreads workers(threads);
    report("expected uncertainties");
    const gum::plan::Expected now = gum::plan::expect(setting, setting.layout);
    gum::plan::note_undetermined_repeatability(setting);
    report("budget by source");
    const gum::plan::SourceShares shares = gum::plan::source_shares(setting, now.motions);
    report("one thing changed at a time");
    const std::vector<gum::plan::Variant> variants = gum::plan::variants_of(setting, workers);
    const std::optional<gum::plan::Proposal> proposal = gum::plan::propose(setting, now, workers, progress);
    return reports::plan::document_of({.name = job_name,
                                       .title = job.title.in("en"),
                                       .coverage_probability = job.coverage_probability,
                                       .warnings = job.warnings},
                                      std::move(setting), now, shares, variants, proposal);
}

}  // namespace gumcert::evaluation
