#pragma once

#include <span>
#include <string>

#include "audit/rules/registry.h"

namespace gumcert::audit {

/// docs/audit_rules.md: all rules, a table a family, and those that are left out with their reasons.
[[nodiscard]] std::string rules_page(std::span<const Rule> rules, std::span<const RuleLeftOut> left_out);

}  // namespace gumcert::audit
