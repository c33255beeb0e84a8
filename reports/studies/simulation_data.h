#pragma once

#include <string>
#include <vector>

#include "reports/studies/simulation_texts.h"
#include "reports/studies/studied_job.h"

namespace gumcert::reports::simulation {

/// Everything that a study found, coherent SI: canonical JSON, schema "gumcert/simulation/1" (docs/simulation.md).
[[nodiscard]] std::string data_json(const StudiedJob& job, const gum::simulation::Basis& basis,
                                    const std::vector<gum::AngleStudy>& studies);

}  // namespace gumcert::reports::simulation
