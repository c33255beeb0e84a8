#pragma once

#include <string>
#include <vector>

#include "app/simulation_texts.h"
#include "reports/study_document.h"

namespace gumcert::app::simulation {

/// What the studies found, as it is shown to people and given to programs.
[[nodiscard]] reports::StudyDocument document_of(const engine::RotaryTableJob& job, const std::string& job_name,
                                                 const Basis& basis, const std::vector<AngleStudy>& studies);

}  // namespace gumcert::app::simulation
