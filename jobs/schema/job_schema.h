#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "jobs/job_fields.h"

namespace gumcert::jobs {

// What editors and people get of the descriptions of jobs. schemas/job-1.schema.json and docs/job_keys.md are written by the
// program write_schemas of the build; a test compares their bytes.

/// An object that is described, and the definition of the schema that it is.
struct DescribedObject {
    std::string_view definition;  ///< in schemas/job-1.schema.json, a heading of docs/job_keys.md
    const JobFields& fields;
};
[[nodiscard]] std::span<const DescribedObject> described_objects();

/// The JSON Schema (draft 7) of an object. It refers to the definitions `name`, `title` and `file_name`.
[[nodiscard]] nlohmann::ordered_json schema_of(const JobFields& fields);

/// A schema file with the definitions of described_objects() in place of those that it has.
/// \param schema  a JSON object with `definitions`; each begins on a line of its own, indented by four spaces
/// \throws std::invalid_argument  if one of them is not there
[[nodiscard]] std::string with_described_definitions(const std::string& schema);

/// docs/job_keys.md: a table for each object of described_objects().
[[nodiscard]] std::string page_of_job_keys();

}  // namespace gumcert::jobs
