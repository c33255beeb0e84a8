#include "reports/record/record_rules.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace gumcert::reports {
namespace {

using certificate::NumberRule;

TEST(RecordRules, AllowWhatTheirWordsSay) {
    const struct {
        NumberRule rule;
        const char* text;
        double allowed, refused;
    } cases[] = {{NumberRule::not_negative, "must be 0 or greater", 0.0, -1e-300},
                 {NumberRule::positive, "must be greater than 0", 1e-300, 0.0},
                 {NumberRule::probability, "must lie between 0 and 1", 1.0, 1.0000001},
                 {NumberRule::at_least_one, "must be 1 or greater", 1.0, 0.999},
                 {NumberRule::one_or_two, "must be 1 or 2", 2.0, 1.5}};
    for (const auto& one : cases) {
        EXPECT_STREQ(text_of_rule(one.rule), one.text);
        EXPECT_TRUE(is_allowed(one.allowed, one.rule)) << one.text;
        EXPECT_FALSE(is_allowed(one.refused, one.rule)) << one.text;
        EXPECT_FALSE(is_allowed(std::numeric_limits<double>::quiet_NaN(), one.rule)) << one.text;
    }
    EXPECT_TRUE(is_allowed(-1.0, NumberRule::any));
}

TEST(RecordRules, ShowANumberAsARecordHasIt) {
    EXPECT_EQ(record_number(0.1), "0.1");
    EXPECT_EQ(record_number(-2.5), "-2.5");
    EXPECT_EQ(record_number(std::numeric_limits<double>::quiet_NaN()), "NaN");
    EXPECT_EQ(record_number(-std::numeric_limits<double>::infinity()), "infinity");
}

}  // namespace
}  // namespace gumcert::reports
