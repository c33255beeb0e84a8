#include "system/cleanup.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace gumcert::system {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::milliseconds k_moment{50};

class CleanupTest : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) / ("cleanup_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    void put(const std::string& name) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << "x";
    }
    fs::path folder_;
};

TEST_F(CleanupTest, RemovesWhatIsRememberedAndNothingElse) {
    put("file");
    put("forgotten");
    put("others");
    put("work/deep/er");
    fs::create_directories(folder_ / "new/deeper");
    fs::create_directories(folder_ / "used");
    put("used/by somebody");
    remember_file(folder_ / "file");
    remember_file(folder_ / "forgotten");
    forget_file(folder_ / "forgotten");
    remember_folder(folder_ / "work");
    for (const char* name : {"new", "new/deeper", "used"}) {
        remember_new_folder(folder_ / name);
    }
    EXPECT_TRUE(clean_up(k_moment).owns_lock());
    EXPECT_FALSE(fs::exists(folder_ / "file"));
    EXPECT_FALSE(fs::exists(folder_ / "work"));
    EXPECT_FALSE(fs::exists(folder_ / "new"));
    EXPECT_TRUE(fs::exists(folder_ / "used/by somebody"));
    EXPECT_TRUE(fs::exists(folder_ / "forgotten"));
    EXPECT_TRUE(fs::exists(folder_ / "others"));
}

TEST_F(CleanupTest, EndsChildren) {
    const pid_t child = fork();
    if (child == 0) {
        for (;;) {
            pause();
        }
    }
    remember_child(child);
    EXPECT_TRUE(clean_up(k_moment).owns_lock());
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGKILL);
}

TEST_F(CleanupTest, WaitsForWhatIsBroughtToItsEnd) {
    put("file");
    remember_file(folder_ / "file");
    {
        const CleanupLock lock = hold_cleanup();
        std::thread([&] {
            EXPECT_FALSE(clean_up(k_moment).owns_lock());
            EXPECT_TRUE(fs::exists(folder_ / "file"));
        }).join();
    }
    std::thread([&] { EXPECT_TRUE(clean_up(k_moment).owns_lock()); }).join();
    EXPECT_FALSE(fs::exists(folder_ / "file"));
}

}  // namespace
}  // namespace gumcert::system
