#include "reports/message_register.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/support/file_content.h"

namespace gumcert::reports {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* k_register = R"({
  "language": "en",
  "finding": "About findings.",
  "outcomes": {"refused": {"severity": "error", "text": "Refused."}, "note": {"severity": "note", "text": "Told."}},
  "families": {"GC-ONE": {"title": "One", "text": "The first."}, "GC-TWO": {"title": "Two", "text": "The second."}},
  "codes": {
    "GC-ONE-0001": {"outcome": ["refused", "note"], "meaning": "M.", "cause": "C.", "remedy": "R.",
                    "rules": ["a", "b"], "finding": {"id": "A01", "severity": "major"}, "formerly": "F."},
    "GC-ONE-0002": {"outcome": ["refused"], "meaning": "N.", "cause": "D.", "remedy": "S."},
    "GC-ONE-0003": {"retired": "Was."},
    "GC-TWO-0001": {"outcome": ["note"], "meaning": "O.", "cause": "E.", "remedy": "T."}}})";

MessageRegister small() {
    return {k_register, "messages.json"};
}

gum::Diagnostic refusal(const std::string& text) {
    try {
        (void)MessageRegister(text, "messages.json");
    } catch (const gum::StorageError& error) {
        return error.diagnostics().front();
    }
    return {};
}

TEST(MessageRegister, HasWhatTheFileSays) {
    const MessageRegister all = small();
    const MessageEntry& entry = all.codes().at("GC-ONE-0001");
    EXPECT_THAT(entry.outcomes, ElementsAre("refused", "note"));
    EXPECT_EQ(entry.meaning + entry.cause + entry.remedy + entry.formerly, "M.C.R.F.");
    EXPECT_THAT(entry.rules, ElementsAre("a", "b"));
    EXPECT_EQ(entry.finding + " " + entry.finding_severity, "A01 major");
    EXPECT_EQ(entry.retired, "");
    EXPECT_EQ(all.codes().at("GC-ONE-0003").retired, "Was.");
    EXPECT_EQ(all.families().at("GC-TWO").title, "Two");
    EXPECT_EQ(all.outcomes().at("refused").severity, "error");
    EXPECT_EQ(all.text_on_findings(), "About findings.");
}

TEST(MessageRegister, ListsWhatIsInUse) {
    EXPECT_THAT(small().codes_of("GC-ONE"), ElementsAre("GC-ONE-0001", "GC-ONE-0002"));
    EXPECT_THAT(small().codes_of("GC-NONE"), ElementsAre());
    EXPECT_THAT(small().codes_of_finding("A01"), ElementsAre("GC-ONE-0001"));
    EXPECT_THAT(small().codes_of_finding("A02"), ElementsAre());
}

TEST(MessageRegister, ProposesTheNearest) {
    EXPECT_THAT(small().nearest("GC-ONE-0012", 2), ElementsAre("GC-ONE-0002", "GC-ONE-0001"));
    EXPECT_THAT(small().nearest("GC-TOW", 1), ElementsAre("GC-TWO"));
    EXPECT_EQ(small().nearest("", 100).size(), 6U);
}

TEST(MessageRegister, RefusesADamagedFile) {
    EXPECT_EQ(refusal("{").code, "GC-STORE-0011");
    EXPECT_EQ(refusal("{").where, "messages.json");
    const std::string whole = k_register;
    for (const char* key : {"\"finding\": \"About", "\"outcomes\"", "\"families\"", "\"codes\"", "\"meaning\": \"N.\"",
                            "\"severity\": \"note\"", "\"title\": \"One\"", "\"id\": \"A01\""}) {
        std::string text = whole;
        text.replace(text.find(key) + 1, 1, "_");
        EXPECT_EQ(refusal(text).code, "GC-STORE-0011") << key;
    }
    std::string text = whole;
    text.replace(text.find("[\"note\"]"), 8, "[\"lost\"]");
    EXPECT_THAT(refusal(text).what, HasSubstr("GC-TWO-0001 has the outcome \"lost\""));
    text = whole;
    text.replace(text.find("\"N.\""), 4, "17");
    EXPECT_EQ(refusal(text).code, "GC-STORE-0011");
}

TEST(MessageRegister, UnderstandsACodeAsItIsCopied) {
    for (const char* word :
         {"GC-RANK-0001", "[GC-RANK-0001]", "gc-rank-0001", "rank-0001", "(GC-Rank-0001).", "GC-RANK-0001:"}) {
        EXPECT_EQ(code_as_registered(word), "GC-RANK-0001") << word;
    }
    EXPECT_EQ(code_as_registered("rank"), "GC-RANK");
    EXPECT_EQ(code_as_registered(""), "");
    EXPECT_EQ(code_as_registered("[]"), "");
    EXPECT_EQ(family_of_code("GC-RANK-0001"), "GC-RANK");
    for (const char* word : {"GC-RANK", "GC-RANK-001", "GC-RANK-00011", "GC-RANK-000A", ""}) {
        EXPECT_EQ(family_of_code(word), "") << word;
    }
}

TEST(MessageRegister, TheOneOfTheTreeExplainsEveryCode) {
    const MessageRegister all(test::file_content(GUMCERT_SOURCE_DIR "/templates/messages.json"), "messages.json");
    EXPECT_GT(all.codes().size(), 600U);
    for (const auto& [code, entry] : all.codes()) {
        EXPECT_TRUE(!entry.retired.empty() || all.families().contains(family_of_code(code))) << code;
    }
    EXPECT_THAT(all.codes_of_finding("G04"), Contains("GC-GROUP-0001"));
    EXPECT_THAT(all.codes_of("GC-RANK"), ElementsAre("GC-RANK-0001", "GC-RANK-0002"));
}

}  // namespace
}  // namespace gumcert::reports
