#include "engine/rotary_table/start/wrong_labels.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/rotary_table/start/label_hypothesis.h"
#include "engine/rotary_table/start/place_search.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

std::vector<gum::Diagnostic> labels_that_are_asked_for(const RotaryTableMeasurement& measurement) {
    return synthetic::problems_of(
        [&] { WrongLabels(measurement, PlaceSearch(measurement).fit_each()).refuse_suspicious(); });
}

TEST(WrongLabels, OfTheWholeFileAreToldOnceAndOfStationsEach) {
    const RotaryTableMeasurement sound = simulate(synthetic::small_plan()).measurement;
    EXPECT_TRUE(labels_that_are_asked_for(sound).empty());
    EXPECT_NO_THROW(WrongLabels(sound, PlaceSearch(sound).fit_each()).refuse_all());
    const std::vector<gum::Diagnostic> all = labels_that_are_asked_for(relabelled(sound, 0, {.lengths = 2.0}));
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].where, "lengths");
    EXPECT_NE(all[0].what.find("multiplied by 0.5"), std::string::npos) << all[0].what;
    const std::vector<gum::Diagnostic> two = labels_that_are_asked_for(
        relabelled(relabelled(sound, 1, {.first = 0, .second = 5}), 4, {.first = 2, .second = 3}));
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].where, "lengths, station P2");
    EXPECT_NE(two[0].what.find("R1 and R6"), std::string::npos) << two[0].what;
    EXPECT_EQ(two[1].where, "lengths, station P5");
    EXPECT_NE(two[1].what.find("R3 and R4"), std::string::npos) << two[1].what;
}

TEST(WrongLabels, ACoordinateThatAllStationsDisagreeWithComesFirst) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    measurement.fixture(2, 1) += 0.3;
    const std::vector<gum::Diagnostic> problems = labels_that_are_asked_for(measurement);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].where, "fixture, reflector R3");
}

// Of one station: no label of the list has it.
TEST(WrongLabels, AFactorOfOneStationIsLookedFor) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    for (LengthObservation& length : measurement.lengths) {
        length.length *= length.station == 1 ? 1.05 : 1.0;
    }
    const std::vector<gum::Diagnostic> problems = labels_that_are_asked_for(measurement);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].where, "lengths, station P2");
    EXPECT_NE(problems[0].what.find("multiplied by about 0.95"), std::string::npos) << problems[0].what;
}

}  // namespace
}  // namespace gumcert::engine
