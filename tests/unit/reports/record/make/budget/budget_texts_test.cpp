#include "reports/record/make/budget/budget_texts.h"
#include "text/numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

TEST(BudgetTexts, StatedNumbersComeBackWithoutTracesOfConversion) {
    for (const double value : {5.007, 0.3, 123456.789, 1e-7, 20.1, -0.05}) {
        EXPECT_EQ(as_stated(value / 1000.0 * 1000.0), text::shortest(value));
        EXPECT_EQ(as_stated(-value * 1e-6 / 1e-6), text::shortest(-value));
    }
    EXPECT_EQ(as_stated(0.1 * 3.0), "0.3");
    EXPECT_EQ(as_stated(1.0 / 3.0), "0.3333333333333333");
    EXPECT_EQ(text::shortest(-0.0), "0");
}

TEST(BudgetTexts, NumbersOfASeriesHaveEqualDecimals) {
    using Texts = std::vector<std::string>;
    EXPECT_EQ(series_as_stated(std::vector{10.1, 10.12, -9.0}), (Texts{"10.10", "10.12", "-9.00"}));
    EXPECT_EQ(series_as_stated(std::vector{10.1, 10.2}, 3), (Texts{"10.100", "10.200"}));
    EXPECT_EQ(series_as_stated(std::vector{10.0, 7.0}), (Texts{"10", "7"}));
    EXPECT_EQ(series_as_stated(std::vector{100000.0, 100000.5}), (Texts{"100000.0", "100000.5"}));
    EXPECT_EQ(series_as_stated(std::vector{5.1e-6, 5e-6}, 7), (Texts{"0.0000051", "0.0000050"}));
    EXPECT_EQ(series_as_stated(std::vector{1.002e-6, 1e-6}), (Texts{"0.000001002", "0.000001000"}));
    EXPECT_EQ(series_as_stated(std::vector{2.01e-12, 2e-12}, 15), (Texts{"0.000000000002010", "0.000000000002000"}));
    EXPECT_EQ(series_as_stated(std::vector{1e-30, 0.5}), (Texts{"1E-30", "0.5"})) << "no decimals to add";
    EXPECT_EQ(series_as_stated(std::vector{2.5e20, 0.5}), (Texts{"2.5E+20", "0.5"}));
    EXPECT_TRUE(series_as_stated({}).empty());
}

TEST(BudgetTexts, ASeriesMovesNoValue) {
    std::mt19937_64 draws(18);
    for (int run = 0; run < 2000; ++run) {
        std::vector<double> values;
        for (std::uint64_t i = draws() % 8; i < 8; ++i) {
            const double digits = static_cast<double>(draws() % 2'000'000) - 1e6;
            values.push_back(digits / std::pow(10.0, static_cast<double>(draws() % 7)));
        }
        const std::vector<std::string> texts = series_as_stated(values, 1 + static_cast<int>(draws() % 5));
        ASSERT_EQ(texts.size(), values.size());
        for (std::size_t i = 0; i < texts.size(); ++i) {
            EXPECT_EQ(std::stod(texts[i]), std::stod(as_stated(values[i]))) << texts[i];
            EXPECT_EQ(texts[i].size() - std::min(texts[i].find('.'), texts[i].size()),
                      texts[0].size() - std::min(texts[0].find('.'), texts[0].size()));
        }
    }
}

TEST(BudgetTexts, EstimatesEndWithTheirUncertainty) {
    EXPECT_EQ(printed_estimate(10.12345, 0.0123), "10.123");
    EXPECT_EQ(printed_estimate(10.12345, 0.0), "10.12345");
    EXPECT_EQ(shown_degrees_of_freedom(INFINITY).text, "∞");
    EXPECT_EQ(shown_degrees_of_freedom(NAN).text, "–");
    EXPECT_FALSE(shown_degrees_of_freedom(NAN).number);
    EXPECT_EQ(shown_degrees_of_freedom(7.1234).number, 7.1234);
    EXPECT_EQ(shown_degrees_of_freedom(7.1234).text, "7.1");
    EXPECT_EQ(shown_degrees_of_freedom(148.6).text, "148") << "as in the line of the result: never more than there are";
    EXPECT_EQ(rounded(0.012345, 2), "0.012");
}

}  // namespace
}  // namespace gumcert::reports
