#include "system/whole_folders.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "tests/support/empty_folder.h"
#include "tests/support/file_content.h"

namespace gumcert::system {
namespace {

namespace fs = std::filesystem;

using test::file_content;

class WholeFoldersTest : public test::EmptyFolder {};

using Names = std::vector<std::string>;

TEST_F(WholeFoldersTest, AppearTogetherWithAllFiles) {
    const fs::path deep = folder_ / "not" / "there";
    {
        WholeFolders folders(deep);
        EXPECT_FALSE(fs::exists(folder_ / "not")) << "nothing is made before it is needed";
        folders.put_in_place();
        folders.fill("a", {{"x", "1"}, {"sub/deeper/y", ""}, {"sub/z", "3"}});
        folders.fill("b", {{"x", std::string_view("\0\n", 2)}});
        EXPECT_FALSE(fs::exists(deep / "a"));
        Names told;
        folders.put_in_place([&](const std::string& name) { told.push_back(name); });
        EXPECT_EQ(told, (Names{"a", "b"}));
        EXPECT_EQ(file_content(deep / "a" / "x"), "1");
        EXPECT_EQ(file_content(deep / "a" / "sub" / "z"), "3");
        EXPECT_TRUE(fs::is_regular_file(deep / "a" / "sub" / "deeper" / "y"));
        EXPECT_EQ(file_content(deep / "b" / "x"), std::string("\0\n", 2));
        folders.fill("c", {{"x", "later"}});
        folders.put_in_place();
        folders.fill("d", {{"x", "never"}});
    }
    EXPECT_EQ(file_content(deep / "c" / "x"), "later");
    folder_ = deep;
    EXPECT_EQ(names(), (Names{"a", "b", "c"})) << "nothing else is left";
    folder_ = deep.parent_path().parent_path();
}

TEST_F(WholeFoldersTest, LeaveNothingWhereNothingWasPutInPlace) {
    {
        WholeFolders folders(folder_ / "new");
        folders.fill("a", {{"x", "1"}});
        EXPECT_TRUE(fs::exists(folder_ / "new"));
    }
    EXPECT_EQ(names(), Names{});
    fs::create_directories(folder_ / "old");
    { WholeFolders(folder_ / "old").fill("a", {{"x", "1"}}); }
    EXPECT_EQ(names(), Names{"old"}) << "what was there stays";
}

TEST_F(WholeFoldersTest, ReplaceNothing) {
    fs::create_directories(folder_ / "b");  // empty: the system would replace it
    std::ofstream(folder_ / "c") << "mine";
    WholeFolders folders(folder_);
    for (const char* const name : {"a", "b", "c"}) {
        folders.fill(name, {{"x", "1"}});
    }
    try {
        folders.put_in_place();
        FAIL() << "was replaced";
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code(), std::errc::file_exists);
    }
    EXPECT_EQ(file_content(folder_ / "a" / "x"), "1");
    EXPECT_TRUE(fs::is_empty(folder_ / "b"));
    EXPECT_EQ(file_content(folder_ / "c"), "mine");
    EXPECT_THROW(folders.fill("d", {{"x", "1"}, {"x", "2"}}), std::system_error) << "a file twice";
    EXPECT_THROW(folders.fill("e", {{"x", "1"}, {"x/y", "2"}}), std::system_error) << "a file that is a folder";
    EXPECT_THROW(WholeFolders("/proc/nowhere").fill("a", {{"x", "1"}}), std::system_error);
}

TEST_F(WholeFoldersTest, AreFilledBySeveralThreads) {
    constexpr int k_threads = 4;
    constexpr int k_folders = 50;
    WholeFolders folders(folder_);
    std::vector<std::thread> threads;
    for (int thread = 0; thread < k_threads; ++thread) {
        threads.emplace_back([&folders, thread] {
            for (int i = 0; i < k_folders; ++i) {
                const std::string name = std::to_string(thread) + "_" + std::to_string(i);
                folders.fill(name, {{"sub/x", name}});
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    folders.put_in_place();
    const Names all = names();
    EXPECT_EQ(all.size(), static_cast<std::size_t>(k_threads * k_folders) + 1U) << "and the temporary one";
    for (const std::string& name : all) {
        EXPECT_EQ(file_content(folder_ / name / "sub" / "x"), name.starts_with("gumcert-work-") ? "" : name);
    }
}

// Killed at any time: what is in place is whole, and the next one removes the rest.
TEST_F(WholeFoldersTest, AreWholeAfterAKill) {
    constexpr int k_kills = 20;
    const std::string text(3000, 'x');
    const auto write_some = [&](WholeFolders& folders, int first) {
        for (int i = first; i < first + 3; ++i) {
            folders.fill(std::to_string(i), {{"x", text}, {"sub/y", text}});
        }
        folders.put_in_place();
    };
    const auto began = std::chrono::steady_clock::now();
    {
        WholeFolders folders(folder_ / "measured");
        write_some(folders, 0);
        write_some(folders, 3);
    }
    // The last kills come after some are in place, however slow the disk is.
    const auto step = (std::chrono::steady_clock::now() - began) / (k_kills / 4);
    int placed = 0;
    for (int kill_after = 0; kill_after < k_kills; ++kill_after) {
        const fs::path own = folder_ / std::to_string(kill_after);
        const pid_t child = fork();
        if (child == 0) {
            WholeFolders folders(own);
            for (int first = 0;; first += 3) {
                write_some(folders, first);
            }
        }
        std::this_thread::sleep_for(kill_after * step);
        kill(child, SIGKILL);
        int status = 0;
        waitpid(child, &status, 0);
        if (!fs::exists(own)) {
            continue;
        }
        (void)remove_dead_folders(own);
        for (const fs::directory_entry& one : fs::directory_iterator(own)) {
            ++placed;
            EXPECT_EQ(file_content(one.path() / "x"), text) << one.path();
            EXPECT_EQ(file_content(one.path() / "sub" / "y"), text) << one.path();
        }
    }
    EXPECT_GT(placed, 0);
}

}  // namespace
}  // namespace gumcert::system
