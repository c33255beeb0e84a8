#include "reports/printed_texts.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

TEST(PrintedTexts, AreCommonWhereAllAreTheSame) {
    EXPECT_EQ(common({"mm", "mm"}), "mm");
    EXPECT_EQ(common({"mm", "um"}), std::nullopt);
    EXPECT_EQ(common({}), std::nullopt);
    EXPECT_EQ(common({""}), "") << "an empty text is a text";
}

TEST(PrintedTexts, AreListedAndLookedFor) {
    EXPECT_EQ(joined({"a", "b", "c"}), "a, b, c");
    EXPECT_EQ(joined({}), "");
    EXPECT_TRUE(any_of({"", "a"}));
    EXPECT_FALSE(any_of({"", ""}));
    EXPECT_FALSE(any_of({}));
}

TEST(PrintedTexts, HaveTheirUnitBehindABlankThatDoesNotBreak) {
    EXPECT_EQ(with_unit("10.05", "mm").first(), "10.05\u00A0mm");
    EXPECT_EQ(with_unit("10.05", "").first(), "10.05");
    EXPECT_TRUE(with_unit("", "mm").empty()) << "no number, no unit";
    const Text both = with_unit(Text(std::vector<std::string>{"10.05", "10,05"}), "mm");
    EXPECT_EQ(both.in(1), "10,05\u00A0mm");
}

TEST(PrintedTexts, StateAProbabilityAsItWasStated) {
    EXPECT_EQ(percent_text(0.95), "95 %");
    EXPECT_EQ(percent_text(0.9545), "95.45 %");
    EXPECT_EQ(percent_text(0.99), "99 %");
    EXPECT_EQ(percent_text(0.9973), "99.73 %");
}

}  // namespace
}  // namespace gumcert::reports
