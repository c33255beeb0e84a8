#pragma once

#include <string>
#include <vector>

#include "reports/forms/study_document.h"
#include "reports/studies/simulation_texts.h"
#include "reports/studies/studied_job.h"

namespace gumcert::reports::simulation {

/// What the studies found, as it is shown to people and given to programs.
[[nodiscard]] reports::StudyDocument document_of(const StudiedJob& job, const gum::simulation::Basis& basis,
                                                 const std::vector<gum::AngleStudy>& studies);

}  // namespace gumcert::reports::simulation
