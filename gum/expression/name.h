#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gumcert::gum {

enum class CharacterClass : std::uint8_t {
    name_start,      ///< letters, and _
    name_part,       ///< digits, subscript digits and ': inside a name only
    combining_mark,  ///< accents as characters of their own
    control,         ///< control characters, marks of text direction, characters without width
    other,
};
[[nodiscard]] CharacterClass character_class(char32_t code);

/// The same name in the form in which names are compared: the micro sign is μ, the ohm sign Ω, the kelvin sign K and
/// the ångström sign Å, as Unicode normalisation makes them.
[[nodiscard]] std::string canonical_name(std::string_view name);

/// The name with every letter replaced by the ASCII letter that looks the same: names with equal skeletons cannot be
/// told apart on paper.
[[nodiscard]] std::string look_alike_skeleton(std::string_view name);

/// Why text cannot be the name of a quantity: a phrase ("contains a space") for messages, or nothing when it can.
[[nodiscard]] std::optional<std::string> reason_against_name(std::string_view name);

/// "U+202E", for characters that cannot be shown.
[[nodiscard]] std::string code_point_text(char32_t code);

/// The candidate that differs least from a name, if it differs little enough to be a slip.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace gumcert::gum
