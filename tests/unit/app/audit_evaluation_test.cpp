#include "app/audit_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "app/evaluate_job.h"
#include "tests/support/json_schema.h"

namespace gumcert::app {
namespace {

using nlohmann::json;

/// A budget whose first input is divided by what its note does not state; a certificate of a laboratory that is nearly
/// complete, where `waivers` is.
json job_with(double u, const json& waivers) {
    json job = {{"schema", "gumcert/job/1"},
                {"kind", "budget"},
                {"model", {"y = a + b"}},
                {"inputs",
                 {{"a", {{"value", 10}, {"unit", "um"}, {"u", u}, {"note", "U = 0.6 um, k = 2"}, {"source", "K 1"}}},
                  {"b", {{"value", 0}, {"unit", "um"}, {"u", 0.05}}}}}};
    if (!waivers.is_null()) {
        job["certificate"] = {{"status", "not_accredited"}, {"waivers", waivers}};
    }
    return job;
}

Evaluation evaluated(const json& job) {
    const jobs::MemoryFileSource files({{"job.json", job.dump()}});
    return evaluate_job(files, "job.json", CovarianceFile::none, 1,
                        std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates");
}

bool has_finding(const Evaluation& evaluation, const std::string& id) {
    const auto& findings = evaluation.record.certificate->findings;
    return std::any_of(findings.begin(), findings.end(), [&id](const auto& finding) { return finding.id == id; });
}

TEST(AuditOfAnEvaluation, StandsInTheRecord) {
    const Evaluation evaluation = evaluated(job_with(0.3, nullptr));
    const json audit = json::parse(evaluation.record.audit_json);
    EXPECT_EQ(test::JsonSchema("audit-1.schema.json").refusals(audit), "");
    EXPECT_EQ(audit.at("schema"), "gumcert/audit/1");
    EXPECT_EQ(audit.at("kind"), "job");
    EXPECT_EQ(audit.at("file"), "job.json");
    EXPECT_DOUBLE_EQ(audit.at("claimed").at("U"), *evaluation.record.results.front().U);
    EXPECT_FALSE(is_refuted_by_audit(evaluation));
    const json record = json::parse(reports::to_canonical_json(evaluation.record));
    EXPECT_EQ(record.at("audit"), audit);
}

TEST(AuditOfAnEvaluation, CriticalFindingsCloseTheGate) {
    const Evaluation sound = evaluated(job_with(0.3, json::array()));
    EXPECT_FALSE(has_finding(sound, "audit-U13"));
    const Evaluation wrong = evaluated(job_with(0.1, json::array()));
    EXPECT_TRUE(has_finding(wrong, "audit-U13"));
    EXPECT_TRUE(wrong.blocked);
    EXPECT_TRUE(wrong.record.certificate->blocked);
    EXPECT_TRUE(is_refuted_by_audit(wrong));
    const Evaluation specimen = evaluated(job_with(0.1, nullptr));
    EXPECT_FALSE(specimen.record.certificate);
    EXPECT_TRUE(is_refuted_by_audit(specimen));
}

TEST(AuditOfAnEvaluation, AWaiverWithPersonAndReasonOpensIt) {
    json waiver = {{"finding", "U13"},
                   {"by", "Head of laboratory"},
                   {"date", "2026-11-20"},
                   {"reason", "The note repeats an older certificate, U of the new one was halved."}};
    const Evaluation accepted = evaluated(job_with(0.1, json::array({waiver})));
    EXPECT_FALSE(has_finding(accepted, "audit-U13"));
    EXPECT_FALSE(is_refuted_by_audit(accepted));
    const json audit = json::parse(accepted.record.audit_json);
    const auto finding = std::find_if(audit.at("findings").begin(), audit.at("findings").end(),
                                      [](const json& one) { return one.at("id") == "U13"; });
    ASSERT_NE(finding, audit.at("findings").end());
    EXPECT_EQ(finding->at("severity"), "critical") << "accepted is not mended";
    EXPECT_EQ(finding->at("waiver").at("by"), "Head of laboratory");
    waiver["by"] = "-";
    const Evaluation nobody = evaluated(job_with(0.1, json::array({waiver})));
    EXPECT_TRUE(has_finding(nobody, "audit-U13"));
    EXPECT_TRUE(has_finding(nobody, "R18"));
    waiver["by"] = "Head of laboratory";
    waiver["where"] = "elsewhere";
    EXPECT_TRUE(has_finding(evaluated(job_with(0.1, json::array({waiver}))), "audit-U13"));
}

/// The law of the house: what the record's own audit calls critical, and nobody accepts, no certificate issues.
TEST(AuditOfAnEvaluation, NoCertificateIsIssuedAgainstItsOwnAudit) {
    std::mt19937 random(20261124);
    std::uniform_real_distribution<double> exponent(-1.5, 1.0);
    int refuted = 0;
    for (int i = 0; i < 60; ++i) {
        const Evaluation one = evaluated(job_with(0.3 * std::pow(10.0, exponent(random)), json::array()));
        bool critical = false;
        const json audit = json::parse(one.record.audit_json);
        for (const json& finding : audit.at("findings")) {
            critical = critical || (finding.at("severity") == "critical" && !finding.contains("waiver"));
        }
        EXPECT_TRUE(!critical || one.record.certificate->blocked);
        EXPECT_FALSE(critical && one.record.certificate->symbol);
        refuted += is_refuted_by_audit(one) ? 1 : 0;
    }
    EXPECT_GT(refuted, 5);
    EXPECT_LT(refuted, 60) << "a sound budget is not accused";
}

TEST(AuditOfAnEvaluation, ADocumentShowsTheDigest) {
    const Evaluation evaluation = evaluated(job_with(0.3, nullptr));
    const reports::AuditView view = audit_view(std::span(evaluation.audit.get(), 1), {std::string(64, 'a')});
    ASSERT_EQ(view.files.size(), 1U);
    EXPECT_EQ(view.files.front().sha256, std::string(64, 'a'));
    EXPECT_EQ(audit_view(std::span(evaluation.audit.get(), 1)).files.front().sha256, "");
}

}  // namespace
}  // namespace gumcert::app
