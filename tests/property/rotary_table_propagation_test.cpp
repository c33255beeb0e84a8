// The law of propagation through the model of the table gives the covariance of the adjustment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/table_parameters.h"
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
    plan.reversal_model = variant == 3 ? engine::ReversalModel::by_angle : engine::ReversalModel::constant;
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

INSTANTIATE_TEST_SUITE_P(Campaigns, RotaryTablePropagation, testing::Values(0, 1, 2, 3));

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

TEST(TableParameterBudget, IsThatOfTheReportedQuantitiesItIsMadeOf) {
    const auto campaign = simulate(plan_of(1));
    const auto solution = engine::evaluate_jointly(campaign.measurement, engine::EvaluationOptions{});
    const engine::TableParameterModel model(std::dynamic_pointer_cast<const engine::RotaryTableModel>(solution.model),
                                            solution.datum);
    const gum::Propagation all = gum::propagate(*solution.model, 0.9545);
    const gum::Propagation propagation = gum::propagate(model, 0.9545);
    // U of a range from the full covariance: u² of the highest and the lowest angle less twice their covariance.
    for (Eigen::Index k = 0; k < 6; ++k) {
        Eigen::Index low = k;
        Eigen::Index high = k;
        for (Eigen::Index i = k; i < 6 * 12; i += 6) {
            low = all.value[i] < all.value[low] ? i : low;
            high = all.value[i] > all.value[high] ? i : high;
        }
        EXPECT_DOUBLE_EQ(propagation.value[k], all.value[high] - all.value[low]);
        const double variance = all.covariance(low, low) + all.covariance(high, high) - 2.0 * all.covariance(low, high);
        EXPECT_NEAR(propagation.standard_uncertainty[k], std::sqrt(variance), 1e-8 * std::sqrt(variance));
    }
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(propagation.value.size());
    Eigen::Vector4d of_fixture = Eigen::Vector4d::Zero();
    for (const gum::BudgetContribution& contribution : propagation.budget) {
        sum += contribution.share;
        if (contribution.name == "CMM coordinates of the fixture" || contribution.name == "dead paths") {
            of_fixture += contribution.share.segment<4>(6);
        }
        if (contribution.name == "table repeatability, axial") {
            // The positions of the runs are what is measured: the axial deviations of the table are no error of them,
            // but for what they do to dead paths and stations. Taken for errors they would have most of the variance.
            EXPECT_LT(contribution.share.tail(model.parameters()->layout().positioning_count).maxCoeff(), 0.2);
        }
    }
    // The axis in the frame of the fixture is known as well as that frame, and the dead paths that rest on it.
    EXPECT_GT(of_fixture.minCoeff(), 0.9);
    EXPECT_LT((sum.array() - 1.0).abs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace gumcert
