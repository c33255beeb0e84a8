#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "certificate/laboratory_register.h"

namespace gumcert::certificate {

/// Of the first gate, where a job names the folder of its laboratory: certificate and budget against the register.
/// Contradictions, standards that are not applicable or stand in one of the two only, and who may authorise what
/// (ISO/IEC 17025:2017, 6.2.6, 6.4, 6.5). The caller hands them to pass_gates().
[[nodiscard]] std::vector<Finding> register_findings(const CertificateData& data, const LaboratoryRegister& registered);

}  // namespace gumcert::certificate
