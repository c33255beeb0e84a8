#include "system/folder_lock.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace gumcert::system {
namespace {

namespace fs = std::filesystem;
using State = FolderLock::State;
constexpr std::chrono::milliseconds k_lock_moment{20};

TEST(FolderLockTest, OneWritesOrSeveralRead) {
    const fs::path folder = fs::path(::testing::TempDir()) / ("folder_lock_" + std::to_string(getpid()));
    fs::create_directories(folder);
    {
        std::optional<FolderLock> writer;
        writer.emplace(folder, false, k_lock_moment);
        EXPECT_EQ(writer->state(), State::held);
        EXPECT_EQ(FolderLock(folder, false, k_lock_moment).state(), State::busy);
        EXPECT_EQ(FolderLock(folder, true, k_lock_moment).state(), State::busy);
        writer.reset();
        const FolderLock reader(folder, true, k_lock_moment);
        EXPECT_EQ(reader.state(), State::held);
        EXPECT_EQ(FolderLock(folder, true, k_lock_moment).state(), State::held);
        EXPECT_EQ(FolderLock(folder, false, k_lock_moment).state(), State::busy);
    }
    EXPECT_TRUE(fs::is_empty(folder)) << "no file comes for it";
    fs::remove(folder);
    EXPECT_EQ(FolderLock(folder, false, k_lock_moment).state(), State::unsupported);
}

}  // namespace
}  // namespace gumcert::system
