#pragma once

#include <Eigen/Core>
#include <string>

namespace gumcert::engine {

/// A length in millimetres for messages of this layer and of the evaluation, rounded, without its unit and without a minus sign on a zero.
/// \param value  [m]
[[nodiscard]] std::string millimetres(double value, int decimals);

/// A position to the millimetre, with its unit: "(1183, 754, -1056) mm".
/// \param position  [m]
[[nodiscard]] std::string in_millimetres(const Eigen::Vector3d& position);

}  // namespace gumcert::engine
