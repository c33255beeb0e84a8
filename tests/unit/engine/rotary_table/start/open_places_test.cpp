// Places that distances leave open: stated positions decide, and without them there is no result.
#include "engine/rotary_table/start/open_places.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/start_values.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::DeadPaths;

CampaignPlan coplanar_across(double tilt_factor) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.tilt *= tilt_factor;
    for (Eigen::Vector3d& reflector : plan.reflectors) {
        reflector[0] = 0.1;
    }
    return plan;
}

TEST(OpenPlaces, MirrorImageInAPlaneAcrossTheAxisIsRefusedWithBothPositions) {
    for (const double tilt_factor : {0.0, 1.0}) {
        try {
            (void)find_start_values(simulate(coplanar_across(tilt_factor)).measurement);
            FAIL() << "one of two sides was taken";
        } catch (const gum::NoResultError& error) {
            const gum::Diagnostic& diagnostic = error.diagnostics().front();
            EXPECT_EQ(diagnostic.code, "GC-RANK-0001");
            EXPECT_EQ(diagnostic.where, "station P1");
            EXPECT_NE(diagnostic.what.find("(700, 450, 100) mm"), std::string::npos) << diagnostic.what;
            EXPECT_NE(diagnostic.what.find("(-500, 450, 100) mm"), std::string::npos) << diagnostic.what;
            EXPECT_NE(diagnostic.what.find("P2, P3, P4, P5, P6"), std::string::npos) << diagnostic.what;
            EXPECT_NE(diagnostic.rule.find("mirror image"), std::string::npos) << diagnostic.rule;
            EXPECT_NE(diagnostic.action.find("stations file"), std::string::npos) << diagnostic.action;
            EXPECT_NE(diagnostic.action.find("raise alternate holders by 50 mm along x"), std::string::npos);
        }
    }
}

// Three reflectors lie in a plane, here 3° off the one across the axis. A fixture that stands upright and one that is inclined by
// 6° have the same distances: which of both was taken was chance.
TEST(OpenPlaces, ThreeReflectorsNearlyAcrossTheAxisAreRefusedUnlessPositionsAreStated) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        CampaignPlan plan = synthetic::small_plan(seed);
        plan.reflectors = {{0.05, 0.1, 0.0}, {0.05, -0.05, 0.087}, {0.058, -0.05, -0.087}};
        Campaign campaign = simulate(plan);
        const std::vector<gum::Diagnostic> problems =
            synthetic::problems_of([&] { (void)find_start_values(campaign.measurement); });
        ASSERT_EQ(problems.size(), 1U) << seed;
        EXPECT_EQ(problems.front().code, "GC-RANK-0001");
        EXPECT_NE(problems.front().rule.find("mirror image"), std::string::npos) << problems.front().rule;
        for (std::size_t j = 0; j < 6; ++j) {
            campaign.measurement.station_start[j] = campaign.truth.stations[j] + Eigen::Vector3d(0.08, -0.05, 0.05);
        }
        EXPECT_TRUE(synthetic::problems_of([&] { (void)find_start_values(campaign.measurement); }).empty()) << seed;
    }
}

TEST(OpenPlaces, StatedPositionsTellTheSide) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        for (const double tilt_factor : {0.0, 1.0}) {
            CampaignPlan plan = coplanar_across(tilt_factor);
            plan.seed = seed;
            Campaign campaign = simulate(plan);
            for (std::size_t j = 0; j < 6; ++j) {
                campaign.measurement.station_start[j] = campaign.truth.stations[j] + Eigen::Vector3d(0.08, -0.05, 0.05);
            }
            const StartValues start = find_start_values(campaign.measurement);
            for (std::size_t j = 0; j < 6; ++j) {
                EXPECT_LT((start.stations[j] - campaign.truth.stations[j]).norm(), 3e-3)
                    << "seed " << seed << ", " << j;
            }
        }
    }
}

TEST(OpenPlaces, OneStatedPositionGivesTheRightSideOfAllOrARefusal) {
    // A tilt of the fixture holds all stations on one side of the plane: never a mixture, never the wrong side.
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        CampaignPlan plan = coplanar_across(1.0);
        plan.seed = seed;
        Campaign campaign = simulate(plan);
        campaign.measurement.station_start[3] = campaign.truth.stations[3] + Eigen::Vector3d(0.08, -0.05, 0.05);
        try {
            const StartValues start = find_start_values(campaign.measurement);
            for (std::size_t j = 0; j < 6; ++j) {
                EXPECT_LT((start.stations[j] - campaign.truth.stations[j]).norm(), 3e-3)
                    << "seed " << seed << ", " << j;
            }
        } catch (const gum::NoResultError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-RANK-0001");
            EXPECT_EQ(error.diagnostics().front().what.find("P4"), std::string::npos) << error.what();
        }
    }
}

TEST(OpenPlaces, StationOnTheAxisWithADeadPathOfEachReflectorIsRefused) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.dead_paths = DeadPaths::per_station_and_reflector;
    plan.offset.setZero();
    plan.tilt.setZero();
    plan.error_factor = 0.0;
    plan.noise = 0.0;
    plan.stations[2] = {1.0, 0.0, 0.0};
    try {
        (void)find_start_values(simulate(plan).measurement);
        FAIL() << "a position that nothing determines";
    } catch (const gum::NoResultError& error) {
        const gum::Diagnostic& diagnostic = error.diagnostics().front();
        EXPECT_EQ(diagnostic.code, "GC-RANK-0001");
        EXPECT_EQ(diagnostic.where, "station P3");
        EXPECT_NE(diagnostic.what.find("0.0 mm off the rotary axis"), std::string::npos) << diagnostic.what;
        EXPECT_NE(diagnostic.what.find("dead path P3-R6"), std::string::npos) << diagnostic.what;
        EXPECT_NE(diagnostic.action.find("move the station off the rotary axis"), std::string::npos);
    }
}

/// Eight stations and three reflectors with a dead path of each, on a fixture that stands millimetres off the axis: a station on
/// its own takes the set-up for its place.
CampaignPlan few_reflectors(std::uint64_t seed) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    plan.dead_paths = DeadPaths::per_station_and_reflector;
    plan.stations = {{0.87, -1.21, 0.09}, {0.92, 0.33, -0.35}, {0.34, 1.43, -0.44}, {1.11, -0.42, 0.13},
                     {1.17, -0.25, 0.72}, {0.95, 0.50, -0.83}, {1.31, -1.03, 0.46}, {0.49, 1.48, -0.30}};
    plan.reflectors = {{0.03, 0.06, 0.0}, {0.09, 0.062, 0.07}, {0.15, 0.061, -0.08}};
    plan.offset = {4.5e-3, -2.0e-3};
    plan.seed = seed;
    return plan;
}

TEST(OpenPlaces, WhatSeemsOpenAtAFalsePlaceIsLookedForWithinReach) {
    int open = 0;  // as each station is found on its own
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const Campaign campaign = simulate(few_reflectors(seed));
        const PlaceSearch search(campaign.measurement);
        CommonFit together = fit_together(search.observed(), search.fit_each());
        open += synthetic::problems_of([&] { settle_open_places(search.observed(), together); }).empty() ? 0 : 1;
        const CommonFit found = settled_places(search.observed(), search.fit_each());
        for (std::size_t j = 0; j < 8; ++j) {
            // Error motions are noise of a search, and move a place that is hardly determined by centimetres.
            EXPECT_LT((found.stations[j].position - campaign.truth.stations[j]).norm(), 0.1) << seed << ", " << j;
        }
    }
    EXPECT_GE(open, 1);
}

// Five angles close together do not tell the sides of the stations: a refusal, and never the false side.
TEST(OpenPlaces, NoFalseSideIsTakenWithinReach) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        CampaignPlan plan = few_reflectors(seed);
        plan.angles_deg = {0.0, 257.0, 269.0, 310.0, 358.0};
        plan.stations = {{0.97, 0.74, 0.51},   {0.26, 1.45, 0.47}, {0.38, 1.04, -0.56}, {1.04, -0.60, -0.39},
                         {0.35, -1.36, -0.50}, {1.17, 0.71, 0.22}, {0.48, -0.52, 0.71}, {1.40, -1.30, 0.32}};
        plan.reflectors = {{0.056, 0.12, 0.0}, {0.077, -0.06, 0.104}, {0.056, -0.06, -0.104}};
        plan.offset = {4.5e-3, -6.6e-3};
        const Campaign campaign = simulate(plan);
        const PlaceSearch search(campaign.measurement);
        try {
            const CommonFit found = settled_places(search.observed(), search.fit_each());
            for (std::size_t j = 0; j < 8; ++j) {
                EXPECT_LT((found.stations[j].position - campaign.truth.stations[j]).norm(), 0.3) << seed << ", " << j;
            }
        } catch (const gum::NoResultError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-RANK-0001");
        }
    }
}

// Positions are stated to some centimetres: they decide nothing between places that are nearer to each other.
TEST(OpenPlaces, StatedPositionsDecideBetweenPlacesADecimetreApart) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    std::vector<Eigen::Vector3d> here(6, Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> there = here;
    there[2][0] = 0.3;
    EXPECT_FALSE(nearer_to_stated(measurement, here, there)) << "none is stated";
    measurement.station_start[2] = Eigen::Vector3d(0.29, 0.0, 0.0);
    ASSERT_TRUE(nearer_to_stated(measurement, here, there));
    EXPECT_NEAR(*nearer_to_stated(measurement, here, there), 0.28, 1e-12);
    EXPECT_NEAR(*nearer_to_stated(measurement, there, here), -0.28, 1e-12);
    there[2][0] = 0.09;
    EXPECT_FALSE(nearer_to_stated(measurement, here, there));
}

TEST(OpenPlaces, RefusalOfEitherTableNamesTheStationsThatStandElsewhere) {
    const RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    const std::vector<Eigen::Vector3d> here(6, Eigen::Vector3d(0.5, 0.0, 0.0));
    std::vector<Eigen::Vector3d> there = here;
    there[1][0] = -0.3;
    there[4][1] = 0.2;
    for (const RivalTable rival :
         {RivalTable::same_distances, RivalTable::nearly_mirrored, RivalTable::with_other_places}) {
        const std::vector<gum::Diagnostic> problems =
            synthetic::problems_of([&] { refuse_either(measurement, here, there, rival); });
        ASSERT_EQ(problems.size(), 1U);
        EXPECT_EQ(problems[0].code, "GC-RANK-0001");
        EXPECT_EQ(problems[0].where, "station P2");
        EXPECT_EQ(problems[0].what,
                  "its distances fit a position near (500, 0, 0) mm and one near (-300, 0, 0) mm alike; the same holds "
                  "for P5");
        EXPECT_EQ(problems[0].rule.find("mirror image") != std::string::npos, rival != RivalTable::with_other_places);
    }
}

TEST(OpenPlaces, AUsualLayoutHasNone) {
    const Campaign campaign = simulate(synthetic::small_plan());
    const PlaceSearch search(campaign.measurement);
    CommonFit found = fit_together(search.observed(), search.fit_each());
    const CommonFit before = found;
    settle_open_places(search.observed(), found);
    EXPECT_EQ(found.set_up, before.set_up);
    for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_EQ(found.stations[j].position, before.stations[j].position) << j;
    }
}

TEST(OpenPlaces, OtherStationsAreNamedBehindTheFirst) {
    RotaryTableMeasurement measurement;
    measurement.stations = {"P1", "P2", "P3", "P4"};
    EXPECT_EQ(others_alike(measurement, {2}), "");
    EXPECT_EQ(others_alike(measurement, {0, 1, 3}), "; the same holds for P2, P4");
}

}  // namespace
}  // namespace gumcert::engine
