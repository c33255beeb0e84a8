#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gumcert::text {

// Angles in degrees, minutes and seconds. A number of seconds (or of minutes) and its parts are the same decimal number in two
// ways of writing: both directions move digits, and round nothing.

/// The last part of an angle, which has the decimals.
enum class AnglePart { minutes, seconds };

/// Whether a text has a sign of degrees, minutes or seconds, and is no plain number: ° º ' ’ ′ " ” ″.
[[nodiscard]] bool has_angle_sign(std::string_view text);

/// The decimal number of seconds, or of minutes, that an angle is: `12° 30' 05.0"` is "45005.0" seconds, `12° 30.5'` is
/// "750.5" minutes, `-0.5°` is "-30" minutes. Parts stand in their order, each of them once; only the last one has decimals,
/// and parts behind another one are below 60. Blanks may stand between them, the minus sign may be U+2212, and the decimal
/// sign a comma: an angle has no other use for one.
/// \return nothing where it is no such angle, or has seconds where minutes are the last part
[[nodiscard]] std::optional<std::string> decimal_of_angle(std::string_view text, AnglePart last);

/// The parts of a printed decimal number of seconds, or of minutes: "45005.0" is "12° 30′ 05.0″", with blanks that do not
/// break; "-3.2" is "-0° 00′ 03.2″". What is no decimal number of at most 17 digits before the point comes back as it is, as a
/// number with a power of ten does: its last digit stands above the seconds, and minutes and seconds would claim more.
[[nodiscard]] std::string angle_in_parts(std::string_view decimal, AnglePart last);

}  // namespace gumcert::text
