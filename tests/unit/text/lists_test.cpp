#include "text/lists.h"

#include <gtest/gtest.h>

#include <array>

namespace gumcert::text {
namespace {

TEST(Lists, NamesAreListedUpToAnEnd) {
    EXPECT_EQ(listed({}), "");
    EXPECT_EQ(listed({"a", "b", "c"}), "a, b, c");
    EXPECT_EQ(listed({"a", "b", "c", "d"}, 2), "a, b and 2 more");
    EXPECT_EQ(listed({"a", "b"}, 2), "a, b");
}

TEST(Lists, AllHaveAnAndBeforeTheLast) {
    EXPECT_EQ(all_of({"a"}), "a");
    EXPECT_EQ(all_of({"a", "b", "c"}), "a, b and c");
}

TEST(Lists, WordsToChooseFrom) {
    EXPECT_EQ(any_of(std::array<std::string_view, 1>{"csv"}), "csv");
    EXPECT_EQ(any_of(std::array<std::string_view, 3>{"csv", "npy", "none"}), "csv, npy or none");
}

TEST(Lists, NounsFollowTheirCount) {
    EXPECT_EQ(count_of(0, "point"), "0 points");
    EXPECT_EQ(count_of(1, "point"), "1 point");
    EXPECT_EQ(count_of(12, "point"), "12 points");
    EXPECT_EQ(count_of(0, "entry"), "0 entries");
    EXPECT_EQ(count_of(1, "entry"), "1 entry");
    EXPECT_EQ(count_of(2, "day"), "2 days");
}

}  // namespace
}  // namespace gumcert::text
