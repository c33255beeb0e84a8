#pragma once

#include <concepts>
#include <cstdint>
#include <string>

#include "text/lists.h"

namespace gumcert::text {

/// count_of() of a size, or of the rows of a matrix: "1 row", "3 rows".
template <std::integral Count>
[[nodiscard]] std::string count_of(Count count, const std::string& noun) {
    return count_of(static_cast<std::int64_t>(count), noun);
}

}  // namespace gumcert::text
