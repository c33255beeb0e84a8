#include "text/split.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::text {
namespace {

using Parts = std::vector<std::string>;

TEST(Split, KeepsEveryPart) {
    EXPECT_EQ(split("html,pdf", ','), (Parts{"html", "pdf"}));
    EXPECT_EQ(split("one", ','), Parts{"one"});
    EXPECT_EQ(split("", ','), Parts{""});
    EXPECT_EQ(split("/a//b/", '/'), (Parts{"", "a", "", "b", ""}));
}

}  // namespace
}  // namespace gumcert::text
