#include "audit/tables/stated_results.h"

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

TEST(StatedResults, AreNumbersOfTheResultOfCoverageOrWords) {
    for (const Statement of_result : {Statement::value, Statement::U, Statement::tolerance, Statement::reference_U}) {
        EXPECT_TRUE(is_of_result(of_result));
        EXPECT_FALSE(is_in_words(of_result));
    }
    for (const Statement number : {Statement::k, Statement::nu_eff, Statement::coverage_probability, Statement::en}) {
        EXPECT_FALSE(is_of_result(number));
        EXPECT_FALSE(may_be_part(number));
    }
    EXPECT_TRUE(is_of_coverage(Statement::nu_eff));
    EXPECT_FALSE(is_of_coverage(Statement::capability));
    EXPECT_TRUE(may_be_part(Statement::capability));
    EXPECT_FALSE(may_be_part(Statement::value));
    EXPECT_TRUE(is_in_words(Statement::verdict));
}

}  // namespace
}  // namespace gumcert::audit
