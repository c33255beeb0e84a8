#include "engine/rotary_table/rotary_table_measurement.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace gumcert::engine {
namespace {

// ISO 230-7: the second letter is the direction of the motion, the third one the axis that turns.
TEST(RotaryTableMeasurement, ErrorMotionsHaveTheNamesOfTheStandard) {
    EXPECT_EQ(error_motion_names(RotaryAxis::a),
              (std::array<std::string, 6>{"EXA", "EYA", "EZA", "EAA", "EBA", "ECA"}));
    EXPECT_EQ(error_motion_names(RotaryAxis::b),
              (std::array<std::string, 6>{"EXB", "EYB", "EZB", "EAB", "EBB", "ECB"}));
    EXPECT_EQ(error_motion_names(RotaryAxis::c),
              (std::array<std::string, 6>{"EXC", "EYC", "EZC", "EAC", "EBC", "ECC"}));
}

TEST(RotaryTableMeasurement, AxesTurnAboutTheirCoordinate) {
    EXPECT_EQ(axial_coordinate(RotaryAxis::a), 0);
    EXPECT_EQ(axial_coordinate(RotaryAxis::b), 1);
    EXPECT_EQ(axial_coordinate(RotaryAxis::c), 2);
}

}  // namespace
}  // namespace gumcert::engine
