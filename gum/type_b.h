#pragma once

namespace gumcert::gum {

/// Standard uncertainty of a quantity known only to lie within ±a of its estimate, all values equally probable.
///
/// u = a / √3                                                                            (JCGM 100:2008, 4.3.7)
/// \param half_width  a ≥ 0, e.g. the maximum permissible error of an instrument found to conform
/// \return u, in the unit of a; 0 only for a = 0, which stands for a constant
/// \throws InputError  GC-GUM-0001 or -0002
/// Example: examples/api/observations.cpp
[[nodiscard]] double u_from_half_width(double half_width);

/// Standard uncertainty due to the resolution of a displaying device.
///
/// u = δ / √12                                                                           (JCGM 100:2008, F.2.2.1)
/// \param step  δ ≥ 0, the full step of the indication (not half of it)
/// \return u, in the unit of δ
/// \throws InputError  GC-GUM-0001 or -0002
[[nodiscard]] double u_from_resolution(double step);

}  // namespace gumcert::gum
