#include "app/cli/archive/calculate_again.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/cli/archive/action.h"
#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/share_folder.h"
#include "app/cli/terminal/terminal.h"
#include "archive/archive.h"
#include "archive/certificates/affected_certificates.h"
#include "archive/certificates/archive_replay.h"
#include "archive/certificates/shared_work.h"
#include "archive/store/open_store.h"
#include "archive/store/work_table.h"
#include "evaluation/laboratory_overview.h"
#include "evaluation/read_file.h"
#include "outputs/output_files.h"
#include "system/whole_folders.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

namespace fs = std::filesystem;

/// The table of work that the machines of an archive share.
std::unique_ptr<archive::WorkTable> opened_work(const ArchiveOptions& options) {
    if (!archive::is_postgresql(options.store)) {
        refuse_usage(
            "archive " + options.action, "an archive in a file has no workers",
            "machines share work through the server that has the archive; of a file one command uses all cores",
            "leave out --shared, or migrate the archive to a server");
    }
    return archive::open_work_table(options.store);
}

void wait_for_others() {
    constexpr auto k_pause = std::chrono::milliseconds(200);
    std::this_thread::sleep_for(k_pause);
}

/// Drafts of amendments on the disk, each in a folder of its own. One that a command that was ended has left there is whole,
/// and stays.
class DraftFolders {
public:
    explicit DraftFolders(const fs::path& output) : output_(output), folders_(output) {
        if (!output.empty()) {
            outputs::require_writable(output / "draft");
        }
    }

    [[nodiscard]] archive::DraftSink sink() {
        if (output_.empty()) {
            return {};
        }
        return {.write = [this](const std::vector<outputs::OutputFile>& draft) { told([&] { write(draft); }); },
                .finish =
                    [this] {
                        told([&] {
                            folders_.put_in_place([&](const std::string& name) { tell_written(output_ / name); });
                        });
                    }};
    }

private:
    fs::path output_;
    system::WholeFolders folders_;

    void write(const std::vector<outputs::OutputFile>& draft) {
        const fs::path name = *draft.front().path.begin();
        std::error_code error;
        if (fs::exists(output_ / name, error) || error) {
            if (std::all_of(draft.begin(), draft.end(), [&](const auto& file) { return is_there(file); })) {
                return;
            }
            refuse_usage((output_ / name).string(), "is there already, with other files than those of the draft",
                         "a draft is written into a new folder", "choose another folder with -o");
        }
        std::vector<system::WholeFolders::File> files;
        for (const outputs::OutputFile& file : draft) {
            files.emplace_back(file.path.lexically_relative(name), file.bytes);
        }
        folders_.fill(name.string(), files);
    }

    [[nodiscard]] bool is_there(const outputs::OutputFile& file) const {
        std::error_code error;
        return fs::is_regular_file(output_ / file.path, error) &&
               evaluation::read_file(output_ / file.path) == file.bytes;
    }

    void told(const std::function<void()>& work) const {
        try {
            work();
        } catch (const std::system_error& error) {
            throw gum::StorageError(gum::Diagnostic{
                "GC-STORE-0002", output_.string(), "drafts cannot be written: " + error.code().message(),
                "output files appear whole or not at all", "choose another folder with -o, or free the disk"});
        }
    }
};

void require_query(const ArchiveOptions& options) {
    for (const auto& [name, value] : {std::pair("--source", &options.source), std::pair("--since", &options.since)}) {
        if (value->empty()) {
            refuse_usage("archive affected", std::string(name) + " is missing",
                         "the search is for a standard and the days since it was wrong", "name both");
        }
    }
    for (const std::string* const day : {&options.since, &options.until}) {
        if (!day->empty() && !evaluation::is_day(*day)) {
            refuse_usage("archive affected", *day + " is no day", "a day is written as 2026-11-21", "correct it");
        }
    }
    if (!options.until.empty() && options.until < options.since) {
        refuse_usage("archive affected", "--until " + options.until + " is before --since " + options.since,
                     "the search is for work from the first of the days to the last", "correct them");
    }
    if ((!options.output.empty() || options.shared) && options.register_folder.empty()) {
        refuse_usage("archive affected", options.shared ? "--shared without --register" : "-o without --register",
                     "amendments are drafted of certificates that are calculated again",
                     "name the folder of the laboratory with the corrected standard");
    }
}

}  // namespace

ExitCode replay(const ArchiveOptions& options, const CommonOptions& common) {
    const std::unique_ptr<archive::WorkTable> table = options.shared ? opened_work(options) : nullptr;
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    const std::vector<std::pair<std::string, std::string>> records = archive::records_to_replay(archive, options.named);
    const fs::path templates = templates_folder(options.share);
    const auto threads = static_cast<unsigned>(common.threads);
    const auto watch = [&common] { return progress_within_walls(common, "a record"); };
    ProgressLine progress(!common.quiet);
    archive::Replays replays;
    const auto take = [&](const std::string& number, archive::Replay one) {
        progress.clear();
        print_findings(archive::first_differences(one.differences, number), common);
        replays.emplace_back(number, std::move(one));
    };
    if (table) {
        const archive::WorkToShare shared = archive::work_of_replay(records, program_name());
        archive::ArchiveWorker(archive, *table, threads, templates, watch)
            .finish(shared, wait_for_others, [&](const std::string& text) { progress(text); });
        for (auto& [number, one] : archive::replays_in(*table, shared)) {
            take(number, std::move(one));
        }
        table->remove(shared.work.id);
    } else {
        for (std::size_t i = 0; i < records.size(); ++i) {
            const auto& [number, record] = records[i];
            progress(fmt::format("{} of {}: {}", i + 1, records.size(), text::one_line(number)));
            take(number,
                 archive::replay_record(archive.content(record).value_or(""), number, threads, templates, watch()));
        }
    }
    if (as_json(options)) {
        print_json(archive::replay_json(replays, program_name()));
    } else if (!common.quiet) {
        print_to_stdout("{}", archive::replay_text(replays, program_name()));
    }
    return archive::same_again(replays) == replays.size() ? done : negative_answer;
}

ExitCode find_affected(const ArchiveOptions& options, const CommonOptions& common) {
    require_query(options);
    std::string corrected;
    if (!options.register_folder.empty()) {
        const fs::path file = fs::path(options.register_folder) / "standards" / (options.source + ".json");
        std::error_code error;
        if (!fs::exists(file, error)) {
            refuse_usage("archive affected", "there is no " + file.string(),
                         "with --register the standard is named by its identification in the register, which is the "
                         "folder with laboratory.json",
                         "name that with --source, in place of the number of a certificate of it, or the other folder");
        }
        corrected = evaluation::read_file(file);
    }
    const std::unique_ptr<archive::WorkTable> table = options.shared ? opened_work(options) : nullptr;
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    ProgressLine progress(!common.quiet);
    const auto tell = [&](const std::string& text) { progress(text); };
    const archive::WrongStandard standard{.name = options.source, .since = options.since, .until = options.until};
    const auto threads = static_cast<unsigned>(common.threads);
    std::vector<gum::Diagnostic> remarks;
    std::vector<archive::AffectedCertificate> affected =
        archive::find_affected(archive, standard, threads, tell, &remarks);
    progress.clear();
    print_messages(remarks, common);
    std::string work;
    if (!options.register_folder.empty()) {
        const archive::Correction correction{
            .standard = options.source,
            .corrected = corrected,
            .reason = options.why.empty() ? "The standard " + options.source + " was corrected." : options.why,
            .templates = templates_folder(options.share),
            .watch = [&common] { return progress_within_walls(common, "a record"); }};
        if (table) {
            const archive::WorkToShare shared = archive::work_of(affected, correction, program_name());
            archive::ArchiveWorker(archive, *table, threads, correction.templates, correction.watch)
                .finish(shared, wait_for_others, tell);
            archive::take_results(affected, *table, shared);
            work = shared.work.id;
        }
        DraftFolders drafts(options.output);
        archive::recalculate(affected, archive, correction, threads, drafts.sink(), tell);
    }
    progress.clear();
    write_to_stdout(options.format == "json"  ? archive::affected_json(affected, standard)
                    : options.format == "csv" ? archive::affected_csv(affected)
                                              : archive::affected_text(affected));
    if (!work.empty()) {
        table->remove(work);  // what is told need not be kept
    }
    return affected.empty() ? done : negative_answer;
}

/// Does what others share, until there is nothing more; with --wait-for-work it goes on waiting.
ExitCode work_for_others(const ArchiveOptions& options, const CommonOptions& common) {
    const auto table = opened_work(options);
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    archive::ArchiveWorker worker(archive, *table, static_cast<unsigned>(common.threads),
                                  templates_folder(options.share),
                                  [&common] { return progress_within_walls(common, "a record"); });
    ProgressLine progress(!common.quiet);
    std::int64_t done_tasks = 0;
    for (std::optional<archive::SharedWork> work = table->next(program_name()); work || options.wait;
         work = table->next(program_name())) {
        const std::size_t some = work ? worker.do_some(*work) : 0;
        done_tasks += static_cast<std::int64_t>(some);
        progress(text::count_of(done_tasks, "task") + " done");
        if (some == 0) {
            wait_for_others();
        }
    }
    progress.clear();
    if (!common.quiet) {
        const std::size_t unknown = worker.not_evaluated();
        print_to_stdout("{} done{}\n", text::count_of(done_tasks, "task"),
                        unknown > 0 ? fmt::format(", {} of which could not be evaluated", unknown) : "");
    }
    return done;
}

}  // namespace gumcert::cli
