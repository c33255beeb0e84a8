#include "audit/sources/record_subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "audit/audit.h"
#include "audit/budget_outcome.h"
#include "audit/rules/registry.h"

namespace gumcert::audit {
namespace {

/// A record of two inputs, u_c = 0.5 µm, k = 2.
reports::EvaluationRecord two_rows() {
    reports::EvaluationRecord record;
    record.kind = "budget";
    record.job_json =
        R"({"inputs": {"a": {"value": 0, "unit": "um", "u": 0.3}, "b": {"value": 1, "unit": "um", "mpe": 0.69282}}})";
    reports::Result result;
    result.name = "y";
    result.unit = "um";
    result.value = 1.0;
    result.u = 0.5;
    result.k = 2.0;
    result.U = 1.0;
    result.coverage = "normal";
    result.reported.value = 1.0;
    result.reported.u = 0.5;
    result.reported.k = 2.0;
    result.reported.U = 1.0;
    reports::BudgetRow a;
    a.input = "a";
    a.value.number = 0.0;
    a.unit = "um";
    a.u.number = 0.3;
    a.type = "B";
    a.sensitivity.number = 1.0;
    a.contribution.number = 0.3;
    a.distribution = "normal";
    reports::BudgetRow b = a;
    b.input = "b";
    b.value.number = 1.0;
    b.u.number = 0.4;
    b.contribution.number = 0.4;
    b.distribution = "uniform";
    result.budget = {a, b};
    record.results = {result};
    return record;
}

TEST(SubjectOfRecord, EvaluatesToWhatTheRecordReports) {
    const AuditSubject subject = subject_of(two_rows(), "record.json");
    EXPECT_EQ(subject.kind, AuditSubject::Kind::record);
    ASSERT_EQ(subject.budgets.size(), 1U);
    const BudgetOutcome outcome = evaluate(subject.budgets.front());
    EXPECT_NEAR(outcome.u_c, 0.5, 1e-12);
    EXPECT_NEAR(outcome.U, 1.0, 1e-5) << "k = 2 is t of 95.45 % but for its last digits";
    EXPECT_TRUE(subject.budgets.front().evaluated_here);
}

TEST(SubjectOfRecord, TakesTheStatementsOfInputsFromTheJob) {
    const AuditSubject subject = subject_of(two_rows(), "record.json");
    const AuditedRow& b = subject.budgets.front().rows.at(1);
    EXPECT_EQ(b.origin, Origin::specification);
    EXPECT_EQ(b.origin_value, 0.69282);
    EXPECT_EQ(b.shape, Shape::rectangular);
    EXPECT_EQ(b.place, "/results/y/budget/1");
}

/// What a job says in words of a u that it states alone counts the same wherever it stands.
TEST(SubjectOfRecord, ReadsTheWordsOfSourceAndNote) {
    for (const std::string words :
         {"data sheet of the balance, MPE 0.3 um", "U = 0.3 um, k = 2", "resolution 0.3 um", "limits ±0.3 um",
          "manufacturer's specification 0.3 um", "certificate K-17", "mean of 10 readings", "nothing to read"}) {
        const auto report = [&words](bool in_source) {
            reports::EvaluationRecord record = two_rows();
            record.job_json = R"({"inputs": {"a": {"value": 0, "unit": "um", "u": 0.3, ")" +
                              std::string(in_source ? "source" : "note") + R"(": ")" + words +
                              R"("}, "b": {"u": 0.4}}})";
            record.results[0].budget[0].source = in_source ? words : "";
            return audit(subject_of(record, "record.json"), all_rules());
        };
        const AuditReport note = report(false), source = report(true);
        const AuditedRow& of_note = note.subject.budgets.at(0).rows.at(0);
        const AuditedRow& of_source = source.subject.budgets.at(0).rows.at(0);
        EXPECT_EQ(of_source.origin, of_note.origin) << words;
        EXPECT_EQ(of_source.origin_value, of_note.origin_value) << words;
        const auto rules = [](const AuditReport& all) {
            std::set<std::string> found;
            for (const AuditFinding& finding : all.findings) {
                if (finding.rule.starts_with("U")) {
                    found.insert(finding.rule);
                }
            }
            return found;
        };
        EXPECT_EQ(rules(source), rules(note)) << words;
        if (words.find("MPE") != std::string::npos) {
            EXPECT_TRUE(rules(source).contains("U10"));
        }
    }
}

TEST(SubjectOfRecord, WhatCorrelationsAddStaysAsItIs) {
    reports::EvaluationRecord record = two_rows();
    record.results[0].u = 0.6;
    record.results[0].reported.u = 0.6;
    record.results[0].U = record.results[0].reported.U = 1.2;
    const AuditSubject subject = subject_of(record, "record.json");
    EXPECT_NEAR(subject.budgets.front().correlation_variance, 0.36 - 0.25, 1e-12);
    EXPECT_NEAR(evaluate(subject.budgets.front()).u_c, 0.6, 1e-12);
}

/// What trials show beyond the law of propagation has no part in ν_eff, and the stated one is what is claimed.
TEST(SubjectOfRecord, ClaimsTheNuThatIsStatedBesideTrials) {
    for (const double u : {0.5, 0.55, 0.8, 2.0}) {
        reports::EvaluationRecord record = two_rows();
        reports::Result& result = record.results[0];
        result.budget[0].nu.number = 4.0;
        result.nu_eff = std::pow(0.5, 4) / (std::pow(0.3, 4) / 4.0);
        result.reported.method = "monte_carlo";
        result.reported.u = u;
        result.reported.U = 1.9 * u;
        result.reported.k = 1.9;
        const AuditReport report = audit(subject_of(record, "record.json"), all_rules());
        const AuditedResult& audited = report.results.at(0);
        EXPECT_NEAR(audited.claimed.nu_eff, *result.nu_eff, 1e-9) << u;
        EXPECT_NEAR(audited.audited.nu_eff, *result.nu_eff, 1e-9) << u;
        EXPECT_TRUE(audited.allowed.nu_eff.contains(*result.nu_eff) ||
                    std::abs(audited.allowed.nu_eff.low / *result.nu_eff - 1.0) < 1e-9);
        EXPECT_NEAR(audited.audited.U, 1.9 * u, 1e-9) << u;
        result.nu_eff = 482.0;
        EXPECT_EQ(audit(subject_of(record, "record.json"), all_rules()).results.at(0).claimed.nu_eff, 482.0);
    }
}

TEST(SubjectOfRecord, KnowsWhatIsMeasured) {
    reports::EvaluationRecord record = two_rows();
    EXPECT_FALSE(subject_of(record, "record.json").budgets[0].rows[0].is_measured);
    record.results[0].budget[0].standard = "TS-2";
    record.job_json = R"({"inputs": {"b": {"value": 1, "unit": "um", "mpe": 0.7, "role": "indication"}}})";
    const std::vector<AuditedRow> rows = subject_of(record, "record.json").budgets[0].rows;
    EXPECT_TRUE(rows[0].is_measured);
    EXPECT_TRUE(rows[1].is_measured);
}

/// A comparison at two points, E_n = −0.5 and 0.8; the reference has a budget in a file of the job.
reports::EvaluationRecord compared() {
    reports::EvaluationRecord record;
    record.kind = "rotary_table";
    record.job_json = R"({"reference_method": {"budget": "indicator.json"}})";
    reports::InputFile file;
    file.name = "indicator.json";
    file.content = R"({"inputs": {"b": {"value": 0, "unit": "um", "u": 0.4, "note": "MPE 0.4 um"}}})";
    record.job_files = {file};
    reports::Comparison& comparison = record.comparison.emplace();
    comparison.unit = "um";
    comparison.reference_name = "indicator";
    comparison.score_probability = 0.9545;
    for (const double difference : {-0.5, 0.8}) {
        reports::ComparisonPoint point;
        point.value.number = difference;
        point.reference_value.number = 0.0;
        point.u = 0.3;
        point.U.number = 0.6;
        point.reference_u = 0.4;
        point.reference_U.number = 0.8;
        point.En.number = difference;
        comparison.points.push_back(point);
    }
    comparison.reference_budget = {two_rows().results[0].budget[1]};
    comparison.method_budget = {two_rows().results[0].budget[0]};
    return record;
}

TEST(SubjectOfRecord, ReadsTheStatementsOfAReference) {
    const AuditSubject subject = subject_of(compared(), "record.json");
    ASSERT_EQ(subject.budgets.size(), 2U);
    EXPECT_EQ(subject.budgets[1].name, "indicator");
    EXPECT_EQ(subject.budgets[1].rows.at(0).origin, Origin::specification);
    const AuditReport report = audit(subject, all_rules());
    const auto mpe = std::find_if(report.findings.begin(), report.findings.end(),
                                  [](const AuditFinding& finding) { return finding.rule == "U10"; });
    ASSERT_NE(mpe, report.findings.end());
    ASSERT_TRUE(mpe->effect && mpe->effect->alone.en);
    EXPECT_NEAR(*mpe->effect->alone.en, 0.8 / std::hypot(0.6, 0.8 / std::sqrt(3.0)), 1e-9);
}

TEST(SubjectOfRecord, ComparesAtThePointThatIsAskedFor) {
    const AuditSubject largest = subject_of(compared(), "record.json");
    EXPECT_EQ(largest.budgets[0].reference->point, 1U);
    EXPECT_FALSE(largest.budgets[0].reference->largest_difference);
    EXPECT_NEAR(evaluate(largest.budgets[0]).en.value_or(0.0), 0.8, 1e-9);
    EXPECT_NEAR(evaluate(largest.budgets[1]).en.value_or(0.0), 0.8, 1e-9) << "of the reference: the same sign";
    const AuditSubject first = subject_of(compared(), "record.json", 0);
    EXPECT_EQ(first.budgets[0].value, -0.5);
    EXPECT_NEAR(evaluate(first.budgets[0]).en.value_or(0.0), 0.8, 1e-9) << "of the other point";
}

TEST(SubjectOfRecord, ComponentsAreRowsOfTheirOwn) {
    reports::EvaluationRecord record = two_rows();
    reports::BudgetRow& a = record.results[0].budget[0];
    a.components = {a, a};
    a.components[0].input = "first";
    a.components[1].input = "second";
    a.components[0].u.number = a.components[1].u.number = 0.3 / std::sqrt(2.0);
    const AuditSubject subject = subject_of(record, "record.json");
    ASSERT_EQ(subject.budgets.front().rows.size(), 3U);
    EXPECT_EQ(subject.budgets.front().rows[0].quantity, "a: first");
    EXPECT_NEAR(evaluate(subject.budgets.front()).u_c, 0.5, 1e-12);
}

}  // namespace
}  // namespace gumcert::audit
