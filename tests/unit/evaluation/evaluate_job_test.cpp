#include "evaluation/evaluate_job.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>

#include "gum/quantity/diagnostic.h"

namespace gumcert::evaluation {
namespace {

/// Without the catalogue of sentences no record can be finished: it is looked for before a trial is drawn.
TEST(EvaluateJob, LooksForTheSentencesOfTheRecordFirst) {
    const std::map<std::string, std::string> job{
        {"job.json", R"({"schema": "gumcert/job/1", "kind": "budget", "title": "t",
        "model": ["y = a"], "inputs": {"a": {"value": 1, "u": 0.1}}, "monte_carlo": {"trials": 100000}})"}};
    const jobs::MemoryFileSource files(job);
    std::size_t stages = 0;
    const auto count = [&](const std::string&) { ++stages; };
    EXPECT_THROW((void)evaluate_job(files, "job.json", CovarianceFile::none, 1, testing::TempDir() + "nowhere", count),
                 gum::StorageError);
    EXPECT_EQ(stages, 0U);
    (void)evaluate_job(files, "job.json", CovarianceFile::none, 1, GUMCERT_SOURCE_DIR "/templates", count);
    EXPECT_GT(stages, 0U) << "the evaluation tells how far it is";
}

}  // namespace
}  // namespace gumcert::evaluation
