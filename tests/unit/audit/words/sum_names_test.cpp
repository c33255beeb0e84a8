#include "audit/words/sum_names.h"

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

TEST(SumNameOf, TellsSumsOfSquaresFromTheVarianceOfOneThing) {
    for (const char* const name : {"Sum of squares", "u_c²", "u²", "Variance", "Combined variance", "Sum of variances",
                                   "Variance of the result", "Sum of the variances of the components"}) {
        EXPECT_EQ(sum_name(name), SumName::of_squares) << name;
    }
    for (const char* const name : {"Variance of the standard", "Variance of the balance", "Varianz des Normals"}) {
        EXPECT_EQ(sum_name(name), SumName::none) << name;
    }
}

TEST(IsCalledPart, KnowsWordsThatSaySo) {
    EXPECT_TRUE(is_called_part("of which sensor"));
    EXPECT_TRUE(is_called_part("davon Fühler"));
    EXPECT_FALSE(is_called_part("Sensor"));
}

TEST(AreUAndU, AreTheSameButForTheirFirstLetter) {
    EXPECT_TRUE(are_u_and_U("u(f)", "U(f) (k = 2)"));
    EXPECT_TRUE(are_u_and_U("u_x", "U_x"));
    EXPECT_FALSE(are_u_and_U("u(f)", "U(g)"));
    EXPECT_FALSE(are_u_and_U("u(f)", "U(f) of the standard"));
    EXPECT_FALSE(are_u_and_U("u", "U"));
}

}  // namespace
}  // namespace gumcert::audit
