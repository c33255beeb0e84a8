#include "system/temporary.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "system/cleanup.h"

namespace gumcert::system {
namespace {

namespace fs = std::filesystem;

class TemporaryTest : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) / ("temporary_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] static unsigned mode(const fs::path& file) {
        struct stat status = {};
        return lstat(file.c_str(), &status) == 0 ? static_cast<unsigned>(status.st_mode) & 0777U : 0U;
    }
    fs::path folder_;
};

TEST_F(TemporaryTest, FileIsGoneUnlessItIsKept) {
    fs::path gone;
    fs::path kept;
    {
        TemporaryFile one(folder_, 0600);
        TemporaryFile other(folder_, 0600);
        one.fill("abc");
        other.fill("");
        gone = one.path();
        kept = other.path();
        EXPECT_EQ(fs::file_size(gone), 3U);
        EXPECT_EQ(mode(gone), 0600U);
        EXPECT_TRUE(TemporaryFile::is_name(gone.filename().string()));
        other.keep();
    }
    EXPECT_FALSE(fs::exists(gone));
    EXPECT_TRUE(fs::exists(kept));
    EXPECT_THROW(TemporaryFile(folder_ / "nowhere", 0600), std::system_error);
}

TEST_F(TemporaryTest, FileIsGoneAfterCleaningUp) {
    TemporaryFile file(folder_, 0600);
    (void)clean_up(std::chrono::milliseconds(50));
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(TemporaryTest, OnlyOwnNamesAreTaken) {
    for (const char* name :
         {"", "a", ".gumcert-.part", ".gumcert-0123456789abcdeg.part", ".gumcert-0123456789abcdef.par",
          ".gumcert-0123456789abcdef0.part", "gumcert-0123456789abcdef.part", ".gumcert-0123456789ABCDEF.part",
          "a/.gumcert-0123456789abcdef.part"}) {
        EXPECT_FALSE(TemporaryFile::is_name(name)) << name;
    }
    EXPECT_TRUE(TemporaryFile::is_name(".gumcert-0123456789abcdef.part"));
}

TEST_F(TemporaryTest, FolderIsPrivateAndGoesWithWhatIsInIt) {
    {
        const TemporaryFolder work(folder_);
        EXPECT_EQ(mode(work.path()), 0700U);
        std::ofstream(work.path() / "view.json") << "the customer's";
        EXPECT_EQ(remove_dead_folders(folder_), 0U) << "of a living process";
        EXPECT_TRUE(fs::exists(work.path() / "view.json"));
    }
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(TemporaryTest, FoldersOfDeadProcessesAreRemoved) {
    const pid_t child = fork();
    if (child == 0) {
        const TemporaryFolder work(folder_);
        std::ofstream(work.path() / "view.json") << "the customer's";
        kill(getpid(), SIGKILL);
    }
    waitpid(child, nullptr, 0);
    EXPECT_FALSE(fs::is_empty(folder_));
    for (const char* other : {"gumcert-work-", "gumcert-work-1234567", "gumcert-ABCDEF", "work"}) {
        fs::create_directories(folder_ / other);
    }
    fs::create_directories(folder_ / "gumcert-work-opened");
    chmod((folder_ / "gumcert-work-opened").c_str(), 0755);
    fs::create_directory_symlink("work", folder_ / "gumcert-work-linked");
    EXPECT_EQ(remove_dead_folders(folder_), 1U);
    std::size_t left = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) {
        ++left;
    }
    EXPECT_EQ(left, 6U) << "what is not ours stays";
}

TEST_F(TemporaryTest, FoldersOfOtherUsersStay) {
    const fs::path folder = folder_ / "gumcert-work-ABCDEF";
    fs::create_directories(folder);
    chmod(folder.c_str(), 0700);
    if (chown(folder.c_str(), 12345, 12345) != 0) {
        GTEST_SKIP() << "only the superuser can make a folder of another user";
    }
    EXPECT_EQ(remove_dead_folders(folder_), 0U);
    EXPECT_TRUE(fs::exists(folder));
}

}  // namespace
}  // namespace gumcert::system
