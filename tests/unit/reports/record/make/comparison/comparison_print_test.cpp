#include "reports/record/make/comparison/comparison_print.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "gum/comparison/agreement.h"
#include "gum/comparison/scores.h"

namespace gumcert::reports {
namespace {

TEST(ComparisonPrint, ValueAndUncertaintyEndAtTheSamePlaceInTheSameNotation) {
    EXPECT_EQ(printed_value(1e-9, 4.4e-11), "0.000000001000");
    EXPECT_EQ(printed_uncertainty(4.4e-11), "0.000000000044");
    EXPECT_EQ(printed_value(12.26967, 0.12649), "12.27");
    EXPECT_EQ(printed_uncertainty(0.12649), "0.13");
    EXPECT_EQ(printed_value(12345.0, 240.0), "1.234E+4");
    EXPECT_EQ(printed_uncertainty(240.0), "2.4E+2");
}

TEST(ComparisonPrint, WithoutUncertainty) {
    EXPECT_EQ(printed_value(-0.0, std::nullopt), "0");
    EXPECT_EQ(printed_value(24.9, 0.0), "24.9");
    EXPECT_EQ(printed_uncertainty(0.0), "0");
    EXPECT_EQ(printed_uncertainty(std::nullopt), "");
}

/// The law: the printed score calls for what the score calls for.
TEST(ComparisonPrint, AScoreIsPrintedOnItsSideOfTheLimits) {
    EXPECT_EQ(printed_en(1.0), "1.00");
    EXPECT_EQ(printed_en(0.996), "1.00") << "no signal, as 1.00 has none";
    EXPECT_EQ(printed_en(1.0004), "1.0004");
    EXPECT_EQ(printed_en(-1.0049), "-1.005");
    EXPECT_EQ(printed_z(2.995), "2.995");
    EXPECT_EQ(printed_z(3.0), "3.00");
    EXPECT_EQ(printed_z(2.004), "2.004");
    EXPECT_EQ(printed_z(-1.996), "-2.00");
    EXPECT_EQ(printed_share_of_allowed(100.003), "100.003");
    EXPECT_EQ(printed_en(std::nullopt), "");
    std::mt19937_64 engine(9);
    for (int i = 0; i < 20000; ++i) {
        const double limit = std::array{1.0, 2.0, 3.0}[static_cast<std::size_t>(i) % 3];
        const double distance = std::pow(10.0, -15.0 * static_cast<double>(engine() >> 11U) * 0x1p-53);
        const double score = (engine() % 2U == 0 ? 1.0 : -1.0) * (limit + (engine() % 2U == 0 ? distance : -distance));
        EXPECT_EQ(gum::signal_of_z(std::stod(printed_z(score))), gum::signal_of_z(score)) << printed_z(score);
        EXPECT_EQ(gum::signal_of_en(std::stod(printed_en(score))), gum::signal_of_en(score)) << printed_en(score);
        EXPECT_EQ(std::stod(printed_share_of_allowed(100.0 * score)) > 100.0, 100.0 * score > 100.0);
    }
}

/// "p = 0.050, below 0.05" was printed of 0.0498.
TEST(ComparisonPrint, AProbabilityIsPrintedOnItsSideOfTheLimits) {
    EXPECT_EQ(printed_probability(0.0498), "0.0498");
    EXPECT_EQ(printed_probability(0.0499), "0.0499");
    EXPECT_EQ(printed_probability(0.02499), "0.02499");
    EXPECT_EQ(printed_probability(0.0102), "0.0102");
    EXPECT_EQ(printed_probability(0.80013), "0.80");
    EXPECT_EQ(printed_probability_beside(0.09996, 0.1), "0.09996");
    EXPECT_EQ(printed_probability_beside(1e-310, 0.1), "<1E-300");
    EXPECT_EQ(printed_probability(std::nullopt), "");
}

/// p_high of one of three directions was printed as 0.02495, and its limit is 0.0084; 0.01251 and 0.01289 of two were both
/// 0.013, on both sides of 0.01258.
TEST(ComparisonPrint, AProbabilityOfADirectionIsPrintedOnItsSideOfTheLimitOfAllOfThem) {
    EXPECT_EQ(printed_limit_in_family(0.025, 3), "0.00840");
    EXPECT_EQ(printed_probability_in_family(0.02495, 0.025, 3), "0.025");
    EXPECT_EQ(printed_probability_in_family(0.02495, 0.025, 1), "0.02495");
    EXPECT_EQ(printed_probability_in_family(0.01251, 0.025, 2), "0.0125");
    EXPECT_EQ(printed_probability_in_family(0.01289, 0.025, 2), "0.013");
    EXPECT_EQ(printed_probability_in_family(1e-310, 0.025, 2), "<1E-300");
    EXPECT_EQ(printed_probability_in_family(std::nullopt, 0.025, 2), "");
    for (const std::size_t family : {2U, 3U, 7U}) {
        for (const double chance : {gum::k_chance_of_size, gum::k_chance_of_bias_and_pattern}) {
            const double limit = gum::chance_in_family(chance, family);
            const double printed_limit = std::stod(printed_limit_in_family(chance, family));
            for (int i = -300; i <= 300; ++i) {
                const double p = limit * (1.0 + 1e-4 * (i + 0.5));  // none is the limit itself
                const double printed = std::stod(printed_probability_in_family(p, chance, family));
                EXPECT_EQ(printed < limit, p < limit) << p;
                EXPECT_EQ(printed < printed_limit, p < printed_limit) << p;
            }
        }
    }
}

TEST(ComparisonPrint, AnglesATurnApart) {
    for (const auto& [unit, turn] :
         {std::pair<const char*, double>{"deg", 360.0}, {"arcsec", 1296000.0}, {"rad", 6.2831853}}) {
        const gum::Unit angle = gum::Unit::parse(unit);
        EXPECT_TRUE(is_turn_apart(0.001, turn - 0.001, angle)) << unit;
        EXPECT_TRUE(is_turn_apart(2.0 * turn, 0.0, angle)) << unit;
        EXPECT_FALSE(is_turn_apart(0.0, 0.5 * turn, angle)) << unit;
        EXPECT_FALSE(is_turn_apart(-0.001, 0.002, angle)) << unit;
    }
    EXPECT_FALSE(is_turn_apart(0.0, 1e6, gum::Unit::parse("mm")));
    EXPECT_FALSE(is_turn_apart(0.0, 1e6, gum::Unit::parse("1")));
    EXPECT_FALSE(is_turn_apart(0.0, 1e6, gum::Unit::parse("deg/s")));
}

TEST(ComparisonPrint, AValueBetweenTwoDoubles) {
    EXPECT_EQ(printed_value(473612353604000.0, 0.0225, 0.13), "473612353604000.02");
    EXPECT_EQ(printed_value(-473612353604000.0, -0.0225, 0.13), "-473612353604000.02");
    EXPECT_EQ(printed_value(473612353604000.0, -0.0225, 0.13), "473612353603999.98");
    EXPECT_EQ(printed_value(99999999999999.984375, 0.0125, 0.13), "100000000000000.00");
    EXPECT_EQ(printed_value(473612353604000.0, 0.0225, 13.0), "473612353604000");
    EXPECT_EQ(printed_value(10.25, 1e-17, 0.13), printed_value(10.25, 0.13));
}

TEST(ComparisonPrint, AWorstEnWithoutALimitHasAText) {
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(shown_worst_en(k_infinite).text, "∞");
    EXPECT_EQ(shown_worst_en(-k_infinite).text, "-∞");
    EXPECT_FALSE(shown_worst_en(k_infinite).number);
    EXPECT_EQ(shown_worst_en(1.5).text, "1.50");
    EXPECT_EQ(shown_worst_en(std::nullopt).text, "");
}

TEST(ComparisonPrint, AProbabilityIsNeverPrintedAsZero) {
    EXPECT_EQ(printed_probability(0.0), "<1E-300");
    EXPECT_EQ(printed_probability(0.00183), "0.0018");
    EXPECT_EQ(printed_probability(3e-27), "3.0E-27");
    EXPECT_EQ(printed_probability(1.0), "1.0");
    EXPECT_EQ(printed_probability(std::nullopt), "");
}

}  // namespace
}  // namespace gumcert::reports
