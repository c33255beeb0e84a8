#include "engine/rotary_table/start/shifted_angles.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/rotary_table/start/place_search.h"
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

/// What is said where the second pass of P2 has the angle that `stated` makes of each, by its number in the turn of twelve.
std::vector<gum::Diagnostic> problems_of_second_pass(const std::function<std::size_t(std::size_t)>& stated) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    for (LengthObservation& length : measurement.lengths) {
        if (length.station == 1 && length.approach == Approach::negative) {
            length.angle = stated(length.angle);
        }
    }
    const double misfit = PlaceSearch(measurement).fit_of(1, true).upright_misfit();
    return synthetic::problems_of([&] { refuse_angles_of_pass(measurement, 1, misfit); });
}

// They were told as a station that stood in two places, or as distances that fit no rigid table.
TEST(ShiftedAngles, OfAPassAreToldWithTheOtherPass) {
    EXPECT_TRUE(problems_of_second_pass([](std::size_t k) { return k; }).empty());
    const auto told = [](const std::function<std::size_t(std::size_t)>& stated) {
        const std::vector<gum::Diagnostic> problems = problems_of_second_pass(stated);
        if (problems.size() != 1U) {
            return std::to_string(problems.size()) + " problems";
        }
        return problems[0].code + ", " + problems[0].where + ": " + problems[0].what;
    };
    const std::string pass =
        "GC-ADJUST-0013, lengths, station P2, pass P2/2: its distances agree with those of pass P2/1 when ";
    EXPECT_EQ(told([](std::size_t k) { return (k + 1) % 12; }), pass + "its angles are 30° lower");
    EXPECT_EQ(told([](std::size_t k) { return (k + 10) % 12; }), pass + "its angles are 60° higher");
    EXPECT_EQ(told([](std::size_t k) { return 11 - k; }), pass + "its angles are stated in the reverse order");
}

}  // namespace
}  // namespace gumcert::engine
