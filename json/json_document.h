#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "json/strict_parser.h"

namespace gumcert::json {

/// A JSON document and the places of its values.
struct JsonDocument {
    std::string file;
    nlohmann::json value;
    Places places;

    /// `job.json#/fixture/coordinates (line 12, column 5)`, of a table `points.csv:12:5`; without a place when the pointer
    /// has none.
    [[nodiscard]] std::string where(const std::string& pointer) const;

    std::string text;  ///< as it was read
    /// Its values come from a table: a message names the cell, and not the pointer, which no reader of the table knows.
    bool is_table = false;

    /// A number as the text has it, "0.50"; "" where the pointer has no place, or none stands there.
    [[nodiscard]] std::string number_as_written(const std::string& pointer) const;

    /// The most decimals of a number, or of those of an array, as the text has them (text::most_decimals): [1.0, 2.50]
    /// has 2. 0 where something else stands there.
    [[nodiscard]] int decimals_as_written(const std::string& pointer) const;
};

/// A JSON value in a few words for a message: `"axis_line"`, `-2.5`, `an object`.
[[nodiscard]] std::string described(const nlohmann::json& value);

}  // namespace gumcert::json
