#include "encoding/file_bytes.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace gumcert::encoding {
namespace {

namespace fs = std::filesystem;

class FileBytesTest : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) / ("file_bytes_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_;
};

TEST_F(FileBytesTest, ReadsTheBytesOfARegularFile) {
    const std::string content("a\0b\r\n", 5);
    std::ofstream(folder_ / "a", std::ios::binary) << content;
    chmod((folder_ / "a").c_str(), 0640);
    fs::create_symlink("a", folder_ / "link");
    for (const char* name : {"a", "link"}) {
        const FileBytes file = read_regular_file(folder_ / name, 100);
        EXPECT_EQ(file.failure, "");
        EXPECT_EQ(file.bytes, content);
        EXPECT_FALSE(file.too_long);
        EXPECT_EQ(file.mode, 0640U);
    }
    EXPECT_EQ(read_regular_file(folder_ / "a", 5).bytes, content);
    EXPECT_FALSE(read_regular_file(folder_ / "a", 5).too_long);
    EXPECT_EQ(read_regular_file(folder_ / "a", 4).bytes, content.substr(0, 4));
    EXPECT_TRUE(read_regular_file(folder_ / "a", 4).too_long);
    EXPECT_EQ(read_regular_file("/proc/self/stat", 100000).failure, "") << "a file that states size 0";
    EXPECT_NE(read_regular_file("/proc/self/stat", 100000).bytes, "");
}

/// What could wait for ever or never end is not opened.
TEST_F(FileBytesTest, RefusesWhatIsNoRegularFile) {
    mkfifo((folder_ / "fifo").c_str(), 0600);
    const int server = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string place = (folder_ / "s").string();
    ASSERT_LT(place.size(), sizeof(address.sun_path));
    std::memcpy(address.sun_path, place.c_str(), place.size() + 1);
    ASSERT_EQ(bind(server, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    fs::create_symlink("fifo", folder_ / "to_fifo");
    fs::create_symlink("nowhere", folder_ / "dangling");
    for (const fs::path& path : {folder_ / "fifo", folder_ / "s", folder_ / "to_fifo", fs::path("/dev/zero"),
                                 fs::path("/dev/null"), fs::path("/dev/urandom")}) {
        const FileBytes file = read_regular_file(path, 100);
        EXPECT_EQ(file.failure, "it is not a regular file") << path;
        EXPECT_EQ(file.bytes, "");
    }
    EXPECT_EQ(read_regular_file(folder_, 100).failure, "it is a folder");
    for (const fs::path& path : {folder_ / "dangling", folder_ / "absent", fs::path("")}) {
        EXPECT_EQ(read_regular_file(path, 100).failure, "there is no such file") << path;
    }
    EXPECT_NE(read_regular_file(folder_ / std::string(300, 'x'), 100).failure, "");
    close(server);
}

/// Names of up to four parts over a small tree with links of every kind: both ways of walking agree, and neither ever reads
/// what lies outside.
TEST_F(FileBytesTest, StaysBeneathItsFolderHoweverItIsNamed) {
    const fs::path inside = folder_ / "inside";
    fs::create_directories(inside / "d" / "e");
    std::ofstream(folder_ / "secret") << "secret";
    std::ofstream(inside / "f") << "f";
    std::ofstream(inside / "d" / "f") << "d/f";
    std::ofstream(inside / "d" / "e" / "secret") << "not the one";
    fs::create_symlink("d", inside / "to_d");
    fs::create_symlink("../f", inside / "d" / "up");
    fs::create_symlink("../secret", inside / "out");
    fs::create_symlink("..", inside / "out_folder");
    fs::create_symlink(folder_ / "inside" / "f", inside / "absolute");
    fs::create_symlink("round", inside / "round");
    fs::create_symlink("d/../../inside/f", inside / "out_and_in");
    const std::vector<std::string> parts = {"f",   "d",          "e",        "up",    "to_d",       "..",     ".",
                                            "out", "out_folder", "absolute", "round", "out_and_in", "secret", ""};
    std::size_t read = 0;
    std::size_t out = 0;
    const auto compare = [&](const std::string& name) {
        const FileBytes kernel = read_file_beneath(inside, name, 100);
        const FileBytes steps = read_file_beneath(inside, name, 100, Walk::step_by_step);
        ASSERT_EQ(kernel.bytes, steps.bytes) << name;
        ASSERT_EQ(kernel.failure, steps.failure) << name;
        ASSERT_EQ(kernel.leads_out, steps.leads_out) << name;
        ASSERT_NE(kernel.bytes, "secret") << name;
        read += kernel.failure.empty() ? 1U : 0U;
        out += kernel.leads_out ? 1U : 0U;
        if (!kernel.failure.empty()) {
            return;
        }
        ASSERT_EQ(kernel.bytes, read_regular_file(inside / name, 100).bytes) << name;
    };
    for (const std::string& a : parts) {
        compare(a);
        for (const std::string& b : parts) {
            compare(a + "/" + b);
            for (const std::string& c : parts) {
                compare(a + "/" + b + "/" + c);
            }
        }
    }
    EXPECT_GT(read, 20U);
    EXPECT_GT(out, 100U);
    for (const char* name : {"out", "absolute", "out_and_in", "../secret", "/etc/passwd", "to_d/../../secret"}) {
        EXPECT_TRUE(read_file_beneath(inside, name, 100).leads_out) << name;
    }
    fs::create_symlink("inside", folder_ / "link");
    EXPECT_EQ(read_file_beneath(folder_ / "link", "to_d/up", 100).bytes, "f") << "the folder itself may be a link";
    EXPECT_EQ(read_file_beneath(folder_ / "nowhere", "f", 100).failure, "there is no such file");
}

TEST_F(FileBytesTest, ListsTheJsonFilesOfAFolderInTheirOrder) {
    for (const char* name : {"b.json", "a.json", "c.txt", "STD-017.json"}) {
        std::ofstream(folder_ / name) << "{}";
    }
    EXPECT_EQ(json_files_in(folder_), (std::vector<std::string>{"STD-017", "a", "b"}));
    EXPECT_TRUE(json_files_in(folder_ / "absent").empty());
}

}  // namespace
}  // namespace gumcert::encoding
