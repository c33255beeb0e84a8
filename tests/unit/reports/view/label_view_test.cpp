#include "reports/view/label_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "reports/forms/asset_files.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

Wording wording_in(const std::string& language) {
    RenderAssets of_language = assets();
    of_language.languages = {language};
    return read_wording(of_language);
}

TEST(Label, WritesTheMonthAsAWord) {
    const auto in = [](const char* language, const char* date) { return date_in_words(date, wording_in(language)); };
    EXPECT_EQ(in("en", "2026-11-09"), "9 November 2026");
    EXPECT_EQ(in("de", "2026-03-21"), "21. März 2026");
    EXPECT_EQ(in("es", "2026-01-01"), "1 de enero de 2026");
    EXPECT_EQ(in("zh-Hant", "2026-12-31"), "2026年12月31日");
    EXPECT_EQ(in("en", ""), "");
}

TEST(Label, StatesRecalibrationOnlyWhereTheCustomerAgreed) {
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->data.recalibration_date = "2028-11-21";
    record.certificate->data.recalibration_agreement = "";
    EXPECT_EQ(label_view(record, wording_in("en")).dump().find("2028"), std::string::npos);
    record.certificate->data.recalibration_agreement = "Contract 88, 5";
    EXPECT_NE(label_view(record, wording_in("en")).dump().find("21 November 2028"), std::string::npos);
}

TEST(Label, OfADraftSaysSo) {
    EvaluationRecord record = test::certified_budget_record();
    EXPECT_TRUE(label_view(record, wording_in("en"))["mark"].empty());
    EXPECT_EQ(label_view(test::drafted(record), wording_in("en"))["mark"][0]["text"], "draft, not issued");
    record.certificate->superseded_by = "EX-2";
    EXPECT_EQ(label_view(record, wording_in("en"))["mark"][0]["text"], "superseded");
}

TEST(Label, NamesTheItemsOfSectionsOnce) {
    EvaluationRecord record = test::certified_budget_record();
    certificate::Certificate& c = *record.certificate;
    c.data.item = {};
    for (const char* name : {"A", "B", "C"}) {
        certificate::SectionData& section = c.data.sections.emplace_back();
        section.section = name;
        section.item.emplace().serial_number = *name == 'C' ? "SN-2" : "SN-1";
    }
    for (certificate::CertifiedTable& table : c.tables) {
        table.section = "A";
    }
    EXPECT_EQ(label_view(record, wording_in("en"))["rows"][0]["value"], "SN-1; SN-2");
}

TEST(Label, CodesTheNumberAndTheRecord) {
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->data.number = "EX-2026-0042";
    EXPECT_EQ(text_of_code(record), "EX-2026-0042");
    record.digest = "0af";
    EXPECT_EQ(text_of_code(record), "EX-2026-0042 SHA-256 0AF");
}

}  // namespace
}  // namespace gumcert::reports
