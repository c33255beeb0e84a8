#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plan_study.h"
#include "reports/study_document.h"

namespace gumcert::app::plan {

/// What a plan found, as it is shown to people and given to programs.
[[nodiscard]] reports::StudyDocument document_of(Setting setting, const std::string& job_name, const Expected& now,
                                                 const SourceShares& shares, const std::vector<Variant>& variants,
                                                 const std::optional<Proposal>& proposal);

}  // namespace gumcert::app::plan
