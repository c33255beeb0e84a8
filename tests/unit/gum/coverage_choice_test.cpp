#include "gum/coverage_choice.h"

#include <gtest/gtest.h>

namespace gumcert::gum {
namespace {

TEST(CoverageChoice, HasOneWordEach) {
    EXPECT_EQ(coverage_choice_name(CoverageChoice::as_validated), "as_validated");
    EXPECT_EQ(coverage_choice_name(CoverageChoice::law_of_propagation), "law_of_propagation");
    EXPECT_EQ(coverage_choice_name(CoverageChoice::monte_carlo), "monte_carlo");
    EXPECT_EQ(k_coverage_choices.size(), 3U);
}

}  // namespace
}  // namespace gumcert::gum
