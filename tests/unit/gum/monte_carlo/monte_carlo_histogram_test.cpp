#include "gum/monte_carlo/monte_carlo_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "gum/monte_carlo/monte_carlo.h"

namespace gumcert::gum {
namespace {

/// Outputs that are the inputs times a factor.
class Multiples : public MeasurementModel {
public:
    Multiples(const Distribution& input, std::vector<double> factors) : factors_(std::move(factors)) {
        InputGroup& group = groups_.emplace_back();
        group.name = "x";
        group.unit = "m";
        group.value = Eigen::VectorXd::Constant(1, input.location);
        group.covariance = Eigen::MatrixXd::Ones(1, 1);
        group.marginals = {input};
        for (std::size_t j = 0; j < factors_.size(); ++j) {
            outputs_.push_back({.name = "y" + std::to_string(j + 1), .unit = "m"});
        }
    }
    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override { return factors() * x(0); }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& /*x*/) const override { return factors(); }

private:
    [[nodiscard]] Eigen::VectorXd factors() const {
        return Eigen::VectorXd::Map(factors_.data(), static_cast<Eigen::Index>(factors_.size()));
    }

    std::vector<double> factors_;
    std::vector<InputGroup> groups_;
    std::vector<OutputQuantity> outputs_;
};

std::uint64_t total(const Histogram& histogram) {
    return std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0});
}

Moments moments_of_values(const std::vector<double>& values) {
    return gum::moments_of(values.data(), static_cast<Eigen::Index>(values.size()));
}

void count(const std::vector<double>& values, Histogram& histogram) {
    count_values(values.data(), static_cast<Eigen::Index>(values.size()), histogram);
}

MonteCarloOptions histogram_options(std::uint64_t trials, unsigned threads) {
    MonteCarloOptions result;
    result.trials = trials;
    result.threads = threads;
    return result;
}

void expect_same(const Histogram& a, const Histogram& b) {
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
    EXPECT_EQ(a.counts, b.counts);
}

TEST(MonteCarloHistogram, EveryTrialInItsCell) {
    const Multiples model(Distribution::uniform(1.0, 2.0), {1.0, -3.0});
    const MonteCarloResult result = run_monte_carlo(model, histogram_options(5000, 2));
    for (std::size_t j = 0; j < 2; ++j) {
        std::vector<double> values;
        for (std::uint64_t trial = 0; trial < 5000; ++trial) {
            values.push_back(monte_carlo_trial(model, 1, trial)(0) * (j == 0 ? 1.0 : -3.0));
        }
        const Histogram& histogram = result.outputs[j].histogram;
        ASSERT_EQ(histogram.counts.size(), 60U);
        // Within 4 standard deviations lies the whole of a uniform distribution: from the smallest to the largest.
        EXPECT_EQ(histogram.low, *std::min_element(values.begin(), values.end()));
        EXPECT_EQ(histogram.high, *std::max_element(values.begin(), values.end()));
        EXPECT_EQ(total(histogram), 5000U);
        std::sort(values.begin(), values.end());
        const double width = (histogram.high - histogram.low) / 60.0;
        std::uint64_t below = 0;
        for (std::size_t cell = 0; cell + 1 < 60; ++cell) {
            below += histogram.counts[cell];
            const double limit = histogram.low + width * static_cast<double>(cell + 1);
            const double slack = 1e-12 * width;  // a limit is not exact to the last bit
            EXPECT_GE(below, static_cast<std::uint64_t>(std::lower_bound(values.begin(), values.end(), limit - slack) -
                                                        values.begin()));
            EXPECT_LE(below, static_cast<std::uint64_t>(std::lower_bound(values.begin(), values.end(), limit + slack) -
                                                        values.begin()));
        }
    }
}

TEST(MonteCarloHistogram, ReachesFourStandardDeviations) {
    const Multiples model(Distribution::student_t(7.0, 0.5, 3.0), {1.0});
    const MonteCarloOutput output = run_monte_carlo(model, histogram_options(200'000, 2)).outputs[0];
    EXPECT_EQ(output.histogram.low, output.mean - 4.0 * output.standard_uncertainty);
    EXPECT_EQ(output.histogram.high, output.mean + 4.0 * output.standard_uncertainty);
    // t with 3 degrees of freedom, u = 0.5 √3: P(|t| > 4 √3) = 0.00617.
    EXPECT_NEAR(static_cast<double>(total(output.histogram)) / 200'000.0, 1.0 - 0.00617, 0.0015);
}

TEST(MonteCarloHistogram, ShapeOfTheNormalDistribution) {
    const Multiples model(Distribution::normal(-2.0, 0.01), {1.0});
    const MonteCarloOutput output = run_monte_carlo(model, histogram_options(1'000'000, 2)).outputs[0];
    const Histogram& histogram = output.histogram;
    const auto probability_below = [](double y) { return 0.5 * std::erfc(-(y + 2.0) / 0.01 / std::sqrt(2.0)); };
    const double width = (histogram.high - histogram.low) / 60.0;
    double chi_square = 0.0;
    for (std::size_t cell = 0; cell < 60; ++cell) {
        const double left = histogram.low + width * static_cast<double>(cell);
        const double expected = 1e6 * (probability_below(left + width) - probability_below(left));
        const double difference = static_cast<double>(histogram.counts[cell]) - expected;
        chi_square += difference * difference / expected;
    }
    EXPECT_LT(chi_square, 130.0);  // 60 cells; 1e-6 of all samples are above
}

TEST(MonteCarloHistogram, SameForAnyThreadsAndMemory) {
    const Multiples model(Distribution::student_t(0.0, 1.0, 2.0), {1.0, 0.0, 1e-9, 2.0});
    const MonteCarloResult one = run_monte_carlo(model, histogram_options(50'001, 1));
    for (const unsigned threads : {2U, 3U}) {
        for (const bool kept : {true, false}) {
            for (const std::uint64_t collected : {std::uint64_t{1} << 24, std::uint64_t{1}}) {
                MonteCarloOptions o = histogram_options(50'001, threads);
                o.memory.kept_trials = kept ? o.memory.kept_trials : 1000;
                o.memory.collected_values = collected;
                const MonteCarloResult other = run_monte_carlo(model, o);
                for (std::size_t j = 0; j < 4; ++j) {
                    expect_same(one.outputs[j].histogram, other.outputs[j].histogram);
                }
            }
        }
    }
    EXPECT_TRUE(one.outputs[1].histogram.counts.empty());  // does not vary
    EXPECT_EQ(one.outputs[0].histogram.counts, one.outputs[3].histogram.counts);
}

TEST(MonteCarloHistogram, OnlyWhenAskedFor) {
    const Multiples model(Distribution::normal(0.0, 1.0), {1.0});
    MonteCarloOptions o = histogram_options(10'000, 1);
    const MonteCarloOutput with = run_monte_carlo(model, o).outputs[0];
    o.histogram = false;
    const MonteCarloOutput without = run_monte_carlo(model, o).outputs[0];
    EXPECT_EQ(with.histogram.counts.size(), 60U);
    EXPECT_TRUE(without.histogram.counts.empty());
    EXPECT_EQ(with.mean, without.mean);
    EXPECT_EQ(with.shortest, without.shortest);
}

TEST(MonteCarloHistogram, EndsAndOutsiders) {
    Histogram histogram{.low = 0.0, .high = 6.0, .counts = std::vector<std::uint64_t>(60, 0)};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    count({0.0, -0.0, 6.0, std::nextafter(6.0, 0.0), 3.0, -1e-300, std::nextafter(6.0, 7.0), infinity, -infinity,
           std::numeric_limits<double>::quiet_NaN()},
          histogram);
    EXPECT_EQ(histogram.counts[0], 2U);
    EXPECT_EQ(histogram.counts[30], 1U);
    EXPECT_EQ(histogram.counts[59], 2U);
    EXPECT_EQ(total(histogram), 5U);
}

TEST(MonteCarloHistogram, ValuesAtTheLimitsOfDouble) {
    EXPECT_TRUE(empty_histogram(moments_of_values({4.25, 4.25, 4.25})).counts.empty());
    EXPECT_TRUE(empty_histogram(moments_of_values({0.0, 5e-324})).counts.empty());
    EXPECT_TRUE(empty_histogram(moments_of_values({-1.5e308, 1.5e308})).counts.empty());
    const double one_up = std::nextafter(1.0, 2.0);
    Histogram neighbours = empty_histogram(moments_of_values({1.0, one_up}));
    ASSERT_EQ(neighbours.counts.size(), 60U);
    count({1.0, one_up}, neighbours);
    EXPECT_EQ(neighbours.counts.front() + neighbours.counts.back(), 2U);
    const std::vector<double> huge{-1e200, 0.0, 1e200};  // their squares are not finite
    Histogram wide = empty_histogram(moments_of_values(huge));
    EXPECT_EQ(wide.low, -1e200);
    EXPECT_EQ(wide.high, 1e200);
    count(huge, wide);
    EXPECT_EQ(total(wide), 3U);
}

}  // namespace
}  // namespace gumcert::gum
