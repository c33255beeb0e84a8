#include "outputs/output_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "encoding/file_bytes.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "outputs/output_set.h"
#include "system/cleanup.h"
#include "system/end_of_memory.h"
#include "system/folder_lock.h"
#include "system/temporary.h"

namespace gumcert::outputs {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> k_names_of_sqlite = {"-wal", "-shm", "-journal"};

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{"GC-STORE-0002", path.string(), what,
                                            "output files appear whole or not at all",
                                            "choose another folder with -o, or free the disk", gum::Severity::error});
}

[[noreturn]] void refuse_kind(const fs::path& path, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{
        "GC-STORE-0005", path.string(), "is " + what + ", and would be replaced by a file",
        "an output is a new file, or takes the place of a regular file",
        "name another file with -o; -o - writes to standard output where a command allows it", gum::Severity::error});
}

std::string reason() {
    return std::strerror(errno);
}  // NOLINT(concurrency-mt-unsafe): one thread writes

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// What stands at a place now; none where nothing does.
std::optional<struct stat> status_of(const fs::path& path) {
    struct stat status = {};
    if (lstat(path.c_str(), &status) == 0) {
        return status;
    }
    if (errno != ENOENT && errno != ENOTDIR) {
        refuse(path, "cannot be looked at: " + reason());
    }
    return std::nullopt;
}

void require_replaceable(const fs::path& file) {
    if (!file.has_filename() || file.filename() == "." || file.filename() == "..") {
        refuse(file, "is a folder, a file is needed");
    }
    if (const std::optional<struct stat> old = status_of(file); old && !S_ISREG(old->st_mode)) {
        if (S_ISDIR(old->st_mode)) {
            refuse(file, "is a folder, a file is needed");
        }
        refuse_kind(file, S_ISLNK(old->st_mode)    ? "a symbolic link"
                          : S_ISFIFO(old->st_mode) ? "a pipe"
                          : S_ISSOCK(old->st_mode) ? "a socket"
                                                   : "a device");
    }
}

/// Where a path leads when every folder of it that is missing has been made.
fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    fs::path whole = fs::weakly_canonical(absolute, error);
    return error ? absolute.lexically_normal() : whole;
}

bool is_inside(const fs::path& file, const fs::path& folder) {
    const auto [left, unused] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return left == folder.end() && folder.begin() != folder.end();
}

/// The inputs of a command as the system knows them: by device and number, which no spelling and no link changes, and
/// by the place that a name leads to.
class KnownInputs {
public:
    explicit KnownInputs(const std::vector<fs::path>& inputs) {
        for (const fs::path& input : inputs) {
            struct stat status = {};
            if (stat(input.c_str(), &status) != 0) {
                continue;
            }
            numbers_.emplace(status.st_dev, status.st_ino);
            const fs::path place = resolved(input);
            if (S_ISDIR(status.st_mode)) {
                folders_.push_back(place);
            }
            places_.insert(place);
        }
    }

    void require_other(const fs::path& output) const {
        const fs::path place = resolved(output);
        struct stat status = {};
        const bool is_there = stat(output.c_str(), &status) == 0 || stat(place.c_str(), &status) == 0;
        const bool same = places_.contains(place) || (is_there && numbers_.contains({status.st_dev, status.st_ino}));
        const auto folder =
            std::find_if(folders_.begin(), folders_.end(), [&](const fs::path& of) { return is_inside(place, of); });
        if (same || folder != folders_.end()) {
            throw gum::StorageError(gum::Diagnostic{"GC-STORE-0004", output.string(),
                                                    same ? "is an input of this command and would be overwritten"
                                                         : "lies in " + folder->string() + ", which this command reads",
                                                    "inputs are never changed", "choose another name with -o",
                                                    gum::Severity::error});
        }
    }

private:
    std::set<std::pair<dev_t, ino_t>> numbers_;
    std::set<fs::path> places_;
    std::vector<fs::path> folders_;
};

[[noreturn]] void refuse_other_writer(const fs::path& path, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{
        "GC-STORE-0008", path.string(), what, "of two commands that write the same files one wins whole",
        "look at what is there now; run the command again to replace it, or choose another folder with -o",
        gum::Severity::error});
}

/// Which file stands in a place, in which state: another text after it was written.
std::string state_of(const fs::path& file) {
    struct stat status = {};
    if (lstat(file.c_str(), &status) != 0) {
        return "";
    }
    std::string state;
    for (const auto number :
         {static_cast<std::int64_t>(status.st_dev), static_cast<std::int64_t>(status.st_ino),
          static_cast<std::int64_t>(status.st_size), static_cast<std::int64_t>(status.st_mtim.tv_sec),
          static_cast<std::int64_t>(status.st_mtim.tv_nsec)}) {
        state += std::to_string(number) + ' ';
    }
    return state;
}

/// Makes a folder with those above it; removes what it made unless it is kept.
class NewFolders {
public:
    explicit NewFolders(const fs::path& folder) {
        std::error_code error;
        for (fs::path missing = resolved(folder); !missing.empty() && !fs::exists(missing, error);
             missing = missing.parent_path()) {
            made_.push_back(missing);
        }
        const system::CleanupLock lock = system::hold_cleanup();
        for (const fs::path& one : made_) {
            system::remember_new_folder(one);
        }
        fs::create_directories(folder, error);
        if (error) {
            remove();
            refuse(folder, "cannot be made: " + error.message());
        }
    }
    ~NewFolders() { remove(); }
    NewFolders(const NewFolders&) = delete;
    NewFolders& operator=(const NewFolders&) = delete;
    void keep() {
        for (const fs::path& folder : made_) {
            system::forget_folder(folder);
        }
        made_.clear();
    }

private:
    void remove() {
        for (const fs::path& folder : made_) {  // the deepest first; never one that holds something
            (void)rmdir(folder.c_str());
        }
        keep();
    }
    std::vector<fs::path> made_;
};

constexpr std::size_t k_largest_output = std::size_t{4} << 30U;

/// SHA-256 of a regular file; "" where there is none, or it cannot be read.
std::string digest_of(const fs::path& file) {
    std::error_code error;
    if (fs::symlink_status(file, error).type() != fs::file_type::regular) {
        return "";
    }
    const encoding::FileBytes read = encoding::read_regular_file(file, k_largest_output);
    return read.failure.empty() && !read.too_long ? encoding::sha256(read.bytes) : std::string();
}

/// Puts a temporary file in the place of another, which has its name then; or in a place where nothing is.
/// \return false, with errno
bool exchange_or_rename(const fs::path& part, const fs::path& file, bool replaces) {
    if (!replaces) {
        return ::rename(part.c_str(), file.c_str()) == 0;
    }
    if (::renameat2(AT_FDCWD, part.c_str(), AT_FDCWD, file.c_str(), RENAME_EXCHANGE) == 0) {
        return true;
    }
    if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) {
        return false;
    }
    // A file system that cannot exchange: the old one steps aside first.
    fs::path aside = part;
    aside += "~";
    if (::rename(file.c_str(), aside.c_str()) != 0) {
        return false;
    }
    if (::rename(part.c_str(), file.c_str()) != 0) {
        const int error = errno;
        (void)::rename(aside.c_str(), file.c_str());
        errno = error;
        return false;
    }
    return ::rename(aside.c_str(), part.c_str()) == 0;
}

bool is_there(const fs::path& file) {
    struct stat status = {};
    return lstat(file.c_str(), &status) == 0;
}

/// Temporary files of this user; whoever made them has ended, because the folder is locked.
std::vector<fs::path> temporary_files_in(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        struct stat status = {};
        if (system::TemporaryFile::is_name(name.ends_with('~') ? name.substr(0, name.size() - 1) : name) &&
            lstat(entry->path().c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid()) {
            found.push_back(entry->path());
        }
    }
    return found;
}

bool needs_restoring(const fs::path& folder) {
    return is_there(folder / k_set_journal) || !temporary_files_in(folder).empty();
}

[[noreturn]] void refuse_restoring(const fs::path& folder, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{
        "GC-STORE-0013", (folder / k_set_journal).string(),
        "the program was interrupted while it put the files of this folder in place; " + what,
        "files that belong together are all old or all new",
        "look at the files of this folder, keep what you need elsewhere, and remove " + std::string(k_set_journal),
        gum::Severity::error});
}

FileSet journal_in(const fs::path& folder) {
    constexpr std::size_t k_largest_journal = std::size_t{16} << 20U;
    struct stat status = {};
    struct stat of_folder = {};
    const fs::path journal = folder / k_set_journal;
    if (lstat(journal.c_str(), &status) != 0 || stat(folder.c_str(), &of_folder) != 0) {
        refuse_restoring(folder, "its journal cannot be looked at: " + reason());
    }
    // Where everybody may make files, but remove his own only, a journal of somebody else could move those of this user.
    if (status.st_uid != geteuid() && (of_folder.st_mode & S_ISVTX) != 0) {
        refuse_restoring(folder, "its journal belongs to another user, who has to complete it");
    }
    const encoding::FileBytes read = encoding::read_regular_file(journal, k_largest_journal);
    const std::optional<SetManifest> whole = read.failure.empty() ? set_manifest_from_json(read.bytes) : std::nullopt;
    const bool good = S_ISREG(status.st_mode) && whole && whole->sets.size() == 1 &&
                      std::none_of(whole->sets[0].begin(), whole->sets[0].end(),
                                   [](const SetFile& file) { return file.part.empty(); });
    if (!good) {
        refuse_restoring(folder, "its journal is damaged");
    }
    return whole->sets[0];
}

/// Completes the set of a journal; where a part of it is lost, takes back what is in place of it.
/// \return whether the set is the new one
bool restore_set(const fs::path& folder, const FileSet& set) {
    std::vector<const SetFile*> in_place;
    std::vector<const SetFile*> waiting;
    bool lost = false;
    for (const SetFile& file : set) {
        if (digest_of(folder / file.name) == file.sha256) {
            in_place.push_back(&file);
        } else if (digest_of(folder / file.part) == file.sha256) {
            waiting.push_back(&file);
        } else {
            lost = true;
        }
    }
    for (const SetFile* file : lost ? in_place : waiting) {
        const fs::path name = folder / file->name;
        const fs::path part = folder / file->part;
        if (lost && !is_there(part)) {
            continue;  // it was the same before and after
        }
        if (!exchange_or_rename(part, name, is_there(name))) {
            refuse_restoring(folder, file->name + " cannot be put in place: " + reason());
        }
    }
    synchronise_folder(folder);
    return !lost;
}

/// \throws gum::StorageError  GC-STORE-0013
std::vector<gum::Diagnostic> restore_folder(const fs::path& folder) {
    const system::CleanupLock to_the_end = system::hold_cleanup();
    std::vector<gum::Diagnostic> done;
    const std::string place = folder.string();
    const bool interrupted = is_there(folder / k_set_journal);
    if (interrupted) {
        const FileSet set = journal_in(folder);
        const bool completed = restore_set(folder, set);
        std::string names;
        for (const SetFile& file : set) {
            if (file.name != k_set_manifest) {
                names += (names.empty() ? "" : ", ") + file.name;
            }
        }
        done.push_back({"GC-STORE-0009", place,
                        "the program was interrupted here while it put files in place, which " +
                            std::string(completed ? "has been completed: " : "has been taken back: ") + names,
                        "files that belong together are all old or all new",
                        completed ? "nothing: they are those of the command that was interrupted"
                                  : "give the command again that was interrupted: they are those from before it",
                        gum::Severity::warning});
    }
    std::size_t removed = 0;
    bool all_gone = true;
    for (const fs::path& file : temporary_files_in(folder)) {
        const bool gone = unlink(file.c_str()) == 0;
        removed += gone ? 1U : 0U;
        all_gone = all_gone && gone;
    }
    if (interrupted) {
        if (!all_gone || unlink((folder / k_set_journal).c_str()) != 0) {
            refuse_restoring(folder, "its files are in order now, but temporary ones cannot be removed: " + reason());
        }
        synchronise_folder(folder);
    } else if (removed > 0) {
        done.push_back(
            {"GC-STORE-0009", place,
             "temporary files of a program that was interrupted here were removed: " + std::to_string(removed),
             "nothing stays behind", "nothing: no output was changed", gum::Severity::note});
    }
    return done;
}

/// New files of one folder, on their way into their places.
class NewFiles {
public:
    NewFiles(const fs::path& folder, const std::vector<OutputFile>& files, bool with_manifest) : folder_(folder) {
        for (const OutputFile& file : files) {
            add(file.path, file.bytes);
        }
        require_replaceable(folder / k_set_manifest);
        require_replaceable(folder / k_set_journal);
        SetManifest old;
        try {
            old = manifest_in(folder);
        } catch (const gum::StorageError&) {
            old = {};  // a damaged one is replaced
        }
        if ((with_manifest && files.size() > 1) || lists(old, names_.front())) {
            FileSet written;
            for (std::size_t i = 0; i < files.size(); ++i) {
                written.push_back({.name = names_[i], .sha256 = digests_[i], .part = ""});
            }
            manifest_text_ = to_json(with_written(old, std::move(written)));
            if (!set_manifest_from_json(manifest_text_)) {
                refuse(folder, "a name in it is not UTF-8");
            }
            add(folder / k_set_manifest, manifest_text_);
        }
    }

    void put_in_place() {
        const system::CleanupLock to_the_end = system::hold_cleanup();
        system::require_memory();
        if (parts_.size() == 1) {
            if (::rename(parts_[0]->path().c_str(), places_[0].c_str()) != 0) {
                refuse(places_[0], "cannot be put in place: " + reason());
            }
            parts_[0]->keep();
            synchronise_folder(folder_);
            return;
        }
        begin_journal();
        try {
            for (; in_place_ < parts_.size(); ++in_place_) {
                if (!exchange_or_rename(parts_[in_place_]->path(), places_[in_place_], replaces_[in_place_])) {
                    refuse(places_[in_place_], "cannot be put in place: " + reason());
                }
            }
            synchronise_folder(folder_);
        } catch (...) {
            take_back();
            throw;
        }
        // The set is the new one; from here on nothing fails. The journal goes last: while it is there, the next command
        // removes what this one could not.
        bool all_gone = true;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (replaces_[i]) {
                all_gone = parts_[i]->remove() && all_gone;
            } else {
                parts_[i]->keep();
            }
        }
        if (all_gone) {
            (void)unlink((folder_ / k_set_journal).c_str());
        }
    }

private:
    void add(const fs::path& place, const std::string& bytes) {
        const std::optional<struct stat> old = status_of(place);
        try {
            parts_.push_back(std::make_unique<system::TemporaryFile>(folder_, old ? 0600 : 0666));
        } catch (const std::system_error& error) {
            refuse(place, "no file can be made beside it: " + error.code().message());
        }
        if (old) {
            // The owner first: a change of owner may take rights away. Only the superuser can give files away.
            if (old->st_uid != geteuid() || old->st_gid != getegid()) {
                (void)!fchown(parts_.back()->descriptor(), old->st_uid, old->st_gid);
            }
            if (fchmod(parts_.back()->descriptor(), old->st_mode & 0777U) != 0) {
                refuse(place, "its permissions cannot be kept: " + reason());
            }
        }
        fill(*parts_.back(), place, bytes);
        places_.push_back(place);
        replaces_.push_back(old.has_value());
        names_.push_back(place.filename().string());
        digests_.push_back(encoding::sha256(bytes));
    }

    static void fill(system::TemporaryFile& part, const fs::path& place, const std::string& bytes) {
        try {
            part.fill(bytes);
        } catch (const std::system_error& error) {
            refuse(place, "cannot be written: " + error.code().message());
        }
    }

    /// From here on the new set can be completed, whatever happens to this process.
    void begin_journal() {
        const fs::path place = folder_ / k_set_journal;
        FileSet set;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            set.push_back({.name = names_[i], .sha256 = digests_[i], .part = parts_[i]->path().filename().string()});
        }
        try {
            system::TemporaryFile journal(folder_, 0600);
            fill(journal, place, to_json({{std::move(set)}}));
            if (::rename(journal.path().c_str(), place.c_str()) != 0) {
                refuse(place, "cannot be put in place: " + reason());
            }
            journal.keep();
        } catch (const std::system_error& error) {
            refuse(place, "cannot be written: " + error.code().message());
        }
        try {
            synchronise_folder(folder_);
        } catch (...) {
            take_back();
            throw;
        }
    }

    /// The old files return. Where that fails, journal and temporary files stay, and the next command completes the set.
    void take_back() {
        bool taken_back = true;
        while (in_place_ > 0) {
            --in_place_;
            const fs::path& part = parts_[in_place_]->path();
            taken_back = (replaces_[in_place_] ? exchange_or_rename(part, places_[in_place_], true)
                                               : ::rename(places_[in_place_].c_str(), part.c_str()) == 0) &&
                         taken_back;
        }
        for (const std::unique_ptr<system::TemporaryFile>& part : parts_) {
            if (taken_back) {
                taken_back = part->remove();
            } else {
                part->keep();
            }
        }
        if (taken_back) {
            (void)unlink((folder_ / k_set_journal).c_str());
        }
    }

    fs::path folder_;
    std::vector<std::unique_ptr<system::TemporaryFile>> parts_;
    std::vector<fs::path> places_;
    std::vector<bool> replaces_;  ///< whether the place had a file
    std::vector<std::string> names_;
    std::vector<std::string> digests_;
    std::string manifest_text_;
    std::size_t in_place_ = 0;  ///< the first so many are in their places
};

}  // namespace

void synchronise_folder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) {
        refuse(folder, "cannot be opened: " + reason());
    }
    const bool failed = fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP && errno != ENOSYS;
    const std::string why = failed ? reason() : "";
    close(descriptor);
    if (failed) {
        refuse(folder, "cannot be brought to the disk: " + why);
    }
}

bool is_beside_an_archive(const fs::path& file) {
    constexpr std::string_view k_beginning = "SQLite format 3";
    const std::string name = resolved(file).string();
    return std::any_of(k_names_of_sqlite.begin(), k_names_of_sqlite.end(), [&](std::string_view ending) {
        if (!name.ends_with(ending)) {
            return false;
        }
        const std::string archive = name.substr(0, name.size() - ending.size());
        std::error_code error;
        std::string beginning(k_beginning.size(), '\0');
        return fs::is_regular_file(archive, error) &&
               std::ifstream(archive, std::ios::binary)
                   .read(beginning.data(), static_cast<std::streamsize>(beginning.size())) &&
               beginning == k_beginning;
    });
}

void require_writable(const fs::path& file) {
    require_replaceable(file);
    if (is_beside_an_archive(file)) {
        throw gum::StorageError(gum::Diagnostic{"GC-STORE-0004", file.string(),
                                                "is the name of a file that SQLite keeps beside the archive",
                                                "inputs are never changed", "choose another name with -o"});
    }
    std::error_code error;
    // The first folder upwards that exists decides; what is below it will be made.
    fs::path folder = resolved(folder_of(file));
    while (!fs::exists(folder, error) && folder.has_relative_path()) {
        folder = folder.parent_path();
    }
    if (!fs::is_directory(folder, error)) {
        refuse(folder, "is not a folder");
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        refuse(folder, "cannot be written: " + reason());
    }
}

void require_not_inputs(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
    const KnownInputs known(inputs);
    for (const fs::path& output : outputs) {
        known.require_other(output);
    }
}

void require_not_an_input(const fs::path& output, const std::vector<fs::path>& inputs) {
    require_not_inputs({output}, inputs);
}

OutputsAtStart::OutputsAtStart(const std::vector<fs::path>& outputs) {
    for (const fs::path& output : outputs) {
        states_.emplace(resolved(output), state_of(output));
    }
}

void OutputsAtStart::require_unchanged(const fs::path& output) const {
    const auto found = states_.find(resolved(output));
    if (found != states_.end() && found->second != state_of(output)) {
        refuse_other_writer(output, "was written by another program while this command was at work");
    }
}

std::vector<gum::Diagnostic> restore_outputs(const std::vector<fs::path>& outputs) {
    std::set<fs::path> folders;
    for (const fs::path& output : outputs) {
        folders.insert(folder_of(output));
    }
    std::vector<gum::Diagnostic> done;
    for (const fs::path& folder : folders) {
        const system::FolderLock lock(folder, false, std::chrono::milliseconds(0));
        if (lock.state() == system::FolderLock::State::held && needs_restoring(folder)) {
            std::vector<gum::Diagnostic> here = restore_folder(folder);
            done.insert(done.end(), here.begin(), here.end());
        }
    }
    return done;
}

void write_files(const std::vector<OutputFile>& files, const std::vector<fs::path>& inputs,
                 const OutputsAtStart& at_start, bool with_manifest) {
    const KnownInputs known(inputs);
    for (const OutputFile& file : files) {
        require_writable(file.path);  // before the first is in place
        known.require_other(file.path);
    }
    if (files.empty()) {
        return;
    }
    const fs::path folder = folder_of(files.front().path);
    std::set<fs::path> places;
    for (const OutputFile& file : files) {
        if (resolved(file.path).parent_path() != resolved(files.front().path).parent_path()) {
            throw std::logic_error("files that are written together lie in one folder");
        }
        if (!places.insert(resolved(file.path)).second) {
            refuse(file.path, "two outputs of this command would be written there");
        }
    }
    NewFolders made(folder);
    constexpr std::chrono::seconds k_patience{30};  // another command that writes beside this one needs moments
    const system::FolderLock lock(folder, false, k_patience);
    if (lock.state() == system::FolderLock::State::busy) {
        refuse_other_writer(folder, "another program writes there, and has not ended within 30 s");
    }
    if (lock.state() == system::FolderLock::State::held || is_there(folder / k_set_journal)) {
        (void)restore_folder(folder);
    }
    for (const OutputFile& file : files) {
        require_replaceable(file.path);  // the folder exists now, and something may have come meanwhile
        known.require_other(file.path);
        at_start.require_unchanged(file.path);
    }
    NewFiles(folder, files, with_manifest).put_in_place();
    made.keep();
}

}  // namespace gumcert::outputs
