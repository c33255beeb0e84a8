#include "reports/record/make/comparison/budget_sources.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/budget_campaign.h"

namespace gumcert::reports {
namespace {

using Sources = std::vector<gum::UncertaintySource>;

const gum::Unit k_um_of_sources = gum::Unit::parse("um");

TEST(UncertaintySources, AreSignedContributionsInTheUnitOfTheComparison) {
    const jobs::BudgetJob job = jobs::test::read_budget(R"("model": ["y = a - 2*b"], "inputs": {
        "a": {"value": 1, "unit": "mm", "u": 0.003, "source": "gauge"},
        "b": {"unit": "um", "components": [
            {"name": "scale", "value": 5, "u": 0.2, "source": "laser"},
            {"name": "reading", "value": 0, "u": 0.1},
            {"name": "drift", "value": 0, "u": 0.3, "source": "laser"}]}},
        "outputs": {"y": {"unit": "mm"}})");
    const Sources found = uncertainty_sources(job, gum::evaluate_budget(job, 1), 0, 0, k_um_of_sources);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].source, "gauge");
    EXPECT_EQ(found[0].input, "a");
    EXPECT_NEAR(found[0].contribution, 3.0, 1e-12);
    EXPECT_EQ(found[1].input, "b, scale");
    EXPECT_NEAR(found[1].contribution, -0.4, 1e-12);
    EXPECT_EQ(found[2].input, "b, drift");
    EXPECT_NEAR(found[2].contribution, -0.6, 1e-12);
}

TEST(UncertaintySources, OfAPointThatStatesItsOwnInput) {
    const jobs::BudgetJob job = jobs::test::read_budget(R"("model": ["y = a + b"], "inputs": {
        "a": {"value": 1, "unit": "um", "u": 0.3, "source": "laser"},
        "b": {"value": 1, "unit": "um", "u": 0.1, "source": "indicator"}},
        "points": [{"point": "P", "b": {"value": 7, "u": 0.2, "source": "indicator"}}, {"point": "Q"}])");
    const gum::BudgetResult result = gum::evaluate_budget(job, 1);
    const Sources all = uncertainty_sources(job, result, 0, 0, k_um_of_sources);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_NEAR(all[1].contribution, 0.2, 1e-12);
    const Sources common = uncertainty_sources(job, result, 0, 0, k_um_of_sources, true);
    ASSERT_EQ(common.size(), 1U);
    EXPECT_EQ(common[0].source, "laser");
    EXPECT_EQ(uncertainty_sources(job, result, 1, 0, k_um_of_sources, true).size(), 2U);
}

}  // namespace
}  // namespace gumcert::reports
