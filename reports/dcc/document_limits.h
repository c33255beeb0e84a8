#pragma once

#include <cstddef>

namespace gumcert::reports {

// Digital certificates of others that are read. `gumcert limits` prints these.

inline constexpr std::size_t k_largest_document = std::size_t{64} << 20U;  ///< [byte]
inline constexpr std::size_t k_largest_depth = 64;                         ///< elements within each other
inline constexpr std::size_t k_most_elements = 1'000'000;
inline constexpr std::size_t k_most_attributes = 64;  ///< of a tag
inline constexpr std::size_t k_most_numbers = 100'000;

}  // namespace gumcert::reports
