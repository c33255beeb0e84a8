#include "archive/certificates/archive_replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>

#include "archive/store/open_store.h"
#include "evaluation/evaluate_job.h"
#include "reports/record/evaluation_record.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

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

/// One record among many takes no longer than it may, and is named.
TEST(ArchiveReplay, OfARecordThatTakesTooLongIsNotDone) {
    const std::string record = reports::to_canonical_json(
        evaluation::evaluate_job(k_tree_of_replays / "examples" / "gauge_block" / "job.json",
                                 evaluation::CovarianceFile::none, 1, k_tree_of_replays / "templates")
            .record);
    const Replay replay = replay_record(record, "EX-1", 1, k_tree_of_replays / "templates", [](const std::string&) {
        throw gum::StorageError(gum::Diagnostic{
            .code = "GC-STORE-0024", .where = "--time-limit", .what = "used up", .rule = "", .action = ""});
    });
    EXPECT_FALSE(replay.evaluated);
    ASSERT_EQ(replay.differences.size(), 1U);
    EXPECT_EQ(replay.differences[0].code, "GC-ARCHIVE-0061");
    EXPECT_EQ(replay.differences[0].what, "--time-limit: used up");
}

TEST(ArchiveReplay, TellsOnlySoManyPlaces) {
    json record = archived_record();
    for (std::size_t i = 0; i <= k_most_differences; ++i) {
        record["audit"]["not_checked"].push_back(record["audit"]["not_checked"].front());
    }
    EXPECT_LE(replay_of(record).differences.size(), k_most_differences + 1);
}

Replay replay_with(std::size_t differences, bool evaluated = true) {
    Replay replay{.made_by = "0.0.9 (commit a)", .evaluated = evaluated, .differences = {}};
    for (std::size_t i = 0; i < differences; ++i) {
        replay.differences.push_back(
            {.code = "GC-ARCHIVE-0073", .where = std::to_string(i), .what = "\"10\"", .rule = "", .action = ""});
    }
    return replay;
}

TEST(ArchiveReplay, HasALineForEachRecordAndOneForAll) {
    const Replays replays{{"EX-1", replay_with(0)}, {"EX-2", replay_with(1)}, {"EX-3", replay_with(1, false)}};
    EXPECT_EQ(same_again(replays), 1U);
    EXPECT_EQ(replay_text(replays, "0.1.0 (commit b)"),
              "EX-1                      same       made by gumcert 0.0.9 (commit a)\n"
              "EX-2                      DIFFERENT  made by gumcert 0.0.9 (commit a)\n"
              "EX-3                      NOT DONE   made by gumcert 0.0.9 (commit a)\n"
              "1 of 3 records give the same with gumcert 0.1.0 (commit b); 1 not evaluated\n");
    EXPECT_NE(replay_text({{"EX-1", replay_with(0)}}, "b").find("1 of 1 records give the same with gumcert b\n"),
              std::string::npos)
        << "all of them were";
    const json said = replay_json(replays, "0.1.0 (commit b)");
    EXPECT_EQ(said["schema"], "gumcert/archive-replay/1");
    EXPECT_EQ(said["records"], 3);
    EXPECT_EQ(said["same"], 1);
    EXPECT_EQ(said["not_evaluated"], 1);
    EXPECT_EQ(said["certificates"][0]["differences"], json::array());
    EXPECT_EQ(said["certificates"][1]["differences"][0]["what"], "\"10\"");
    EXPECT_EQ(said["certificates"][2]["evaluated"], false);
}

TEST(ArchiveReplay, ShowsTheFirstDifferencesAndHowManyMoreThereAre) {
    EXPECT_EQ(first_differences(replay_with(21).differences, "EX-1").size(), 21U)
        << "one more takes the line of its own";
    const std::vector<gum::Diagnostic> first = first_differences(replay_with(25).differences, "EX-1");
    ASSERT_EQ(first.size(), 21U);
    EXPECT_EQ(first.back().what, "5 more places");
    EXPECT_EQ(first.back().where, "EX-1");
    EXPECT_EQ(first_differences(replay_with(k_most_differences + 1).differences, "EX-1").back().what,
              "more than 980 more places");
}

TEST(ArchiveReplay, IsOfTheRecordsThatAreNamedOrOfAll) {
    const test::StoreFolder folder;
    test::Clock clock;
    const auto by = [&](const std::string& who) {
        return Request{.actor = who, .at = clock.next(), .request_key = "", .why = ""};
    };
    const auto store =
        create_store(folder.file().string(),
                     first_entry({.four_eyes = false, .numbering = "EX-YYYY-####"}, "gumcert", "1", by("K.")));
    Archive archive(*store);
    for (int i = 0; i < 2; ++i) {
        const std::string number = archive.take_number(by("A.")).entry.certificate;
        (void)archive.draft(test::sample_draft(number), by("A."));
    }
    (void)archive.take_number(by("A."));  // without a record
    const auto all = records_to_replay(archive, {});
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].first, "EX-2026-0001");
    EXPECT_EQ(all[0].second.size(), 64U);
    EXPECT_EQ(records_to_replay(archive, {"EX-2026-0002"}), (std::vector{all[1]}));
    EXPECT_EQ(test::code_of([&] { (void)records_to_replay(archive, {"EX-2026-0009"}); }), "GC-ARCHIVE-0026");
}

}  // namespace
}  // namespace gumcert::archive
