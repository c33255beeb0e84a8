#include "gum/rounding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <random>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {

inline void PrintTo(const RoundedPair& pair, std::ostream* out) {
    *out << pair.value << " ± " << pair.U;
}

namespace {

using test::code_of;
using test::message_of;
using test::number;

TEST(RoundToUncertainty, GoldenVectors) {
    EXPECT_EQ(round_to_uncertainty(693.1, 11.8), (RoundedPair{"693", "12"}));
    EXPECT_EQ(round_to_uncertainty(0.99626791663, 0.5), (RoundedPair{"1.00", "0.50"}));
    EXPECT_EQ(round_to_uncertainty(0.99626791663, 0.1), (RoundedPair{"1.00", "0.10"}));
    EXPECT_EQ(round_to_uncertainty(10.05762, 0.027), (RoundedPair{"10.058", "0.027"}));  // JCGM 100:2008, 7.2.6
    EXPECT_EQ(round_to_uncertainty(100.02147, 0.0996), (RoundedPair{"100.02", "0.10"}));
    EXPECT_EQ(round_to_uncertainty(1234.567, 99.6), (RoundedPair{"1.23E+3", "1.0E+2"}));
    EXPECT_EQ(round_to_uncertainty(12.345, 0.00999), (RoundedPair{"12.345", "0.010"}));
    EXPECT_EQ(round_to_uncertainty(-0.0004, 0.0123), (RoundedPair{"0.000", "0.012"}));
    EXPECT_EQ(round_to_uncertainty(299792.458, 1450), (RoundedPair{"2.998E+5", "1.4E+3"}));
    EXPECT_EQ(round_to_uncertainty(299792.458, 1450, 2, RoundingMode::up), (RoundedPair{"2.998E+5", "1.5E+3"}));
}

TEST(RoundToUncertainty, AdviceOfTheGum) {
    // JCGM 100:2008, 7.2.6: 10.47 mΩ may be rounded up to 11 mΩ, 28.05 kHz is rounded to 28 kHz.
    EXPECT_EQ(round_to_uncertainty(0.0, 10.47, 2, RoundingMode::up).U, "11");
    EXPECT_EQ(round_to_uncertainty(0.0, 10.47).U, "10");
    EXPECT_EQ(round_to_uncertainty(0.0, 28.05).U, "28");
    EXPECT_EQ(round_to_uncertainty(10.05762, 0.027), (RoundedPair{"10.058", "0.027"}));
}

TEST(RoundToUncertainty, ConciseNotationOfTheGtcManual) {
    // Printed as 0.10139(18), 0.3303(18), 0.0087(29), 0.2410(50) (MSLNZ/GTC documentation).
    EXPECT_EQ(round_to_uncertainty(0.10138722, 0.00018433), (RoundedPair{"0.10139", "0.00018"}));
    EXPECT_EQ(round_to_uncertainty(0.3303397, 0.001806), (RoundedPair{"0.3303", "0.0018"}));
    EXPECT_EQ(round_to_uncertainty(0.0087, 0.002858), (RoundedPair{"0.0087", "0.0029"}));
    EXPECT_EQ(round_to_uncertainty(0.241, 0.00497), (RoundedPair{"0.2410", "0.0050"}));
}

TEST(RoundToUncertainty, CarryKeepsTheNumberOfDigits) {
    EXPECT_EQ(round_to_uncertainty(0.0, 9.96), (RoundedPair{"0", "10"}));
    EXPECT_EQ(round_to_uncertainty(9.9999, 0.0995), (RoundedPair{"10.00", "0.10"}));  // tie: 0.0995 -> 0.100 -> 0.10
    EXPECT_EQ(round_to_uncertainty(-9.9999, 0.01), (RoundedPair{"-10.000", "0.010"}));
    EXPECT_EQ(round_to_uncertainty(99.96, 0.96, 1), (RoundedPair{"100", "1"}));
    EXPECT_EQ(round_to_uncertainty(7.0, 99.1, 2, RoundingMode::up), (RoundedPair{"1E+1", "1.0E+2"}));
}

TEST(RoundToUncertainty, OtherNumbersOfDigits) {
    EXPECT_EQ(round_to_uncertainty(12.3456, 0.0271, 1), (RoundedPair{"12.35", "0.03"}));
    EXPECT_EQ(round_to_uncertainty(12.3456, 0.0271, 3), (RoundedPair{"12.3456", "0.0271"}));
    EXPECT_EQ(round_to_uncertainty(12.3456, 0.25, 5), (RoundedPair{"12.34560", "0.25000"}));
}

TEST(RoundToUncertainty, PowerOfTenWhenTheLastDigitIsAboveTheUnit) {
    EXPECT_EQ(round_to_uncertainty(3.0, 1234.0), (RoundedPair{"0E+2", "1.2E+3"}));
    EXPECT_EQ(round_to_uncertainty(-49.0, 1234.0), (RoundedPair{"0E+2", "1.2E+3"}));
    EXPECT_EQ(round_to_uncertainty(-149.0, 1234.0), (RoundedPair{"-1E+2", "1.2E+3"}));
    EXPECT_EQ(round_to_uncertainty(1.0, 99.4), (RoundedPair{"1", "99"}));
}

TEST(RoundToUncertainty, VeryLargeAndVerySmall) {
    EXPECT_EQ(round_to_uncertainty(6.02214076e23, 1.5e16), (RoundedPair{"6.02214076E+23", "1.5E+16"}));
    EXPECT_EQ(round_to_uncertainty(1.23456e-7, 2.5e-9), (RoundedPair{"0.0000001235", "0.0000000025"}));
    EXPECT_EQ(round_to_uncertainty(1e300, 0.5).value.size(), 304U);
    EXPECT_EQ(round_to_uncertainty(0.0, std::numeric_limits<double>::denorm_min(), 1),
              (RoundedPair{"0E-324", "5E-324"}));
    // Zeros that nobody counts become a power of ten, of both alike.
    EXPECT_EQ(round_to_uncertainty(2.01e-16, 1.2e-17), (RoundedPair{"0.000000000000000201", "0.000000000000000012"}));
    EXPECT_EQ(round_to_uncertainty(2.01e-17, 1.2e-18), (RoundedPair{"2.01E-17", "1.2E-18"}));
}

TEST(RoundAsWritten, KeepsTheDigitsThatWereWritten) {
    EXPECT_EQ(round_as_written(2e-12, 13), "0.0000000000020");
    EXPECT_EQ(round_as_written(-2.50e-9, 11), "-0.00000000250");
    EXPECT_EQ(round_as_written(1000.0, 0), "1000");
    EXPECT_EQ(round_as_written(123456789012345.0, 0), "123456789012345");
    EXPECT_EQ(round_as_written(1.5e20, 0), "1.5E+20");
    EXPECT_EQ(round_as_written(-1e15, 0), "-1E+15");
    EXPECT_EQ(round_as_written(1.2000000000000002e20, 0), "1.2E+20") << "traces of a conversion";
    EXPECT_EQ(round_as_written(2.01e-25, 27), "2.01E-25");
    EXPECT_EQ(round_as_written(0.0, 2), "0.00");
    EXPECT_EQ(code_of<InputError>([] { (void)round_as_written(std::numeric_limits<double>::infinity(), 0); }),
              "GC-GUM-0001");
}

TEST(RoundToUncertainty, ValueBelowTheQuantum) {
    EXPECT_EQ(round_to_uncertainty(1e-30, 0.12), (RoundedPair{"0.00", "0.12"}));
    EXPECT_EQ(round_to_uncertainty(-1e-30, 0.12), (RoundedPair{"0.00", "0.12"}));
    EXPECT_EQ(round_to_uncertainty(-0.0, 0.12), (RoundedPair{"0.00", "0.12"}));
    EXPECT_EQ(round_to_uncertainty(0.0051, 0.12), (RoundedPair{"0.01", "0.12"}));
    EXPECT_EQ(round_to_uncertainty(-0.005, 0.12), (RoundedPair{"0.00", "0.12"}));
}

TEST(RoundToUncertainty, UpIsNotMovedByTheNoiseOfTheComputation) {
    EXPECT_EQ(round_to_uncertainty(1.0, 0.12000000000000001, 2, RoundingMode::up).U, "0.12");
    EXPECT_EQ(round_to_uncertainty(1.0, 3.0 * 0.1, 2, RoundingMode::up).U, "0.30");  // 0.30000000000000004
    EXPECT_EQ(round_to_uncertainty(1.0, 0.1200001, 2, RoundingMode::up).U, "0.13");
    EXPECT_EQ(round_to_uncertainty(1.005, 0.121, 2, RoundingMode::up).value, "1.00") << "the value stays half-even";
}

TEST(RoundToQuantum, TiesAreDecimal) {
    EXPECT_EQ(round_to_quantum(2.675, 2), "2.68");  // the double is 2.67499999999999982…
    EXPECT_EQ(round_to_quantum(2.665, 2), "2.66");
    EXPECT_EQ(round_to_quantum(1.005, 2), "1.00");
    EXPECT_EQ(round_to_quantum(1.015, 2), "1.02");
    EXPECT_EQ(round_to_quantum(0.5, 0), "0");
    EXPECT_EQ(round_to_quantum(1.5, 0), "2");
    EXPECT_EQ(round_to_quantum(2.5, 0), "2");
    EXPECT_EQ(round_to_quantum(-2.5, 0), "-2");
    EXPECT_EQ(round_to_quantum(-0.5, 0), "0");
    EXPECT_EQ(round_to_quantum(9.95, 1), "10.0");
    EXPECT_EQ(round_to_quantum(9.85, 1), "9.8");
    EXPECT_EQ(round_to_quantum(0.1 + 0.2, 1), "0.3");
    EXPECT_EQ(round_to_quantum(2.5000000001, 0), "3");
}

TEST(RoundToQuantum, Decimals) {
    EXPECT_EQ(round_to_quantum(12.0, 3), "12.000");
    EXPECT_EQ(round_to_quantum(-0.0004, 3), "0.000");
    EXPECT_EQ(round_to_quantum(999.9996, 3), "1000.000");
    EXPECT_EQ(round_to_quantum(1234.5, -1), "1.23E+3");
    EXPECT_EQ(round_to_quantum(1e-7, 3), "0.000");
    EXPECT_EQ(round_to_quantum(123456789.125, 2), "123456789.12");
    EXPECT_EQ(round_to_quantum(0.0, 2), "0.00");
}

TEST(RoundSignificant, PlainAndPowerOfTen) {
    EXPECT_EQ(round_significant(0.123456, 3), "0.123");
    EXPECT_EQ(round_significant(12.34, 3), "12.3");
    EXPECT_EQ(round_significant(1.0, 3), "1.00");
    EXPECT_EQ(round_significant(-0.00012345, 3), "-0.000123");
    EXPECT_EQ(round_significant(0.0001, 2), "0.00010");
    EXPECT_EQ(round_significant(0.00009996, 3), "0.000100");
    EXPECT_EQ(round_significant(0.0000999, 3), "9.99E-5");
    EXPECT_EQ(round_significant(1.23e-12, 2), "1.2E-12");
    EXPECT_EQ(round_significant(123456.0, 6), "123456");
    EXPECT_EQ(round_significant(123456.0, 3), "1.23E+5");
    EXPECT_EQ(round_significant(999999.6, 6), "1.00000E+6");
    EXPECT_EQ(round_significant(1e6, 8), "1.0000000E+6");
    EXPECT_EQ(round_significant(4.56e18, 2), "4.6E+18");
    EXPECT_EQ(round_significant(7.0, 1), "7");
    EXPECT_EQ(round_significant(1310.7, 4), "1311");
    EXPECT_EQ(round_significant(0.0, 3), "0");
    EXPECT_EQ(round_significant(-0.0, 3), "0");
}

TEST(Percent, OneDecimal) {
    EXPECT_EQ(percent(0.123), "12.3");
    EXPECT_EQ(percent(0.1234), "12.3");
    EXPECT_EQ(percent(0.1235), "12.4");  // tie, 3 is odd
    EXPECT_EQ(percent(0.1245), "12.4");  // tie, 4 is even
    EXPECT_EQ(percent(1.0), "100.0");
    EXPECT_EQ(percent(0.0), "0.0");
    EXPECT_EQ(percent(0.00049), "0.0");
    EXPECT_EQ(percent(-1e-18), "0.0");
    EXPECT_EQ(percent(0.9996), "100.0");
}

TEST(Rounding, RefusesWhatCannotBePrinted) {
    for (const double bad : {std::nan(""), k_infinity, -k_infinity}) {
        EXPECT_EQ(code_of<InputError>([&] { (void)round_to_uncertainty(bad, 0.1); }), "GC-GUM-0001");
        EXPECT_EQ(code_of<InputError>([&] { (void)round_to_uncertainty(1.0, bad); }), "GC-GUM-0001");
        EXPECT_EQ(code_of<InputError>([&] { (void)round_to_quantum(bad, 2); }), "GC-GUM-0001");
        EXPECT_EQ(code_of<InputError>([&] { (void)round_significant(bad, 2); }), "GC-GUM-0001");
        EXPECT_EQ(code_of<InputError>([&] { (void)percent(bad); }), "GC-GUM-0001");
    }
    EXPECT_EQ(code_of<InputError>([] { (void)round_to_uncertainty(1.0, 0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)round_to_uncertainty(1.0, 0.1, 0); }), "GC-GUM-0040");
    EXPECT_EQ(code_of<InputError>([] { (void)round_significant(1.0, 16); }), "GC-GUM-0040");
    EXPECT_EQ(code_of<InputError>([] { (void)round_to_quantum(1.0, 401); }), "GC-GUM-0041");
    EXPECT_EQ(message_of<InputError>([] { (void)round_to_uncertainty(1.0, -2e-6); }),
              "uncertainty to print — -2e-06 — must be greater than 0 — Correct the value.");
}

/// Power of ten of the last printed digit.
int quantum_exponent(const std::string& text) {
    const std::size_t power = text.find('E');
    const std::string mantissa = text.substr(0, power);
    const std::size_t point = mantissa.find('.');
    const int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point) - 1;
    const int exponent = power == std::string::npos ? 0 : std::stoi(text.substr(power + 1));
    return exponent - decimals;
}

int significant_digits(const std::string& text) {
    const std::string mantissa = text.substr(0, text.find('E'));
    int count = 0;
    for (const char character : mantissa) {
        const bool is_digit = character >= '0' && character <= '9';
        if (is_digit && (count > 0 || character != '0')) {
            ++count;
        }
    }
    return count;
}

TEST(RoundingProperty, AMillionRandomPairs) {
    std::mt19937_64 random(20240607);
    const auto uniform = [&random] { return std::ldexp(static_cast<double>(random() >> 11U), -53); };
    int failures = 0;
    for (int trial = 0; trial < 1'000'000 && failures < 10; ++trial) {
        // U over eighteen decades; values from far below the quantum to far above it; some with few decimal digits,
        // so that ties and carries happen often.
        double U = std::pow(10.0, 18.0 * uniform() - 12.0);
        double value = (uniform() - 0.5) * U * std::pow(10.0, 8.0 * uniform() - 2.0);
        if (trial % 3 == 0) {
            U = (1.0 + std::floor(uniform() * 9999.0)) / 1000.0;
            value = std::floor((uniform() - 0.5) * 2e5) / 1000.0;
        }
        const int digits = trial % 5 == 0 ? 1 : trial % 7 == 0 ? 3 : 2;
        const RoundingMode mode = trial % 2 == 0 ? RoundingMode::half_even : RoundingMode::up;
        const RoundedPair pair = round_to_uncertainty(value, U, digits, mode);

        const int exponent = quantum_exponent(pair.U);
        const double quantum = number("1e" + std::to_string(exponent));
        const double printed_value = number(pair.value);
        const double printed_U = number(pair.U);
        const double noise = 4e-16 * (std::abs(value) + U);
        bool good = quantum_exponent(pair.value) == exponent;
        good = good && significant_digits(pair.U) == digits;
        good = good && std::abs(printed_value - value) <= 0.5 * quantum + noise;
        if (mode == RoundingMode::half_even) {
            good = good && std::abs(printed_U - U) <= 0.5 * quantum + noise;
        } else {
            good = good && printed_U >= U * (1.0 - 1e-11) && printed_U - U <= quantum + noise;
        }
        good = good && !(pair.value.front() == '-' && printed_value == 0.0);
        if (!good) {
            ++failures;
            ADD_FAILURE() << "value " << ::testing::PrintToString(value) << ", U " << ::testing::PrintToString(U)
                          << ", digits " << digits << ": " << pair.value << " ± " << pair.U;
        }
    }
}

TEST(RoundingProperty, RoundingTwiceChangesNothing) {
    std::mt19937_64 random(7);
    for (int trial = 0; trial < 100'000; ++trial) {
        const double value = std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -50);
        const std::string once = round_significant(value, 4);
        ASSERT_EQ(round_significant(number(once), 4), once) << value;
        const std::string decimals = round_to_quantum(value, 3);
        ASSERT_EQ(round_to_quantum(number(decimals), 3), decimals) << value;
    }
}

TEST(Rounding, NoiseOfAComputationDoesNotBreakATie) {
    EXPECT_EQ(round_to_uncertainty(3139.674 + 223.676, 1.0), (RoundedPair{"3363.4", "1.0"}));
    EXPECT_EQ(round_to_quantum(0.1 + 0.2 + 0.05, 1), "0.4");  // 0.35000000000000003: a tie that goes to the even digit
    EXPECT_EQ(round_to_quantum(0.15 + 0.1, 1), "0.2");
    EXPECT_EQ(round_to_quantum(0.25000000000001, 1), "0.3");  // 14 digits: not noise
    // Where nearly all digits are kept, nothing is taken for noise.
    EXPECT_EQ(round_to_quantum(0.1234567890123456, 15), "0.123456789012346");
    EXPECT_EQ(round_to_quantum(9.9999999999999995, 1), "10.0");
}

/// What is printed beside a limit is on the side of it that the verdict is on.
TEST(RoundSignificantBeside, StandsOnItsSideOfEachLimit) {
    EXPECT_EQ(round_significant_beside(0.0498, 2, {0.05}), "0.0498");
    EXPECT_EQ(round_significant_beside(0.04999996, 2, {0.05}), "0.04999996");
    EXPECT_EQ(round_significant_beside(0.0502, 2, {0.05}), "0.0502");
    EXPECT_EQ(round_significant_beside(0.05, 2, {0.05}), "0.050");
    EXPECT_EQ(round_significant_beside(0.044, 2, {0.05, 0.025}), "0.044");
    EXPECT_EQ(round_significant_beside(0.02496, 2, {0.05, 0.025}), "0.02496");
    EXPECT_EQ(round_significant_beside(std::nextafter(0.05, 0.0), 2, {0.05}), "0.050") << "rounding of the computation";
}

TEST(RoundInOrder, KeepsTheOrderOfANumberAndItsLimits) {
    using ::testing::ElementsAre;
    EXPECT_THAT(round_in_order({1.648, 9.4877290}, 4, &round_significant), ElementsAre("1.648", "9.488"));
    EXPECT_THAT(round_in_order({5.99149, 5.991465}, 4, &round_significant), ElementsAre("5.99149", "5.99146"))
        << "both, until they differ";
    EXPECT_THAT(round_in_order({2.0, 2.0}, 2, &round_significant), ElementsAre("2.0", "2.0"));
    EXPECT_THAT(round_in_order({10.3 - 10.0, 0.3}, 2, &round_significant), ElementsAre("0.30", "0.30"))
        << "rounding of the computation";
    EXPECT_THAT(round_in_order({10.04, 3.0, 10.0}, 1, &round_to_quantum), ElementsAre("10.04", "3.00", "10.00"));
}

// A number that a computation has cost some digits is the decimal number within what was lost, where there is one with all but two of the
// digits that stand: half of 0.3 − 0.1 is 0.1.
TEST(SettledDecimal, IsTheOneWithinWhatWasLost) {
    EXPECT_EQ(settled_decimal(0.1 + 0.2, 1e-16), 0.3);
    EXPECT_EQ(settled_decimal(0.09999999999999998, 1e-16), 0.1);
    EXPECT_EQ(settled_decimal(-0.09999999999999998, 1e-16), -0.1);
    EXPECT_EQ(settled_decimal(0.10000000003, 1e-16), 0.10000000003) << "no decimal number is so near";
    EXPECT_EQ(settled_decimal(0.12345678901234567, 1e-17), 0.12345678901234567) << "nor here";
    EXPECT_EQ(settled_decimal(0.5, 1e-16), 0.5) << "it has no digit below";
    EXPECT_EQ(settled_decimal(12.0, 1e-3), 12.0);
    constexpr double k_inf = std::numeric_limits<double>::infinity();
    for (const double lost : {0.0, -1.0, k_inf, std::nan("")}) {
        EXPECT_EQ(settled_decimal(0.1 + 0.2, lost), 0.1 + 0.2) << lost;
    }
    EXPECT_EQ(settled_decimal(0.0, 1.0), 0.0);
    EXPECT_EQ(settled_decimal(k_inf, 1.0), k_inf);
    EXPECT_TRUE(std::isnan(settled_decimal(std::nan(""), 1.0)));
}

TEST(RoundToQuantum, HasBoundsOfItsDecimals) {
    EXPECT_EQ(message_of<InputError>([] { (void)round_to_quantum(1.0, -301); }),
              "number of decimals — -301 — must be -300 to 400 — Correct the number of decimals.");
    EXPECT_EQ(code_of<InputError>([] { (void)round_to_quantum(1.0, 401); }), "GC-GUM-0041");
    EXPECT_EQ(round_to_quantum(1.0, -300), "0E+300");
}

}  // namespace
}  // namespace gumcert::gum
