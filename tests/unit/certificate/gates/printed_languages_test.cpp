#include "certificate/gates/printed_languages.h"

#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

TEST(PrintedLanguages, ThatTheProfileDemandsCannotBeLeftOut) {
    Certificate c = passed_certificate();
    c.profile.required_languages = {"zh-Hant", "en"};
    c.data.languages = {"zh-Hant", "en"};
    pass_gates(c);
    const std::size_t before = c.findings.size();
    EXPECT_FALSE(judge_printed_languages(c, {}));
    ASSERT_FALSE(c.blocked);
    EXPECT_TRUE(judge_printed_languages(c, {"en"}));
    EXPECT_TRUE(c.blocked);
    EXPECT_FALSE(c.symbol);
    ASSERT_GT(c.findings.size(), before);
    expect_finding(c.findings.at(0), "R13", "profile " + c.profile.id, FindingSeverity::critical, "/languages");
}

TEST(PrintedLanguages, ThatATextLacksAreFindings) {
    Certificate c = passed_certificate();
    c.data.item.description.by_language = {{"en", "End gauge"}};
    c.data.item.description.plain.clear();
    c.data.languages = {"en"};
    pass_gates(c);
    const std::size_t before = c.findings.size();
    EXPECT_FALSE(judge_printed_languages(c, {"en"}));
    EXPECT_EQ(c.findings.size(), before);
    EXPECT_TRUE(judge_printed_languages(c, {"de"}));
    EXPECT_FALSE(c.blocked);
    ASSERT_GT(c.findings.size(), before);
    EXPECT_EQ(c.findings.back().id, "R17");
}

TEST(PrintedLanguages, OfASpecimenAreFree) {
    Certificate c = passed_certificate();
    c.profile.required_languages = {"zh-Hant"};
    c.data.status = "specimen";
    EXPECT_FALSE(judge_printed_languages(c, {"de"}));
    EXPECT_FALSE(c.blocked);
}

}  // namespace
}  // namespace gumcert::certificate
