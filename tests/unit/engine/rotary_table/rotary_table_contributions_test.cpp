// The law of propagation without its sensitivity coefficients gives the numbers of the one with all of them.
#include "engine/rotary_table/rotary_table_contributions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::CampaignPlan;

// Relative to the variance of the quantity, or to the uncertainties of a pair; the rounding of the dense algebra.
constexpr double k_equal_sums = 1e-9;

struct Dense {
    Eigen::MatrixXd jacobian;
    std::vector<Eigen::VectorXd> variance;
    Eigen::MatrixXd covariance;
};

/// C V Cᵀ with the whole C.
Dense dense_law(const gum::MeasurementModel& model) {
    Dense result;
    result.jacobian = model.jacobian(gum::input_estimates(model));
    const Eigen::MatrixXd& all = result.jacobian;
    result.covariance = Eigen::MatrixXd::Zero(all.rows(), all.rows());
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        const auto part = all.middleCols(first, group.size());
        const Eigen::MatrixXd covariance =
            group.is_diagonal() ? Eigen::MatrixXd(part * group.covariance.col(0).asDiagonal() * part.transpose())
                                : Eigen::MatrixXd(part * group.covariance * part.transpose());
        result.variance.emplace_back(covariance.diagonal());
        result.covariance += covariance;
        first += group.size();
    }
    return result;
}

void expect_same(const RotaryTableContributions& found, const Dense& expected, const gum::MeasurementModel& model) {
    const Eigen::VectorXd total = expected.covariance.diagonal();
    ASSERT_EQ(found.variance.size(), expected.variance.size());
    Eigen::Index first = 0;
    for (std::size_t g = 0; g < expected.variance.size(); ++g) {
        for (Eigen::Index i = 0; i < total.size(); ++i) {
            EXPECT_NEAR(found.variance[g][i], expected.variance[g][i], k_equal_sums * total[i] + 1e-40)
                << model.inputs()[g].name << ", quantity " << i;
        }
        if (model.inputs()[g].size() == 1) {
            EXPECT_LT((found.sensitivity[g] - expected.jacobian.col(first)).norm(),
                      1e-7 * expected.jacobian.col(first).norm());
        } else {
            EXPECT_EQ(found.sensitivity[g].size(), 0);
        }
        first += model.inputs()[g].size();
    }
    for (Eigen::Index i = 0; i < total.size(); ++i) {
        for (Eigen::Index j = 0; j <= i; ++j) {
            EXPECT_NEAR(found.covariance(i, j), expected.covariance(i, j),
                        k_equal_sums * std::sqrt(total[i] * total[j]) + 1e-40)
                << i << ' ' << j;
        }
    }
}

/// A campaign of its own for every seed: axis, datum, senses, gaps, priors, dead paths and resolution change with it.
CampaignPlan plan_of(unsigned seed) {
    constexpr std::array<RotaryAxis, 3> k_axes{RotaryAxis::a, RotaryAxis::b, RotaryAxis::c};
    CampaignPlan plan;
    plan.seed = seed;
    plan.axis = k_axes[seed % 3];
    plan.datum = seed % 2 == 0 ? Datum::home : Datum::axis_average_line;
    plan.home = seed % 4;
    plan.angles_deg = synthetic::full_turn(5 + static_cast<int>(seed % 6));
    plan.both_senses = seed % 4 < 2;
    plan.reversal_model = seed % 8 < 2 ? ReversalModel::by_angle : ReversalModel::constant;
    plan.dead_paths =
        seed % 5 == 0 ? synthetic::DeadPaths::per_station_and_reflector : synthetic::DeadPaths::per_station;
    plan.missing_share = seed % 3 == 0 ? 0.1 : 0.0;
    plan.table_linear = 0.2e-6;
    plan.table_axial = 2e-6;
    plan.table_tilt = 1e-6;
    plan.start_values = true;
    if (seed % 2 == 1) {
        plan.scale_model = ScaleModel::prior;
        plan.u_scale = 1.5e-7;
    }
    if (seed % 3 != 1) {
        plan.temperature_difference = 0.2;
        plan.u_temperature = 0.027;
        plan.expansion = 11.5e-6;
        plan.u_expansion = 5e-7;
    }
    return plan;
}

TEST(RotaryTableContributions, AreThoseOfAllSensitivityCoefficients) {
    for (unsigned seed = 1; seed <= 24; ++seed) {
        SCOPED_TRACE(seed);
        synthetic::Campaign campaign = synthetic::simulate(plan_of(seed));
        campaign.measurement.table_repeatability.mode = RepeatabilityMode::given;
        campaign.measurement.length_uncertainty.resolution = seed % 4 == 3 ? 1e-7 : 0.0;
        if (seed % 6 == 0) {
            Eigen::MatrixXd& covariance = campaign.measurement.fixture_covariance;
            covariance(0, 1) = covariance(1, 0) = 0.5 * covariance(0, 0);
        }
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        const auto model = std::dynamic_pointer_cast<const RotaryTableModel>(solution.model);
        expect_same(contributions_of(*model), dense_law(*model), *model);
        const ContactPointModel contact(model, campaign.measurement, solution.datum, {0.02, -0.03, 0.15});
        expect_same(contributions_of(*model, contact), dense_law(contact), contact);
    }
}

TEST(RotaryTableContributions, AreNotNegativeWhereTheDatumTakesThemAway) {
    CampaignPlan plan = plan_of(2);
    plan.datum = Datum::home;
    const synthetic::Campaign campaign = synthetic::simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const auto model = std::dynamic_pointer_cast<const RotaryTableModel>(solution.model);
    const RotaryTableContributions found = contributions_of(*model);
    const auto home = static_cast<Eigen::Index>(6 * campaign.measurement.home);
    for (const Eigen::VectorXd& variance : found.variance) {
        EXPECT_GE(variance.minCoeff(), 0.0);
        EXPECT_TRUE(variance.segment<6>(home).isZero(0.0)) << "error motions at home are zero by definition";
    }
    EXPECT_TRUE(found.covariance.of_angle(home / 6).isZero(0.0));
}

}  // namespace
}  // namespace gumcert::engine
