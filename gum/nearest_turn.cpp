#include "gum/nearest_turn.h"

#include <cmath>
#include <numbers>

namespace gumcert::gum {

double nearest_turn(double angle, double to) {
    constexpr double k_turn = 2.0 * std::numbers::pi;
    return angle - k_turn * std::round((angle - to) / k_turn);
}

}  // namespace gumcert::gum
