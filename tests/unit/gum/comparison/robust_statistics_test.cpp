// Robust statistics against published numbers, brute force and their own properties.
#include "gum/comparison/robust_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::message_of;
using test::prints_as;

using Results = std::vector<double>;

// ISO 13528:2022, table E.1, the results given as "less than" left out.
const Results k_table_e1{12, 19, 20, 23, 23, 25, 25, 26, 28, 28, 28, 29, 30, 30, 31, 32, 32, 45};

// ISO 13528:2022, table E.4: atrazine in water.
const Results k_table_e4{0.04,   0.055, 0.178, 0.202,  0.206, 0.227, 0.228, 0.23,  0.23,  0.235, 0.236, 0.237,
                         0.243,  0.244, 0.245, 0.2555, 0.26,  0.264, 0.267, 0.27,  0.273, 0.274, 0.274, 0.278,
                         0.2811, 0.287, 0.287, 0.288,  0.289, 0.295, 0.296, 0.311, 0.331, 0.4246};

// ISO 13528:2022, clause E.7.
const Results k_clause_e7{0.013, 0.013, 0.0135, 0.014,  0.014, 0.016, 0.017, 0.019, 0.0239, 0.037, 0.039,
                          0.04,  0.04,  0.04,   0.0424, 0.044, 0.045, 0.045, 0.046, 0.049,  0.053};

// ISO 13528:2022, table E.10: allergen A.
const Results k_table_e10{12.95, 6.47, 11.4,  8.32,  18.88, 15.14, 10.12, 17.94, 11.68, 12.44,
                          6.93,  9.57, 11.73, 12.29, 10.95, 10.95, 11.17, 11.2,  7.64,  12.17,
                          10.71, 7.84, 20.47, 12.6,  11.37, 11.36, 10.75, 12.21, 7.49};

// Copper in wholemeal flour, data set "chem" of the R package MASS.
const Results k_copper{2.2, 2.2, 2.4, 2.4, 2.5, 2.7, 2.8, 2.9, 3.03, 3.03, 3.1,  3.37,
                       3.4, 3.4, 3.4, 3.5, 3.6, 3.7, 3.7, 3.7, 3.7,  3.77, 5.28, 28.95};

// An example computed independently, with its mean 20.418333, standard deviation 0.529783 and median 20.275.
const Results k_twelve{20.31, 20.12, 20.53, 20.24, 19.95, 20.41, 20.22, 21.96, 20.03, 20.72, 20.36, 20.17};

/// Numbers that look like results: with a common value, a few outliers and, from a coarse step, ties.
class RandomResults {
public:
    explicit RandomResults(std::uint64_t seed) : engine_(seed) {}
    [[nodiscard]] std::size_t whole(std::size_t low, std::size_t high) {
        return low + static_cast<std::size_t>(engine_() % (high - low + 1));
    }
    [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    [[nodiscard]] Results draw(std::size_t count, double step) {
        Results results;
        for (std::size_t i = 0; i < count; ++i) {
            const double bell = uniform() + uniform() + uniform() + uniform() - 2.0;
            const double value = bell * (uniform() < 0.1 ? 20.0 : 1.0);
            results.push_back(step > 0.0 ? std::round(value / step) * step : value);
        }
        return results;
    }
    void shuffle(Results& results) { std::shuffle(results.begin(), results.end(), engine_); }

private:
    std::mt19937_64 engine_;
};

/// Q method as it is written down: all differences, their distinct values, the share of pairs up to each.
double q_scale_by_definition(const Results& results) {
    std::vector<double> differences;
    double largest = 0.0;
    for (std::size_t i = 0; i < results.size(); ++i) {
        largest = std::max(largest, std::abs(results[i]));
        for (std::size_t j = 0; j < i; ++j) {
            differences.push_back(std::abs(results[i] - results[j]));
        }
    }
    std::sort(differences.begin(), differences.end());
    const double same = 8.0 * std::numeric_limits<double>::epsilon() * largest;
    const auto pairs = static_cast<double>(differences.size());
    std::vector<double> places{0.0};
    std::vector<double> shares{0.0};  // H
    for (std::size_t k = 0; k < differences.size(); ++k) {
        if (differences[k] - places.back() > same) {
            places.push_back(differences[k]);
            shares.push_back(0.0);
        }
        shares.back() = static_cast<double>(k + 1) / pairs;
    }
    const double equal = shares.front();
    const double wanted = 0.25 + 0.75 * equal;
    double low = 0.0;
    for (std::size_t k = 1; k < places.size(); ++k) {
        const double high = 0.5 * (shares[k] + shares[k - 1]);
        if (high >= wanted) {
            const double quantile = places[k - 1] + (wanted - low) / (high - low) * (places[k] - places[k - 1]);
            return quantile / (std::numbers::sqrt2 * standard_normal_quantile(0.625 + 0.375 * equal));
        }
        low = high;
    }
    return 0.0;
}

double psi(double q) {
    const double size = std::abs(q);
    const double value = size <= 1.5 ? size : (size <= 3.0 ? 1.5 : std::max(0.0, 4.5 - size));
    return std::copysign(value, q);
}

double psi_sum(const Results& results, double location, double scale) {
    double sum = 0.0;
    for (const double result : results) {
        sum += psi((result - location) / scale);
    }
    return sum;
}

/// Hampel's estimator as it is written down: all corners, a root wherever the sum changes its sign between two, and of
/// these the one nearest the median.
double hampel_by_definition(const Results& results, double scale) {
    std::vector<double> corners;
    for (const double result : results) {
        for (const double corner : {-4.5, -3.0, -1.5, 1.5, 3.0, 4.5}) {
            corners.push_back(result + corner * scale);
        }
    }
    std::sort(corners.begin(), corners.end());
    const double centre = median(results);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
        const double low = psi_sum(results, corners[k], scale);
        const double high = psi_sum(results, corners[k + 1], scale);
        if (low * high < 0.0) {
            const double root = corners[k] + (corners[k + 1] - corners[k]) * low / (low - high);
            if (std::abs(root - centre) < std::abs(nearest - centre)) {
                nearest = root;
            }
        }
    }
    return nearest;
}

double mean_of(const Results& results) {
    double sum = 0.0;
    for (const double result : results) {
        sum += result;
    }
    return sum / static_cast<double>(results.size());
}

double standard_deviation_of(const Results& results) {
    const double mean = mean_of(results);
    double squares = 0.0;
    for (const double result : results) {
        squares += (result - mean) * (result - mean);
    }
    return std::sqrt(squares / static_cast<double>(results.size() - 1));
}

// ---- published numbers ----------------------------------------------------------------------------------------------

TEST(RobustStatistics, AlgorithmAOfTwelveResults) {
    const RobustEstimate estimate = algorithm_a(k_twelve);
    EXPECT_TRUE(prints_as(estimate.location, "20.317012"));
    EXPECT_TRUE(prints_as(estimate.scale, "0.284752"));
    EXPECT_TRUE(prints_as(estimate.u, "0.102751"));
    EXPECT_TRUE(prints_as(median(k_twelve), "20.275"));
}

TEST(RobustStatistics, AlgorithmAOfIso13528) {
    // ISO 13528:2022, table E.1. The source stops when three figures stand still (5.2916); converged it is 5.2946.
    const RobustEstimate e1 = algorithm_a(k_table_e1);
    EXPECT_TRUE(prints_as(e1.location, "26.81"));
    EXPECT_TRUE(prints_as(e1.scale, "5.29"));
    EXPECT_TRUE(agrees(e1.location, 26.8125, 1e-12));
    EXPECT_TRUE(agrees(e1.scale, 5.29458866760596, 1e-12));
    EXPECT_TRUE(agrees(e1.u, 1.55993314602401, 1e-12));

    // ISO 13528:2022, table E.5.
    const RobustEstimate e3 = algorithm_a(k_table_e4);
    EXPECT_TRUE(prints_as(e3.location, "0.2570"));
    EXPECT_TRUE(prints_as(e3.scale, "0.0395"));
    EXPECT_TRUE(prints_as(e3.u, "0.0085"));
    EXPECT_TRUE(agrees(e3.location, 0.25701103928149, 1e-12));
    EXPECT_TRUE(agrees(e3.scale, 0.0395199072258653, 1e-10));  // the source stops at an absolute 1e-12

    // ISO 13528:2022, clause E.7, with the comparison of the consensus with a reference value 0.044, u = 0.0041.
    const RobustEstimate e7 = algorithm_a(k_clause_e7);
    EXPECT_TRUE(prints_as(e7.location, "0.03161"));
    EXPECT_TRUE(prints_as(e7.scale, "0.0164"));
    EXPECT_TRUE(prints_as(e7.u, "0.0045"));
    EXPECT_TRUE(prints_as(0.044 - e7.location, "0.012"));
    EXPECT_TRUE(prints_as(std::hypot(e7.u, 0.0041), "0.0061"));
    EXPECT_TRUE(agrees((0.044 - e7.location) / std::hypot(e7.u, 0.0041), 2.03875455303167, 1e-11));

    const RobustEstimate e12 = algorithm_a(k_table_e10);
    EXPECT_TRUE(agrees(e12.location, 11.1700299691972, 1e-12));
    EXPECT_TRUE(agrees(e12.scale, 2.68714617382217, 1e-12));
}

TEST(RobustStatistics, ZScoresOfTableE10FromMeanAndStandardDeviation) {
    // ISO 13528:2022, table E.10. The printed scores come from the arithmetic mean and the standard deviation.
    const char* const printed[] = {"0.427",  "-1.540", "-0.043", "-0.978", "2.228",  "1.092",  "-0.432", "1.942",
                                   "0.042",  "0.272",  "-1.400", "-0.599", "0.057",  "0.227",  "-0.180", "-0.180",
                                   "-0.113", "-0.104", "-1.185", "0.190",  "-0.253", "-1.124", "2.710",  "0.321",
                                   "-0.052", "-0.055", "-0.241", "0.203",  "-1.230"};
    const double mean = mean_of(k_table_e10);
    const double deviation = standard_deviation_of(k_table_e10);
    EXPECT_TRUE(prints_as(mean, "11.54"));
    EXPECT_TRUE(prints_as(deviation, "3.29"));
    for (std::size_t i = 0; i < k_table_e10.size(); ++i) {
        EXPECT_TRUE(prints_as((k_table_e10[i] - mean) / deviation, printed[i])) << i + 1;
    }
}

TEST(RobustStatistics, MedianMadeQuartilesAndQHampelOfTableE5) {
    EXPECT_TRUE(prints_as(median(k_table_e4), "0.2620"));
    EXPECT_TRUE(prints_as(normalised_interquartile_range(k_table_e4), "0.0402"));
    EXPECT_TRUE(agrees(normalised_interquartile_range(k_table_e4), 0.0402340575, 1e-12));
    const RobustEstimate made = median_with_made(k_table_e4);
    EXPECT_TRUE(prints_as(made.location, "0.2620"));
    EXPECT_TRUE(prints_as(made.scale, "0.0386"));
    // Printed from MADe of the published table: 1.25 · 0.038558/√34 = 0.008266; the 0.0086 belongs to nIQR.
    EXPECT_TRUE(prints_as(1.25 * normalised_interquartile_range(k_table_e4) / std::sqrt(34.0), "0.0086"));
    EXPECT_TRUE(agrees(made.u, 1.25 * 0.038558 / std::sqrt(34.0), 1e-12));

    const RobustEstimate q = q_hampel(k_table_e4);
    EXPECT_TRUE(prints_as(q.location, "0.2600"));
    EXPECT_TRUE(prints_as(q.scale, "0.0426"));
    EXPECT_TRUE(prints_as(q.u, "0.0091"));
    EXPECT_TRUE(agrees(q.scale, 0.0425662494783085, 1e-12));
    EXPECT_TRUE(agrees(q.location, 0.2599838615233, 1e-12));

    // The classical numbers of the same table.
    EXPECT_TRUE(prints_as(mean_of(k_table_e4), "0.2512"));
    EXPECT_TRUE(prints_as(standard_deviation_of(k_table_e4), "0.0672"));
    Results trimmed = k_table_e4;  // without 0.04, 0.055 and 0.4246
    trimmed.erase(trimmed.begin(), trimmed.begin() + 2);
    trimmed.pop_back();
    EXPECT_TRUE(prints_as(mean_of(trimmed), "0.2588"));
    EXPECT_TRUE(prints_as(standard_deviation_of(trimmed), "0.0337"));
    EXPECT_TRUE(prints_as(standard_deviation_of(trimmed) / std::sqrt(31.0), "0.0061"));
}

TEST(RobustStatistics, HuberProposalTwoOfCopper) {
    // R package MASS; the source cuts the location after five places (3.205498 → 3.20549).
    EXPECT_TRUE(prints_as(mean_of(k_copper), "4.2804"));
    EXPECT_TRUE(prints_as(median(k_copper), "3.385"));
    EXPECT_TRUE(prints_as(median_with_made(k_copper).scale / 1.483 / 0.674489750196082, "0.52632"));
    const RobustEstimate exact = algorithm_a(k_copper, AlgorithmAConstants::exact);
    EXPECT_NEAR(exact.location, 3.20549, 1e-5);
    EXPECT_TRUE(prints_as(exact.scale, "0.67365"));
    EXPECT_TRUE(agrees(exact.location, 3.20549808182744, 1e-11));
    EXPECT_TRUE(agrees(exact.scale, 0.673652600067877, 1e-11));
    const RobustEstimate published = algorithm_a(k_copper);
    EXPECT_TRUE(agrees(published.location, 3.20556592273093, 1e-11));
    EXPECT_TRUE(agrees(published.scale, 0.674150100027761, 1e-11));
}

TEST(RobustStatistics, AlgorithmSFactorsArePrintedOnes) {
    // ISO 13528:2022, annex C, table of the factors. It has 1.024 for 6 and 1.017 for 10 degrees of freedom, where the
    // chi-square distribution gives 1.02342 and 1.01637.
    const struct {
        double degrees_of_freedom;
        const char* limit;
        const char* adjustment;
    } printed[] = {{1, "1.645", "1.097"}, {2, "1.517", "1.054"},   {3, "1.444", "1.039"}, {4, "1.395", "1.032"},
                   {5, "1.359", "1.027"}, {6, "1.332", "1.02342"}, {7, "1.310", "1.021"}, {8, "1.292", "1.019"},
                   {9, "1.277", "1.018"}, {10, "1.264", "1.01637"}};
    for (const auto& line : printed) {
        const AlgorithmSFactors factors = algorithm_s_factors(line.degrees_of_freedom);
        EXPECT_TRUE(prints_as(factors.limit, line.limit)) << line.degrees_of_freedom;
        EXPECT_TRUE(prints_as(factors.adjustment, line.adjustment)) << line.degrees_of_freedom;
    }
}

TEST(RobustStatistics, AlgorithmsAAndSOfTableE11) {
    // ISO 13528:2022, table E.11: averages and standard deviations of four replicates each.
    const Results averages{2.15, 1.85, 1.8, 1.8,  1.9,  1.9,  1.9, 2.05, 2.35, 2.03, 2.08, 1.25, 1.13,
                           1.0,  1.08, 1.2, 1.35, 1.23, 1.23, 0.9, 1.48, 1.2,  1.73, 1.43, 1.28};
    const Results deviations{0.13, 0.21, 0.08, 0.24, 0.36, 0.32, 0.14, 0.26, 0.39, 0.53, 0.25, 0.24, 0.72,
                             0.26, 0.17, 0.32, 0.4,  0.36, 0.33, 0.43, 0.4,  0.55, 0.39, 0.3,  0.22};
    const RobustEstimate mean = algorithm_a(averages);
    EXPECT_TRUE(prints_as(mean.location, "1.57"));
    EXPECT_TRUE(agrees(mean.location, 1.56864266983233, 1e-12));
    EXPECT_TRUE(prints_as(algorithm_s(deviations, 3.0), "0.34"));
    // With the factors as printed.
    EXPECT_TRUE(agrees(algorithm_s(deviations, AlgorithmSFactors{.limit = 1.444, .adjustment = 1.039}), 0.3395831714473,
                       1e-12));
}

TEST(RobustStatistics, KernelModeOfClauseE6) {
    // ISO 13528:2022, clause E.6: coliforms.
    const Results results{3.8,  3.9,  3.07, 3.64, 4.06, 3.4,  3.59, 3.39, 3.47, 3.47, 3.77, 3.53,
                          2.83, 2.75, 2.06, 3.75, 3.73, 3.82, 3.86, 3.88, 3.97, 3.96, 3.8,  3.88,
                          3.25, 3.45, 3.64, 2.86, 3.17, 3.19, 3.17, 4.22, 3.82, 3.82, 3.95};
    EXPECT_TRUE(prints_as(kernel_density_mode(results, 0.1875), "3.79"));
    EXPECT_TRUE(agrees(kernel_density_mode(results, 0.1875), 3.79334488865561, 1e-5));
}

// ---- against brute force --------------------------------------------------------------------------------------------

TEST(RobustStatistics, QHampelIsWhatItsDefinitionSays) {
    RandomResults random(20260601);
    for (int set = 0; set < 400; ++set) {
        // A step of 1/8 is exact in binary; 0.1 is not, and equal differences then differ by rounding.
        const double step = set % 4 == 0 ? 0.125 : (set % 4 == 1 ? 0.1 : (set % 4 == 2 ? 0.5 : 0.0));
        Results results = random.draw(random.whole(2, 60), step);
        if (std::adjacent_find(results.begin(), results.end(), std::not_equal_to<>()) == results.end()) {
            continue;
        }
        for (double& result : results) {
            result += set % 3 == 0 ? 100.0 : 0.0;
        }
        const RobustEstimate estimate = q_hampel(results);
        ASSERT_TRUE(agrees(estimate.scale, q_scale_by_definition(results), 1e-12)) << set;
        ASSERT_NEAR(psi_sum(results, estimate.location, estimate.scale), 0.0, 1e-9) << set;
        const double by_definition = hampel_by_definition(results, estimate.scale);
        const double centre = median(results);
        // Where two roots are as near, the median itself is the estimate.
        ASSERT_LE(std::abs(estimate.location - centre), std::abs(by_definition - centre) + 1e-9 * estimate.scale);
        if (std::abs(psi_sum(results, centre, estimate.scale)) > 1e-9 && estimate.location != centre) {
            ASSERT_NEAR(estimate.location, by_definition, 1e-9 * estimate.scale) << set;
        }
    }
}

TEST(RobustStatistics, HampelTakesTheRootNearestTheMedian) {
    // Seven results and a far group of five: the sum of ψ has a root in each, and one between them.
    const Results results{1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 101.0, 101.1, 101.2, 101.3, 101.4};
    const RobustEstimate estimate = q_hampel(results);
    EXPECT_GE(estimate.scale, 0.1);
    EXPECT_TRUE(agrees(estimate.location, hampel_by_definition(results, estimate.scale), 1e-12));
    // Two equal groups: the median between them is as near to the one as to the other.
    Results two;
    for (int i = 0; i < 20; ++i) {
        two.push_back(i);
        two.push_back(10000.0 - i);
    }
    EXPECT_DOUBLE_EQ(q_hampel(two).location, 5000.0);
}

// The law: where the location is taken as a value, at least half of the results lie within reach of ψ. Two groups of six
// gave the middle between them with a u of 0.06, and every result a signal.
TEST(RobustStatistics, HampelIsSupportedByHalfOfTheResults) {
    const Results apart{9.9, 9.95, 10.0, 10.05, 10.1, 10.02, 13.9, 13.95, 14.0, 14.05, 14.1, 14.02};
    EXPECT_EQ(test::code_of<NoResultError>([&] { (void)supported_q_hampel(apart); }), "GC-GUM-0144");
    Results seven = apart;
    seven.push_back(10.01);
    EXPECT_NEAR(supported_q_hampel(seven).location, 10.0, 0.1);
    RandomResults random(11);
    for (int set = 0; set < 200; ++set) {
        Results results = random.draw(random.whole(4, 40), 0.0);
        for (std::size_t i = 0; i < results.size(); ++i) {
            results[i] += i % 2 == 0 ? 0.1 * set : 0.0;
        }
        try {
            const RobustEstimate estimate = supported_q_hampel(results);
            const auto within = std::count_if(results.begin(), results.end(), [&](double result) {
                return std::abs(result - estimate.location) <= 4.5 * estimate.scale * (1.0 + 1e-12);
            });
            EXPECT_GE(2 * static_cast<std::size_t>(within), results.size()) << set;
        } catch (const NoResultError&) {
            EXPECT_GT(set, 20) << "one group has a value";
        }
    }
}

TEST(RobustStatistics, KernelModeIsTheHighestPlaceOfTheDensity) {
    RandomResults random(7);
    for (int set = 0; set < 40; ++set) {
        const Results results = random.draw(random.whole(1, 40), 0.0);
        const double bandwidth = 0.02 + random.uniform();
        const auto density = [&](double x) {
            double height = 0.0;
            for (const double result : results) {
                height += std::exp(-0.5 * (x - result) * (x - result) / (bandwidth * bandwidth));
            }
            return height;
        };
        const double found = density(kernel_density_mode(results, bandwidth));
        const double low = *std::min_element(results.begin(), results.end());
        const double high = *std::max_element(results.begin(), results.end());
        for (int i = 0; i <= 4000; ++i) {
            ASSERT_GE(found * (1.0 + 1e-12), density(low + (high - low) * i / 4000.0)) << set;
        }
    }
    EXPECT_EQ(kernel_density_mode(Results{4.25}, 0.1), 4.25);
    EXPECT_NEAR(kernel_density_mode(Results{1.0, 2.0}, 1.0), 1.5, 1e-12);
    EXPECT_NEAR(kernel_density_mode(Results{1.0, 200.0}, 0.5), 1.0, 1e-12);  // equally high: the lowest
    EXPECT_NEAR(kernel_density_mode(Results{1e300, 2.0, 2.0, -1e300}, 1e-3), 2.0, 1e-12);
}

TEST(RobustStatistics, AlgorithmAIsAFixedPoint) {
    RandomResults random(99);
    for (int set = 0; set < 200; ++set) {
        const Results results = random.draw(random.whole(3, 80), 0.0);
        const RobustEstimate estimate = algorithm_a(results);
        Results drawn;
        for (const double result : results) {
            drawn.push_back(
                std::clamp(result, estimate.location - 1.5 * estimate.scale, estimate.location + 1.5 * estimate.scale));
        }
        ASSERT_NEAR(mean_of(drawn), estimate.location, 1e-11 * estimate.scale) << set;
        ASSERT_TRUE(agrees(1.134 * standard_deviation_of(drawn), estimate.scale, 1e-11)) << set;
    }
}

// ---- properties -----------------------------------------------------------------------------------------------------

void expect_moved(const RobustEstimate& moved, const RobustEstimate& estimate, double shift, double factor) {
    // The results themselves are rounded when they are moved.
    const double tolerance = 1e-11 * std::abs(factor) * estimate.scale + 1e-14 * std::abs(shift);
    EXPECT_NEAR(moved.location, shift + factor * estimate.location, tolerance);
    EXPECT_NEAR(moved.scale, std::abs(factor) * estimate.scale, tolerance);
    EXPECT_NEAR(moved.u, std::abs(factor) * estimate.u, tolerance);
}

TEST(RobustStatistics, MovesAndScalesWithItsResults) {
    RandomResults random(4711);
    for (int set = 0; set < 100; ++set) {
        const Results results = random.draw(random.whole(4, 50), set % 2 == 0 ? 0.0 : 0.05);
        const double shift = std::round(2000.0 * (random.uniform() - 0.5));
        const double factor = (random.uniform() + 0.1) * (set % 3 == 0 ? -1.0 : 1.0);
        Results moved = results;
        for (double& result : moved) {
            result = shift + factor * result;
        }
        if (median_with_made(results).scale > 0.0) {
            expect_moved(algorithm_a(moved), algorithm_a(results), shift, factor);
            expect_moved(algorithm_a(moved, AlgorithmAConstants::exact),
                         algorithm_a(results, AlgorithmAConstants::exact), shift, factor);
        }
        expect_moved(q_hampel(moved), q_hampel(results), shift, factor);
        expect_moved(median_with_made(moved), median_with_made(results), shift, factor);
        const double range = normalised_interquartile_range(results);
        EXPECT_NEAR(normalised_interquartile_range(moved), std::abs(factor) * range, 1e-11 + 1e-11 * range);
        EXPECT_NEAR(kernel_density_mode(moved, 0.3 * std::abs(factor)),
                    shift + factor * kernel_density_mode(results, 0.3), 1e-8);
        ASSERT_FALSE(::testing::Test::HasFailure()) << "set " << set;
    }
}

TEST(RobustStatistics, DoesNotDependOnTheOrderOfTheResults) {
    RandomResults random(31);
    for (int set = 0; set < 50; ++set) {
        const Results results = random.draw(random.whole(5, 60), 0.0);
        Results shuffled = results;
        random.shuffle(shuffled);
        // To the last bit.
        ASSERT_EQ(median(shuffled), median(results));
        ASSERT_EQ(algorithm_a(shuffled).location, algorithm_a(results).location);
        ASSERT_EQ(algorithm_a(shuffled).scale, algorithm_a(results).scale);
        ASSERT_EQ(q_hampel(shuffled).location, q_hampel(results).location);
        ASSERT_EQ(q_hampel(shuffled).scale, q_hampel(results).scale);
        ASSERT_EQ(normalised_interquartile_range(shuffled), normalised_interquartile_range(results));
        ASSERT_EQ(kernel_density_mode(shuffled, 0.2), kernel_density_mode(results, 0.2));
    }
}

TEST(RobustStatistics, KeepsTheStandardDeviationOfANormalDistribution) {
    Results results;
    constexpr int count = 10001;
    for (int i = 0; i < count; ++i) {
        results.push_back(5.0 + 2.0 * standard_normal_quantile((i + 0.5) / count));
    }
    EXPECT_NEAR(algorithm_a(results).scale, 2.0, 2e-3);
    EXPECT_NEAR(algorithm_a(results, AlgorithmAConstants::exact).scale, 2.0, 1e-3);
    EXPECT_NEAR(q_hampel(results).scale, 2.0, 1e-3);
    EXPECT_NEAR(median_with_made(results).scale, 2.0, 2e-3);
    EXPECT_NEAR(normalised_interquartile_range(results), 2.0, 1e-3);
    EXPECT_NEAR(algorithm_a(results).location, 5.0, 1e-12);
    EXPECT_NEAR(q_hampel(results).location, 5.0, 1e-12);
}

// ---- edges ----------------------------------------------------------------------------------------------------------

TEST(RobustStatistics, TwoResults) {
    // Nothing is drawn in: mean, and 1.134 times the standard deviation.
    const RobustEstimate a = algorithm_a(Results{1.0, 3.0});
    EXPECT_TRUE(agrees(a.location, 2.0, 1e-15));
    EXPECT_TRUE(agrees(a.scale, 1.134 * std::numbers::sqrt2, 1e-14));
    const RobustEstimate q = q_hampel(Results{1.0, 3.0});
    EXPECT_TRUE(agrees(q.location, 2.0, 1e-15));
    EXPECT_TRUE(agrees(q.scale, 1.0 / (std::numbers::sqrt2 * standard_normal_quantile(0.625)), 1e-14));
    EXPECT_TRUE(agrees(median_with_made(Results{1.0, 3.0}).scale, 1.483, 1e-15));
    EXPECT_TRUE(agrees(normalised_interquartile_range(Results{1.0, 3.0}), 0.7413, 1e-15));
}

TEST(RobustStatistics, TooFewResults) {
    EXPECT_EQ(code_of<InputError>([] { return median({}); }), "GC-GUM-0100");
    EXPECT_EQ(code_of<InputError>([] { return kernel_density_mode({}, 1.0); }), "GC-GUM-0100");
    EXPECT_EQ(code_of<InputError>([] { return algorithm_s({}, 3.0); }), "GC-GUM-0100");
    EXPECT_EQ(median(Results{7.5}), 7.5);
    const Results one{7.5};
    EXPECT_EQ(code_of<InputError>([&] { return algorithm_a(one); }), "GC-GUM-0101");
    EXPECT_EQ(code_of<InputError>([&] { return q_hampel(one); }), "GC-GUM-0101");
    EXPECT_EQ(code_of<InputError>([&] { return median_with_made(one); }), "GC-GUM-0101");
    EXPECT_EQ(code_of<InputError>([&] { return normalised_interquartile_range(one); }), "GC-GUM-0101");
    EXPECT_EQ(message_of<InputError>([&] { return algorithm_a(one); }),
              "results — 1 — a robust standard deviation needs at least 2 results — Give more results, or state the "
              "uncertainty another way.");
}

TEST(RobustStatistics, EqualResultsHaveNoScale) {
    const Results most_equal{5.0, 5.0, 5.0, 5.0, 6.0, 4.9, 7.0};
    EXPECT_EQ(median_with_made(most_equal).scale, 0.0);
    // Algorithm A begins with the standard deviation then; by the steps of the algorithm in double precision.
    EXPECT_TRUE(agrees(algorithm_a(most_equal).location, 5.313698586654404, 1e-12));
    EXPECT_TRUE(agrees(algorithm_a(most_equal).scale, 0.6547943466176148, 1e-12));
    EXPECT_TRUE(agrees(algorithm_a(Results{10.0, 10.0, 10.0, 10.1, 9.9}).scale, 0.0801859089865542, 1e-12));
    // One of ten that is off is drawn in to the others, and no scale is left.
    const Results all_but_one{5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 6.0};
    EXPECT_EQ(
        message_of<InputError>([&] { return algorithm_a(all_but_one); }),
        "algorithm A — more than half of 10 results are equal, and the others too few or too far away to make a "
        "scale — a robust standard deviation greater than 0 is needed — Take a value and a limit that need no such "
        "scale (sigma_pt or delta_E), use the Q method with "
        "Hampel's estimator, or give the results with more digits.");
    // The Q method, which would be no help, is no advice where all are equal.
    for (const Results& equal : {Results{5.0, 5.0, 5.0}, Results{0.3, 0.1 + 0.2, 0.3}}) {
        EXPECT_EQ(
            message_of<InputError>([&] { return algorithm_a(equal); }),
            "algorithm A — all 3 results are equal: the scale is 0 — a robust standard deviation greater than 0 is "
            "needed — Take a value and a limit that need no such scale (sigma_pt or delta_E), or give the results "
            "with more digits.");
    }
    // Nor where it would be refused: the results that are not equal are two groups far away from each other.
    Results groups;
    for (int i = 0; i < 12; ++i) {
        groups.push_back(i < 7 ? 10.0 : 1000.0 + i);
    }
    for (const Results& results : {most_equal, groups}) {
        std::string refusal;
        try {
            (void)algorithm_a(results);
            continue;
        } catch (const InputError& refused) {
            refusal = refused.diagnostics().front().action;
        }
        bool has_q = true;
        try {
            (void)supported_q_hampel(results);
        } catch (const DiagnosedError&) {
            has_q = false;
        }
        EXPECT_EQ(refusal.find("Q method") != std::string::npos, has_q);
    }
    // The Q method has a scale as long as not all results are equal.
    const RobustEstimate q = q_hampel(most_equal);
    EXPECT_GT(q.scale, 0.0);
    EXPECT_TRUE(agrees(q.scale, q_scale_by_definition(most_equal), 1e-12));
    EXPECT_EQ(code_of<InputError>([] { return q_hampel(Results{5.0, 5.0, 5.0}); }), "GC-GUM-0102");
    // Numbers that differ by their rounding only are equal.
    EXPECT_EQ(code_of<InputError>([] { return q_hampel(Results{0.3, 0.1 + 0.2, 0.3}); }), "GC-GUM-0102");
    EXPECT_EQ(code_of<InputError>([] { return algorithm_s(Results{0.0, 0.0, 0.1}, 3.0); }), "GC-GUM-0102");
}

TEST(RobustStatistics, AlgorithmAWithHalfOfTheResultsEqual) {
    // Just enough to begin with: the scale starts small and grows to that of all results.
    const RobustEstimate estimate = algorithm_a(Results{5, 5, 5, 5, 5, 5.0 + 1e-9, 6, 7, 8, 9, 10, 11});
    EXPECT_TRUE(agrees(estimate.location, 6.688163040231156, 1e-12));
    EXPECT_TRUE(agrees(estimate.scale, 2.3798622943618044, 1e-12));
}

TEST(RobustStatistics, MedianBetweenTwoNumbersThatHaveNoneBetweenThem) {
    // Around 2^20 doubles are 2^-32 apart. In this unit: 0, 1, 2, 7, the median 1.5, the deviations 0.5, 0.5, 1.5, 5.5.
    const double unit = std::exp2(-32.0), offset = std::exp2(20.0);
    const Results results{offset, offset + unit, offset + 2.0 * unit, offset + 7.0 * unit};
    EXPECT_EQ(median_with_made(results).scale, 1.483 * unit);
}

TEST(RobustStatistics, AlgorithmAConvergesSlowlyToAllItsDigits) {
    // mpmath, 60 digits, steps below 1e-30 of s*. A last step of 1e-13 would leave 1e-12.
    const RobustEstimate estimate = algorithm_a(
        Results{2.781630609621508, 24.914485609490853, 3.934221569692331, 3.012632451018527, 1.8655443183342246});
    EXPECT_TRUE(agrees(estimate.location, 3.90955902305789654, 1e-14));
    EXPECT_TRUE(agrees(estimate.scale, 2.69613809570999687, 1e-14));
    EXPECT_TRUE(agrees(estimate.u, 1.50718701468359678, 1e-14));
}

TEST(RobustStatistics, AlgorithmSOfDeviationsThatScatterMoreThanTheirDegreesOfFreedomAllow) {
    // mpmath, 40 digits, S1 and S2 steps of the algorithm until they stand still.
    EXPECT_TRUE(agrees(algorithm_s(Results{0.7, 1.2, 0.4, 1.6, 0.9, 1.1, 0.6, 1.3, 1.0, 0.8}, 999.0),
                       0.585723139847433211, 1e-13));
    EXPECT_TRUE(agrees(algorithm_s(Results{0.3, 1.2, 0.1, 1.6, 0.9, 1.1, 0.2, 1.3, 1.0, 0.05}, 999.0),
                       0.0738845389028077869, 1e-13));
    // Two of five are 0: the steps lead to 0, though the median is 1.
    EXPECT_EQ(code_of<InputError>([] { return algorithm_s(Results{0.0, 0.0, 1.0, 1.0, 1.0}, 999.0); }), "GC-GUM-0102");
    EXPECT_TRUE(agrees(algorithm_s(Results{0.25, 0.25, 0.25}, 3.0), 0.25 * algorithm_s_factors(3.0).adjustment, 1e-15));
}

TEST(RobustStatistics, AlgorithmSNeedsFactorsThatExist) {
    EXPECT_EQ(code_of<InputError>([] { return algorithm_s_factors(1e11); }), "GC-GUM-0005");
    EXPECT_EQ(code_of<InputError>([] { return algorithm_s_factors(1e-6); }), "GC-GUM-0001");
    EXPECT_GT(algorithm_s_factors(1e9).limit, 1.0);
    const AlgorithmSFactors too_small{.limit = 0.9, .adjustment = 1.1};
    EXPECT_EQ(code_of<InputError>([&] { return algorithm_s(Results{1.0, 2.0}, too_small); }), "GC-GUM-0003");
}

TEST(RobustStatistics, OneResultInAWrongUnitDoesNotBlurTheOthers) {
    // mpmath, 60 digits, of the decimal numbers; the eight good results have ties among their differences.
    const Results farad{4.701e-12, 4.703e-12, 4.698e-12, 4.695e-12, 4.702e-12, 4.704e-12, 4.699e-12, 4.700e-12, 4.7};
    const RobustEstimate capacitance = q_hampel(farad);
    EXPECT_TRUE(agrees(capacitance.location, 4.70025e-12, 1e-15));
    EXPECT_TRUE(agrees(capacitance.scale, 4.66020337856865917e-15, 1e-12));
    const RobustEstimate far = q_hampel(Results{1.01, 1.03, 0.98, 0.95, 1.02, 1.04, 0.99, 1.0, 1e12});
    EXPECT_TRUE(agrees(far.location, 1.0025, 1e-15));
    EXPECT_TRUE(agrees(far.scale, 0.0466020337856865917, 1e-13));
}

TEST(RobustStatistics, RefusesNumbersThatAreNotFinite) {
    const Results results{1.0, 2.0, std::nan(""), 4.0};
    const Results infinite{1.0, 2.0, std::numeric_limits<double>::infinity()};
    EXPECT_EQ(code_of<InputError>([&] { return median(results); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([&] { return algorithm_a(results); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([&] { return q_hampel(infinite); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([&] { return algorithm_s(results, 3.0); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([] { return algorithm_s(Results{-1.0, 2.0, 3.0}, 3.0); }), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([&] { return kernel_density_mode(infinite, 1.0); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([] { return kernel_density_mode(Results{1.0, 2.0}, 0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { return algorithm_s_factors(0.0); }), "GC-GUM-0003");
    EXPECT_NE(message_of<InputError>([&] { return median(results); }).find("result 3"), std::string::npos);
}

TEST(RobustStatistics, HugeAndTinyNumbers) {
    for (const double factor : {1e250, 1e-250, 1e300, 1e-300}) {
        Results results = k_twelve;
        for (double& result : results) {
            result *= factor;
        }
        EXPECT_TRUE(agrees(algorithm_a(results).scale / factor, algorithm_a(k_twelve).scale, 1e-12)) << factor;
        EXPECT_TRUE(agrees(algorithm_a(results).location / factor, algorithm_a(k_twelve).location, 1e-14)) << factor;
        EXPECT_TRUE(agrees(q_hampel(results).scale / factor, q_hampel(k_twelve).scale, 1e-11)) << factor;
        EXPECT_TRUE(agrees(q_hampel(results).location / factor, q_hampel(k_twelve).location, 1e-13)) << factor;
    }
    // Differences that no double holds: refused, not wrong.
    const double most = std::numeric_limits<double>::max();
    EXPECT_EQ(code_of<InputError>([&] { return q_hampel(Results{-most, most}); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([&] { return algorithm_a(Results{-most, most}); }), "GC-GUM-0001");
}

}  // namespace
}  // namespace gumcert::gum
