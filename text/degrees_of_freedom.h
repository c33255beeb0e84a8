#pragma once

#include <string>

namespace gumcert::text {

/// "1 degree of freedom", "2.5 degrees of freedom".
/// \param printed  their number
[[nodiscard]] std::string degrees_of_freedom(const std::string& printed);

}  // namespace gumcert::text
