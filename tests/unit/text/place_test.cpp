#include "text/place.h"

#include <gtest/gtest.h>

#include <string_view>

namespace gumcert::text {
namespace {

TEST(Place, CountsLinesAndCharacters) {
    constexpr std::string_view k_text = "aä€\nb\r\n😀c";
    PlaceFinder finder(k_text);
    EXPECT_EQ(finder.at(0), (Place{1, 1}));
    EXPECT_EQ(finder.at(3), (Place{1, 3})) << "ä has two bytes and is one character";
    EXPECT_EQ(finder.at(6), (Place{1, 4})) << "the line feed belongs to its line";
    EXPECT_EQ(finder.at(7), (Place{2, 1}));
    EXPECT_EQ(finder.at(k_text.size() - 1), (Place{3, 2}));
}

TEST(Place, GoesBackAndStaysInsideTheText) {
    PlaceFinder finder("a\nb");
    EXPECT_EQ(finder.at(1000), (Place{2, 2}));
    EXPECT_EQ(finder.at(1), (Place{1, 2}));
}

TEST(Place, IsToldInTwoForms) {
    EXPECT_EQ(line_and_column({3, 26}), "line 3, column 26");
    EXPECT_EQ(where_in_text("job.json", {3, 26}), "job.json:3:26");
    EXPECT_EQ(where_in_text("a\nb", {}), "a\\u{000A}b:1:1");
}

}  // namespace
}  // namespace gumcert::text
