#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "workbook/workbook.h"

namespace gumcert::workbook {

// Letters and digits of ASCII, whatever the locale.
constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
constexpr char capital(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
constexpr bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// With capitals of ASCII for its small letters: what spreadsheets compare names and texts by.
inline std::string folded_text(std::string_view text) {
    std::string folded(text);
    std::transform(folded.begin(), folded.end(), folded.begin(), capital);
    return folded;
}

/// The column that the letters from `at` name; `at` is behind them. Nothing: no letters, or no column of a sheet.
inline std::optional<std::uint32_t> read_column(std::string_view text, std::size_t& at) {
    std::uint32_t column = 0;
    const std::size_t begin = at;
    for (; at < text.size() && is_letter(text[at]); ++at) {
        if (at - begin >= 3) {
            return std::nullopt;
        }
        column = column * 26 + static_cast<std::uint32_t>(capital(text[at]) - 'A') + 1;
    }
    return column >= 1 && column <= k_most_columns ? std::optional(column) : std::nullopt;
}

/// The same of the digits of a row, which do not begin with 0.
inline std::optional<std::uint32_t> read_row(std::string_view text, std::size_t& at) {
    std::uint32_t row = 0;
    const std::size_t begin = at;
    for (; at < text.size() && is_digit(text[at]); ++at) {
        if (at - begin >= 7 || text[begin] == '0') {
            return std::nullopt;
        }
        row = row * 10 + static_cast<std::uint32_t>(text[at] - '0');
    }
    return row >= 1 && row <= k_most_rows ? std::optional(row) : std::nullopt;
}

}  // namespace gumcert::workbook
