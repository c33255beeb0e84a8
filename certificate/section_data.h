#pragma once

#include <string_view>

#include "certificate/certificate_data.h"

namespace gumcert::certificate {

/// The data as they hold for the results of one section of a job: item, method, standards and conditions that the section
/// states stand in place of those of the whole certificate. All else is the same.
/// \param section  its name; one that states nothing of its own, or "", has the data of the certificate
[[nodiscard]] CertificateData data_of_section(const CertificateData& data, std::string_view section);

}  // namespace gumcert::certificate
