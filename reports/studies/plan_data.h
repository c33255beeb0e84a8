#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gum/rotary_table/studies/plan_study.h"
#include "reports/studies/studied_job.h"

namespace gumcert::reports::plan {

/// Everything that a plan found, unrounded: canonical JSON, schema "gumcert/plan/1" (docs/planning.md).
[[nodiscard]] std::string data_json(const gum::plan::Setting& setting, const StudiedJob& job,
                                    const gum::plan::Expected& now, const gum::plan::SourceShares& shares,
                                    const std::vector<gum::plan::Variant>& variants,
                                    const std::optional<gum::plan::Proposal>& proposal);

}  // namespace gumcert::reports::plan
