// What a plan expects is what the evaluation of the measurement then states; proposals of stations are worth something.
#include "engine/measurement_plan.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "engine/variance_components.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::DeadPaths;
using synthetic::Vector6;

/// The layout of a plan of a campaign, without what its lengths say.
RotaryTableMeasurement layout_of(CampaignPlan plan) {
    plan.noise = 0.0;
    Campaign campaign = synthetic::simulate(plan);
    for (std::size_t j = 0; j < campaign.truth.stations.size(); ++j) {
        campaign.measurement.station_start[j] = campaign.truth.stations[j];
    }
    predict_lengths(campaign.measurement);
    return campaign.measurement;
}

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

std::vector<Eigen::Vector3d> narrow_cone() {
    // rotary_model_check.py, section D2: directions from the middle of the reflectors drawn towards the x axis.
    const CampaignPlan plan;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : plan.reflectors) {
        middle += p / 6.0;
    }
    std::vector<Eigen::Vector3d> stations;
    for (const Eigen::Vector3d& q : plan.stations) {
        const double distance = (q - middle).norm();
        const Eigen::Vector3d direction = Eigen::Vector3d::UnitX() + 0.15 / distance * (q - middle);
        stations.emplace_back(middle + distance * direction.normalized());
    }
    return stations;
}

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
// there removes means and turning parts with equal weight of the angles, as engine/datum.h says; the note weights them
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
         narrow_cone(),
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
        const RotaryTableMeasurement measurement = layout_of(plan);
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
    const RotaryTableMeasurement measurement = layout_of(note_layout());
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
                const RotaryTableMeasurement measurement = layout_of(plan);
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
    RotaryTableMeasurement measurement = layout_of(full_campaign(RotaryAxis::a, Datum::axis_average_line, true));
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
    const RotaryTableMeasurement before = layout_of(plan);
    plan.stations[1] = {0.3, 0.9, -0.4};
    const RotaryTableMeasurement after = layout_of(plan);
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
    RotaryTableMeasurement measurement = layout_of(note_layout());
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
    RotaryTableMeasurement measurement = layout_of(note_layout());
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
    const RotaryTableMeasurement measurement = layout_of(plan);
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
    EXPECT_EQ(with_twice_the_angles(layout_of(plan)).angles.size(), 19U) << "an open range has no angle after its end";
}

ParallelTasks threads(unsigned count) {
    return {count, [count](std::size_t tasks, const std::function<void(unsigned, std::size_t)>& work) {
                std::atomic<std::size_t> next{0};
                std::vector<std::thread> pool;
                for (unsigned worker = 0; worker < count; ++worker) {
                    pool.emplace_back([&, worker] {
                        for (std::size_t task = next++; task < tasks; task = next++) {
                            work(worker, task);
                        }
                    });
                }
                for (std::thread& thread : pool) {
                    thread.join();
                }
            }};
}

constexpr std::array<double, 2> k_wanted{0.1e-6, 0.5e-6};

const StationRegion& front_box() {
    static const StationRegion region{{Eigen::Vector3d(0.4, -0.8, -0.8), Eigen::Vector3d(1.2, 0.8, 0.8)}, 0.4, 0.3};
    return region;
}

TEST(StationProposal, CandidatesObeyTheRules) {
    const RotaryTableMeasurement measurement = layout_of(note_layout());
    const StationCandidates candidates = station_candidates(measurement, front_box());
    EXPECT_EQ(candidates.step, 0.4);
    // 3 × 5 × 5, without the two on the rotary axis and those nearer than 0.3 m to a reflector.
    EXPECT_LE(candidates.positions.size(), 72U);
    EXPECT_GT(candidates.positions.size(), 60U);
    for (const Eigen::Vector3d& position : candidates.positions) {
        EXPECT_GE(std::hypot(position[1], position[2]), 0.02);
        for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
            const Eigen::Matrix3d rotation = nominal_rotation(measurement, i);
            for (Eigen::Index m = 0; m < 6; ++m) {
                EXPECT_GE((rotation * measurement.fixture.row(m).transpose() - position).norm(), 0.3);
            }
        }
    }
    EXPECT_EQ(candidates.positions.front(), Eigen::Vector3d(0.4, -0.8, -0.8));
    EXPECT_TRUE(candidates.positions.back().isApprox(Eigen::Vector3d(1.2, 0.8, 0.8)));

    StationRegion fine = front_box();
    fine.step = 0.01;
    fine.most_candidates = 500;
    const StationCandidates limited = station_candidates(measurement, fine);
    EXPECT_GT(limited.step, 0.01);
    EXPECT_LE(limited.positions.size(), 500U);
    EXPECT_GT(limited.positions.size(), 250U);

    StationRegion flat = front_box();  // a floor: a box without height
    flat.corners[1][2] = flat.corners[0][2];
    for (const Eigen::Vector3d& position : station_candidates(measurement, flat).positions) {
        EXPECT_EQ(position[2], -0.8);
    }
}

TEST(StationProposal, ANarrowConeBecomesAboutAsGoodAsTheBestOfManyLayouts) {
    CampaignPlan plan = note_layout();
    plan.angles_deg = synthetic::full_turn(12);
    plan.stations = narrow_cone();
    const RotaryTableMeasurement measurement = layout_of(plan);
    const StochasticModel stochastic = start_variances(measurement.table_repeatability);
    const std::vector<Eigen::Vector3d> candidates = station_candidates(measurement, front_box()).positions;
    const StationProposal proposal = propose_stations(measurement, stochastic, candidates, k_wanted, threads(1));

    ASSERT_FALSE(proposal.exchanges.empty());
    double last = proposal.ratio_before;
    for (const StationExchange& exchange : proposal.exchanges) {
        EXPECT_LT(exchange.ratio, last);
        last = exchange.ratio;
    }
    EXPECT_EQ(last, proposal.ratio_after);
    plan.stations = proposal.positions;
    const RotaryTableMeasurement moved = layout_of(plan);
    EXPECT_NEAR(largest_ratio(expected(moved).covariance.diagonal(), 12, k_wanted) / proposal.ratio_after, 1.0, 1e-7)
        << "the ratio that is claimed is not that of the positions";

    synthetic::Noise noise(4);
    double best = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 200; ++trial) {
        for (Eigen::Vector3d& station : plan.stations) {
            for (int c = 0; c < 3; ++c) {
                station[c] = front_box().corners[0][c] +
                             noise.uniform() * (front_box().corners[1][c] - front_box().corners[0][c]);
            }
        }
        best = std::min(best, largest_ratio(LayoutVariances(layout_of(plan), stochastic).variances(), 12, k_wanted));
    }
    EXPECT_LT(proposal.ratio_after, 1.05 * best);
    EXPECT_LT(proposal.ratio_after, 0.3 * proposal.ratio_before);
}

TEST(StationProposal, IsTheSameForAnyNumberOfThreads) {
    CampaignPlan plan = note_layout();
    plan.angles_deg = synthetic::full_turn(8);
    plan.stations = narrow_cone();
    const RotaryTableMeasurement measurement = layout_of(plan);
    const StochasticModel stochastic = start_variances(measurement.table_repeatability);
    const std::vector<Eigen::Vector3d> candidates = station_candidates(measurement, front_box()).positions;
    const StationProposal one = propose_stations(measurement, stochastic, candidates, k_wanted, threads(1));
    const StationProposal three = propose_stations(measurement, stochastic, candidates, k_wanted, threads(3));
    EXPECT_EQ(one.ratio_after, three.ratio_after);
    ASSERT_EQ(one.exchanges.size(), three.exchanges.size());
    for (std::size_t e = 0; e < one.exchanges.size(); ++e) {
        EXPECT_EQ(one.exchanges[e].station, three.exchanges[e].station);
        EXPECT_EQ(one.exchanges[e].to, three.exchanges[e].to);
        EXPECT_EQ(one.exchanges[e].ratio, three.exchanges[e].ratio);
    }
}

TEST(StationProposal, NothingToChooseFromChangesNothing) {
    const RotaryTableMeasurement measurement = layout_of(note_layout());
    const StationProposal proposal =
        propose_stations(measurement, start_variances(measurement.table_repeatability), {}, k_wanted, threads(1));
    EXPECT_TRUE(proposal.exchanges.empty());
    EXPECT_EQ(proposal.ratio_before, proposal.ratio_after);
    EXPECT_EQ(proposal.positions[2], *measurement.station_start[2]);
}

}  // namespace
}  // namespace gumcert::engine
