// Groups of distances that are wrong together are found and named first; sound measurements are left in peace.
#include "engine/rotary_table/group_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "tests/support/planted_blunders.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

double upper_tail(double value, double degrees_of_freedom) {
    return boost::math::cdf(boost::math::complement(boost::math::chi_squared_distribution<double>(degrees_of_freedom),
                                                    std::max(value, 0.0)));
}

/// A table with a repeatability of its own, whose components are estimated.
Campaign campaign(std::uint64_t seed) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(24);
    plan.table_linear = 0.15e-6;
    plan.table_axial = 1.5e-6;
    plan.table_tilt = 0.5e-6;
    plan.seed = seed;
    Campaign result = simulate(plan);
    result.measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    result.measurement.estimate_length_noise = true;
    result.measurement.outliers.test = OutlierTest::data_snooping;
    return result;
}

GroupTests tests_of(const RotaryTableMeasurement& measurement) {
    EvaluationOptions options;
    options.chi_square_upper_tail = upper_tail;
    const RotaryTableSolution solution = evaluate_jointly(measurement, options);
    return solution.groups.value();
}

std::string told(const GroupTests& groups) {
    std::string text = "scale " + std::to_string(groups.scale) + "\n";
    for (const GroupTest& test : groups.tests) {
        text += std::to_string(static_cast<int>(test.kind)) + (test.suspicious ? " ! " : "   ") +
                std::to_string(test.chi_square) + " (" + std::to_string(test.critical_value) + ") station " +
                std::to_string(static_cast<int>(test.station)) + " angle " +
                std::to_string(static_cast<int>(test.angle)) + " reflector " +
                std::to_string(static_cast<int>(test.reflector)) + " estimate " + std::to_string(test.estimate * 1e6) +
                " detectable " + std::to_string(test.minimal_detectable * 1e6) + "\n";
    }
    return text;
}

TEST(GroupTests, LeaveSoundMeasurementsInPeace) {
    // One family of tests has a level of 1 %: of 60, more than three alarms have a probability of 0.3 %.
    int alarms = 0;
    std::string told_of_all;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const GroupTests groups = tests_of(campaign(seed).measurement);
        EXPECT_NEAR(groups.scale, 1.0, 0.35);
        if (std::ranges::any_of(groups.tests, &GroupTest::suspicious)) {
            ++alarms;
            told_of_all += "seed " + std::to_string(seed) + "\n" + told(groups);
        }
    }
    EXPECT_LE(alarms, 3) << told_of_all;
}

/// The repeatability of a data sheet: five times what the table has.
RotaryTableMeasurement with_large_repeatability(std::uint64_t seed) {
    RotaryTableMeasurement measurement = campaign(seed).measurement;
    measurement.table_repeatability = {RepeatabilityMode::given, 0.75e-6, 7.5e-6, 2.5e-6};
    return measurement;
}

TEST(GroupTests, LeaveReflectorsInPeaceWhereTheRepeatabilityIsGivenTooLarge) {
    // All visits scatter little then. By their scale what tells the distances of a visit apart would be too large.
    int told_by_the_scale_of_visits = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const GroupTests groups = tests_of(with_large_repeatability(seed));
        EXPECT_LT(groups.scale, 0.6);
        EXPECT_FALSE(groups.tests.front().suspicious) << told(groups);
        for (const GroupTest& test : groups.tests) {
            told_by_the_scale_of_visits += test.kind == GroupKind::reflector_at_angles &&
                                                   test.chi_square / (groups.scale * groups.scale) > test.critical_value
                                               ? 1
                                               : 0;
        }
    }
    EXPECT_GE(told_by_the_scale_of_visits, 2);
}

TEST(GroupTests, FindWhatIsWrongWhereTheRepeatabilityIsGivenTooLarge) {
    RotaryTableMeasurement measurement = with_large_repeatability(5);
    for (LengthObservation& length : measurement.lengths) {
        length.length += length.station == 2 && length.reflector == 3 ? 1.5e-6 : 0.0;
    }
    const GroupTests groups = tests_of(measurement);
    EXPECT_TRUE(groups.tests.front().suspicious) << told(groups);
    EXPECT_EQ(groups.tests.front().kind, GroupKind::pair_length) << told(groups);
    EXPECT_EQ(groups.tests.front().station, 2U);
    EXPECT_EQ(groups.tests.front().reflector, 3U);
}

TEST(GroupTests, FindAVisitThatIsOff) {
    for (const double error : {5e-6, -50e-6, 500e-6}) {
        RotaryTableMeasurement measurement = campaign(31).measurement;
        for (LengthObservation& length : measurement.lengths) {
            if (length.station == 2 && length.angle == 7) {
                length.length += error;
            }
        }
        const GroupTests groups = tests_of(measurement);
        ASSERT_FALSE(groups.tests.empty());
        const GroupTest& first = groups.tests.front();
        EXPECT_TRUE(first.suspicious) << told(groups);
        EXPECT_EQ(first.kind, GroupKind::visit_length) << told(groups);
        EXPECT_EQ(first.station, 2U) << told(groups);
        EXPECT_EQ(first.angle, 7U) << told(groups);
        EXPECT_NEAR(first.estimate / error, 1.0, 0.3) << told(groups);
    }
}

TEST(GroupTests, FindAnInterruptedBeam) {
    for (const double error : {1e-6, 10e-6, 100e-6}) {
        RotaryTableMeasurement measurement = campaign(32).measurement;
        for (LengthObservation& length : measurement.lengths) {
            if (length.station == 1 && length.angle >= 13) {
                length.length += error;
            }
        }
        const GroupTests groups = tests_of(measurement);
        const GroupTest& first = groups.tests.front();
        EXPECT_TRUE(first.suspicious) << told(groups);
        EXPECT_EQ(first.kind, GroupKind::dead_path_change) << told(groups);
        EXPECT_EQ(first.station, 1U) << told(groups);
        EXPECT_EQ(first.angle, 13U) << told(groups);
        EXPECT_NEAR(first.estimate / error, 1.0, 0.5) << told(groups);
    }
}

/// One to three distances that are off by micrometres to a metre: never a refusal.
TEST(GroupTests, SurviveDistancesThatAreOffByAnySize) {
    for (const double error : {0.5e-6, 50e-6, 1.7e-3, 5e-3, 14e-3, 50e-3, 1.0}) {
        for (std::uint64_t seed = 41; seed < 44; ++seed) {
            RotaryTableMeasurement measurement = campaign(seed).measurement;
            for (std::size_t k = 0; k < seed - 40; ++k) {
                measurement.lengths[(37 * seed + 211 * k) % measurement.lengths.size()].length -= error;
            }
            EvaluationOptions options;
            options.chi_square_upper_tail = upper_tail;
            const RotaryTableSolution solution = evaluate_jointly(measurement, options);
            EXPECT_EQ(std::count_if(solution.outliers.begin(), solution.outliers.end(),
                                    [](const OutlierFinding& finding) { return finding.removed; }) >=
                          static_cast<long>(seed - 40),
                      error > 1e-6)
                << error << ", seed " << seed;
        }
    }
}

TEST(GroupTests, FindDrift) {
    for (const double drift : {2e-6, 10e-6}) {
        RotaryTableMeasurement measurement = campaign(33).measurement;
        for (LengthObservation& length : measurement.lengths) {
            length.length += drift * static_cast<double>(length.angle) / 23.0;
        }
        const GroupTests groups = tests_of(measurement);
        EXPECT_TRUE(groups.tests.front().suspicious) << told(groups);
        EXPECT_TRUE(groups.tests.front().kind == GroupKind::drift || groups.tests.front().kind == GroupKind::succession)
            << told(groups);
    }
}

// Of few stations the error motions leave little more than one number at an angle: what all stations show of it is one observation.
TEST(GroupTests, TakeStationsThatShowTheSameForOneSuccession) {
    double mean = 0.0;     // of the test value; 1/2 of one side of a square of a normal deviate
    double of_each = 0.0;  // were the visits of all stations independent
    constexpr std::uint64_t k_campaigns = 16;
    for (std::uint64_t seed = 301; seed < 301 + k_campaigns; ++seed) {
        CampaignPlan plan;
        plan.angles_deg = synthetic::full_turn(24);
        plan.stations.resize(4);
        plan.reflectors.resize(4);
        plan.table_linear = 0.3e-6;
        plan.table_axial = plan.table_tilt = 2e-6;
        plan.start_values = true;
        plan.seed = seed;
        for (const GroupTest& test : tests_of(simulate(plan).measurement).tests) {
            if (test.kind == GroupKind::succession) {
                mean += test.chi_square / k_campaigns;
                of_each += std::pow(std::max(0.0, test.estimate), 2) * 4.0 * 23.0 / k_campaigns;
            }
        }
    }
    EXPECT_LT(mean, 0.9) << of_each;
    EXPECT_GT(of_each, mean);
}

/// The same drift by the order of the rows and by times is told with one size; the rows may then stand in any order.
TEST(GroupTests, TakeADriftFromTheTimesOfTheDistances) {
    RotaryTableMeasurement measurement = campaign(40).measurement;
    const std::size_t angles = measurement.angles.size();
    for (LengthObservation& length : measurement.lengths) {
        // Measured from the middle onwards, then from the first angle: the file has the rows by angle.
        const std::size_t order = (length.angle + angles / 2) % angles;
        measurement.times.push_back(60.0 * static_cast<double>(order));
        if (length.station == 3) {
            length.length += 4e-6 * static_cast<double>(order) / static_cast<double>(angles - 1);
        }
    }
    const GroupTests groups = tests_of(measurement);
    const GroupTest& first = groups.tests.front();
    EXPECT_EQ(first.kind, GroupKind::drift) << told(groups);
    EXPECT_EQ(first.station, 3U);
    EXPECT_NEAR(first.estimate, 4e-6, 1e-6);
    measurement.times.clear();  // by its order this is a jump in the middle, and a drift on either side
    EXPECT_NE(tests_of(measurement).tests.front().kind, GroupKind::drift);
}

/// The first angle measured again at the end: what the table cannot imitate.
TEST(GroupTests, KnowADriftOfAllStationsBetterWhereRunsAreClosed) {
    const auto u_of_common = [](bool closed) {
        const GroupTests groups = tests_of(synthetic::sound_campaign(5, 24, closed).measurement);
        for (const DriftEstimate& drift : groups.drifts) {
            if (drift.station == GroupTest::k_none) {
                EXPECT_LT(std::abs(drift.estimate), 3.0 * drift.u);
                EXPECT_GT(drift.minimal_detectable, 3.0 * drift.u);
                return drift.u;
            }
        }
        ADD_FAILURE() << "no drift of all stations";
        return 0.0;
    };
    EXPECT_LT(u_of_common(true), 0.75 * u_of_common(false));
}

// One coefficient is wrong for all stations, by the temperature of each: no station is accused of a scale of its own.
TEST(GroupTests, TellAWrongExpansionCoefficientBeforeTheStations) {
    constexpr double k_steel = 11.5e-6;
    for (const double stated : {23.5e-6, 5e-6}) {
        CampaignPlan plan;
        plan.angles_deg = synthetic::full_turn(12);
        plan.seed = 7;
        RotaryTableMeasurement measurement = simulate(plan).measurement;
        measurement.expansion = stated;
        measurement.u_expansion = 0.5e-6;
        measurement.u_temperature.setConstant(0.03);
        const std::vector<double> temperatures{3.0, -2.5, 0.5, -1.0, 2.0, 4.0};
        for (std::size_t j = 0; j < temperatures.size(); ++j) {
            measurement.temperature_difference[static_cast<Eigen::Index>(j)] = temperatures[j];
        }
        for (LengthObservation& length : measurement.lengths) {
            // What an expansion of the fixture about its origin does to a distance, to first order: the point of the
            // reflector moves along its own vector, which at one station is the same as a factor on all distances.
            length.length *= 1.0 + k_steel * temperatures[length.station];
        }
        const GroupTests groups = tests_of(measurement);
        const GroupTest& first = groups.tests.front();
        EXPECT_TRUE(first.suspicious) << told(groups);
        EXPECT_EQ(first.kind, GroupKind::expansion) << told(groups);
        EXPECT_NEAR(stated - first.estimate, k_steel, 1e-6) << told(groups);
        EXPECT_TRUE(std::ranges::none_of(groups.tests, [](const GroupTest& test) {
            return test.suspicious && test.kind == GroupKind::station_scale;
        })) << told(groups);
    }
    // At one temperature it is the size of the fixture.
    RotaryTableMeasurement alike = campaign(7).measurement;
    alike.expansion = k_steel;
    alike.u_expansion = 0.5e-6;
    alike.temperature_difference.setConstant(5.0);
    const GroupTests groups = tests_of(alike);
    EXPECT_EQ(groups.tests.front().kind, GroupKind::fixture_scale) << told(groups);
    // And at temperatures nearly alike, where chance says which of both explains more.
    for (std::uint64_t seed = 16; seed <= 18; ++seed) {
        alike = campaign(seed).measurement;
        alike.expansion = 5e-6;
        alike.u_expansion = 0.5e-6;
        for (Eigen::Index j = 0; j < alike.temperature_difference.size(); ++j) {
            alike.temperature_difference[j] = j % 2 == 0 ? 4.9 : 5.1;
        }
        for (LengthObservation& length : alike.lengths) {
            length.length *= 1.0 + alike.expansion * (length.station % 2 == 0 ? -0.1 : 0.1);
        }
        const GroupTests nearly = tests_of(alike);
        EXPECT_EQ(nearly.tests.front().kind, GroupKind::fixture_scale) << seed << ", " << told(nearly);
    }
}

// Scales of two stations follow the temperatures in part by chance, and the more so as the adjustment takes them for temperatures.
TEST(GroupTests, ScalesOfTwoStationsAreNeitherExpansionNorAnythingElse) {
    for (const auto& [second, fifth] : {std::pair{100e-6, -30e-6}, std::pair{20e-6, 20e-6}, std::pair{20e-6, -20e-6}}) {
        CampaignPlan plan;
        plan.angles_deg = synthetic::full_turn(12);
        plan.both_senses = true;
        plan.temperature_difference = -0.2;
        plan.u_temperature = 0.03;
        plan.expansion = 11.5e-6;
        plan.u_expansion = 0.5e-6;
        plan.seed = 5;
        RotaryTableMeasurement measurement = simulate(plan).measurement;
        for (LengthObservation& length : measurement.lengths) {
            length.length *= 1.0 + (length.station == 1 ? second : length.station == 4 ? fifth : 0.0);
        }
        const GroupTests groups = tests_of(measurement);
        for (const GroupTest& test : groups.tests) {
            if (test.suspicious) {
                EXPECT_EQ(test.kind, GroupKind::station_scale) << told(groups);
                EXPECT_TRUE(test.station == 1 || test.station == 4) << told(groups);
            }
        }
        EXPECT_EQ(std::ranges::count_if(groups.tests, &GroupTest::suspicious), 2) << told(groups);
    }
}

// What the reversal does at a station whose senses are interchanged its place between two passes would take up.
TEST(GroupTests, TellInterchangedSensesOfAStation) {
    for (const double size : {1.0, 10.0}) {
        CampaignPlan plan;
        plan.angles_deg = synthetic::full_turn(12);
        plan.both_senses = true;
        plan.seed = 3;
        plan.reversal << Eigen::Vector3d(0.4e-6, -0.3e-6, 0.3e-6), Eigen::Vector3d(4e-6, -3e-6, 2e-6);
        plan.reversal *= size;
        RotaryTableMeasurement measurement = simulate(plan).measurement;
        EXPECT_TRUE(std::ranges::none_of(tests_of(measurement).tests, &GroupTest::suspicious));
        for (LengthObservation& length : measurement.lengths) {
            if (length.station == 2) {
                length.approach = length.approach == Approach::positive ? Approach::negative : Approach::positive;
            }
        }
        const GroupTests groups = tests_of(measurement);
        const GroupTest& first = groups.tests.front();
        EXPECT_TRUE(first.suspicious) << told(groups);
        EXPECT_EQ(first.kind, GroupKind::senses) << told(groups);
        EXPECT_GT(first.degrees_of_freedom, 1) << "the same distances say which reversal it is";
        EXPECT_EQ(first.station, 2U) << told(groups);
        EXPECT_NEAR(first.estimate, 1.0, 0.3) << told(groups);
        EXPECT_EQ(std::ranges::count_if(groups.tests, &GroupTest::suspicious), 1) << told(groups);
    }
}

/// u of the drifts is what they scatter by, and the shares of the kinds leave a tenth for the fixture.
TEST(GroupTests, StateTheScatterOfDriftsAndDivideTheLevel) {
    double squares = 0.0;
    int count = 0;
    for (std::uint64_t seed = 50; seed < 60; ++seed) {
        for (const DriftEstimate& drift : tests_of(campaign(seed).measurement).drifts) {
            squares += std::pow(drift.estimate / drift.u, 2);
            ++count;
        }
    }
    EXPECT_EQ(count, 70);
    EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.25);
    double shares = 0.0;
    for (const GroupKind kind :
         {GroupKind::visit_length, GroupKind::visit_pose, GroupKind::dead_path_change, GroupKind::station_place,
          GroupKind::pair_length, GroupKind::drift, GroupKind::angle_index, GroupKind::succession, GroupKind::station,
          GroupKind::reflector, GroupKind::reflector_at_angles, GroupKind::reflector_from_visit,
          GroupKind::fixture_scale, GroupKind::station_scale, GroupKind::fixture_place, GroupKind::expansion,
          GroupKind::senses}) {
        // Large values of one sign only make a succession or a station suspicious.
        const bool one_sided = kind == GroupKind::succession || kind == GroupKind::station;
        shares += share_of_level(kind) * (one_sided ? 0.5 : 1.0);
    }
    EXPECT_LE(shares, 0.9);
    EXPECT_GT(shares, 0.89);
}

// Linearised at temperatures that hundreds of ppm had moved, 270 ppm were told as 363 ppm, and reflectors beside them.
TEST(GroupTests, TellTheSizeOfAFixtureAndNothingElse) {
    for (const double larger : {270e-6, -60e-6}) {
        RotaryTableMeasurement measurement = campaign(36).measurement;
        measurement.expansion = 11.5e-6;
        measurement.u_expansion = 0.5e-6;
        measurement.temperature_difference.setConstant(0.5);
        measurement.u_temperature.setConstant(0.03);
        measurement.table_repeatability = {RepeatabilityMode::given, 0.15e-6, 1.5e-6, 0.5e-6};
        measurement.estimate_length_noise = false;
        measurement.outliers.test = OutlierTest::none;
        measurement.fixture /= (1.0 + larger) * (1.0 + 0.5 * measurement.expansion);
        const GroupTests groups = tests_of(measurement);
        const GroupTest& first = groups.tests.front();
        EXPECT_EQ(first.kind, GroupKind::fixture_scale) << told(groups);
        EXPECT_NEAR(-first.estimate * 1e6, larger * 1e6, 3.0) << told(groups);  // some times its u
        EXPECT_EQ(std::ranges::count_if(groups.tests, &GroupTest::suspicious), 1) << told(groups);
    }
}

TEST(GroupTests, FindADisplacedReflector) {
    for (const double error : {5e-6, 50e-6}) {
        RotaryTableMeasurement measurement = campaign(34).measurement;
        measurement.fixture(2, 1) += error;
        const GroupTests groups = tests_of(measurement);
        const GroupTest& first = groups.tests.front();
        EXPECT_TRUE(first.suspicious) << told(groups);
        EXPECT_EQ(first.kind, GroupKind::reflector) << told(groups);
        EXPECT_EQ(first.reflector, 2U) << told(groups);
        EXPECT_EQ(std::count_if(groups.tests.begin(), groups.tests.end(),
                                [](const GroupTest& t) { return t.suspicious && t.kind == GroupKind::reflector; }),
                  1)
            << told(groups);
    }
}

/// What the residuals refute is not said to be near 1 by construction.
TEST(GroupTests, NoReasonContradictsTheVarianceFactor) {
    CampaignPlan plan;
    plan.both_senses = true;
    plan.u_constant = 0.05e-6;
    plan.u_proportional = 0.0;
    plan.table_linear = 0.15e-6;
    plan.table_axial = 1.5e-6;
    plan.table_tilt = 1.5e-6;
    RotaryTableMeasurement measurement = simulate(plan).measurement;
    measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    measurement.estimate_length_noise = true;
    measurement.outliers.test = OutlierTest::data_snooping;
    const auto says_near = [](const RotaryTableSolution& solution) {
        return solution.variance_factor_reason.find("near 1 by construction") != std::string::npos;
    };
    EXPECT_TRUE(says_near(evaluate_jointly(measurement, EvaluationOptions{})));
    measurement.fixture(2, 1) += 50e-6;
    const RotaryTableSolution refuted = evaluate_jointly(measurement, EvaluationOptions{});
    EXPECT_GT(refuted.variance_factor, 1.5);
    EXPECT_FALSE(says_near(refuted));
}

// Whatever else is wrong, and what a reflector does that stands elsewhere by hundreds of nanometres to micrometres: angles are
// told to be off only where correcting them helps.
TEST(GroupTests, OnlyAnglesThatAreOffAreToldToBeOff) {
    for (const double off : {0.7e-6, 2e-6, 6e-6}) {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            RotaryTableMeasurement measurement = campaign(40 + seed).measurement;
            const auto reflector = static_cast<Eigen::Index>(seed);
            measurement.fixture(reflector, static_cast<Eigen::Index>(seed % 3)) += off;
            const GroupTests groups = tests_of(measurement);
            EXPECT_TRUE(std::ranges::none_of(
                groups.tests,
                [](const GroupTest& test) { return test.suspicious && test.kind == GroupKind::angle_index; }))
                << off << ", seed " << seed << "\n"
                << told(groups);
        }
    }
}

TEST(GroupTests, TellAStationWithOtherAngles) {
    RotaryTableMeasurement measurement = campaign(35).measurement;
    for (LengthObservation& length : measurement.lengths) {
        if (length.station == 4) {
            length.angle = (length.angle + 1) % measurement.angles.size();
        }
    }
    const GroupTests groups = tests_of(measurement);
    EXPECT_TRUE(groups.tests.front().suspicious) << told(groups);
    EXPECT_EQ(groups.tests.front().kind, GroupKind::angle_index) << told(groups);
    EXPECT_EQ(groups.tests.front().station, 4U) << told(groups);
}

/// Limits are kept by the one who asked first: a thread that found another's limit half made would print 0 for it.
TEST(GroupTests, AskForProbabilitiesFromOneThread) {
    const std::thread::id here = std::this_thread::get_id();
    std::atomic<int> asked = 0;
    std::atomic<int> asked_elsewhere = 0;
    EvaluationOptions options;
    options.chi_square_upper_tail = [&](double value, double degrees_of_freedom) {
        ++(std::this_thread::get_id() == here ? asked : asked_elsewhere);
        return upper_tail(value, degrees_of_freedom);
    };
    options.workers = [](std::size_t tasks, const std::function<void(std::size_t)>& task) {
        std::vector<std::thread> threads;
        for (std::size_t k = 0; k < tasks; ++k) {
            threads.emplace_back(task, k);
        }
        for (std::thread& thread : threads) {
            thread.join();
        }
    };
    const RotaryTableMeasurement measurement = campaign(35).measurement;
    const GroupTests by_threads = evaluate_jointly(measurement, options).groups.value();
    EXPECT_GT(asked, 0);
    EXPECT_EQ(asked_elsewhere, 0);
    EXPECT_EQ(told(by_threads), told(tests_of(measurement)));
}

}  // namespace
}  // namespace gumcert::engine
