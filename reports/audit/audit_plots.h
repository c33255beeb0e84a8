#pragma once

#include <string>

#include "reports/audit/audit_view.h"
#include "reports/audit/audit_words.h"
#include "reports/plots/svg_plot.h"

namespace gumcert::reports {

/// U of the budgets, U as audited, and the capability over the number of the result.
/// \param file  with two results or more, all of one unit: see has_range_plot()
[[nodiscard]] Plot range_plot(const AuditedFileView& file, const AuditWords& words, const std::string& id);
[[nodiscard]] bool has_range_plot(const AuditedFileView& file);

/// Shares of the rows in the sum of their squares, the largest first; what is beyond the tenth is one bar.
[[nodiscard]] BarPlot audited_share_plot(const AuditedResultView& result, const AuditWords& words,
                                         const std::string& id);

/// A bar whose length is a share, as an SVG element that is as wide as its place. It says nothing to a screen reader:
/// the number stands beside it.
[[nodiscard]] std::string share_bar(double share);

/// An arrow from U before to U after a correction, as an SVG element: hidden from screen readers, as the words beside it
/// say the same.
/// \param largest  right end of the axis, in the unit of both
[[nodiscard]] std::string change_arrow(double before, double after, double largest);

}  // namespace gumcert::reports
