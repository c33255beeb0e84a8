// What a plan expects is what the evaluation of the measurement then states; proposals of stations are worth something.
#include "engine/rotary_table/studies/measurement_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/rotary_table/studies/station_proposal.h"
#include "engine/rotary_table/variance_components.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/planned_layout.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::DeadPaths;
using synthetic::Vector6;

ExpectedUncertainty expected(const RotaryTableMeasurement& measurement) {
    return expected_uncertainty(measurement, start_variances(measurement.table_repeatability), EvaluationOptions{});
}

/// Root mean square of the standard uncertainties over the angles, [µm] and [µrad].
Vector6 rms(const ExpectedUncertainty& uncertainty, const RotaryTableMeasurement& measurement) {
    return 1e6 * synthetic::rms_over_angles(uncertainty.covariance.diagonal().cwiseSqrt(),
                                            static_cast<Eigen::Index>(measurement.angles.size()));
}

/// The geometry of the note, rotary-table.md, 4e. With what `synthetic_campaign.h` takes for its length noise: it adds
/// in squares, and the note's 0.1 µm + 0.15 µm/m adds linearly.
CampaignPlan note_layout(Datum datum = Datum::axis_average_line) {
    CampaignPlan plan;
    plan.datum = datum;
    return plan;
}

struct OracleCase {
    const char* name;
    Datum datum;
    std::vector<Eigen::Vector3d> stations;     // empty: those of the note
    std::vector<std::size_t> reflectors_left;  // empty: all
    std::array<double, 6> exact;               // same noise law
    std::array<double, 6> printed;             // in the note, its own noise law
};

std::vector<Eigen::Vector3d> twice_as_far() {
    const CampaignPlan plan;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : plan.reflectors) {
        middle += p / 6.0;
    }
    std::vector<Eigen::Vector3d> stations;
    for (const Eigen::Vector3d& q : plan.stations) {
        stations.emplace_back(middle + 2.0 * (q - middle));
    }
    return stations;
}

// Oracle: numpy, class Bundle of shared/tools/rotary_model_check.py (an independent Jacobian with the poses as rotation
// vectors), inverse of JᵀJ, with u = hypot(0.158 µm, 0.1936 µm/m · d) and the CMM of eq. (11). The axis average line
// there removes means and turning parts with equal weight of the angles, as engine/rotary_table/datum.h says; the note weights them
// with the reflectors, which changes nothing in three digits. Of stations twice as far the note says "× 1.5".
TEST(MeasurementPlan, StandardUncertaintiesOfTheNote) {
    const CampaignPlan note;
    const std::vector<Eigen::Vector3d> four(note.stations.begin(), note.stations.begin() + 4);
    const Datum a = Datum::axis_average_line;
    const std::vector<OracleCase> cases{
        {"six stations, axis average line",
         a,
         {},
         {},
         {0.058056, 0.103438, 0.12094, 0.773183, 0.653944, 0.601353},
         {0.057, 0.101, 0.119, 0.78, 0.66, 0.59}},
        {"six stations, home",
         Datum::home,
         {},
         {},
         {0.083152, 0.130956, 0.148538, 1.106139, 0.807234, 0.756325},
         {0.084, 0.128, 0.144, 1.10, 0.81, 0.74}},
        {"four stations",
         a,
         four,
         {},
         {0.065097, 0.146546, 0.134231, 0.997587, 0.7204, 0.75366},
         {0.065, 0.145, 0.133, 0.99, 0.71, 0.75}},
        {"four reflectors",
         a,
         {},
         {0, 2, 3, 4},
         {0.072157, 0.111633, 0.13232, 0.927641, 0.802612, 0.762316},
         {0.072, 0.111, 0.131, 0.92, 0.80, 0.76}},
        {"narrow cone",
         a,
         planned::narrow_cone(),
         {},
         {0.040246, 0.57958, 0.697225, 5.819989, 0.914044, 0.819611},
         {0.040, 0.575, 0.691, 5.8, 0.91, 0.82}},
        {"twice as far",
         a,
         twice_as_far(),
         {},
         {0.09301, 0.160062, 0.185298, 1.212166, 1.036123, 0.959716},
         {0.087, 0.155, 0.180, 1.16, 0.98, 0.90}},
    };
    for (const OracleCase& one : cases) {
        CampaignPlan plan = note_layout(one.datum);
        if (!one.stations.empty()) {
            plan.stations = one.stations;
        }
        if (!one.reflectors_left.empty()) {
            std::vector<Eigen::Vector3d> left;
            for (const std::size_t m : one.reflectors_left) {
                left.push_back(plan.reflectors[m]);
            }
            plan.reflectors = left;
        }
        const RotaryTableMeasurement measurement = planned::layout_of(plan);
        const Vector6 found = rms(expected(measurement), measurement);
        for (int c = 0; c < 6; ++c) {
            const auto k = static_cast<std::size_t>(c);
            EXPECT_NEAR(found[c] / one.exact[k], 1.0, 2e-5) << one.name << ", component " << c;
            // Simulated with 200 runs and another law of noise: the figures of the note are good to some per cent.
            EXPECT_NEAR(found[c] / one.printed[k], 1.0, 0.08) << one.name << ", component " << c;
        }
    }
}

TEST(MeasurementPlan, SummaryFiguresOfTheNote) {
    const RotaryTableMeasurement measurement = planned::layout_of(note_layout());
    const ExpectedUncertainty uncertainty = expected(measurement);
    // The same oracle; 1296 distances + 18 coordinates − 252 parameters.
    EXPECT_EQ(uncertainty.degrees_of_freedom, 1062);
    EXPECT_NEAR(uncertainty.mean_redundancy, 0.810274, 2e-6);
    EXPECT_NEAR(1e6 * uncertainty.largest_minimal_detectable_bias, 1.635173, 2e-5);
    EXPECT_EQ(uncertainty.uncontrolled_distances, 0U);
    EXPECT_NEAR(uncertainty.condition_number / 2904.5, 1.0, 0.02) << "Euler angles there, rotation vectors here";
    const Eigen::VectorXd u = 1e6 * uncertainty.covariance.diagonal().cwiseSqrt();
    const std::array<double, 4> set_up{0.248558, 0.244238, 1.573677, 1.643899};
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_NEAR(u[uncertainty.quantities.set_up + static_cast<Eigen::Index>(c)], set_up[c], 1e-5) << c;
    }
    Vector6 largest = Vector6::Zero();
    for (Eigen::Index i = 0; i < 216; ++i) {
        largest[i % 6] = std::max(largest[i % 6], u[i]);
    }
    const std::array<double, 6> oracle{0.058231, 0.105736, 0.123744, 0.792229, 0.680574, 0.623074};
    for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_NEAR(largest[static_cast<Eigen::Index>(c)], oracle[c], 1e-5) << c;
    }
}

CampaignPlan full_campaign(RotaryAxis axis, Datum datum, bool both_senses) {
    CampaignPlan plan;
    plan.axis = axis;
    plan.datum = datum;
    plan.home = 3;
    plan.angles_deg = synthetic::full_turn(18);
    plan.both_senses = both_senses;
    plan.scale_model = ScaleModel::prior;
    plan.u_scale = 1.5e-7;
    plan.temperature_difference = 0.2;
    plan.u_temperature = 0.027;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 5e-7;
    plan.table_linear = 0.2e-6;
    plan.table_axial = 2e-6;
    plan.table_tilt = 1e-6;
    plan.start_values = true;
    return plan;
}

TEST(MeasurementPlan, IsWhatTheEvaluationOfASimulatedCampaignStates) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        for (const Datum datum : {Datum::axis_average_line, Datum::home}) {
            CampaignPlan plan = full_campaign(axis, datum, axis == RotaryAxis::b);
            if (axis == RotaryAxis::c) {
                plan.dead_paths = DeadPaths::per_station_and_reflector;
                plan.missing_share = 0.05;
            }
            Campaign campaign = synthetic::simulate(plan);
            const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
            RotaryTableMeasurement layout = campaign.measurement;
            for (std::size_t j = 0; j < layout.stations.size(); ++j) {
                layout.station_start[j] = campaign.truth.stations[j];
            }
            predict_lengths(layout);
            const ExpectedUncertainty planned = expected(layout);
            ASSERT_EQ(planned.covariance.rows(), solution.covariance.rows());
            EXPECT_EQ(planned.degrees_of_freedom, solution.degrees_of_freedom);
            for (Eigen::Index i = 0; i < solution.covariance.rows(); ++i) {
                const double u = std::sqrt(solution.covariance(i, i));
                const double u_planned = std::sqrt(planned.covariance(i, i));
                if (u == 0.0) {
                    EXPECT_EQ(u_planned, 0.0);
                } else {
                    EXPECT_NEAR(u_planned / u, 1.0, 0.01)
                        << planned.quantities.outputs[static_cast<std::size_t>(i)].name;
                }
            }
            for (std::size_t j = 0; j < planned.stations.size(); ++j) {
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(std::sqrt(planned.stations[j].covariance(c, c)) / solution.stations[j].u[c], 1.0, 0.01);
                }
            }
        }
    }
}

TEST(MeasurementPlan, LayoutVariancesAreTheDiagonalOfTheFullCovariance) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        for (const Datum datum : {Datum::axis_average_line, Datum::home}) {
            for (const bool both_senses : {false, true}) {
                CampaignPlan plan = full_campaign(axis, datum, both_senses);
                plan.missing_share = 0.1;
                plan.dead_paths = both_senses ? DeadPaths::per_station : DeadPaths::per_station_and_reflector;
                const RotaryTableMeasurement measurement = planned::layout_of(plan);
                const ExpectedUncertainty full = expected(measurement);
                const LayoutVariances lean(measurement, start_variances(measurement.table_repeatability));
                const std::optional<Eigen::VectorXd> variances = lean.variances();
                ASSERT_TRUE(variances.has_value());
                ASSERT_EQ(variances->size(), full.covariance.rows());
                for (Eigen::Index i = 0; i < variances->size(); ++i) {
                    EXPECT_NEAR((*variances)[i], full.covariance(i, i), 1e-8 * full.covariance(i, i))
                        << full.quantities.outputs[static_cast<std::size_t>(i)].name;
                }
            }
        }
    }
}

TEST(MeasurementPlan, AStationInOneSenseOnlyLeavesTheReversalOut) {
    RotaryTableMeasurement measurement =
        planned::layout_of(full_campaign(RotaryAxis::a, Datum::axis_average_line, true));
    std::erase_if(measurement.lengths, [](const LengthObservation& length) {
        return length.station == 2 && length.approach == Approach::negative;
    });
    const ExpectedUncertainty full = expected(measurement);
    const std::optional<Eigen::VectorXd> lean =
        LayoutVariances(measurement, start_variances(measurement.table_repeatability)).variances();
    ASSERT_TRUE(lean.has_value());
    ASSERT_EQ(lean->size(), full.covariance.rows());
    EXPECT_FALSE(full.quantities.has_reversal);
    for (Eigen::Index i = 0; i < lean->size(); ++i) {
        EXPECT_NEAR((*lean)[i], full.covariance(i, i), 1e-8 * full.covariance(i, i)) << i;
    }
}

TEST(MeasurementPlan, AMovedStationReplacesItsPartOnly) {
    CampaignPlan plan = full_campaign(RotaryAxis::a, Datum::axis_average_line, false);
    const RotaryTableMeasurement before = planned::layout_of(plan);
    plan.stations[1] = {0.3, 0.9, -0.4};
    const RotaryTableMeasurement after = planned::layout_of(plan);
    const StochasticModel stochastic = start_variances(before.table_repeatability);
    const LayoutVariances layout(before, stochastic);
    LayoutVariances::Information sum = layout.prior();
    LayoutVariances::Information part;
    for (std::size_t j = 0; j < 6; ++j) {
        const auto observer = layout.observer(j);
        observer->information({0.5, -0.5, 0.9}, part);  // leaves no trace
        observer->information(plan.stations[j], part);
        add(sum, part);
    }
    const std::optional<Eigen::VectorXd> moved = layout.variances(sum);
    const std::optional<Eigen::VectorXd> made = LayoutVariances(after, stochastic).variances();
    ASSERT_TRUE(moved && made);
    EXPECT_LT((moved->array() / made->array() - 1.0).abs().maxCoeff(), 1e-10);
}

TEST(MeasurementPlan, LayoutsThatDetermineNothingAreNamed) {
    RotaryTableMeasurement measurement = planned::layout_of(note_layout());
    // One station and five reflectors: five distances an angle for six error motions.
    for (std::size_t left_out = 5; left_out > 0; --left_out) {
        measurement = without_station(measurement, left_out);
    }
    const StochasticModel stochastic = start_variances(measurement.table_repeatability);
    measurement = without_reflector(measurement, 0);
    EXPECT_FALSE(LayoutVariances(measurement, stochastic).variances().has_value());
    const std::optional<gum::Diagnostic> why = undetermined_by(measurement, stochastic, SolverOptions{});
    ASSERT_TRUE(why.has_value());
    EXPECT_EQ(why->code, "GC-RANK-0001");
    EXPECT_FALSE(why->action.empty());
    EXPECT_THROW((void)expected(measurement), gum::NoResultError);
    EXPECT_TRUE(std::isinf(largest_ratio(std::nullopt, 36, {1e-6, 1e-6})));
}

TEST(MeasurementPlan, AStationWithoutPositionIsRefused) {
    RotaryTableMeasurement measurement = planned::layout_of(note_layout());
    measurement.station_start[1].reset();
    measurement.station_start[4].reset();
    try {
        predict_lengths(measurement);
        FAIL() << "accepted";
    } catch (const gum::InputError& error) {
        ASSERT_EQ(error.diagnostics().size(), 2U);
        EXPECT_EQ(error.diagnostics()[0].code, "GC-PLAN-0001");
        EXPECT_EQ(error.diagnostics()[1].where, "station P5");
    }
}

TEST(MeasurementPlan, AnglesAreHalvedAndDoubledAboutHome) {
    CampaignPlan plan = note_layout();
    plan.angles_deg = synthetic::full_turn(36);
    plan.home = 3;
    const RotaryTableMeasurement measurement = planned::layout_of(plan);
    const RotaryTableMeasurement half = with_every_angle(measurement, 2);
    ASSERT_EQ(half.angles.size(), 18U);
    EXPECT_EQ(half.angles_deg[half.home], 30.0);
    EXPECT_EQ(half.lengths.size(), measurement.lengths.size() / 2);
    const RotaryTableMeasurement twice = with_twice_the_angles(measurement);
    ASSERT_EQ(twice.angles.size(), 72U);
    EXPECT_EQ(twice.angles_deg[twice.home], 30.0);
    EXPECT_NEAR(twice.angles_deg.back(), 355.0, 1e-9);
    EXPECT_EQ(twice.lengths.size(), 2 * measurement.lengths.size());
    // Every second one of them is the layout that it was made from.
    const RotaryTableMeasurement again = with_every_angle(twice, 2);
    ASSERT_EQ(again.lengths.size(), measurement.lengths.size());
    EXPECT_LT((expected(again).covariance.dense() - expected(measurement).covariance.dense()).cwiseAbs().maxCoeff(),
              1e-8 * expected(measurement).covariance.dense().cwiseAbs().maxCoeff());

    plan.angles_deg = synthetic::partial_turn(90.0, 10);
    plan.home = 0;
    EXPECT_EQ(with_twice_the_angles(planned::layout_of(plan)).angles.size(), 19U)
        << "an open range has no angle after its end";
}

}  // namespace
}  // namespace gumcert::engine
