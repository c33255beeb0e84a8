#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gumcert::reports {

/// A unit in the notation of D-SI 2 as jobs write it: "\micro\metre" → "um", "\metre\per\second" → "m s-1",
/// "\volt\hertz\tothe{-0.5}" → "V Hz^(-1/2)", "\one" → "1". The other direction is gum::unit_in_d_si().
/// Everything behind \per is in the denominator, as the D-SI parser of the PTB (dsiUnits) reads it:
/// "\joule\per\kilogram \kelvin" → "J kg-1 K-1".
/// Behind "|" (not in D-SI) stands a unit by its name here, with "_" for blanks: "|psi" → "psi", "|ft_lbf" → "ft lbf".
/// \return nothing for a unit that this program does not know, among them those with more than one \per, those whose symbol
///     would be another unit ("\femto\tonne" is not "ft"), and names behind "|" of units that D-SI has ("|F")
[[nodiscard]] std::optional<std::string> unit_from_d_si(std::string_view text);

/// Whether a text is a unit in the notation of D-SI, known to this program or not: prefixes, units, powers and at most
/// one \per; or one that begins with "|", which means that D-SI does not have it.
[[nodiscard]] bool is_d_si(std::string_view text);

}  // namespace gumcert::reports
