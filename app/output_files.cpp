#include "app/output_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

namespace {

namespace fs = std::filesystem;

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

void synchronise_folder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        (void)fsync(descriptor);  // a file system that cannot synchronise a folder does not lose the file for it
        close(descriptor);
    }
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

/// A new file beside its place, with a name that nobody can know beforehand. Nothing that is there already is opened.
std::pair<int, fs::path> temporary_file(const fs::path& folder, mode_t mode) {
    constexpr int k_most_tries = 100;
    std::random_device random;
    for (int i = 0; i < k_most_tries; ++i) {
        constexpr std::array k_digits{'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'a', 'b', 'c', 'd', 'e', 'f'};
        std::string name = ".gumcert-";
        for (int digit = 0; digit < 16; ++digit) {
            name += k_digits[random() % k_digits.size()];
        }
        const fs::path path = folder / (name + ".part");
        const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
        if (descriptor >= 0) {
            return {descriptor, path};
        }
        if (errno != EEXIST) {
            refuse(folder, "no file can be made in it: " + reason());
        }
    }
    refuse(folder, "no file can be made in it: no free name was found");
}

void write_whole(int descriptor, const fs::path& path, const std::string& bytes) {
    std::size_t written = 0;
    while (written < bytes.size()) {
        const ssize_t count = write(descriptor, bytes.data() + written, bytes.size() - written);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            const std::string why = reason();
            close(descriptor);
            refuse(path, "cannot be written: " + why);
        }
        written += static_cast<std::size_t>(count);
    }
    const bool synchronised = fsync(descriptor) == 0;
    const std::string why = synchronised ? "" : reason();
    if (close(descriptor) != 0 || !synchronised) {
        refuse(path, "cannot be brought to the disk: " + (synchronised ? reason() : why));
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

}  // namespace

void require_writable(const fs::path& file) {
    require_replaceable(file);
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

void write_files(const std::vector<OutputFile>& files, const std::vector<fs::path>& inputs) {
    const KnownInputs known(inputs);
    for (const OutputFile& file : files) {
        require_writable(file.path);  // before the first is in place
        known.require_other(file.path);
    }
    std::vector<fs::path> temporary;
    try {
        std::set<fs::path> places;
        for (const OutputFile& file : files) {
            std::error_code error;
            fs::create_directories(folder_of(file.path), error);
            if (error) {
                refuse(folder_of(file.path), "cannot be made: " + error.message());
            }
            if (!places.insert(resolved(file.path)).second) {
                refuse(file.path, "two outputs of this command would be written there");
            }
            const std::optional<struct stat> old = status_of(file.path);
            const auto [descriptor, path] = temporary_file(folder_of(file.path), old ? 0600 : 0666);
            temporary.push_back(path);
            if (old) {
                // The owner first: a change of owner may take rights away. Only the superuser can give files away.
                if (old->st_uid != geteuid() || old->st_gid != getegid()) {
                    (void)!fchown(descriptor, old->st_uid, old->st_gid);
                }
                if (fchmod(descriptor, old->st_mode & 0777U) != 0) {
                    const std::string why = reason();
                    close(descriptor);
                    refuse(file.path, "its permissions cannot be kept: " + why);
                }
            }
            write_whole(descriptor, file.path, file.bytes);
        }
        for (const OutputFile& file : files) {
            require_replaceable(file.path);  // all folders exist now, and something may have come meanwhile
            known.require_other(file.path);
        }
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (std::rename(temporary[i].c_str(), files[i].path.c_str()) != 0) {
                refuse(files[i].path, "cannot be put in place: " + reason());
            }
        }
    } catch (...) {
        for (const fs::path& path : temporary) {
            std::error_code ignored;
            fs::remove(path, ignored);
        }
        throw;
    }
    std::set<fs::path> folders;
    for (const OutputFile& file : files) {
        folders.insert(folder_of(file.path));
    }
    for (const fs::path& folder : folders) {
        synchronise_folder(folder);
    }
}

}  // namespace gumcert::app
