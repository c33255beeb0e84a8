#include "engine/rotary_table/start/selected_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(SelectedLengths, AreThoseOfAStationOfAPassAndOfOtherReflectors) {
    const RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    const std::size_t pass = measurement.lengths.back().pass;
    const std::vector<bool> station = lengths_of_station(measurement, 5);
    const std::vector<bool> part = lengths_of_station(measurement, 5, pass);
    const std::vector<bool> others = lengths_without_reflector(measurement, 2);
    ASSERT_EQ(station.size(), measurement.lengths.size());
    for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
        const LengthObservation& length = measurement.lengths[i];
        EXPECT_EQ(station[i], length.station == 5);
        EXPECT_EQ(part[i], length.station == 5 && length.pass == pass);
        EXPECT_EQ(others[i], length.reflector != 2);
    }
    EXPECT_EQ(std::ranges::count(part, true) * 2, std::ranges::count(station, true));
}

TEST(SelectedLengths, SomeVisitsAreWholeAndSpreadOverAll) {
    synthetic::CampaignPlan plan = synthetic::small_plan();
    const RotaryTableMeasurement small = simulate(plan).measurement;
    EXPECT_EQ(lengths_of_some_visits(small, lengths_of_station(small, 1)), lengths_of_station(small, 1));  // 24 visits
    plan.angles_deg = synthetic::full_turn(36);
    const RotaryTableMeasurement large = simulate(plan).measurement;
    const std::vector<bool> some = lengths_of_some_visits(large, lengths_of_station(large, 1));
    std::set<std::size_t> passes;
    std::set<std::size_t> angles;
    for (std::size_t i = 0; i < some.size(); ++i) {
        if (some[i]) {
            EXPECT_EQ(large.lengths[i].station, 1U);
            passes.insert(large.lengths[i].pass);
            angles.insert(large.lengths[i].angle);
        }
    }
    EXPECT_EQ(std::ranges::count(some, true), 24 * 6);
    EXPECT_EQ(passes.size(), 2U);
    EXPECT_GT(*angles.rbegin() - *angles.begin(), 30U);
}

}  // namespace
}  // namespace gumcert::engine
