#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jobs/job_kind.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"
#include "jobs/rotary_table/rotary_table_job.h"

namespace gumcert::jobs {

// The keys of a rotary_table job that ask for studies without or beside a measurement.

/// The key `simulation`.
/// \return nothing when it is absent
[[nodiscard]] std::optional<gum::SimulationRequest> read_simulation(const JsonObject& root, ProblemList& problems);

/// The key `plan`.
/// \return nothing when it is absent
[[nodiscard]] std::optional<gum::PlanRequest> read_plan(const JsonDocument& document, const JsonObject& root,
                                                        ProblemList& problems);

/// Refuses directions of reflectors that the fixture does not have, or has twice.
void check_facing(const gum::PlanRequest& plan, const std::vector<std::string>& reflectors, ProblemList& problems);

/// Warns of angles that differ by full turns: 0° and 360° each get a pose of their own.
/// \param angles_deg  ascending
void warn_of_same_positions(const std::vector<double>& angles_deg, const std::string& where, ProblemList& problems);

}  // namespace gumcert::jobs
