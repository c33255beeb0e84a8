#include "archive/certificates/archive_draft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evaluation/evaluate_job.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/render.h"
#include "tests/support/archive_folder.h"
#include "tests/unit/reports/certified_sample.h"

namespace gumcert::archive {
namespace {

// A laboratory has another day than UTC for some hours of each day; two days are another matter.
TEST(ArchiveDraft, PrintedDaysAreThoseOfThePlace) {
    reports::EvaluationRecord record = gumcert::test::certified_budget_record();
    record.certificate->data.dates.authorised = "2026-11-28";
    record.certificate->data.dates.issued = "2026-12-31";
    const std::string text = to_canonical_json(record);
    const auto doubts = [&](const std::string& kind, const std::string& day) {
        return doubts_about_days(text, "EX-1", kind, day).size();
    };
    for (const char* const day : {"2026-11-27", "2026-11-28", "2026-11-29"}) {
        EXPECT_EQ(doubts("authorised", day), 0U) << day;
    }
    EXPECT_EQ(doubts("authorised", "2026-11-30"), 1U);
    EXPECT_EQ(doubts("issued", "2027-01-01"), 0U);
    EXPECT_EQ(doubts("issued", "2027-01-02"), 1U);
    EXPECT_EQ(doubts("reviewed", "2027-01-02"), 0U);
}

/// Files of others are read within walls, all of them counting; how long the evaluation between takes is said by its job.
TEST(ArchiveDraft, ReadsFilesAndEvaluatesWithinWallsOfEach) {
    const test::StoreFolder folder;
    const std::filesystem::path tree(GUMCERT_SOURCE_DIR);
    const std::filesystem::path record = folder.file("record");
    const std::filesystem::path page = folder.file("page");
    const evaluation::Evaluation evaluation = evaluation::evaluate_job(
        tree / "examples" / "laboratory" / "end_gauge.json", evaluation::CovarianceFile::none, 1, tree / "templates",
        {}, evaluation::program_kinds(), tree / "examples" / "laboratory" / "laboratory");
    std::ofstream(record, std::ios::binary) << reports::to_canonical_json(evaluation.record);
    reports::RenderAssets assets;
    assets.templates = tree / "templates";
    std::ofstream(page, std::ios::binary) << reports::render_html(evaluation.record, assets);
    std::vector<std::string> said;
    std::string within = "outside";
    ArchiveChecks checks{.threads = 1, .templates = tree / "templates", .trusted = {}, .now = 0, .progress = {}};
    checks.progress = [&](const std::string& text) { said.push_back(text + ", " + within); };
    checks.within_walls = [&](const std::vector<std::filesystem::path>& files, const std::function<void()>& work) {
        said.push_back(std::to_string(files.size()) + " files");
        EXPECT_NE(std::find(files.begin(), files.end(), record), files.end());
        EXPECT_EQ(std::find(files.begin(), files.end(), page) != files.end(), files.size() == 2U);
        within = "within walls";
        work();
        within = "outside";
    };
    checks.evaluates_within = [&](const std::function<void()>& work) {
        said.emplace_back("evaluation");
        within = "within walls of an evaluation";
        work();
        within = "outside";
    };
    EXPECT_EQ(checked_draft(record, {page}, checks).draft.documents.size(), 1U);
    ASSERT_GE(said.size(), 3U);
    EXPECT_EQ(said[0], "2 files");
    EXPECT_EQ(said[said.size() - 2], "2 files");
    EXPECT_EQ(said.back(), "checking " + page.filename().string() + ", within walls");
    EXPECT_EQ(said[1], "evaluation");
    EXPECT_TRUE(std::all_of(said.begin() + 2, said.end() - 2,
                            [](const auto& one) { return one.ends_with("within walls of an evaluation"); }));
    // The walls end the process; here the work is left out, and nothing is evaluated elsewhere.
    std::ofstream(record, std::ios::binary) << reports::with_digest([&] {
        nlohmann::json other = nlohmann::json::parse(reports::to_canonical_json(evaluation.record));
        other["title"] = "another title than that of its job";
        return other;
    }());
    EXPECT_THROW((void)checked_draft(record, {}, checks), gum::InputError);
    checks.evaluates_within = [](const std::function<void()>&) {};
    EXPECT_NO_THROW((void)checked_draft(record, {}, checks));
}

TEST(Reason, SaysSomething) {
    for (const char* const nothing :
         {"", " ", "-", "\u2014", "...", "?", "n/a", "N. A.", "tbd", "xxx", "k. A.", "\u3000"}) {
        EXPECT_FALSE(states_a_reason(nothing)) << nothing;
    }
    for (const char* const something :
         {"typing error", "agreed", "The item was damaged.", "Tippfehler", "\u6253\u932F\u5B57", "errata", "order 17",
          "number not needed", "kein Auftrag"}) {
        EXPECT_TRUE(states_a_reason(something)) << something;
    }
}

}  // namespace
}  // namespace gumcert::archive
