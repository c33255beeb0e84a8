#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gumcert::signing {

/// "2026-03-31T12:00:00Z" (RFC 3339).
/// \param time  seconds since 1970-01-01 UTC
[[nodiscard]] std::string time_text(std::int64_t time);

/// "D:20260331120000Z" (ISO 32000-1, 7.9.4).
[[nodiscard]] std::string pdf_time_text(std::int64_t time);

/// Reads a time of XML ("2026-03-31T12:00:00.5+02:00") or PDF ("D:20260331120000+02'00'"); without a zone it is UTC.
/// \return seconds since 1970-01-01 UTC, none if it is no time of the years 1950 to 9999
[[nodiscard]] std::optional<std::int64_t> time_from_text(std::string_view text);

}  // namespace gumcert::signing
