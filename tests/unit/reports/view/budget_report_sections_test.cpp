#include "reports/view/budget_report_sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/forms/asset_files.h"
#include "reports/view/certificate_view.h"
#include "tests/support/sample_budget_record.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"
#include "tests/unit/reports/view_blocks.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Wording english_wording() {
    RenderAssets of_english = assets();
    of_english.languages = {"en"};
    return read_wording(of_english);
}

std::vector<std::string> annexes_of(const json& view) {
    std::vector<std::string> ids;
    for (const json& section : view["sections"]) {
        if (section["kind"] == "annex") {
            ids.push_back(section["id"]);
        }
    }
    return ids;
}

EvaluationRecord with_annexes(const std::string& extent) {
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->data.annexes = extent;
    return record;
}

TEST(Annexes, AreAsTheLaboratoryWantsThem) {
    const Wording wording = english_wording();
    const std::vector<std::string> full = annexes_of(certificate_view(with_annexes("full"), wording));
    EXPECT_EQ(annexes_of(certificate_view(with_annexes(""), wording)), full);
    EXPECT_THAT(full, Contains("monte_carlo"));
    EXPECT_THAT(full, Contains("uncertainty"));
    EXPECT_THAT(annexes_of(certificate_view(with_annexes("summary"), wording)),
                ::testing::ElementsAre("evaluation", "uncertainty"));
    EXPECT_THAT(annexes_of(certificate_view(with_annexes("none"), wording)), IsEmpty());
}

TEST(Annexes, WithoutThemNothingOfTheCertifiedPartIsMissing) {
    const Wording wording = english_wording();
    std::vector<json> before;
    const json full = certificate_view(with_annexes("full"), wording);
    for (const json& section : full["sections"]) {
        if (section["kind"] == "" && section["id"] != "statement_of_uncertainty") {
            before.push_back(section);
        }
    }
    std::vector<json> alone;
    const json bare = certificate_view(with_annexes("none"), wording);
    for (const json& section : bare["sections"]) {
        if (section["id"] == "statement_of_uncertainty") {
            EXPECT_THAT(section.dump(), HasSubstr("The record of the evaluation holds the budget."));
            EXPECT_THAT(section.dump(), Not(HasSubstr("annex")));
        } else {
            alone.push_back(section);
        }
    }
    EXPECT_EQ(alone, before);
}

TEST(BudgetReport, SaysThatItIsNoCertificateAndShowsEverything) {
    EvaluationRecord record = with_annexes("none");
    record.digest = std::string(64, 'd');
    record.inputs.emplace_back();
    record.inputs.back().name = "x_1";
    record.inputs.back().description = certificate::LocalisedText("What it is");
    record.job_files.push_back(input_file("readings.csv", "x,y\r\n1,2\n", true));
    record.job_files.push_back(input_file("lost.csv", "x\n", false));
    record.certificate->findings = {{.id = "T06",
                                     .clause = "ISO/IEC 17025:2017, 6.5",
                                     .severity = certificate::FindingSeverity::minor,
                                     .where = "/standards/0",
                                     .what = "no budget names it",
                                     .action = "Name it."}};
    const json view = budget_report_view(record, english_wording());
    EXPECT_TRUE(view["identity"].empty());
    ASSERT_EQ(view["mark"].size(), 1U);
    EXPECT_EQ(view["mark"][0]["text"], "INTERNAL — no calibration certificate");
    EXPECT_THAT(view["header_right"].get<std::string>(), HasSubstr("INTERNAL — no calibration certificate"));
    EXPECT_THAT(view["header_right"].get<std::string>(), HasSubstr(record.certificate->data.number));
    const std::string all = view.dump();
    for (const char* part : {"What it is", "no budget names it", "budget-0", "capability-of-values", "readings"}) {
        EXPECT_THAT(all, HasSubstr(part));
    }
    EXPECT_THAT(all, HasSubstr(record.digest));
    const json file = block(view, "table", "file-1");
    ASSERT_EQ(file["rows"].size(), 2U);
    EXPECT_EQ(file["rows"][1]["cells"][1]["text"], "1,2");
    EXPECT_TRUE(block(view, "table", "file-2").is_null());
}

TEST(BudgetReport, OfARecordWithoutCertificateDataHasItsResults) {
    const json view = budget_report_view(test::sample_budget_record(), english_wording());
    EXPECT_FALSE(block(view, "table", "results-0").is_null());
    EXPECT_TRUE(annexes_of(view).empty());
}

}  // namespace
}  // namespace gumcert::reports
