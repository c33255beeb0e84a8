// A reversal that depends on the angle is found and modelled at every angle; sound measurements keep one of all angles.
#include "engine/rotary_table/reversal_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

#include "engine/rotary_table/anglewise_map.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/rotary_table_contributions.h"
#include "gum/quantity/dense_factors.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::Vector6;

double chi_square_tail(double value, double degrees_of_freedom) {
    return boost::math::cdf(boost::math::complement(boost::math::chi_squared_distribution<double>(degrees_of_freedom),
                                                    std::max(value, 0.0)));
}

double fisher_tail(double value, double numerator, double denominator) {
    if (std::isinf(denominator)) {
        return chi_square_tail(numerator * value, numerator);
    }
    return boost::math::cdf(boost::math::complement(boost::math::fisher_f_distribution<double>(numerator, denominator),
                                                    std::max(value, 0.0)));
}

EvaluationOptions options() {
    EvaluationOptions all;
    all.chi_square_upper_tail = chi_square_tail;
    all.fisher_upper_tail = fisher_tail;
    return all;
}

CampaignPlan sound_plan(std::uint64_t seed) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.both_senses = true;
    plan.reversal << 1e-6, -2e-6, 1.5e-6, 4e-6, -3e-6, 2e-6;
    plan.table_linear = 0.15e-6;
    plan.table_axial = 1.5e-6;
    plan.table_tilt = 0.5e-6;
    plan.seed = seed;
    return plan;
}

/// Every second campaign has a table that varies in two motions; variances are estimated from the residuals.
CampaignPlan varying_plan(std::uint64_t seed) {
    CampaignPlan plan = sound_plan(seed);
    plan.reversal_second << 2e-6, 0.0, 0.0, 20e-6, 0.0, 0.0;  // 2 µm in EXA, 4″ in EAA
    return plan;
}

Campaign estimated(const CampaignPlan& plan) {
    Campaign campaign = simulate(plan);
    campaign.measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    campaign.measurement.estimate_length_noise = true;
    campaign.measurement.outliers.test = OutlierTest::data_snooping;
    return campaign;
}

const RotaryTableModel& model_of(const RotaryTableSolution& solution) {
    return dynamic_cast<const RotaryTableModel&>(*solution.model);
}

const gum::Diagnostic* note_of(const RotaryTableSolution& solution) {
    const auto found = std::ranges::find(solution.notes, "GC-REVERSAL-0002", &gum::Diagnostic::code);
    return found == solution.notes.end() ? nullptr : &*found;
}

TEST(ReversalChoice, FindsAReversalThatDependsOnTheAngle) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Campaign campaign = estimated(varying_plan(seed));
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, options());
        ASSERT_EQ(solution.reversal_model, ReversalModel::by_angle) << seed;
        ASSERT_EQ(solution.reversal_tests.size(), 6U);
        for (const ReversalTest& test : solution.reversal_tests) {
            EXPECT_EQ(test.depends_on_angle, test.motion == 0 || test.motion == 3) << test.motion;
            EXPECT_EQ(test.angles, 11.0);
            EXPECT_GT(test.residual, 30.0) << test.motion;
        }
        EXPECT_NEAR(solution.reversal_tests[0].spread, 2e-6 / std::sqrt(2.0), 0.4e-6);
        EXPECT_NEAR(solution.reversal_tests[3].spread, 20e-6 / std::sqrt(2.0), 3e-6);
        const gum::Diagnostic* const note = note_of(solution);
        ASSERT_NE(note, nullptr);
        EXPECT_EQ(note->severity, gum::Severity::note);
        EXPECT_NE(note->what.find("depends on the angle: it varies by"), std::string::npos) << note->what;

        // The repeatability is that of the table, and not the reversal that was left over.
        EXPECT_NEAR(solution.components[table_axial].value, 1.5e-6, 0.6e-6);
        EXPECT_NEAR(solution.components[table_linear].value, 0.15e-6, 0.08e-6);
        for (std::size_t i = 0; i < 12; ++i) {
            const Vector6 off =
                model_of(solution).solved().reversal(i) - campaign.truth.reversals.col(static_cast<Eigen::Index>(i));
            EXPECT_LT(std::abs(off[0]), 1.0e-6) << seed << ' ' << i;
            EXPECT_LT(std::abs(off[3]), 5.0e-6) << seed << ' ' << i;
        }
        // One reversal of all angles states a repeatability that the table does not have.
        RotaryTableMeasurement constant = campaign.measurement;
        constant.reversal = ReversalModel::constant;
        const RotaryTableSolution one = evaluate_jointly(constant, options());
        EXPECT_EQ(one.reversal_model, ReversalModel::constant);
        EXPECT_GT(one.components[table_axial].value, 4e-6);
        ASSERT_NE(note_of(one), nullptr);
        EXPECT_EQ(note_of(one)->severity, gum::Severity::warning);
        EXPECT_EQ(one.reversal_tests.size(), 6U);
    }
}

TEST(ReversalChoice, LeavesSoundMeasurementsWithOneOfAllAngles) {
    int by_angle = 0;
    int tested = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const RotaryTableSolution solution = evaluate_jointly(estimated(sound_plan(seed)).measurement, options());
        by_angle += solution.reversal_model == ReversalModel::by_angle ? 1 : 0;
        tested += solution.reversal_tests.empty() ? 0 : 1;
    }
    EXPECT_EQ(by_angle, 0) << "one of a thousand";
    EXPECT_LE(tested, 15) << "tests are worth their time in about one of twenty";
}

TEST(ReversalChoice, TakesNoDriftForAReversal) {
    for (const double drift : {1e-6, -3e-6}) {
        Campaign campaign = estimated(sound_plan(7));
        std::vector<double> visits(campaign.measurement.stations.size(), 0.0);
        std::size_t pass = campaign.measurement.passes.size();
        std::size_t angle = 0;
        for (LengthObservation& length : campaign.measurement.lengths) {
            if (length.pass != pass || length.angle != angle) {
                pass = length.pass;
                angle = length.angle;
                visits[length.station] += 1.0;
            }
            if (length.station == 2) {
                length.length += drift * visits[2] / 24.0;
            }
        }
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, options());
        EXPECT_EQ(solution.reversal_model, ReversalModel::constant) << drift;
    }
}

TEST(ReversalChoice, StatesProbabilitiesThatAreTrue) {
    // 6 tests in each of 40 campaigns with stated variances: their p-values are uniform, mean 1/2 ± 0.019.
    double sum = 0.0;
    int low = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        CampaignPlan plan = sound_plan(100 + seed);
        plan.reversal_model = ReversalModel::by_angle;
        const RotaryTableSolution solution = evaluate_jointly(simulate(plan).measurement, options());
        ASSERT_EQ(solution.reversal_tests.size(), 6U);
        for (const ReversalTest& test : solution.reversal_tests) {
            EXPECT_TRUE(std::isinf(test.residual));
            sum += test.p_value / 240.0;
            low += test.p_value < 0.05 ? 1 : 0;
        }
    }
    EXPECT_NEAR(sum, 0.5, 4.0 * 0.019);
    EXPECT_LE(low, 26) << "12 expected";
}

TEST(ReversalChoice, TestValueIsThatOfDenseMatricesWithADriftOfEachStation) {
    CampaignPlan plan = varying_plan(3);
    plan.reversal_model = ReversalModel::by_angle;
    plan.datum = Datum::home;
    plan.angles_deg = synthetic::full_turn(6);
    const RotaryTableSolution solution = evaluate_jointly(simulate(plan).measurement, options());
    const JointAdjustment& known = model_of(solution).solved();
    JointAdjustment joint(known.measurement(), known.active(), known.set_up(), known.present_values(),
                          solution.stochastic);
    joint.copy_parameters_from(known);
    joint.set_weights(solution.stochastic);
    const NormalEquations normal = joint.adjustment().linearise();
    const std::vector<ReversalTest> tests =
        test_reversals(joint, normal, normal.bordered_covariance(), solution.components, fisher_tail);

    const Eigen::Index p = normal.parameter_count();
    const auto stations = static_cast<Eigen::Index>(known.measurement().stations.size());
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(normal.observation_count(), p + stations);
    Eigen::VectorXd r(normal.observation_count());
    Eigen::VectorXd count = Eigen::VectorXd::Zero(stations);
    Eigen::Index row = 0;
    for (std::size_t g = 0; g < normal.groups().size(); ++g) {
        const LinearisedGroup& group = normal.groups()[g];
        const Eigen::Index n = group.residual.size();
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            J.block(row, group.columns[c], n, 1) = group.jacobian.col(static_cast<Eigen::Index>(c));
        }
        if (g < joint.visits().size()) {
            const auto station = static_cast<Eigen::Index>(joint.visits()[g].station);
            J.block(row, p + station, n, 1) = group.cholesky.triangularView<Eigen::Lower>().solve(
                Eigen::VectorXd::Constant(n, 1e-6 * count[station]));  // not centred: the dead path takes that up
            count[station] += 1.0;
        }
        r.segment(row, n) = group.residual;
        row += n;
    }
    const Eigen::VectorXd scale = J.colwise().norm().cwiseInverse();
    const Eigen::MatrixXd scaled = J * scale.asDiagonal();
    const Eigen::VectorXd step = scale.cwiseProduct(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(scaled).solve(r));
    const Eigen::MatrixXd inverse =
        (scaled.transpose() * scaled).ldlt().solve(Eigen::MatrixXd::Identity(J.cols(), J.cols()));
    const Eigen::MatrixXd covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
    for (int motion = 0; motion < 6; ++motion) {
        Eigen::VectorXd value(6);
        std::vector<Eigen::Index> columns;
        for (std::size_t i = 0; i < 6; ++i) {
            columns.push_back(normal.column(joint.pose_block(i), 6 + motion));
            value[static_cast<Eigen::Index>(i)] = joint.reversal(i)[motion] + step[columns.back()];
        }
        Eigen::MatrixXd contrast = Eigen::MatrixXd::Zero(5, 6);  // each against the first
        contrast.col(0).setConstant(-1.0);
        contrast.rightCols<5>().setIdentity();
        const Eigen::VectorXd difference = contrast * value;
        const Eigen::MatrixXd of_difference = contrast * covariance(columns, columns) * contrast.transpose();
        const double f = difference.dot(of_difference.ldlt().solve(difference)) / 5.0;
        EXPECT_NEAR(tests[static_cast<std::size_t>(motion)].f, f, 1e-5 * f) << motion;
    }
}

TEST(ReversalChoice, UncertaintiesOfBothSensesAreThoseOfSimulatedMeasurements) {
    // Squared deviations over variances of all poses of both senses of 25 campaigns, axial and radial.
    double axial = 0.0;
    double linear = 0.0;
    double count = 0.0;
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        CampaignPlan plan = varying_plan(200 + seed);
        plan.reversal_model = ReversalModel::by_angle;
        plan.datum = Datum::home;
        const Campaign campaign = simulate(plan);
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        const RotaryTableModel& model = model_of(solution);
        const AnglewiseMap map = map_of_both_senses(reported_map(model.solved(), model.equations(), solution.datum));
        const Eigen::VectorXd variance = contributions_of(model, map).covariance.diagonal();
        for (Eigen::Index i = 0; i < 12; ++i) {
            const Vector6 reversal = model.solved().reversal(static_cast<std::size_t>(i));
            for (const int sense : {0, 1}) {
                const double half = sense == 0 ? 0.5 : -0.5;
                const Vector6 off = solution.datum.errors.col(i) + half * reversal - campaign.truth.errors.col(i) -
                                    half * campaign.truth.reversals.col(i);
                axial += off[3] * off[3] / variance[12 * i + 6 * sense + 3];
                linear += off[0] * off[0] / variance[12 * i + 6 * sense];
                count += 1.0;
            }
        }
    }
    // The poses of a campaign share its stations and fixture: 25 campaigns know the ratio to about a tenth.
    EXPECT_NEAR(axial / count, 1.0, 0.3);
    EXPECT_NEAR(linear / count, 1.0, 0.3);
}

TEST(ReversalChoice, OneSenseAtAnAngleIsNotTested) {
    Campaign campaign = estimated(varying_plan(5));
    std::erase_if(campaign.measurement.lengths, [](const LengthObservation& length) {
        return length.angle == 4 && length.approach == Approach::negative;
    });
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, options());
    EXPECT_EQ(solution.reversal_model, ReversalModel::constant);
    EXPECT_TRUE(solution.reversal_tests.empty());
}

}  // namespace
}  // namespace gumcert::engine
