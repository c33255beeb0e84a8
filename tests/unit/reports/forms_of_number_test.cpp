#include "reports/forms_of_number.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace gumcert::reports {
namespace {

std::string with_all(const std::string& pattern, bool one) {
    return with_forms_of(pattern, [&](const std::string&) { return one; });
}

TEST(FormsOfNumber, OneFormStandsForBoth) {
    const std::string pattern = "{count} of {all} {all?result|results} {count?differs|differ}";
    EXPECT_EQ(with_all(pattern, true), "{count} of {all} result differs");
    EXPECT_EQ(with_all(pattern, false), "{count} of {all} results differ");
    EXPECT_EQ(with_forms_of(pattern, [](const std::string& name) { return name == "count"; }),
              "{count} of {all} results differs");
    EXPECT_THAT(names_with_forms(pattern), testing::ElementsAre("all", "count"));
}

TEST(FormsOfNumber, AFormMayHoldThePlaceOfItsValue) {
    const std::string pattern = "ninguno {count?del único punto|de los # puntos}.";
    EXPECT_EQ(with_all(pattern, true), "ninguno del único punto.");
    EXPECT_EQ(with_all(pattern, false), "ninguno de los {count} puntos.");
}

TEST(FormsOfNumber, OtherBracesAndMarksStay) {
    for (const std::string pattern :
         {"|{name}| > 1?", "{{\"a\"?1|2}}", "{D}: a | b", "{a?b}", "{?a|b}", "{count:number}", "{"}) {
        EXPECT_EQ(with_all(pattern, true), pattern);
        EXPECT_TRUE(names_with_forms(pattern).empty()) << pattern;
    }
}

}  // namespace
}  // namespace gumcert::reports
