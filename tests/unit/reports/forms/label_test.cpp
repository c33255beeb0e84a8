#include "reports/forms/label.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/support/sample_budget_record.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;

TEST(Label, AsSvgHasEveryText) {
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->data.number = "EX & 42";
    const std::string svg = render_label_svg(record, assets());
    EXPECT_THAT(svg, HasSubstr("width=\"60mm\" height=\"30mm\""));
    EXPECT_THAT(svg, HasSubstr("Certificate: EX &amp; 42"));
    EXPECT_THAT(svg, HasSubstr(record.certificate->data.item.serial_number));
    EXPECT_THAT(svg, HasSubstr("<path fill=\"#000\""));
}

TEST(Label, AsPdfIsOnePageThatSaysTheSame) {
    SKIP_WITHOUT_PDF();
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->data.item.identification = std::string(60, 'W');  // drawn narrower, not cut off
    const std::string text = pdf_text(render_label_pdf(record, assets()));
    if (program("pdftotext").empty()) {
        GTEST_SKIP() << "pdftotext (poppler-utils) is not installed";
    }
    EXPECT_THAT(text, HasSubstr(record.certificate->data.number));
    EXPECT_THAT(text, HasSubstr(std::string(60, 'W')));
}

TEST(Label, NeedsACertificate) {
    EXPECT_THROW((void)render_label_svg(test::sample_budget_record(), assets()), gum::InputError);
    EXPECT_THROW((void)render_label_pdf(test::sample_budget_record(), assets()), gum::InputError);
}

}  // namespace
}  // namespace gumcert::reports
