#include "system/whole_folders.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "system/cleanup.h"
#include "system/new_file.h"

namespace gumcert::system {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_whole(int error) {
    throw std::system_error(error, std::generic_category());
}

/// A new file with some bytes; not on the disk yet.
void write_new(const fs::path& file, std::string_view bytes) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        fail_whole(errno);
    }
    int error = write_whole(descriptor, bytes);
    if (::close(descriptor) != 0 && error == 0) {
        error = errno;
    }
    if (error != 0) {
        fail_whole(error);
    }
}

}  // namespace

WholeFolders::WholeFolders(fs::path parent) : parent_(std::move(parent)) {}

WholeFolders::~WholeFolders() {
    work_.reset();
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
    for (const fs::path& folder : made_) {  // never one that holds something
        (void)::rmdir(folder.c_str());
        forget_folder(folder);
    }
}

void WholeFolders::make_parent() {
    std::error_code error;
    const CleanupLock lock = hold_cleanup();
    for (fs::path missing = fs::absolute(parent_).lexically_normal(); !missing.empty() && !fs::exists(missing, error);
         missing = missing.parent_path()) {
        made_.push_back(missing);
        remember_new_folder(missing);
    }
    fs::create_directories(parent_);
}

fs::path WholeFolders::begun() {
    const std::lock_guard lock(mutex_);
    if (!work_) {
        make_parent();
        descriptor_ = ::open(parent_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (descriptor_ < 0) {
            fail_whole(errno);
        }
        work_.emplace(parent_);
    }
    return work_->path();
}

void WholeFolders::fill(const std::string& name, const std::vector<File>& files) {
    const fs::path folder = begun() / name;
    std::set<fs::path> made;
    for (const auto& [place, bytes] : files) {
        const fs::path file = folder / place;
        if (made.insert(file.parent_path()).second) {
            fs::create_directories(file.parent_path());
        }
        write_new(file, bytes);
    }
    const std::lock_guard lock(mutex_);
    filled_.insert(name);
}

void WholeFolders::put_in_place(const std::function<void(const std::string&)>& told) {
    std::set<std::string> names;
    {
        const std::lock_guard lock(mutex_);
        names.swap(filled_);
    }
    if (names.empty()) {
        return;
    }
    if (::syncfs(descriptor_) != 0) {
        fail_whole(errno);
    }
    for (const std::string& name : names) {
        rename_to_new(work_->path() / name, parent_ / name);
        if (told) {
            told(name);
        }
    }
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != ENOSYS) {
        fail_whole(errno);
    }
}

}  // namespace gumcert::system
