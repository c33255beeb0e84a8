#include "gum/comparison/comparison_scheme.h"

#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;

TEST(ComparisonScheme, AStatedUBelongsToItsFactor) {
    const ResultUncertainty stated = stated_expanded(0.03, 2.5);
    EXPECT_DOUBLE_EQ(stated.u, 0.012);
    EXPECT_EQ(stated.U, 0.03);
    EXPECT_EQ(stated.k, 2.5);
    EXPECT_TRUE(stated.stated_as_expanded);
    EXPECT_EQ(code_of<InputError>([] { (void)stated_expanded(0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)stated_expanded(0.03, -2.0); }), "GC-GUM-0003");
}

TEST(ComparisonScheme, WordsAreInTheOrderOfTheEnumeration) {
    EXPECT_EQ(word_of(AssignedValueMethod::reference), "reference");
    EXPECT_EQ(word_of(AssignedValueMethod::algorithm_a), "algorithm_a");
    EXPECT_EQ(word_of(AssignedValueMethod::largest_consistent_subset), "largest_consistent_subset");
    EXPECT_EQ(word_of(AssignedValueMethod::power_moderated_mean), "power_moderated_mean");
}

TEST(ComparisonScheme, OneRoundWithoutNameUnlessStated) {
    EXPECT_EQ(ComparisonScheme{}.rounds, std::vector<std::string>{""});
}

}  // namespace
}  // namespace gumcert::gum
