#pragma once

#include <vector>

#include "audit/rule.h"

namespace gumcert::audit {

/// W: worksheets, in the order of their ids.
[[nodiscard]] std::vector<Rule> worksheet_rules();

// Parts of them, one file each.

[[nodiscard]] std::vector<Rule> worksheet_divisor_rules();   ///< W01, W02
[[nodiscard]] std::vector<Rule> worksheet_reading_rules();   ///< W04, W06
[[nodiscard]] Rule worksheet_address_rule();                 ///< W05
[[nodiscard]] std::vector<Rule> worksheet_standard_rules();  ///< W07, W08
[[nodiscard]] Rule stored_value_rule();                      ///< W17

}  // namespace gumcert::audit
