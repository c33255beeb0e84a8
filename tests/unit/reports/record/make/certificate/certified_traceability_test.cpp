#include "reports/record/make/certificate/certified_traceability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sample_certificate.h"

namespace gumcert::reports {
namespace {

using certificate::FindingSeverity;
using testing::IsEmpty;

/// One result with one input from a source, and the standards STD-017 and STD-018.
reports::EvaluationRecord record_with(const std::string& source) {
    reports::EvaluationRecord record;
    record.kind = "budget";
    reports::Result result;
    reports::BudgetRow row;
    row.input = "d";
    reports::BudgetRow part;
    part.source = source;
    part.unit = test::sample_standard().unit;
    part.u.number = 0.5 * test::sample_standard().U.value_or(0.0);
    row.components = {part};
    result.budget = {row};
    record.results = {result};
    record.certificate.emplace();
    certificate::StandardUsed other = test::sample_standard();
    other.name = "Comparator";
    other.identification = "STD-018";
    other.certificate = "CL-2026-0311";
    record.certificate->data.standards = {test::sample_standard(), other};
    return record;
}

TEST(TraceabilityFindings, WantTheStandardsInTheSourcesOfTheInputs) {
    EXPECT_THAT(traceability_findings(record_with("std 017 and CL-2026-0311")), IsEmpty());
    EXPECT_THAT(traceability_findings(record_with("Laser interferometer; comparator")), IsEmpty());
    for (const char* source : {"", "manual", "STD-01"}) {
        const auto findings = traceability_findings(record_with(source));
        ASSERT_EQ(findings.size(), 1U) << source;
        EXPECT_EQ(findings[0].id, "T06");
        EXPECT_EQ(findings[0].severity, FindingSeverity::major);
        EXPECT_EQ(findings[0].where, "/standards");
    }
    const auto one = traceability_findings(record_with("certificate NMI-2026-0117"));
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].severity, FindingSeverity::minor);
    EXPECT_EQ(one[0].where, "/standards/1");
}

TEST(TraceabilityFindings, HaveNothingToSayWithoutABudgetOrStandards) {
    reports::EvaluationRecord record = record_with("");
    record.kind = "rotary_table";
    EXPECT_THAT(traceability_findings(record), IsEmpty());
    record = record_with("");
    record.certificate->data.standards.clear();
    EXPECT_THAT(traceability_findings(record), IsEmpty());
    record = record_with("");
    record.certificate.reset();
    EXPECT_THAT(traceability_findings(record), IsEmpty());
}

}  // namespace
}  // namespace gumcert::reports
