#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/record/record_problems.h"

namespace gumcert::reports {

/// The JSON value of a text, with what nlohmann-json lets pass refused: duplicate keys, deep nesting, NUL in a text.
/// \param problems  receives what is wrong; the value is worth nothing then
[[nodiscard]] nlohmann::json json_of_text(const std::string& text, RecordProblems& problems);

}  // namespace gumcert::reports
