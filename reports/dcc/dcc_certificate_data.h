#pragma once

#include <string>
#include <vector>

#include "certificate/certificate_data.h"
#include "reports/dcc/xml_document.h"

namespace gumcert::reports {

/// A statement of a digital certificate, in English where it has it.
struct DccStatement {
    std::string id, ref_type;  ///< attributes; "" without
    std::string norm, reference, declaration;
};

/// What a digital certificate says beside its results, as far as the format has elements for it: number, laboratory,
/// customer, item, days, persons by their roles, the method of the calibration, measuring equipment with the certificates
/// that it names, influence conditions, and the accreditation where a statement is about one. The main signer, or the only
/// person there is, authorises. What stands in free text only, as remarks and opinions do, stays there: a field that is
/// empty was not found, which does not mean that the certificate does not have it. Of a standard U and k are those that
/// this program writes; a condition is the range of what is stated of it.
/// \param root  of read_dcc_root()
[[nodiscard]] certificate::CertificateData certificate_data_of(const XmlElement& root);

/// All of its statements, in their order.
[[nodiscard]] std::vector<DccStatement> statements_of(const XmlElement& root);

/// Names of equipment whose certificate, as the document itself says, was not valid when it was used.
[[nodiscard]] std::vector<std::string> equipment_out_of_validity(const XmlElement& root);

}  // namespace gumcert::reports
