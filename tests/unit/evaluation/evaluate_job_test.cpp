#include "evaluation/evaluate_job.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

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

/// A title in languages is that of the record in English, and of its documents in theirs.
TEST(EvaluateJob, KeepsTheTitleInItsLanguages) {
    const auto record_of = [](const std::string& title) {
        const std::map<std::string, std::string> job{
            {"job.json", R"({"schema": "gumcert/job/1", "kind": "budget", "title": )" + title +
                             R"(, "model": ["y = a"], "inputs": {"a": {"value": 1, "u": 0.1}}})"}};
        return evaluate_job(jobs::MemoryFileSource(job), "job.json", CovarianceFile::none, 1,
                            GUMCERT_SOURCE_DIR "/templates", [](const std::string&) {})
            .record;
    };
    const reports::EvaluationRecord plain = record_of(R"("Meter")");
    EXPECT_EQ(plain.title, "Meter");
    EXPECT_TRUE(plain.title_by_language.empty());
    EXPECT_EQ(reports::to_canonical_json(plain).find("title_by_language"), std::string::npos);
    const reports::EvaluationRecord record = record_of(R"({"de": "Messgerät", "en": "Meter"})");
    EXPECT_EQ(record.title, "Meter");
    EXPECT_EQ(record.title_by_language.in("de"), "Messgerät");
    const reports::EvaluationRecord read = reports::record_from_json(reports::to_canonical_json(record), "record.json");
    EXPECT_EQ(read.title_by_language, record.title_by_language);
}

/// Numbers of tables are those of the document: a record holds what it says of them, as documents do.
TEST(EvaluateJob, JudgesTheTablesThatAreNamed) {
    const auto found_of = [](const std::string& as_found) {
        const std::map<std::string, std::string> job{
            {"job.json",
             R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["y = a"], "inputs": {"a": {"value": 1,
            "u": 0.1}}, "certificate": {"status": "specimen", "adjustment": {"adjusted": true, "as_found": ")" +
                 as_found + R"("}}})"}};
        const Evaluation evaluation = evaluate_job(jobs::MemoryFileSource(job), "job.json", CovarianceFile::none, 1,
                                                   GUMCERT_SOURCE_DIR "/templates", [](const std::string&) {});
        std::string found;
        for (const certificate::Finding& one : evaluation.record.certificate->findings) {
            found += one.where == "/adjustment/as_found" ? one.what + "\n" : "";
        }
        return found;
    };
    EXPECT_EQ(found_of("Table 1 of certificate CL-2026-17"), "");
    EXPECT_NE(found_of("see Table 9").find("are said to stand in table 9"), std::string::npos);
}

}  // namespace
}  // namespace gumcert::evaluation
