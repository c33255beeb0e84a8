#include "gum/monte_carlo/monte_carlo_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace gumcert::gum {
namespace {

// By hand: 2 4 4 4 5 5 7 9 has the mean 5 and Σ d² = 32, Σ d³ = 42, Σ d⁴ = 356.
TEST(Moments, OfEightNumbers) {
    const std::vector<double> values{2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
    const Moments moments = moments_of(values.data(), 8);
    EXPECT_EQ(moments.count, 8U);
    EXPECT_EQ(moments.mean, 5.0);
    EXPECT_EQ(moments.m2, 32.0);
    EXPECT_EQ(moments.m3, 42.0);
    EXPECT_EQ(moments.m4, 356.0);
    EXPECT_EQ(moments.smallest, 2.0);
    EXPECT_EQ(moments.largest, 9.0);
    EXPECT_DOUBLE_EQ(moments.standard_deviation(), std::sqrt(32.0 / 7.0));
    // var(u²) ≈ (356/8 − 16 · 5/7)/8 and u(u) = √var(u²)/(2u), with 32/8 for u² as in the formula.
    EXPECT_DOUBLE_EQ(moments.error_of_standard_deviation() / moments.standard_deviation(),
                     0.5 * std::sqrt((44.5 / 16.0 - 5.0 / 7.0) / 8.0));
}

TEST(Moments, OfFewNumbers) {
    EXPECT_EQ(moments_of(nullptr, 0).count, 0U);
    const double one = 3.0;
    EXPECT_EQ(moments_of(&one, 1).standard_deviation(), 0.0);
    // Nothing is known of the scatter of a scatter of three numbers.
    const std::vector<double> three{1.0, 2.0, 3.0};
    EXPECT_EQ(moments_of(three.data(), 3).error_of_standard_deviation(), 1.0);
    const std::vector<double> lost{1.0, std::nan(""), 3.0};
    EXPECT_FALSE(std::isfinite(moments_of(lost.data(), 3).mean));
}

TEST(Moments, MergedInParts) {
    std::vector<double> values;
    for (int i = 0; i < 1000; ++i) {
        values.push_back(1e6 + std::sin(i) + 0.001 * i);
    }
    const Moments whole = moments_of(values.data(), 1000);
    Moments parts = moments_of(values.data(), 137);
    parts.merge(moments_of(values.data() + 137, 1));
    parts.merge(Moments());
    parts.merge(moments_of(values.data() + 138, 862));
    EXPECT_NEAR(parts.mean, whole.mean, 1e-9);
    EXPECT_NEAR(parts.m2, whole.m2, 1e-9 * whole.m2);
    EXPECT_NEAR(parts.m3, whole.m3, 1e-7 * whole.m2);
    EXPECT_NEAR(parts.m4, whole.m4, 1e-9 * whole.m4);
    EXPECT_EQ(parts.largest, *std::max_element(values.begin(), values.end()));
}

TEST(SumOfProducts, IsThatOfTheNaiveLoop) {
    std::vector<double> a;
    std::vector<double> b;
    double expected = 0.0;
    for (int i = 0; i < 21; ++i) {  // two whole rows of partial sums, and a rest; every product is a whole number
        a.push_back(i * i % 13);
        b.push_back(7 - i * 5 % 11);
        expected += (a.back() - 4.0) * (b.back() - 2.0);
    }
    EXPECT_EQ(sum_of_products(a.data(), 4.0, b.data(), 2.0, 21), expected);
    EXPECT_EQ(sum_of_products(a.data(), 4.0, b.data(), 2.0, 0), 0.0);
}

TEST(ShortestRange, IsThatOfAllIntervals) {
    std::vector<double> values;
    for (int i = 0; i < 997; ++i) {
        values.push_back(std::exp(2.0 * std::sin(i * 1.3)) + std::cos(i * 0.37));
    }
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for (const std::size_t inside : std::vector<std::size_t>{1, 200, 498, 499, 947, 996}) {
        std::size_t best = 0;
        for (std::size_t r = 1; r + inside < sorted.size(); ++r) {
            if (sorted[r + inside] - sorted[r] < sorted[best + inside] - sorted[best]) {
                best = r;
            }
        }
        std::vector<double> rearranged = values;
        const ShortestRange range = shortest_range(rearranged, inside);
        EXPECT_EQ(range.low.value, sorted[best]) << inside;
        EXPECT_EQ(range.high.value, sorted[best + inside]) << inside;
        EXPECT_EQ(range.low.resolution, 0.0);
    }
    std::vector<double> steps{5.0, 1.0, 4.0, 2.0, 3.0};
    EXPECT_EQ(shortest_range(steps, 2).low.value, 1.0) << "the first of several that are equally short";
}

// JCGM 101:2008, 7.7.2: ranks counted from 1 there. M = 10^6, p = 0.95: r = 25000, r + q = 975000.
TEST(CoverageRanks, OfTheTheSymmetricInterval) {
    const CoverageRanks ranks(0.95, 1'000'000);
    EXPECT_EQ(ranks.inside, 950'000U);
    EXPECT_EQ(ranks.low + 1, 25'000U);
    const CoverageRanks odd(0.95, 999);  // pM = 949.05: q = 949, (M - q)/2 = 25
    EXPECT_EQ(odd.inside, 949U);
    EXPECT_EQ(odd.low + 1, 25U);
    const CoverageRanks half(0.95, 998);  // pM = 948.1: q = 948, r = 25
    EXPECT_EQ(half.low + 1, 25U);
    const CoverageRanks up(0.95, 1010);  // pM = 959.5: q = 960, r = 25
    EXPECT_EQ(up.inside, 960U);
    const CoverageRanks not_whole(0.95, 1001);  // q = 951, (M - q)/2 = 25
    EXPECT_EQ(not_whole.low + 1, 25U);
    const CoverageRanks rounded(0.95, 1019);  // pM = 968.05: q = 968, (M - q)/2 = 25.5: r = 26
    EXPECT_EQ(rounded.low + 1, 26U);
}

TEST(RankSearch, AgreesWithSorting) {
    std::vector<double> values;
    for (int i = 0; i < 20'000; ++i) {
        const double x = std::sin(i * 1.7) + std::cos(i * 0.3);
        values.push_back(i % 7 == 0 ? 1e9 * x : (i % 11 == 0 ? 0.25 : x * x * x));
    }
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const std::vector<std::uint64_t> ranks{0, 1, 500, 10'000, 19'000, 19'999};
    for (const std::uint64_t most : std::vector<std::uint64_t>{100'000, 3'000, 300}) {
        RankSearch search(std::span<const double>(values.data(), 500), 4, most);
        for (const std::uint64_t rank : ranks) {
            search.want_rank(rank);
        }
        int passes = 0;
        while (!search.is_done()) {
            RankSearch::Tally tally = search.tally();
            search.add(values.data(), 20'000, tally);
            search.absorb(tally);
            search.finish_pass(sorted.front(), sorted.back());
            ASSERT_LT(++passes, 10);
        }
        for (const std::uint64_t rank : ranks) {
            const RankValue found = search.value(rank);
            EXPECT_NEAR(found.value, sorted[rank], found.resolution * (1.0 + 1e-9)) << rank << " " << most;
        }
    }
}

TEST(RankSearch, FindsTheShortestInterval) {
    std::vector<double> values;
    for (int i = 0; i < 20'000; ++i) {
        values.push_back(std::exp(std::sin(i * 1.7) + 0.3 * std::cos(i * 0.3)));
    }
    std::vector<double> rearranged = values;
    const ShortestRange expected = shortest_range(rearranged, 19'000);
    const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
    RankSearch search(std::span<const double>(values.data(), 500), 6, 10'000);
    search.want_shortest(19'000);
    while (!search.is_done()) {
        RankSearch::Tally tally = search.tally();
        search.add(values.data(), 20'000, tally);
        search.absorb(tally);
        search.finish_pass(*smallest, *largest);
    }
    EXPECT_EQ(search.shortest().low.value, expected.low.value);
    EXPECT_EQ(search.shortest().high.value, expected.high.value);
}

}  // namespace
}  // namespace gumcert::gum
