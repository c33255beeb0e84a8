#pragma once

#include <numbers>

namespace gumcert::gum {

// Factors to coherent SI, for use at a border only (files, documents). Inside, lengths are metres, angles radians,
// temperatures differences in kelvin.
inline constexpr double k_micrometre = 1e-6;                                ///< [m]
inline constexpr double k_millimetre = 1e-3;                                ///< [m]
inline constexpr double k_degree = std::numbers::pi / 180.0;                ///< [rad]
inline constexpr double k_arcsecond = std::numbers::pi / (180.0 * 3600.0);  ///< [rad]

}  // namespace gumcert::gum
