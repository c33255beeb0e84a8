#pragma once

#include "audit/finding.h"

namespace gumcert::audit {

/// U is understated when the corrected one is larger by this part of the claimed one.
inline constexpr double k_understated = 0.10;

/// The severity of a finding whose correction is known: critical where a verdict or |E_n| > 1 turns, or U is understated
/// by 10 % or more; major where a printed digit changes; minor below. Alone and as the last correction: the graver one
/// counts.
[[nodiscard]] FindingSeverity severity_of(const Effect& effect);

/// "U understated", "U overstated", or "U unchanged" as printed: at the last digit of a U that somebody stated.
[[nodiscard]] std::string direction_in_words(const BudgetOutcome& claimed, const BudgetOutcome& corrected);

}  // namespace gumcert::audit
