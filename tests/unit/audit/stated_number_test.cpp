#include "audit/stated_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <tuple>

namespace gumcert::audit {
namespace {

struct Printed {
    std::string text;
    double value, half_step;
};
class PrintedNumbers : public testing::TestWithParam<Printed> {};

TEST_P(PrintedNumbers, AreReadWithWhatTheirDigitsLeaveOpen) {
    const std::optional<StatedNumber> number = read_number(GetParam().text, "row 3");
    ASSERT_TRUE(number) << GetParam().text;
    EXPECT_DOUBLE_EQ(number->value, GetParam().value);
    EXPECT_NEAR(number->half_step, GetParam().half_step, 1e-12 * GetParam().half_step);
    EXPECT_EQ(number->text, GetParam().text);
    EXPECT_EQ(number->place, "row 3");
}

INSTANTIATE_TEST_SUITE_P(EnglishAndGerman, PrintedNumbers,
                         testing::Values(Printed{"0.29", 0.29, 0.005}, Printed{"0,29", 0.29, 0.005},
                                         Printed{"0.290", 0.290, 0.0005}, Printed{"-1.5", -1.5, 0.05},
                                         Printed{"\u2212"
                                                 "1,5",
                                                 -1.5, 0.05},
                                         Printed{"\u00B10.5", 0.5, 0.05}, Printed{"+/- 0,5", 0.5, 0.05},
                                         Printed{"+-0.5", 0.5, 0.05}, Printed{"12", 12.0, 0.0},
                                         Printed{"1.2E-3", 1.2e-3, 0.05e-3}, Printed{"1,2\u00B710^-3", 1.2e-3, 0.05e-3},
                                         Printed{"1.2 \u00D7 10-3", 1.2e-3, 0.05e-3}, Printed{"5 %", 0.05, 0.0},
                                         Printed{"0,5%", 0.005, 0.0005}, Printed{"10 000.25", 10000.25, 0.005},
                                         Printed{"10'000.25", 10000.25, 0.005}, Printed{"1.234,5", 1234.5, 0.05},
                                         Printed{"1,234.5", 1234.5, 0.05}, Printed{"1.234.567", 1234567.0, 0.0},
                                         Printed{"\u221A"
                                                 "3",
                                                 std::sqrt(3.0), 0.0},
                                         Printed{"sqrt(6)", std::sqrt(6.0), 0.0},
                                         Printed{"2\u221A"
                                                 "3",
                                                 2.0 * std::sqrt(3.0), 0.0},
                                         Printed{"2E2", 200.0, 50.0}));

TEST(StatedNumber, KnowsInfinity) {
    for (const char* text : {"\u221E", "inf", "Infinity", "unendlich"}) {
        const std::optional<StatedNumber> number = read_number(text, "");
        ASSERT_TRUE(number) << text;
        EXPECT_TRUE(std::isinf(number->value)) << text;
    }
}

TEST(StatedNumber, IsNothingWhereTextIsNoNumber) {
    for (const char* text : {"", "rect.", "0.36 \u00B5m", "631.74.2", "k = 2", "1.2.3", "1.234.56", "12.34,5", "--3",
                             "sqrt(", "1e", "0.002 \u00D7 100"}) {
        EXPECT_FALSE(read_number(text, "")) << text;
    }
}

TEST(StatedNumber, LeavesWhatFollowsANumber) {
    const std::optional<LeadingNumber> leading = read_leading_number("0.36 \u00B5m, k = 2", "");
    ASSERT_TRUE(leading);
    EXPECT_DOUBLE_EQ(leading->number.value, 0.36);
    EXPECT_EQ(leading->rest, "\u00B5m, k = 2");
    EXPECT_FALSE(read_leading_number("about 0.36", ""));
    EXPECT_FALSE(read_leading_number(std::string(401, '1'), ""));
}

/// A number with its digits in groups of three from the decimal sign on, as the SI Brochure, 9th edition, 5.4.4, sets them.
std::string in_groups(const std::string& whole, const std::string& decimals, char sign, const std::string& group) {
    std::string all;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        all += (i > 0 && (whole.size() - i) % 3 == 0 ? group : "") + whole[i];
    }
    all += decimals.empty() ? "" : std::string(1, sign);
    for (std::size_t i = 0; i < decimals.size(); ++i) {
        all += (i > 0 && i % 3 == 0 ? group : "") + decimals[i];
    }
    return all;
}

/// The law: however many digits stand before and behind the sign, and whatever sets their groups apart, all of them are read, and what
/// follows is not.
TEST(StatedNumber, OfDigitsInGroupsHasAllOfThem) {
    const std::string digits = "730519264807";
    for (const std::string& group :
         {std::string(" "), std::string("\u00A0"), std::string("\u2009"), std::string("\u202F"), std::string("'")}) {
        for (const char sign : {'.', ','}) {
            for (std::size_t before = 1; before <= 7; ++before) {
                for (std::size_t behind = 0; behind <= 8; ++behind) {
                    const std::string whole = before == 1 ? "0" : digits.substr(0, before);
                    const std::string decimals = digits.substr(digits.size() - behind);
                    const double value = std::stod(whole + "." + (decimals.empty() ? "0" : decimals));
                    const double half_step = behind == 0 ? 0.0 : 0.5 * std::pow(10.0, -static_cast<double>(behind));
                    for (const std::string& rest :
                         {std::string(), std::string("mm"), std::string("mm, k = 2"), std::string("\u00D7 10^0 V")}) {
                        const std::string text =
                            in_groups(whole, decimals, sign, group) + (rest.empty() ? "" : " " + rest);
                        const std::optional<LeadingNumber> read = read_leading_number(text, "", Percent::unit);
                        ASSERT_TRUE(read) << text;
                        EXPECT_DOUBLE_EQ(read->number.value, value) << text;
                        const bool has_power = rest.starts_with("\u00D7");
                        EXPECT_NEAR(read->number.half_step, has_power && behind == 0 ? 0.5 : half_step, 1e-12) << text;
                        EXPECT_EQ(read->rest, has_power ? "V" : rest) << text;
                    }
                }
            }
        }
    }
}

TEST(StatedNumber, TakesNoDigitsThatAreNotOfIt) {
    for (const auto& [text, value, rest] :
         {std::tuple("0.028 0.5", 0.028, "0.5"), std::tuple("0.028 10^-3", 0.028, "10^-3"),
          std::tuple("0.28 15", 0.28, "15"), std::tuple("0.028 15mm", 0.028, "15mm"), std::tuple("0.5 123", 0.5, "123"),
          std::tuple("0.028  15", 0.028, "15"), std::tuple("12 15", 12.0, "15"), std::tuple("1234 567", 1234.0, "567"),
          std::tuple("0.028 15/2", 0.028, "15/2")}) {
        const std::optional<LeadingNumber> read = read_leading_number(text, "", Percent::unit);
        ASSERT_TRUE(read) << text;
        EXPECT_DOUBLE_EQ(read->number.value, value) << text;
        EXPECT_EQ(read->rest, rest) << text;
    }
}

TEST(StatedNumber, IsAnInterval) {
    const Interval interval = read_number("0.29", "")->interval();
    EXPECT_TRUE(interval.contains(0.2851));
    EXPECT_TRUE(interval.contains(0.2949));
    EXPECT_FALSE(interval.contains(0.2849));
    EXPECT_TRUE(interval.meets({0.294, 0.4}));
    EXPECT_FALSE(interval.meets({0.296, 0.4}));
    EXPECT_EQ(exact_number(0.29, "x").half_step, 0.0);
    EXPECT_EQ(exact_number(0.29, "x").place, "x");
}

TEST(PrintedHalfStep, TakesWholeNumbersForRounded) {
    const auto half = [](const char* text) { return printed_half_step(*read_number(text, "")); };
    EXPECT_DOUBLE_EQ(half("0.29"), 0.005);
    EXPECT_DOUBLE_EQ(half("12"), 0.5);
    EXPECT_DOUBLE_EQ(half("120"), 5.0);
    EXPECT_DOUBLE_EQ(half("125"), 0.5);
    EXPECT_DOUBLE_EQ(half("100"), 5.0);
    EXPECT_DOUBLE_EQ(half("0"), 0.0);
    EXPECT_DOUBLE_EQ(printed_half_step(exact_number(12.0, "")), 0.0);
}

}  // namespace
}  // namespace gumcert::audit
