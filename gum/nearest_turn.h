#pragma once

namespace gumcert::gum {

/// An angle with the number of full turns that brings it nearest to another one, both in rad: 179° and −179° lie 2° apart.
[[nodiscard]] double nearest_turn(double angle, double to);

}  // namespace gumcert::gum
