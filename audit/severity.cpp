#include "audit/severity.h"

#include <algorithm>
#include <cmath>

namespace gumcert::audit {
namespace {

FindingSeverity severity_of_step(const BudgetOutcome& before, const BudgetOutcome& after) {
    const bool en_turns = before.en && after.en && (std::abs(*before.en) > 1.0) != (std::abs(*after.en) > 1.0);
    if (verdict_turns(before.verdict, after.verdict) || en_turns || after.U >= before.U * (1.0 + k_understated)) {
        return FindingSeverity::critical;
    }
    return before.rounded_U != after.rounded_U || before.printed_value != after.printed_value ? FindingSeverity::major
                                                                                              : FindingSeverity::minor;
}

}  // namespace

FindingSeverity severity_of(const Effect& effect) {
    return std::max(severity_of_step(effect.claimed, effect.alone), severity_of_step(effect.last, effect.audited));
}

std::string direction_in_words(const BudgetOutcome& claimed, const BudgetOutcome& corrected) {
    // Two texts may differ in digits and signs alone: 0.06, 0,06 and 0.060.
    constexpr double k_half = 0.5 * (1.0 + 1e-9);
    const bool is_same_text = claimed.printed_U == corrected.printed_U;
    const bool is_same = claimed.stated_step > 0.0 ? std::abs(claimed.U - corrected.U) <= k_half * claimed.stated_step
                                                   : claimed.rounded_U == corrected.rounded_U;
    if (is_same_text || (is_same && !corrected.is_held_against_statement)) {
        return "U unchanged";
    }
    return corrected.U > claimed.U ? "U understated" : "U overstated";
}

}  // namespace gumcert::audit
