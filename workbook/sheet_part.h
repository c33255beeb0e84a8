#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "workbook/workbook.h"
#include "workbook/workbook_parts.h"

namespace gumcert::workbook {

/// What cells of all sheets stand on, and how many there may still be.
struct SheetSurroundings {
    std::span<const std::string> shared_strings;
    std::span<const std::uint32_t> format_of_style;
    TextAllowance& texts;
    std::size_t& cells_left;
};

/// Reads the part of a sheet into it.
/// \throws gum::InputError  as read_xlsx() does
void read_sheet_part(std::string_view xml, const std::string& where, const SheetSurroundings& surroundings,
                     Sheet& sheet);

}  // namespace gumcert::workbook
