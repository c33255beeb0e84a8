#include "archive/certificates/archive_replay.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "evaluation/recompute_record.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::archive {

namespace {

gum::Diagnostic not_replayed(const std::string& name, std::string what) {
    return {.code = "GC-ARCHIVE-0061",
            .where = name,
            .what = std::move(what),
            .rule = "an archived record holds its job, which is evaluated again",
            .action = "evaluate the job by hand from its files"};
}

/// Where today's record differs from the archived one, whose bytes have the hash that the log states: nobody changed it, and the
/// programs differ. What is printed comes before what the audit says.
std::vector<gum::Diagnostic> differences_of(const reports::EvaluationRecord& archived,
                                            const reports::EvaluationRecord& again, const std::string& name,
                                            const std::string& made_by) {
    std::vector<gum::Diagnostic> found;
    const auto told = [&](const std::string& where, std::string what, std::string rule, std::string action) {
        return gum::Diagnostic{.code = "GC-ARCHIVE-0073",
                               .where = where,
                               .what = std::move(what),
                               .rule = std::move(rule),
                               .action = std::move(action)};
    };
    const std::string of_audit = name + "#/audit/";
    evaluation::tell_disagreements(
        archived, again, [&](const std::string& pointer, const std::string& stated, const std::string& evaluated) {
            found.push_back(told(
                name + "#" + pointer, stated, "this program gives " + evaluated,
                "the record is as gumcert " + made_by + " made it; see what the difference means for the certificate"));
        });
    std::stable_partition(found.begin(), found.end(),
                          [&](const gum::Diagnostic& one) { return !one.where.starts_with(of_audit); });
    if (found.size() > k_most_differences) {
        const std::size_t left_out = found.size() - k_most_differences;
        found.resize(k_most_differences);
        found.push_back(told(name, std::to_string(left_out) + " more places",
                             "the first " + std::to_string(k_most_differences) + " are listed",
                             "evaluate the job by hand from its files"));
    }
    return found;
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
        reports::EvaluationRecord again = evaluation::evaluated_again(record, name, threads, templates, progress);
        again.software = record.software;
        replay.differences = differences_of(record, again, name, replay.made_by);
        replay.evaluated = true;
    } catch (const gum::DiagnosedError& error) {
        const gum::Diagnostic& first = error.diagnostics().front();
        replay.differences.push_back(not_replayed(name, first.where + ": " + first.what));
    }
    return replay;
}

}  // namespace gumcert::archive
