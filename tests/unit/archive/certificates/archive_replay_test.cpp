#include "archive/certificates/archive_replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>

#include "evaluation/evaluate_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::archive {
namespace {

using nlohmann::json;

const std::filesystem::path k_tree_of_replays = GUMCERT_SOURCE_DIR;

json archived_record() {
    return json::parse(reports::to_canonical_json(
        evaluation::evaluate_job(k_tree_of_replays / "examples" / "certificate" / "end_gauge.json",
                                 evaluation::CovarianceFile::none, 1, k_tree_of_replays / "templates")
            .record));
}

Replay replay_of(const json& record) {
    return replay_record(reports::with_digest(record), "EX-1", 1, k_tree_of_replays / "templates");
}

// The hash of its bytes stands in the log: a record that another version made differs, and nobody changed it.
TEST(ArchiveReplay, SaysThatAnotherProgramGaveIt) {
    json record = archived_record();
    EXPECT_TRUE(replay_of(record).differences.empty());
    record["software"]["version"] = "0.0.9";
    EXPECT_TRUE(replay_of(record).differences.empty()) << "who made it is not compared";
    json& value = record["certificate"]["tables"][0]["columns"][0]["values"][0];
    value["printed_U"] = "10";
    const Replay replay = replay_of(record);
    EXPECT_TRUE(replay.evaluated);
    ASSERT_EQ(replay.differences.size(), 1U);
    const gum::Diagnostic& one = replay.differences.front();
    EXPECT_EQ(one.code, "GC-ARCHIVE-0073");
    EXPECT_EQ(one.where, "EX-1#/certificate/tables/0/columns/0/values/0/printed_U");
    EXPECT_EQ(one.what, "\"10\"");
    EXPECT_TRUE(one.rule.starts_with("this program gives \"")) << one.rule;
    EXPECT_NE(one.action.find("gumcert 0.0.9"), std::string::npos) << one.action;
    EXPECT_EQ((one.rule + one.action).find("changed after"), std::string::npos) << "nobody is accused";
}

TEST(ArchiveReplay, TellsWhatIsPrintedBeforeTheAudit) {
    json record = archived_record();
    ASSERT_FALSE(record["audit"]["findings"].empty());
    for (json& finding : record["audit"]["findings"]) {
        finding["evidence"] = "another";
    }
    for (json& row : record["results"]["l"]["budget"]) {
        for (const char* key : {"contribution", "sensitivity", "u", "share"}) {
            row[key] = 12345.0;
        }
    }
    const std::vector<gum::Diagnostic> found = replay_of(record).differences;
    ASSERT_GT(found.size(), 20U) << "all of them";
    const auto is_of_audit = [](const gum::Diagnostic& one) { return one.where.find("#/audit/") != std::string::npos; };
    EXPECT_TRUE(std::is_partitioned(found.begin(), found.end(), std::not_fn(is_of_audit)));
    EXPECT_TRUE(is_of_audit(found.back()));
    EXPECT_FALSE(is_of_audit(found.front()));
}

TEST(ArchiveReplay, TellsOnlySoManyPlaces) {
    json record = archived_record();
    for (std::size_t i = 0; i <= k_most_differences; ++i) {
        record["audit"]["not_checked"].push_back(record["audit"]["not_checked"].front());
    }
    EXPECT_LE(replay_of(record).differences.size(), k_most_differences + 1);
}

}  // namespace
}  // namespace gumcert::archive
