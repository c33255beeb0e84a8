#include "reports/record/reported_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "certificate/statement_of_uncertainty.h"
#include "tests/support/sample_budget_record.h"

namespace gumcert::reports {
namespace {

TEST(ReportedResult, IsValueAndUOfTheLawOfPropagation) {
    ReportedResult r = law_of_propagation_result(50000838.0, 31.7, 92.6, 2.92, 0.99);
    print_reported(r, "nm");
    EXPECT_EQ(r.method, "law_of_propagation");
    EXPECT_EQ(r.printed.value, "50000838");
    EXPECT_EQ(r.printed.U, "93");
    EXPECT_EQ(r.printed.unit, "nm");
    EXPECT_EQ(r.printed_low, "");
    ASSERT_TRUE(r.interval);
    EXPECT_NEAR((*r.interval)[0], 50000838.0 - 92.6, 1e-6);
}

TEST(ReportedResult, HasAnIntervalWhereUWouldSaySomethingElse) {
    ReportedResult r = monte_carlo_result(0.9987, 1.4108, {0.000811, 5.2037}, 0.9545, "vanishing");
    print_reported(r, "mm");
    EXPECT_FALSE(r.U);
    EXPECT_FALSE(r.k);
    EXPECT_EQ(r.printed.value, "1.0");
    EXPECT_EQ(r.printed.U, "");
    EXPECT_EQ(r.printed_u, "1.4");
    EXPECT_EQ(r.printed_low, "0.0");
    EXPECT_EQ(r.printed_high, "5.2");
}

TEST(ReportedResult, HasNoUWithoutAVariance) {
    ReportedResult r = monte_carlo_result(2.0, {}, {-1.9, 5.9}, 0.9545, "second_order");
    print_reported(r, "1");
    EXPECT_FALSE(r.u || r.U || r.k) << "also where the interval is symmetric: k would be U/u";
    EXPECT_EQ(r.printed_u, "");
    EXPECT_EQ(r.printed_low, "-1.9");
    EXPECT_EQ(r.printed_high, "5.9");
}

// Where ± U is printed, its ends are those of the interval within the last printed digit.
TEST(ReportedResult, IsSymmetricOnlyToThePrintedDigit) {
    std::mt19937_64 random(2026);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int symmetric = 0;
    for (int i = 0; i < 5000; ++i) {
        const double half = std::pow(10.0, 12.0 * unit(random) - 6.0);
        const double value = (2.0 * unit(random) - 1.0) * std::pow(10.0, 4.0 * unit(random)) * half;
        const double off = (2.0 * unit(random) - 1.0) * 0.1 * half;
        ReportedResult r =
            monte_carlo_result(value, 0.5 * half, {value + off - half, value + off + half}, 0.95, "asked");
        print_reported(r, "1");
        const auto number = [](const std::string& text) { return *certificate::number_of(text); };
        if (r.U) {
            ++symmetric;
            const double last = std::pow(10.0, -certificate::decimals_of(r.printed.U));
            EXPECT_LE(std::abs(value - half - (*r.interval)[0]), 0.5001 * last);
            EXPECT_LE(std::abs(number(r.printed.value) + number(r.printed.U) - (*r.interval)[1]), 1.5001 * last);
            EXPECT_NEAR(*r.k * *r.u, *r.U, 1e-12 * *r.U);
        } else {
            EXPECT_EQ(certificate::decimals_of(r.printed_low), certificate::decimals_of(r.printed.value));
            const double last = std::pow(10.0, -certificate::decimals_of(r.printed.value));
            EXPECT_LE(std::abs(number(r.printed_low) - (*r.interval)[0]), 0.5001 * last);
            EXPECT_LE(std::abs(number(r.printed_high) - (*r.interval)[1]), 0.5001 * last);
            EXPECT_GT(std::abs(off), 0.4999 * last);
        }
    }
    EXPECT_GT(symmetric, 500);
    EXPECT_LT(symmetric, 4500);
}

TEST(ReportedResult, IsMadeOfTheNumbersOfARecordThatKnewNone) {
    const EvaluationRecord record = test::sample_budget_record();
    const ReportedResult r = reported_result(record.results.front());
    EXPECT_EQ(r.method, "law_of_propagation");
    EXPECT_EQ(r.printed.U, "93");
    Result old = record.results.front();
    old.coverage = "none";
    old.U.reset();
    old.k.reset();
    const ReportedResult alone = reported_result(old);
    EXPECT_EQ(alone.method, "monte_carlo");
    EXPECT_EQ(*alone.interval, old.monte_carlo->symmetric.number);
    EXPECT_FALSE(alone.U);
}

/// More than p of the trials are one value: the interval has no width, and the result is uncertain all the same.
TEST(ReportedResult, HasNoUOfZeroBesideAnUncertainty) {
    for (const double value : {0.9994, 1.0, 1.2}) {
        ReportedResult r = monte_carlo_result(value, 0.003, {1.0, 1.0}, 0.8, "not_linear");
        print_reported(r, "1");
        EXPECT_FALSE(r.U || r.k) << value;
        EXPECT_EQ(r.printed.U, "");
        EXPECT_EQ(r.printed_u, "0.0030");
        EXPECT_EQ(r.printed_low, "1.0000");
        EXPECT_EQ(r.printed_high, "1.0000");
        EXPECT_EQ(certificate::decimals_of(r.printed.value), 4);
    }
    ReportedResult exact = monte_carlo_result(1.0, 0.0, {1.0, 1.0}, 0.8, "asked");
    print_reported(exact, "1");
    EXPECT_EQ(exact.U, 0.0);
    EXPECT_FALSE(is_symmetric_as_printed(0.9994, {1.0, 1.0}));
}

/// Over sizes of the interval and of the error: half a unit of the last digit of the value is no smaller than its error,
/// and no digit is printed that a double does not hold.
TEST(ReportedResult, ValueBesideAnIntervalEndsWhereItIsHeld) {
    for (const double width : {1e-22, 1e-9, 1e-3, 1.0, 1e4}) {
        for (const double error : {0.0, 1e-6, 2.3e-4, 0.04, 0.2, 30.0}) {
            for (const double value : {0.00050663, 2.38395, 1234.5}) {
                ReportedResult r = monte_carlo_result(value, {}, {0.0, width}, 0.95, "asked");
                ReportedRounding rounding;
                rounding.value_error = error;
                print_reported(r, "1", rounding);
                const double last = std::pow(10.0, -certificate::decimals_of(r.printed.value));
                EXPECT_GE(0.5 * last * (1.0 + 1e-9), error) << r.printed.value;
                EXPECT_GE(last, 0.9e-15 * value) << r.printed.value;
                EXPECT_LE(std::abs(*certificate::number_of(r.printed.value) - value), 0.5001 * last);
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
