#include "system/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace gumcert::system {

FolderLock::FolderLock(const std::filesystem::path& folder, bool shared, std::chrono::milliseconds patience) {
    using Clock = std::chrono::steady_clock;
    descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) {
        return;
    }
    const Clock::time_point deadline = Clock::now() + patience;
    while (::flock(descriptor_, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0) {
        if (errno == EINTR) {
            continue;
        }
        if (errno != EWOULDBLOCK) {
            return;
        }
        if (Clock::now() >= deadline) {
            state_ = State::busy;
            return;
        }
        constexpr useconds_t k_between_tries = 5000;  // [us]
        ::usleep(k_between_tries);
    }
    state_ = State::held;
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

}  // namespace gumcert::system
