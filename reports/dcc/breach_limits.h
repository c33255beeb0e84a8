#pragma once

#include <cstddef>

namespace gumcert::reports {

inline constexpr std::size_t k_most_breaches = 1000;  ///< of one document; nobody reads more
inline constexpr std::size_t k_shown = 60;            ///< characters of a foreign text in a message

}  // namespace gumcert::reports
