// The adjustment as a measurement model: values, sensitivity coefficients, and what it hands to the law of propagation.
#include "engine/rotary_table/rotary_table_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::Noise;

/// Everything that can be an input is one: both senses, scale prior, temperatures, expansion, repeatability.
CampaignPlan full_plan(RotaryAxis axis, Datum datum) {
    CampaignPlan plan;
    plan.axis = axis;
    plan.datum = datum;
    plan.angles_deg = synthetic::full_turn(8);
    plan.both_senses = true;
    plan.reversal << 1e-6, -2e-6, 1.5e-6, 4e-6, -3e-6, 2e-6;
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
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

class ModelOfTheTable : public testing::TestWithParam<std::tuple<RotaryAxis, Datum, ReversalModel>> {
protected:
    void SetUp() override {
        const auto& [axis, datum, reversal] = GetParam();
        CampaignPlan plan = full_plan(axis, datum);
        plan.reversal_model = reversal;
        plan.reversal_second = 2.0 * plan.reversal;
        campaign_ = simulate(plan);
        solution_ = evaluate_jointly(campaign_.measurement, EvaluationOptions{});
    }

    Campaign campaign_;
    RotaryTableSolution solution_;
};

TEST_P(ModelOfTheTable, NominalInputsGiveTheSolution) {
    const Eigen::VectorXd x = gum::input_estimates(*solution_.model);
    const Eigen::VectorXd y = solution_.model->evaluate(x);
    ASSERT_EQ(y.size(), solution_.values.size());
    EXPECT_LT((y - solution_.values).cwiseAbs().maxCoeff(), 1e-12);
    ASSERT_EQ(solution_.model->outputs().size(), static_cast<std::size_t>(y.size()));
    for (std::size_t i = 0; i < solution_.model->outputs().size(); ++i) {
        EXPECT_EQ(solution_.model->outputs()[i].name, solution_.quantities.outputs[i].name);
        EXPECT_EQ(solution_.model->outputs()[i].unit, solution_.quantities.outputs[i].unit);
    }
}

/// Columns of the Jacobian against central differences, a few inputs of every group; deviations in parts of the largest
/// element of the column. Rows of different units are compared in parts of their standard uncertainty.
void expect_central_differences(const RotaryTableSolution& solution, double limit) {
    const gum::MeasurementModel& model = *solution.model;
    const Eigen::VectorXd x = gum::input_estimates(model);
    const Eigen::MatrixXd jacobian = model.jacobian(x);
    EXPECT_EQ(jacobian.cols(), x.size());
    EXPECT_EQ(jacobian.rows(), solution.values.size());
    const Eigen::VectorXd u = solution.covariance.diagonal().cwiseSqrt();
    Eigen::VectorXd weight(u.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
        weight[i] = u[i] > 1e-15 ? 1.0 / u[i] : 1.0 / 1e-7;  // zero at home in the home datum, and must stay so
    }
    Noise noise(17);
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        std::set<Eigen::Index> chosen;
        while (chosen.size() < std::min<std::size_t>(5, static_cast<std::size_t>(group.size()))) {
            chosen.insert(static_cast<Eigen::Index>(noise.uniform() * static_cast<double>(group.size())));
        }
        for (const Eigen::Index k : chosen) {
            // Dead paths are known together far better than one by one: a step of their own u is out of all proportion.
            const double step =
                group.source == "dead path"
                    ? 0.2e-6
                    : std::sqrt(group.covariance.cols() == 1 ? group.covariance(k, 0) : group.covariance(k, k));
            EXPECT_GT(step, 0.0) << group.name;
            const auto central = [&](double h) -> Eigen::VectorXd {
                Eigen::VectorXd changed = x;
                changed[first + k] = x[first + k] + h;
                const Eigen::VectorXd above = model.evaluate(changed);
                changed[first + k] = x[first + k] - h;
                return (above - model.evaluate(changed)) / (2.0 * h);
            };
            // Richardson: free of the third derivative (expansion times temperature is not linear over their u).
            const Eigen::VectorXd numeric = (4.0 * central(0.5 * step) - central(step)) / 3.0;
            const Eigen::VectorXd column = jacobian.col(first + k);
            const double scale = column.cwiseProduct(weight).cwiseAbs().maxCoeff();
            const double deviation = (numeric - column).cwiseProduct(weight).cwiseAbs().maxCoeff() / scale;
            EXPECT_GT(scale, 0.0) << group.name;
            EXPECT_LT(deviation, limit) << group.name << ", input " << k;
        }
        first += group.size();
    }
}

TEST_P(ModelOfTheTable, SensitivitiesAreCentralDifferences) {
    CampaignPlan plan = full_plan(std::get<0>(GetParam()), std::get<1>(GetParam()));
    plan.noise = 0.0;
    expect_central_differences(evaluate_jointly(simulate(plan).measurement, EvaluationOptions{}), 1e-4);
    // With noise the coefficients leave out residual times curvature, as every adjustment does; it must stay small.
    expect_central_differences(solution_, 0.02);
}

TEST_P(ModelOfTheTable, ContributionsAddToTheCovarianceOfTheAdjustment) {
    // C V_x Cᵀ over the groups, written out: the dead paths as inputs split the covariance without changing it.
    const gum::MeasurementModel& model = *solution_.model;
    const Eigen::MatrixXd jacobian = model.jacobian(gum::input_estimates(model));
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(jacobian.rows(), jacobian.rows());
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        const Eigen::MatrixXd part = jacobian.middleCols(first, group.size());
        if (group.is_diagonal()) {
            covariance += part * group.covariance.col(0).asDiagonal() * part.transpose();
        } else {
            covariance += part * group.covariance * part.transpose();
        }
        first += group.size();
    }
    const Eigen::VectorXd u = solution_.covariance.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < u.size(); ++i) {
        for (Eigen::Index k = 0; k <= i; ++k) {
            EXPECT_NEAR(covariance(i, k), solution_.covariance(i, k), 1e-7 * u[i] * u[k] + 1e-30)
                << solution_.quantities.outputs[static_cast<std::size_t>(i)].name << " and "
                << solution_.quantities.outputs[static_cast<std::size_t>(k)].name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AxesAndData, ModelOfTheTable,
                         testing::Values(std::tuple{RotaryAxis::a, Datum::axis_average_line, ReversalModel::constant},
                                         std::tuple{RotaryAxis::b, Datum::home, ReversalModel::constant},
                                         std::tuple{RotaryAxis::c, Datum::axis_average_line, ReversalModel::constant},
                                         std::tuple{RotaryAxis::a, Datum::home, ReversalModel::by_angle},
                                         std::tuple{RotaryAxis::c, Datum::axis_average_line, ReversalModel::by_angle}),
                         [](const auto& tested) {
                             return std::string(1, "ABC"[axial_coordinate(std::get<0>(tested.param))]) +
                                    (std::get<1>(tested.param) == Datum::home ? "Home" : "AxisAverageLine") +
                                    (std::get<2>(tested.param) == ReversalModel::by_angle ? "ByAngle" : "");
                         });

/// The model takes an adjustment in which the dead paths are free; that of another model has them held.
JointAdjustment solution_with_free_dead_paths(const Campaign& campaign, const JointAdjustment& from,
                                              const StochasticModel& stochastic) {
    JointAdjustment result(campaign.measurement, from.active(), from.set_up(), from.present_values(), stochastic);
    result.copy_parameters_from(from);
    result.set_weights(stochastic);
    EXPECT_TRUE(result.adjustment().refine(SolverOptions{}).converged);
    return result;
}

TEST_P(ModelOfTheTable, SensitivityCoefficientsAreCountedBeforehand) {
    const auto outputs = static_cast<double>(solution_.model->outputs().size());
    const auto inputs = static_cast<double>(gum::input_estimates(*solution_.model).size());
    EXPECT_EQ(sensitivity_coefficient_count(campaign_.measurement), outputs * inputs);
    RotaryTableMeasurement finite = campaign_.measurement;
    finite.length_uncertainty.resolution = 1e-8;
    EXPECT_EQ(sensitivity_coefficient_count(finite), outputs * (inputs + static_cast<double>(finite.lengths.size())));
}

TEST(RotaryTableModel, MoreSensitivityCoefficientsThanCanBeHeldAreRefused) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(600);
    EXPECT_NO_THROW(require_evaluable_size(simulate(plan).measurement));
    plan.angles_deg = synthetic::full_turn(1000);
    const RotaryTableMeasurement measurement = simulate(plan).measurement;
    try {
        require_evaluable_size(measurement);
        FAIL() << "accepted";
    } catch (const gum::NoResultError& error) {
        ASSERT_EQ(error.diagnostics().size(), 1U);
        const gum::Diagnostic& problem = error.diagnostics().front();
        EXPECT_EQ(problem.code, "GC-ADJUST-0008");
        // 6004 outputs by 36 000 lengths, 36 000 deviations of the table, 6 dead paths and 18 coordinates.
        EXPECT_EQ(problem.what, "1000 angles with 36000 distances have 432 million sensitivity coefficients");
        EXPECT_NE(problem.rule.find("200 million"), std::string::npos);
        EXPECT_NE(problem.action.find("about 680"), std::string::npos) << problem.action;
    }
}

TEST(RotaryTableModel, EveryGroupNamesItsSource) {
    const Campaign campaign = simulate(full_plan(RotaryAxis::a, Datum::home));
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const std::set<std::string> known{"length noise", "scale",           "dead path",
                                      "fixture CMM",  "fixture thermal", "table repeatability"};
    std::set<std::string> seen;
    for (const gum::InputGroup& group : solution.model->inputs()) {
        EXPECT_FALSE(group.name.empty());
        EXPECT_EQ(known.count(group.source), 1U) << group.source;
        EXPECT_EQ(group.covariance.rows(), group.size()) << group.name;
        EXPECT_TRUE(group.covariance.cols() == 1 || group.covariance.cols() == group.size()) << group.name;
        seen.insert(group.source);
    }
    EXPECT_EQ(seen, known);
}

TEST(RotaryTableModel, OnlyWhatIsUncertainIsAnInput) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    for (const gum::InputGroup& group : solution.model->inputs()) {
        EXPECT_NE(group.source, "scale");
        EXPECT_NE(group.source, "fixture thermal");
        if (group.source == "table repeatability") {
            EXPECT_EQ(group.covariance.cwiseAbs().maxCoeff(), 0.0);
        }
    }
    EXPECT_EQ(solution.quantities.outputs.size(), 6U * 8U + 4U);
}

TEST(RotaryTableModel, LayoutIsThatOfTheInputs) {
    Campaign campaign = simulate(full_plan(RotaryAxis::b, Datum::home));
    for (const double resolution : {0.0, 1e-7}) {
        campaign.measurement.length_uncertainty.resolution = resolution;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        const auto model = std::dynamic_pointer_cast<const RotaryTableModel>(solution.model);
        const RotaryTableInputs& layout = model->layout();
        const std::vector<std::pair<std::string, Eigen::Index>> expected{
            {"length noise", layout.lengths},
            {"scale of the stations", layout.scale},
            {"dead paths", layout.dead_paths},
            {"CMM coordinates of the fixture", layout.fixture},
            {"temperature of the fixture", layout.temperature},
            {"expansion coefficient of the fixture", layout.expansion},
            {"table repeatability, linear", layout.linear},
            {"table repeatability, axial", layout.axial},
            {"table repeatability, tilt", layout.tilt},
            {"resolution of the lengths", layout.resolution}};
        Eigen::Index first = 0;
        ASSERT_EQ(model->inputs().size(), resolution > 0.0 ? 10U : 9U);
        for (std::size_t g = 0; g < model->inputs().size(); ++g) {
            EXPECT_EQ(model->inputs()[g].name, expected[g].first);
            EXPECT_EQ(first, expected[g].second) << expected[g].first;
            first += model->inputs()[g].size();
        }
        EXPECT_EQ(first, layout.size);
    }
}

TEST(RotaryTableModel, ResolutionIsAUniformInputOfEveryLength) {
    Campaign campaign = simulate(full_plan(RotaryAxis::a, Datum::axis_average_line));
    campaign.measurement.length_uncertainty.resolution = 0.6e-6;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const gum::MeasurementModel& model = *solution.model;
    const gum::InputGroup& group = model.inputs().back();
    ASSERT_EQ(group.name, "resolution of the lengths");
    EXPECT_EQ(group.source, "length noise");
    EXPECT_EQ(group.distribution, "uniform");
    ASSERT_EQ(group.size(), static_cast<Eigen::Index>(campaign.measurement.lengths.size()));
    ASSERT_EQ(group.marginals.size(), campaign.measurement.lengths.size());
    EXPECT_NEAR(group.marginals[7].scale, 0.3e-6, 1e-18);  // half a step
    EXPECT_NEAR(std::sqrt(group.covariance(7, 0)), 0.3e-6 / std::sqrt(3.0), 1e-18);
    // What it adds is in the covariance of the adjustment as well.
    const Eigen::MatrixXd jacobian = model.jacobian(gum::input_estimates(model));
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(jacobian.rows());
    Eigen::Index first = 0;
    for (const gum::InputGroup& input : model.inputs()) {
        const Eigen::MatrixXd part = jacobian.middleCols(first, input.size());
        variance += input.is_diagonal() ? Eigen::VectorXd(part.cwiseAbs2() * input.covariance.col(0))
                                        : Eigen::VectorXd((part * input.covariance * part.transpose()).diagonal());
        first += input.size();
    }
    for (Eigen::Index i = 0; i < variance.size(); ++i) {
        EXPECT_NEAR(variance[i], solution.covariance(i, i), 1e-6 * solution.covariance(i, i));
    }
    // A length that was rounded down by r is longer by r.
    Eigen::VectorXd x = gum::input_estimates(model);
    x[11] += 1e-7;
    const Eigen::VectorXd by_length = model.evaluate(x);
    x[11] -= 1e-7;
    x[x.size() - group.size() + 11] += 1e-7;
    EXPECT_LT((model.evaluate(x) - by_length).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(RotaryTableModel, ShapesBecomeDistributions) {
    Campaign campaign = simulate(full_plan(RotaryAxis::a, Datum::axis_average_line));
    const auto check = [](const gum::InputGroup& group, bool uniform) {
        EXPECT_EQ(group.distribution, uniform ? "uniform" : "normal") << group.name;
        EXPECT_EQ(group.marginals.size(), uniform ? static_cast<std::size_t>(group.size()) : 0U) << group.name;
        for (std::size_t i = 0; i < group.marginals.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            EXPECT_EQ(group.covariance.cols(), 1) << group.name;
            EXPECT_NEAR(gum::standard_deviation(group.marginals[i]), std::sqrt(group.covariance(at, 0)),
                        1e-12 * std::sqrt(group.covariance(at, 0)));
            EXPECT_EQ(gum::expectation(group.marginals[i]), group.value[at]);
        }
    };
    for (const InputShape shape : {InputShape::normal, InputShape::uniform}) {
        campaign.measurement.fixture_shape = shape;
        campaign.measurement.temperature_shape = shape;
        campaign.measurement.expansion_shape = shape;
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        for (const gum::InputGroup& group : solution.model->inputs()) {
            check(group, shape == InputShape::uniform && group.source.starts_with("fixture"));
        }
    }
    // Correlated coordinates stay normal: a uniform shape is for uncorrelated ones.
    campaign.measurement.fixture_covariance(0, 1) = campaign.measurement.fixture_covariance(1, 0) =
        0.3 * campaign.measurement.fixture_covariance(0, 0);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    for (const gum::InputGroup& group : solution.model->inputs()) {
        check(group, group.source == "fixture thermal");
    }
}

TEST(RotaryTableModel, FixtureFactorScalesTheCovarianceOfTheCoordinates) {
    const Campaign campaign = simulate(full_plan(RotaryAxis::a, Datum::axis_average_line));
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const auto joint = std::dynamic_pointer_cast<const RotaryTableModel>(solution.model);
    JointAdjustment adjustment = joint->solved();
    StochasticModel stochastic = joint->stochastic();
    stochastic.fixture_factor = 2.25;
    const RotaryTableModel model(campaign.measurement, solution_with_free_dead_paths(campaign, adjustment, stochastic),
                                 stochastic, {1e9, 1e9, 1e9, 1e9, 12.0});
    const auto group_of = [](const RotaryTableModel& of) {
        return *std::find_if(of.inputs().begin(), of.inputs().end(),
                             [](const gum::InputGroup& group) { return group.source == "fixture CMM"; });
    };
    const gum::InputGroup before = group_of(*joint);
    const gum::InputGroup after = group_of(model);
    EXPECT_LT((after.covariance - 2.25 * before.covariance).cwiseAbs().maxCoeff(), 1e-25);
    EXPECT_EQ(after.degrees_of_freedom, 12.0);
    EXPECT_EQ(after.evaluation, gum::Evaluation::type_a);
    EXPECT_EQ(before.evaluation, gum::Evaluation::type_b);
    EXPECT_TRUE(std::isinf(before.degrees_of_freedom));
}

TEST(RotaryTableModel, SensitivityOfAnyCombinationIsThatOfTheReportedQuantities) {
    // Two ways to the same rows: all reported quantities and then the combination, or the combination at once. A
    // residual is l - f: its derivative is that of the length less that of the prediction, zero for A^T V^-1 (l - f).
    const Campaign campaign = simulate(full_plan(RotaryAxis::c, Datum::home));
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const auto model = std::dynamic_pointer_cast<const RotaryTableModel>(solution.model);
    const Eigen::MatrixXd all = model->jacobian(gum::input_estimates(*model));
    const NormalEquations normal = model->solved().adjustment().linearise();
    const AnglewiseMap structured = reported_map(model->solved(), normal, solution.datum);
    const Eigen::MatrixXd map =
        structured.combined(Eigen::MatrixXd::Identity(structured.rows(), structured.rows()), model->solved(), normal);
    Noise noise(5);
    Eigen::MatrixXd combination(3, map.rows());
    for (double& value : combination.reshaped()) {
        value = noise.normal();
    }
    const Eigen::MatrixXd direct =
        model->input_sensitivity(model->solved(), normal, combination * map, Eigen::MatrixXd(3, 0));
    EXPECT_LT((direct - combination * all).cwiseAbs().maxCoeff(), 1e-8 * direct.cwiseAbs().maxCoeff());

    const Eigen::Index lengths = model->layout().scale;
    Eigen::MatrixXd normal_rows = Eigen::MatrixXd::Zero(normal.parameter_count(), lengths);  // Jᵀ V⁻¹
    Eigen::Index first = 0;
    for (std::size_t v = 0; v < model->solved().visits().size(); ++v) {
        const LinearisedGroup& group = normal.groups()[v];
        const Eigen::MatrixXd rows =
            group.cholesky.triangularView<Eigen::Lower>().transpose().solve(group.jacobian).transpose();
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            normal_rows.row(group.columns[c]).segment(first, rows.cols()) = rows.row(static_cast<Eigen::Index>(c));
        }
        first += rows.cols();
    }
    // Normal equations of the poses, which no prior touches: Jᵀ V⁻¹ (l - f) = 0 for any lengths.
    const Eigen::MatrixXd pose_rows = normal_rows.bottomRows(6 * 7);
    const Eigen::MatrixXd zero = model->input_sensitivity(
        model->solved(), normal, Eigen::MatrixXd::Zero(pose_rows.rows(), map.cols()), pose_rows);
    EXPECT_LT(zero.leftCols(lengths).cwiseAbs().maxCoeff(), 1e-7 * pose_rows.cwiseAbs().maxCoeff());
}

TEST(RotaryTableModel, SmallMonteCarloReproducesTheStandardUncertainties) {
    CampaignPlan plan = full_plan(RotaryAxis::a, Datum::axis_average_line);
    plan.angles_deg = synthetic::full_turn(6);
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const gum::MeasurementModel& model = *solution.model;
    const Eigen::VectorXd x = gum::input_estimates(model);
    std::vector<Eigen::MatrixXd> factors;
    for (const gum::InputGroup& group : model.inputs()) {
        factors.emplace_back(group.is_diagonal()
                                 ? Eigen::MatrixXd(group.covariance.cwiseSqrt())
                                 : Eigen::MatrixXd(Eigen::LLT<Eigen::MatrixXd>(group.covariance).matrixL()));
    }
    Noise noise(2024);
    constexpr int k_trials = 200;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(solution.values.size());
    Eigen::VectorXd squares = sum;
    for (int trial = 0; trial < k_trials; ++trial) {
        Eigen::VectorXd drawn = x;
        Eigen::Index first = 0;
        for (std::size_t g = 0; g < model.inputs().size(); ++g) {
            const Eigen::Index n = model.inputs()[g].size();
            Eigen::VectorXd normal(n);
            for (double& value : normal) {
                value = noise.normal();
            }
            if (model.inputs()[g].is_diagonal()) {
                drawn.segment(first, n) += factors[g].col(0).cwiseProduct(normal);
            } else {
                drawn.segment(first, n) += factors[g] * normal;
            }
            first += n;
        }
        const Eigen::VectorXd difference = model.evaluate(drawn) - solution.values;
        sum += difference;
        squares += difference.cwiseAbs2();
    }
    // u from 200 trials has a relative standard deviation of 5 %.
    const Eigen::VectorXd mean = sum / k_trials;
    const Eigen::VectorXd spread = ((squares - k_trials * mean.cwiseAbs2()) / (k_trials - 1)).cwiseSqrt();
    const Eigen::VectorXd u = solution.covariance.diagonal().cwiseSqrt();
    const Eigen::ArrayXd ratio = spread.array() / u.array();
    EXPECT_GT(ratio.minCoeff(), 0.8);
    EXPECT_LT(ratio.maxCoeff(), 1.2);
    EXPECT_NEAR(ratio.mean(), 1.0, 0.05);
    EXPECT_LT((mean.array() / u.array()).abs().maxCoeff(), 4.0 / std::sqrt(static_cast<double>(k_trials)));
}

}  // namespace
}  // namespace gumcert::engine
