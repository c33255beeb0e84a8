#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gumcert::jobs {

// What editors and people get of the descriptions of the files of a laboratory. schemas/laboratory-1.schema.json and
// docs/laboratory_keys.md are written by the program write_schemas of the build; a test compares their bytes.

/// The JSON Schema (draft 7) of the files of a laboratory folder. What they have in common with certificate data is taken
/// from the schema of jobs, so that it stands in one place.
/// \param job_schema  schemas/job-1.schema.json
/// \throws std::invalid_argument  if a definition is not there
[[nodiscard]] nlohmann::ordered_json laboratory_schema(const nlohmann::ordered_json& job_schema);

/// docs/laboratory_keys.md: a table for each described object.
[[nodiscard]] std::string page_of_laboratory_keys();

}  // namespace gumcert::jobs
