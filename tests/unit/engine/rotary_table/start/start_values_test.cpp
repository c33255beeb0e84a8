// Start values without an operator: whatever the dead paths, the turn, the set-up and the outliers, the joint
// adjustment converges from them to the truth.
#include "engine/rotary_table/start/start_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/start/gross_errors.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::DeadPaths;
using synthetic::k_arcsec;

/// The beam of a station is broken before an angle: from there on another dead path.
void relock(Campaign& campaign, std::size_t station, std::size_t from) {
    RotaryTableMeasurement& measurement = campaign.measurement;
    const std::size_t path = measurement.dead_paths.size();
    measurement.dead_paths.push_back("P" + std::to_string(station + 1) + "/" + std::to_string(path));
    const double shift = 0.0031 * static_cast<double>(path);
    for (LengthObservation& length : measurement.lengths) {
        if (length.station == station && length.angle >= from) {
            length.dead_path = path;
            length.length -= shift;
        }
    }
}

void relock_every(Campaign& campaign, std::size_t angles) {
    for (std::size_t j = 0; j < campaign.measurement.stations.size(); ++j) {
        for (std::size_t k = 3 + j; k < campaign.measurement.angles.size(); k += angles) {
            relock(campaign, j, k);
        }
    }
}

struct Scenario {
    std::string name;
    std::function<void(CampaignPlan&)> plan;
    std::function<void(Campaign&)> change = [](Campaign&) {};
};

void PrintTo(const Scenario& scenario, std::ostream* stream) {
    *stream << scenario.name;
}

void coarse_set_up(CampaignPlan& plan) {
    plan.offset = {5e-3, -4e-3};
    plan.tilt = {3600.0 * k_arcsec, -2900.0 * k_arcsec};
}

const std::vector<Scenario> k_scenarios{
    {"Standard", [](CampaignPlan&) {}},
    {"DeadPathOfEachReflector", [](CampaignPlan& plan) { plan.dead_paths = DeadPaths::per_station_and_reflector; }},
    {"DeadPathOfEachReflectorQuarterTurn",
     [](CampaignPlan& plan) {
         plan.dead_paths = DeadPaths::per_station_and_reflector;
         plan.angles_deg = synthetic::partial_turn(90.0, 10);
     }},
    {"QuarterTurn", [](CampaignPlan& plan) { plan.angles_deg = synthetic::partial_turn(90.0, 10); }},
    {"Relocked", [](CampaignPlan&) {},
     [](Campaign& campaign) {
         relock(campaign, 2, 17);
         relock(campaign, 4, 30);
         relock(campaign, 4, 35);
     }},
    {"RelockedOften", [](CampaignPlan&) {}, [](Campaign& campaign) { relock_every(campaign, 5); }},
    {"RelockedAtEveryAngle", [](CampaignPlan& plan) { plan.angles_deg = synthetic::full_turn(12); },
     [](Campaign& campaign) { relock_every(campaign, 1); }},
    {"CoplanarAlongTheAxis",
     [](CampaignPlan& plan) {
         for (Eigen::Vector3d& reflector : plan.reflectors) {
             reflector[1] = 0.1;
         }
     }},
    {"CoplanarObliqueQuarterTurn",
     [](CampaignPlan& plan) {
         plan.angles_deg = synthetic::partial_turn(90.0, 10);
         for (Eigen::Vector3d& reflector : plan.reflectors) {
             reflector[0] = 0.1 + 0.5 * reflector[1];
         }
     }},
    {"CoarseSetUp", coarse_set_up},
    {"CoarseSetUpDeadPathOfEachReflector",
     [](CampaignPlan& plan) {
         coarse_set_up(plan);
         plan.dead_paths = DeadPaths::per_station_and_reflector;
     }},
    {"CoarseSetUpQuarterTurn",
     [](CampaignPlan& plan) {
         coarse_set_up(plan);
         plan.angles_deg = synthetic::partial_turn(90.0, 10);
     }},
    {"OneInTwentyOffByDecimetres",
     [](CampaignPlan& plan) {
         plan.outliers = 64;
         plan.outlier_size = 0.3;
     }},
    {"OutliersCoarseSetUpRelocked",
     [](CampaignPlan& plan) {
         coarse_set_up(plan);
         plan.outliers = 64;
         plan.outlier_size = 0.1;
     },
     [](Campaign& campaign) { relock_every(campaign, 9); }},
    {"OutliersDeadPathOfEachReflector",
     [](CampaignPlan& plan) {
         plan.dead_paths = DeadPaths::per_station_and_reflector;
         plan.outliers = 64;
         plan.outlier_size = 0.3;
     }},
    {"LargeErrorMotions", [](CampaignPlan& plan) { plan.error_factor = 20.0; }},
    {"FarStationsDeadPathOfEachReflector",
     [](CampaignPlan& plan) {
         plan.dead_paths = DeadPaths::per_station_and_reflector;
         for (Eigen::Vector3d& station : plan.stations) {
             station *= 2.5;
         }
     }},
    {"StatedPositionsThatAreWrong", [](CampaignPlan&) {},
     [](Campaign& campaign) {
         for (auto& stated : campaign.measurement.station_start) {
             stated = Eigen::Vector3d(-1.0, 0.3, 2.0);
         }
     }},
};

class StartValuesWithoutOperator : public testing::TestWithParam<std::tuple<Scenario, RotaryAxis>> {};

TEST_P(StartValuesWithoutOperator, LeadTheJointAdjustmentToTheTruth) {
    const Scenario& scenario = std::get<0>(GetParam());
    CampaignPlan plan;
    plan.axis = std::get<1>(GetParam());
    scenario.plan(plan);
    Campaign campaign = simulate(plan);
    scenario.change(campaign);
    RotaryTableMeasurement& measurement = campaign.measurement;
    if (plan.outliers > 0) {
        measurement.outliers.test = OutlierTest::data_snooping;
        measurement.outliers.action = OutlierAction::remove;
    }
    std::vector<bool> active(measurement.lengths.size(), true);
    std::vector<std::size_t> gross = find_gross_errors(measurement);
    for (const std::size_t i : gross) {
        active[i] = false;
    }
    std::sort(gross.begin(), gross.end());
    EXPECT_EQ(gross, campaign.truth.outliers);

    // The start values belong to the fixture frame at home; what is left is error motions, here to 12 µrad at 1 m.
    const StartValues start = find_start_values(measurement, active);
    for (std::size_t j = 0; j < start.stations.size(); ++j) {
        const Eigen::Vector3d in_table = synthetic::moved(campaign.truth.set_up, start.stations[j]);
        EXPECT_LT((in_table - campaign.truth.stations[j]).norm(), plan.error_factor > 1.0 ? 5e-3 : 2e-3)
            << measurement.stations[j];
    }
    const RotaryTableSolution solution = evaluate_jointly(measurement, EvaluationOptions{});
    const Eigen::VectorXd normalised =
        (solution.values - campaign.true_values(false)).array() / solution.covariance.diagonal().array().sqrt();
    EXPECT_LT(std::sqrt(normalised.squaredNorm() / static_cast<double>(normalised.size())), 1.8);
    EXPECT_NEAR(solution.chi_square / static_cast<double>(solution.degrees_of_freedom), 1.0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(ScenariosAndAxes, StartValuesWithoutOperator,
                         testing::Combine(testing::ValuesIn(k_scenarios),
                                          testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c)),
                         [](const auto& tested) {
                             return std::get<0>(tested.param).name +
                                    std::string(1, "ABC"[axial_coordinate(std::get<1>(tested.param))]);
                         });

TEST(StartValues, SameInputSameBytes) {
    CampaignPlan plan;
    plan.dead_paths = DeadPaths::per_station_and_reflector;
    plan.angles_deg = synthetic::full_turn(12);
    const Campaign campaign = simulate(plan);
    const StartValues first = find_start_values(campaign.measurement);
    const StartValues second = find_start_values(campaign.measurement);
    EXPECT_EQ(first.stations, second.stations);
    EXPECT_EQ(first.dead_paths, second.dead_paths);
}

// Three reflectors on dead paths of their own: from the usual start a descent ends where the distances fit badly, and where
// they fit a station that looks at an overturned fixture, or wrong labels, nearly as well.
TEST(StartValues, SoundCampaignsOfWeakLayoutsAreNotAccused) {
    struct Layout {
        std::vector<Eigen::Vector3d> stations;
        std::vector<double> angles_deg;
        bool both_senses;
    };
    const std::vector<Layout> layouts{
        {{{0.651, 0.422, -0.759}, {0.416, -0.605, -0.296}, {1.236, -1.246, -0.440}, {0.295, 1.384, 0.601}},
         {0, 4, 130, 164, 172, 298, 340, 342},
         true},
        {{{0.202, 0.353, -0.025},
          {1.229, -0.254, 0.232},
          {1.367, -0.016, 0.699},
          {1.113, 0.826, 0.775},
          {0.896, -1.276, -0.021}},
         synthetic::full_turn(8),
         true},
        {{{0.649, 0.355, 0.755}, {1.330, 0.704, 0.331}, {1.156, -1.471, 0.444}, {1.264, 1.128, -0.540}},
         synthetic::full_turn(6),
         false},
        {{{1.441, 0.244, -0.236}, {0.938, 0.326, -0.404}, {0.509, 0.576, 0.307}}, synthetic::full_turn(24), true},
    };
    for (const Layout& layout : layouts) {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            CampaignPlan plan;
            plan.stations = layout.stations;
            // Where a descent ends is a matter of millimetres.
            synthetic::Noise draw(seed);
            for (Eigen::Vector3d& station : plan.stations) {
                for (double& coordinate : station) {
                    coordinate += 0.016 * (draw.uniform() - 0.5);
                }
            }
            plan.reflectors = {{0.033, 0.136, 0.005}, {0.085, 0.028, 0.072}, {0.152, -0.099, 0.117}};
            plan.angles_deg = layout.angles_deg;
            plan.both_senses = layout.both_senses;
            plan.dead_paths = DeadPaths::per_station_and_reflector;
            plan.cmm_factor = 20.0;
            plan.table_linear = 1.6e-6;
            plan.seed = seed;
            const Campaign campaign = simulate(plan);
            std::vector<std::size_t> gross;
            ASSERT_NO_THROW(gross = find_gross_errors(campaign.measurement))
                << plan.stations[0].transpose() << ", " << seed;
            EXPECT_TRUE(gross.empty());
            const StartValues start = find_start_values(campaign.measurement);
            for (std::size_t j = 0; j < start.stations.size(); ++j) {
                EXPECT_LT((start.stations[j] - campaign.truth.stations[j]).norm(), 0.3)
                    << campaign.measurement.stations[j] << ", " << plan.stations[0].transpose() << ", " << seed;
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::engine
