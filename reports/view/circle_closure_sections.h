#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// Design, tests, series and residuals of a circle closure, with the deviations as a figure where there is no
/// certificate: there the certified values have theirs. Nothing where the record holds no circle closure.
void circle_closure_section(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

}  // namespace gumcert::reports
