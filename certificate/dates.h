#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace gumcert::certificate {

// Dates of a certificate are texts "2026-11-21" (ISO 8601-1:2019, calendar date, extended format), so that no clock and
// no time zone can change them.

/// The day of a text; nothing where it is not a date of the Gregorian calendar from 1583 to 9999, or is "".
[[nodiscard]] std::optional<std::chrono::year_month_day> calendar_date(std::string_view text);

/// Whether the first day is after the second; false where one of them is not stated or is no date.
[[nodiscard]] bool is_after(std::string_view first, std::string_view second);

/// Whether a day lies between two others, both included; "" is no limit. False where the day itself is no date, or a
/// limit that is stated is none.
[[nodiscard]] bool is_within(std::string_view date, std::string_view from, std::string_view to);

/// Days from the first date to the second, negative where the second is earlier; nothing where one is no date.
[[nodiscard]] std::optional<long> days_between(std::string_view first, std::string_view second);

}  // namespace gumcert::certificate
