#include "reports/audit/audit_sarif.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/hostile_strings.h"
#include "tests/support/sample_audit.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

json sarif_of(const std::vector<audit::AuditReport>& reports) {
    return json::parse(audit_as_sarif(make_audit_view(reports, test::sample_rules(), {.program = "gumcert 0.1.0"}),
                                      test::sample_rules()));
}

TEST(AuditSarif, IsOneRunWithItsRules) {
    const json log = sarif_of({test::sample_audit(), test::sample_audit_of_points()});
    EXPECT_EQ(log.at("version"), "2.1.0");
    ASSERT_EQ(log.at("runs").size(), 1U);
    const json& run = log.at("runs").at(0);
    const json& driver = run.at("tool").at("driver");
    EXPECT_EQ(driver.at("name"), "gumcert");
    EXPECT_EQ(driver.at("version"), "0.1.0");
    ASSERT_EQ(driver.at("rules").size(), test::sample_rules().size());
    for (const json& rule : driver.at("rules")) {
        EXPECT_FALSE(rule.at("shortDescription").at("text").get<std::string>().empty());
        EXPECT_FALSE(rule.at("help").at("text").get<std::string>().empty());
    }
    EXPECT_EQ(run.at("artifacts").size(), 2U);
    for (const json& result : run.at("results")) {
        const std::size_t index = result.at("ruleIndex");
        EXPECT_EQ(driver.at("rules").at(index).at("id"), result.at("ruleId"));
        const json& artifact = result.at("locations").at(0).at("physicalLocation").at("artifactLocation");
        EXPECT_EQ(run.at("artifacts").at(artifact.at("index").get<std::size_t>()).at("location").at("uri"),
                  artifact.at("uri"));
    }
}

TEST(AuditSarif, LevelsFollowSeverities) {
    const json log = sarif_of({test::sample_audit()});
    const json& results = log.at("runs").at(0).at("results");
    ASSERT_EQ(results.size(), 3U);
    EXPECT_EQ(results.at(0).at("level"), "error");
    EXPECT_EQ(results.at(1).at("level"), "warning");
    EXPECT_EQ(results.at(2).at("level"), "note");
    EXPECT_EQ(results.at(0).at("properties").at("severity"), "critical");
    EXPECT_THAT(results.at(0).at("message").at("text").get<std::string>(),
                HasSubstr("U 1.3 -> 1.6 (+23.7 %): U understated, verdict pass -> fail"));
    EXPECT_EQ(results.at(0).at("locations").at(0).at("logicalLocations").at(0).at("fullyQualifiedName"),
              "row 1 (gauge block, certificate), divisor");
}

TEST(AuditSarif, WaiversAreSuppressionsAndGapsAreNotifications) {
    audit::AuditReport report = test::sample_audit();
    report.subject.waivers = {{.finding = "B05", .where = {}, .by = "A. N.", .date = "2026-03-04", .reason = "known"}};
    const json log = sarif_of({report});
    const json& run = log.at("runs").at(0);
    EXPECT_EQ(run.at("results").at(2).at("suppressions").at(0).at("justification"), "known (A. N., 2026-03-04)");
    EXPECT_FALSE(run.at("results").at(0).contains("suppressions"));
    const json& notes = run.at("invocations").at(0).at("toolConfigurationNotifications");
    ASSERT_EQ(notes.size(), 3U) << "two rules that were not checked, and a line that was not read";
    EXPECT_EQ(notes.at(0).at("associatedRule").at("id"), "T01");
    EXPECT_EQ(notes.at(2).at("level"), "warning");
}

TEST(AuditSarif, PointsOfOneNameAreOneLocation) {
    audit::AuditSubject subject;
    subject.name = "table.csv";
    subject.budgets = {test::sample_audited_budget(), test::sample_audited_budget()};
    const json log = sarif_of({audit::audit(std::move(subject), test::sample_rules())});
    EXPECT_EQ(log.at("runs").at(0).at("results").at(0).at("locations").at(0).at("logicalLocations").size(), 2U);
}

TEST(AuditSarif, NamesOfFilesAreRelativeReferences) {
    for (const std::string& hostile : test::hostile_strings()) {
        const json log = sarif_of({test::hostile_audit(hostile)});
        EXPECT_THAT(log.at("runs").at(0).at("artifacts").at(0).at("location").at("uri").get<std::string>(),
                    MatchesRegex("[A-Za-z0-9._~/%-]*"));
    }
    const json log = sarif_of({test::sample_audit("a b#1?.csv")});
    EXPECT_EQ(log.at("runs").at(0).at("artifacts").at(0).at("location").at("uri"), "a%20b%231%3F.csv");
}

}  // namespace
}  // namespace gumcert::reports
