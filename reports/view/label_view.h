#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace gumcert::reports {

/// What a label on a calibrated item says, as texts in the binding language:
///
///     language, title, attachment[]            as of a certificate
///     laboratory, accreditation[] {text}       number of the accreditation, only where the symbol may stand
///     symbol[]    data_uri, base64, file, alt
///     heading     "Calibrated"
///     rows[]      {label, value}: item, certificate, date with the month in words; recalibration only where the customer
///                 agreed on it (ISO/IEC 17025:2017, 7.8.4.3)
///     mark[]      {text}: draft, specimen, superseded; none on the label of a certificate that is issued
///     code        what the QR code says, see text_of_code()
///
/// \param record   with certificate data
/// \param words  as of certificate_view()
/// \throws gum::StorageError if the wording lacks a text
[[nodiscard]] nlohmann::json label_view(const EvaluationRecord& record, const Wording& words);

/// Number of the certificate and SHA-256 of its record, in capital letters, which make the code smaller:
/// "EX-2026-0042 SHA-256 0A1B…". The number alone, where the record states no digest.
[[nodiscard]] std::string text_of_code(const EvaluationRecord& record);

/// "2026-11-21" as "21 November 2026", in the binding language; a text that is no date as it is.
[[nodiscard]] std::string date_in_words(const std::string& date, const Wording& words);

}  // namespace gumcert::reports
