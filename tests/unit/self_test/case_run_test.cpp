#include "self_test/case_run.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/read_file.h"

namespace gumcert::self_test {
namespace {

using nlohmann::json;

const std::filesystem::path k_tree(GUMCERT_SOURCE_DIR);

json resistors() {
    return json::parse(
        evaluation::read_file(k_tree / "tests/reference/cases/gum-522-series-resistors-uncorrelated.json"));
}

CaseOutcome outcome_of(const json& reference) {
    return run_case(reference_case_from_json(reference.dump(), "resistors"), k_tree / "templates");
}

/// The case with one value alone.
CaseOutcome with_first(const char* key, const json& value) {
    json reference = resistors();
    json first = reference["expected"][0];
    first[key] = value;
    reference["expected"] = json::array({first});
    return outcome_of(reference);
}

TEST(CaseRun, ACaseAsItIsPassesWithAllOfItsDigits) {
    const CaseOutcome outcome = outcome_of(resistors());
    EXPECT_TRUE(outcome.passes());
    ASSERT_FALSE(outcome.values.empty());
    EXPECT_EQ(outcome.agreed(), outcome.values.size());
    for (const ComparedValue& value : outcome.values) {
        EXPECT_TRUE(value.was_found);
        EXPECT_TRUE(value.because.empty()) << value.because;
    }
}

TEST(CaseRun, EverySpoiledValueIsRefusedAndNamed) {
    const json whole = resistors();
    for (std::size_t i = 0; i < whole["expected"].size(); ++i) {
        json reference = whole;
        json& entry = reference["expected"][i];
        const char* const key = entry.contains("printed") ? "printed" : "computed";
        entry[key] =
            entry[key].is_string() ? json("7" + entry[key].get<std::string>()) : json(entry[key].get<double>() * 1.01);
        const CaseOutcome outcome = outcome_of(reference);
        EXPECT_FALSE(outcome.passes());
        EXPECT_EQ(outcome.agreed(), outcome.values.size() - 1);
        EXPECT_NE(outcome.values[i].because.find(", expected "), std::string::npos) << outcome.values[i].because;
    }
}

TEST(CaseRun, AJobThatIsRefusedIsAFailureOfItsValues) {
    json reference = resistors();
    reference["jobs"]["law"]["model"] = json::array({"Rref = "});
    const CaseOutcome outcome = outcome_of(reference);
    EXPECT_FALSE(outcome.passes());
    EXPECT_EQ(outcome.agreed(), 0U);
    for (const ComparedValue& value : outcome.values) {
        EXPECT_FALSE(value.was_found);
        EXPECT_TRUE(value.because.starts_with("job law: job.json")) << value.because;
    }
}

TEST(CaseRun, WhatIsNotThereIsAFailure) {
    for (const char* path : {"law/results/none/u", "none/results/Rref/u", "law/results/Rref/budget/input=none/u",
                             "law/results/Rref", "law/results/Rref/budget/9999/u", "law/results/Rref/u/more",
                             "{law/results/Rref/u} / 0", "{law/results/Rref/u} +"}) {
        const CaseOutcome outcome = with_first("found", path);
        EXPECT_FALSE(outcome.passes()) << path;
        ASSERT_EQ(outcome.values.size(), 1U);
        EXPECT_FALSE(outcome.values[0].because.empty());
    }
}

TEST(CaseRun, EveryPlaceOfAValueIsCompared) {
    const std::string place = resistors()["expected"][0]["found"];
    EXPECT_TRUE(with_first("found", json::array({place, place})).passes());
    const CaseOutcome outcome = with_first("found", json::array({place, "1e3 * {" + place + "}"}));
    EXPECT_FALSE(outcome.passes());
    EXPECT_NE(outcome.values[0].because.find("1e3"), std::string::npos);
}

TEST(CaseRun, JobsThatNeedThemselvesEnd) {
    json reference = resistors();
    reference["jobs"]["law"]["title"] = "{law/title}";
    EXPECT_FALSE(outcome_of(reference).passes());
    reference = resistors();
    reference["jobs"]["law"]["like"] = "law";
    EXPECT_FALSE(outcome_of(reference).passes());
}

TEST(CaseRun, NothingToCompareIsNoSuccess) {
    json reference = resistors();
    reference["expected"] = json::array();
    const CaseOutcome outcome = outcome_of(reference);
    EXPECT_FALSE(outcome.passes());
    EXPECT_FALSE(outcome.refused.empty());
}

}  // namespace
}  // namespace gumcert::self_test
