#include "certificate/statement_of_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include <optional>
#include <string>

namespace gumcert::certificate {
namespace {

std::string stated(double value, double U, std::optional<double> capability = {}, const PrintRule& rule = {}) {
    const StatedPair pair = state_uncertainty(value, U, capability, rule);
    return pair.value + " ± " + pair.U;
}

// Golden vector 5 of the design (independent program), two digits, half-even.
TEST(StatementOfUncertainty, GivesTheGoldenVector) {
    EXPECT_EQ(stated(693.1, 11.8), "693 ± 12");
    EXPECT_EQ(stated(0.99626791663, 0.5), "1.00 ± 0.50");
    EXPECT_EQ(stated(0.99626791663, 0.1), "1.00 ± 0.10");
    EXPECT_EQ(stated(10.05762, 0.027), "10.058 ± 0.027");
    EXPECT_EQ(stated(100.02147, 0.0996), "100.02 ± 0.10");
    EXPECT_EQ(stated(1234.567, 99.6), "1.23E+3 ± 1.0E+2");
    EXPECT_EQ(stated(12.345, 0.00999), "12.345 ± 0.010");
    EXPECT_EQ(stated(-0.0004, 0.0123), "0.000 ± 0.012");
    EXPECT_EQ(stated(299792.458, 1450.0), "2.998E+5 ± 1.4E+3");
    EXPECT_EQ(stated(299792.458, 1450.0, {}, {.digits = 2, .rounding = gum::RoundingMode::up}), "2.998E+5 ± 1.5E+3");
    EXPECT_EQ(stated(299792.458, 1450.0, 1450.0), "2.998E+5 ± 1.5E+3");
}

TEST(StatementOfUncertainty, HoldsTheFloorAfterRounding) {
    EXPECT_EQ(stated(693.1, 11.8, 12.0), "693 ± 12");  // printed U is not below: nothing is raised
    EXPECT_FALSE(state_uncertainty(693.1, 11.8, 12.0, {}).raised);
    EXPECT_EQ(stated(693.1, 11.4, 12.0), "693 ± 12");  // would print 11
    EXPECT_TRUE(state_uncertainty(693.1, 11.4, 12.0, {}).raised);
    EXPECT_EQ(stated(693.1, 0.5, 12.0), "693 ± 12");  // the value follows the place of the capability
    EXPECT_EQ(stated(12.3456, 0.0994, 0.1), "12.35 ± 0.10");
    EXPECT_EQ(stated(12.3456, 0.2, 0.1), "12.35 ± 0.20");
    EXPECT_FALSE(state_uncertainty(12.3456, 0.2, 0.1, {}).raised);
}

TEST(StatementOfUncertainty, NeverPrintsLessThanTheCapability) {
    EXPECT_EQ(stated(10.0, 0.3, 0.5572), "10.00 ± 0.56");
    EXPECT_EQ(stated(10.0, 0.3, 0.5512), "10.00 ± 0.56");  // half-even would print 0.55
    // U is not below, its rounding is: it goes upwards, and is not the capability.
    const StatedPair pair = state_uncertainty(10.0, 0.5519, 0.5512, {});
    EXPECT_EQ(pair.U, "0.56");
    EXPECT_FALSE(pair.raised);
    EXPECT_FALSE(pair.below);
}

TEST(StatementOfUncertainty, TakesNoiseOfAConversionForNothing) {
    EXPECT_EQ(stated(1.0, 0.30000000000000004, 0.30000000000000004), "1.00 ± 0.30");
    EXPECT_EQ(stated(1.0, 0.3, 0.1 + 0.2), "1.00 ± 0.30");
    EXPECT_FALSE(state_uncertainty(1.0, 0.3, 0.1 + 0.2, {}).raised);
}

TEST(StatementOfUncertainty, KeepsTwoDigitsOfACapabilityWhereUHasOne) {
    const PrintRule one{.digits = 1, .rounding = gum::RoundingMode::half_even};
    EXPECT_EQ(stated(5.678, 0.11, 0.12, one), "5.68 ± 0.12");
    EXPECT_EQ(stated(5.678, 0.3, 0.12, one), "5.7 ± 0.3");
    EXPECT_EQ(stated(5.678, 0.14, 0.12, one), "5.7 ± 0.2");  // 0.1 would be below
}

// EA-4/02 M:2022: rounding may not make U smaller by more than 5 %. With two digits it cannot (10.5 gives 10: 4.8 %).
TEST(StatementOfUncertainty, RoundsUpwardsWhereOneDigitWouldTakeMuchAway) {
    const PrintRule one{.digits = 1, .rounding = gum::RoundingMode::half_even};
    EXPECT_EQ(stated(5.678, 0.14, {}, one), "5.7 ± 0.2");
    EXPECT_EQ(stated(5.678, 0.0106, {}, one), "5.68 ± 0.02");
    EXPECT_EQ(stated(5.678, 0.0105, {}, one), "5.68 ± 0.01");  // 4.8 %
    EXPECT_EQ(stated(5.678, 0.96, {}, one), "6 ± 1");
    EXPECT_EQ(stated(5.678, 0.105), "5.68 ± 0.10");
    // The capability is held against the rounding that was asked for: 1.6 is stated, not 1.1 rounded upwards.
    EXPECT_EQ(stated(5.678, 1.1, 1.6, one), "5.7 ± 1.6");
    EXPECT_TRUE(state_uncertainty(5.678, 1.1, 1.6, one).raised);
}

TEST(StatementOfUncertainty, SaysThatUIsBelowWhereItIsNotRaised) {
    const StatedPair pair = state_uncertainty(693.1, 11.4, 12.0, {}, false);
    EXPECT_EQ(pair.U, "11");
    EXPECT_EQ(pair.value, "693");
    EXPECT_TRUE(pair.below);
    EXPECT_FALSE(pair.raised);
    EXPECT_FALSE(state_uncertainty(693.1, 11.8, 12.0, {}, false).below);
    EXPECT_EQ(state_uncertainty(299792.458, 1450.0, 1450.0, {}, false).U, "1.5E+3");
}

TEST(StatementOfUncertainty, RaisesAnUncertaintyOfZero) {
    EXPECT_EQ(stated(5.0, 0.0, 0.12), "5.00 ± 0.12");
    EXPECT_TRUE(state_uncertainty(5.0, 0.0, 0.12, {}, false).below);
}

TEST(StatementOfUncertainty, PrintsCoverageFactorAndDegreesOfFreedom) {
    EXPECT_EQ(printed_coverage_factor(2.0), "2.00");
    EXPECT_EQ(printed_coverage_factor(13.968), "13.97");
    EXPECT_EQ(printed_degrees_of_freedom(std::nullopt), "∞");
    EXPECT_EQ(printed_degrees_of_freedom(16.75), "16.8");
    EXPECT_EQ(printed_degrees_of_freedom(4.0), "4");
    EXPECT_EQ(printed_degrees_of_freedom(412.7), "412");
    EXPECT_EQ(printed_degrees_of_freedom(12000.0), ">9999");
}

TEST(StatementOfUncertainty, PrintsRisksInPercent) {
    EXPECT_EQ(printed_probability(0.02275), "2.3");
    EXPECT_EQ(printed_probability(0.5), "50");
    EXPECT_EQ(printed_probability(1.0e-9), "<0.01");
    EXPECT_EQ(printed_probability(0.0), "<0.01");
    EXPECT_EQ(printed_probability(0.977250), "97.7");
    EXPECT_EQ(printed_probability(0.99865), "99.86");
    EXPECT_EQ(printed_probability(1.0 - 1e-9), ">99.99");
    EXPECT_EQ(printed_probability(1.0), ">99.99");
    EXPECT_EQ(printed_probability(0.30), "30");
    EXPECT_EQ(printed_probability(0.0123), "1.2");
    EXPECT_EQ(printed_probability(0.995), "99.50");  // two digits of it would be 1.0E+2
    EXPECT_EQ(printed_probability(0.9996), "99.960");
}

TEST(StatementOfUncertainty, PrintsAcceptanceLimitsToTheSafeSide) {
    EXPECT_EQ(printed_at_most(9.97759, 3), "9.977");
    EXPECT_EQ(printed_at_least(9.97711, 3), "9.978");
    EXPECT_EQ(printed_at_most(-9.97711, 3), "-9.978");
    EXPECT_EQ(printed_at_least(-9.97759, 3), "-9.977");
    EXPECT_EQ(printed_at_most(9.978, 3), "9.978");
    EXPECT_EQ(printed_at_most(0.3 - 0.1, 1), "0.2");  // 0.19999999999999998
    EXPECT_EQ(printed_at_least(0.1 + 0.2, 1), "0.3");
    EXPECT_EQ(printed_at_least(0.0, 2), "0.00");
    EXPECT_EQ(printed_at_most(-0.0, 2), "0.00");
    EXPECT_EQ(printed_at_most(49999933.4, 0), "49999933");
    // Far more decimals than the number has: its noise is that of a negative number, too.
    EXPECT_EQ(printed_at_most(-1234567.125, 9), "-1234567.125000000");
    EXPECT_EQ(printed_at_least(1234567.125, 9), "1234567.125000000");
    EXPECT_EQ(printed_at_least(1401.0, -2), "1.5E+3");
    EXPECT_EQ(printed_at_most(0.999999, 2), "0.99");
}

TEST(StatementOfUncertainty, ReadsItsOwnTexts) {
    EXPECT_EQ(decimals_of("1.23"), 2);
    EXPECT_EQ(decimals_of("50"), 0);
    EXPECT_EQ(decimals_of("1.2E+3"), -2);
    EXPECT_EQ(decimals_of("1.2E-5"), 6);
    EXPECT_EQ(number_of("-1.2E+3"), -1200.0);
    EXPECT_EQ(number_of("<0.01"), std::nullopt);
    EXPECT_EQ(significant_digits("0.010"), 2);
    EXPECT_EQ(significant_digits("1.0E+2"), 2);
    EXPECT_EQ(significant_digits("12"), 2);
}

TEST(StatementOfUncertainty, PrintsLimitsAsStated) {
    EXPECT_EQ(printed_limit(10.0, 2), "10.00");
    EXPECT_EQ(printed_limit(10.125, 2), "10.125");
    EXPECT_EQ(printed_limit(0.1 + 0.2, 0), "0.3");
    EXPECT_EQ(printed_limit(-10.0, 0), "-10");
    EXPECT_EQ(printed_limit(50001000.0, 0), "50001000");
    EXPECT_EQ(printed_limit(1.3e-6, 0), "0.0000013");
    EXPECT_EQ(printed_limit(1.45e9, 0), "1450000000");
    EXPECT_EQ(printed_limit(0.0, 0), "0");
    EXPECT_EQ(printed_limit(0.0, 2), "0.00");
}

TEST(StatementOfUncertainty, PrintsACapabilityAsTheScopeDoes) {
    EXPECT_EQ(printed_capability(1450.0), "1450");
    EXPECT_EQ(printed_capability(0.2), "0.2");
    EXPECT_EQ(printed_capability(1.3e-6), "0.0000013");
    EXPECT_EQ(printed_capability(0.5512345), "0.5512");
    EXPECT_EQ(printed_capability(55.9017), "55.9");
    EXPECT_EQ(printed_capability(0.30000006), "0.30");
    EXPECT_EQ(printed_capability(123456.0), "1.235E+5");
}

/// A capability of two digits that was computed with an argument as it was measured: 0.1 + 0.002·m at 100.00003 g.
TEST(StatementOfUncertainty, TheScatterOfAnArgumentRaisesNoCapability) {
    for (int digits = 10; digits < 100; ++digits) {
        for (const int exponent : {-9, -3, -2, 0, 2}) {
            const double stated = digits * std::pow(10.0, exponent);
            const std::string as_it_is = gum::round_to_uncertainty(0.0, stated, 2).U;
            for (const double scatter : {-1e-5, -3e-7, -1e-9, 1e-9, 3e-7, 1e-5}) {
                const double computed = stated * (1.0 + scatter);
                SCOPED_TRACE(computed);
                const StatedPair raised = state_uncertainty(0.0, 0.5 * stated, computed, {});
                EXPECT_EQ(raised.U, as_it_is);
                EXPECT_TRUE(raised.raised);
                EXPECT_FALSE(is_below_capability(as_it_is, computed));
                EXPECT_EQ(number_of(printed_capability(computed)), number_of(as_it_is));
                EXPECT_TRUE(states_capability(0.5 * stated, as_it_is, computed));
                EXPECT_EQ(state_uncertainty(0.0, stated, computed, {}).U, as_it_is);
            }
            // More than that is a capability of its own, and never understated.
            const double larger = stated * 1.0020001;
            EXPECT_TRUE(is_below_capability(as_it_is, larger));
            EXPECT_GE(number_of(state_uncertainty(0.0, 0.5 * stated, larger, {}).U), larger);
        }
    }
}

TEST(StatementOfUncertainty, ANumberOfTheScopeIsHeldAsItIs) {
    EXPECT_TRUE(is_below_capability("0.12", 0.1201));
    EXPECT_FALSE(is_below_capability("0.12", 0.12));
    EXPECT_FALSE(is_below_capability("0.30", 0.1 + 0.2));
    EXPECT_FALSE(states_capability(0.12, "0.12", 0.12));
    EXPECT_FALSE(states_capability(0.1778, "0.18", 0.2));
    EXPECT_TRUE(states_capability(0.1778, "0.2", 0.2));
    EXPECT_FALSE(states_capability(0.1778, "0.2", {}));
}

TEST(CoverageProbability, IsNeverPrintedAsAHundred) {
    EXPECT_EQ(printed_coverage_probability(0.9545), "95.45");
    EXPECT_EQ(printed_coverage_probability(0.95), "95.00");
    EXPECT_EQ(printed_coverage_probability(0.9973), "99.73");
    EXPECT_EQ(printed_coverage_probability(0.99999), "99.999");
    for (double outside = 0.5; outside > 1e-9; outside *= 0.83) {
        const std::string text = printed_coverage_probability(1.0 - outside);
        const double read = 1.0 - *number_of(text) / 100.0;
        EXPECT_NEAR(read / outside, 1.0, 0.06) << text << ", 1 - p = " << outside;
    }
}

}  // namespace
}  // namespace gumcert::certificate
