#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The conditions that a certificate states against what the environment file of the measurement says: E04 where the
/// file leaves what is stated, E05 where it leaves the limits of the method and no deviation is stated. Both critical:
/// a certificate that states other conditions than those of the measurement is wrong (docs/findings.md).
///
/// A value leaves a range when it is outside by more than its own expanded uncertainty (k = 2), that of the sensor and
/// half a unit of the last digit of the stated range. The temperatures of the fixture must be in one of the
/// temperatures that the certificate states; those of the air, too, where it states more than one; pressure and
/// humidity in one of their kind where there is one.
[[nodiscard]] std::vector<certificate::Finding> environment_findings(const reports::EvaluationRecord& record);

}  // namespace gumcert::reports
