#pragma once

#include <string>
#include <vector>

namespace gumcert::reports {

/// A QR code (ISO/IEC 18004) without the light margin around it.
struct QrCode {
    int size = 0;            ///< modules a side
    std::vector<bool> dark;  ///< size×size, row by row from the top
};

/// A text as the smallest QR code that holds it with error correction M, which stands 15 % of damage.
/// \throws gum::NoResultError  GC-REPORT-0044 for a text of more than 2000 bytes, or an empty one
[[nodiscard]] QrCode qr_code(const std::string& text);

/// The code as SVG with the margin of four modules that readers need.
/// \param x, y, side  place of the drawing in the units around it; with side 0 a picture of its own, one unit a module
[[nodiscard]] std::string svg_of(const QrCode& code, double x = 0.0, double y = 0.0, double side = 0.0);

}  // namespace gumcert::reports
