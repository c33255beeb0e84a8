#include "reports/forms/label.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/pdf_page_texts.h"
#include "reports/forms/pdf_worker.h"
#include "reports/view/certificate_identity_sections.h"
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

/// Each page is held against its view after it was set: a template that changes a text, and be it to capitals, is refused.
TEST(Label, AsPdfCarriesTheMarkOfEveryStateInEveryLanguage) {
    SKIP_WITHOUT_PDF();
    EvaluationRecord issued = test::certified_budget_record();
    EvaluationRecord specimen = issued;
    specimen.certificate->data.status = "specimen";
    EvaluationRecord superseded = issued;
    superseded.certificate->superseded_by = "EX-2";
    const std::filesystem::path noto = "/usr/share/fonts/opentype/noto";
    for (const std::string language : {"en", "de", "es", "zh-Hant"}) {
        RenderAssets of_language = assets();
        of_language.languages = {language};
        if (language == "zh-Hant") {
            if (!std::filesystem::exists(noto)) {
                continue;
            }
            of_language.fonts = {noto};
        }
        PdfWorker worker(of_language);
        const Wording words = read_wording(of_language);
        for (const EvaluationRecord& record : {issued, test::drafted(issued), specimen, superseded}) {
            const std::string status = document_status(record);
            std::string pdf;
            EXPECT_NO_THROW(pdf = render_label_pdf(record, of_language, &worker)) << language << ", " << status;
            if (status != "issued" && !pdf.empty()) {
                std::string mark = words("certificate_status", status).first();
                std::erase(mark, ' ');
                EXPECT_THAT(texts_of_pages(pdf).at(0), HasSubstr(mark)) << language;
            }
        }
    }
}

TEST(Label, NeedsACertificate) {
    EXPECT_THROW((void)render_label_svg(test::sample_budget_record(), assets()), gum::InputError);
    EXPECT_THROW((void)render_label_pdf(test::sample_budget_record(), assets()), gum::InputError);
}

}  // namespace
}  // namespace gumcert::reports
