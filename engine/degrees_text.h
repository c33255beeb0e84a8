#pragma once

#include <string>

namespace gumcert::engine {

/// An angle in degrees for messages: "22.5°".
[[nodiscard]] std::string degrees_text(double degrees);

}  // namespace gumcert::engine
