#include "system/ceilings.h"

#include <gtest/gtest.h>

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

TEST(Ceilings, NoneIsNone) {
    watch_ceilings({}, [](Ceiling) { ADD_FAILURE() << "nothing was to be watched"; });
    std::this_thread::sleep_for(milliseconds(50));
}

}  // namespace
}  // namespace gumcert::system
