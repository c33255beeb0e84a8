// Tables that distances of few reflectors may mean as well: the best one is the result, or none is.
#include "engine/rotary_table/evaluation/rival_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/start/observed_stations.h"
#include "engine/rotary_table/start/open_places.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/variance_components.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/few_reflectors.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::ring_of_few;

Campaign measured(const CampaignPlan& plan) {
    Campaign campaign = simulate(plan);
    campaign.measurement.table_repeatability = {};
    campaign.measurement.table_repeatability.mode = RepeatabilityMode::estimate;
    return campaign;
}

enum class Answer { right, wrong, none };

Answer answer_of(const Campaign& campaign, const PlacedAdjustment& placed) {
    constexpr double k_wrong_place = 0.1;  // [m]
    const RigidMotion fixture_from_table = rigid_motion(campaign.truth.set_up).inverse();
    const std::vector<Eigen::Vector3d> found = placed.adjustment.present_values().stations;
    for (std::size_t j = 0; j < found.size(); ++j) {
        const Eigen::Vector3d in_fixture = placed.set_up.inverse() * found[j];
        if (!((in_fixture - fixture_from_table * campaign.truth.stations[j]).norm() < k_wrong_place)) {
            return Answer::wrong;
        }
    }
    return Answer::right;
}

struct Answers {
    std::size_t right = 0, wrong = 0, none = 0, wrong_before = 0;
};

/// From the places of a search without error motions, and by the adjustments of all tables that have nearly their distances.
/// \param stated     standard uncertainty of a length, in units of the one that it has
/// \param positions  of the stations are stated, to some centimetres
Answers answers_to(const std::function<CampaignPlan(std::uint64_t)>& plan, std::uint64_t campaigns, double stated = 1.0,
                   bool positions = false) {
    Answers answers;
    SolverOptions solver;
    solver.step_tolerance = 1e-3;
    for (std::uint64_t seed = 1; seed <= campaigns; ++seed) {
        Campaign campaign = measured(plan(seed));
        campaign.measurement.length_uncertainty.u_constant *= stated;
        campaign.measurement.length_uncertainty.u_proportional *= stated;
        for (std::size_t j = 0; j < campaign.truth.stations.size() && positions; ++j) {
            campaign.measurement.station_start[j] = campaign.truth.stations[j] + Eigen::Vector3d(0.03, -0.02, 0.01);
        }
        const std::vector<bool> all(campaign.measurement.lengths.size(), true);
        const StochasticModel stochastic = start_variances(campaign.measurement.table_repeatability);
        const PlaceSearch search(campaign.measurement);
        Answer answer = Answer::none;
        try {
            PlacedAdjustment placed = placed_adjustment(
                search.observed(), all, settled_places(search.observed(), search.fit_each()), stochastic, {});
            const NormalEquations normal = placed.adjustment.adjustment().linearise();
            placed.summary = placed.adjustment.adjustment().solve(solver);
            answers.wrong_before += answer_of(campaign, placed) == Answer::wrong ? 1U : 0U;
            settle_rival_tables(search.observed(), all, stochastic, solver,
                                static_cast<double>(normal.observation_count() - normal.parameter_count()), placed);
            answer = answer_of(campaign, placed);
        } catch (const gum::NoResultError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-RANK-0001") << seed << ": " << error.what();
        }
        (answer == Answer::right ? answers.right : answer == Answer::wrong ? answers.wrong : answers.none) += 1;
    }
    return answers;
}

// Of these a search without error motions has a quarter wrong: stations on false sides, and error motions of 100 µm that make up
// for it.
TEST(RivalTables, FewReflectorsOverPartOfATurnStandWhereTheyStoodOrNothingIsSaid) {
    constexpr std::uint64_t k_campaigns = 25;
    for (const std::pair<double, double>& of : {std::pair{120.0, 0.06}, {200.0, 0.005}}) {
        const Answers answers = answers_to(
            [&](std::uint64_t seed) {
                return ring_of_few(seed, 3, {0.02, 0.16}, of.first, of.second);
            },
            k_campaigns);
        EXPECT_EQ(answers.wrong, 0U) << of.first;
        EXPECT_GE(answers.wrong_before, 3U) << of.first << ": nothing is tested";
        EXPECT_GE(answers.right, k_campaigns * 9 / 10) << of.first;
    }
}

/// Three stations, three reflectors and a fixture that stands degrees off the axis: hardly more distances than unknowns.
CampaignPlan hardly_determined(std::uint64_t seed, const Eigen::Vector2d& height) {
    CampaignPlan plan = ring_of_few(seed, 3, height, 90.0, 0.02);
    synthetic::Noise draw(seed + 77);
    const double direction = 2.0 * std::numbers::pi * draw.uniform();
    constexpr double k_tilt = 0.042;  // [rad]
    plan.tilt = {k_tilt * std::cos(direction), k_tilt * std::sin(direction)};
    plan.stations.resize(std::min<std::size_t>(plan.stations.size(), 3));
    return plan;
}

// Few distances fit a false side within ten times their degrees of freedom: others are asked for whatever fits.
TEST(RivalTables, FewDistancesSayLittleByWhatTheyFit) {
    const Answers answers = answers_to([](std::uint64_t seed) { return hardly_determined(seed, {0.02, 0.16}); }, 28);
    EXPECT_EQ(answers.wrong, 0U);
    EXPECT_GE(answers.right, 25U);
}

// Nearly across the axis a valley leads from an axis that nobody has to tables some degrees aside: an adjustment begins at the one
// of its start values, and of two that fit alike the one with by far smaller error motions is the table.
TEST(RivalTables, AnAdjustmentDoesNotSlideAlongAValley) {
    const Answers answers = answers_to(
        [](std::uint64_t seed) {
            return hardly_determined(seed, {0.09, 0.1});
        },
        20, 1.0, true);
    EXPECT_EQ(answers.wrong, 0U);
    EXPECT_GE(answers.right, 15U);
}

// 0.1 mm out of a plane: the mirror image fits within micrometres, and only the adjustment tells that it does not fit.
TEST(RivalTables, NearlyInOnePlaneTheRightSideIsTakenOrNone) {
    constexpr std::uint64_t k_campaigns = 30;
    const Answers answers = answers_to(
        [](std::uint64_t seed) {
            return ring_of_few(seed, 4, {0.0498, 0.0502}, 315.0, 0.02);
        },
        k_campaigns);
    EXPECT_EQ(answers.wrong, 0U);
    EXPECT_GE(answers.wrong_before, 3U) << "nothing is tested";
    EXPECT_GE(answers.right, answers.wrong_before);
}

// Centimetres out of a plane the mirror image is worse by far, and stays so where each visit is far above the noise that is stated.
TEST(RivalTables, AreToldApartByTheNoiseThatIsLeft) {
    constexpr std::uint64_t k_campaigns = 20;
    // Of one the start values are refused.
    for (const auto& [stated, right] : {std::pair{1.0, 19U}, {0.01, 19U}, {0.001, 16U}}) {
        const Answers answers = answers_to(
            [](std::uint64_t seed) {
                return ring_of_few(seed, 4, {0.045, 0.06}, 315.0, 0.0005);
            },
            k_campaigns, stated);
        EXPECT_EQ(answers.wrong, 0U) << stated;
        EXPECT_GE(answers.right, right) << stated;
    }
}

// The evaluation asks for them: without, some of these have a result with a station on the false side.
TEST(RivalTables, AreAskedForByTheEvaluation) {
    std::size_t right = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        Campaign campaign = measured(ring_of_few(seed, 3, {0.02, 0.16}, 120.0, 0.06));
        campaign.measurement.outliers.test = OutlierTest::data_snooping;
        try {
            const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
            for (std::size_t j = 0; j < solution.stations.size(); ++j) {
                EXPECT_LT((solution.stations[j].position - campaign.truth.stations[j]).norm(), 0.1)
                    << seed << ", " << j;
            }
            ++right;
        } catch (const gum::NoResultError& error) {
            EXPECT_NE(error.diagnostics().front().code, "GC-ADJUST-0013") << seed;
        }
    }
    EXPECT_GE(right, 9U);
}

// Stated positions decide between a table and its mirror image only where they tell them apart.
TEST(RivalTables, StatedPositionsDecideBetweenTablesThatFitAlike) {
    const Campaign campaign = measured(ring_of_few(1, 4, {0.05, 0.05}, 315.0, 0.005));
    RotaryTableMeasurement measurement = campaign.measurement;
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        measurement.station_start[j] = campaign.truth.stations[j] + Eigen::Vector3d(0.03, -0.02, 0.01);
    }
    const RotaryTableSolution solution = evaluate_jointly(measurement, EvaluationOptions{});
    for (std::size_t j = 0; j < solution.stations.size(); ++j) {
        EXPECT_LT((solution.stations[j].position - campaign.truth.stations[j]).norm(), 0.1) << j;
    }
    try {
        (void)evaluate_jointly(campaign.measurement, EvaluationOptions{});
        FAIL() << "one of two sides was taken";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-RANK-0001");
    }
}

// Centimetres out of a plane the distances tell the sides apart: positions on the false side are refused, and right ones change
// nothing.
TEST(RivalTables, StatedPositionsNeverDecideAgainstTheDistances) {
    std::size_t refused = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const Campaign campaign = measured(ring_of_few(seed, 4, {0.045, 0.06}, 315.0, 0.0005));
        const double plane = campaign.measurement.fixture.col(axial_coordinate(campaign.measurement.axis)).mean();
        for (const bool mirrored : {false, true}) {
            SCOPED_TRACE(std::to_string(seed) + (mirrored ? ", mirrored" : ""));
            RotaryTableMeasurement measurement = campaign.measurement;
            for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
                Eigen::Vector3d position = campaign.truth.stations[j] + Eigen::Vector3d(0.03, -0.02, 0.01);
                if (mirrored) {
                    double& along = position[axial_coordinate(measurement.axis)];
                    along = 2.0 * plane - along;
                }
                measurement.station_start[j] = position;
            }
            try {
                const RotaryTableSolution solution = evaluate_jointly(measurement, EvaluationOptions{});
                for (std::size_t j = 0; j < solution.stations.size(); ++j) {
                    EXPECT_LT((solution.stations[j].position - campaign.truth.stations[j]).norm(), 0.1) << j;
                }
            } catch (const gum::NoResultError& error) {
                EXPECT_TRUE(mirrored) << error.diagnostics().front().code;
                refused += error.diagnostics().front().code == "GC-ADJUST-0016" ? 1U : 0U;
            }
        }
    }
    EXPECT_GE(refused, 2U);
}

// A fixture whose coordinates along the axis have the other sign has the distances of the mirror image of the table: error motions
// of no table were stated, with nothing but the stations against them.
TEST(RivalTables, AFixtureOfTheOtherSignAlongTheAxisIsRefusedByStatedPositions) {
    const Campaign campaign = measured(ring_of_few(3, 5, {0.02, 0.16}, 330.0, 0.0005));
    const int axial = axial_coordinate(campaign.measurement.axis);
    for (const bool is_mirrored : {false, true}) {
        for (const double along : {0.0, 0.4}) {
            RotaryTableMeasurement measurement = campaign.measurement;
            measurement.fixture.col(axial) *= is_mirrored ? -1.0 : 1.0;
            // 40 cm along the axis: in a frame with another origin. The mirror image is nearer all the same.
            for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
                Eigen::Vector3d position = campaign.truth.stations[j] + Eigen::Vector3d(0.03, -0.02, 0.01);
                position[axial] += along;
                measurement.station_start[j] = position;
            }
            const std::vector<gum::Diagnostic> problems =
                synthetic::problems_of([&] { (void)evaluate_jointly(measurement, EvaluationOptions{}); });
            ASSERT_EQ(problems.size(), is_mirrored ? 1U : 0U) << along;
            if (!problems.empty()) {
                EXPECT_EQ(problems[0].code, "GC-ADJUST-0018");
                EXPECT_NE(problems[0].what.find("where x has the other sign"), std::string::npos) << problems[0].what;
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::engine
