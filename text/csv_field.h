#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gumcert::text {

/// A text as one field of a CSV file (RFC 4180, 2.5 to 2.7): quoted where it holds a separator, a quote or a line end,
/// and begun with an apostrophe where a spreadsheet would take it for a formula, whatever separator it was set up for.
[[nodiscard]] std::string csv_field(const std::string& text);
/// The same, and quoted whatever it holds.
[[nodiscard]] std::string quoted_csv_field(const std::string& text);

/// A first line "sep=;" that is no row, but states the separator, as spreadsheets write and read it.
struct SeparatorLine {
    char separator = ',';    ///< a comma, a semicolon, a tab or a bar
    std::size_t length = 0;  ///< bytes of the line, without its end
};
/// \param text  without byte order mark
[[nodiscard]] std::optional<SeparatorLine> separator_line(std::string_view text);

}  // namespace gumcert::text
