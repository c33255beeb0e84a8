#include "text/numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gumcert::text {
namespace {

TEST(Numbers, ShortestReadsBackTheSame) {
    EXPECT_EQ(shortest(0.1), "0.1");
    EXPECT_EQ(shortest(-1e-9), "-1e-09");
    EXPECT_EQ(shortest(1.0 / 3.0), "0.3333333333333333");
    EXPECT_EQ(shortest(100000.0), "1e+05");
}

TEST(Numbers, PlainHasNoExponentWherePeopleReadIt) {
    EXPECT_EQ(shortest_plain(100000.0), "100000");
    EXPECT_EQ(shortest_plain(0.0001), "0.0001");
    EXPECT_EQ(shortest_plain(0.00009), "9e-05");
    EXPECT_EQ(shortest_plain(-2.5e-7, 1e-7), "-0.00000025");
    EXPECT_EQ(shortest_plain(1e15), "1e+15");
    EXPECT_EQ(shortest_plain(999999999999999.0), "999999999999999");
    EXPECT_EQ(shortest_plain(0.0), "0");
}

TEST(Numbers, ZeroAndNaNHaveNoSign) {
    EXPECT_EQ(shortest(-0.0), "0");
    EXPECT_EQ(fixed(-0.0, 2), "0.00");
    EXPECT_EQ(shortest(std::copysign(std::numeric_limits<double>::quiet_NaN(), -1.0)), "NaN");
    EXPECT_EQ(shortest_plain(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Numbers, SignificantAndFixedDigits) {
    EXPECT_EQ(significant(1234.5, 3), "1.23e+03");
    EXPECT_EQ(significant(5.334, 3), "5.33");
    EXPECT_EQ(significant(12345678.0, 12), "12345678");
    EXPECT_EQ(fixed(1234.567, 1), "1234.6");
    EXPECT_EQ(fixed(0.0, 0), "0");
    EXPECT_EQ(fixed(std::numeric_limits<double>::max(), 700).size(), 309U + 1U + 700U);
}

TEST(Numbers, DecimalsAreCountedAsTheyAreWritten) {
    const auto most = [](const std::vector<std::string>& numbers) { return most_decimals(numbers); };
    EXPECT_EQ(most({"1.50"}), 2);
    EXPECT_EQ(most({"1.0", "-2.500", "3"}), 3);
    EXPECT_EQ(most({"7", "8"}), 0);
    EXPECT_EQ(most({"1.5e-3"}), 4);
    EXPECT_EQ(most({"0.1", "0.30000000000000004"}), 1) << "traces of a conversion";
    EXPECT_EQ(most({"-0.000100000"}), 9);
    EXPECT_EQ(most({"1.50e-3"}), 5) << "its zero was written";
    EXPECT_EQ(most({"0.10", "1e-30"}), 30);
    EXPECT_EQ(most({"1.00e-30", "0.10"}), 32) << "in any order";
    EXPECT_EQ(most({"2.5e+3", "1E2"}), 0);
    EXPECT_EQ(most({"2.01E-12"}), 14);
    EXPECT_EQ(most({"3.0000000000000004e-20"}), 20) << "traces of a conversion";
    EXPECT_EQ(most({"0e-99999999999"}), 340);
    EXPECT_EQ(most({"1e99999999999"}), 0);
    EXPECT_EQ(most({}), 0);
}

TEST(Numbers, TrailingZerosGo) {
    EXPECT_EQ(without_trailing_zeros("1.50"), "1.5");
    EXPECT_EQ(without_trailing_zeros("2.000"), "2");
    EXPECT_EQ(without_trailing_zeros("100"), "100");
    EXPECT_EQ(without_trailing_zeros("1.50E+3"), "1.50E+3");
}

}  // namespace
}  // namespace gumcert::text
