#pragma once

#include <cstddef>

namespace gumcert::workbook {

/// What is read of a file that may come from anywhere. No budget that people look at comes near.
inline constexpr std::size_t k_largest_file = 20'000'000;       ///< bytes of an .xlsx or CSV file
inline constexpr std::size_t k_largest_unpacked = 200'000'000;  ///< bytes of all parts that are unpacked
inline constexpr std::size_t k_largest_texts = 200'000'000;  ///< bytes of texts and formulas of all cells, each counted
inline constexpr std::size_t k_most_parts = 10'000;          ///< of an .xlsx file
inline constexpr std::size_t k_most_sheets = 1'000;
inline constexpr std::size_t k_most_cells = 2'000'000;  ///< of all sheets
inline constexpr std::size_t k_most_names = 100'000;    ///< defined names
inline constexpr std::size_t k_most_formats = 100'000;
inline constexpr std::size_t k_longest_formula = 8'192;  ///< characters, as spreadsheets allow
inline constexpr std::size_t k_deepest_nesting = 64;     ///< of formulas and of XML
inline constexpr std::size_t k_longest_text = 32'767;    ///< characters that a formula can put together

}  // namespace gumcert::workbook
