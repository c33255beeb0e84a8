#include "app/cli/archive/whole_archive.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "app/cli/archive/action.h"
#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/terminal.h"
#include "archive/archive.h"
#include "archive/store/open_store.h"
#include "archive/store/sqlite_store.h"
#include "archive/verification.h"
#include "encoding/sha2.h"
#include "outputs/output_files.h"
#include "system/cleanup.h"
#include "system/new_file.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A new archive: a file under a temporary name until it is whole, or a database, which does so by itself.
class NewArchive {
public:
    /// \throws gum::StorageError  GC-ARCHIVE-0002, -0010, GC-STORE-0002
    explicit NewArchive(const std::string& address) : address_(address) {
        if (!archive::is_postgresql(address)) {
            archive::require_place_of_archive(address);
            told_as_storage([&] { file_.emplace(address); });
        }
    }
    /// Where it is made.
    [[nodiscard]] std::string address() const { return file_ ? file_->part().string() : address_; }
    /// As people know it.
    [[nodiscard]] std::string name_of(const archive::Store& store) const { return file_ ? address_ : store.name(); }
    /// Nobody has it open.
    void put_in_place() {
        if (file_) {
            told_as_storage([&] { file_->put_in_place([&] { tell_written(file_->place()); }); });
            outputs::synchronise_folder(file_->place().has_parent_path() ? file_->place().parent_path() : ".");
        }
    }

private:
    std::string address_;
    std::optional<system::NewFile> file_;

    void told_as_storage(const std::function<void()>& work) const {
        try {
            work();
        } catch (const std::system_error& error) {
            throw gum::StorageError(gum::Diagnostic{
                "GC-STORE-0002", address_, "cannot be made: " + error.code().message(),
                "output files appear whole or not at all", "choose another folder with -o, or free the disk"});
        }
    }
};

std::string random_nonce() {
    std::random_device source;
    std::string bytes;
    for (int i = 0; i < 16; ++i) {
        bytes += static_cast<char>(source() & 0xFFU);
    }
    return encoding::hexadecimal(bytes);
}

/// "R. Lin=author,reviewer" of each --person.
std::map<std::string, std::set<std::string>> persons_of(const ArchiveOptions& options) {
    std::map<std::string, std::set<std::string>> persons;
    for (const std::string& word : options.persons) {
        const std::size_t equals = word.find('=');
        std::set<std::string>& roles = persons[word.substr(0, equals)];
        std::size_t start = equals == std::string::npos ? word.size() : equals + 1;
        while (start < word.size()) {
            const std::size_t end = std::min(word.find(',', start), word.size());
            roles.insert(word.substr(start, end - start));
            start = end + 1;
        }
        if (equals == 0 || roles.empty() ||
            !std::all_of(roles.begin(), roles.end(), [](const std::string& role) { return archive::is_role(role); })) {
            refuse_usage("--person " + word, "is no name with roles",
                         "NAME=ROLE,ROLE with the roles author, reviewer, authoriser, keeper", "correct it");
        }
    }
    return persons;
}

archive::Settings settings_of(const ArchiveOptions& options) {
    return {.four_eyes = !options.one_pair_of_eyes, .numbering = options.numbering, .persons = persons_of(options)};
}

}  // namespace

ExitCode init_archive(const ArchiveOptions& options, const CommonOptions& common) {
    const archive::LogEntry first =
        archive::first_entry(settings_of(options), "gumcert " + program_name(), random_nonce(), request_of(options));
    NewArchive made(options.store);
    std::string name;
    const archive::Written written = carried_out([&] {
        name = made.name_of(*archive::create_store(made.address(), first));
        made.put_in_place();
        return archive::Written{first, false};
    });
    if (!common.quiet && !as_json(options)) {
        print_to_stdout("Begun: {}\n", text::one_line(name));
    }
    return told(written, options, common);
}

ExitCode change_settings(const ArchiveOptions& options, const CommonOptions& common) {
    const auto store = opened(options, archive::Access::read_and_write);
    return told(carried_out([&] {
                    return archive::Archive(*store).change_settings(settings_of(options), request_of(options));
                }),
                options, common);
}

/// The copy is looked at before it gets its name, and noted in the log before anybody relies on it.
ExitCode back_up(const ArchiveOptions& options, const CommonOptions& common) {
    const fs::path file = options.output;
    outputs::require_writable(file);
    const auto store = opened(options, archive::Access::read_and_write);
    std::error_code error;
    if (fs::exists(file, error) || error) {
        refuse_usage(file.string(), "is there already", "a backup is a new file", "choose another name");
    }
    NewArchive made(options.output);
    store->copy_to(made.address());
    ProgressLine progress(!common.quiet);
    archive::Verification verification;
    {
        const auto copy = archive::open_store(made.address(), archive::Access::read_only);
        verification =
            archive::verify_store(*copy, {}, [&](const std::string& text) { progress("verifying: " + text); });
    }
    progress.clear();
    if (!verification.sound() || !verification.head) {
        print_findings(verification.findings, common);
        throw gum::StorageError(gum::Diagnostic{.code = "GC-ARCHIVE-0011",
                                                .where = file.string(),
                                                .what = "the copy cannot be verified, and was removed",
                                                .rule = "a backup is verified before it counts as one",
                                                .action = "see what gumcert archive verify says of the archive"});
    }
    // Where the entry is refused, the copy goes; a signal finds both or none of them.
    const auto both = system::hold_cleanup();
    const archive::Written written = carried_out([&] {
        return archive::Archive(*store).note_backup(file.filename().string(), *verification.head, request_of(options));
    });
    made.put_in_place();
    // Nobody writes into a copy by mistake: two archives would give out the same numbers. Where a disk knows no such rights it
    // is a copy all the same.
    constexpr fs::perms k_write = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
    fs::permissions(file, k_write, fs::perm_options::remove, error);
    return told(written, options, common);
}

ExitCode migrate(const ArchiveOptions& options, const CommonOptions& common) {
    const auto from = opened(options, archive::Access::read_only);
    const archive::Head head = archive::Archive(*from).head();
    ProgressLine progress(!common.quiet);
    progress("copying " + text::count_of(head.size, "entry"));
    NewArchive made(options.to);
    std::unique_ptr<archive::Store> to;
    std::string name;
    {
        std::optional<EntryUnderWay> under_way;  // a file is not there before it is in its place
        if (archive::is_postgresql(options.to)) {
            under_way.emplace();
        }
        to = archive::replay_into(*from, made.address(), archive::list_again);
        name = made.name_of(*to);
        if (under_way) {
            under_way->is_in_the_log(text::count_of(head.size, "entry") + " in " + text::one_line(name));
        }
    }
    const archive::Verification verification =
        archive::verify_store(*to, {head}, [&](const std::string& text) { progress("verifying: " + text); });
    progress.clear();
    print_findings(verification.findings, common);
    if (!verification.sound()) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-ARCHIVE-0011",
                            .where = name,
                            .what = archive::is_postgresql(options.to) ? "the copy cannot be verified"
                                                                       : "the copy cannot be verified, and was removed",
                            .rule = "a copy is verified before it counts as one",
                            .action = archive::is_postgresql(options.to)
                                          ? "remove it, and see what gumcert archive verify says of the archive"
                                          : "see what gumcert archive verify says of the archive"});
    }
    to.reset();
    made.put_in_place();
    if (as_json(options)) {
        print_json({{"schema", "gumcert/archive-migration/1"},
                    {"from", from->name()},
                    {"to", name},
                    {"entries", verification.entries},
                    {"contents", verification.contents},
                    {"head", json::parse(archive::to_json(*verification.head))}});
    } else if (!common.quiet) {
        print_to_stdout("{}: sound; {}, {}, {}, as in {}\n  head {} of {}\n", text::one_line(name),
                        text::count_of(static_cast<std::int64_t>(verification.entries), "entry"),
                        text::count_of(static_cast<std::int64_t>(verification.contents), "content"),
                        text::count_of(static_cast<std::int64_t>(verification.certificates), "certificate"),
                        text::one_line(from->name()), encoding::hexadecimal(verification.head->root),
                        verification.head->at);
    }
    return done;
}

}  // namespace gumcert::cli
