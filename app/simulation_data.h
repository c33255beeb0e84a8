#pragma once

#include <string>
#include <vector>

#include "app/simulation_texts.h"

namespace gumcert::app::simulation {

/// Everything that a study found, coherent SI: canonical JSON, schema "gumcert/simulation/1" (docs/simulation.md).
[[nodiscard]] std::string data_json(const std::string& job_name, const engine::RotaryTableJob& job, const Basis& basis,
                                    const std::vector<AngleStudy>& studies);

}  // namespace gumcert::app::simulation
