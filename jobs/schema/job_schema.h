#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/job_fields.h"

namespace gumcert::jobs {

// What editors and people get of the descriptions of jobs. schemas/job-1.schema.json and docs/job_keys.md are written by the
// program write_schemas of the build; a test compares their bytes.

/// The JSON Schema (draft 7) of an object. It refers to the definitions `name`, `title`, `label`, `file_name` and
/// `file_object`, and to those of the objects in it that have one.
[[nodiscard]] nlohmann::ordered_json schema_of(const JobFields& fields);

/// A schema file with the definitions of all described objects in place of those that it has.
/// \param schema  a JSON object with `definitions`; each begins on a line of its own, indented by four spaces
/// \throws std::invalid_argument  if one of them is not there
[[nodiscard]] std::string with_described_definitions(const std::string& schema);

/// Tables of the keys of described objects and of all that stand in them, each under the name of its definition.
[[nodiscard]] std::string tables_of_keys(const std::vector<const JobFields*>& objects);

/// These objects and those in them that have a definition, each once.
[[nodiscard]] std::vector<const JobFields*> with_objects_in_them(const std::vector<const JobFields*>& objects);

/// docs/job_keys.md: a table for each described object.
[[nodiscard]] std::string page_of_job_keys();

}  // namespace gumcert::jobs
