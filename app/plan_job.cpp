#include "app/plan_job.h"

#include <optional>
#include <utility>
#include <vector>

#include "app/plan_document.h"
#include "app/plan_study.h"
#include "gum/worker_threads.h"

namespace gumcert::app {

reports::StudyDocument plan_job(const std::filesystem::path& job, unsigned threads, const gum::Progress& progress) {
    const auto report = [&](const char* text) {
        if (progress) {
            progress(text);
        }
    };
    plan::Setting setting = plan::setting_of(job, progress);
    gum::WorkerThreads workers(threads);
    report("expected uncertainties");
    const plan::Expected now = plan::expect(setting, setting.layout);
    report("budget by source");
    const plan::SourceShares shares = plan::source_shares(setting, now.motions);
    report("one thing changed at a time");
    const std::vector<plan::Variant> variants = plan::variants_of(setting, workers);
    const std::optional<plan::Proposal> proposal = plan::propose(setting, now, workers, progress);
    return plan::document_of(std::move(setting), job.filename().string(), now, shares, variants, proposal);
}

}  // namespace gumcert::app
