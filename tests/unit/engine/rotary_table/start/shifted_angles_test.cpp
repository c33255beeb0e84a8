#include "engine/rotary_table/start/shifted_angles.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

/// Angles of one station that are so much larger than those of the others.
RotaryTableMeasurement shifted_by(double degrees) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    const std::size_t angles = measurement.angles.size();
    for (std::size_t a = 0; a < angles; ++a) {
        measurement.angles.push_back(measurement.angles[a] + degrees * std::numbers::pi / 180.0);
        measurement.angles_deg.push_back(measurement.angles_deg[a] + degrees);
    }
    for (LengthObservation& length : measurement.lengths) {
        length.angle += length.station == 3 ? angles : 0;
    }
    return measurement;
}

TEST(ShiftedAngles, OfAStationAreToldWithTheirOffset) {
    EXPECT_NO_THROW(refuse_shifted_angles(simulate(synthetic::small_plan()).measurement));
    for (const auto& [degrees, told] : {std::pair{0.25, "0.25° lower"}, std::pair{-7.0, "7° higher"}}) {
        const std::vector<gum::Diagnostic> problems =
            synthetic::problems_of([&, by = degrees] { refuse_shifted_angles(shifted_by(by)); });
        ASSERT_EQ(problems.size(), 1U);
        EXPECT_EQ(problems[0].code, "GC-ADJUST-0013");
        EXPECT_EQ(problems[0].where, "lengths, station P4");
        EXPECT_NE(problems[0].what.find(told), std::string::npos) << problems[0].what;
    }
}

TEST(ShiftedAngles, AnglesOfItsOwnWithoutAPatternAreNone) {
    RotaryTableMeasurement measurement = shifted_by(0.25);
    for (std::size_t a = 12; a < 24; ++a) {
        measurement.angles[a] += 0.01 * static_cast<double>((a * a) % 7);
    }
    EXPECT_NO_THROW(refuse_shifted_angles(measurement));
}

}  // namespace
}  // namespace gumcert::engine
