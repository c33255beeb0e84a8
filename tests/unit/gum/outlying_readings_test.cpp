#include "gum/outlying_readings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {
namespace {

std::vector<std::size_t> positions(const std::vector<double>& readings, double resolution = 0.0) {
    std::vector<std::size_t> list;
    for (const OutlyingReading& found : outlying_readings(readings, resolution)) {
        list.push_back(found.position);
    }
    return list;
}

using Positions = std::vector<std::size_t>;

TEST(OutlyingReadings, UraniumIsotopesOfTheHandbook) {
    // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.5.17.1: G = 2.4687 (2.46876, cut).
    const std::vector<double> readings{199.31, 199.53, 200.19, 200.82, 201.92, 201.95, 202.18, 245.57};
    const auto found = outlying_readings(readings);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].position, 7U);
    EXPECT_EQ(found[0].tested, 8U);
    EXPECT_NEAR(found[0].G, 2.4687, 1e-4);
    EXPECT_LT(found[0].p_value, 1e-6);
}

/// n readings, the last one so far out that Grubbs' statistic is G.
std::vector<double> readings_with(int n, double G) {
    std::vector<double> readings;
    for (int i = 0; i < n; ++i) {
        readings.push_back(1.0 / 3.0 + std::sin(12.9898 * i + 1.0));  // no short decimals: no step
    }
    double low = 0.0;
    double high = 1e4;
    for (int step = 0; step < 200; ++step) {
        readings.back() = 0.5 * (low + high);
        double mean = 0.0;
        for (const double r : readings) {
            mean += r / n;
        }
        double squares = 0.0;
        for (const double r : readings) {
            squares += (r - mean) * (r - mean);
        }
        ((readings.back() - mean) / std::sqrt(squares / (n - 1)) < G ? low : high) = readings.back();
    }
    return readings;
}

TEST(OutlyingReadings, CriticalValuesOfTheTables) {
    // Upper 0.5 % of Grubbs' table, which is two-sided 1 %: n, G (ASTM E178, table 1).
    for (const auto& [n, critical] : {std::pair{10, 2.482}, std::pair{20, 3.001}, std::pair{30, 3.236}}) {
        EXPECT_TRUE(positions(readings_with(n, critical * 0.999)).empty()) << n;
        EXPECT_EQ(positions(readings_with(n, critical * 1.001)), Positions{static_cast<std::size_t>(n - 1)}) << n;
    }
}

TEST(OutlyingReadings, FindsWhatASlipOfThePenMakes) {
    EXPECT_EQ(positions({5.00, 5.01, 4.99, 5.00, 49.99, 5.01, 4.99, 5.00, 5.01, 5.00}), Positions{4});
    EXPECT_EQ(positions({5.00, 5.01, 50.0}), Positions{2});
    EXPECT_EQ(positions({-1.001, -1.002, -1.000, 1.001, -1.003}), Positions{3});
    // Two that hide each other from a single test.
    const auto two =
        outlying_readings(std::vector<double>{9.99, 10.01, 10.02, 9.98, 10.0, 10.01, 9.99, 10.0, 100.1, 100.0, 10.02});
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].position, 8U);
    EXPECT_EQ(two[1].position, 9U);
    EXPECT_LT(two[0].p_value, k_outlier_level);
}

TEST(OutlyingReadings, LeavesDigitalReadingsAlone) {
    EXPECT_TRUE(positions({10.01, 10.01, 10.02}).empty());
    EXPECT_TRUE(positions({10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.1}).empty());
    EXPECT_TRUE(positions(std::vector<double>(10, 7.0)).empty());  // all equal
    EXPECT_TRUE(positions({1.0, 1000.0}).empty());                 // two readings
    EXPECT_TRUE(positions({}).empty());
    // A step that the display is known to have.
    const std::vector<double> steps{10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.5};
    EXPECT_EQ(positions(steps), Positions{6});
    EXPECT_TRUE(positions(steps, 0.5).empty());
}

// What the message says of it: the p-value is that of G, or a larger one where rounding hides the scatter of the others.
TEST(OutlyingReadings, HaveThePValueOfGOrALargerOneForCoarseDigits) {
    std::mt19937_64 chance(11);
    std::normal_distribution<double> normal;
    std::size_t equal = 0, larger = 0;
    for (int set = 0; set < 400; ++set) {
        std::vector<double> readings(5);
        for (double& reading : readings) {
            reading = std::round(normal(chance) * (set % 2 == 0 ? 1.0 : 1000.0));
        }
        readings.back() += set % 2 == 0 ? 12.0 : 12000.0;
        for (const OutlyingReading& r : outlying_readings(readings)) {
            const double n = static_cast<double>(r.tested);
            const double left = (n - 1.0) * (n - 1.0) - n * r.G * r.G;  // 0 where all others are equal
            const boost::math::students_t distribution(n - 2.0);
            const double of_G = left < 1e-9 ? 0.0
                                            : 2.0 * n *
                                                  boost::math::cdf(boost::math::complement(
                                                      distribution, r.G * std::sqrt(n * (n - 2.0) / left)));
            EXPECT_GT(r.p_value, of_G * (1.0 - 1e-6));
            ++(r.p_value > of_G * (1.0 + 1e-6) ? larger : equal);
        }
    }
    EXPECT_GT(equal, 100U);
    EXPECT_GT(larger, 1U);
}

TEST(OutlyingReadings, DoNotDependOnTheOrderOrTheUnit) {
    std::vector<double> readings{5.00, 5.01, 4.99, 5.00, 49.99, 5.01, 4.99};
    std::sort(readings.begin(), readings.end());
    do {
        const auto found = outlying_readings(readings);
        ASSERT_EQ(found.size(), 1U);
        ASSERT_EQ(found[0].value, 49.99);
    } while (std::next_permutation(readings.begin(), readings.end()) && readings.front() < 5.0);
}

TEST(OutlyingReadings, AreOneInAHundredSetsOfGoodOnes) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    for (const int n : {3, 5, 10, 12, 20, 50}) {
        int alarms = 0;
        constexpr int k_sets = 4000;
        for (int set = 0; set < k_sets; ++set) {
            std::vector<double> readings;
            for (int i = 0; i < n; ++i) {
                readings.push_back(normal(random));
            }
            alarms += positions(readings).empty() ? 0 : 1;
        }
        EXPECT_LT(alarms, k_sets * 0.02) << n;
        EXPECT_GT(alarms, k_sets * 0.002) << n;
    }
}

TEST(OutlyingReadings, AreNotLookedForAmongWhatIsNotFinite) {
    EXPECT_THROW((void)outlying_readings(std::vector<double>{1.0, 2.0, std::numeric_limits<double>::quiet_NaN()}),
                 InputError);
}

TEST(DecimalStep, IsTheLastPlaceThatIsUsed) {
    EXPECT_EQ(decimal_step(std::vector<double>{10.01, 10.02, 3.0}), 0.01);
    EXPECT_EQ(decimal_step(std::vector<double>{100.0, 200.0}), 100.0);
    EXPECT_EQ(decimal_step(std::vector<double>{100.0, 201.0}), 1.0);
    EXPECT_EQ(decimal_step(std::vector<double>{0.0, 0.0}), 1.0);
    EXPECT_EQ(decimal_step(std::vector<double>{0.1 * 3.0}), 0.1);
    EXPECT_EQ(decimal_step(std::vector<double>{1.0 / 3.0}), 0.0);
}

/// A change of unit changes nothing: the same digits give the same outliers, with the same p-value.
TEST(OutlyingReadings, DoNotDependOnTheUnit) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    for (int set = 0; set < 200; ++set) {
        std::vector<int> digits;
        const int spread = set % 4 == 0 ? 1 : 30;
        for (int i = 0; i < 8; ++i) {
            digits.push_back(10000 + static_cast<int>(std::lround(spread * normal(random))));
        }
        digits.back() += set % 3 == 0 ? 400 : 0;
        const auto found_in = [&](int power) {
            std::vector<double> readings;
            for (const int value : digits) {
                readings.push_back(std::strtod((std::to_string(value) + "e" + std::to_string(power)).c_str(), nullptr));
            }
            return outlying_readings(readings);
        };
        const auto expected = found_in(0);
        for (const int power : {-24, -19, -15, -9, -4, -2, 3, 9}) {
            const auto found = found_in(power);
            ASSERT_EQ(found.size(), expected.size()) << "set " << set << ", power " << power;
            for (std::size_t i = 0; i < found.size(); ++i) {
                EXPECT_EQ(found[i].position, expected[i].position) << "set " << set << ", power " << power;
                EXPECT_NEAR(found[i].p_value, expected[i].p_value, 1e-6 * expected[i].p_value + 1e-12)
                    << "set " << set << ", power " << power;
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::gum
