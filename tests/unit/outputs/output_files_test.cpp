#include "outputs/output_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "outputs/output_set.h"

namespace gumcert::outputs {
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
    write_files({{folder_ / "new/deeper/a", "1"}, {folder_ / "new/deeper/b", "2"}});
    EXPECT_EQ(content("new/deeper/a"), "1");
    EXPECT_EQ(content("new/deeper/b"), "2");
    write_files({{folder_ / "new/deeper/a", "3"}});
    EXPECT_EQ(content("new/deeper/a"), "3");
    EXPECT_EQ(entries(), 5U) << "two folders, two files and their manifest; nothing temporary is left";
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

/// The next who opens the archive would take it for a part of it, and remove it.
TEST_F(OutputFilesTest, NoSpellingPutsAnOutputBesideAnArchive) {
    put("lab.archive", std::string("SQLite format 3\0", 16) + "and more");
    put("text", "no archive");
    fs::create_symlink(folder_, folder_ / "link");
    const fs::path was_at = fs::current_path();
    fs::current_path(folder_);
    for (const char* const ending : {"-wal", "-shm", "-journal"}) {
        for (const fs::path& place : {fs::path(), fs::path("."), folder_, folder_ / "link", fs::path("link/.")}) {
            EXPECT_TRUE(is_beside_an_archive(place / ("lab.archive" + std::string(ending)))) << place << ending;
            EXPECT_EQ(code_of([&] { require_writable(place / ("lab.archive" + std::string(ending))); }),
                      "GC-STORE-0004")
                << place << ending;
            EXPECT_FALSE(is_beside_an_archive(place / ("text" + std::string(ending))));
            EXPECT_FALSE(is_beside_an_archive(place / ("other.archive" + std::string(ending))));
        }
    }
    EXPECT_EQ(code_of([] { require_writable("lab.archive-head.json"); }), "");
    fs::current_path(was_at);
}

TEST_F(OutputFilesTest, RefusesTwoOutputsInOnePlace) {
    EXPECT_NE(code_of([&] { write_files({{folder_ / "a", "1"}, {folder_ / "new/../a", "2"}}); }), "");
    EXPECT_FALSE(fs::exists(folder_ / "a"));
}

TEST_F(OutputFilesTest, AFolderIsBroughtToTheDisk) {
    EXPECT_EQ(code_of([&] { synchronise_folder(folder_); }), "");
    EXPECT_EQ(code_of([&] { synchronise_folder(folder_ / "nowhere"); }), "GC-STORE-0002");
}

TEST_F(OutputFilesTest, OfTwoWritersOneWinsWhole) {
    const std::vector<fs::path> outputs{folder_ / "a", folder_ / "b"};
    put("a", "old");
    const OutputsAtStart first(outputs);
    const OutputsAtStart second(outputs);
    write_files({{folder_ / "a", "1"}, {folder_ / "b", "1"}}, {}, first);
    EXPECT_EQ(code_of([&] { write_files({{folder_ / "a", "2"}, {folder_ / "b", "2"}}, {}, second); }), "GC-STORE-0008");
    EXPECT_EQ(content("a") + content("b"), "11");
    EXPECT_EQ(entries(), 3U);
    write_files({{folder_ / "a", "3"}, {folder_ / "b", "3"}}, {}, OutputsAtStart(outputs));
    EXPECT_EQ(content("a") + content("b"), "33");
}

TEST_F(OutputFilesTest, FoldersOfASetThatFailsAreRemoved) {
    EXPECT_NE(code_of([&] {
                  write_files({{folder_ / "new/deeper" / std::string(300, 'n'), "1"}, {folder_ / "new/deeper/b", "2"}});
              }),
              "");
    EXPECT_EQ(entries(), 0U);
}

/// What a process leaves that is killed while it puts files in place.
class InterruptedSetTest : public OutputFilesTest {
protected:
    void SetUp() override {
        OutputFilesTest::SetUp();
        put("a", "old a");
        put("b", "old b");
        put("notes", "mine");
        put(part('1'), "new a");
        put(part('2'), "new b");
        put(part('3'), "new c");
        journal({{"a", encoding::sha256("new a"), part('1')},
                 {"b", encoding::sha256("new b"), part('2')},
                 {"c", encoding::sha256("new c"), part('3')}});
    }
    static std::string part(char digit) { return ".gumcert-" + std::string(16, digit) + ".part"; }
    void journal(FileSet set) const { put(k_set_journal, to_json({{std::move(set)}})); }
    void exchange(const std::string& one, const std::string& other) const {
        fs::rename(folder_ / one, folder_ / "between");
        fs::rename(folder_ / other, folder_ / one);
        fs::rename(folder_ / "between", folder_ / other);
    }
    [[nodiscard]] std::string restored() const {
        const std::vector<gum::Diagnostic> said = restore_outputs({folder_ / "a"});
        return said.size() == 1 ? said[0].code + " " + said[0].what : "";
    }
};

TEST_F(InterruptedSetTest, IsCompletedWhereverItWasInterrupted) {
    const std::vector<std::function<void()>> steps{[&] { exchange("a", part('1')); }, [&] { exchange("b", part('2')); },
                                                   [&] { fs::rename(folder_ / part('3'), folder_ / "c"); },
                                                   [&] { fs::remove(folder_ / part('1')); },
                                                   [&] { fs::remove(folder_ / part('2')); }};
    for (std::size_t done = 0; done <= steps.size(); ++done) {
        TearDown();
        SetUp();
        for (std::size_t i = 0; i < done; ++i) {
            steps[i]();
        }
        EXPECT_NE(restored().find("GC-STORE-0009 "), std::string::npos) << done;
        EXPECT_EQ(content("a") + content("b") + content("c") + content("notes"), "new anew bnew cmine") << done;
        EXPECT_EQ(entries(), 4U) << done;
        EXPECT_EQ(restored(), "") << "once";
    }
}

TEST_F(InterruptedSetTest, IsTakenBackWhereAPartIsLost) {
    exchange("a", part('1'));
    fs::remove(folder_ / part('3'));
    EXPECT_NE(restored().find("taken back"), std::string::npos);
    EXPECT_EQ(content("a") + content("b"), "old aold b");
    EXPECT_EQ(entries(), 3U);
}

TEST_F(InterruptedSetTest, IsCompletedByTheNextThatWrites) {
    exchange("a", part('1'));
    write_files({{folder_ / "d", "x"}});
    EXPECT_EQ(content("a") + content("b") + content("c") + content("d"), "new anew bnew cx");
    EXPECT_EQ(entries(), 5U);
}

TEST_F(InterruptedSetTest, ADamagedJournalIsLeftToAPerson) {
    for (const char* text : {"", "{}", R"({"schema": "gumcert/set/1", "sets": []})"}) {
        put(k_set_journal, text);
        EXPECT_EQ(code_of([&] { (void)restore_outputs({folder_ / "a"}); }), "GC-STORE-0013") << text;
        EXPECT_EQ(content("a") + content("b"), "old aold b");
    }
    journal({{"a", encoding::sha256("new a"), ""}});
    EXPECT_EQ(code_of([&] { write_files({{folder_ / "d", "x"}}); }), "GC-STORE-0013");
}

TEST_F(OutputFilesTest, TemporaryFilesOfADeadProcessAreRemoved) {
    put(".gumcert-0123456789abcdef.part", "half");
    put(".gumcert-notes.part", "mine");
    const std::vector<gum::Diagnostic> said = restore_outputs({folder_ / "a", folder_ / "b"});
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(said[0].severity, gum::Severity::note);
    EXPECT_EQ(entries(), 1U);
    EXPECT_TRUE(restore_outputs({folder_ / "nowhere/a"}).empty());
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
}  // namespace gumcert::outputs
