// The law of propagation through the model of the table gives the covariance of the adjustment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/rotary_table_evaluation.h"
#include "gum/propagation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert {
namespace {

using engine::synthetic::CampaignPlan;

CampaignPlan plan_of(int variant) {
    CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(12);
    plan.axis = variant == 0 ? engine::RotaryAxis::a : variant == 1 ? engine::RotaryAxis::b : engine::RotaryAxis::c;
    plan.datum = variant == 1 ? engine::Datum::home : engine::Datum::axis_average_line;
    if (variant == 0) {
        return plan;  // perfect table, scale fixed, one dead path a station
    }
    plan.both_senses = true;
    plan.dead_paths = engine::synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    plan.scale_model = engine::ScaleModel::prior;
    plan.u_scale = 1e-7;
    plan.temperature_difference = 1.2;
    plan.u_temperature = 0.05;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 1e-6;
    plan.missing_share = 0.05;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    return plan;
}

class RotaryTablePropagation : public testing::TestWithParam<int> {};

TEST_P(RotaryTablePropagation, CovarianceIsThatOfTheAdjustment) {
    const auto campaign = simulate(plan_of(GetParam()));
    const auto solution = engine::evaluate_jointly(campaign.measurement, engine::EvaluationOptions{});
    const gum::Propagation propagation = gum::propagate(*solution.model, 0.9545);
    EXPECT_LT((propagation.value - solution.values).cwiseAbs().maxCoeff(), 1e-12);
    const Eigen::VectorXd u = solution.covariance.diagonal().cwiseSqrt();
    double largest = 0.0;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
        for (Eigen::Index k = 0; k <= i; ++k) {
            if (u[i] > 1e-15 && u[k] > 1e-15) {  // zero at home in the home datum
                largest = std::max(largest,
                                   std::abs(propagation.covariance(i, k) - solution.covariance(i, k)) / (u[i] * u[k]));
            }
        }
    }
    // The two matrices are made with weights that rest on slightly different dead paths: 4e-8 has been seen.
    EXPECT_LT(largest, 2e-7);
    // Contributions of the budget add to the variance; no share is negative.
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(u.size());
    for (const gum::BudgetContribution& contribution : propagation.budget) {
        EXPECT_GE(contribution.variance.minCoeff(), 0.0) << contribution.name;
        sum += contribution.variance;
    }
    EXPECT_LT((sum - propagation.standard_uncertainty.cwiseAbs2()).cwiseAbs().maxCoeff(),
              1e-12 * propagation.standard_uncertainty.cwiseAbs2().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Campaigns, RotaryTablePropagation, testing::Values(0, 1, 2));

TEST(RotaryTableBudget, ErrorsComeFromTheLengthsAndSetUpFromTheCmm) {
    // rotary-table.md, 4d: CMM times five changes nothing in E, and O and S depend on the CMM only.
    CampaignPlan plan;
    plan.datum = engine::Datum::home;
    const auto campaign = simulate(plan);
    const auto solution = engine::evaluate_jointly(campaign.measurement, engine::EvaluationOptions{});
    const gum::Propagation propagation = gum::propagate(*solution.model, 0.9545);
    for (const gum::BudgetContribution& contribution : propagation.shares_by_source) {
        if (contribution.name == "fixture CMM") {
            EXPECT_LT(contribution.share.head(solution.quantities.set_up).maxCoeff(), 0.01);
            EXPECT_GT(contribution.share.segment<4>(solution.quantities.set_up).minCoeff(), 0.8);
        }
    }
}

}  // namespace
}  // namespace gumcert
