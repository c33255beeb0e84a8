#pragma once

#include <string>

namespace gumcert::engine {

/// A length in millimetres for messages of this layer, rounded, without its unit and without a minus sign on a zero.
/// \param value  [m]
[[nodiscard]] std::string millimetres(double value, int decimals);

}  // namespace gumcert::engine
