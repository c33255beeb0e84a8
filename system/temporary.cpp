#include "system/temporary.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "system/cleanup.h"

namespace gumcert::system {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view k_part_begin = ".gumcert-";
constexpr std::string_view k_part_end = ".part";
constexpr std::size_t k_part_digits = 16;
constexpr std::string_view k_folder_begin = "gumcert-work-";
constexpr std::size_t k_folder_letters = 6;
constexpr std::string_view k_hexadecimal = "0123456789abcdef";

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category());
}

std::string random_part() {
    std::random_device random;
    std::string name(k_part_begin);
    for (std::size_t digit = 0; digit < k_part_digits; ++digit) {
        name += k_hexadecimal[random() % k_hexadecimal.size()];
    }
    return name += k_part_end;
}

bool is_folder_name(std::string_view name) {
    return name.size() == k_folder_begin.size() + k_folder_letters && name.starts_with(k_folder_begin);
}

/// An open folder of this user that nobody else may enter; -1 for anything else.
int open_own_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    struct stat status = {};
    if (descriptor >= 0 &&
        (::fstat(descriptor, &status) != 0 || status.st_uid != ::geteuid() || (status.st_mode & 0077U) != 0)) {
        ::close(descriptor);
        return -1;
    }
    return descriptor;
}

/// Takes the lock of a new folder. Somebody who removes dead folders may have met it before it was locked.
/// \return the descriptor that holds the lock; -1 when the folder is lost
int lock_new_folder(const fs::path& folder) {
    const int descriptor = open_own_folder(folder);
    if (descriptor < 0) {
        return -1;
    }
    const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    struct stat status = {};
    if (!locked || ::fstat(descriptor, &status) != 0 || status.st_nlink == 0) {
        ::close(descriptor);
        return -1;
    }
    return descriptor;
}

}  // namespace

int write_whole(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(count));
        } else if (count == 0 || errno != EINTR) {
            return count == 0 ? ENOSPC : errno;
        }
    }
    return 0;
}

TemporaryFile::TemporaryFile(const fs::path& folder, mode_t mode) {
    constexpr int k_most_tries = 100;
    for (int i = 0; i < k_most_tries; ++i) {
        path_ = folder / random_part();
        const CleanupLock lock = hold_cleanup();
        remember_file(path_);
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
        if (descriptor_ >= 0) {
            return;
        }
        const int error = errno;
        forget_file(path_);
        if (error != EEXIST) {
            fail(error);
        }
    }
    fail(EEXIST);
}

TemporaryFile::~TemporaryFile() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
    if (!path_.empty()) {
        (void)remove();
    }
}

void TemporaryFile::fill(std::string_view bytes) {
    if (const int error = write_whole(descriptor_, bytes); error != 0) {
        fail(error);
    }
    if (::fsync(descriptor_) != 0) {
        fail(errno);
    }
    if (::close(std::exchange(descriptor_, -1)) != 0) {
        fail(errno);
    }
}

void TemporaryFile::keep() {
    forget_file(path_);
    path_.clear();
}

bool TemporaryFile::remove() {
    const CleanupLock lock = hold_cleanup();
    if (::unlink(path_.c_str()) != 0 && errno != ENOENT) {
        return false;
    }
    keep();
    return true;
}

bool TemporaryFile::is_name(std::string_view name) {
    return name.size() == k_part_begin.size() + k_part_digits + k_part_end.size() && name.starts_with(k_part_begin) &&
           name.ends_with(k_part_end) &&
           name.substr(k_part_begin.size(), k_part_digits).find_first_not_of(k_hexadecimal) == std::string_view::npos;
}

TemporaryFolder::TemporaryFolder(const fs::path& parent) {
    (void)remove_dead_folders(parent);
    const std::string pattern =
        (fs::absolute(parent) / (std::string(k_folder_begin) + std::string(k_folder_letters, 'X'))).string();
    constexpr int k_most_tries = 10;
    for (int i = 0; i < k_most_tries; ++i) {
        std::string name = pattern;
        const CleanupLock lock = hold_cleanup();
        if (::mkdtemp(name.data()) == nullptr) {
            fail(errno);
        }
        path_ = name;
        remember_folder(path_);
        lock_ = lock_new_folder(path_);
        if (lock_ >= 0) {
            return;
        }
        std::error_code ignored;
        fs::remove_all(path_, ignored);
        forget_folder(path_);
    }
    fail(EBUSY);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    forget_folder(path_);
    ::close(lock_);
}

std::size_t remove_dead_folders(const fs::path& parent) {
    std::vector<fs::path> candidates;
    std::error_code error;
    for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error)) {
        if (is_folder_name(entry->path().filename().string())) {
            candidates.push_back(entry->path());
        }
    }
    std::size_t removed = 0;
    for (const fs::path& folder : candidates) {
        const int descriptor = open_own_folder(folder);
        if (descriptor < 0) {
            continue;
        }
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
            fs::remove_all(folder, error);
            removed += error ? 0U : 1U;
        }
        ::close(descriptor);
    }
    return removed;
}

}  // namespace gumcert::system
