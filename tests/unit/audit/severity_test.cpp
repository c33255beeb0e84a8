#include "audit/severity.h"

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

BudgetOutcome with_U(double U, const std::string& printed) {
    BudgetOutcome outcome;
    outcome.U = U;
    outcome.printed_U = outcome.rounded_U = printed;
    return outcome;
}
Effect effect_from(const BudgetOutcome& before, const BudgetOutcome& after) {
    return {.claimed = before, .alone = after, .last = before, .audited = after};
}

TEST(Severity, FollowsTheEffect) {
    const BudgetOutcome claimed = with_U(1.00, "1.0");
    EXPECT_EQ(severity_of(effect_from(claimed, with_U(1.10, "1.1"))), FindingSeverity::critical);
    EXPECT_EQ(severity_of(effect_from(claimed, with_U(1.09, "1.1"))), FindingSeverity::major);
    EXPECT_EQ(severity_of(effect_from(claimed, with_U(0.50, "0.50"))), FindingSeverity::major);
    EXPECT_EQ(severity_of(effect_from(claimed, with_U(1.01, "1.0"))), FindingSeverity::minor);
}

TEST(Severity, IsCriticalWhereADecisionTurns) {
    BudgetOutcome claimed = with_U(1.0, "1.0"), other = with_U(0.9, "0.90");
    claimed.verdict = "pass";
    other.verdict = "fail";
    EXPECT_EQ(severity_of(effect_from(claimed, other)), FindingSeverity::critical);
    other.verdict = "pass";
    claimed.en = 0.99;
    other.en = -1.01;
    EXPECT_EQ(severity_of(effect_from(claimed, other)), FindingSeverity::critical);
    other.en = -0.99;
    EXPECT_EQ(severity_of(effect_from(claimed, other)), FindingSeverity::major);
}

TEST(Severity, TakesTheGraverOfAloneAndLast) {
    const BudgetOutcome same = with_U(1.0, "1.0"), larger = with_U(1.3, "1.3");
    EXPECT_EQ(severity_of({.claimed = same, .alone = same, .last = same, .audited = larger}),
              FindingSeverity::critical);
    EXPECT_EQ(severity_of({.claimed = same, .alone = larger, .last = larger, .audited = larger}),
              FindingSeverity::critical);
}

TEST(Severity, CountsAPrintedValue) {
    BudgetOutcome claimed = with_U(1.0, "1.0"), other = with_U(1.0, "1.0");
    claimed.printed_value = "10.0";
    other.printed_value = "10.1";
    EXPECT_EQ(severity_of(effect_from(claimed, other)), FindingSeverity::major);
}

TEST(Severity, SaysTheDirectionInWords) {
    EXPECT_EQ(direction_in_words(with_U(1.0, "1.0"), with_U(1.2, "1.2")), "U understated");
    EXPECT_EQ(direction_in_words(with_U(1.0, "1.0"), with_U(0.8, "0.80")), "U overstated");
    EXPECT_EQ(direction_in_words(with_U(1.0, "1.0"), with_U(1.01, "1.0")), "U unchanged");
}

TEST(Severity, ComparesAClaimAtItsLastDigit) {
    // However a claim is written, the direction is that of the numbers.
    for (const char* const text : {"0.066", "0,066", "6.6E-2", "6,6E-2"}) {
        BudgetOutcome claimed = with_U(0.066, text);
        claimed.stated_step = 0.001;
        EXPECT_EQ(direction_in_words(claimed, with_U(0.0658, "0.066")), "U unchanged") << text;
        EXPECT_EQ(direction_in_words(claimed, with_U(0.0664, "0.066")), "U unchanged") << text;
        EXPECT_EQ(direction_in_words(claimed, with_U(0.0671, "0.067")), "U understated") << text;
        EXPECT_EQ(direction_in_words(claimed, with_U(0.0649, "0.065")), "U overstated") << text;
    }
    BudgetOutcome one_digit = with_U(0.06, "0.06");
    one_digit.stated_step = 0.01;
    EXPECT_EQ(direction_in_words(one_digit, with_U(0.0598, "0.060")), "U unchanged");
    EXPECT_EQ(direction_in_words(one_digit, with_U(0.0640, "0.064")), "U unchanged");
    EXPECT_EQ(direction_in_words(one_digit, with_U(0.0690, "0.069")), "U understated");
}

}  // namespace
}  // namespace gumcert::audit
