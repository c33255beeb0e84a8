#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gumcert::reports {

/// A unit in the notation of D-SI 2 as UDUNITS-2 writes it: "\micro\metre" → "um", "\metre\per\second" → "m s-1",
/// "\one" → "1". The other direction is gum::unit_in_d_si().
/// \return nothing for a unit that this program does not know, among them all that begin with "|" (not in D-SI)
[[nodiscard]] std::optional<std::string> unit_from_d_si(std::string_view text);

}  // namespace gumcert::reports
