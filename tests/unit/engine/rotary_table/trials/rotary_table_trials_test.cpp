// The trials of the Monte Carlo method: each is a whole adjustment, and none knows of the others.
#include "engine/rotary_table/trials/rotary_table_trials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/start/start_values.h"
#include "gum/quantity/dense_factors.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::Noise;

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr SourceDegreesOfFreedom k_stated{k_infinity, k_infinity, k_infinity, k_infinity};

/// One campaign, solved, with the weights that the trials hold.
struct Solved {
    explicit Solved(const CampaignPlan& plan, double resolution = 0.0,
                    const SourceDegreesOfFreedom& degrees_of_freedom = k_stated)
        : campaign(simulate(plan)) {
        campaign.measurement.length_uncertainty.resolution = resolution;
        solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        stochastic = solution.stochastic;
        const auto& model = dynamic_cast<const RotaryTableModel&>(*solution.model);
        joint = std::make_unique<JointAdjustment>(campaign.measurement, model.solved().active(),
                                                  model.solved().set_up(), model.solved().present_values(), stochastic);
        joint->copy_parameters_from(model.solved());
        joint->set_weights(stochastic);
        EXPECT_TRUE(joint->adjustment().refine(SolverOptions{}).converged);
        trials = std::make_unique<RotaryTableTrials>(*joint, stochastic, degrees_of_freedom);
        u = solution.covariance.diagonal().cwiseSqrt();
        for (double& each : u) {
            each = each > 1e-15 ? each : 1e-7;  // zero at home in the home datum, and must stay so
        }
    }

    Campaign campaign;
    RotaryTableSolution solution;
    StochasticModel stochastic;
    std::unique_ptr<JointAdjustment> joint;
    std::unique_ptr<RotaryTableTrials> trials;
    Eigen::VectorXd u;  ///< of the reported quantities
};

/// One draw of all inputs; uniform ones by their marginals, factors of variances between 0.5 and 1.5.
Eigen::VectorXd draw(const gum::MeasurementModel& model, Noise& noise, double spread) {
    Eigen::VectorXd x = gum::input_estimates(model);
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        const Eigen::Index n = group.size();
        Eigen::VectorXd deviates(n);
        for (double& deviate : deviates) {
            deviate = spread * noise.normal();
        }
        if (group.name.ends_with("estimated variance")) {
            x[first] = 0.5 + noise.uniform();
        } else if (!group.marginals.empty()) {
            for (Eigen::Index i = 0; i < n; ++i) {
                x[first + i] += (2.0 * noise.uniform() - 1.0) * group.marginals[static_cast<std::size_t>(i)].scale;
            }
        } else if (group.is_diagonal() || n == 1) {
            x.segment(first, n) += group.covariance.col(0).cwiseSqrt().cwiseProduct(deviates);
        } else {
            x.segment(first, n) += Eigen::LLT<Eigen::MatrixXd>(group.covariance).matrixL() * deviates;
        }
        first += n;
    }
    return x;
}

/// Values of the inputs of a group, empty when it is not there.
Eigen::VectorXd input(const gum::MeasurementModel& model, const Eigen::VectorXd& x, const std::string& name) {
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : model.inputs()) {
        if (group.name == name) {
            return x.segment(first, group.size());
        }
        first += group.size();
    }
    return {};
}

/// The same trial by the adjustment itself, group by group.
/// \param coordinates  drawn for the reflectors, where they are no inputs
/// \param end          receives the adjustment
Eigen::VectorXd solve_again(const Solved& solved, const gum::MeasurementModel& model, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& coordinates = {}, JointAdjustment* end = nullptr) {
    const RotaryTableMeasurement& measurement = solved.campaign.measurement;
    JointAdjustment again = *solved.joint;
    const auto of = [&](const std::string& name) -> Eigen::VectorXd {
        Eigen::VectorXd values = input(model, x, name);
        const Eigen::VectorXd variance = input(model, x, name + ", estimated variance");
        if (variance.size() == 1) {
            Eigen::VectorXd estimate = input(model, gum::input_estimates(model), name);
            values = estimate + (values - estimate) / std::sqrt(variance[0]);
        }
        return values;
    };
    const Eigen::VectorXd noise = of("length noise");
    const Eigen::VectorXd resolution = of("resolution of the lengths");
    const Eigen::VectorXd linear = of("table repeatability, linear");
    const Eigen::VectorXd axial = of("table repeatability, axial");
    const Eigen::VectorXd tilt = of("table repeatability, tilt");
    const auto order = repeatability_order(measurement.axis);
    Eigen::Index next = 0;
    for (std::size_t v = 0; v < again.visits().size(); ++v) {
        const std::vector<std::size_t>& observations = again.visits()[v].observations;
        Eigen::Matrix<double, 6, 1> deviation = Eigen::Matrix<double, 6, 1>::Zero();
        const auto at = static_cast<Eigen::Index>(v);
        for (int c = 0; c < 3 && linear.size() > 0; ++c) {
            deviation[order[static_cast<std::size_t>(c)]] = linear[3 * at + c];
        }
        if (axial.size() > 0) {
            deviation[order[3]] = axial[at];
        }
        for (int c = 0; c < 2 && tilt.size() > 0; ++c) {
            deviation[order[static_cast<std::size_t>(4 + c)]] = tilt[2 * at + c];
        }
        Eigen::VectorXd observed = -(solved.joint->repeatability_jacobian(v) * deviation);
        for (Eigen::Index k = 0; k < observed.size(); ++k, ++next) {
            observed[k] += measurement.lengths[observations[static_cast<std::size_t>(k)]].length + noise[next];
            observed[k] += resolution.size() > 0 ? resolution[next] : 0.0;
        }
        again.adjustment().set_observed(v, observed);
    }
    const Eigen::VectorXd scale = of("scale of the stations");
    const Eigen::VectorXd temperature = of("temperature of the fixture");
    Eigen::Index scales = 0;
    Eigen::Index temperatures = 0;
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        if (again.scale_prior(j) != JointAdjustment::k_none) {
            again.adjustment().set_observed(again.scale_prior(j), scale.segment(scales++, 1));
        }
        if (again.temperature_prior(j) != JointAdjustment::k_none) {
            again.adjustment().set_observed(again.temperature_prior(j), temperature.segment(temperatures++, 1));
        }
    }
    if (again.expansion_prior() != JointAdjustment::k_none) {
        again.adjustment().set_observed(again.expansion_prior(), of("expansion coefficient of the fixture"));
    }
    again.adjustment().set_observed(again.fixture_prior(),
                                    coordinates.size() > 0 ? coordinates : of("CMM coordinates of the fixture"));
    SolverOptions options;
    options.step_tolerance = 1e-7;
    EXPECT_TRUE(again.adjustment().refine(options).converged);
    if (end != nullptr) {
        *end = again;
    }
    return reported_values(again, transform_to_datum(measurement, again.poses(), again.set_up(), measurement.datum));
}

/// Largest difference of trials of the class from the adjustment itself, in parts of u.
double largest_difference(const Solved& solved, double spread, int count, std::uint64_t seed) {
    Noise noise(seed);
    const Eigen::VectorXd estimates = gum::input_estimates(*solved.trials);
    Eigen::MatrixXd x(count, estimates.size());
    for (int i = 0; i < count; ++i) {
        x.row(i) = draw(*solved.trials, noise, spread).transpose();
    }
    Eigen::MatrixXd y(count, static_cast<Eigen::Index>(solved.trials->outputs().size()));
    solved.trials->evaluate_trials(x, y);
    double largest = 0.0;
    for (int i = 0; i < count; ++i) {
        const Eigen::VectorXd expected = solve_again(solved, *solved.trials, x.row(i).transpose());
        largest = std::max(
            largest,
            ((y.row(i).head(expected.size()).transpose() - expected).array() / solved.u.array()).abs().maxCoeff());
    }
    return largest;
}

CampaignPlan repeating(CampaignPlan plan) {
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    return plan;
}

CampaignPlan full_plan() {
    CampaignPlan plan = repeating({});
    plan.axis = RotaryAxis::b;
    plan.datum = Datum::home;
    plan.home = 3;
    plan.angles_deg = synthetic::full_turn(12);
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
    plan.missing_share = 0.1;
    return plan;
}

struct Case {
    const char* name;
    CampaignPlan plan;

    friend void PrintTo(const Case& tested, std::ostream* to) { *to << tested.name; }
};

std::vector<Case> cases() {
    std::vector<Case> all;
    all.push_back({"AxisA", {}});
    all.push_back({"AxisARepeating", repeating({})});
    CampaignPlan single = repeating({});
    single.axis = RotaryAxis::c;
    single.one_reflector_a_pass = true;
    single.angles_deg = synthetic::full_turn(12);
    all.push_back({"AxisCOneReflectorAVisit", single});
    all.push_back({"AxisBEverything", full_plan()});
    CampaignPlan by_angle = full_plan();
    by_angle.reversal_model = ReversalModel::by_angle;
    by_angle.reversal_second = 2.0 * by_angle.reversal;
    all.push_back({"AxisBReversalByAngle", by_angle});
    CampaignPlan expansion = full_plan();
    expansion.u_temperature = 0.0;
    all.push_back({"ExpansionUncertain", expansion});
    CampaignPlan temperature = full_plan();
    temperature.u_expansion = 0.0;
    all.push_back({"TemperaturesUncertain", temperature});
    CampaignPlan pairs;
    pairs.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    pairs.start_values = true;
    pairs.angles_deg = synthetic::full_turn(12);
    all.push_back({"DeadPathPerPair", pairs});
    CampaignPlan free_scale;
    free_scale.scale_model = ScaleModel::free;
    free_scale.angles_deg = synthetic::full_turn(12);
    all.push_back({"ScaleFree", free_scale});
    CampaignPlan partial;
    partial.datum = Datum::home;
    partial.angles_deg = synthetic::partial_turn(90.0, 10);
    all.push_back({"PartialTurn", partial});
    return all;
}

class TrialsAgainstTheAdjustment : public testing::TestWithParam<Case> {};

TEST_P(TrialsAgainstTheAdjustment, AgreeWithARefinedSolution) {
    const Solved solved(GetParam().plan);
    const double at_u = largest_difference(solved, 1.0, 3, 7);
    const double at_five_u = largest_difference(solved, 5.0, 3, 8);
    RecordProperty("at_u", std::to_string(at_u));
    RecordProperty("at_five_u", std::to_string(at_five_u));
    EXPECT_LT(at_u, 1e-5) << "inputs off by about u";
    EXPECT_LT(at_five_u, 1e-5) << "inputs off by about 5 u";
    EXPECT_EQ(solved.trials->steps().trials, 6U);
    EXPECT_EQ(solved.trials->steps().not_converged, 0U);
}

INSTANTIATE_TEST_SUITE_P(Campaigns, TrialsAgainstTheAdjustment, testing::ValuesIn(cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(RotaryTableTrials, ResolutionAndEstimatedVariancesAct) {
    const SourceDegreesOfFreedom estimated{20.0, 8.0, 9.0, 10.0, 11.0};
    const Solved solved(full_plan(), 0.1e-6, estimated);
    std::vector<std::string> names;
    for (const gum::InputGroup& group : solved.trials->inputs()) {
        names.push_back(group.name);
    }
    const std::vector<std::string> expected{"length noise",
                                            "resolution of the lengths",
                                            "table repeatability, linear",
                                            "table repeatability, axial",
                                            "table repeatability, tilt",
                                            "scale of the stations",
                                            "CMM coordinates of the fixture",
                                            "temperature of the fixture",
                                            "expansion coefficient of the fixture",
                                            "length noise, estimated variance",
                                            "table repeatability, linear, estimated variance",
                                            "table repeatability, axial, estimated variance",
                                            "table repeatability, tilt, estimated variance",
                                            "CMM coordinates of the fixture, estimated variance"};
    EXPECT_EQ(names, expected);
    const gum::InputGroup& variance = solved.trials->inputs()[9];
    EXPECT_DOUBLE_EQ(gum::expectation(variance.marginals[0]), 1.0);
    EXPECT_DOUBLE_EQ(gum::standard_deviation(variance.marginals[0]), std::sqrt(2.0 / 20.0));
    EXPECT_LT(largest_difference(solved, 1.0, 4, 3), 1e-5);
}

TEST(RotaryTableTrials, FarSetUpIsCarriedToTheDatumAsAnywhere) {
    // T_s is the identity here, so that the whole set-up of 193 µm and 109″ is left to the change of datum.
    for (const Datum datum : {Datum::axis_average_line, Datum::home}) {
        Solved solved(repeating({}));
        RotaryTableMeasurement& measurement = solved.campaign.measurement;
        measurement.datum = datum;
        solved.joint =
            std::make_unique<JointAdjustment>(measurement, std::vector<bool>(measurement.lengths.size(), true),
                                              RigidMotion{}, find_start_values(measurement), solved.stochastic);
        ASSERT_TRUE(solved.joint->adjustment().solve(SolverOptions{}).converged);
        for (int i = 0; i < 3; ++i) {  // to the last digit: the values are compared to 1e-15 m below
            ASSERT_TRUE(solved.joint->adjustment().refine(SolverOptions{}).converged);
        }
        solved.trials = std::make_unique<RotaryTableTrials>(*solved.joint, solved.stochastic, k_stated);
        const DatumSolution expected =
            transform_to_datum(measurement, solved.joint->poses(), solved.joint->set_up(), datum);
        EXPECT_GT(expected.set_up.head<3>().norm(), 190e-6);
        const Eigen::VectorXd y = solved.trials->evaluate(gum::input_estimates(*solved.trials));
        EXPECT_LT((y - reported_values(*solved.joint, expected)).cwiseAbs().maxCoeff(), 1e-14);
        EXPECT_LT(largest_difference(solved, 5.0, 2, 5), 1e-5);
    }
}

TEST(RotaryTableTrials, ExpansionTimesTemperatureCostsNoSteps) {
    // At 4 µm/(m K), a third of the expansion, the product of the two is far from linear, and
    // what the last step leaves is larger (1.1e-5 u seen at 8 K).
    for (const double u_expansion : {1e-6, 4e-6}) {
        for (const double difference : {0.0, 1.2, 8.0}) {
            CampaignPlan plan = full_plan();
            plan.u_expansion = u_expansion;
            plan.temperature_difference = difference;
            const Solved solved(plan);
            const double bound = u_expansion > 1e-6 ? 1e-4 : 1e-5;
            EXPECT_LT(largest_difference(solved, 2.0, 16, 8), bound) << u_expansion << ", " << difference;
            EXPECT_LE(solved.trials->steps().mean(), 3.0) << u_expansion << ", " << difference;
            EXPECT_EQ(solved.trials->steps().alone, 0U) << u_expansion << ", " << difference;
        }
    }
}

TEST(RotaryTableTrials, ThatNeedsMoreStepsIsSolvedAlone) {
    Solved solved(full_plan());
    solved.trials = std::make_unique<RotaryTableTrials>(*solved.joint, solved.stochastic, k_stated,
                                                        TrialExtras{.options = {.most_steps = 1}});
    EXPECT_LT(largest_difference(solved, 3.0, 6, 8), 1e-5);
    EXPECT_EQ(solved.trials->steps().alone, 6U);
    EXPECT_EQ(solved.trials->steps().not_converged, 0U);
}

TEST(RotaryTableTrials, HeldParametersStay) {
    Solved solved(repeating({}));
    const auto held_motion = solved.joint->pose_block(7);
    solved.joint->adjustment().hold(held_motion, 2);
    solved.joint->adjustment().hold(solved.joint->station_block(1), 0);
    solved.joint->adjustment().hold(solved.joint->fixture_block(), 4);
    ASSERT_TRUE(solved.joint->adjustment().refine(SolverOptions{}).converged);
    solved.trials = std::make_unique<RotaryTableTrials>(*solved.joint, solved.stochastic, k_stated);
    EXPECT_LT(largest_difference(solved, 2.0, 3, 11), 1e-5);
}

TEST(RotaryTableTrials, NoTrialDependsOnItsNeighbours) {
    CampaignPlan plan = full_plan();
    plan.u_expansion = 3e-6;
    const Solved solved(plan);
    const RotaryTableTrials& trials = *solved.trials;
    constexpr Eigen::Index k_trials = 37;
    Noise noise(12);
    Eigen::MatrixXd x(k_trials, gum::input_estimates(trials).size());
    for (Eigen::Index i = 0; i < k_trials; ++i) {
        x.row(i) = draw(trials, noise, i % 5 == 0 ? 3.0 : 1.0).transpose();
    }
    Eigen::MatrixXd together(k_trials, static_cast<Eigen::Index>(trials.outputs().size()));
    trials.evaluate_trials(x, together);
    EXPECT_EQ(trials.steps().trials, static_cast<std::uint64_t>(k_trials));
    EXPECT_GE(trials.steps().most, 3);
    for (Eigen::Index i = 0; i < k_trials; ++i) {
        const Eigen::VectorXd single = trials.evaluate(x.row(i).transpose());
        EXPECT_EQ((single - together.row(i).transpose()).cwiseAbs().maxCoeff(), 0.0) << "trial " << i;
    }
    // Parts of other sizes, in a wider matrix.
    Eigen::MatrixXd wide = Eigen::MatrixXd::Constant(k_trials + 9, x.cols(), 7.0);
    wide.middleRows(4, k_trials) = x;
    for (const Eigen::Index part : {5, 16, 21}) {
        Eigen::MatrixXd y = Eigen::MatrixXd::Zero(k_trials + 3, together.cols());
        for (Eigen::Index first = 0; first < k_trials; first += part) {
            const Eigen::Index rows = std::min(part, k_trials - first);
            // A block of rows has an outer stride that is not its number of rows.
            trials.evaluate_trials(wide.middleRows(4 + first, rows), y.middleRows(1 + first, rows));
        }
        EXPECT_EQ((y.middleRows(1, k_trials) - together).cwiseAbs().maxCoeff(), 0.0) << "parts of " << part;
    }
}

TEST(RotaryTableTrials, WhatHasNoValueIsNotANumber) {
    const Solved solved(repeating({}));
    Eigen::VectorXd x = gum::input_estimates(*solved.trials);
    x[3] = std::numeric_limits<double>::quiet_NaN();
    Eigen::MatrixXd rows = gum::input_estimates(*solved.trials).transpose().replicate(40, 1);
    rows.row(1) = x.transpose();  // whatever is computed beside it or after it is not touched
    Eigen::MatrixXd y(rows.rows(), static_cast<Eigen::Index>(solved.trials->outputs().size()));
    solved.trials->evaluate_trials(rows, y);
    EXPECT_TRUE(y.row(1).array().isNaN().all());
    y.row(1) = y.row(0);
    EXPECT_TRUE(y.allFinite());
    EXPECT_EQ((y.rowwise() - y.row(0)).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(solved.trials->steps().not_converged, 1U);
    EXPECT_THROW(static_cast<void>(solved.trials->evaluate(x)), gum::NoResultError);
}

TEST(RotaryTableTrials, SensitivitiesAreThoseOfTheModelForPropagation) {
    const Solved solved(full_plan());
    const auto& model = dynamic_cast<const RotaryTableModel&>(*solved.solution.model);
    const Eigen::MatrixXd of_trials = solved.trials->jacobian(gum::input_estimates(*solved.trials));
    // With the dead paths found again, C V Cᵀ over the inputs is the covariance of the adjustment.
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(of_trials.rows(), of_trials.rows());
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : solved.trials->inputs()) {
        const Eigen::MatrixXd part = of_trials.middleCols(first, group.size());
        covariance += group.is_diagonal()
                          ? Eigen::MatrixXd(part * group.covariance.col(0).asDiagonal() * part.transpose())
                          : Eigen::MatrixXd(part * group.covariance * part.transpose());
        first += group.size();
    }
    const Eigen::VectorXd ratio = covariance.diagonal().cwiseSqrt().cwiseQuotient(solved.u);
    for (Eigen::Index i = 0; i < ratio.size(); ++i) {
        if (solved.solution.covariance(i, i) > 1e-30) {
            EXPECT_NEAR(ratio[i], 1.0, 2e-3) << solved.trials->outputs()[static_cast<std::size_t>(i)].name;
        }
    }
    EXPECT_EQ(model.outputs().size(), solved.trials->outputs().size());
}

TEST(RotaryTableTrials, FromTheModelForPropagationIsTheSame) {
    CampaignPlan plan = repeating({});
    plan.angles_deg = synthetic::full_turn(12);
    const Solved solved(plan);
    const auto& model = dynamic_cast<const RotaryTableModel&>(*solved.solution.model);
    const RotaryTableTrials trials(model);
    const Eigen::VectorXd estimates = gum::input_estimates(trials);
    ASSERT_EQ(estimates.size(), gum::input_estimates(*solved.trials).size());
    EXPECT_LT(
        ((trials.evaluate(estimates) - solved.trials->evaluate(estimates)).array() / solved.u.array()).abs().maxCoeff(),
        1e-6);
}

/// Coordinates with a common scale and an offset that must not matter.
class ScaledFixture final : public gum::MeasurementModel {
public:
    explicit ScaledFixture(const RotaryTableMeasurement& measurement)
        : stated_(measurement.fixture.transpose().reshaped()) {
        gum::InputGroup scale;
        scale.name = "scale of the coordinate measuring machine";
        scale.unit = "1";
        scale.value = Eigen::VectorXd::Constant(1, 2e-6);
        scale.covariance = Eigen::MatrixXd::Constant(1, 1, 4e-12);
        gum::InputGroup probing;
        probing.name = "probing";
        probing.unit = "m";
        probing.value = Eigen::VectorXd::Zero(stated_.size());
        probing.covariance = Eigen::MatrixXd::Constant(stated_.size(), 1, 1e-13);
        inputs_ = {scale, probing};
        for (Eigen::Index i = 0; i < stated_.size(); ++i) {
            outputs_.push_back({"coordinate " + std::to_string(i), "m"});
        }
    }
    [[nodiscard]] const std::vector<gum::InputGroup>& inputs() const override { return inputs_; }
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        return (1.0 + x[0]) * stated_ + x.tail(stated_.size()) + Eigen::VectorXd::Constant(stated_.size(), 1e-3);
    }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& /*x*/) const override {
        Eigen::MatrixXd result(stated_.size(), 1 + stated_.size());
        result << stated_, Eigen::MatrixXd::Identity(stated_.size(), stated_.size());
        return result;
    }

private:
    Eigen::VectorXd stated_;
    std::vector<gum::InputGroup> inputs_;
    std::vector<gum::OutputQuantity> outputs_;
};

TEST(RotaryTableTrials, FixtureMayHaveAModelOfItsOwn) {
    const Solved solved(full_plan());
    const auto fixture = std::make_shared<ScaledFixture>(solved.campaign.measurement);
    const RotaryTableTrials trials(*solved.joint, solved.stochastic, k_stated, {.fixture = fixture});
    Noise noise(21);
    const Eigen::VectorXd x = draw(trials, noise, 1.0);
    Eigen::VectorXd of_fixture(1 + 18);
    of_fixture << input(trials, x, "scale of the coordinate measuring machine"), input(trials, x, "probing");
    const Eigen::VectorXd coordinates =
        solved.campaign.measurement.fixture.transpose().reshaped() +
        (fixture->evaluate(of_fixture) - fixture->evaluate(gum::input_estimates(*fixture)));
    const Eigen::VectorXd expected = solve_again(solved, trials, x, coordinates);
    EXPECT_LT(((trials.evaluate(x) - expected).array() / solved.u.array()).abs().maxCoeff(), 1e-5);
}

/// Hands out the positions of the visits as they come.
class AllPositions final : public DerivedQuantities {
public:
    explicit AllPositions(std::size_t visits) : outputs_(visits, gum::OutputQuantity{"position", "rad"}) {}
    [[nodiscard]] const std::vector<gum::OutputQuantity>& outputs() const override { return outputs_; }
    void values(const Eigen::Ref<const Eigen::VectorXd>& /*reported*/,
                const Eigen::Ref<const Eigen::VectorXd>& visit_positions,
                Eigen::Ref<Eigen::VectorXd> result) const override {
        result = visit_positions;
    }

private:
    std::vector<gum::OutputQuantity> outputs_;
};

class PositionsOfTheVisits : public testing::TestWithParam<ReversalModel> {};

TEST_P(PositionsOfTheVisits, ReachTheDerivedQuantities) {
    CampaignPlan plan = full_plan();
    plan.reversal_model = GetParam();
    plan.reversal_second = 2.0 * plan.reversal;
    const Solved solved(plan);
    const auto derived = std::make_shared<AllPositions>(solved.joint->visits().size());
    const RotaryTableTrials trials(*solved.joint, solved.stochastic, k_stated, {.derived = derived});
    Noise noise(31);
    const Eigen::VectorXd x = draw(trials, noise, 1.0);
    JointAdjustment end = *solved.joint;
    const Eigen::VectorXd reported = solve_again(solved, trials, x, {}, &end);
    const VisitPositionGains gains = visit_position_gains(*solved.joint, solved.stochastic);
    Eigen::VectorXd expected = visit_positions(end, reported, gains);
    const Eigen::VectorXd axial = input(trials, x, "table repeatability, axial");
    for (std::size_t v = 0; v < gains.gains.size(); ++v) {
        if (gains.determined(v)) {
            expected[static_cast<Eigen::Index>(v)] += axial[static_cast<Eigen::Index>(v)];
        }
    }
    const Eigen::VectorXd y = trials.evaluate(x);
    EXPECT_LT((y.tail(expected.size()) - expected).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_GT(expected.cwiseAbs().maxCoeff(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Reversals, PositionsOfTheVisits,
                         testing::Values(ReversalModel::constant, ReversalModel::by_angle), [](const auto& tested) {
                             return tested.param == ReversalModel::by_angle ? "ByAngle" : "Constant";
                         });

}  // namespace
}  // namespace gumcert::engine
