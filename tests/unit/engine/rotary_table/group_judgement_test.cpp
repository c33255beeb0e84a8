#include "engine/rotary_table/group_judgement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {
namespace {

/// With two degrees of freedom, for which it is exact.
double exponential_tail(double value, double /*degrees_of_freedom*/) {
    return std::exp(-0.5 * std::max(value, 0.0));
}

TEST(GroupJudgement, DividesTheShareOfAKindAmongItsTests) {
    const GroupTestOptions options{0.01, exponential_tail};
    const GroupJudgement judgement(options);
    for (const std::size_t count : {1U, 7U, 500U}) {
        const double level = 0.01 * share_of_level(GroupKind::reflector) / static_cast<double>(count);
        const double limit = -2.0 * std::log(level);
        const GroupTest below = judgement.judged(GroupKind::reflector, 0.999 * limit, 2, count);
        EXPECT_NEAR(below.critical_value, limit, 1e-9 * limit);
        EXPECT_FALSE(below.suspicious);
        EXPECT_EQ(below.family, count);
        const GroupTest above = judgement.judged(GroupKind::reflector, 1.001 * limit, 2, count);
        EXPECT_TRUE(above.suspicious);
        EXPECT_NEAR(above.p_value, std::exp(-0.5005 * limit), 1e-12);
        EXPECT_EQ(above.critical_value, below.critical_value);
    }
}

TEST(GroupJudgement, TakesRoundingForNothingAndRefusesWhatIsNoSumOfSquares) {
    const GroupTestOptions options{0.01, exponential_tail};
    const GroupJudgement judgement(options);
    EXPECT_EQ(judgement.judged(GroupKind::drift, -1e-4, 2, 1).chi_square, 0.0);
    EXPECT_THROW((void)judgement.judged(GroupKind::drift, -1.0, 2, 1), gum::NoResultError);
    EXPECT_THROW((void)judgement.judged(GroupKind::drift, std::numeric_limits<double>::quiet_NaN(), 2, 1),
                 gum::NoResultError);
}

TEST(GroupJudgement, ComparesMisfitsWhereBothProbabilitiesAreZero) {
    GroupTest a, b;
    a.p_value = 1e-9;
    b.p_value = 1e-8;
    EXPECT_TRUE(is_less_probable(a, b));
    EXPECT_FALSE(is_less_probable(b, a));
    a.p_value = b.p_value = 0.0;
    a.chi_square = 5000.0;
    b.chi_square = 5003.0;
    EXPECT_TRUE(is_less_probable(b, a));
    b.degrees_of_freedom = 3;  // four more than one degree of freedom stands for
    EXPECT_TRUE(is_less_probable(a, b));
}

}  // namespace
}  // namespace gumcert::engine
