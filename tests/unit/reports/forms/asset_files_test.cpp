#include "reports/forms/asset_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/wording.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

class AssetFiles : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(file_); }

    /// What a file with this text is refused for.
    [[nodiscard]] std::string refusal(const std::string& text) const {
        std::ofstream(file_, std::ios::binary) << text;
        try {
            (void)read_json_asset(file_);
        } catch (const gum::StorageError& error) {
            return error.diagnostics().front().code + " " + gum::message(error.diagnostics().front());
        }
        return "accepted";
    }

    std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".json");
};

TEST_F(AssetFiles, AreReadAsObjects) {
    EXPECT_EQ(refusal("\xEF\xBB\xBF{\"language\": \"en\"}"), "accepted");
    EXPECT_EQ(read_json_asset(file_)["language"], "en");
}

// Pins: of two equal keys of a wording the last one won, and nobody was told.
TEST_F(AssetFiles, TellWhereTheyAreWrong) {
    EXPECT_THAT(refusal("{\"a\": \"x\",\n \"a\": \"y\"}"),
                testing::HasSubstr(file_.string() + " (line 2, column 2) — the key \"a\" occurs twice"));
    EXPECT_THAT(refusal("{\"a\": \"x\""), testing::HasSubstr("(line 1, column 10) — the file ends where a comma"));
    EXPECT_THAT(refusal("[]"), testing::HasSubstr("not a JSON object"));
    EXPECT_THAT(refusal("{} // a comment"), testing::StartsWith("GC-REPORT-0001"));
    EXPECT_THAT(refusal(""), testing::StartsWith("GC-REPORT-0002"));
}

/// The terms of a body stand in its language, in labels and in the sentences of the program, and nowhere else.
TEST(WordingOfARecord, HasTheTermsOfItsProfile) {
    EvaluationRecord record;
    record.certificate.emplace();
    record.certificate->data.languages = {"zh-Hant", "es"};
    const auto type_of = [&](std::size_t language) {
        return read_wording(assets(), record)("document", "type").in(language);
    };
    const std::string spanish = type_of(1);
    EXPECT_EQ(type_of(0), "校正證書");
    record.certificate->profile.terms = {{.language = "zh-Hant", .word = "校正證書", .term = "校正報告"}};
    EXPECT_EQ(type_of(0), "校正報告");
    EXPECT_EQ(type_of(1), spanish);
    const Wording wording = read_wording(assets(), record);
    for (const char* group : {"document", "certificate_status", "dcc"}) {
        EXPECT_EQ(wording.group(group).dump().find("校正證書"), std::string::npos) << group;
    }
    const std::string sentences = read_asset(assets().templates / "wording" / "sentences.json");
    ASSERT_NE(sentences.find("校正證書"), std::string::npos) << "a sentence with the word, for this test";
    EXPECT_EQ(wording.language(), "zh-Hant");
}

TEST(LanguagesOfAssets, AreTheBindingOneAlone) {
    RenderAssets asked = assets();
    asked.languages = {"de", "en"};
    EXPECT_EQ(in_one_language(asked).languages, std::vector<std::string>{"de"});
    asked.languages.clear();
    EXPECT_TRUE(in_one_language(asked).languages.empty());
}

}  // namespace
}  // namespace gumcert::reports
