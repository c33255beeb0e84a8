#include "reports/view/document_kinds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "reports/forms/asset_files.h"
#include "reports/view/certificate_view.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_record.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

std::vector<std::string> sections_of_view(const EvaluationRecord& record, std::span<const DocumentKind> kinds) {
    std::vector<std::string> ids;
    RenderAssets english = assets();
    english.languages = {"en"};
    const nlohmann::json view = certificate_view(record, read_wording(english), kinds);
    for (const nlohmann::json& section : view["sections"]) {
        ids.push_back(section["id"]);
    }
    return ids;
}

TEST(DocumentKinds, ARecordHasTheRowOfItsWord) {
    EXPECT_EQ(document_kind(test::sample_record()).word, "rotary_table");
    EXPECT_EQ(document_kind(test::sample_budget_record()).word, "budget");
    EXPECT_FALSE(document_kind(test::sample_record()).is_report());
    EvaluationRecord comparison;
    comparison.kind = "comparison";
    comparison.comparison.emplace();
    EXPECT_TRUE(document_kind(comparison).is_report());
}

TEST(DocumentKinds, ARecordThatLacksWhatItsRowShowsIsShownByItsResults) {
    EvaluationRecord record = test::sample_record();
    record.rotary.reset();
    EXPECT_EQ(document_kind(record).word, "budget");
    record.kind = "comparison";
    record.comparison.reset();
    EXPECT_EQ(document_kind(record).word, "budget");
    EXPECT_NO_THROW((void)sections_of_view(record, document_kinds()));
}

TEST(DocumentKinds, ARowOfTheCallerAddsItsSections) {
    const Sections own = [](CertificateBuilder& builder, const Wording& /*words*/, const EvaluationRecord& /*r*/) {
        builder.section("own", "Own section");
        builder.paragraph("Own text.");
    };
    const std::array<DocumentKind, 1> kinds{{{.word = "budget", .evidence = own}}};
    const EvaluationRecord record = test::sample_budget_record();
    const std::vector<std::string> before = sections_of_view(record, document_kinds());
    std::vector<std::string> after = sections_of_view(record, kinds);
    const auto added = std::find(after.begin(), after.end(), "own");
    ASSERT_NE(added, after.end());
    after.erase(added);
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace gumcert::reports
