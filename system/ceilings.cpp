#include "system/ceilings.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <thread>
#include <utility>

namespace gumcert::system {

namespace {

using Clock = std::chrono::steady_clock;

/// What a process may write to in its memory. Reserved and never touched memory counts here, therefore it is wide. A
/// sanitizer reserves terabytes for its notes: no wall there.
void wall_in([[maybe_unused]] std::uint64_t memory) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    constexpr std::uint64_t k_for_threads = std::uint64_t{256} << 20U;
    rlimit wall{};
    if (::getrlimit(RLIMIT_DATA, &wall) == 0) {
        wall.rlim_cur = std::min<rlim_t>(wall.rlim_cur, 2 * memory + k_for_threads);
        (void)::setrlimit(RLIMIT_DATA, &wall);
    }
#endif
}

void watch(const Ceilings& ceilings, Clock::time_point begin, const std::function<void(Ceiling)>& end) {
    constexpr std::chrono::milliseconds k_look_again{10};
    for (;;) {
        if (ceilings.time.count() > 0 && Clock::now() - begin >= ceilings.time) {
            end(Ceiling::time);
            return;
        }
        if (ceilings.memory > 0 && resident_memory() > ceilings.memory) {
            end(Ceiling::memory);
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
        wall_in(ceilings.memory);
    }
    if (ceilings.memory > 0 || ceilings.time.count() > 0) {
        std::thread(watch, ceilings, Clock::now(), std::move(end)).detach();
    }
}

}  // namespace gumcert::system
