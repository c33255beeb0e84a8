#pragma once

#include "certificate/certified_results.h"
#include "reports/plots/svg_plot.h"
#include "reports/wording.h"

#include <optional>
#include <string>

namespace gumcert::reports {

/// Values of a certified table against its argument, one panel a quantity, with bars of the printed U and the limits of
/// tolerance and acceptance. Nothing where there is no numeric argument or fewer than three values.
/// \param caption  of the table
/// \param id       unique in the document
[[nodiscard]] std::optional<Plot> certified_plot(const certificate::CertifiedTable& table, const std::string& caption,
                                                 const Wording& words, const std::string& id);

}  // namespace gumcert::reports
