#pragma once

#include <string>

namespace gumcert::text {

/// A text as one field of a CSV file (RFC 4180, 2.5 to 2.7): quoted where it holds a separator, a quote or a line end,
/// and begun with an apostrophe where a spreadsheet would take it for a formula, whatever separator it was set up for.
[[nodiscard]] std::string csv_field(const std::string& text);
/// The same, and quoted whatever it holds.
[[nodiscard]] std::string quoted_csv_field(const std::string& text);

}  // namespace gumcert::text
