#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "jobs/json_object.h"
#include "jobs/laboratory/laboratory_statement.h"
#include "laboratory/standard_record.h"

namespace gumcert::jobs {

/// laboratory.json as it was read.
struct LaboratoryFile {
    nlohmann::json laboratory, accreditation;  ///< objects of certificate data, checked; null: not stated
    std::vector<SignatoryStatement> signatories;
};

/// Reads a file of standards/, checked completely: docs/laboratory_keys.md says the keys.
/// \return nothing when anything was refused, which is in the list then
[[nodiscard]] std::optional<laboratory::StandardRecord> read_standard(const JsonDocument& document,
                                                                      ProblemList& problems);

/// Reads laboratory.json.
/// \return nothing when anything was refused
[[nodiscard]] std::optional<LaboratoryFile> read_laboratory(const JsonDocument& document, ProblemList& problems);

}  // namespace gumcert::jobs
