#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

std::array<std::string, 6> error_motion_names(RotaryAxis axis) {
    const char letter = static_cast<char>('A' + axial_coordinate(axis));
    std::array<std::string, 6> names{"EX", "EY", "EZ", "EA", "EB", "EC"};
    for (std::string& name : names) {
        name += letter;
    }
    return names;
}

}  // namespace gumcert::engine
