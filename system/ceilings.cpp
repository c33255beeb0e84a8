#include "system/ceilings.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace gumcert::system {

namespace {

using Clock = std::chrono::steady_clock;

/// What a process may write to in its memory. Reserved and never touched memory counts here, therefore it is wide. A
/// sanitizer reserves terabytes for its notes: no wall there.
/// \return the wall that there was
rlimit wall_in([[maybe_unused]] std::uint64_t memory) {
    rlimit before{.rlim_cur = RLIM_INFINITY, .rlim_max = RLIM_INFINITY};
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    constexpr std::uint64_t k_for_threads = std::uint64_t{256} << 20U;
    if (::getrlimit(RLIMIT_DATA, &before) == 0) {
        rlimit wall = before;
        wall.rlim_cur = std::min<rlim_t>(wall.rlim_cur, 2 * memory + k_for_threads);
        (void)::setrlimit(RLIMIT_DATA, &wall);
    }
#endif
    return before;
}

constexpr std::chrono::milliseconds k_look_again{10};

/// \return the ceiling that is reached
std::optional<Ceiling> reached(const Ceilings& ceilings, Clock::time_point begin) {
    if (ceilings.time.count() > 0 && Clock::now() - begin >= ceilings.time) {
        return Ceiling::time;
    }
    if (ceilings.memory > 0 && resident_memory() > ceilings.memory) {
        return Ceiling::memory;
    }
    return std::nullopt;
}

void watch(const Ceilings& ceilings, Clock::time_point begin, const std::function<void(Ceiling)>& end) {
    for (;;) {
        if (const std::optional<Ceiling> which = reached(ceilings, begin)) {
            end(*which);
            return;
        }
        std::this_thread::sleep_for(k_look_again);
    }
}

}  // namespace

std::uint64_t resident_memory() {
    // "size resident shared ..." in pages; read without taking memory.
    const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0) {
        return 0;
    }
    std::array<char, 128> text{};
    const ssize_t count = ::read(file, text.data(), text.size() - 1);
    ::close(file);
    if (count <= 0) {
        return 0;
    }
    const char* const end = text.data() + count;
    const char* at = std::find(text.data(), text.data() + count, ' ');
    std::uint64_t pages = 0;
    if (at == end || std::from_chars(at + 1, end, pages).ec != std::errc()) {
        return 0;
    }
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void watch_ceilings(const Ceilings& ceilings, std::function<void(Ceiling)> end) {
    if (ceilings.memory > 0) {
        (void)wall_in(ceilings.memory);
    }
    if (ceilings.memory > 0 || ceilings.time.count() > 0) {
        std::thread(watch, ceilings, Clock::now(), std::move(end)).detach();
    }
}

struct CeilingsOfWork::Watch {
    std::mutex mutex;
    std::condition_variable is_done_or_time;
    bool is_done = false;
    rlimit wall_before{};
    bool has_wall = false;
    std::thread thread;  // the last member: it uses the others
};

CeilingsOfWork::CeilingsOfWork(Ceilings ceilings, std::function<void(Ceiling)> end) {
    if (ceilings.memory == 0 && ceilings.time.count() == 0) {
        return;
    }
    watch_ = std::make_unique<Watch>();
    if (ceilings.memory > 0) {
        ceilings.memory += resident_memory();
        watch_->wall_before = wall_in(ceilings.memory);
        watch_->has_wall = true;
    }
    watch_->thread = std::thread([watch = watch_.get(), ceilings, begin = Clock::now(), end = std::move(end)] {
        std::unique_lock lock(watch->mutex);
        while (!watch->is_done) {
            if (const std::optional<Ceiling> which = reached(ceilings, begin)) {
                end(*which);
                return;
            }
            watch->is_done_or_time.wait_for(lock, k_look_again);
        }
    });
}

CeilingsOfWork::~CeilingsOfWork() {
    if (!watch_) {
        return;
    }
    {
        const std::lock_guard lock(watch_->mutex);
        watch_->is_done = true;
    }
    watch_->is_done_or_time.notify_all();
    watch_->thread.join();
    if (watch_->has_wall) {
        (void)::setrlimit(RLIMIT_DATA, &watch_->wall_before);
    }
}

}  // namespace gumcert::system
