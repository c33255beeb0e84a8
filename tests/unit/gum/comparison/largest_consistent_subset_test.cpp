// Largest consistent subset: golden vector 6, constructed cases whose answer is known, ties, correlations, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gum/comparison/reference_value.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::message_of;
using test::prints_as;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

LaboratoryResults results(const std::vector<double>& x, const std::vector<double>& u) {
    return {.x = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())),
            .u = Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()))};
}

LaboratoryResults key_comparison() {
    return results({12.31, 12.18, 12.42, 12.25, 12.95, 12.05}, {0.10, 0.15, 0.20, 0.12, 0.15, 0.30});
}

TEST(LargestConsistentSubset, GoldenVectorSix) {
    const LaboratoryResults labs = key_comparison();
    const ConsistentSubset subset = largest_consistent_subset(labs);
    EXPECT_THAT(subset.members, ElementsAre(0, 1, 2, 3, 5));
    EXPECT_TRUE(subset.unique);
    EXPECT_TRUE(prints_as(subset.mean.value, "12.26967"));
    EXPECT_TRUE(prints_as(subset.mean.u, "0.06325"));
    EXPECT_TRUE(prints_as(subset.test.chi_square, "1.6480"));
    EXPECT_TRUE(prints_as(subset.test.p_value, "0.8001"));
    EXPECT_TRUE(subset.test.consistent);
    EXPECT_EQ(subset.test.degrees_of_freedom, 4u);
    EXPECT_EQ(subset.mean.weights.size(), 6);
    EXPECT_EQ(subset.mean.weights(4), 0.0);
    const DegreesOfEquivalence degrees = degrees_of_equivalence(labs, subset.mean);
    const std::vector<std::string_view> en = {"0.260", "-0.330", "0.396", "-0.096", "2.090", "-0.375"};
    for (Eigen::Index i = 0; i < 6; ++i) {
        EXPECT_TRUE(prints_as(degrees.d(i) / (2.0 * degrees.u(i)), en[static_cast<std::size_t>(i)])) << i;
    }
}

TEST(LargestConsistentSubset, AllResultsWhereTheyAreConsistent) {
    const ConsistentSubset subset = largest_consistent_subset(results({1.0, 1.1, 0.9}, {0.1, 0.1, 0.1}));
    EXPECT_THAT(subset.members, ElementsAre(0, 1, 2));
    EXPECT_TRUE(subset.unique);
}

TEST(LargestConsistentSubset, SayWhereAnotherSubsetIsAsGood) {
    // Two pairs that are mirror images: the first one is taken, and it is said that it is not the only one.
    const ConsistentSubset pairs = largest_consistent_subset(results({0.0, 1.0, 100.0, 101.0}, {1.0, 1.0, 1.0, 1.0}));
    EXPECT_THAT(pairs.members, ElementsAre(0, 1));
    EXPECT_FALSE(pairs.unique);
    // Two laboratories with the same result, of which one finds a place.
    const ConsistentSubset twins =
        largest_consistent_subset(results({0.0, 2.7, 2.7, -200.0}, {1.0, 1.0, 1.0, 0.1}), 0.05);
    EXPECT_THAT(twins.members, ElementsAre(0, 1, 2));
    EXPECT_TRUE(twins.unique);
    const ConsistentSubset out = largest_consistent_subset(results({0.0, 2.7, -2.7, 900.0}, {1.0, 1.0, 1.0, 1.0}));
    EXPECT_EQ(out.members.size(), 2U);
    EXPECT_FALSE(out.unique);
    // A ladder: every pair of neighbours is as good as the next.
    const ConsistentSubset ladder =
        largest_consistent_subset(results({0.0, 2.0, 4.0, 6.0, 8.0, 10.0}, {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}));
    EXPECT_EQ(ladder.members.size(), 2u);
    EXPECT_FALSE(ladder.unique);
}

/// The law: in whatever order the results are listed, the same ones are taken, also where subsets tie.
TEST(LargestConsistentSubset, DoesNotDependOnTheOrderOfTheResults) {
    std::mt19937_64 engine(6);
    for (int trial = 0; trial < 60; ++trial) {
        const auto n = static_cast<std::size_t>(4 + trial % 4);
        std::vector<double> x;
        for (std::size_t i = 0; i < n; ++i) {  // a coarse grid: many ties
            x.push_back(0.5 * static_cast<double>(engine() % 12U) + 0.01 * static_cast<double>(i % 2));
        }
        const std::vector<double> u(n, 0.2);
        const auto value_of = [&](const std::vector<double>& values, bool correlated) {
            LaboratoryResults labs = results(values, u);
            if (correlated) {
                labs.covariance = labs.u.array().square().matrix().asDiagonal();
            }
            try {
                const ConsistentSubset subset = largest_consistent_subset(labs);
                std::vector<double> members;
                for (const std::size_t member : subset.members) {
                    members.push_back(values[member]);
                }
                std::sort(members.begin(), members.end());
                return members;
            } catch (const NoResultError&) {
                return std::vector<double>{};
            }
        };
        std::vector<double> listed = x;
        for (int order = 0; order < 5; ++order) {
            std::shuffle(listed.begin(), listed.end(), engine);
            for (const bool correlated : {false, true}) {
                EXPECT_EQ(value_of(listed, correlated), value_of(x, correlated)) << trial << " " << correlated;
            }
        }
    }
}

/// Against every subset: who is in another consistent one of the size that was found.
TEST(LargestConsistentSubset, NamesWhoIsInAnotherConsistentSubset) {
    std::mt19937_64 draw(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0.05, 0.5);
    std::size_t with = 0;
    std::size_t without = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const std::size_t n = 4 + static_cast<std::size_t>(trial % 5);
        std::vector<double> x;
        std::vector<double> u;
        for (std::size_t i = 0; i < n; ++i) {
            u.push_back(trial % 3 == 0 ? 0.1 : uniform(draw));
            x.push_back(10.0 + normal(draw) * (trial % 2 == 0 ? 0.3 : 0.15) + (i == 0 ? 2.0 : 0.0));
        }
        LaboratoryResults labs = results(x, u);
        ConsistentSubset found;
        try {
            found = largest_consistent_subset(labs);
        } catch (const NoResultError&) {
            continue;
        }
        std::set<std::size_t> expected;
        for (std::uint32_t mask = 0; mask < (1U << n); ++mask) {
            std::vector<std::size_t> members;
            for (std::size_t i = 0; i < n; ++i) {
                if ((mask >> i) % 2 == 1) {
                    members.push_back(i);
                }
            }
            if (members.size() == found.members.size() &&
                consistency_test(selected_results(labs, members)).consistent) {
                expected.insert(members.begin(), members.end());
            }
        }
        for (const std::size_t member : found.members) {
            expected.erase(member);
        }
        const std::vector<std::size_t> others(expected.begin(), expected.end());
        EXPECT_EQ(found.in_another, others) << trial;
        (others.empty() ? without : with) += 1;
        labs.covariance = labs.u.array().square().matrix().asDiagonal();
        EXPECT_EQ(largest_consistent_subset(labs).in_another, others) << trial << " by every subset";
    }
    EXPECT_GT(with, 20U);
    EXPECT_GT(without, 20U);
}

TEST(LargestConsistentSubset, EqualValuesAndManyEqualResults) {
    const ConsistentSubset equal =
        largest_consistent_subset(results({5.0, 5.0, 5.0, 7.0, 9.0}, {0.1, 0.2, 1e-6, 1e-3, 1e-3}));
    EXPECT_THAT(equal.members, ElementsAre(0, 1, 2));
    EXPECT_EQ(equal.test.chi_square, 0.0);
    std::vector<double> x;
    for (int i = 0; i < 600; ++i) {
        x.push_back(static_cast<double>(i % 3) * 3.0);
    }
    const ConsistentSubset many = largest_consistent_subset(results(x, std::vector<double>(600, 1.0)));
    EXPECT_TRUE(many.test.consistent);
    EXPECT_FALSE(many.unique);
    // 200 of one value and m of a neighbouring one have chi-square 9 · 200 m/(200 + m): 268.09 for m = 35 (critical
    // value for 234 degrees of freedom 270.68), 274.58 for m = 36 (271.76). From both sides there is room for fewer.
    EXPECT_EQ(many.members.size(), 235u);
    EXPECT_TRUE(agrees(many.test.chi_square, 9.0 * 200.0 * 35.0 / 235.0, 1e-12));
}

TEST(LargestConsistentSubset, PreciseResultsFarApart) {
    const LaboratoryResults labs =
        results({1e9, 1e9 + 1e-3, 1e9 + 2e-3, 1e9 + 7.0, 1e9 - 3.0, 2e9}, {1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e9});
    const ConsistentSubset subset = largest_consistent_subset(labs);
    EXPECT_THAT(subset.members, ElementsAre(0, 1, 2, 5));
    EXPECT_TRUE(subset.unique);
}

TEST(LargestConsistentSubset, CorrelatedResultsByEverySubset) {
    LaboratoryResults labs = key_comparison();
    labs.covariance = labs.u.array().square().matrix().asDiagonal();
    const ConsistentSubset diagonal = largest_consistent_subset(labs);
    const ConsistentSubset plain = largest_consistent_subset(key_comparison());
    EXPECT_EQ(diagonal.members, plain.members);
    EXPECT_TRUE(agrees(diagonal.test.chi_square, plain.test.chi_square, 1e-13));
    // Results 1 and 4 share nearly everything and differ by 0.06: chi-square of the pair alone is about 5.9.
    labs.covariance(0, 3) = labs.covariance(3, 0) = 0.97 * labs.u(0) * labs.u(3);
    const ConsistentSubset correlated = largest_consistent_subset(labs);
    EXPECT_TRUE(correlated.test.consistent);
    EXPECT_TRUE(agrees(correlated.test.chi_square,
                       consistency_test(selected_results(labs, correlated.members)).chi_square, 1e-14));
    LaboratoryResults singular = key_comparison();
    singular.covariance = singular.u.array().square().matrix().asDiagonal();
    singular.covariance(0, 1) = singular.covariance(1, 0) = singular.u(0) * singular.u(1);
    EXPECT_EQ(code_of<NoResultError>([&] { (void)largest_consistent_subset(singular); }), "GC-GUM-0132");
}

TEST(LargestConsistentSubset, UncertaintiesOfVeryDifferentSize) {
    // Every subset in 40 digits (mpmath). One imprecise result first in the list: all six are consistent.
    const ConsistentSubset all =
        largest_consistent_subset(results({-31364.845955593617, 3.785917944607355e-12, 2.006654348923086e-12,
                                           4.579778014707386e-14, 1.0109358338332220e-12, 1.756833778589485e-12},
                                          {1e5, 8.450036842481452e-13, 1.43624077461813e-12, 8.523971230151797e-13,
                                           1.132160076208483e-12, 1.3185062042746253e-12}));
    EXPECT_THAT(all.members, ElementsAre(0, 1, 2, 3, 4, 5));
    // Two imprecise ones: the mean of the best subset lies 1e-17 of them beside the precise ones.
    const ConsistentSubset three = largest_consistent_subset(results(
        {-183213.9746513662, 156733.50756805378, -3.5998914716813627e-12, 8.304110305328209e-13, 3.758294316970057e-12},
        {1e5, 1e5, 5.329045651013124e-13, 9.847044687848874e-13, 1.4515298127322195e-12}));
    EXPECT_THAT(three.members, ElementsAre(1, 3, 4));
    EXPECT_TRUE(three.unique);
    EXPECT_TRUE(agrees(three.test.chi_square, 5.24291106640179863, 1e-13));
}

TEST(LargestConsistentSubset, RefusesWhatItCannotDoExactly) {
    const std::size_t too_many = k_most_results_of_subset + 1;
    const LaboratoryResults many{.x = Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(too_many), 0.0, 1.0),
                                 .u = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(too_many))};
    EXPECT_EQ(code_of<InputError>([&] { (void)largest_consistent_subset(many); }), "GC-GUM-0133");
    EXPECT_THAT(message_of<InputError>([&] { (void)largest_consistent_subset(many); }),
                HasSubstr("2001 results — an exact search takes at most 2000"));
    const Eigen::Index n = static_cast<Eigen::Index>(k_most_correlated_results_of_subset) + 1;
    const LaboratoryResults correlated{.x = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0),
                                       .u = Eigen::VectorXd::Ones(n),
                                       .covariance = Eigen::MatrixXd::Identity(n, n)};
    EXPECT_EQ(code_of<InputError>([&] { (void)largest_consistent_subset(correlated); }), "GC-GUM-0133");
    EXPECT_EQ(code_of<InputError>([] { (void)largest_consistent_subset(key_comparison(), 0.5); }), "GC-GUM-0004");
    EXPECT_EQ(code_of<InputError>([] { (void)largest_consistent_subset(results({1.0}, {0.1})); }), "GC-GUM-0131");
    EXPECT_EQ(code_of<NoResultError>([] {
                  (void)largest_consistent_subset(results({1.0, 2.0, 3.0}, {0.01, 0.01, 0.01}));
              }),
              "GC-GUM-0134");
}

}  // namespace
}  // namespace gumcert::gum
