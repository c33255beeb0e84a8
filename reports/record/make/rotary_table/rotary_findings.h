#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What the adjustment of a rotary table says of its own uncertainties, as messages of the evaluation: GC-ADJUST-0010
/// chi-square refutes them, -0011 it is far too small for them (a note), -0012 many distances are left out. Nothing of
/// a record of another kind.
[[nodiscard]] std::vector<gum::Diagnostic> rotary_remarks(const reports::EvaluationRecord& record);

/// The same as findings of a certificate: G01 and G03, critical where it is accredited, and G02, information; and G04
/// for every group of distances that the adjustment found suspicious, and G07 for every component of a given repeatability
/// that the distances refute, critical where it is accredited and the component is too small (docs/findings.md).
[[nodiscard]] std::vector<certificate::Finding> rotary_findings(const reports::EvaluationRecord& record);

}  // namespace gumcert::reports
