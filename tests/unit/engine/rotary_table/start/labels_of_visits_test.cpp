#include "engine/rotary_table/start/labels_of_visits.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "engine/rotary_table/start/place_search.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

std::optional<gum::Diagnostic> labels_of_visits_of_third(const RotaryTableMeasurement& measurement) {
    return labels_of_visits(measurement, 2, PlaceSearch(measurement).fit_of(2, true));
}

TEST(LabelsOfVisits, AreToldWithTheFirstAndTheLastOfThem) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    EXPECT_FALSE(labels_of_visits_of_third(measurement));
    for (LengthObservation& length : measurement.lengths) {
        if (length.station == 2 && length.approach == Approach::negative && length.angle < 5) {
            length.reflector = length.reflector == 1 ? 3 : length.reflector == 3 ? 1 : length.reflector;
        }
    }
    const std::optional<gum::Diagnostic> two = labels_of_visits_of_third(measurement);
    ASSERT_TRUE(two);
    EXPECT_EQ(two->code, "GC-ADJUST-0013");
    EXPECT_EQ(two->where, "lengths, station P3, pass P3/2, 120°");  // the table comes down
    EXPECT_EQ(two->what.find("at 5 of the 24 visits of the station, this one the first and pass P3/2, 0° the last, "),
              0U)
        << two->what;
    EXPECT_NE(two->what.find("the reflectors R2 and R4 are interchanged"), std::string::npos) << two->what;
    EXPECT_TRUE(two->action.ends_with(", at these visits")) << two->action;
}

TEST(LabelsOfVisits, ARingOfReflectorsAndAUnitAreTold) {
    const RotaryTableMeasurement sound = simulate(synthetic::small_plan()).measurement;
    RotaryTableMeasurement ring = sound;
    RotaryTableMeasurement halved = sound;
    for (std::size_t i = 0; i < sound.lengths.size(); ++i) {
        if (sound.lengths[i].station == 2 && sound.lengths[i].approach == Approach::negative) {
            const std::size_t m = sound.lengths[i].reflector;
            ring.lengths[i].reflector = m == 0 ? 1 : m == 1 ? 2 : m == 2 ? 0 : m;
            halved.lengths[i].length *= 0.5;
        }
    }
    const std::optional<gum::Diagnostic> three = labels_of_visits_of_third(ring);
    ASSERT_TRUE(three);
    EXPECT_NE(three->what.find("the reflectors R1, R2 and R3 are R3, R1 and R2"), std::string::npos) << three->what;
    const std::optional<gum::Diagnostic> factor = labels_of_visits_of_third(halved);
    ASSERT_TRUE(factor);
    EXPECT_NE(factor->what.find("at 12 of the 24 visits"), std::string::npos) << factor->what;
    EXPECT_NE(factor->what.find("multiplied by 2"), std::string::npos) << factor->what;
}

}  // namespace
}  // namespace gumcert::engine
