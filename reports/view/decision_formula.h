#pragma once

#include "reports/document_text.h"
#include "reports/wording.h"

#include <string>

namespace gumcert::reports {

/// The formula of a decision rule, as the record holds it ("pass: AL = TL + w; else undetermined"), in the words and
/// with the decimal sign of each language, and with the symbols of the tables: A_L, A_U, T_L, T_U (JCGM 106:2012).
/// What is not known stays as it is.
[[nodiscard]] Text decision_formula(const std::string& recorded, const Wording& words);

}  // namespace gumcert::reports
