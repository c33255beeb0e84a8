#include "reports/audit/audit_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "json/canonical_json.h"
#include "tests/support/hostile_strings.h"
#include "tests/support/json_schema.h"
#include "tests/support/sample_audit.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;

std::string json_text(std::vector<audit::AuditReport> reports, const std::vector<certificate::Waiver>& waivers = {}) {
    for (audit::AuditReport& report : reports) {
        report.subject.waivers = waivers;
    }
    return audit_as_json(make_audit_view(reports, test::sample_rules(), {.program = "gumcert 0.1.0"}));
}

std::set<std::string> names_of(const json& object) {
    std::set<std::string> names;
    for (const auto& [name, value] : object.items()) {
        names.insert(name);
    }
    return names;
}

TEST(AuditJson, HasTheFormOfTheContract) {
    const json all = json::parse(json_text({test::sample_audit()}));
    EXPECT_EQ(all.at("schema"), "gumcert/audit/1");
    for (const char* key : {"claimed", "recomputed", "audited"}) {
        for (const char* name : {"value", "u_c", "nu_eff", "k", "U", "verdict"}) {
            EXPECT_TRUE(all.at(key).contains(name)) << key << ' ' << name;
        }
    }
    EXPECT_EQ(all.at("claimed").at("U"), 1.3);
    EXPECT_EQ(all.at("claimed").at("verdict"), "pass");
    EXPECT_EQ(all.at("audited").at("verdict"), "fail");
    const json& finding = all.at("findings").at(0);
    EXPECT_EQ(finding.at("id"), "U13");
    EXPECT_EQ(finding.at("severity"), "critical");
    EXPECT_EQ(finding.at("clause_verified"), false);
    for (const char* step : {"alone", "last"}) {
        EXPECT_EQ(names_of(finding.at("effect").at(step)),
                  (std::set<std::string>{"u_c", "nu_eff", "k", "U", "verdict", "En"}));
    }
    EXPECT_TRUE(finding.at("effect").at("share").is_number());
    EXPECT_TRUE(all.at("findings").at(2).at("effect").is_null()) << "nobody knows how large the contribution is";
    EXPECT_EQ(all.at("not_checked").at(0), (json{{"id", "T01"}, {"because", "no certificate data are stated"}}));
    EXPECT_FALSE(all.contains("files"));
}

TEST(AuditJson, TellsOfTheScoreWhereTheEffectIsOnAnotherResult) {
    audit::AuditReport report = test::sample_audit();
    EXPECT_FALSE(json::parse(json_text({report})).at("findings").at(0).contains("effect_on_score"));
    report.findings[0].effect_on_score = report.findings[0].effect;
    report.findings[0].effect_on_score->alone.en = 0.25;
    const json all = json::parse(json_text({report}));
    const json& score = all.at("findings").at(0).at("effect_on_score");
    EXPECT_EQ(names_of(score), (std::set<std::string>{"alone", "last", "result", "share"}));
    EXPECT_EQ(score.at("alone").at("En"), 0.25);
    EXPECT_EQ(score.at("result"), all.at("findings").at(0).at("effect_on"));
    EXPECT_EQ(test::JsonSchema("audit-1.schema.json").refusals(all), "");
}

TEST(AuditJson, InfiniteDegreesOfFreedomAreNull) {
    audit::AuditSubject subject;
    subject.name = "a.csv";
    subject.budgets = {test::sample_audited_budget()};
    subject.budgets[0].rows[2].used_nu = std::numeric_limits<double>::infinity();
    subject.budgets[0].value.reset();
    subject.budgets[0].claims.value.reset();
    const json all = json::parse(json_text({audit::audit(std::move(subject), test::sample_rules())}));
    EXPECT_TRUE(all.at("recomputed").at("nu_eff").is_null());
    EXPECT_TRUE(all.at("recomputed").at("value").is_null());
    EXPECT_TRUE(all.at("results").at(0).at("allowed").at("nu_eff").at("high").is_null());
}

TEST(AuditJson, SeveralFilesStandBesideTheWorst) {
    const json all = json::parse(json_text({test::sample_audit_of_points(), test::sample_audit()}));
    ASSERT_EQ(all.at("files").size(), 2U);
    EXPECT_EQ(all.at("files").at(0).at("results").size(), 4U);
    EXPECT_EQ(all.at("claimed"), all.at("files").at(1).at("claimed"));
    EXPECT_EQ(all.at("file"), "micrometer.csv");
    EXPECT_EQ(all.at("result"), "deviation of indication");
    EXPECT_EQ(all.at("files").at(0).at("findings").at(0).at("effect_on"), "deviation at 10 mm");
}

TEST(AuditJson, AFileWithoutABudgetHasNoOutcome) {
    audit::AuditSubject subject;
    subject.name = "empty.csv";
    const json all = json::parse(json_text({audit::audit(std::move(subject), test::sample_rules())}));
    EXPECT_TRUE(all.at("claimed").is_null());
    EXPECT_TRUE(all.at("findings").empty() || all.at("findings").at(0).at("effect").is_null());
}

TEST(AuditJson, TheSchemaAcceptsWhatIsWrittenAndNothingElse) {
    const test::JsonSchema schema("audit-1.schema.json");
    const std::vector<certificate::Waiver> waivers = {
        {.finding = "B05", .where = {}, .by = "A. N.", .date = "2026-03-04", .reason = "known"}};
    audit::AuditSubject empty;
    empty.name = "empty.csv";
    const audit::AuditReport nothing = audit::audit(std::move(empty), {});
    for (const std::vector<audit::AuditReport>& reports :
         {std::vector{test::sample_audit()}, std::vector{test::sample_audit(), test::sample_audit_of_points()},
          std::vector{nothing}, std::vector{nothing, test::sample_audit()}}) {
        EXPECT_EQ(schema.refusals(json::parse(json_text(reports, waivers))), "");
    }
    json spoiled = json::parse(json_text({test::sample_audit()}));
    spoiled["findings"][0]["severity"] = "grave";
    EXPECT_FALSE(schema.accepts(spoiled));
    spoiled = json::parse(json_text({test::sample_audit()}));
    spoiled["claimed"].erase("k");
    EXPECT_FALSE(schema.accepts(spoiled));
}

TEST(AuditJson, SurvivesHostileTextsAndGivesTheSameBytes) {
    const test::JsonSchema schema("audit-1.schema.json");
    for (const std::string& hostile : test::hostile_strings()) {
        const std::string text = json_text({test::hostile_audit(hostile)});
        EXPECT_EQ(schema.refusals(json::parse(text)), "") << hostile;
        EXPECT_EQ(text.find('\x1B'), std::string::npos);
    }
    EXPECT_EQ(json_text({test::sample_audit()}), json_text({test::sample_audit()}));
}

TEST(AuditJson, OfManyFilesIsCanonicalHoweverItsTasksAreDone) {
    const std::vector<audit::AuditReport> reports(3, test::sample_audit());
    const TaskRunner backwards = [](std::size_t n, const std::function<void(std::size_t)>& task) {
        for (std::size_t i = n; i > 0; --i) {
            task(i - 1);
        }
    };
    const AuditView view = make_audit_view(reports, test::sample_rules(), {.program = "gumcert 0.1.0"}, backwards);
    const std::string text = audit_as_json(view, backwards);
    EXPECT_EQ(text, json_text(reports));
    EXPECT_EQ(text, gumcert::json::canonical_json(json::parse(text)));
    EXPECT_EQ(json::parse(text).at("files").size(), 3U);
}

}  // namespace
}  // namespace gumcert::reports
