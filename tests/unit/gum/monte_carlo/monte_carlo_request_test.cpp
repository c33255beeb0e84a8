#include "gum/monte_carlo/monte_carlo_request.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::gum {
namespace {

TEST(MonteCarloRequest, IsAdaptiveUnlessTheTrialsAreCounted) {
    const MonteCarloOptions adaptive = monte_carlo_options({.trials = {}, .digits = 1, .seed = 4, .where = {}}, 2, {});
    ASSERT_TRUE(adaptive.adaptive.has_value());
    EXPECT_EQ(adaptive.adaptive->digits, 1);
    EXPECT_EQ(adaptive.adaptive->tolerance_divisor, 1.0);
    EXPECT_EQ(adaptive.seed, 4U);
    EXPECT_EQ(adaptive.threads, 2U);
    EXPECT_FALSE(adaptive.progress);
    const MonteCarloOptions counted = monte_carlo_options({.trials = 5000, .where = {}}, 1, {});
    EXPECT_FALSE(counted.adaptive.has_value());
    EXPECT_EQ(counted.trials, 5000U);
}

// JCGM 101:2008, 8.2: the trials of a validation have a tolerance of a fifth.
TEST(MonteCarloRequest, AsksForMoreWhereTheLawIsValidated) {
    EXPECT_EQ(monte_carlo_options({.trials = {}, .validate = true, .where = {}}, 1, {}).adaptive->tolerance_divisor,
              5.0);
}

TEST(MonteCarloRequest, TellsHowFarTheTrialsAre) {
    std::vector<std::string> said;
    const MonteCarloOptions options = monte_carlo_options(
        {.trials = 1, .where = {}}, 1, [&](const std::string& sentence) { said.push_back(sentence); });
    options.progress(0.25);
    EXPECT_EQ(said, std::vector<std::string>{"Monte Carlo, 25 %"});
}

}  // namespace
}  // namespace gumcert::gum
