#pragma once

#include <optional>

#include "audit/tables/sheet_view.h"
#include "audit/tables/table_heads.h"

namespace gumcert::audit {

/// Half of the distance of the two limits of a row, with the unit of their cells or heads; nothing where they are no two numbers about the
/// estimate, or about 0 as deviations from it are.
[[nodiscard]] std::optional<NumberWithUnit> half_width_of_limits(const SheetView& sheet, const Heads& heads,
                                                                 const SheetView::Row& row);

/// Takes "Lower | Upper" for limits of what is divided where u of the rows below shows it: each is half of their distance over the divisor
/// of its distribution, or what a slip makes of it where the other rows are right. A range that the room may have is no such limit.
void take_limits(const SheetView& sheet, const SheetView::Row& row, Heads& heads);

}  // namespace gumcert::audit
