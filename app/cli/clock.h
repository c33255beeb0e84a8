#pragma once

#include <chrono>
#include <cstdint>

namespace gumcert::cli {

/// Seconds since 1970-01-01 UTC: the time of a signature. Nothing that is evaluated depends on it.
[[nodiscard]] inline std::int64_t seconds_now() {
    const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::seconds>(since_1970).count();
}

}  // namespace gumcert::cli
