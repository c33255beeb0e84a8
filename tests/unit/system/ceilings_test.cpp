#include "system/ceilings.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <thread>

namespace gumcert::system {
namespace {

using std::chrono::milliseconds;

/// Waits for what a thread says.
bool comes(const std::atomic<int>& said, int what) {
    for (int i = 0; i < 1000 && said != what; ++i) {
        std::this_thread::sleep_for(milliseconds(10));
    }
    return said == what;
}

TEST(Ceilings, TimeIsToldOnce) {
    static std::atomic<int> told{0};
    watch_ceilings({.memory = 0, .time = milliseconds(30)},
                   [](Ceiling which) { told += which == Ceiling::time ? 1 : 99; });
    EXPECT_EQ(told, 0);
    EXPECT_TRUE(comes(told, 1));
    std::this_thread::sleep_for(milliseconds(50));
    EXPECT_EQ(told, 1);
}

TEST(Ceilings, MemoryCountsWhenItIsUsed) {
    constexpr std::size_t k_block = std::size_t{64} << 20U;
    static std::atomic<int> told{0};
    const std::uint64_t before = resident_memory();
    ASSERT_GT(before, 0U);
    watch_ceilings({.memory = before + k_block, .time = milliseconds(0)},
                   [](Ceiling which) { told = which == Ceiling::memory ? 1 : 99; });
    const std::unique_ptr<char[]> reserved(new char[2 * k_block]);
    std::this_thread::sleep_for(milliseconds(100));
    EXPECT_EQ(told, 0) << "what is reserved is not taken";
    std::memset(reserved.get(), 1, 2 * k_block);
    EXPECT_TRUE(comes(told, 1));
    EXPECT_GT(resident_memory(), before + k_block);
}

TEST(CeilingsOfWork, EndWithTheWork) {
    const auto tell = [](Ceiling which) { ADD_FAILURE() << (which == Ceiling::time ? "time" : "memory"); };
    for (int i = 0; i < 20; ++i) {
        const CeilingsOfWork work({.memory = std::uint64_t{1} << 40U, .time = milliseconds(2000)}, tell);
    }
    std::this_thread::sleep_for(milliseconds(2200));  // the last one would tell by now
    const CeilingsOfWork none({}, tell);
}

TEST(CeilingsOfWork, TellTimeAndWhatIsTakenMeanwhile) {
    std::atomic<int> told{0};
    {
        const CeilingsOfWork work({.memory = 0, .time = milliseconds(30)},
                                  [&](Ceiling which) { told = which == Ceiling::time ? 1 : 99; });
        EXPECT_TRUE(comes(told, 1));
    }
    constexpr std::size_t k_block = std::size_t{64} << 20U;
    const std::unique_ptr<char[]> before(new char[2 * k_block]);
    std::memset(before.get(), 1, 2 * k_block);
    const CeilingsOfWork work({.memory = k_block, .time = milliseconds(0)},
                              [&](Ceiling which) { told = which == Ceiling::memory ? 2 : 99; });
    std::this_thread::sleep_for(milliseconds(50));
    EXPECT_EQ(told, 1) << "what was in memory before does not count";
    const std::unique_ptr<char[]> more(new char[2 * k_block]);
    std::memset(more.get(), 1, 2 * k_block);
    EXPECT_TRUE(comes(told, 2));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(CeilingsOfWork, LeaveTheWallOfTheSystemAsItWas) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_DATA, &before), 0);
    {
        const CeilingsOfWork work({.memory = std::uint64_t{1} << 30U, .time = milliseconds(0)}, [](Ceiling) {});
        rlimit wall{};
        ASSERT_EQ(::getrlimit(RLIMIT_DATA, &wall), 0);
        EXPECT_LE(wall.rlim_cur, std::uint64_t{4} << 30U);
    }
    rlimit after{};
    ASSERT_EQ(::getrlimit(RLIMIT_DATA, &after), 0);
    EXPECT_EQ(after.rlim_cur, before.rlim_cur);
}
#endif

TEST(Ceilings, NoneIsNone) {
    watch_ceilings({}, [](Ceiling) { ADD_FAILURE() << "nothing was to be watched"; });
    std::this_thread::sleep_for(milliseconds(50));
}

}  // namespace
}  // namespace gumcert::system
