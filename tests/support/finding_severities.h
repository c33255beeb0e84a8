#pragma once

#include "certificate/certified_results.h"

namespace gumcert::certificate {

inline constexpr FindingSeverity k_critical = FindingSeverity::critical;
inline constexpr FindingSeverity k_major = FindingSeverity::major;
inline constexpr FindingSeverity k_minor = FindingSeverity::minor;

}  // namespace gumcert::certificate
