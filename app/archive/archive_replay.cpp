#include "app/archive/archive_replay.h"

#include <algorithm>
#include <utility>

#include "app/recompute_record.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

namespace {

gum::Diagnostic not_replayed(const std::string& name, std::string what) {
    return {.code = "GC-ARCHIVE-0061",
            .where = name,
            .what = std::move(what),
            .rule = "an archived record holds its job, which is evaluated again",
            .action = "evaluate the job by hand from its files"};
}

}  // namespace

Replay replay_record(const std::string& bytes, const std::string& name, unsigned threads,
                     const std::filesystem::path& templates, const gum::Progress& progress) {
    Replay replay;
    try {
        const reports::EvaluationRecord record = reports::record_from_json(bytes, name);
        replay.made_by = record.software.version + " (commit " + record.software.commit + ")";
        const bool whole = !record.job_files.empty() &&
                           std::all_of(record.job_files.begin(), record.job_files.end(),
                                       [](const reports::InputFile& file) { return file.content.has_value(); });
        if (!whole) {
            replay.differences.push_back(not_replayed(name, "the record does not hold all files of its job"));
            return replay;
        }
        reports::EvaluationRecord again = evaluated_again(record, name, threads, templates, progress);
        again.software = record.software;
        replay.differences = disagreements(record, again, name);
        replay.evaluated = true;
    } catch (const gum::DiagnosedError& error) {
        const gum::Diagnostic& first = error.diagnostics().front();
        replay.differences.push_back(not_replayed(name, first.where + ": " + first.what));
    }
    return replay;
}

}  // namespace gumcert::app
