#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plan_study.h"

namespace gumcert::app::plan {

/// Everything that a plan found, unrounded: canonical JSON, schema "gumcert/plan/1" (docs/planning.md).
[[nodiscard]] std::string data_json(const Setting& setting, const std::string& job_name, const Expected& now,
                                    const SourceShares& shares, const std::vector<Variant>& variants,
                                    const std::optional<Proposal>& proposal);

}  // namespace gumcert::app::plan
