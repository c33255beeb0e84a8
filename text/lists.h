#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::text {

/// "a, b and 3 more"; all of them where they are not more than `most`.
[[nodiscard]] std::string listed(const std::vector<std::string>& names,
                                 std::size_t most = std::numeric_limits<std::size_t>::max());
/// "a, b and c".
[[nodiscard]] std::string all_of(const std::vector<std::string>& names);
/// "a, b or c".
[[nodiscard]] std::string any_of(std::span<const std::string_view> words);
/// "1 distance", "2 distances", "2 entries".
[[nodiscard]] std::string count_of(std::int64_t count, const std::string& noun);

}  // namespace gumcert::text
