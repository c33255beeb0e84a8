#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "certificate/certificate_data.h"

namespace gumcert::reports {

/// A text of the certificate data that says whose certificate a document is, what was calibrated, when, how, and who says so.
struct DocumentFact {
    std::string what;                    ///< "serial number of the item"
    std::vector<std::string> spellings;  ///< as documents print it, in every language that is stated
};

/// What a certificate identifies (ISO/IEC 17025:2017, 7.8.2.1 and 7.8.4.1): its number, laboratory, customer, item and pieces,
/// dates, method, persons and the certificates of its standards. Without those that the record does not state.
[[nodiscard]] std::vector<DocumentFact> facts_of(const certificate::CertificateData& data);

/// All texts of a view, one a line, without its pictures and drawings.
[[nodiscard]] std::string texts_of_view(const nlohmann::json& view);

}  // namespace gumcert::reports
