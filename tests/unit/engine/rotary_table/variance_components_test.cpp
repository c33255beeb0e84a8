// Variance components are recovered from simulated campaigns within what is stated of them.
#include "engine/rotary_table/variance_components.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/evaluation/sequential_evaluation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

/// Campaign whose components are to be estimated, from start values that say nothing of the truth.
Campaign to_estimate(const CampaignPlan& plan) {
    Campaign campaign = simulate(plan);
    campaign.measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    campaign.measurement.estimate_length_noise = true;
    return campaign;
}

CampaignPlan table_with_repeatability() {
    CampaignPlan plan;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 5e-6 / 3.0;
    return plan;
}

bool has_note(const RotaryTableSolution& solution, const char* code) {
    return std::any_of(solution.notes.begin(), solution.notes.end(),
                       [code](const gum::Diagnostic& note) { return note.code == code; });
}

TEST(VarianceComponents, AreRecoveredWithinTheirStatedUncertainty) {
    // Fisher information of the same four components by an independent program (tools/rotary_model_check.py, D4, with
    // the tilt added) at the true values.
    const std::array<double, 4> relative{0.0280, 0.0823, 0.0793, 0.0926};
    const std::array<double, 4> redundancy{719.5, 93.7, 119.7, 117.4};
    double squares = 0.0;
    constexpr int k_campaigns = 6;
    for (int k = 0; k < k_campaigns; ++k) {
        CampaignPlan plan = table_with_repeatability();
        plan.axis = std::array{RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}[static_cast<std::size_t>(k % 3)];
        plan.seed = 2000 + static_cast<std::uint64_t>(k);
        const Campaign campaign = to_estimate(plan);
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        ASSERT_EQ(solution.components.size(), 5U);
        EXPECT_FALSE(has_note(solution, "GC-VARIANCE-0001")) << "not converged";
        const std::array<double, 4> truth{rms_length_noise(plan, campaign), plan.table_linear, plan.table_axial,
                                          plan.table_tilt};
        for (std::size_t c = 0; c < 4; ++c) {
            const VarianceComponent& component = solution.components[c];
            EXPECT_TRUE(component.estimated);
            EXPECT_EQ(component.angular, c >= 2);
            // u grows with the estimate: a low estimate states a low u, and the truth looks further off than it is.
            const double u = std::max(component.u, relative[c] * truth[c]);
            EXPECT_LT(std::abs(component.value - truth[c]), 3.0 * u) << component.name << ", seed " << plan.seed;
            // u of a standard deviation from ν degrees of freedom: s/sqrt(2ν).
            EXPECT_NEAR(component.u / component.value * std::sqrt(2.0 * component.degrees_of_freedom), 1.0, 1e-9)
                << component.name;
            squares += std::pow((component.value - truth[c]) / component.u, 2) / (4.0 * k_campaigns);
        }
        for (std::size_t c = 0; c < 4; ++c) {
            const VarianceComponent& component = solution.components[c];
            EXPECT_NEAR(component.u / component.value / relative[c], 1.0, c == 0 ? 0.1 : 0.4) << component.name;
            EXPECT_NEAR(component.redundancy / redundancy[c], 1.0, c == 0 ? 0.1 : 0.4) << component.name;
        }
        // At convergence of restricted maximum likelihood the residuals fill the degrees of freedom, up to what the CMM
        // coordinates (not estimated, 18 observations) differ from theirs.
        EXPECT_NEAR(solution.chi_square / static_cast<double>(solution.degrees_of_freedom), 1.0, 0.03);
    }
    // 24 normalised deviations, nearly independent: their rms is 1 ± 0.14.
    EXPECT_GT(std::sqrt(squares), 0.6);
    EXPECT_LT(std::sqrt(squares), 1.4);
}

TEST(VarianceComponents, ComponentsAreAFixedPoint) {
    const CampaignPlan plan = table_with_repeatability();
    const Campaign campaign = to_estimate(plan);
    const RotaryTableMeasurement& measurement = campaign.measurement;
    const RotaryTableSolution solution = evaluate_jointly(measurement, EvaluationOptions{});
    JointAdjustment adjustment(measurement, std::vector<bool>(measurement.lengths.size(), true),
                               rigid_motion(solution.datum.set_up),
                               StartValues{campaign.truth.stations, solution.dead_paths}, solution.stochastic);
    ASSERT_TRUE(adjustment.adjustment().solve(SolverOptions{}).converged);
    adjustment.set_weights(solution.stochastic);
    ASSERT_TRUE(adjustment.adjustment().refine(SolverOptions{}).converged);
    const NormalEquations normal = adjustment.adjustment().linearise();
    const VarianceComponentStep step =
        estimate_variance_components(adjustment, normal, normal.bordered_covariance(), solution.stochastic, {});
    EXPECT_LT(step.relative_change, 1e-4);
    EXPECT_NEAR(step.stochastic.length_factor / solution.stochastic.length_factor, 1.0, 1e-5);
    EXPECT_NEAR(step.stochastic.variance_linear / solution.stochastic.variance_linear, 1.0, 1e-4);
    EXPECT_NEAR(step.stochastic.variance_axial / solution.stochastic.variance_axial, 1.0, 1e-4);
    EXPECT_NEAR(step.stochastic.variance_tilt / solution.stochastic.variance_tilt, 1.0, 1e-4);
    // Redundancies of the components add to the degrees of freedom: Σ θ tr(R V_k) = tr(R V).
    double redundancy = 0.0;
    for (const VarianceComponent& component : step.components) {
        redundancy += component.redundancy;
    }
    EXPECT_NEAR(step.components[fixture_cmm].redundancy,
                fixture_redundancy(adjustment, normal, normal.bordered_covariance()), 1e-9);
    EXPECT_NEAR(redundancy, static_cast<double>(solution.degrees_of_freedom), 1e-3);
}

TEST(VarianceComponents, LengthNoiseStatedWrongIsCorrected) {
    CampaignPlan plan;
    plan.seed = 9;
    Campaign campaign = simulate(plan);
    campaign.measurement.length_uncertainty.u_constant *= 3.0;
    campaign.measurement.length_uncertainty.u_proportional *= 3.0;
    campaign.measurement.estimate_length_noise = true;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_NEAR(solution.stochastic.length_factor, 1.0 / 9.0, 0.15 / 9.0);
    const double truth = rms_length_noise(plan, campaign);
    EXPECT_LT(std::abs(solution.components[0].value - truth), 3.0 * solution.components[0].u);
    EXPECT_NEAR(*solution.components[0].stated / (3.0 * truth), 1.0, 1e-5);
    // Components that are given are not touched and rest on what was stated.
    for (std::size_t c = 1; c < 4; ++c) {
        EXPECT_FALSE(solution.components[c].estimated);
        EXPECT_EQ(solution.components[c].u, 0.0);
        EXPECT_TRUE(std::isinf(solution.components[c].degrees_of_freedom));
    }
}

// One factor multiplies both parts: what is shown is the noise that the distances have, however it is stated.
TEST(VarianceComponents, LengthNoiseIsTheSameHoweverItIsStated) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.u_constant = 0.1e-6;
    plan.u_proportional = 0.0;
    plan.seed = 41;
    Campaign campaign = simulate(plan);
    campaign.measurement.estimate_length_noise = true;
    for (const auto& [constant, proportional] :
         {std::pair{0.1e-6, 0.0}, std::pair{0.05e-6, 1e-6}, std::pair{0.05e-6, 0.3e-6}, std::pair{1e-12, 0.5e-6},
          std::pair{0.0, 0.1e-6}, std::pair{2e-6, 0.1e-6}}) {
        SCOPED_TRACE(std::to_string(1e6 * constant) + " µm, " + std::to_string(1e6 * proportional) + " µm/m");
        campaign.measurement.length_uncertainty.u_constant = constant;
        campaign.measurement.length_uncertainty.u_proportional = proportional;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        const VarianceComponent& noise = solution.components[length_noise];
        // Weights that fall with the distance let short ones say more: the root mean square follows them by some percent.
        EXPECT_NEAR(noise.value / 0.1e-6, 1.0, 0.2);
        EXPECT_NEAR(noise.value / *noise.stated, std::sqrt(solution.stochastic.length_factor), 1e-6);
        CampaignPlan stated = plan;
        stated.u_constant = constant;
        stated.u_proportional = proportional;
        EXPECT_NEAR(*noise.stated / rms_length_noise(stated, campaign), 1.0, 1e-5);
    }
}

TEST(VarianceComponents, PerfectTableHasNoRepeatabilityToSpeakOf) {
    for (const std::uint64_t seed : {60U, 61U, 62U, 63U}) {
        CampaignPlan plan;
        plan.seed = seed;
        const Campaign campaign = to_estimate(plan);
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        EXPECT_FALSE(has_note(solution, "GC-VARIANCE-0001")) << "not converged";
        EXPECT_LT(std::abs(solution.components[0].value - rms_length_noise(plan, campaign)),
                  3.0 * solution.components[0].u);
        for (std::size_t c = 1; c < 4; ++c) {
            const VarianceComponent& component = solution.components[c];
            EXPECT_GE(component.value, 0.0);
            EXPECT_LT(component.value, component.angular ? 1.2e-6 : 0.1e-6) << component.name << ", seed " << seed;
            EXPECT_GT(component.u, 0.0);
            EXPECT_LT(component.value, 6.0 * component.u) << component.name << ", seed " << seed;
            EXPECT_TRUE(std::isfinite(component.u));
        }
        EXPECT_TRUE(solution.covariance.diagonal().allFinite());
    }
}

/// A step with one component of the table, θ̂ = `variance` with the standard uncertainty `u`.
VarianceComponentStep step_with(std::size_t row, double variance, double u) {
    VarianceComponentStep step;
    step.components.resize(5);
    VarianceComponent& component = step.components[row];
    component.angular = row != table_linear;
    component.estimated = true;
    component.value = std::sqrt(variance);
    component.u = variance > 0.0 ? std::min(0.5 * u / component.value, std::sqrt(u)) : std::sqrt(u);
    component.degrees_of_freedom = variance > 0.0 ? 2.0 * variance * variance / (u * u) : static_cast<double>(INFINITY);
    return step;
}

// Law: whatever the estimate and its uncertainty, what is taken is at least the estimate, has a u and finite degrees of
// freedom, rises with the estimate without a leap, scales with the unit, and is the estimate where it is determined.
TEST(VarianceComponents, WhatIsPlausibleIsNeverLessThanTheEstimateAndNeverKnown) {
    for (const std::size_t row : {table_linear, table_axial, table_tilt}) {
        for (const double u : {1e-18, 1e-15, 3e-13}) {
            double last = 0.0;
            for (int i = 0; i <= 1000; ++i) {
                const double variance = 0.01 * i * u;
                VarianceComponentStep step = step_with(row, variance, u);
                take_plausible_components(step);
                const VarianceComponent& taken = step.components[row];
                const double square = taken.value * taken.value;
                EXPECT_GE(square, variance * (1.0 - 1e-12)) << i;
                EXPECT_GT(square, 0.75 * u) << i;
                EXPECT_GT(square, last) << i;
                EXPECT_LT(square - last, i == 0 ? u : 0.0102 * u) << i;
                last = square;
                EXPECT_GT(taken.u, 0.0);
                EXPECT_GT(taken.degrees_of_freedom, 3.5) << i;
                EXPECT_TRUE(std::isfinite(taken.degrees_of_freedom));
                // u of a standard deviation with ν degrees of freedom: s/√(2ν).
                EXPECT_NEAR(taken.u / taken.value * std::sqrt(2.0 * taken.degrees_of_freedom), 1.0, 1e-9) << i;
                if (i != 400) {  // the very limit, up to rounding
                    EXPECT_EQ(taken.residuals_give.has_value(), i < 400) << i;
                }
                EXPECT_TRUE(taken.determined);
                if (taken.residuals_give) {
                    EXPECT_EQ(*taken.residuals_give, std::sqrt(variance));
                    const double in_weights = row == table_linear  ? step.stochastic.variance_linear
                                              : row == table_axial ? step.stochastic.variance_axial
                                                                   : step.stochastic.variance_tilt;
                    EXPECT_DOUBLE_EQ(in_weights, square);
                } else {
                    EXPECT_EQ(taken.value, std::sqrt(variance));
                }
            }
        }
        // Half of a standard normal distribution: mean √(2/π), variance 1 − 2/π.
        VarianceComponentStep half = step_with(row, 0.0, 1e-14);
        take_plausible_components(half);
        EXPECT_NEAR(std::pow(half.components[row].value, 2) / 1e-14, std::sqrt(2.0 / std::numbers::pi), 1e-12);
        EXPECT_NEAR(half.components[row].degrees_of_freedom, 4.0 / std::numbers::pi / (1.0 - 2.0 / std::numbers::pi),
                    1e-9);
        for (const double u : {1e-5, 1e300, static_cast<double>(INFINITY)}) {
            VarianceComponentStep open = step_with(row, 0.0, u);
            take_plausible_components(open);
            EXPECT_FALSE(open.components[row].determined) << u;
        }
        VarianceComponentStep given = step_with(row, 1e-20, 1e-14);
        given.components[row].estimated = false;
        take_plausible_components(given);
        EXPECT_EQ(given.components[row].value, 1e-10);
    }
}

// Three stations in one pass hardly determine the repeatability: components came out 0 and counted as known (67 % of the
// truth within U), or nearly 0 with ν near 0 (U of 1E+69 µm).
TEST(VarianceComponents, HardlyDeterminedComponentsAreInTheUncertainty) {
    std::size_t within = 0;
    std::size_t all = 0;
    std::size_t told = 0;
    for (std::uint64_t seed = 700; seed < 712; ++seed) {
        CampaignPlan plan;
        plan.angles_deg = synthetic::full_turn(12);
        plan.stations.resize(3);
        plan.u_constant = 0.1e-6;
        plan.u_proportional = 0.0;
        plan.table_linear = 0.15e-6;
        plan.table_axial = plan.table_tilt = 1e-6;
        plan.axis = std::array{RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}[seed % 3];
        plan.seed = seed;
        Campaign campaign = to_estimate(plan);
        campaign.measurement.estimate_length_noise = false;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        for (std::size_t c = table_linear; c <= table_tilt; ++c) {
            EXPECT_GT(solution.components[c].value, 0.0) << solution.components[c].name << ", seed " << seed;
            EXPECT_GT(solution.components[c].degrees_of_freedom, 3.5) << solution.components[c].name;
            EXPECT_TRUE(std::isfinite(solution.components[c].degrees_of_freedom)) << solution.components[c].name;
        }
        EXPECT_DOUBLE_EQ(solution.stochastic.variance_linear, std::pow(solution.components[table_linear].value, 2));
        told += has_note(solution, "GC-VARIANCE-0007") ? 1U : 0U;
        const Eigen::VectorXd deviation = solution.values - campaign.true_values(false);
        for (Eigen::Index i = 0; i < deviation.size(); ++i) {
            const double u = std::sqrt(solution.covariance.diagonal()[i]);
            all += u > 0.0 ? 1U : 0U;
            within += u > 0.0 && std::abs(deviation[i]) <= 2.0 * u ? 1U : 0U;
        }
    }
    EXPECT_GE(told, 8U);
    EXPECT_GT(static_cast<double>(within), 0.95 * static_cast<double>(all)) << within << " of " << all;
}

/// The same distances, and the coordinates of the fixture in a frame that is turned about the axis and shifted along it.
struct OtherFrame {
    int axial;
    double shift, angle;

    [[nodiscard]] Eigen::Vector3d point(const Eigen::Vector3d& p) const {
        return synthetic::turn(axial, angle) * p + shift * Eigen::Vector3d::Unit(axial);
    }
    [[nodiscard]] RotaryTableMeasurement measurement(RotaryTableMeasurement result) const {
        for (Eigen::Index m = 0; m < result.fixture.rows(); ++m) {
            result.fixture.row(m) = point(result.fixture.row(m).transpose()).transpose();
        }
        if (result.table_repeatability.axial_position) {
            *result.table_repeatability.axial_position += shift;
        }
        return result;
    }
    /// Motions of the new origin in the directions of the new frame.
    void carry(Eigen::Ref<Eigen::VectorXd> translation, Eigen::Ref<Eigen::VectorXd> rotation) const {
        const Eigen::Matrix3d to = synthetic::turn(axial, angle);
        const Eigen::Vector3d turned = to * Eigen::Vector3d(rotation);
        const Eigen::Vector3d at_old = to * Eigen::Vector3d(translation);
        rotation = turned;
        translation = at_old - turned.cross(shift * Eigen::Vector3d::Unit(axial));
    }
    /// Reported quantities, which it takes to first order.
    [[nodiscard]] Eigen::VectorXd carried(Eigen::VectorXd values, std::size_t angles, bool has_reversal) const {
        const auto errors = 6 * static_cast<Eigen::Index>(angles);
        for (Eigen::Index i = 0; i < errors; i += 6) {
            carry(values.segment(i, 3), values.segment(i + 3, 3));
        }
        Eigen::VectorXd set_up = Eigen::VectorXd::Zero(6);
        for (int c = 0; c < 2; ++c) {
            set_up[(axial + 1 + c) % 3] = values[errors + c];
            set_up[3 + (axial + 1 + c) % 3] = values[errors + 2 + c];
        }
        carry(set_up.head(3), set_up.tail(3));
        for (int c = 0; c < 2; ++c) {
            values[errors + c] = set_up[(axial + 1 + c) % 3];
            values[errors + 2 + c] = set_up[3 + (axial + 1 + c) % 3];
        }
        if (has_reversal) {
            carry(values.segment(errors + 4, 3), values.segment(errors + 7, 3));
        }
        return values;
    }
};

// Law: where a CMM put the origin of its coordinates along the axis, and how it turned them about it, changes no
// uncertainty. The repeatability of the table acted at the origin: at half a metre U of the tilts was a quarter smaller.
TEST(VarianceComponents, OriginAlongTheAxisIsACoordinate) {
    for (int k = 0; k < 8; ++k) {
        CampaignPlan plan = table_with_repeatability();
        plan.axis = std::array{RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}[static_cast<std::size_t>(k % 3)];
        plan.angles_deg = synthetic::full_turn(12);
        plan.both_senses = k % 4 >= 2;
        plan.reversal << 0.3e-6, -0.2e-6, 0.1e-6, 4e-6, -2e-6, 3e-6;
        plan.seed = 40 + static_cast<std::uint64_t>(k);
        const bool is_given = k % 2 == 0;
        Campaign campaign = is_given ? simulate(plan) : to_estimate(plan);
        if (k >= 4) {
            campaign.measurement.table_repeatability.axial_position = -0.03;
        }
        const OtherFrame frame{axial_coordinate(plan.axis),
                               std::array{0.5, -0.2, 0.0, 1.0}[static_cast<std::size_t>(k / 2)], 0.4 * k};
        const auto solve = [&](const RotaryTableMeasurement& measurement) {
            // The sequential method takes the components of the joint one, and one sense of approach.
            return k % 4 == 0 ? evaluate_sequentially(measurement, EvaluationOptions{})
                              : evaluate_jointly(measurement, EvaluationOptions{});
        };
        const RotaryTableSolution here = solve(campaign.measurement);
        const RotaryTableSolution there = solve(frame.measurement(campaign.measurement));
        for (std::size_t c = table_linear; c <= table_tilt; ++c) {
            EXPECT_NEAR(there.components[c].value / here.components[c].value, 1.0, 1e-3)
                << k << here.components[c].name;
        }
        EXPECT_NEAR(there.chi_square / here.chi_square, 1.0, 1e-4) << k;
        const Eigen::Index n = here.values.size();
        const auto carried = [&](const Eigen::MatrixXd& columns) {
            Eigen::MatrixXd result = columns;
            for (Eigen::Index j = 0; j < columns.cols(); ++j) {
                result.col(j) = frame.carried(columns.col(j), plan.angles_deg.size(), here.quantities.has_reversal);
            }
            return result;
        };
        const Eigen::MatrixXd map = carried(Eigen::MatrixXd::Identity(n, n));
        const Eigen::MatrixXd covariance = map * here.covariance.dense() * map.transpose();
        const Eigen::VectorXd values = map * here.values;
        const Eigen::VectorXd there_variance = there.covariance.diagonal();
        for (Eigen::Index i = 0; i < n; ++i) {
            EXPECT_NEAR(std::sqrt(there_variance[i] / covariance(i, i)), 1.0, 2e-3) << k << ", quantity " << i;
            if (k % 4 !=
                0) {  // the model of the sequential method is linear in set-up errors, and not the same elsewhere
                EXPECT_NEAR((there.values[i] - values[i]) / std::sqrt(covariance(i, i)), 0.0, 0.05)
                    << k << ", quantity " << i;
            }
        }
    }
}

// A table whose tilts are about a point far below the reflectors: where that is stated, its repeatability is found there.
TEST(VarianceComponents, StatedPointIsWhereTheTableDeviates) {
    CampaignPlan plan = table_with_repeatability();
    plan.table_linear = 0.05e-6;
    plan.repeatability_off = -0.4;
    plan.seed = 77;
    Campaign campaign = to_estimate(plan);
    const RotaryTableSolution at_centroid = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_GT(at_centroid.components[table_linear].value, 0.3e-6);  // 0.4 m of 1.7 µrad
    campaign.measurement.table_repeatability.axial_position =
        campaign.truth.fixture.col(axial_coordinate(plan.axis)).mean() - 0.4;
    const RotaryTableSolution at_point = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_LT(at_point.components[table_linear].value, 0.2e-6);
    EXPECT_NEAR(at_point.components[table_tilt].value / plan.table_tilt, 1.0, 0.3);
}

TEST(JointAdjustment, DeviationMovesItsPointByItsTranslation) {
    const Eigen::Vector3d point(0.0, 0.3, 0.0);
    Eigen::Matrix<double, 6, 1> deviation;
    deviation << 1e-7, -2e-7, 3e-7, 1e-6, 2e-6, -3e-6;
    const Eigen::Matrix<double, 6, 1> pose = pose_by_deviation(point) * deviation;
    const Eigen::Vector3d moved = pose.head<3>() + Eigen::Vector3d(pose.tail<3>()).cross(point);
    EXPECT_NEAR((moved - deviation.head<3>()).norm(), 0.0, 1e-20);
    EXPECT_EQ(Eigen::Vector3d(pose.tail<3>()), Eigen::Vector3d(deviation.tail<3>()));
}

TEST(VarianceComponents, SingleDistanceAVisitKeepsTheLengthNoiseAsStated) {
    CampaignPlan plan = table_with_repeatability();
    plan.one_reflector_a_pass = true;
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    plan.seed = 5;
    const Campaign campaign = to_estimate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_EQ(solution.stochastic.length_factor, 1.0);
    EXPECT_FALSE(solution.components[0].estimated);
    EXPECT_NEAR(solution.components[0].value / rms_length_noise(plan, campaign), 1.0, 1e-4);
    EXPECT_TRUE(std::isinf(solution.components[0].degrees_of_freedom));
    EXPECT_TRUE(has_note(solution, "GC-VARIANCE-0002"));
    const std::array<double, 4> truth{plan.u_constant, plan.table_linear, plan.table_axial, plan.table_tilt};
    for (std::size_t c = 1; c < 4; ++c) {
        EXPECT_LT(std::abs(solution.components[c].value - truth[c]), 3.0 * solution.components[c].u)
            << solution.components[c].name;
    }
    const Eigen::VectorXd truth_values = campaign.true_values(false);
    const Eigen::VectorXd normalised =
        (solution.values - truth_values).array() / solution.covariance.diagonal().array().sqrt();
    EXPECT_NEAR(std::sqrt(normalised.squaredNorm() / static_cast<double>(normalised.size())), 1.0, 0.3);
}

/// Probability above chi-square by the series of the incomplete gamma function, enough for tests.
double chi_square_above(double chi_square, double degrees_of_freedom) {
    const double a = 0.5 * degrees_of_freedom;
    const double x = 0.5 * chi_square;
    double term = 1.0 / a;
    double sum = term;
    for (int n = 1; n < 2000; ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return 1.0 - std::exp(a * std::log(x) - x - std::lgamma(a)) * sum;
}

EvaluationOptions with_fixture_test() {
    EvaluationOptions options;
    options.chi_square_upper_tail = chi_square_above;
    return options;
}

TEST(VarianceComponents, TracerAndCmmHaveTheInformationOfTheNote) {
    // rotary-table.md, D4: tracer 2.2 %, CMM 21 %, redundancy of the CMM 11.9, for a perfect table.
    EXPECT_NEAR(chi_square_above(18.307038, 10.0), 0.05, 1e-6);
    double tracer = 0.0;
    double cmm = 0.0;
    double redundancy = 0.0;
    constexpr int k_campaigns = 8;
    for (std::uint64_t seed = 0; seed < k_campaigns; ++seed) {
        CampaignPlan plan;
        plan.seed = 300 + seed;
        Campaign campaign = simulate(plan);
        campaign.measurement.table_repeatability.mode = RepeatabilityMode::none;
        campaign.measurement.estimate_length_noise = true;
        campaign.measurement.fixture_component = FixtureComponent::estimate;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        tracer += solution.components[length_noise].u / solution.components[length_noise].value / k_campaigns;
        cmm += solution.components[fixture_cmm].u / solution.components[fixture_cmm].value / k_campaigns;
        redundancy += solution.components[fixture_cmm].redundancy / k_campaigns;
        EXPECT_TRUE(solution.components[fixture_cmm].used);
        EXPECT_NEAR(solution.components[fixture_cmm].value / *solution.components[fixture_cmm].stated,
                    std::sqrt(solution.stochastic.fixture_factor), 1e-6);
        // Every component estimated: restricted maximum likelihood fills the degrees of freedom exactly.
        EXPECT_NEAR(solution.chi_square / static_cast<double>(solution.degrees_of_freedom), 1.0, 1e-5);
        EXPECT_EQ(solution.variance_basis, VarianceBasis::estimated);
    }
    EXPECT_NEAR(tracer, 0.022, 0.001);
    EXPECT_NEAR(cmm, 0.21, 0.015);
    EXPECT_NEAR(redundancy, 11.9, 0.2);
}

TEST(VarianceComponents, StatedUncertaintyOfEachAgreesWithTheScatterOverCampaigns) {
    constexpr int k_campaigns = 60;
    Eigen::MatrixXd value(5, k_campaigns);
    Eigen::MatrixXd u(5, k_campaigns);
    for (int k = 0; k < k_campaigns; ++k) {
        CampaignPlan plan = table_with_repeatability();
        plan.angles_deg = synthetic::full_turn(24);
        plan.seed = 9000 + static_cast<std::uint64_t>(k);
        Campaign campaign = to_estimate(plan);
        campaign.measurement.fixture_component = FixtureComponent::estimate;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        ASSERT_EQ(solution.components.size(), 5U);
        for (Eigen::Index c = 0; c < 5; ++c) {
            value(c, k) = solution.components[static_cast<std::size_t>(c)].value;
            u(c, k) = solution.components[static_cast<std::size_t>(c)].u;
        }
    }
    CampaignPlan plan = table_with_repeatability();
    plan.angles_deg = synthetic::full_turn(24);
    const Campaign sample = simulate(plan);
    const double cmm = std::sqrt(sample.measurement.fixture_covariance.diagonal().mean());
    const std::array<double, 5> truth{rms_length_noise(plan, sample), plan.table_linear, plan.table_axial,
                                      plan.table_tilt, cmm};
    for (Eigen::Index c = 0; c < 5; ++c) {
        const double mean = value.row(c).mean();
        const double scatter = std::sqrt((value.row(c).array() - mean).square().sum() / (k_campaigns - 1));
        const double stated = std::sqrt(u.row(c).squaredNorm() / k_campaigns);
        // A scatter of 60 is known to 9 %; a mean of 60, to 0.13 of the scatter. A standard deviation with 12 degrees
        // of freedom is low by 2 % in the mean.
        EXPECT_NEAR(scatter / stated, 1.0, 0.27) << "component " << c;
        EXPECT_LT(std::abs(mean - truth[static_cast<std::size_t>(c)]), 0.45 * scatter) << "component " << c;
    }
}

TEST(VarianceComponents, CheckOfTheFixtureDoesNotTouchTheResult) {
    CampaignPlan plan = table_with_repeatability();
    plan.seed = 12;
    Campaign campaign = to_estimate(plan);
    campaign.measurement.fixture_component = FixtureComponent::given;
    const RotaryTableSolution given = evaluate_jointly(campaign.measurement, with_fixture_test());
    campaign.measurement.fixture_component = FixtureComponent::check;
    const RotaryTableSolution check = evaluate_jointly(campaign.measurement, with_fixture_test());
    EXPECT_EQ(given.values, check.values);
    EXPECT_EQ(given.covariance.dense(), check.covariance.dense());
    EXPECT_EQ(check.stochastic.fixture_factor, 1.0);
    const VarianceComponent& stated = given.components[fixture_cmm];
    EXPECT_FALSE(stated.estimated);
    EXPECT_EQ(stated.value, *stated.stated);
    EXPECT_EQ(stated.u, 0.0);
    const VarianceComponent& row = check.components[fixture_cmm];
    EXPECT_EQ(row.name, "fixture CMM");
    EXPECT_TRUE(row.estimated);
    EXPECT_TRUE(row.separable);
    EXPECT_FALSE(row.used);
    EXPECT_FALSE(row.angular);
    EXPECT_EQ(*row.stated, *stated.stated);
    EXPECT_LT(std::abs(row.value - *row.stated), 3.0 * row.u);
    EXPECT_NEAR(row.u / row.value, 0.21, 0.03);
    EXPECT_NEAR(row.degrees_of_freedom, 11.5, 2.0);
    EXPECT_FALSE(has_note(check, "GC-VARIANCE-0003"));
    // The same numbers as when it is used, as far as the other weights are the same.
    campaign.measurement.fixture_component = FixtureComponent::estimate;
    const RotaryTableSolution estimate = evaluate_jointly(campaign.measurement, with_fixture_test());
    EXPECT_NEAR(estimate.components[fixture_cmm].value / row.value, 1.0, 1e-3);
    EXPECT_NEAR(estimate.components[fixture_cmm].u / row.u, 1.0, 1e-3);
}

TEST(VarianceComponents, FixtureStatedWrongIsFoundOut) {
    for (const double factor : {1.0 / 9.0, 9.0}) {
        CampaignPlan plan = table_with_repeatability();
        plan.seed = 40;
        Campaign campaign = to_estimate(plan);
        campaign.measurement.fixture_covariance *= factor;
        const RotaryTableSolution check = evaluate_jointly(campaign.measurement, with_fixture_test());
        ASSERT_TRUE(has_note(check, "GC-VARIANCE-0003")) << factor;
        for (const gum::Diagnostic& note : check.notes) {
            if (note.code == "GC-VARIANCE-0003") {
                EXPECT_EQ(note.severity, gum::Severity::warning);
                EXPECT_NE(note.action.find("\"variance_component\": \"estimate\""), std::string::npos);
                EXPECT_NE(note.what.find(factor < 1.0 ? "0.135 µm is stated" : "1.21 µm is stated"), std::string::npos)
                    << note.what;
            }
        }
        EXPECT_EQ(check.stochastic.fixture_factor, 1.0);
        campaign.measurement.fixture_component = FixtureComponent::estimate;
        const RotaryTableSolution estimate = evaluate_jointly(campaign.measurement, with_fixture_test());
        EXPECT_FALSE(has_note(estimate, "GC-VARIANCE-0003"));
        EXPECT_GT(estimate.stochastic.fixture_factor * factor, 0.3);
        EXPECT_LT(estimate.stochastic.fixture_factor * factor, 2.5);
        // Set-up errors rest on the fixture: their uncertainty follows its component.
        const double ratio = estimate.covariance(estimate.quantities.set_up, estimate.quantities.set_up) /
                             check.covariance(check.quantities.set_up, check.quantities.set_up);
        EXPECT_NEAR(ratio / estimate.stochastic.fixture_factor, 1.0, 0.35);
    }
}

TEST(VarianceComponents, FixtureThatTheDistancesCannotJudgeIsNotJudged) {
    // A CMM fifty times better than the tracer: what the distances say of the coordinates is nothing new.
    for (const FixtureComponent mode : {FixtureComponent::check, FixtureComponent::estimate}) {
        CampaignPlan plan;
        plan.cmm_factor = 0.02;
        plan.angles_deg = synthetic::full_turn(12);
        Campaign campaign = to_estimate(plan);
        campaign.measurement.fixture_component = mode;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, with_fixture_test());
        const VarianceComponent& row = solution.components[fixture_cmm];
        EXPECT_FALSE(row.separable);
        EXPECT_FALSE(row.estimated);
        EXPECT_EQ(row.value, *row.stated);
        EXPECT_EQ(row.u, 0.0);
        EXPECT_LT(row.redundancy, 2.0);
        EXPECT_EQ(solution.stochastic.fixture_factor, 1.0);
        EXPECT_TRUE(has_note(solution, "GC-VARIANCE-0004"));
    }
}

TEST(VarianceComponents, ResolutionStaysOutsideTheLengthNoise) {
    double with = 0.0;
    double without = 0.0;
    double squares = 0.0;
    constexpr int k_campaigns = 4;
    for (std::uint64_t seed = 0; seed < k_campaigns; ++seed) {
        CampaignPlan plan;
        plan.seed = 700 + seed;
        Campaign campaign = simulate(plan);
        campaign.measurement.estimate_length_noise = true;
        constexpr double k_step = 0.5e-6;
        for (LengthObservation& length : campaign.measurement.lengths) {
            length.length = k_step * std::round(length.length / k_step);
        }
        const RotaryTableSolution blind = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        campaign.measurement.length_uncertainty.resolution = k_step;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        const double truth = rms_length_noise(plan, campaign);
        with += solution.components[length_noise].value / truth / k_campaigns;
        without += blind.components[length_noise].value / truth / k_campaigns;
        EXPECT_NEAR(*solution.components[length_noise].stated / truth, 1.0, 1e-5);
        // The shares of resolution and noise cannot change what both do together.
        EXPECT_NEAR(solution.covariance(0, 0) / blind.covariance(0, 0), 1.0, 0.03);
        const Eigen::VectorXd normalised =
            (solution.values - campaign.true_values(false)).array() / solution.covariance.diagonal().array().sqrt();
        squares += normalised.squaredNorm() / static_cast<double>(normalised.size()) / k_campaigns;
    }
    // Variance of one length at a metre: 0.158² + 0.194² + 0.5²/12, noise and proportional part estimated together.
    EXPECT_NEAR(with, 1.0, 0.04);
    EXPECT_GT(without, 1.1);
    EXPECT_NEAR(std::sqrt(squares), 1.0, 0.12);
}

TEST(VarianceComponents, NoiseBelowTheResolutionEndsAtZero) {
    CampaignPlan plan;
    plan.u_constant = 0.01e-6;
    plan.u_proportional = 0.0;
    plan.seed = 77;
    Campaign campaign = simulate(plan);
    campaign.measurement.estimate_length_noise = true;
    // A coarse display whose rounding is taken for larger than it is: nothing is left for the noise.
    campaign.measurement.length_uncertainty.resolution = 0.1e-6;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_FALSE(has_note(solution, "GC-VARIANCE-0001"));
    EXPECT_EQ(solution.components[length_noise].value, 0.0);
    EXPECT_GT(solution.components[length_noise].u, 0.0);
    EXPECT_TRUE(solution.covariance.diagonal().allFinite());
}

TEST(VarianceComponents, StartFromWhatIsStatedOfTheTable) {
    const StochasticModel given = start_variances({RepeatabilityMode::given, 2e-6, 3e-6, 0.0});
    EXPECT_DOUBLE_EQ(given.variance_linear, 4e-12);
    EXPECT_DOUBLE_EQ(given.variance_axial, 9e-12);
    EXPECT_EQ(given.variance_tilt, 0.0) << "stated as none";
    EXPECT_EQ(given.length_factor, 1.0);
    EXPECT_EQ(given.fixture_factor, 1.0);
    const StochasticModel none = start_variances({RepeatabilityMode::none, 2e-6, 3e-6, 4e-6});
    EXPECT_EQ(none.variance_linear + none.variance_axial + none.variance_tilt, 0.0);
    // Where it is to be estimated, a stated value is where that begins, and a guess where there is none.
    const StochasticModel estimate = start_variances({RepeatabilityMode::estimate, 2e-6, 0.0, 0.0});
    EXPECT_DOUBLE_EQ(estimate.variance_linear, 4e-12);
    EXPECT_GT(estimate.variance_axial, 0.0);
    EXPECT_EQ(estimate.variance_tilt, estimate.variance_axial);
}

}  // namespace
}  // namespace gumcert::engine
