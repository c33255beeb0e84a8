#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "evaluation/plan_job.h"
#include "evaluation/simulate_job.h"
#include "gum/quantity/diagnostic.h"
#include "tests/fuzz/job_targets.h"
#include "tests/fuzz/well_formed.h"

namespace gumcert::fuzz {
namespace {

using jobs::RotaryTableJob;

/// A layout whose study takes no longer than some hundredths of a second.
bool is_small(const RotaryTableJob& job) {
    const engine::RotaryTableMeasurement& m = job.measurement;
    const std::size_t angles = std::max(m.angles.size(), job.plan ? job.plan->angles_deg.size() : 0);
    const bool has_region = job.plan && job.plan->station_region;
    return angles <= 8 && m.stations.size() <= 6 && m.reflectors.size() <= 6 && m.lengths.size() <= 200 &&
           !has_region && !job.fixture_budget;
}

/// A study that is shown: text without control characters, JSON for programs, the same both times.
void demand_shown(const reports::StudyDocument& study, const char* kind) {
    demand(study.kind == kind && !study.sections.empty(), "a study without contents");
    demand(is_plain_text(reports::render_text(study)), "a control character in a text");
    const nlohmann::json data = nlohmann::json::parse(study.data_json, nullptr, false);
    demand(data.is_object() && data.contains("schema"), "data that are no JSON");
}

template <class Study>
void studied_or_refused(const Study& study) {
    try {
        study();
    } catch (const gum::DiagnosedError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
        jobs::fuzz::demand_honest(error.diagnostics());
    }
}

void plan(const jobs::FileSource& files) {
    const RotaryTableJob job = jobs::read_rotary_table_job(files, "job.json", jobs::JobUse::plan);
    if (is_small(job)) {
        demand_shown(evaluation::plan_job(job, "job.json", 1), "plan");
    }
}

void simulate(const jobs::FileSource& files) {
    RotaryTableJob job = jobs::read_rotary_table_job(files, "job.json", jobs::JobUse::simulate);
    if (is_small(job)) {
        if (job.simulation) {
            job.simulation->angle_counts.clear();
        }
        demand_shown(evaluation::simulate_job(job, "job.json", 2, 7, 1), "simulation");
    }
}

}  // namespace
}  // namespace gumcert::fuzz

/// The files of a job: a plan and a simulation of it are refused, have no result, or are shown as text and as data.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const jobs::MemoryFileSource files(jobs::fuzz::files_of_bundle({reinterpret_cast<const char*>(data), size}));
    fuzz::studied_or_refused([&] { fuzz::plan(files); });
    fuzz::studied_or_refused([&] { fuzz::simulate(files); });
    return 0;
}
