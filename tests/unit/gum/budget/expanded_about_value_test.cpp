#include "gum/budget/expanded_about_value.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gum/coverage.h"
#include "gum/monte_carlo/trial_distribution.h"
#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

BudgetResult trials_of(Budget of) {
    of.coverage = CoverageChoice::monte_carlo;
    MonteCarloRequest& request = of.monte_carlo.emplace();
    request.trials = 100000;
    request.seed = 3;
    return evaluate_budget(of, 1);
}

Budget normal_one() {
    return test::budget({"y = a"}, {test::input("a", state_uncertainty(5, 0.2))});
}

TEST(ExpandedAboutValue, IsTheSmallestThatHoldsTheShare) {
    const std::vector<Budget> budgets = {
        test::budget({"h = L * cos(f)"}, {test::input("L", state_uncertainty(0.1, 5e-8), "m"),
                                          test::input("f", test::rectangular(0, 0.009), "rad")}),
        test::budget({"y = a + b"}, {test::input("a", state_uncertainty(5, 0.2)),
                                     test::input("b", test::shaped(DistributionKind::exponential, 0.0, 1.0))}),
        normal_one()};
    for (const Budget& budget : budgets) {
        const BudgetResult result = trials_of(budget);
        const BudgetPointResult& point = result.points.front();
        const double y = point.outputs.front().monte_carlo->mean;
        const TrialDistribution trials = count_trials(
            {.model = point.model, .output = 0, .unit = {}, .seed = 3, .streams = point.streams, .trials = 100000});
        for (const double p : {0.5, 0.9545, 0.99}) {
            const double U = expanded_about_value(point, 0, p);
            const auto share = [&](double width) { return trials.function(y + width) - trials.below(y - width); };
            EXPECT_GE(share(U), p) << budget.model.front().text;
            EXPECT_LT(share(U * (1.0 - 1e-3)), p) << budget.model.front().text;
        }
    }
}

TEST(ExpandedAboutValue, IsThatOfANormalDistribution) {
    const BudgetResult result = trials_of(normal_one());
    EXPECT_NEAR(expanded_about_value(result.points.front(), 0, 0.9545), 0.2 * coverage_factor(0.9545, INFINITY), 0.006);
}

}  // namespace
}  // namespace gumcert::gum
