#pragma once

#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "workbook/workbook.h"

namespace gumcert::test {

/// What a cell of a test holds: a number, a truth value, a text, an error, or behind an equals sign a formula.
inline workbook::Cell cell_of(const std::string& address, const std::string& content) {
    using namespace workbook;
    Cell cell;
    cell.address = *read_a1(address);
    if (content.starts_with("=")) {
        cell.formula = content.substr(1);
        cell.formula_kind = FormulaKind::plain;
    } else if (content == "TRUE" || content == "FALSE") {
        cell.value = {.kind = CellKind::boolean, .number = content == "TRUE" ? 1.0 : 0.0};
    } else if (const auto error = read_error(content)) {
        cell.value = {.kind = CellKind::error, .error = *error};
    } else {
        double number = 0.0;
        const char* const end = content.data() + content.size();
        const auto read = std::from_chars(content.data(), end, number);
        const bool is_number = read.ec == std::errc() && read.ptr == end;
        cell.value = {.kind = is_number ? CellKind::number : CellKind::text, .number = number, .text = content};
    }
    return cell;
}

using Contents = std::vector<std::pair<std::string, std::string>>;

/// A sheet of cells, given as address and content, row by row.
inline workbook::Sheet sheet_of(const std::string& name, const Contents& contents) {
    workbook::Sheet sheet;
    sheet.name = name;
    for (const auto& [address, content] : contents) {
        sheet.cells.push_back(cell_of(address, content));
    }
    return sheet;
}

inline workbook::Workbook workbook_of(const Contents& contents) {
    workbook::Workbook made;
    made.sheets.push_back(sheet_of("Sheet1", contents));
    return made;
}

}  // namespace gumcert::test
