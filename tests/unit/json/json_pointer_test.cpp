#include "json/json_pointer.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace gumcert::json {
namespace {

// RFC 6901, section 5.
TEST(JsonPointer, FindsTheValuesOfTheStandard) {
    const nlohmann::json document = nlohmann::json::parse(
        R"({"foo": ["bar", "baz"], "": 0, "a/b": 1, "c%d": 2, "e^f": 3, "g|h": 4, "i\\j": 5, "k\"l": 6, " ": 7, "m~n": 8})");
    EXPECT_EQ(child_pointer("", "a/b"), "/a~1b");
    EXPECT_EQ(child_pointer("", "m~n"), "/m~0n");
    EXPECT_EQ(child_pointer(child_pointer("", "foo"), 1), "/foo/1");
    for (const auto& [key, value] : document.items()) {
        EXPECT_EQ(document.at(nlohmann::json::json_pointer(child_pointer("", key))), value) << key;
    }
}

TEST(JsonPointer, EscapesATokenOnce) {
    EXPECT_EQ(pointer_token("~1"), "~01");
    EXPECT_EQ(pointer_token("/~"), "~1~0");
    EXPECT_EQ(pointer_token(""), "");
}

TEST(JsonPointer, GoesUpByOneToken) {
    EXPECT_EQ(parent_pointer("/a~1b/0"), "/a~1b");
    EXPECT_EQ(parent_pointer("/a"), "");
    EXPECT_EQ(parent_pointer("/a/"), "/a");
    EXPECT_EQ(parent_pointer(""), "");
}

}  // namespace
}  // namespace gumcert::json
