#include "app/output_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::app {
namespace {

namespace fs = std::filesystem;

std::string code_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const gum::StorageError& error) {
        return error.diagnostics().front().code;
    }
    return "";
}

class OutputFilesTest : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) / ("output_files_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    void put(const std::string& name, const std::string& bytes) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    [[nodiscard]] std::string content(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        std::ostringstream bytes;
        bytes << file.rdbuf();
        return bytes.str();
    }
    [[nodiscard]] unsigned mode(const std::string& name) const {
        struct stat status = {};
        return lstat((folder_ / name).c_str(), &status) == 0 ? static_cast<unsigned>(status.st_mode) & 0777U : 0U;
    }
    [[nodiscard]] std::size_t entries() const {
        std::size_t count = 0;
        for ([[maybe_unused]] const auto& entry : fs::recursive_directory_iterator(folder_)) {
            ++count;
        }
        return count;
    }
    fs::path folder_;
};

TEST_F(OutputFilesTest, WritesAllFilesAndMakesTheirFolders) {
    write_files({{folder_ / "new/a", "1"}, {folder_ / "new/deeper/b", "2"}});
    EXPECT_EQ(content("new/a"), "1");
    EXPECT_EQ(content("new/deeper/b"), "2");
    write_files({{folder_ / "new/a", "3"}});
    EXPECT_EQ(content("new/a"), "3");
    EXPECT_EQ(entries(), 4U) << "nothing temporary is left";
}

/// An output never takes the place of anything but a regular file, and nothing else of its set is written then.
TEST_F(OutputFilesTest, ReplacesRegularFilesOnly) {
    put("target", "kept");
    fs::create_directories(folder_ / "folder");
    mkfifo((folder_ / "fifo").c_str(), 0600);
    fs::create_symlink("target", folder_ / "link");
    fs::create_symlink("nowhere", folder_ / "dangling");
    fs::create_symlink("/dev/null", folder_ / "to_device");
    const std::size_t before = entries();
    for (const char* name : {"folder", "fifo", "link", "dangling", "to_device", "folder/", ".", "..", "folder/.."}) {
        EXPECT_NE(code_of([&] { require_writable(folder_ / name); }), "") << name;
        EXPECT_NE(code_of([&] { write_files({{folder_ / "first", "x"}, {folder_ / name, "x"}}); }), "") << name;
        EXPECT_EQ(entries(), before) << name;
    }
    for (const char* device : {"/dev/null", "/dev/full", "/dev/stdout", "/dev/zero"}) {
        EXPECT_EQ(code_of([&] { require_writable(device); }), "GC-STORE-0005") << device;
        EXPECT_NE(code_of([&] { write_files({{device, "x"}}); }), "") << device;
    }
    EXPECT_EQ(content("target"), "kept");
}

TEST_F(OutputFilesTest, KeepsPermissionsOfAFileThatIsReplaced) {
    for (const unsigned kept : {0600U, 0640U, 0644U, 0400U, 0777U}) {
        const std::string name = "file_" + std::to_string(kept);
        put(name, "old");
        chmod((folder_ / name).c_str(), kept);
        write_files({{folder_ / name, "new"}});
        EXPECT_EQ(content(name), "new");
        EXPECT_EQ(mode(name), kept);
    }
    const mode_t old = umask(027);
    write_files({{folder_ / "fresh", "x"}});
    umask(old);
    EXPECT_EQ(mode("fresh"), 0640U);
}

/// One input, every way to spell an output that is the same file.
TEST_F(OutputFilesTest, NoSpellingMakesAnOutputOfAnInput) {
    put("jobs/job.json", "job");
    put("jobs/data/points.csv", "points");
    put("templates/a.mustache", "template");
    fs::create_directory_symlink("jobs", folder_ / "linked");
    fs::create_hard_link(folder_ / "jobs/job.json", folder_ / "hard");
    fs::create_directory_symlink(folder_, folder_ / "jobs/up");
    const std::vector<fs::path> inputs{folder_ / "jobs/job.json", folder_ / "linked/data/../data/points.csv",
                                       folder_ / "templates", folder_ / "absent"};
    const std::size_t before = entries();
    const fs::path here = fs::current_path();
    for (const char* name : {"jobs/job.json",
                             "jobs/./job.json",
                             "jobs//job.json",
                             "jobs/data/../job.json",
                             "jobs/new/../job.json",
                             "new/../jobs/job.json",
                             "new/deeper/../../jobs/job.json",
                             "linked/job.json",
                             "linked/data/../job.json",
                             "linked/new/../job.json",
                             "hard",
                             "new/../hard",
                             "jobs/up/jobs/job.json",
                             "jobs/up/hard",
                             "jobs/data/points.csv",
                             "linked/data/points.csv",
                             "templates/a.mustache",
                             "templates/new.html",
                             "templates/new/deeper.html",
                             "new/../templates/b",
                             "jobs/up/templates/c"}) {
        SCOPED_TRACE(name);
        const auto refused = [&](const fs::path& output) {
            return code_of([&] { require_not_an_input(output, inputs); }) == "GC-STORE-0004" &&
                   code_of([&] {
                       write_files({{folder_ / "other", "x"}, {output, "x"}}, inputs);
                   }) == "GC-STORE-0004";
        };
        EXPECT_TRUE(refused(folder_ / name));
        fs::current_path(folder_);
        EXPECT_TRUE(refused(name)) << "relative";
        fs::current_path(here);
        EXPECT_EQ(entries(), before);
    }
    EXPECT_EQ(content("jobs/job.json"), "job");
    EXPECT_EQ(code_of([&] { write_files({{folder_ / "jobs/record.json", "x"}}, inputs); }), "");
}

TEST_F(OutputFilesTest, RefusesTwoOutputsInOnePlace) {
    EXPECT_NE(code_of([&] { write_files({{folder_ / "a", "1"}, {folder_ / "new/../a", "2"}}); }), "");
    EXPECT_FALSE(fs::exists(folder_ / "a"));
}

/// Files of the name that the temporary ones had before, and links in their place, are left alone.
TEST_F(OutputFilesTest, OpensNothingThatIsThere) {
    put("secret", "kept");
    fs::create_symlink("secret", folder_ / (".out." + std::to_string(getpid()) + ".part"));
    write_files({{folder_ / "out", "x"}});
    EXPECT_EQ(content("secret"), "kept");
    EXPECT_EQ(content("out"), "x");
    write_files({{folder_ / std::string(255, 'n'), "longest name"}});
    EXPECT_EQ(content(std::string(255, 'n')), "longest name");
}

}  // namespace
}  // namespace gumcert::app
