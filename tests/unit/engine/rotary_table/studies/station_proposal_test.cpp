// Exchange of stations: what it proposes is the best exchange of every round, and is worth something.
#include "engine/rotary_table/studies/station_proposal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "engine/rotary_table/variance_components.h"
#include "tests/support/planned_layout.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using planned::layout_of;
using planned::narrow_cone;
using synthetic::CampaignPlan;

ExpectedUncertainty expected_of_layout(const RotaryTableMeasurement& measurement) {
    return expected_uncertainty(measurement, start_variances(measurement.table_repeatability), EvaluationOptions{});
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
    const RotaryTableMeasurement measurement = layout_of(CampaignPlan{});
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

TEST(StationProposal, StationsAmongTheReflectorsAreTold) {
    RotaryTableMeasurement measurement = layout_of(CampaignPlan{});
    EXPECT_TRUE(stations_among_reflectors(measurement, 0.2).empty());
    // Within 1 mm of where the second reflector comes by at the fourth angle, and a position in metres.
    measurement.station_start[1] =
        nominal_rotation(measurement, 3) * measurement.fixture.row(1).transpose() + Eigen::Vector3d(0.0, 0.001, 0.0);
    measurement.station_start[2] = *measurement.station_start[2] * 1e-3;
    const std::vector<StationAmongReflectors> near = stations_among_reflectors(measurement, 0.2);
    ASSERT_EQ(near.size(), 2U);
    EXPECT_EQ(near[0].station, 1U);
    EXPECT_EQ(near[0].reflector, 1U);
    EXPECT_EQ(near[0].angle, 3U);
    EXPECT_NEAR(near[0].distance, 0.001, 1e-12);
    EXPECT_EQ(near[1].station, 2U);
    EXPECT_TRUE(stations_among_reflectors(measurement, 0.0).empty());
}

TEST(StationProposal, ANarrowConeBecomesAboutAsGoodAsTheBestOfManyLayouts) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.stations = narrow_cone();
    const RotaryTableMeasurement measurement = layout_of(plan);
    const StochasticModel stochastic = start_variances(measurement.table_repeatability);
    const std::vector<Eigen::Vector3d> candidates = station_candidates(measurement, front_box()).positions;
    const StationProposal proposal = propose_stations(measurement, stochastic, candidates, {k_wanted}, threads(1));

    ASSERT_FALSE(proposal.exchanges.empty());
    double last = proposal.ratio_before;
    for (const StationExchange& exchange : proposal.exchanges) {
        EXPECT_LT(exchange.ratio, last);
        last = exchange.ratio;
    }
    EXPECT_EQ(last, proposal.ratio_after);
    plan.stations = proposal.positions;
    const RotaryTableMeasurement moved = layout_of(plan);
    EXPECT_NEAR(largest_ratio(expected_of_layout(moved).covariance.diagonal(), 12, k_wanted) / proposal.ratio_after,
                1.0, 1e-7)
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
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    plan.stations = narrow_cone();
    const RotaryTableMeasurement measurement = layout_of(plan);
    const StochasticModel stochastic = start_variances(measurement.table_repeatability);
    const std::vector<Eigen::Vector3d> candidates = station_candidates(measurement, front_box()).positions;
    const StationProposal one = propose_stations(measurement, stochastic, candidates, {k_wanted}, threads(1));
    const StationProposal three = propose_stations(measurement, stochastic, candidates, {k_wanted}, threads(3));
    EXPECT_EQ(one.ratio_after, three.ratio_after);
    ASSERT_EQ(one.exchanges.size(), three.exchanges.size());
    for (std::size_t e = 0; e < one.exchanges.size(); ++e) {
        EXPECT_EQ(one.exchanges[e].station, three.exchanges[e].station);
        EXPECT_EQ(one.exchanges[e].to, three.exchanges[e].to);
        EXPECT_EQ(one.exchanges[e].ratio, three.exchanges[e].ratio);
    }
}

TEST(StationProposal, NothingToChooseFromChangesNothing) {
    const RotaryTableMeasurement measurement = layout_of(CampaignPlan{});
    const StationProposal proposal =
        propose_stations(measurement, start_variances(measurement.table_repeatability), {}, {k_wanted}, threads(1));
    EXPECT_TRUE(proposal.exchanges.empty());
    EXPECT_EQ(proposal.ratio_before, proposal.ratio_after);
    EXPECT_EQ(proposal.positions[2], *measurement.station_start[2]);
}

/// A campaign with everything that a layout can have, other in every trial.
CampaignPlan any_plan(unsigned trial, synthetic::Noise& noise) {
    CampaignPlan plan;
    plan.axis = static_cast<RotaryAxis>(trial % 3);
    plan.datum = trial % 2 == 0 ? Datum::axis_average_line : Datum::home;
    plan.angles_deg = synthetic::full_turn(6 + static_cast<int>(trial % 5));
    plan.home = trial % 4;
    plan.both_senses = trial % 3 == 1;
    plan.dead_paths =
        trial % 4 == 3 ? synthetic::DeadPaths::per_station_and_reflector : synthetic::DeadPaths::per_station;
    plan.scale_model = trial % 2 == 0 ? ScaleModel::prior : ScaleModel::fixed;
    plan.u_scale = trial % 2 == 0 ? 1.5e-7 : 0.0;
    plan.table_linear = 0.3e-6 * noise.uniform();
    plan.table_axial = 2e-6 * noise.uniform();
    plan.table_tilt = 1e-6 * noise.uniform();
    for (Eigen::Vector3d& station : plan.stations) {
        for (int c = 0; c < 3; ++c) {
            station[c] += 0.4 * (noise.uniform() - 0.5);
        }
    }
    return plan;
}

TEST(StationProposal, NoVarianceIsBelowItsBound) {
    synthetic::Noise noise(11);
    for (unsigned trial = 0; trial < 24; ++trial) {
        const RotaryTableMeasurement measurement = layout_of(any_plan(trial, noise));
        const LayoutVariances layout(measurement, start_variances(measurement.table_repeatability));
        LayoutVariances::Information sum = layout.prior();
        LayoutVariances::Information part;
        Eigen::MatrixXd poses;
        Eigen::MatrixXd all = sum.poses;
        for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
            const auto observer = layout.observer(j);
            observer->pose_information(*measurement.station_start[j], poses);
            all += poses;
            observer->information(*measurement.station_start[j], part);
            EXPECT_LT((part.poses - poses).norm(), 1e-9 * part.poses.norm());
            add(sum, part);
        }
        const auto variances = layout.variances(sum);
        const auto least = layout.least_variances(all);
        ASSERT_TRUE(variances && least) << trial;
        double closest = 0.0;
        for (Eigen::Index i = 0; i < least->size(); ++i) {
            EXPECT_LE((*least)[i], (1.0 + 1e-9) * (*variances)[i]) << trial << ", " << i;
            closest = std::max(closest, (*least)[i] / std::max((*variances)[i], 1e-300));
        }
        EXPECT_GT(closest, 0.1) << "a bound that bounds nothing, trial " << trial;
    }
}

/// The best exchange of a round by trying all of them, without bounds.
StationExchange best_exchange(const RotaryTableMeasurement& measurement, const StochasticModel& stochastic,
                              const std::vector<Eigen::Vector3d>& candidates) {
    StationExchange best{0, {}, {}, std::numeric_limits<double>::infinity()};
    const auto angles = static_cast<Eigen::Index>(measurement.angles.size());
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        for (const Eigen::Vector3d& candidate : candidates) {
            RotaryTableMeasurement moved = measurement;
            bool free = true;
            for (const auto& other : measurement.station_start) {
                free = free && (*other - candidate).norm() >= 0.05;
            }
            moved.station_start[j] = candidate;
            predict_lengths(moved);
            const double ratio = free ? largest_ratio(LayoutVariances(moved, stochastic).variances(), angles, k_wanted)
                                      : std::numeric_limits<double>::infinity();
            if (ratio < (1.0 - 1e-10) * best.ratio) {
                best = {j, *measurement.station_start[j], candidate, ratio};
            }
        }
    }
    return best;
}

TEST(StationProposal, MakesTheBestExchangeOfEveryRound) {
    synthetic::Noise noise(3);
    for (const unsigned trial : {0U, 3U, 9U}) {  // about the x axis, that the box stands before
        RotaryTableMeasurement measurement = layout_of(any_plan(trial, noise));
        const StochasticModel stochastic = start_variances(measurement.table_repeatability);
        StationRegion region = front_box();
        region.step = 0.8;
        const std::vector<Eigen::Vector3d> candidates = station_candidates(measurement, region).positions;
        const StationProposal proposal = propose_stations(measurement, stochastic, candidates, {k_wanted}, threads(2));
        ASSERT_FALSE(proposal.exchanges.empty()) << trial;
        for (const StationExchange& made : proposal.exchanges) {
            const StationExchange best = best_exchange(measurement, stochastic, candidates);
            EXPECT_EQ(made.station, best.station) << trial;
            EXPECT_EQ(made.to, best.to) << trial;
            EXPECT_NEAR(made.ratio, best.ratio, 1e-8 * best.ratio) << trial;
            measurement.station_start[best.station] = best.to;
            predict_lengths(measurement);
        }
        EXPECT_GE(best_exchange(measurement, stochastic, candidates).ratio, 0.995 * proposal.ratio_after * (1 - 1e-8));
    }
}

TEST(StationProposal, KeepsTheTargetsThatAreMetWhereThatIsAsked) {
    // A wide layout but for one motion: wanted such that some motions are met and others missed.
    synthetic::Noise noise(8);
    unsigned broken = 0;
    for (unsigned trial = 0; trial < 12; ++trial) {
        CampaignPlan plan = any_plan(3 * trial, noise);
        plan.angles_deg = synthetic::full_turn(6);
        plan.home = 0;
        const RotaryTableMeasurement measurement = layout_of(plan);
        const StochasticModel stochastic = start_variances(measurement.table_repeatability);
        const auto angles = static_cast<Eigen::Index>(measurement.angles.size());
        const auto before = motion_ratios(*LayoutVariances(measurement, stochastic).variances(), angles, {1.0, 1.0});
        const auto middle = [&](std::size_t c) {
            std::array<double, 3> values{before[c], before[c + 1], before[c + 2]};
            std::sort(values.begin(), values.end());
            return 1.001 * values[1];
        };
        const std::array<double, 2> wanted{middle(0), middle(3)};
        StationRegion region = front_box();
        region.step = 0.8;
        const auto candidates = station_candidates(measurement, region).positions;
        const auto after = [&](bool keep_met) {
            ExchangeRules rules{wanted};
            rules.keep_met = keep_met;
            const StationProposal proposal = propose_stations(measurement, stochastic, candidates, rules, threads(1));
            RotaryTableMeasurement moved = measurement;
            for (std::size_t j = 0; j < moved.stations.size(); ++j) {
                moved.station_start[j] = proposal.positions[j];
            }
            predict_lengths(moved);
            return motion_ratios(*LayoutVariances(moved, stochastic).variances(), angles, {1.0, 1.0});
        };
        const auto kept = after(true);
        const auto free = after(false);
        for (std::size_t c = 0; c < 6; ++c) {
            const double limit = wanted[c < 3 ? 0 : 1];
            if (before[c] <= limit) {
                EXPECT_LE(kept[c], limit) << trial << ", " << c;
                broken += free[c] > limit ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(broken, 0U) << "nothing that had to be kept";
}

}  // namespace
}  // namespace gumcert::engine
