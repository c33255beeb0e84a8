#include "system/new_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "system/cleanup.h"

namespace gumcert::system {

void rename_to_new(const std::filesystem::path& from, const std::filesystem::path& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) {
        return;
    }
    if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) {
        throw std::system_error(errno, std::generic_category());
    }
    // A file system that cannot tell: looked at before.
    struct stat status = {};
    if (::lstat(to.c_str(), &status) == 0) {
        throw std::system_error(EEXIST, std::generic_category());
    }
    if (::rename(from.c_str(), to.c_str()) != 0) {
        throw std::system_error(errno, std::generic_category());
    }
}

NewFile::NewFile(std::filesystem::path place) : place_(std::move(place)) {
    folder_.emplace(place_.has_parent_path() ? place_.parent_path() : ".");
    part_ = folder_->path() / place_.filename();
}

void NewFile::put_in_place(const std::function<void()>& told) {
    const CleanupLock lock = hold_cleanup();
    rename_to_new(part_, place_);
    if (told) {
        told();
    }
}

}  // namespace gumcert::system
