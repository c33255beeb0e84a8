#include "archive/certificates/archive_replay.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "archive/certificates/message_json.h"
#include "evaluation/recompute_record.h"
#include "reports/record/evaluation_record.h"
#include "text/lists.h"
#include "text/visible_text.h"

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
        found.push_back(told(name, text::count_of(static_cast<std::int64_t>(left_out), "more place"),
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

std::vector<std::pair<std::string, std::string>> records_to_replay(Archive& archive,
                                                                   const std::vector<std::string>& numbers) {
    std::vector<std::pair<std::string, std::string>> records;
    for (const std::string& number : numbers) {
        records.emplace_back(number, archive.life(number).record);
    }
    if (numbers.empty()) {
        for (const ListedCertificate& one : archive.certificates()) {
            if (!one.record.empty()) {
                records.emplace_back(one.number, one.record);
            }
        }
    }
    return records;
}

std::vector<gum::Diagnostic> first_differences(const std::vector<gum::Diagnostic>& all, const std::string& number) {
    if (all.size() <= evaluation::k_most_disagreements + 1) {
        return all;
    }
    std::vector<gum::Diagnostic> first(all.begin(), all.begin() + evaluation::k_most_disagreements);
    const bool is_all = all.size() <= k_most_differences;
    const std::size_t more = std::min(all.size(), k_most_differences) - first.size();
    first.push_back(
        {.code = "GC-ARCHIVE-0073",
         .where = number,
         .what = (is_all ? "" : "more than ") + text::count_of(static_cast<std::int64_t>(more), "more place"),
         .rule = "the first " + std::to_string(first.size()) + " are shown here",
         .action = "--format json lists them"});
    return first;
}

std::size_t same_again(const Replays& replays) {
    return static_cast<std::size_t>(
        std::count_if(replays.begin(), replays.end(), [](const auto& one) { return one.second.differences.empty(); }));
}

std::size_t not_evaluated(const Replays& replays) {
    return static_cast<std::size_t>(
        std::count_if(replays.begin(), replays.end(), [](const auto& one) { return !one.second.evaluated; }));
}

std::string replay_text(const Replays& replays, const std::string& program) {
    std::string text;
    for (const auto& [number, one] : replays) {
        text += fmt::format("{:<24}  {}  made by gumcert {}\n", text::one_line(number),
                            one.differences.empty() ? "same     "
                            : one.evaluated         ? "DIFFERENT"
                                                    : "NOT DONE ",
                            text::one_line(one.made_by));
    }
    const std::size_t not_done = not_evaluated(replays);
    return text + fmt::format("{} of {} records give the same with gumcert {}{}\n", same_again(replays), replays.size(),
                              program, not_done > 0 ? fmt::format("; {} not evaluated", not_done) : "");
}

nlohmann::json replay_json(const Replays& replays, const std::string& program) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& [number, one] : replays) {
        list.push_back({{"number", number},
                        {"made_by", one.made_by},
                        {"evaluated", one.evaluated},
                        {"same", one.differences.empty()},
                        {"differences", as_json(one.differences)}});
    }
    return {{"schema", "gumcert/archive-replay/1"},
            {"program", program},
            {"records", replays.size()},
            {"same", same_again(replays)},
            {"not_evaluated", not_evaluated(replays)},
            {"certificates", list}};
}

}  // namespace gumcert::archive
