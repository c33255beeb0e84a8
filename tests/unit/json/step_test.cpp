#include "json/step.h"

#include <gtest/gtest.h>

namespace gumcert::json {
namespace {

TEST(Step, TellsThePointerOfTheWholeChain) {
    const Step document;
    EXPECT_EQ(document.pointer(), "");
    const Step list = document.child("a/b");
    const Step element = list.child(12);
    EXPECT_EQ(list.pointer(), "/a~1b");
    EXPECT_EQ(element.child("~").pointer(), "/a~1b/12/~0");
    EXPECT_EQ(document.child("").pointer(), "/") << "the empty key is a key (RFC 6901)";
}

}  // namespace
}  // namespace gumcert::json
