#pragma once

#include <cstddef>

// Eigen divides large matrix products into blocks that fit into the caches of the processor, which it asks for their sizes. The
// order of a sum, and with it the last bits of a product, would be another one on another processor (ADR 0085). Before the
// program begins, Eigen is told these sizes in place of those of the machine; whoever links gum/quantity gets them.

namespace gumcert::gum {

inline constexpr std::ptrdiff_t k_first_level_cache = std::ptrdiff_t{48} << 10U;  ///< [byte]
inline constexpr std::ptrdiff_t k_second_level_cache = std::ptrdiff_t{2} << 20U;  ///< [byte]
inline constexpr std::ptrdiff_t k_third_level_cache = std::ptrdiff_t{32} << 20U;  ///< [byte]

}  // namespace gumcert::gum
