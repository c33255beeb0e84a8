#include "jobs/problem_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::jobs {
namespace {

using testing::HasSubstr;

std::string at(int line) {
    return "p.csv:" + std::to_string(line) + ":1";
}

void refuse_cell(ProblemList& problems, int line, const std::string& what, const std::string& column = "x") {
    problems.refuse(k_csv_not_a_number, at(line), what, "must be a number", "correct it", column);
}

TEST(ProblemList, HoldsWhatWasToldInItsOrder) {
    ProblemList problems("job.json");
    problems.warn(k_unknown_choice, "job.json#/a", "w", "rule", "action");
    problems.refuse(k_missing_key, "job.json#/b", "first", "rule", "action");
    problems.note(k_unknown_choice, "job.json#/c", "n", "rule", "action");
    problems.refuse(k_wrong_type, "job.json#/d", "second", "rule", "action");
    ASSERT_EQ(problems.refused().size(), 2U);
    EXPECT_EQ(problems.refused()[0].what, "first");
    EXPECT_EQ(problems.refused()[1].what, "second");
    ASSERT_EQ(problems.warnings().size(), 2U);
    EXPECT_EQ(problems.warnings()[0].severity, gum::Severity::warning);
    EXPECT_EQ(problems.warnings()[1].severity, gum::Severity::note);
    EXPECT_EQ(problems.refusals(), 2U);
    EXPECT_EQ(problems.file(), "job.json");
}

/// One cause in a column is one message with the number of its places; another column, rule or action is another cause.
TEST(ProblemList, OneCauseOfAColumnIsOneMessage) {
    ProblemList problems("p.csv");
    refuse_cell(problems, 2, "\"a\"");
    EXPECT_EQ(problems.refused()[0].what, "\"a\"");
    refuse_cell(problems, 3, "\"b\"");
    EXPECT_EQ(problems.refused()[0].what, "\"a\"; the same in 1 more place, " + at(3));
    refuse_cell(problems, 7, "\"c\"");
    ASSERT_EQ(problems.refused().size(), 1U);
    EXPECT_EQ(problems.refused()[0].where, at(2));
    EXPECT_EQ(problems.refused()[0].what, "\"a\"; the same in 2 more places, the last is " + at(7));
    refuse_cell(problems, 2, "\"a\"", "y");
    problems.refuse(k_csv_not_a_number, at(2), "\"a\"", "must be a whole number", "correct it", "x");
    problems.refuse(k_csv_not_a_number, at(2), "\"a\"", "must be a number", "leave it out", "x");
    // The same message in another column is the same message.
    EXPECT_EQ(problems.refused().size(), 3U);
    EXPECT_EQ(problems.refusals(), 6U) << "every one is counted";
}

TEST(ProblemList, WhatStandsAloneIsToldOnceForEachPlace) {
    ProblemList problems("job.json");
    for (int i = 0; i < 3; ++i) {
        refuse_cell(problems, 2, "\"a\"", "");
        refuse_cell(problems, 3, "\"a\"", "");
    }
    EXPECT_EQ(problems.refused().size(), 2U);
    EXPECT_EQ(problems.refusals(), 6U);
}

/// However many there are: the first 200, and a line that says how many more.
TEST(ProblemList, EndsWithHowManyMoreThereAre) {
    for (const std::size_t n :
         {ProblemList::k_limit - 1, ProblemList::k_limit, ProblemList::k_limit + 1, ProblemList::k_limit * 3}) {
        ProblemList problems("p.csv");
        for (std::size_t i = 0; i < n; ++i) {
            refuse_cell(problems, static_cast<int>(i), "\"a\"", "");
        }
        const std::vector<gum::Diagnostic> refused = problems.refused();
        EXPECT_EQ(problems.refusals(), n);
        const std::size_t more = n > ProblemList::k_limit ? n - ProblemList::k_limit : 0;
        ASSERT_EQ(refused.size(), n - more + (more > 0 ? 1 : 0));
        if (more > 0) {
            EXPECT_EQ(refused.back().what, "and " + std::to_string(more) + " more");
            EXPECT_EQ(refused.back().where, "p.csv");
            EXPECT_EQ(refused.back().severity, gum::Severity::error);
        }
        EXPECT_TRUE(problems.warnings().empty());
    }
}

TEST(ProblemList, TakesWhatAnotherOneHolds) {
    ProblemList all("job.json");
    ProblemList other("p.csv");
    refuse_cell(all, 2, "\"a\"");
    refuse_cell(other, 3, "\"b\"");
    other.refuse(k_missing_key, "p.csv:1:1", "no column", "rule", "action");
    other.warn(k_unknown_choice, "p.csv:1:1", "w", "rule", "action");
    ProblemList some = all;
    all.take(other);
    EXPECT_EQ(all.refusals(), 3U);
    ASSERT_EQ(all.refused().size(), 2U) << "of one column, as if one list had been told of both";
    EXPECT_THAT(all.refused()[0].what, HasSubstr(at(3)));
    EXPECT_EQ(all.warnings().size(), 1U);
    some.take(other, [](const gum::Diagnostic& one) { return one.code == k_missing_key.code; });
    EXPECT_EQ(some.refusals(), 2U);
    EXPECT_EQ(some.refused()[1].what, "no column");
    EXPECT_TRUE(some.warnings().empty());
}

}  // namespace
}  // namespace gumcert::jobs
