#include "reports/record/make/rotary_table/fixture_budget_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/campaign.h"

namespace gumcert::reports {
namespace {

using jobs::test::Files;
using jobs::test::replace;
using testing::HasSubstr;

reports::FixtureBudget record_of(const Files& files) {
    jobs::RotaryTableJob job = jobs::test::read(files);
    const gum::FixtureUncertainty fixture = gum::apply_fixture_budget(job);
    return fixture_budget_record(job, fixture);
}

TEST(FixtureBudgetRecord, HasTheBudgetOfTheLeastCertainCoordinate) {
    Files files = jobs::test::small_campaign();
    replace(files.at("job.json"), "\"coordinates\"", "\"budget\": \"fixture_budget.json\", \"coordinates\"");
    files["fixture_budget.json"] = jobs::test::small_fixture_budget();
    files["fixture_points.csv"] = jobs::test::small_fixture_points();
    std::string& points = files.at("fixture_points.csv");  // in an order of its own
    replace(points, "R1.x,33.25\n", "");
    points += "R1.x,33.25\n";
    const reports::FixtureBudget record = record_of(files);
    EXPECT_EQ(record.method, "budget");
    EXPECT_EQ(record.file, "fixture_budget.json");
    EXPECT_EQ(record.largest_coordinate, "R3.x");
    ASSERT_EQ(record.largest.size(), 3U);
    EXPECT_EQ(record.largest[1].input, "d_cmm");
    EXPECT_NEAR(record.largest[1].share.number, 0.09 / (0.09 + std::pow(0.15275, 2)), 1e-12);
}

TEST(FixtureBudgetRecord, WithoutBudgetIsAsStated) {
    const reports::FixtureBudget record = record_of(jobs::test::small_campaign());
    EXPECT_EQ(record.method, "stated");
    EXPECT_THAT(record.largest, testing::IsEmpty());
}

TEST(FixtureBudgetRecord, SaysWhatIsWrongWithTheEquationOfTheSourcePaper) {
    Files files = jobs::test::small_campaign();
    replace(files.at("job.json"), "\"coordinates\"", "\"uncertainty\": \"source_paper\", \"coordinates\"");
    const reports::FixtureBudget record = record_of(files);
    EXPECT_EQ(record.method, "source_paper");
    ASSERT_EQ(record.remarks.size(), 4U);
    EXPECT_THAT(record.remarks[1], HasSubstr("3.334"));
    // Its terms, as section 5.1 of the paper prints them: sqrt(3.12² + 1.176²) = 3.334, sqrt(0.4² + 0.0289²) = 0.401.
    EXPECT_NEAR(std::hypot(3.12, 1.176), 3.334, 0.0005);
    EXPECT_NEAR(std::hypot(0.4, 0.0289), 0.401, 0.0005);
    EXPECT_NEAR(0.1 / std::sqrt(12.0), 0.0289, 0.00005);
}

}  // namespace
}  // namespace gumcert::reports
