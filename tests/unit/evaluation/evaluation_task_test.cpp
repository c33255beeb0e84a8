#include "evaluation/evaluation_task.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::evaluation {
namespace {

reports::InputFile file_with(const std::string& digest) {
    reports::InputFile file;
    file.name = "job.json";
    file.sha256 = digest;
    return file;
}

TEST(CovarianceOutput, HasANameThatDependsOnTheFilesOnlyBesideOthers) {
    const CovarianceOutput alone(CovarianceFile::own_folder);
    EXPECT_EQ(alone.name(reports::CovarianceForm::csv, {file_with("ab")}), "covariance.csv");
    EXPECT_EQ(alone.name(reports::CovarianceForm::npy, {file_with("cd")}), "covariance.npy");
    const CovarianceOutput beside(CovarianceFile::with_others);
    // The first twelve digits of the SHA-256 of "abc" (FIPS 180-2, B.1).
    EXPECT_EQ(beside.name(reports::CovarianceForm::csv, {file_with("a"), file_with("bc")}),
              "covariance-ba7816bf8f01.csv");
}

TEST(CovarianceOutput, IsNotWrittenWhereNoPlaceOrNoFormIsAsked) {
    EXPECT_TRUE(CovarianceOutput(CovarianceFile::own_folder).is_written());
    EXPECT_FALSE(CovarianceOutput(CovarianceFile::none).is_written());
    EXPECT_FALSE(CovarianceOutput(CovarianceFile::own_folder, reports::CovarianceForm::none).is_written());
}

TEST(EvaluationTask, HoldsFilesUpToEightMebibytesEachAndSixteenTogether) {
    const std::string eight(std::size_t{8} << 20U, 'x');
    const jobs::MemoryFileSource source(
        {{"job.json", "{}"}, {"a.csv", eight}, {"b.csv", eight + "x"}, {"c.csv", eight}, {"d.csv", "y"}});
    const jobs::ReadOnceSource files(source);
    const std::string job = "job.json";
    const CovarianceOutput none(CovarianceFile::none);
    const std::filesystem::path templates;
    const gum::Progress progress;
    const EvaluationTask task{.files = files,
                              .job_file = job,
                              .covariance = none,
                              .threads = 1,
                              .templates = templates,
                              .progress = progress};
    const auto held = task.held_files({"job.json", "a.csv", "b.csv", "c.csv", "d.csv"});
    ASSERT_EQ(held.size(), 5U);
    EXPECT_TRUE(held[0].content);
    EXPECT_TRUE(held[1].content);
    EXPECT_FALSE(held[2].content);  // too large
    EXPECT_FALSE(held[3].content);  // the job and a.csv leave less than 8 MiB
    EXPECT_TRUE(held[4].content);
    EXPECT_EQ(held[0].sha256, "44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a");  // of "{}"
    EXPECT_FALSE(task.profile_of(std::nullopt));
}

}  // namespace
}  // namespace gumcert::evaluation
