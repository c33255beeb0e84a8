#include "evaluation/rerun_record.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "evaluation/evaluate_job.h"

namespace gumcert::evaluation {
namespace {

using nlohmann::json;

const std::filesystem::path k_rerun_tree(GUMCERT_SOURCE_DIR);

/// The record of a certificate with a verdict, made now.
const std::string& certified() {
    static const std::string k_text =
        reports::to_canonical_json(evaluate_job(k_rerun_tree / "examples" / "certificate" / "end_gauge.json",
                                                CovarianceFile::none, 1, k_rerun_tree / "templates")
                                       .record);
    return k_text;
}

RerunRecord rerun(const std::string& text) {
    return rerun_record(text, "old.json", 1, k_rerun_tree / "templates");
}

/// The record as another version would have written it, with one value of its own.
std::string of_another_version(const std::string& pointer, const json& value) {
    json record = json::parse(certified());
    record["software"]["version"] = "0.0.7";
    record["software"]["commit"] = "0123456789ab";
    json& at = record.at(json::json_pointer(pointer));
    EXPECT_NE(at, value) << pointer;
    at = value;
    return reports::with_digest(record);
}

std::string refusal_of(const std::string& text) {
    try {
        (void)rerun(text);
    } catch (const gum::InputError& error) {
        return error.diagnostics().front().code;
    }
    return "";
}

TEST(RerunRecord, ARecordOfThisVersionIsTheSame) {
    const RerunRecord same = rerun(certified());
    EXPECT_STREQ(same.outcome(), "same");
    EXPECT_FALSE(same.is_negative());
    EXPECT_TRUE(same.changes.empty());
    EXPECT_NE(rerun_text({&same, 1}).find("the same in every number"), std::string::npos);
}

TEST(RerunRecord, AnotherVersionIsWantedAndChangesNothingByItself) {
    const RerunRecord same = rerun(of_another_version("/software/commit", "abc"));
    EXPECT_STREQ(same.outcome(), "same");
    EXPECT_EQ(same.made_by.version, "0.0.7");
}

TEST(RerunRecord, WhatChangedIsToldByWhatItConcerns) {
    const struct {
        const char* pointer;
        json old;
        const char* word;
        const char* outcome;
    } cases[] = {
        {"/results/l/u", 33.5, "number", "numbers"},
        {"/results/l/printed/U", "66", "printed", "changed"},
        {"/certificate/tables/0/columns/0/values/0/printed_k", "2.00", "printed", "changed"},
        {"/certificate/tables/0/columns/0/values/0/verdict/verdict", "fail", "verdict", "changed"},
        {"/certificate/tables/0/columns/0/values/0/raised", true, "verdict", "changed"},
        {"/title", "another title", "other", "same"},
    };
    for (const auto& one : cases) {
        const RerunRecord changed = rerun(of_another_version(one.pointer, one.old));
        EXPECT_STREQ(changed.outcome(), one.outcome) << one.pointer;
        EXPECT_EQ(changed.is_negative(), std::string(one.outcome) == "changed") << one.pointer;
        ASSERT_EQ(changed.changes.size(), 1U) << one.pointer;
        EXPECT_STREQ(word_of(changed.changes[0].kind), one.word) << one.pointer;
        EXPECT_EQ(changed.changes[0].place, one.pointer);
        EXPECT_EQ(changed.changes[0].before, one.old.is_string() ? one.old.get<std::string>() : one.old.dump());
    }
}

TEST(RerunRecord, WhatTheNewVersionSaysInAdditionIsNoChangeAndWhatItLeavesOutIsOne) {
    json record = json::parse(certified());
    record["results"]["l"].erase("coverage_note");  // as a version writes that did not know it yet
    record["results"]["l"]["budget"][0]["printed"].erase("nu");
    const RerunRecord added = rerun(reports::with_digest(record));
    EXPECT_STREQ(added.outcome(), "same");
    EXPECT_EQ(added.count(ChangeKind::other), 2U);

    record = json::parse(certified());
    json& budget = record["results"]["l"]["budget"];
    budget.push_back(budget[0]);
    const RerunRecord left_out = rerun(reports::with_digest(record));
    EXPECT_STREQ(left_out.outcome(), "changed");
    ASSERT_EQ(left_out.changes.size(), 1U);
    EXPECT_EQ(left_out.changes[0].place, "/results/l/budget");
}

/// It is no fault of the record, as a job that cannot be evaluated is; every record is counted, those that were refused, too.
TEST(RerunRecord, IsCountedWhereItsProgressEndsIt) {
    const std::string record =
        reports::to_canonical_json(evaluate_job(k_rerun_tree / "examples" / "gauge_block" / "job.json",
                                                CovarianceFile::none, 1, k_rerun_tree / "templates")
                                       .record);
    const auto ended_by = [&](const char* code) {
        return rerun_record(record, "old.json", 1, k_rerun_tree / "templates", [code](const std::string&) {
            throw gum::StorageError(gum::Diagnostic{
                .code = code, .where = "--time-limit", .what = "used up", .rule = "the rule", .action = "do it"});
        });
    };
    const RerunRecord ended = ended_by("GC-STORE-0024");
    EXPECT_TRUE(ended.was_ended());
    EXPECT_TRUE(ended.is_negative());
    EXPECT_STREQ(ended.outcome(), "not_evaluated");
    EXPECT_EQ(ended.not_evaluated->where, "--time-limit");
    EXPECT_NE(rerun_text({&ended, 1}).find("\n1 record named; evaluated"), std::string::npos)
        << rerun_text({&ended, 1});
    EXPECT_NE(rerun_text({&ended, 1}).find("0 changed, 1 not evaluated\n"), std::string::npos);
    EXPECT_NE(rerun_text({&ended, 1}, 2).find("\n3 records named; evaluated"), std::string::npos);
    EXPECT_NE(rerun_text({&ended, 1}, 2).find("0 changed, 3 not evaluated\n"), std::string::npos);
    EXPECT_TRUE(rerun_text({}, 1).starts_with("1 record named; evaluated")) << "none that can be read";
    EXPECT_FALSE(ended_by("GC-STORE-0001").was_ended()) << "any other trouble is one of the job";
}

TEST(RerunRecord, SaysWhyItCannotBeEvaluated) {
    json record = json::parse(certified());
    record["job"]["files"][0]["content"] = nullptr;
    record["job"]["files"][0]["encoding"] = "none";
    const RerunRecord without = rerun(reports::with_digest(record));
    ASSERT_TRUE(without.not_evaluated);
    EXPECT_EQ(without.not_evaluated->code, "GC-RECORD-0027");
    EXPECT_TRUE(without.is_negative());
    EXPECT_NE(rerun_text({&without, 1}).find("[GC-RECORD-0027]"), std::string::npos);
    EXPECT_EQ(json::parse(rerun_json({&without, 1}))["records"][0]["outcome"], "not_evaluated");
    EXPECT_NE(rerun_csv({&without, 1}).find("old.json,not_evaluated,,,,"), std::string::npos);
}

TEST(RerunRecord, DamagedRecordsAreRefusedWithTheirCodes) {
    json record = json::parse(certified());
    record["results"]["l"]["u"] = 33.5;
    EXPECT_EQ(refusal_of(record.dump()), "GC-RECORD-0021");  // its digest is that of before
    record = json::parse(certified());
    record["job"]["files"][0]["content"] = record["job"]["files"][0]["content"].get<std::string>() + " ";
    EXPECT_EQ(refusal_of(reports::with_digest(record)), "GC-RECORD-0023");
    for (const std::string& text :
         {std::string("{}"), std::string("[1]"), certified().substr(0, 1000), std::string()}) {
        EXPECT_NE(refusal_of(text), "") << text.substr(0, 20);
    }
}

TEST(RerunRecord, FormsForProgramsHoldEveryPlace) {
    const RerunRecord changed = rerun(of_another_version("/results/l/printed/U", "66"));
    const json told = json::parse(rerun_json({&changed, 1}));
    EXPECT_EQ(told["schema"], "gumcert/rerun/1");
    EXPECT_EQ(told["records"][0]["made_by"]["version"], "0.0.7");
    EXPECT_EQ(told["records"][0]["counts"]["printed"], 1);
    EXPECT_EQ(told["records"][0]["changes"][0],
              json({{"kind", "printed"}, {"place", "/results/l/printed/U"}, {"before", "66"}, {"now", "67"}}));
    EXPECT_EQ(rerun_csv({&changed, 1}),
              "record,outcome,kind,place,before,now\nold.json,changed,printed,/results/l/printed/U,66,67\n");
}

}  // namespace
}  // namespace gumcert::evaluation
