#include "audit/sources/record_subject.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(SubjectOfRecord, WhatCorrelationsAddStaysAsItIs) {
    reports::EvaluationRecord record = two_rows();
    record.results[0].u = 0.6;
    record.results[0].reported.u = 0.6;
    record.results[0].U = record.results[0].reported.U = 1.2;
    const AuditSubject subject = subject_of(record, "record.json");
    EXPECT_NEAR(subject.budgets.front().correlation_variance, 0.36 - 0.25, 1e-12);
    EXPECT_NEAR(evaluate(subject.budgets.front()).u_c, 0.6, 1e-12);
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
