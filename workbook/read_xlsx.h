#pragma once

#include <string>
#include <string_view>

#include "workbook/workbook.h"

namespace gumcert::workbook {

/// Reads an .xlsx file (ECMA-376, both the transitional and the strict form), or an .xlsm file, whose macros are left
/// alone and named in WorkbookMetadata::not_examined. Formulas that the file shares between cells stand at each cell, moved
/// as spreadsheets move them. Dates are numbers with their format. Nothing is computed.
///
/// The file may come from anywhere. Limits (workbook/limits.h): file 20 MB, unpacked 200 MB, texts of all cells together
/// 200 MB, 2 million cells, 1000 sheets, 100000 names, formulas 8192 characters, XML 64 levels. Time and memory are linear in
/// what is unpacked. The size that a file states of itself is not believed. No other file is opened.
/// \param bytes  of the file
/// \param file   its name, for messages
/// \throws gum::InputError  GC-WORKBOOK-0001 to -0013 and -0018: what is wrong, with the part and the cell
[[nodiscard]] Workbook read_xlsx(std::string_view bytes, const std::string& file);

}  // namespace gumcert::workbook
