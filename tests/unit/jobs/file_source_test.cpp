#include "jobs/file_source.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "gum/quantity/diagnostic.h"

namespace gumcert::jobs {
namespace {

namespace fs = std::filesystem;

class DiskFiles : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / ("disk_files_" + std::to_string(getpid()));
        for (const char* name : {"jobs/sub/x.csv", "jobs/x.csv", "laboratory/standard.json", "other/x.csv"}) {
            fs::create_directories((folder_ / name).parent_path());
            std::ofstream(folder_ / name) << name;
        }
        std::ofstream(folder_ / "other" / "job.json") << "{}";
        fs::create_symlink("../other/job.json", folder_ / "jobs" / "job.json");
        fs::create_symlink("../other", folder_ / "jobs" / "hidden");
        fs::create_symlink("sub", folder_ / "jobs" / "near");
        fs::create_symlink("laboratory", folder_ / "laboratory_link");
    }
    void TearDown() override { fs::remove_all(folder_); }

    static std::string code_of(const FileSource& source, const std::string& name) {
        try {
            return source.read(name);
        } catch (const gum::StorageError& error) {
            return error.diagnostics().front().code;
        }
    }
    fs::path folder_;
};

TEST_F(DiskFiles, AreListedForMessages) {
    const DiskFileSource source = DiskFileSource::of_job(folder_ / "jobs" / "job.json", folder_ / "laboratory");
    using Names = std::vector<std::string>;
    EXPECT_EQ(source.json_files("laboratory:/"), Names{"standard"});
    EXPECT_EQ(source.json_files("../other/"), Names{"job"});
    EXPECT_EQ(ReadOnceSource(source).json_files("../laboratory/"), Names{"standard"});
    EXPECT_EQ(source.json_files("absent/"), Names{});
    const MemoryFileSource memory({{"lab/a.json", ""}, {"lab/b.csv", ""}, {"lab/sub/c.json", ""}, {"other.json", ""}});
    EXPECT_EQ(memory.json_files("lab/"), Names{"a"});
}

TEST_F(DiskFiles, AreWhereTheirNamesShow) {
    const DiskFileSource source = DiskFileSource::of_job(folder_ / "jobs" / "job.json", folder_ / "laboratory_link");
    EXPECT_EQ(source.read("x.csv"), "jobs/x.csv");
    EXPECT_EQ(source.read("sub/x.csv"), "jobs/sub/x.csv");
    EXPECT_EQ(source.read("near/x.csv"), "jobs/sub/x.csv");
    EXPECT_EQ(source.read("../other/x.csv"), "other/x.csv");
    EXPECT_EQ(source.read("../other/../laboratory/standard.json"), "laboratory/standard.json");
    EXPECT_EQ(source.read("sub/../../other/x.csv"), "other/x.csv") << "as the budget in sub names it";
    EXPECT_EQ(source.read("laboratory:/standard.json"), "laboratory/standard.json") << "a folder that the user names";
    EXPECT_EQ(source.read("job.json"), "{}") << "a job that the user names";
    EXPECT_EQ(code_of(source, "hidden/x.csv"), "GC-STORAGE-0002");
    EXPECT_EQ(code_of(source, "../jobs/hidden/x.csv"), "other/x.csv") << "it begins at the folder above";
    EXPECT_EQ(code_of(source, "missing.csv"), "GC-STORAGE-0001");
    EXPECT_EQ(code_of(source, "sub"), "GC-STORAGE-0001");
    EXPECT_EQ(code_of(source, ""), "GC-STORAGE-0001");
    EXPECT_EQ(code_of(source, ".."), "GC-STORAGE-0001");
    EXPECT_EQ(code_of(DiskFileSource(folder_ / "jobs"), "job.json"), "GC-STORAGE-0002");
}

}  // namespace
}  // namespace gumcert::jobs
