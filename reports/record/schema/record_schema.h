#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace gumcert::reports {

// What a record may hold, for validators and people, from the descriptions that its writer and its reader walk
// (reports/record/record_fields.h). schemas/record-1.schema.json is written by the program write_schemas of the build; a
// test compares its bytes.

/// The JSON Schema (draft 7) of a record: a definition for each struct, in the order in which the descriptions meet them.
[[nodiscard]] nlohmann::ordered_json record_schema();

/// The same as schemas/record-1.schema.json has it.
[[nodiscard]] std::string record_schema_text();

/// Adds to a schema what the descriptions do not say of a value.
///
/// \param place     the value: the keys that lead to it from a definition, "*" for the elements of an array:
///                  "fit/data/u_x/*"; from the record itself, "/job/files"
/// \param addition  keywords; they take the place of those that stand there
/// \throws std::invalid_argument  if the schema has no such place, if it says the same already, or if a validator would
///                                not look at it: beside a reference only a description may stand
void add_to_schema(nlohmann::ordered_json& schema, std::string_view place, const nlohmann::ordered_json& addition);

}  // namespace gumcert::reports
