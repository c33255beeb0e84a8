#include "engine/rotary_table/start/millimetres_text.h"

#include <cmath>

#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

std::string millimetres(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);  // not 0.1, which is no double: 0.35 mm is 0.4
    value = std::round(value / gum::k_millimetre * scale) / scale;
    value = value == 0.0 ? 0.0 : value;  // no minus sign on a zero
    return text::fixed(value, decimals);
}

std::string in_millimetres(const Eigen::Vector3d& position) {
    return "(" + millimetres(position[0], 0) + ", " + millimetres(position[1], 0) + ", " + millimetres(position[2], 0) +
           ") mm";
}

}  // namespace gumcert::engine
