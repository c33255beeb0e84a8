#include "issuing/run_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "evaluation/evaluate_job.h"
#include "issuing/issue_documents.h"

namespace gumcert::issuing {
namespace {

namespace fs = std::filesystem;

const fs::path k_tree_of_runs = GUMCERT_SOURCE_DIR;

std::vector<std::string> names_of(const std::vector<outputs::OutputFile>& files) {
    std::vector<std::string> names;
    for (const outputs::OutputFile& file : files) {
        names.push_back(file.path.string());
    }
    return names;
}

evaluation::Evaluation end_gauge() {
    return evaluation::evaluate_job(k_tree_of_runs / "examples" / "certificate" / "end_gauge.json",
                                    evaluation::CovarianceFile::own_folder, 1, k_tree_of_runs / "templates");
}

TEST(RunFiles, HaveTheirPlacesInOneFolder) {
    EXPECT_EQ(evaluated_places("out"),
              (std::vector<fs::path>{"out/record.json", "out/covariance.csv", "out/audit.html"}));
    for (const evaluation::Kind& kind : evaluation::program_kinds()) {
        const std::vector<fs::path> places = document_places(kind, "out");
        ASSERT_EQ(places.size(), kind.forms.size());
        EXPECT_EQ(places.front().parent_path(), "out");
        EXPECT_EQ(places.front().filename().string(), document_names(kind).front());
    }
}

TEST(RunFiles, HoldRecordAndCovarianceAsTheyWereEvaluated) {
    evaluation::Evaluation evaluation;
    evaluation.record.kind = "budget";
    const std::vector<outputs::OutputFile> record_alone = evaluated_files(evaluation, "out/record.json");
    EXPECT_THAT(names_of(record_alone), testing::ElementsAre("out/record.json"));
    EXPECT_EQ(record_alone.front().bytes, reports::to_canonical_json(evaluation.record));
    evaluation.covariance = "1,2\n";
    evaluation.covariance_file = "covariance.npy";
    const std::vector<outputs::OutputFile> files = evaluated_files(evaluation, "out/record.json");
    EXPECT_THAT(names_of(files), testing::ElementsAre("out/record.json", "out/covariance.npy"));
    EXPECT_EQ(files.back().bytes, "1,2\n");
}

TEST(RunFiles, HaveTheAuditOfTheJobForTheLaboratory) {
    const evaluation::Evaluation evaluation = end_gauge();
    reports::RenderAssets assets;
    assets.templates = k_tree_of_runs / "templates";
    const outputs::OutputFile audit = audit_file(evaluation, "out", assets);
    EXPECT_EQ(audit.path, "out/audit.html");
    EXPECT_THAT(audit.bytes, testing::HasSubstr("<html"));
    EXPECT_THAT(audit.bytes, testing::HasSubstr(evaluation.record.job_files.front().sha256.substr(0, 8)));
}

}  // namespace
}  // namespace gumcert::issuing
