// Ranges, the axis average line and ISO 230-2 parameters of a table, and their sensitivities.
#include "engine/rotary_table/table_parameters.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/evaluation/sequential_evaluation.h"
#include "gum/quantity/dense_factors.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::Noise;
using synthetic::Vector6;

/// Two runs in each sense, curves with clear extremes, everything that can be an input is one.
CampaignPlan plan_of(RotaryAxis axis, Datum datum) {
    CampaignPlan plan;
    plan.axis = axis;
    plan.datum = datum;
    plan.angles_deg = synthetic::full_turn(6);
    plan.runs = 2;
    plan.both_senses = true;
    plan.reversal << 1e-6, -2e-6, 1.5e-6, 8e-6, -6e-6, 7e-6;
    plan.scale_model = ScaleModel::prior;
    plan.u_scale = 1e-7;
    plan.temperature_difference = 1.2;
    plan.u_temperature = 0.05;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 1e-6;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    return plan;
}

std::shared_ptr<const RotaryTableModel> joint_model(const RotaryTableSolution& solution) {
    return std::dynamic_pointer_cast<const RotaryTableModel>(solution.model);
}

/// The axis from the 4×4 matrix of T_s, inverted as any matrix; the line through two points of the axis.
Eigen::Vector4d by_geometry(RotaryAxis axis, const Vector6& set_up) {
    const int k = axial_coordinate(axis);
    Eigen::Matrix4d table_from_fixture = Eigen::Matrix4d::Identity();
    table_from_fixture.topLeftCorner<3, 3>() =
        synthetic::turn(2, set_up[5]) * synthetic::turn(1, set_up[4]) * synthetic::turn(0, set_up[3]);
    table_from_fixture.topRightCorner<3, 1>() = set_up.head<3>();
    const Eigen::Matrix4d inverse = table_from_fixture.fullPivLu().inverse();
    const Eigen::Vector3d first = (inverse * (Eigen::Vector3d::Unit(k) * -2.0).homogeneous()).head<3>();
    const Eigen::Vector3d last = (inverse * (Eigen::Vector3d::Unit(k) * 2.0).homogeneous()).head<3>();
    const Eigen::Vector3d pierced = first + (last - first) * (first[k] / (first[k] - last[k]));
    const Eigen::Vector3d slope = (last - first) / (last[k] - first[k]);
    // Rotation about x by a small angle takes y towards +z and z towards -y; about y z to +x, x to -z; about z x to +y.
    switch (axis) {
        case RotaryAxis::a:
            return {pierced[1], pierced[2], -std::atan(slope[2]), std::atan(slope[1])};
        case RotaryAxis::b:
            return {pierced[0], pierced[2], std::atan(slope[2]), -std::atan(slope[0])};
        default:
            return {pierced[0], pierced[1], -std::atan(slope[1]), std::atan(slope[0])};
    }
}

TEST(AxisLine, IsTheAxisInTheFrameOfTheFixture) {
    const std::array<std::array<std::string, 4>, 3> names{{{"axis_y", "axis_z", "axis_b", "axis_c"},
                                                           {"axis_x", "axis_z", "axis_a", "axis_c"},
                                                           {"axis_x", "axis_y", "axis_a", "axis_b"}}};
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        EXPECT_EQ(axis_line_names(axis), names[static_cast<std::size_t>(axis)]);
        const auto across = across_axis(axis);
        const Eigen::Vector4d across_values{1e-3, -0.7e-3, 3e-3, 2e-3};  // [m], [rad]
        Vector6 set_up = Vector6::Zero();
        for (int c = 0; c < 2; ++c) {
            set_up[across[static_cast<std::size_t>(c)]] = across_values[c];
            set_up[3 + across[static_cast<std::size_t>(c)]] = across_values[2 + c];
        }
        const Eigen::Vector4d found = axis_line(axis, across_values);
        EXPECT_LT((found - by_geometry(axis, set_up)).cwiseAbs().maxCoeff(), 1e-15);
        // To first order the set-up with the other sign: offsets to the product of offset and tilt, tilts likewise.
        for (int c = 0; c < 2; ++c) {
            const int lower = std::min(across[0], across[1]);
            const int at = across[static_cast<std::size_t>(c)] == lower ? 0 : 1;
            EXPECT_NEAR(found[at], -across_values[c], 1e-8);
            EXPECT_NEAR(found[2 + at], -across_values[2 + c], 1e-5);
        }
    }
}

class ParametersOfATable : public testing::TestWithParam<std::tuple<RotaryAxis, Datum, ReversalModel>> {};

TEST_P(ParametersOfATable, AxisLineIsThatOfTheAverageInAnyDatum) {
    const auto [axis, datum, reversal] = GetParam();
    CampaignPlan plan = plan_of(axis, Datum::axis_average_line);  // the truth obeys it
    plan.reversal_model = reversal;
    plan.noise = 0.0;
    plan.cmm_factor = 1.0;
    Campaign campaign = simulate(plan);
    campaign.measurement.datum = datum;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const TableParameterModel model(joint_model(solution), solution.datum);
    const Eigen::VectorXd values = model.evaluate(gum::input_estimates(model));
    const Eigen::Vector4d expected = by_geometry(axis, campaign.truth.set_up);
    const Eigen::Vector4d found = values.segment<4>(model.parameters()->layout().axis_line);
    // The truth obeys its datum to first order: products of error motions of micrometres and seconds of arc are left.
    EXPECT_LT((found - expected).head<2>().cwiseAbs().maxCoeff(), 5e-9);
    EXPECT_LT((found - expected).tail<2>().cwiseAbs().maxCoeff(), 5e-9);
    // With the datum of the paper the set-up itself is another one.
    if (datum == Datum::home) {
        EXPECT_GT((solution.datum.set_up - campaign.truth.set_up).cwiseAbs().maxCoeff(), 1e-7);
    }
    for (Eigen::Index k = 0; k < 6; ++k) {
        const auto curve = solution.datum.errors.row(k);
        EXPECT_NEAR(values[k], curve.maxCoeff() - curve.minCoeff(), 1e-12);
    }
    const auto names = error_motion_names(axis);
    EXPECT_EQ(model.outputs()[0].name, "range of " + names[0]);
    EXPECT_EQ(model.outputs()[9].name, axis_line_names(axis)[3]);
    EXPECT_EQ(model.outputs()[10].name, "M");
    EXPECT_EQ(model.outputs().size(), 22U);
    EXPECT_EQ(model.parameters()->descriptions().size(), 22U);
    EXPECT_EQ(model.parameters()->short_names()[0], names[0]);
}

TEST_P(ParametersOfATable, SensitivitiesAreCentralDifferences) {
    const auto [axis, datum, reversal] = GetParam();
    CampaignPlan plan = plan_of(axis, datum);
    plan.reversal_model = reversal;
    plan.noise = 0.01;  // the coefficients leave out residual times curvature: 0.006 with five times as much
    Campaign campaign = simulate(plan);
    campaign.measurement.length_uncertainty.resolution = 1e-7;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const TableParameterModel model(joint_model(solution), solution.datum);
    const Eigen::VectorXd x = gum::input_estimates(model);
    const Eigen::MatrixXd jacobian = model.jacobian(x);
    ASSERT_EQ(jacobian.cols(), x.size());
    ASSERT_EQ(jacobian.rows(), static_cast<Eigen::Index>(model.outputs().size()));
    // Rows in parts of their own uncertainty.
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(jacobian.rows());
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        const Eigen::MatrixXd part = jacobian.middleCols(first, group.size());
        variance += group.is_diagonal() ? Eigen::VectorXd(part.cwiseAbs2() * group.covariance.col(0))
                                        : Eigen::VectorXd((part * group.covariance * part.transpose()).diagonal());
        first += group.size();
    }
    const Eigen::VectorXd weight = variance.cwiseSqrt().cwiseInverse();
    Noise noise(17);
    first = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        std::set<Eigen::Index> chosen;
        while (chosen.size() < std::min<std::size_t>(6, static_cast<std::size_t>(group.size()))) {
            chosen.insert(static_cast<Eigen::Index>(noise.uniform() * static_cast<double>(group.size())));
        }
        for (const Eigen::Index k : chosen) {
            // Far below the spread of the positions, so that no extreme moves to another angle and s stays straight.
            const double fraction = group.source == "table repeatability" ? 5e-4 : 5e-3;
            const double own = group.covariance.cols() == 1 ? group.covariance(k, 0) : group.covariance(k, k);
            const double step = group.source == "dead path" ? 1e-9 : fraction * std::sqrt(own);
            const auto central = [&](double h) -> Eigen::VectorXd {
                Eigen::VectorXd changed = x;
                changed[first + k] = x[first + k] + h;
                const Eigen::VectorXd above = model.evaluate(changed);
                changed[first + k] = x[first + k] - h;
                return (above - model.evaluate(changed)) / (2.0 * h);
            };
            const Eigen::VectorXd numeric = (4.0 * central(0.5 * step) - central(step)) / 3.0;
            const Eigen::VectorXd column = jacobian.col(first + k);
            const double scale = column.cwiseProduct(weight).cwiseAbs().maxCoeff();
            Eigen::Index worst = 0;
            const double deviation = (numeric - column).cwiseProduct(weight).cwiseAbs().maxCoeff(&worst) / scale;
            EXPECT_GT(scale, 0.0) << group.name;
            EXPECT_LT(deviation, 2e-3) << group.name << ", input " << k << ", "
                                       << model.outputs()[static_cast<std::size_t>(worst)].name;
        }
        first += group.size();
    }
}

INSTANTIATE_TEST_SUITE_P(AxesAndData, ParametersOfATable,
                         testing::Combine(testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                                          testing::Values(Datum::axis_average_line, Datum::home),
                                          testing::Values(ReversalModel::constant, ReversalModel::by_angle)),
                         [](const auto& tested) {
                             return std::string(1, "ABC"[axial_coordinate(std::get<0>(tested.param))]) +
                                    (std::get<1>(tested.param) == Datum::home ? "Home" : "AxisAverageLine") +
                                    (std::get<2>(tested.param) == ReversalModel::by_angle ? "ByAngle" : "");
                         });

/// Variance of each row of ∂y/∂inputs.
Eigen::VectorXd variance_of(const gum::MeasurementModel& model, const Eigen::MatrixXd& sensitivity) {
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(sensitivity.rows());
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        const Eigen::MatrixXd part = sensitivity.middleCols(first, group.size());
        variance += group.is_diagonal() ? Eigen::VectorXd(part.cwiseAbs2() * group.covariance.col(0))
                                        : Eigen::VectorXd((part * group.covariance * part.transpose()).diagonal());
        first += group.size();
    }
    return variance;
}

class OnePosition : public testing::TestWithParam<ReversalModel> {};

TEST_P(OnePosition, HasTheUncertaintyOfThePropagation) {
    // The short formula of one visit against all rows ∂x_v/∂inputs, +1 on the own deviation of the visit.
    CampaignPlan plan = plan_of(RotaryAxis::b, Datum::home);
    plan.reversal_model = GetParam();
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    Campaign campaign = simulate(plan);
    campaign.measurement.length_uncertainty.resolution = 2e-7;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const auto joint = joint_model(solution);
    const TableParameterModel model(joint, solution.datum);
    const NormalEquations normal = joint->solved().adjustment().linearise();
    const AnglewiseMap structured = reported_map(joint->solved(), normal, solution.datum);
    const Eigen::MatrixXd map =
        structured.combined(Eigen::MatrixXd::Identity(structured.rows(), structured.rows()), joint->solved(), normal);
    const std::vector<Visit>& visits = joint->solved().visits();
    const auto count = static_cast<Eigen::Index>(visits.size());
    Eigen::MatrixXd by_parameter(count, map.cols());
    Eigen::MatrixXd by_residual = Eigen::MatrixXd::Zero(count, joint->layout().scale);
    Eigen::Index first = 0;
    for (Eigen::Index v = 0; v < count; ++v) {
        const Visit& visit = visits[static_cast<std::size_t>(v)];
        const double share = visit.approach == Approach::positive ? 0.5 : -0.5;
        by_parameter.row(v) = map.row(6 * static_cast<Eigen::Index>(visit.angle) + 4);
        if (GetParam() == ReversalModel::by_angle) {
            by_parameter(v, normal.column(joint->solved().pose_block(visit.angle), 6 + 4)) += share;
        } else {
            by_parameter.row(v) += share * map.row(map.rows() - 2);
        }
        const Eigen::VectorXd& gain = model.gains().gains[static_cast<std::size_t>(v)];
        EXPECT_NEAR(gain.dot(joint->visit_pose(static_cast<std::size_t>(v)).col(4)), 1.0, 1e-6);
        by_residual.row(v).segment(first, gain.size()) = gain.transpose();
        first += gain.size();
    }
    Eigen::MatrixXd sensitivity = joint->input_sensitivity(joint->solved(), normal, by_parameter, by_residual);
    sensitivity.middleCols(joint->layout().axial, count) += Eigen::MatrixXd::Identity(count, count);
    const Eigen::VectorXd variance = variance_of(*joint, sensitivity);
    EXPECT_NEAR(model.rms_position_uncertainty(), std::sqrt(variance.mean()), 1e-6 * std::sqrt(variance.mean()));
}

INSTANTIATE_TEST_SUITE_P(Reversals, OnePosition, testing::Values(ReversalModel::constant, ReversalModel::by_angle),
                         [](const auto& tested) {
                             return tested.param == ReversalModel::by_angle ? "ByAngle" : "Constant";
                         });

TEST(TableParameterModel, UncertaintiesAreThoseOfSimulatedMeasurements) {
    // Lengths that hold the deviations of the table, estimated without knowledge of them; what is wrong with each
    // parameter is its difference from that of the positions that the table really took.
    CampaignPlan plan = plan_of(RotaryAxis::a, Datum::axis_average_line);
    plan.error_factor = 4.0;
    plan.runs = 1;
    plan.seed = 3;
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const auto joint = joint_model(solution);
    const TableParameterModel model(joint, solution.datum);
    const RotaryTableInputs& layout = joint->layout();
    const std::vector<Visit>& visits = joint->solved().visits();
    const int axial = 3 + axial_coordinate(RotaryAxis::a);

    // The law of propagation holds where extremes are clear: one target with a large spread, one with a large reversal.
    Eigen::VectorXd x = gum::input_estimates(model);
    Eigen::Index first = 0;
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const Eigen::MatrixXd& pose = joint->visit_pose(v);
        const double extra = visits[v].angle == 2   ? (visits[v].station % 2 == 0 ? 25e-6 : -25e-6)
                             : visits[v].angle == 4 ? (visits[v].approach == Approach::positive ? 8e-6 : -8e-6)
                                                    : 0.0;
        x.segment(first, pose.rows()) += extra * pose.col(axial);
        first += pose.rows();
    }
    const Eigen::VectorXd u = variance_of(model, model.jacobian(x)).cwiseSqrt();
    const auto count = static_cast<Eigen::Index>(model.outputs().size());
    const JointAdjustment nominal = joint->solve_at(x);
    const DatumSolution datum =
        transform_to_datum(joint->measurement(), nominal.poses(), nominal.set_up(), Datum::axis_average_line);
    const Eigen::VectorXd reported = reported_values(nominal, datum);
    const Eigen::VectorXd positions = visit_positions(nominal, reported, model.gains());
    std::vector<Eigen::MatrixXd> factors;
    for (const gum::InputGroup& group : model.inputs()) {
        factors.emplace_back(group.is_diagonal()
                                 ? Eigen::MatrixXd(group.covariance.cwiseSqrt())
                                 : Eigen::MatrixXd(Eigen::LLT<Eigen::MatrixXd>(group.covariance).matrixL()));
    }
    Noise noise(77);
    constexpr int k_trials = 300;
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(count);
    for (int trial = 0; trial < k_trials; ++trial) {
        Eigen::VectorXd drawn = x;
        first = 0;
        for (std::size_t g = 0; g < model.inputs().size(); ++g) {
            const Eigen::Index n = model.inputs()[g].size();
            Eigen::VectorXd normal(n);
            for (double& value : normal) {
                value = noise.normal();
            }
            drawn.segment(first, n) += model.inputs()[g].is_diagonal()
                                           ? Eigen::VectorXd(factors[g].col(0).cwiseProduct(normal))
                                           : Eigen::VectorXd(factors[g] * normal);
            first += n;
        }
        // The deviations go into the lengths, and the estimator is told nothing of them.
        Eigen::VectorXd truth = positions;
        const auto order = repeatability_order(RotaryAxis::a);
        first = 0;
        for (std::size_t v = 0; v < visits.size(); ++v) {
            const auto at = static_cast<Eigen::Index>(v);
            Vector6 deviation;
            deviation[order[0]] = drawn[layout.linear + 3 * at];
            deviation[order[1]] = drawn[layout.linear + 3 * at + 1];
            deviation[order[2]] = drawn[layout.linear + 3 * at + 2];
            deviation[order[3]] = drawn[layout.axial + at];
            deviation[order[4]] = drawn[layout.tilt + 2 * at];
            deviation[order[5]] = drawn[layout.tilt + 2 * at + 1];
            truth[at] += deviation[order[3]];
            const Eigen::MatrixXd& pose = joint->visit_pose(v);
            drawn.segment(first, pose.rows()) += pose * deviation;
            first += pose.rows();
        }
        drawn.segment(layout.linear, layout.resolution - layout.linear).setZero();
        Eigen::VectorXd actual(count);
        model.parameters()->values(reported, truth, actual);
        squares += (model.evaluate(drawn) - actual).cwiseAbs2();
    }
    const Eigen::VectorXd spread = (squares / k_trials).cwiseSqrt();
    // The relative standard deviation of a root of a mean square of 300 is 4.1 %.
    for (Eigen::Index k = 0; k < count; ++k) {
        EXPECT_NEAR(spread[k] / u[k], 1.0, 0.15) << model.outputs()[static_cast<std::size_t>(k)].name;
    }
}

TEST(TableParameterModel, SpreadOfThePositionsIsThePlantedRepeatability) {
    for (const double planted : {0.0, 5e-6}) {
        CampaignPlan plan;
        plan.angles_deg = synthetic::full_turn(12);
        plan.runs = 3;
        plan.both_senses = true;
        plan.reversal[3] = 8e-6;
        plan.table_axial = planted;
        const Campaign campaign = simulate(plan);
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        const auto joint = joint_model(solution);
        const TableParameterModel model(joint, solution.datum);
        double squares = 0.0;
        double degrees = 0.0;
        double reversal = 0.0;
        const PositioningAccuracy accuracy = model.positioning();
        ASSERT_EQ(accuracy.targets.size(), 12U);
        for (const PositioningTarget& target : accuracy.targets) {
            squares += 17.0 * (*target.s_up * *target.s_up + *target.s_down * *target.s_down);
            degrees += 34.0;
            reversal += *target.reversal / 12.0;
        }
        double noise = 0.0;  // variance of g'(l - f) from the lengths alone
        for (std::size_t v = 0; v < joint->solved().visits().size(); ++v) {
            const Eigen::VectorXd& gain = model.gains().gains[v];
            noise += gain.cwiseAbs2().dot(joint->solved().stated_variance(v));
        }
        noise /= static_cast<double>(joint->solved().visits().size());
        // s² has a relative standard deviation of √(2/408) = 7 %; parameters of the stations take and add little.
        EXPECT_NEAR(squares / degrees / (planted * planted + noise), 1.0, 0.25);
        EXPECT_NEAR(reversal, 8e-6, 4.0 * std::sqrt((planted * planted + noise) * 2.0 / 18.0 / 12.0));
        if (planted > 0.0) {
            EXPECT_NEAR(std::sqrt(squares / degrees - noise) / planted, 1.0, 0.15);
        } else {
            EXPECT_LT(model.rms_position_uncertainty(), 2.0 * std::sqrt(noise));
        }
    }
}

TEST(TableParameterModel, OneSenseAndOneRunHaveWhatTheyAllow) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const TableParameterModel model(joint_model(solution), solution.datum);
    ASSERT_EQ(model.outputs().size(), 13U);  // one pass a station: six runs in one sense
    EXPECT_EQ(model.outputs()[10].name, "E_up");
    EXPECT_EQ(model.outputs()[11].name, "R_up");
    EXPECT_EQ(model.outputs()[12].name, "A_up");
    EXPECT_EQ(model.parameters()->layout().positioning_count, 3);
}

TEST(TableParameterModel, VisitThatDoesNotSeeTheRotationIsNoRun) {
    // A station on the axis: one reflector a pass, and every line of sight passes through the axis.
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    plan.one_reflector_a_pass = true;
    plan.offset.setZero();
    plan.tilt.setZero();
    plan.error_factor = 0.0;
    plan.noise = 0.0;
    plan.cmm_factor = 1e-3;
    plan.stations[5] = {0.9, 0.0, 0.0};
    plan.start_values = true;
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const auto joint = joint_model(solution);
    const TableParameterModel model(joint, solution.datum);
    const std::vector<Visit>& visits = joint->solved().visits();
    std::size_t seen = 0;
    for (std::size_t v = 0; v < visits.size(); ++v) {
        if (visits[v].station == 5) {
            EXPECT_FALSE(model.gains().determined(v));
        }
        seen += model.gains().determined(v) ? 1U : 0U;
    }
    EXPECT_GT(seen, visits.size() / 2);
    for (const auto& target : model.parameters()->runs().up) {
        for (const Eigen::Index v : target) {
            EXPECT_NE(visits[static_cast<std::size_t>(v)].station, 5U);
        }
    }
    EXPECT_TRUE(model.evaluate(gum::input_estimates(model)).allFinite());
    EXPECT_TRUE(std::isfinite(model.rms_position_uncertainty()));
}

TEST(TableParameterModel, SequentialMethodHasRangesAndAxisLine) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    Campaign campaign = simulate(plan);
    campaign.measurement.method = AdjustmentMethod::sequential;
    const RotaryTableSolution solution = evaluate_sequentially(campaign.measurement, EvaluationOptions{});
    const TableParameterModel model(solution.model, campaign.measurement, solution.datum);
    ASSERT_EQ(model.outputs().size(), 10U);
    const Eigen::VectorXd x = gum::input_estimates(model);
    const Eigen::VectorXd values = model.evaluate(x);
    EXPECT_LT((values.segment<4>(6) - by_geometry(RotaryAxis::a, solution.datum.set_up)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_TRUE((variance_of(model, model.jacobian(x)).array() > 0.0).all());
    EXPECT_EQ(model.positioning().targets.size(), 0U);
}

}  // namespace
}  // namespace gumcert::engine
