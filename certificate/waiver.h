#pragma once

#include <string>

#include "certificate/certificate_data.h"

namespace gumcert::certificate {

/// Whether a waiver lets a finding pass: it names a person, gives a reason that says something, and is not dated later
/// than the certificate. What it lacks is a finding of its own (R18, docs/findings.md).
/// \param issued  date of the certificate; "" none is stated
[[nodiscard]] bool has_effect(const Waiver& waiver, const std::string& issued);

}  // namespace gumcert::certificate
