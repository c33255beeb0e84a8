#include "reports/audit/audit_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sample_audit.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;

std::string pdf_of(const std::vector<audit::AuditReport>& reports, const std::string& language) {
    RenderAssets in = assets();
    in.languages = {language};
    return audit_as_pdf(make_audit_view(reports, test::sample_rules(), {.program = "gumcert 0.1.0"}), in);
}

TEST(AuditDocument, SaysTheSameAsThePage) {
    SKIP_WITHOUT_PDF();
    const std::vector<audit::AuditReport> reports = {test::sample_audit(), test::sample_audit_of_points()};
    const std::string pdf = pdf_of(reports, "en");
    EXPECT_TRUE(pdf.starts_with("%PDF-1.7"));
    EXPECT_EQ(pdf_of(reports, "en"), pdf);
    const std::string text = pdf_text(pdf);
    if (text.empty()) {
        GTEST_SKIP() << "pdftotext is missing: the texts of the PDF were not compared";
    }
    EXPECT_THAT(text, HasSubstr("Audit – not a calibration certificate"));
    EXPECT_THAT(text, HasSubstr("(+13.5 %): U understated; verdict pass"));
    EXPECT_THAT(text, HasSubstr("Questions to the laboratory"));
    EXPECT_THAT(text, HasSubstr("End of the audit"));
}

TEST(AuditDocument, ShowsHostileTextsAsTexts) {
    SKIP_WITHOUT_PDF();
    std::vector<audit::AuditReport> reports;
    for (const char* hostile : {"#panic(\"x\")", "$x^2$ *b* @ref <label>", "a\u202Eb\x1B[31m", "{{{style}}}"}) {
        reports.push_back(test::hostile_audit(hostile));
    }
    EXPECT_TRUE(pdf_of(reports, "de").starts_with("%PDF-1.7"));
}

}  // namespace
}  // namespace gumcert::reports
