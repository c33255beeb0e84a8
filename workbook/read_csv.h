#pragma once

#include <string>
#include <string_view>

#include "workbook/workbook.h"

namespace gumcert::workbook {

/// Makes a workbook of one sheet of a CSV text (RFC 4180, in UTF-8, with or without a byte order mark).
///
/// The separator is the one of TAB, semicolon and comma that most of the lines have outside of quotes; of two that have
/// equally many, the first in this order. Behind semicolons a number is written with a decimal comma where any field is;
/// else with a point. What reads as a number is one, and CellValue::text keeps its characters; everything else is text,
/// formulas too. Lines may end with LF, CR LF or CR.
/// \param text   the bytes of the file
/// \param file   its name, for messages
/// \param sheet  name of the sheet
/// \throws gum::InputError  GC-WORKBOOK-0001 larger than 20 MB, -0012 too many cells, -0016 no UTF-8, -0017 a quote that is
///                          not closed, or with something behind it
[[nodiscard]] Workbook read_csv(std::string_view text, const std::string& file, const std::string& sheet);

}  // namespace gumcert::workbook
