#include "app/plan_job.h"

#include <optional>
#include <utility>
#include <vector>

#include "gum/monte_carlo/worker_threads.h"
#include "gum/rotary_table/studies/plan_study.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/studies/plan_document.h"

namespace gumcert::app {

reports::StudyDocument plan_job(const std::filesystem::path& job, unsigned threads, const gum::Progress& progress) {
    const auto report = [&](const char* text) {
        if (progress) {
            progress(text);
        }
    };
    const jobs::RotaryTableJob read = jobs::read_rotary_table_job(job, jobs::JobUse::plan);
    gum::plan::Setting setting = gum::plan::setting_of(read, read.plan.value_or(gum::PlanRequest{}), progress);
    gum::WorkerThreads workers(threads);
    report("expected uncertainties");
    const gum::plan::Expected now = gum::plan::expect(setting, setting.layout);
    report("budget by source");
    const gum::plan::SourceShares shares = gum::plan::source_shares(setting, now.motions);
    report("one thing changed at a time");
    const std::vector<gum::plan::Variant> variants = gum::plan::variants_of(setting, workers);
    const std::optional<gum::plan::Proposal> proposal = gum::plan::propose(setting, now, workers, progress);
    return reports::plan::document_of({.name = job.filename().string(),
                                       .title = read.title,
                                       .coverage_probability = read.coverage_probability,
                                       .warnings = read.warnings},
                                      std::move(setting), now, shares, variants, proposal);
}

}  // namespace gumcert::app
