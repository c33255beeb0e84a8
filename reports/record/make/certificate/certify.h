#pragma once

#include <vector>

#include "certificate/capability_inputs.h"
#include "certificate/certificate_data.h"
#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Makes a record a certificate: puts its results into certified tables, prints every value with its capability as the
/// floor and by the profile, decides on conformity, passes the three gates. Printed texts elsewhere in the record
/// (Result::printed, StatedValue::printed …) become the same ones, so that no two places of a document disagree.
///
/// The rounding of a budget job (`reporting.rounding`: up) stays in force where the profile rounds half-even.
/// \param of_register  findings of the register of the laboratory (certificate/gates/register_gate.h)
/// \throws gum::InputError  GC-GUM-.. if a number of the record cannot be printed
void certify(reports::EvaluationRecord& record, certificate::CertificateData data, certificate::Profile profile,
             const certificate::CapabilityInputs& inputs = {},
             const std::vector<certificate::Finding>& of_register = {});

}  // namespace gumcert::reports
