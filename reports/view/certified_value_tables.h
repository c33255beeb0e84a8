#pragma once

#include "certificate/certified_results.h"
#include "reports/document_text.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/certified_overview.h"
#include "reports/wording.h"

#include <string>

namespace gumcert::reports {

/// Caption of a certified table.
[[nodiscard]] Text certified_table_name(const certificate::CertifiedTable& table, const Wording& words);

/// Head of the column of the argument, and whether its cells are numbers.
[[nodiscard]] Text argument_head(const certificate::CertifiedTable::Argument& argument, const Wording& words);
[[nodiscard]] bool is_numeric(const certificate::CertifiedTable::Argument& argument);

/// A certified table as one table of the document, or as several where it is too wide for a page.
/// \param id     unique in the document
/// \param shown  values that have their place here; of the others nothing is printed
void certified_table(CertificateBuilder& builder, const Wording& words, const certificate::CertifiedTable& table,
                     const std::string& id, const CertifiedOverview::Holds& shown, const CertifiedOverview& overview);

/// What the short names of the quantities of a table stand for.
void certified_meanings(CertificateBuilder& builder, const Wording& words, const certificate::CertifiedTable& table);

}  // namespace gumcert::reports
