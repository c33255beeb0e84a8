#include "engine/rotary_table/start/two_places.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/rotary_table/start/place_search.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(TwoPlaces, OfThePassesOfAStationAreToldWithTheirDistance) {
    // The second pass of P2 was measured from where P3 stands.
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    std::erase_if(measurement.lengths, [](const LengthObservation& length) {
        return (length.station == 1 && length.approach == Approach::negative) ||
               (length.station == 2 && length.approach == Approach::positive);
    });
    for (LengthObservation& length : measurement.lengths) {
        length.station = length.station == 2 ? 1 : length.station;
    }
    const StationFit whole = PlaceSearch(measurement).fit_of(1, true);
    ASSERT_GT(whole.misfit, 1e-3);
    const std::vector<gum::Diagnostic> problems =
        synthetic::problems_of([&] { refuse_two_places(measurement, 1, whole.upright_misfit()); });
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].code, "GC-ADJUST-0013");
    EXPECT_EQ(problems[0].where, "lengths, station P2");
    // (0.20, 0.50, 0.95) m apart.
    EXPECT_NE(problems[0].what.find("1092 mm apart: P2/1 and P3/2"), std::string::npos) << problems[0].what;
}

TEST(TwoPlaces, AnInterruptedBeamBetweenThePassesIsNone) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    for (LengthObservation& length : measurement.lengths) {
        length.length += length.station == 1 && length.approach == Approach::negative ? 0.1 : 0.0;
    }
    const StationFit whole = PlaceSearch(measurement).fit_of(1, true);
    EXPECT_NO_THROW(refuse_two_places(measurement, 1, whole.upright_misfit()));
}

}  // namespace
}  // namespace gumcert::engine
