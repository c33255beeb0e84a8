#pragma once

#include <optional>
#include <string_view>

#include "audit/words/named_statement.h"

namespace gumcert::audit {

/// What a name in words says of an uncertainty: "standard uncertainty of the result", "Overall uncertainty", "Messunsicherheit U".
/// Nothing where it may be that of anything else, "uncertainty of calibration", or is one of the two only with its coverage, and
/// that says nothing.
/// \param coverage     what follows it, "(k = 2)"
/// \param is_relative  set where the name says so
[[nodiscard]] std::optional<Statement> uncertainty_in_words(std::string_view name, std::string_view coverage,
                                                            bool& is_relative);

}  // namespace gumcert::audit
