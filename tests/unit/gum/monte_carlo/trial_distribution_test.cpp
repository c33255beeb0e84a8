#include "gum/monte_carlo/trial_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "gum/monte_carlo/monte_carlo.h"

namespace gumcert::gum {
namespace {

/// y = f(x) of one input.
class OfOneInput final : public MeasurementModel {
public:
    OfOneInput(Distribution distribution, std::function<double(double)> function) : function_(std::move(function)) {
        InputGroup x;
        x.name = "x";
        x.unit = "m";
        x.value = Eigen::VectorXd::Constant(1, distribution.location);
        x.covariance = Eigen::MatrixXd::Constant(1, 1, 1.0);
        x.marginals = {std::move(distribution)};
        inputs_ = {x};
        outputs_ = {{"y", "m"}};
    }
    const std::vector<InputGroup>& inputs() const override { return inputs_; }
    const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override { return x.unaryExpr(function_); }
    Eigen::MatrixXd jacobian(const Eigen::VectorXd&) const override { return Eigen::MatrixXd::Identity(1, 1); }

private:
    std::function<double(double)> function_;
    std::vector<InputGroup> inputs_;
    std::vector<OutputQuantity> outputs_;
};

TrialsOfOutput trials_of(
    const Distribution& distribution, std::uint64_t trials,
    std::function<double(double)> function = [](double x) { return x; }) {
    return {.model = std::make_shared<const OfOneInput>(distribution, std::move(function)),
            .unit = Unit::parse("mm"),
            .seed = 3,
            .streams = {},
            .trials = trials};
}

TEST(CountTrials, GivesTheSameForAnyNumberOfThreads) {
    TrialsOfOutput of = trials_of(Distribution::uniform(9.9, 0.2), 50001);
    const TrialDistribution one = count_trials(of);
    of.threads = 3;
    const TrialDistribution three = count_trials(of);
    EXPECT_EQ(one.counted, 50001U);
    for (const double x : {9699.0, 9712.0, 9900.0, 10099.9, 10101.0}) {
        EXPECT_EQ(one.function(x), three.function(x));
    }
    EXPECT_EQ(one.function(9699.0), 0.0);
    EXPECT_EQ(one.function(10101.0), 1.0);
    EXPECT_NEAR(one.function(9900.0), 0.5, 0.01);
}

TEST(CountTrials, CountsTheTrialsThatMonteCarloDrew) {
    const TrialsOfOutput of = trials_of(Distribution::uniform(9.9, 0.2), 999);
    const TrialDistribution counted = count_trials(of);
    int below = 0;
    for (std::uint64_t trial = 0; trial < 999; ++trial) {
        below += monte_carlo_trial(*of.model, of.seed, trial)(0) <= 9.85 ? 1 : 0;
    }
    EXPECT_NEAR(counted.function(9850.0), below / 999.0, 1e-14);
}

// max(x, 0) has half of its trials at 0: P(Y ≤ 0) and P(Y < 0) differ by them.
TEST(CountTrials, TellsAtFromBelow) {
    const TrialDistribution counted =
        count_trials(trials_of(Distribution::normal(0.0, 1.0), 20000, [](double x) { return std::max(x, 0.0); }));
    EXPECT_EQ(counted.below(0.0), 0.0);
    EXPECT_NEAR(counted.function(0.0), 0.5, 0.02);
}

// P(|T| > a) of a t-distribution falls off like a^−ν; a bounded distribution has no tail.
TEST(TailIndex, IsTheExponentOfTheTails) {
    const TailIndex of_one = tail_index(trials_of(Distribution::student_t(0.0, 1.0, 1.0), 1'000'000));
    EXPECT_TRUE(of_one.is_below(1.1));
    EXPECT_NEAR(of_one.standard_error, of_one.exponent / std::sqrt(1000.0), 1e-12);
    const TailIndex of_three = tail_index(trials_of(Distribution::student_t(0.0, 1.0, 3.0), 1'000'000));
    EXPECT_TRUE(of_three.is_above(2.0));
    EXPECT_LT(of_three.exponent, 3.4);
    EXPECT_FALSE(of_three.is_above(of_three.exponent));
    EXPECT_FALSE(of_three.is_below(of_three.exponent));
    EXPECT_TRUE(tail_index(trials_of(Distribution::uniform(0.0, 1.0), 1'000'000)).is_above(20.0));
    EXPECT_TRUE(std::isinf(tail_index(trials_of(Distribution::normal(0.0, 1.0), 100)).exponent));
}

// The step from the limit of a clipped distribution to the trials beyond it is no tail.
TEST(TailIndex, OfAClippedDistributionIsThatOfWhatIsClipped) {
    for (const double centre : {-2.0, -2.5, -3.0}) {
        EXPECT_TRUE(tail_index(trials_of(Distribution::normal(centre, 1.0), 1'000'000,
                                         [](double x) { return std::max(x, 0.0); }))
                        .is_above(2.0))
            << centre;
    }
    // A power law behind a limit stays one.
    EXPECT_TRUE(tail_index(trials_of(Distribution::student_t(0.0, 1.0, 1.0), 1'000'000, [](double x) {
                    return std::max(x, 3.0);
                })).is_below(1.5));
}

}  // namespace
}  // namespace gumcert::gum
