#pragma once

#include <fmt/core.h>
#include <gumcert_build_info.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

namespace gumcert::cli {

/// Seconds since 1970-01-01 UTC: the time of a signature. Nothing that is evaluated depends on it.
[[nodiscard]] inline std::int64_t seconds_now() {
    const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::seconds>(since_1970).count();
}

/// Date and time by UTC, "2026-11-24T18:55:00Z".
/// \param seconds  since 1970-01-01 UTC
[[nodiscard]] inline std::string time_text(std::int64_t seconds) {
    const std::chrono::sys_seconds now{std::chrono::seconds(seconds)};
    const auto day = std::chrono::floor<std::chrono::days>(now);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss time(now - day);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), time.hours().count(),
                       time.minutes().count(), time.seconds().count());
}

/// Now. Nothing that is evaluated depends on it.
[[nodiscard]] inline std::string time_now() {
    return time_text(seconds_now());
}

/// The latest time that has come by this clock or by one that differs from it a little.
[[nodiscard]] inline std::string latest_time() {
    constexpr std::int64_t k_between_clocks = 300;  // [s], as tools/verify_archive.py has it
    return time_text(seconds_now() + k_between_clocks);
}

/// The day by UTC, "2026-11-22": whether a certificate is issued ahead of time. Nothing that is evaluated depends on
/// it. A clock that stands before the program was made is wrong: the day of its commit then.
[[nodiscard]] inline std::string today() {
    const std::chrono::year_month_day day{
        std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(std::chrono::seconds(seconds_now())))};
    const std::string by_clock = fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()),
                                             static_cast<unsigned>(day.month()), static_cast<unsigned>(day.day()));
    return std::max(by_clock, std::string(k_day_of_commit));
}

}  // namespace gumcert::cli
