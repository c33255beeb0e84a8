#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "encoding/sha2.h"
#include "evaluation/evaluate_job.h"
#include "jobs/file_source.h"

namespace gumcert::evaluation {
namespace {

namespace fs = std::filesystem;

/// Files of a folder that are other files from their second reading on: a blank more for every reading before.
class ChangingSource : public jobs::FileSource {
public:
    explicit ChangingSource(fs::path folder) : disk_(std::move(folder)) {}
    [[nodiscard]] std::string read(const std::string& name) const override {
        const std::size_t earlier = readings_[name]++;
        return disk_.read(name) + std::string(earlier, '\n');
    }
    mutable std::map<std::string, std::size_t> readings_;

private:
    jobs::DiskFileSource disk_;
};

/// The record states the digest of the bytes that were evaluated: every file of a job is read once, whatever kinds of
/// readers look at it (its kind, the job, the budget of another job, the digest).
TEST(OneRead, OfEveryFileOfEveryExample) {
    const fs::path examples = fs::path(GUMCERT_SOURCE_DIR) / "examples";
    for (const char* job : {"gauge_block/job.json", "certificate/end_gauge.json", "comparison/key_comparison.json",
                            "rotary_table/fixture_budget.json"}) {
        SCOPED_TRACE(job);
        ASSERT_TRUE(fs::exists(examples / job));
        const ChangingSource source((examples / job).parent_path());
        const Evaluation evaluation = evaluate_job(source, fs::path(job).filename().string(), CovarianceFile::none, 1,
                                                   fs::path(GUMCERT_SOURCE_DIR) / "templates");
        EXPECT_FALSE(evaluation.record.job_files.empty());
        for (const auto& [name, count] : source.readings_) {
            EXPECT_EQ(count, 1U) << name;
        }
        for (const reports::InputFile& file : evaluation.record.job_files) {
            EXPECT_EQ(source.readings_[file.name], 1U) << file.name;
            const jobs::DiskFileSource disk((examples / job).parent_path());
            EXPECT_EQ(file.sha256, encoding::sha256(disk.read(file.name))) << file.name;
        }
        EXPECT_NE(evaluation.record.options_json.find("\"unit_table_sha256\""), std::string::npos);
    }
}

TEST(OneRead, AlsoOfAJobThatIsRefused) {
    const fs::path folder = fs::path(::testing::TempDir()) / "one_read";
    fs::create_directories(folder);
    std::ofstream(folder / "job.json") << R"({"schema": "gumcert/job/1", "kind": "budgit", "inputs": {}})";
    const ChangingSource source(folder);
    EXPECT_ANY_THROW((void)evaluate_job(source, "job.json", CovarianceFile::none, 1, {}));
    EXPECT_EQ(source.readings_["job.json"], 1U);
    fs::remove_all(folder);
}

}  // namespace
}  // namespace gumcert::evaluation
