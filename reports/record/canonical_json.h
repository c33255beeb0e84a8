#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gumcert::reports {

inline constexpr std::size_t k_max_json_depth = 64;                         ///< levels of nesting of a record
inline constexpr std::size_t k_max_record_bytes = 128UL * 1024UL * 1024UL;  ///< size of a record as text

/// A key as a token of a JSON pointer (RFC 6901, section 3): "~" as "~0", "/" as "~1".
[[nodiscard]] std::string pointer_token(std::string_view key);

}  // namespace gumcert::reports
