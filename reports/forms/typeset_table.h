#pragma once

#include <nlohmann/json_fwd.hpp>

namespace gumcert::reports {

/// The view with what the PDF template would else have to find out about each cell, which takes it longer than setting
/// them (docs/templates.md):
/// - `form` of a cell: "digits", a number in one piece; "number", another one; "letter", a letter that is a symbol, in the first
///   column; "short", words of 12 characters at most, which stay in one line; "long", with a word of 30 characters or more;
///   "words", any other
/// - `line` of a row: "one" where it is one line of the height of a number at any width, else ""
/// - `longest` of a column: the two longest of its texts; where it is one of numbers, of those of digits alone, and of others
/// - `digits` of a table: characters of the longest number of each column, together
[[nodiscard]] nlohmann::json with_typeset_tables(nlohmann::json view);

}  // namespace gumcert::reports
