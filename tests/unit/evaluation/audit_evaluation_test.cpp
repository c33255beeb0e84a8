#include "evaluation/audit_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "audit/budget_outcome.h"
#include "audit/sources/record_subject.h"
#include "evaluation/evaluate_job.h"
#include "tests/support/json_schema.h"

namespace gumcert::evaluation {
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

TEST(AuditOfAnEvaluation, CriticalFindingsAreToldWhereNoCertificateHasThem) {
    EXPECT_TRUE(critical_messages(evaluated(job_with(0.3, nullptr))).empty());
    const std::vector<gum::Diagnostic> told = critical_messages(evaluated(job_with(0.1, nullptr)));
    ASSERT_FALSE(told.empty());
    EXPECT_EQ(told.front().code, "GC-AUDIT-0020");
    EXPECT_TRUE(told.front().where.starts_with("audit U13, ")) << told.front().where;
    EXPECT_EQ(told.front().severity, gum::Severity::warning);
    EXPECT_TRUE(critical_messages(evaluated(job_with(0.1, json::array()))).empty()) << "its findings are told";
    EXPECT_TRUE(critical_messages(Evaluation{}).empty());
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

/// A sum of inputs of many shapes, one of which is stated so.
json job_of_shapes(const json& first, std::mt19937 random) {
    std::uniform_real_distribution<double> size(0.01, 0.5);
    std::uniform_int_distribution<int> shape(0, 5), count(1, 5), sign(0, 1);
    json job = {{"schema", "gumcert/job/1"}, {"kind", "budget"}, {"inputs", {{"a", first}}}};
    job["inputs"]["a"].update({{"value", 10}, {"unit", "um"}, {"source", "K 1"}});
    std::string model = "y = a";
    const int others = count(random);
    for (int i = 0; i < others; ++i) {
        const std::string name = "b" + std::to_string(i);
        json& input = job["inputs"][name];
        input = {{"value", 0}, {"unit", "um"}};
        const double w = size(random);
        switch (shape(random)) {
            case 0:
                input["u"] = w;
                break;
            case 1:
                input.update({{"u", w}, {"nu", 3.0 + 20.0 * w}});
                break;
            case 2:
                input["half_width"] = w;
                break;
            case 3:
                input.update({{"half_width", w}, {"distribution", "triangular"}});
                break;
            case 4:
                input.update({{"half_width", w}, {"distribution", "arcsine"}});
                break;
            default:
                input.erase("value");
                input["observations"] = {0.0, w, -w, 0.3 * w, 0.2 * w};
        }
        model += (sign(random) == 1 ? " + " : " - ") + name;
    }
    job["model"] = {model};
    job["reporting"] = {{"degrees_of_freedom", sign(random) == 1 ? "truncated" : "exact"}};
    return job;
}

/// A corrected copy of an own job has the U that the evaluation gives for the corrected job, whatever k it takes then.
TEST(AuditOfAnEvaluation, CorrectsToTheUThatTheCorrectedJobHas) {
    std::mt19937 random(17025);
    std::uniform_real_distribution<double> size(0.05, 2.0), factor(1.5, 3.0);
    int convolved = 0, changed = 0;
    for (int i = 0; i < 120; ++i) {
        const double a = size(random), k = factor(random);
        const std::string in_words = json(a).dump() + " um";
        json wrong, right;
        std::string rule;
        switch (i % 4) {
            case 0:
                rule = "U10";
                wrong = {{"u", a}, {"note", "verified, MPE " + in_words}};
                right = {{"half_width", a}};
                break;
            case 1:
                rule = "U13";
                wrong = {{"u", a}, {"note", "U = " + in_words + ", k = " + json(k).dump()}};
                right = {{"U", a}, {"k", k}};
                break;
            case 2:
                rule = "U09";
                wrong = {{"u", a}, {"note", "resolution " + in_words}};
                right = {{"resolution", a}};
                break;
            default:
                rule = "U24";
                wrong = {{"u", 0.5 * a}, {"note", "verified, MPE " + in_words}};
                right = {{"half_width", a}};
        }
        const Evaluation claimed = evaluated(job_of_shapes(wrong, random)),
                         mended = evaluated(job_of_shapes(right, random));
        random.discard(100);
        const json audit = json::parse(claimed.record.audit_json);
        int of_rule = 0, with_effect = 0;
        for (const json& finding : audit.at("findings")) {
            of_rule += finding.at("id") == rule ? 1 : 0;
            with_effect += finding.contains("effect") && !finding.at("effect").is_null() ? 1 : 0;
        }
        ASSERT_EQ(of_rule, 1) << rule << " " << claimed.record.job_json;
        ASSERT_EQ(with_effect, 1) << claimed.record.audit_json;
        const reports::Result& of = mended.record.results.front();
        EXPECT_NEAR(audit.at("audited").at("U").get<double>() / *of.U, 1.0, 1e-3)
            << rule << ", k by " << of.coverage << "\n"
            << claimed.record.job_json;
        convolved += of.coverage == "convolution" ? 1 : 0;
        changed += of.coverage != claimed.record.results.front().coverage ? 1 : 0;
    }
    EXPECT_GT(convolved, 20);
    EXPECT_GT(changed, 10);
}

/// What the audit decides by probability of a record of ours is what the certificate says, or nothing: correlated inputs and
/// shapes that rows do not tell included.
TEST(AuditOfAnEvaluation, DecidesByProbabilityAsTheCertificateOrNotAtAll) {
    std::mt19937 random(30112026);
    std::uniform_real_distribution<double> size(0.2, 1.0), limit(1.2, 3.2), correlation(-0.95, 0.95);
    int decided = 0, silent = 0, failed = 0;
    for (int i = 0; i < 100; ++i) {
        const double u = size(random);
        json inputs = {{"a", {{"value", 10}, {"unit", "mm"}, {"u", u}}},
                       {"b", {{"value", 0}, {"unit", "mm"}, {"u", size(random)}}},
                       {"c", {{"value", 0}, {"unit", "mm"}, {"half_width", size(random)}}}};
        json job = {{"schema", "gumcert/job/1"}, {"kind", "budget"}, {"model", {"y = a + b + c"}}};
        switch (i % 5) {
            case 0:
                job["correlations"] = json::array({json::array({"a", "b", correlation(random)})});
                break;
            case 1:
                inputs["c"] = {{"unit", "mm"}, {"distribution", {{"kind", "gamma"}, {"shape", 2}, {"scale", 0.3 * u}}}};
                break;
            case 2:
                inputs["c"]["distribution"] = "trapezoidal";
                inputs["c"]["beta"] = 0.3;
                break;
            case 3:
                inputs["b"]["nu"] = 4;
                break;
            default:
                inputs["c"]["distribution"] = "arcsine";
        }
        job["inputs"] = inputs;
        const bool by_proof = i % 2 == 1;
        job["certificate"] = {
            {"status", "not_accredited"},
            {"specifications", json::array({{{"id", "s"},
                                             {"results", {"y"}},
                                             {"upper", 10.0 + limit(random) * 2.0 * u},
                                             {"unit", "mm"},
                                             {"document", "Drawing 1234"},
                                             {"rule", by_proof ? json({{"id", "DR-08"}, {"probability", 0.95}})
                                                               : json({{"id", "DR-07"}, {"probability", 0.025}})}}})}};
        const Evaluation one = evaluated(job);
        const auto& verdict = one.record.certificate->tables.at(0).columns.at(0).values.at(0).verdict;
        ASSERT_TRUE(verdict) << job;
        EXPECT_FALSE(has_finding(one, "audit-D04")) << job;
        const audit::AuditSubject subject = audit::subject_of(one.record, "record.json");
        const std::string again = audit::evaluate(subject.budgets.at(0)).verdict;
        EXPECT_TRUE(again.empty() || again == verdict->verdict) << again << ", not " << verdict->verdict << "\n" << job;
        decided += again.empty() ? 0 : 1;
        silent += again.empty() ? 1 : 0;
        failed += verdict->verdict == "fail" || verdict->verdict == "undetermined" ? 1 : 0;
    }
    EXPECT_GT(decided, 30);
    EXPECT_GT(silent, 50) << "correlated beside another shape, gamma, trapezoid";
    EXPECT_GT(failed, 10);
}

TEST(AuditOfAnEvaluation, ADocumentShowsTheDigest) {
    const Evaluation evaluation = evaluated(job_with(0.3, nullptr));
    const reports::AuditView view = audit_view(std::span(evaluation.audit.get(), 1), {std::string(64, 'a')});
    ASSERT_EQ(view.files.size(), 1U);
    EXPECT_EQ(view.files.front().sha256, std::string(64, 'a'));
    EXPECT_EQ(audit_view(std::span(evaluation.audit.get(), 1)).files.front().sha256, "");
}

}  // namespace
}  // namespace gumcert::evaluation
