#pragma once

#include "certificate/certified_results.h"
#include "reports/document_text.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certified_overview.h"
#include "reports/wording.h"

#include <string>

namespace gumcert::reports {

/// Title of a table with a layout, and of its group of rows: "DC voltage. Range: 100 mV."
[[nodiscard]] Text layout_caption(const certificate::TableLayout& layout, const Wording& words);

/// A certified table as its layout says: columns of points, results, limits and verdicts side by side. k and marks stand
/// in columns of their own behind U where they are needed and the layout has none; limits that are symmetrical about 0
/// take one column where the profile allows ±. What does not fit side by side on a page becomes several tables: the
/// columns of a result stay together, and those of the points before the first result are repeated.
/// \param shown  values that have their place here
void layout_table(CertificateBuilder& builder, const Wording& words, const certificate::CertifiedTable& table,
                  const std::string& id, const CertifiedOverview::Holds& shown, const CertifiedOverview& overview);

}  // namespace gumcert::reports
