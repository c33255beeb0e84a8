#include "text/plus_sign.h"

#include <gtest/gtest.h>

namespace gumcert::text {
namespace {

TEST(PlusSign, IsTakenFromANumberAndFromNothingElse) {
    EXPECT_EQ(without_plus("+3.1"), "3.1");
    EXPECT_EQ(without_plus("+.5"), ".5");
    for (const char* const text : {"", "+", "+-5", "++5", "-5", "5", "+inf", "+nan", "+ 5", "+\u22125"}) {
        EXPECT_EQ(without_plus(text), text);
    }
}

}  // namespace
}  // namespace gumcert::text
