#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

using test::found_by;
using test::sound_budget;
using test::subject_with;
using testing::HasSubstr;

certificate::StandardUsed standard_with(const std::string& identification, const std::string& certificate,
                                        const std::string& calibrated) {
    certificate::StandardUsed standard;
    standard.name.by_language = {{"en", "Gauge block 10 mm"}};
    standard.identification = identification;
    standard.certificate = certificate;
    standard.calibrated = calibrated;
    return standard;
}
AuditSubject subject_of_standards(std::vector<certificate::StandardUsed> standards, const std::string& source) {
    AuditedBudget budget = sound_budget();
    budget.rows[0].source = source;
    AuditSubject subject = test::subject_with_certificate({budget});
    subject.certificate->data.standards = std::move(standards);
    return subject;
}

TEST(TraceabilityRules, T06_reads_of_values_outside_of_the_range) {
    AuditedBudget budget = sound_budget();
    EXPECT_EQ(found_by(traceability_rules(), "T06", subject_with({budget})), "");
    budget.rows[0].comment = "extrapolated to 120 mm";
    EXPECT_THAT(found_by(traceability_rules(), "T06", subject_with({budget})), HasSubstr("calibrated range"));
}

TEST(TraceabilityRules, T07_compares_with_the_standard) {
    AuditedBudget budget = sound_budget();
    budget.rows[0].origin = Origin::certificate;
    budget.rows[0].origin_value = 0.8;
    budget.rows[0].certificate_k = 2.0;
    EXPECT_THAT(found_by(traceability_rules(), "T07", subject_with({budget})),
                HasSubstr("smaller than what the standard alone contributes, 0.4 µm"));
    AuditedBudget mean = budget;
    mean.rows[0].used_sensitivity = 0.25;
    EXPECT_EQ(found_by(traceability_rules(), "T07", subject_with({mean})), "");
    AuditedBudget correlated = budget;
    correlated.correlations = {{.first = 0, .second = 1, .r = -0.5}};
    EXPECT_EQ(found_by(traceability_rules(), "T07", subject_with({correlated})), "");
    // A correlation that the job of an evaluated budget states, or trials, make u_c smaller than the row that is in the sum.
    AuditedBudget evaluated = budget;
    evaluated.evaluated_here = true;
    EXPECT_NE(found_by(traceability_rules(), "T07", subject_with({evaluated})), "")
        << "the row has less than the certificate";
    evaluated.rows[0].used_u = 0.4;
    evaluated.correlation_variance = -0.1;
    EXPECT_EQ(found_by(traceability_rules(), "T07", subject_with({evaluated})), "");
}

TEST(TraceabilityRules, T08_finds_the_older_of_two_certificates) {
    const std::vector<certificate::StandardUsed> standards{standard_with("EX-1", "K-2023-7", "2023-05-01"),
                                                           standard_with("EX-1", "K-2025-9", "2025-05-01")};
    EXPECT_THAT(found_by(traceability_rules(), "T08", subject_of_standards(standards, "EX-1, K-2023-7")),
                HasSubstr("a later one, K-2025-9"));
    EXPECT_EQ(found_by(traceability_rules(), "T08", subject_of_standards(standards, "EX-1, K-2025-9")), "");
}

TEST(TraceabilityRules, T11_asks_which_piece_is_meant) {
    EXPECT_THAT(
        found_by(traceability_rules(), "T11",
                 subject_of_standards(
                     {standard_with("EX-1", "K-7", "2025-05-01"), standard_with("EX-1", "K-9", "2025-05-01")}, "")),
        HasSubstr("two standards have the identification EX-1"));
    const std::vector<certificate::StandardUsed> twins{standard_with("EX-1", "K-7", "2025-05-01"),
                                                       standard_with("EX-2", "K-9", "2025-05-01")};
    EXPECT_THAT(found_by(traceability_rules(), "T11", subject_of_standards(twins, "Gauge block 10 mm")),
                HasSubstr("that of two standards, EX-1 and EX-2"));
    EXPECT_EQ(found_by(traceability_rules(), "T11", subject_of_standards(twins, "Gauge block 10 mm, EX-2")), "");
}

TEST(TraceabilityRules, T12_asks_for_the_distance_to_the_nearest_point) {
    AuditedBudget budget = sound_budget();
    EXPECT_EQ(found_by(traceability_rules(), "T12", subject_with({budget})), "");
    budget.rows[0].comment = "value of the nearest point, 20 mm";
    EXPECT_THAT(found_by(traceability_rules(), "T12", subject_with({budget})), HasSubstr("nearest calibrated point"));
    budget.rows.push_back(test::audited_row("interpolation", 0.02, Contributor::fit));
    EXPECT_EQ(found_by(traceability_rules(), "T12", subject_with({budget})), "");
}

}  // namespace
}  // namespace gumcert::audit
