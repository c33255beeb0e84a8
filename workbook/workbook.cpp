#include "workbook/workbook.h"

#include <algorithm>
#include <array>
#include <utility>

#include "workbook/letters.h"

namespace gumcert::workbook {

namespace {

constexpr std::array<std::pair<CellError, std::string_view>, 7> k_errors{{{CellError::null, "#NULL!"},
                                                                          {CellError::division_by_zero, "#DIV/0!"},
                                                                          {CellError::value, "#VALUE!"},
                                                                          {CellError::reference, "#REF!"},
                                                                          {CellError::name, "#NAME?"},
                                                                          {CellError::number, "#NUM!"},
                                                                          {CellError::not_available, "#N/A"}}};

}  // namespace

std::string column_letters(std::uint32_t column) {
    std::string letters;
    for (; column > 0; column = (column - 1) / 26) {
        letters += static_cast<char>('A' + (column - 1) % 26);
    }
    std::reverse(letters.begin(), letters.end());
    return letters;
}

std::string a1_text(const CellAddress& address) {
    return column_letters(address.column) + std::to_string(address.row);
}

std::string a1_text(const CellRange& range) {
    return range.first == range.last ? a1_text(range.first) : a1_text(range.first) + ":" + a1_text(range.last);
}

std::optional<CellAddress> read_a1(std::string_view text) {
    std::size_t at = !text.empty() && text.front() == '$' ? 1 : 0;
    const std::optional<std::uint32_t> column = read_column(text, at);
    if (!column) {
        return std::nullopt;
    }
    at += at < text.size() && text[at] == '$' ? 1U : 0U;
    const std::optional<std::uint32_t> row = read_row(text, at);
    if (!row || at != text.size()) {
        return std::nullopt;
    }
    return CellAddress{*row, *column};
}

std::string quoted_sheet(std::string_view name) {
    const bool plain =
        !name.empty() && !is_digit(name.front()) && !read_a1(name) &&
        std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
    if (plain) {
        return std::string(name);
    }
    std::string quoted = "'";
    for (const char c : name) {
        quoted.append(c == '\'' ? 2 : 1, c);
    }
    return quoted + "'";
}

std::string sheet_a1(std::string_view sheet, const CellAddress& address) {
    return quoted_sheet(sheet) + "!" + a1_text(address);
}

std::string_view error_text(CellError error) {
    const auto* const found =
        std::find_if(k_errors.begin(), k_errors.end(), [&](const auto& one) { return one.first == error; });
    return found == k_errors.end() ? "#OTHER!" : found->second;
}

std::optional<CellError> read_error(std::string_view text) {
    if (text.empty() || text.front() != '#') {
        return std::nullopt;
    }
    const auto* const found =
        std::find_if(k_errors.begin(), k_errors.end(), [&](const auto& one) { return one.second == text; });
    return found == k_errors.end() ? CellError::other : found->first;
}

const Cell* find_cell(const Sheet& sheet, const CellAddress& address) {
    const auto found = std::lower_bound(sheet.cells.begin(), sheet.cells.end(), address,
                                        [](const Cell& cell, const CellAddress& one) { return cell.address < one; });
    return found == sheet.cells.end() || found->address != address ? nullptr : &*found;
}

std::optional<std::size_t> find_sheet(const Workbook& workbook, std::string_view name) {
    const std::string folded = folded_text(name);
    const auto found = std::find_if(workbook.sheets.begin(), workbook.sheets.end(),
                                    [&](const Sheet& sheet) { return folded_text(sheet.name) == folded; });
    if (found == workbook.sheets.end()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - workbook.sheets.begin());
}

}  // namespace gumcert::workbook
