#include "reports/record/make/certificate/evaluation_findings.h"

#include <gtest/gtest.h>

#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

TEST(EvaluationFindings, AreThoseOfEveryKindWithoutACertificate) {
    EvaluationRecord record = test::sample_record();
    ASSERT_FALSE(record.certificate);
    const std::size_t before = evaluation_findings(record).size();
    record.rotary->adjustment.chi_square.number = 160.0;
    record.rotary->adjustment.p_value.number = 1.3e-4;
    record.rotary->adjustment.degrees_of_freedom = 100;
    const std::vector<certificate::Finding> found = evaluation_findings(record);
    ASSERT_EQ(found.size(), before + 1);
    EXPECT_EQ(found.back().id, "G01");
    EXPECT_EQ(found.back().severity, certificate::FindingSeverity::major);
    EXPECT_TRUE(evaluation_findings(EvaluationRecord()).empty());
}

}  // namespace
}  // namespace gumcert::reports
