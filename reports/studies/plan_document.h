#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gum/rotary_table/studies/plan_study.h"
#include "reports/forms/study_document.h"
#include "reports/studies/studied_job.h"

namespace gumcert::reports::plan {

/// What a plan found, as it is shown to people and given to programs.
[[nodiscard]] reports::StudyDocument document_of(const StudiedJob& job, gum::plan::Setting setting,
                                                 const gum::plan::Expected& now, const gum::plan::SourceShares& shares,
                                                 const std::vector<gum::plan::Variant>& variants,
                                                 const std::optional<gum::plan::Proposal>& proposal);

}  // namespace gumcert::reports::plan
