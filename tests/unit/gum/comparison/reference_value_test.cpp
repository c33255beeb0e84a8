// Weighted mean, consistency test, degrees of equivalence: published and independently computed figures, and what is
// refused.
#include "gum/comparison/reference_value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
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
using ::testing::HasSubstr;

Eigen::VectorXd to_vector(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

LaboratoryResults laboratory_results(const std::vector<double>& x, const std::vector<double>& u) {
    return {.x = to_vector(x), .u = to_vector(u)};
}

LaboratoryResults with_correlation(LaboratoryResults of, Eigen::Index i, Eigen::Index j, double r) {
    if (of.covariance.size() == 0) {
        of.covariance = of.u.array().square().matrix().asDiagonal();
    }
    of.covariance(i, j) = r * of.u(i) * of.u(j);
    of.covariance(j, i) = of.covariance(i, j);
    return of;
}

/// Key comparison of golden vector 6.
LaboratoryResults key_comparison_results() {
    return laboratory_results({12.31, 12.18, 12.42, 12.25, 12.95, 12.05}, {0.10, 0.15, 0.20, 0.12, 0.15, 0.30});
}

TEST(ReferenceValue, GoldenVectorSixOfAKeyComparison) {
    const LaboratoryResults labs = key_comparison_results();
    const ReferenceValue mean = weighted_mean(labs);
    EXPECT_TRUE(prints_as(mean.value, "12.37236"));
    EXPECT_TRUE(prints_as(mean.u, "0.05828"));
    const ConsistencyTest consistency = consistency_test(labs);
    EXPECT_TRUE(prints_as(consistency.chi_square, "19.1142"));
    EXPECT_EQ(consistency.degrees_of_freedom, 5u);
    EXPECT_TRUE(prints_as(consistency.critical_value, "11.0705"));
    EXPECT_TRUE(prints_as(consistency.p_value, "0.00183"));
    EXPECT_FALSE(consistency.consistent);
    EXPECT_TRUE(prints_as(consistency.birge_ratio, "1.9552"));
    EXPECT_TRUE(agrees(consistency.birge_limit, std::sqrt(1.0 + std::sqrt(8.0 / 5.0)), 1e-15));

    const DegreesOfEquivalence degrees = degrees_of_equivalence(labs, mean);
    const std::vector<std::string_view> en = {"-0.384", "-0.696", "0.125", "-0.583", "2.090", "-0.548"};
    for (Eigen::Index i = 0; i < 6; ++i) {
        EXPECT_TRUE(prints_as(degrees.d(i) / (2.0 * degrees.u(i)), en[static_cast<std::size_t>(i)])) << i;
        EXPECT_TRUE(agrees(degrees.u(i), std::sqrt(labs.u(i) * labs.u(i) - mean.u * mean.u), 1e-13)) << i;
        EXPECT_TRUE(agrees(degrees.correlation(i), mean.u / labs.u(i), 1e-13)) << i;
    }
    // What the plus sign would have made of laboratory 5.
    EXPECT_TRUE(prints_as(degrees.d(4) / (2.0 * std::hypot(labs.u(4), mean.u)), "1.795"));
}

TEST(ReferenceValue, LaboratoryOutsideTheMeanTakesThePlusSign) {
    const LaboratoryResults labs = key_comparison_results();
    const std::vector<std::size_t> members = {0, 1, 2, 3, 5};
    const ReferenceValue mean = spread_weights(weighted_mean(selected_results(labs, members)), members, 6);
    EXPECT_EQ(mean.weights(4), 0.0);
    const DegreesOfEquivalence degrees = degrees_of_equivalence(labs, mean);
    EXPECT_TRUE(agrees(degrees.u(4), std::hypot(labs.u(4), mean.u), 1e-14));
    EXPECT_EQ(degrees.correlation(4), 0.0);
    EXPECT_TRUE(prints_as(degrees.d(4) / (2.0 * degrees.u(4)), "2.090"));  // as inside with the minus sign
    EXPECT_TRUE(agrees(degrees.u(0), std::sqrt(0.01 - mean.u * mean.u), 1e-13));
}

// Cox 2002, Metrologia 39, 589-595, procedure A, applied to five results (published example, secondary source): printed
// 43877 and 53. The degrees of equivalence were computed with NumPy.
TEST(ReferenceValue, ProcedureAForFiveLaboratories) {
    const LaboratoryResults labs =
        laboratory_results({43772.0, 43910.0, 43947.0, 43910.0, 43900.0}, {97.0, 100.0, 104.5, 160.0, 280.0});
    const ReferenceValue mean = weighted_mean(labs);
    EXPECT_TRUE(prints_as(mean.value, "43877"));
    EXPECT_TRUE(prints_as(mean.u, "53"));
    EXPECT_TRUE(agrees(mean.value, 43877.3803892326, 1e-14));
    EXPECT_TRUE(agrees(mean.u, 53.477326169271, 1e-13));
    const ConsistencyTest consistency = consistency_test(labs, 0.05);
    EXPECT_TRUE(agrees(consistency.chi_square, 1.77859404317893, 1e-13));
    EXPECT_TRUE(agrees(consistency.p_value, 0.77639628860821, 1e-12));
    EXPECT_TRUE(consistency.consistent);

    const DegreesOfEquivalence degrees = degrees_of_equivalence(labs, mean);
    const std::vector<double> d = {-105.380389232552, 32.6196107674477, 69.6196107674477, 32.6196107674477,
                                   22.6196107674477};
    const std::vector<double> U = {161.853953745782, 168.999119356113, 179.559745887383, 301.596920314418,
                                   549.691461042594};
    const std::vector<double> en = {0.651083194409137, 0.193016454119575, 0.387723932351252, 0.108156312516193,
                                    0.0411496491587214};
    for (Eigen::Index i = 0; i < 5; ++i) {
        const auto at = static_cast<std::size_t>(i);
        EXPECT_TRUE(agrees(degrees.d(i), d[at], 1e-12)) << i;
        EXPECT_TRUE(agrees(2.0 * degrees.u(i), U[at], 1e-13)) << i;
        EXPECT_TRUE(agrees(std::abs(degrees.d(i)) / (2.0 * degrees.u(i)), en[at], 1e-12)) << i;
    }
    const PairDifference pair = pair_difference(labs, 0, 1);
    EXPECT_EQ(pair.d, -138.0);
    EXPECT_TRUE(agrees(2.0 * pair.u, 278.632374285545, 1e-14));
}

// Two results of equal u with r = 0.5, one independent: by hand. V⁻¹1 = (2/3, 2/3, 1)/u², total 7/3.
TEST(ReferenceValue, GeneralisedWeightedMeanByHand) {
    const LaboratoryResults labs = with_correlation(laboratory_results({1.0, 3.0, 5.0}, {0.3, 0.3, 0.3}), 0, 1, 0.5);
    const ReferenceValue mean = weighted_mean(labs);
    EXPECT_TRUE(agrees(mean.weights(0), 2.0 / 7.0, 1e-14));
    EXPECT_TRUE(agrees(mean.weights(2), 3.0 / 7.0, 1e-14));
    EXPECT_TRUE(agrees(mean.value, (2.0 + 6.0 + 15.0) / 7.0, 1e-14));
    EXPECT_TRUE(agrees(mean.u, 0.3 * std::sqrt(3.0 / 7.0), 1e-14));
    // Chi-square by the inverse matrix.
    const Eigen::VectorXd residuals = labs.x.array() - mean.value;
    EXPECT_TRUE(agrees(consistency_test(labs).chi_square, residuals.dot(labs.covariance.inverse() * residuals), 1e-13));
    const PairDifference pair = pair_difference(labs, 1, 0);
    EXPECT_TRUE(agrees(pair.u, 0.3, 1e-14));
    // cov(x_i, y) = u²(y) for every laboratory of a generalised weighted mean.
    const DegreesOfEquivalence degrees = degrees_of_equivalence(labs, mean);
    for (Eigen::Index i = 0; i < 3; ++i) {
        EXPECT_TRUE(agrees(degrees.u(i), std::sqrt(0.09 - mean.u * mean.u), 1e-13));
        EXPECT_TRUE(agrees(degrees.correlation(i), mean.u / 0.3, 1e-13));
    }
}

TEST(ReferenceValue, StrongCorrelationGivesANegativeWeight) {
    const ReferenceValue mean =
        weighted_mean(with_correlation(laboratory_results({10.0, 11.0}, {1.0, 3.0}), 0, 1, 0.9));
    EXPECT_LT(mean.weights(1), 0.0);
    EXPECT_LT(mean.value, 10.0);
    EXPECT_TRUE(agrees(mean.weights.sum(), 1.0, 1e-14));
}

TEST(ReferenceValue, CommonOffsetCostsNoDigits) {
    // 2^30 is a number of which all sums with multiples of 2^-10 are exact.
    const double offset = 1073741824.0;
    const std::vector<double> x = {0.25, 0.5, 0.3125, 0.75, 0.4375};
    const std::vector<double> u = {0.01, 0.02, 0.015, 0.01, 0.03};
    std::vector<double> shifted = x;
    for (double& value : shifted) {
        value += offset;
    }
    const LaboratoryResults near = laboratory_results(x, u);
    const LaboratoryResults far = laboratory_results(shifted, u);
    EXPECT_EQ(consistency_test(near).chi_square, consistency_test(far).chi_square);
    EXPECT_EQ(weighted_mean(near).u, weighted_mean(far).u);
    const DegreesOfEquivalence a = degrees_of_equivalence(near, weighted_mean(near));
    const DegreesOfEquivalence b = degrees_of_equivalence(far, weighted_mean(far));
    EXPECT_LT((a.d - b.d).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(arithmetic_mean(near.x).u, arithmetic_mean(far.x).u);
}

TEST(ReferenceValue, UncertaintiesOverTwelveDecades) {
    const LaboratoryResults labs = laboratory_results({1.0, 1.0 + 2e-6, 1.5, 30.0, 4e5}, {1e-6, 2e-6, 1.0, 1e3, 1e6});
    const ReferenceValue mean = weighted_mean(labs);
    EXPECT_TRUE(agrees(mean.u, 1e-6 / std::sqrt(1.25 + 1e-12), 1e-13));
    const DegreesOfEquivalence degrees = degrees_of_equivalence(labs, mean);
    // The mean is almost laboratory 1 alone in the next case: u² − u²(y) by itself would be 0 there.
    EXPECT_TRUE(agrees(degrees.u(4), 1e6, 1e-12));
    const LaboratoryResults two = laboratory_results({7.0, 9.0}, {1e-6, 1e6});
    const ReferenceValue of_two = weighted_mean(two);
    const DegreesOfEquivalence inside = degrees_of_equivalence(two, of_two);
    EXPECT_TRUE(agrees(inside.d(0) / inside.u(0), -2.0 / std::hypot(1e-6, 1e6), 1e-12));
}

TEST(ReferenceValue, IndependentReferenceAndASingleLaboratory) {
    const ReferenceValue given{.value = 10.0, .u = 0.3};
    const DegreesOfEquivalence degrees = degrees_of_equivalence(laboratory_results({10.5}, {0.4}), given);
    EXPECT_EQ(degrees.d(0), 0.5);
    EXPECT_TRUE(agrees(degrees.u(0), 0.5, 1e-15));
    EXPECT_EQ(degrees.correlation(0), 0.0);
    ReferenceValue zero_weights = given;
    zero_weights.weights = Eigen::VectorXd::Zero(1);
    EXPECT_EQ(degrees_of_equivalence(laboratory_results({10.5}, {0.4}), zero_weights).u(0), degrees.u(0));
}

TEST(ReferenceValue, CorrelationNeverExceedsOne) {
    // Three values that agree by chance: u of their mean is far below what their uncertainties allow.
    const LaboratoryResults labs = laboratory_results({5.0, 5.001, 5.002}, {1.0, 1.0, 1.0});
    const ReferenceValue mean = arithmetic_mean(labs.x);
    const DegreesOfEquivalence degrees = degrees_of_equivalence(labs, mean);
    for (Eigen::Index i = 0; i < 3; ++i) {
        EXPECT_EQ(degrees.correlation(i), 1.0);
        EXPECT_TRUE(agrees(degrees.u(i), 1.0 - mean.u, 1e-14));
    }
    const DegreesOfEquivalence equal =
        degrees_of_equivalence(laboratory_results({5.0, 5.0}, {1.0, 2.0}), arithmetic_mean(to_vector({5.0, 5.0})));
    EXPECT_EQ(equal.u(1), 2.0);
    EXPECT_EQ(equal.correlation(1), 0.0);
}

TEST(ReferenceValue, ArithmeticMeanHasTheStandardDeviationOfTheValues) {
    const ReferenceValue mean = arithmetic_mean(to_vector({1.0, 2.0, 3.0, 4.0}));
    EXPECT_TRUE(agrees(mean.value, 2.5, 1e-15));
    EXPECT_TRUE(agrees(mean.u, std::sqrt(5.0 / 3.0 / 4.0), 1e-15));
    EXPECT_EQ(mean.weights(2), 0.25);
    EXPECT_EQ(code_of<InputError>([] { (void)arithmetic_mean(to_vector({1.0})); }), "GC-GUM-0131");
    EXPECT_EQ(code_of<InputError>([] { (void)arithmetic_mean(to_vector({1.0, std::nan("")})); }), "GC-GUM-0001");
    // Squares beyond the numbers, and a range beyond them.
    for (const double factor : {1e200, 1e-200, 1e-320}) {
        EXPECT_TRUE(agrees(arithmetic_mean(to_vector({factor, 3.0 * factor})).u, factor, 1e-15)) << factor;
    }
    EXPECT_EQ(code_of<InputError>([] { (void)arithmetic_mean(to_vector({1e308, -1e308})); }), "GC-GUM-0001");
}

/// Results of laboratories that state s/√n of n = ν + 1 readings, all of them right.
LaboratoryResults of_readings(std::mt19937& random, Eigen::Index laboratories, int nu) {
    LaboratoryResults labs{.x = Eigen::VectorXd(laboratories), .u = Eigen::VectorXd(laboratories)};
    labs.degrees_of_freedom = Eigen::VectorXd::Constant(laboratories, nu);
    // Polar method: std::normal_distribution is not the same in every library.
    const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
    const auto normal = [&] {
        return std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform());
    };
    for (Eigen::Index i = 0; i < laboratories; ++i) {
        Eigen::VectorXd readings(nu + 1);
        for (double& reading : readings) {
            reading = normal();
        }
        labs.x(i) = readings.mean();
        labs.u(i) = std::sqrt((readings.array() - labs.x(i)).square().sum() / (nu * (nu + 1.0)));
    }
    return labs;
}

// Welch 1951 and before: u of few readings are too small for the results that scatter most. By χ² alone 47 % of ten
// results with ν = 3 would contradict each other.
TEST(ReferenceValue, RightUncertaintiesOfFewReadingsAreConsistent) {
    constexpr int k_sets = 400;
    for (const int nu : {2, 3, 5, 20}) {
        for (const Eigen::Index laboratories : {Eigen::Index{2}, Eigen::Index{5}, Eigen::Index{20}}) {
            std::mt19937 random(static_cast<unsigned>(100 * nu + laboratories));
            int refuted = 0;
            int by_chi_square = 0;
            int left_out = 0;
            for (int set = 0; set < k_sets; ++set) {
                LaboratoryResults labs = of_readings(random, laboratories, nu);
                const ConsistencyTest test = consistency_test(labs);
                EXPECT_TRUE(test.of_finite_degrees);
                refuted += test.consistent ? 0 : 1;
                if (laboratories > 2 && set < 100) {
                    const ConsistentSubset subset = largest_consistent_subset(labs);
                    left_out += subset.members.size() < static_cast<std::size_t>(laboratories) ? 1 : 0;
                    EXPECT_TRUE(subset.test.consistent);
                    EXPECT_EQ(subset.members.size() == static_cast<std::size_t>(laboratories), test.consistent);
                }
                labs.degrees_of_freedom.resize(0);
                by_chi_square += consistency_test(labs).consistent ? 0 : 1;
            }
            const double rate = static_cast<double>(refuted) / k_sets;
            EXPECT_LE(rate, 0.105) << nu << " " << laboratories;
            EXPECT_GE(rate, 0.01) << nu << " " << laboratories;
            EXPECT_LE(left_out, 15) << nu << " " << laboratories;
            EXPECT_LE(refuted, by_chi_square + 10) << nu << " " << laboratories;
        }
    }
}

TEST(ReferenceValue, ATestOfFewDegreesOfFreedomIsOneOfManyInTheLimit) {
    LaboratoryResults labs = key_comparison_results();
    const ConsistencyTest exact = consistency_test(labs);
    labs.degrees_of_freedom = Eigen::VectorXd::Constant(6, 1e9);
    EXPECT_TRUE(agrees(consistency_test(labs).chi_square, exact.chi_square, 1e-6));
    labs.degrees_of_freedom = Eigen::VectorXd::Constant(6, std::numeric_limits<double>::infinity());
    EXPECT_EQ(consistency_test(labs).chi_square, exact.chi_square);
    EXPECT_FALSE(consistency_test(labs).of_finite_degrees);
    // One result of few degrees of freedom alone, far off: it is not far off for its t, and the others are as they were.
    labs.degrees_of_freedom(4) = 2.0;
    EXPECT_TRUE(consistency_test(labs).consistent);
    EXPECT_EQ(largest_consistent_subset(labs).members.size(), 6U);
    labs.x(4) = 30.0;
    EXPECT_FALSE(consistency_test(labs).consistent);
    EXPECT_EQ(largest_consistent_subset(labs).members, (std::vector<std::size_t>{0, 1, 2, 3, 5}));
    // Whatever the unit and the zero.
    const double chi_square = consistency_test(labs).chi_square;
    labs.x = (labs.x.array() + 1e3) * 1e-6;
    labs.u *= 1e-6;
    EXPECT_TRUE(agrees(consistency_test(labs).chi_square, chi_square, 1e-9));
}

TEST(ReferenceValue, CorrelatedResultsOfFewDegreesOfFreedomAreHeldAgainstOneEstimate) {
    LaboratoryResults labs = with_correlation(key_comparison_results(), 0, 1, 0.5);
    const ConsistencyTest exact = consistency_test(labs);
    labs.degrees_of_freedom = Eigen::VectorXd::Constant(6, 4.0);
    const ConsistencyTest test = consistency_test(labs);
    EXPECT_EQ(test.chi_square, exact.chi_square);
    EXPECT_TRUE(agrees(test.critical_value, 5.0 * 6.256056502, 1e-6));  // F_0.95(5, 4)
    EXPECT_GT(test.p_value, exact.p_value);
    EXPECT_TRUE(test.consistent);
    EXPECT_EQ(largest_consistent_subset(labs).members.size(), 6U);
}

TEST(ReferenceValue, IncompatiblePairs) {
    // Differences of laboratory 5: 0.64, 0.77, 0.53, 0.70, 0.90; twice their uncertainties: 0.361, 0.424, 0.5, 0.384,
    // 0.671. All other pairs: at most 0.37.
    EXPECT_EQ(incompatible_pairs(key_comparison_results(), 2.0), 5u);
    EXPECT_EQ(incompatible_pairs(key_comparison_results(), 10.0), 0u);
    const LaboratoryResults pair = laboratory_results({0.0, 2.0}, {1.0, 1.0});
    EXPECT_EQ(incompatible_pairs(pair, 2.0), 0u);
    EXPECT_EQ(incompatible_pairs(with_correlation(pair, 0, 1, 0.9), 2.0), 1u);
    // Just at the limit, where 10.3 − 10.1 is a little more than 0.2, and a little beyond it.
    EXPECT_EQ(incompatible_pairs(laboratory_results({10.1, 10.3}, {0.06, 0.08})), 0u);
    EXPECT_EQ(incompatible_pairs(laboratory_results({10.1, 10.3 + 1e-13}, {0.06, 0.08})), 1u);
    // Two that differ by 7 u, beside a first one that is far away.
    EXPECT_EQ(incompatible_pairs(laboratory_results({1e6, 1e-12, 2e-12}, {1e6, 1e-13, 1e-13})), 1u);
    EXPECT_EQ(code_of<InputError>([&] { (void)incompatible_pairs(pair, 0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([&] { (void)pair_difference(pair, 1, 1); }), "GC-GUM-0135");
    EXPECT_EQ(code_of<InputError>([&] { (void)pair_difference(pair, 0, 2); }), "GC-GUM-0135");
}

TEST(ReferenceValue, PairOfFullyCorrelatedResults) {
    const LaboratoryResults labs = with_correlation(laboratory_results({1.0, 2.0}, {0.1, 0.1}), 0, 1, 1.0);
    EXPECT_EQ(pair_difference(labs, 0, 1).u, 0.0);
    EXPECT_EQ(incompatible_pairs(labs), 1u);
}

TEST(ReferenceValue, SingularCovarianceHasNoWeightedMeanButDegreesOfEquivalence) {
    const LaboratoryResults labs = with_correlation(laboratory_results({1.0, 1.1, 1.2}, {0.1, 0.1, 0.2}), 0, 1, 1.0);
    EXPECT_NO_THROW(require_results(labs));
    EXPECT_EQ(code_of<NoResultError>([&] { (void)weighted_mean(labs); }), "GC-GUM-0132");
    EXPECT_EQ(code_of<NoResultError>([&] { (void)consistency_test(labs); }), "GC-GUM-0132");
    const DegreesOfEquivalence degrees = degrees_of_equivalence(labs, {.value = 1.0, .u = 0.1});
    EXPECT_TRUE(agrees(degrees.u(0), std::hypot(0.1, 0.1), 1e-13));
}

TEST(ReferenceValue, RefusesWhatIsNoResult) {
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(code_of<InputError>([] { (void)weighted_mean(laboratory_results({1.0}, {0.1})); }), "GC-GUM-0131");
    EXPECT_EQ(code_of<InputError>([] { (void)weighted_mean(laboratory_results({}, {})); }), "GC-GUM-0131");
    EXPECT_EQ(code_of<InputError>([] { (void)weighted_mean(laboratory_results({1.0, 2.0}, {0.1})); }), "GC-GUM-0135");
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)weighted_mean(laboratory_results({1.0, not_a_number}, {0.1, 0.1}));
              }),
              "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)weighted_mean(laboratory_results({1.0, 2.0}, {0.1, not_a_number}));
              }),
              "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)weighted_mean(laboratory_results({1.0, 2.0}, {0.1, 0.0}));
              }),
              "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)weighted_mean(laboratory_results({1.0, 2.0}, {0.1, -0.1}));
              }),
              "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)weighted_mean(laboratory_results({1.0, 2.0}, {0.1, 1e-300}));
              }),
              "GC-GUM-0142");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)weighted_mean(laboratory_results({1.0, 1e140}, {0.1, 1e-100}));
              }),
              "GC-GUM-0142");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)consistency_test(laboratory_results({1.0, 2.0}, {0.1, 0.1}), 1.0);
              }),
              "GC-GUM-0004");
    // All problems together, each with the number of its result.
    const std::string text = message_of<InputError>([&] {
        require_results(laboratory_results({1.0, not_a_number, 3.0}, {0.0, 0.1, 0.1}));
    });
    EXPECT_THAT(text, HasSubstr("result 1 — standard uncertainty 0 — must be greater than 0"));
    EXPECT_THAT(text, HasSubstr("result 2 — value NaN"));
}

TEST(ReferenceValue, RefusesACovarianceThatIsNone) {
    const LaboratoryResults labs = laboratory_results({1.0, 2.0, 3.0}, {0.5, 0.25, 0.5});
    LaboratoryResults wrong = with_correlation(labs, 0, 1, 0.5);
    wrong.covariance(1, 0) *= 1.1;
    EXPECT_EQ(code_of<InputError>([&] { require_results(wrong); }), "GC-GUM-0052");
    const LaboratoryResults above_one = with_correlation(labs, 0, 1, 1.25);
    EXPECT_EQ(code_of<InputError>([&] { require_results(above_one); }), "GC-GUM-0053");
    EXPECT_THAT(message_of<InputError>([&] { require_results(above_one); }),
                HasSubstr("element of result 1 and result 2 is 0.15625, a correlation of 1.25"));
    wrong = with_correlation(labs, 0, 1, 0.0);
    wrong.covariance(2, 2) = 0.02;
    EXPECT_EQ(code_of<InputError>([&] { require_results(wrong); }), "GC-GUM-0143");
    wrong.covariance.resize(2, 2);
    EXPECT_EQ(code_of<InputError>([&] { require_results(wrong); }), "GC-GUM-0135");
    wrong = with_correlation(labs, 0, 1, std::nan(""));
    EXPECT_EQ(code_of<InputError>([&] { require_results(wrong); }), "GC-GUM-0001");
    // r = 0.9, 0.9, −0.9 contradict each other: eigenvalues 1.9, 1.9 and −0.8.
    wrong = with_correlation(with_correlation(with_correlation(labs, 0, 1, 0.9), 0, 2, 0.9), 1, 2, -0.9);
    EXPECT_EQ(code_of<InputError>([&] { require_results(wrong); }), "GC-GUM-0054");
    EXPECT_THAT(message_of<InputError>([&] { require_results(wrong); }),
                HasSubstr("smallest eigenvalue of the correlation matrix is -0.8"));
}

TEST(ReferenceValue, RefusesAReferenceThatDoesNotFit) {
    const LaboratoryResults labs = laboratory_results({1.0, 2.0}, {0.1, 0.1});
    EXPECT_EQ(code_of<InputError>([&] { (void)degrees_of_equivalence(labs, {.value = std::nan("")}); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([&] { (void)degrees_of_equivalence(labs, {.value = 1.0, .u = -0.1}); }),
              "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>(
                  [&] { (void)degrees_of_equivalence(labs, {.value = 1.0, .u = 0.1, .weights = to_vector({1.0})}); }),
              "GC-GUM-0135");
}

}  // namespace
}  // namespace gumcert::gum
