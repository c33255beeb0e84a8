#pragma once

#include "reports/document_text.h"
#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace gumcert::reports {

/// The first page of a certificate (ISO/IEC 17025:2017, 7.8.2.1 a to e, g to j, l and o): who, what, when and where. An
/// object of the view; see certificate_view.h. Nothing of it is a result.
/// \param builder  without open sections; it is empty again afterwards, its numbering goes on
/// \param record   with certificate data
[[nodiscard]] nlohmann::json identity_page(CertificateBuilder& builder, const Wording& words,
                                           const EvaluationRecord& record);

/// What stands in a box above everything: that a document is a draft, a specimen, or superseded. Empty for one that can
/// be issued. An array of objects of the view.
/// \param report  of a document that is no certificate, how its words begin (DocumentKind::report); "" else
[[nodiscard]] nlohmann::json document_marks(const Wording& words, const EvaluationRecord& record,
                                            std::string_view report);

/// What the head of every page ends with, where a later document supersedes this one; "" on all others.
[[nodiscard]] std::string superseded_in_head(const Wording& words, const EvaluationRecord& record);

/// Head and foot of every page: {header_left, header_right, footer_left}, in the binding language.
[[nodiscard]] nlohmann::json running_texts(const Wording& words, const EvaluationRecord& record);

/// "draft", "specimen", "superseded" or "issued": the group certificate_status of the wording has words for it.
[[nodiscard]] std::string document_status(const EvaluationRecord& record);

/// What a certificate that is issued says of that on every page: an array of one {text}; none for others, whose marks
/// say what they are.
[[nodiscard]] nlohmann::json issued_status(const Wording& words, const EvaluationRecord& record);

/// The title: "Calibration certificate", or which certificate it amends or replaces (ISO/IEC 17025:2017, 7.8.8.2).
/// \param record  with certificate data
[[nodiscard]] Text document_type(const EvaluationRecord& record, const Wording& words);

/// The symbol of the accreditation, only where it may stand: an array of none or one {data_uri, base64, file, alt}.
[[nodiscard]] nlohmann::json accreditation_symbol(const certificate::Certificate& certificate, const Wording& words);

/// What of a certificate an amendment changed, for people: "Item calibrated: Serial number", "l: U".
[[nodiscard]] Text place_of_change(const certificate::Change& change, const Wording& words);
/// What stood or stands there.
/// \param side  Change::before or after
[[nodiscard]] Text side_of_change(const certificate::Change& change, const std::string& side, const Wording& words);

/// What a certificate says of an item. Facts that an assessor looks for stand there even when nothing was stated: "–".
[[nodiscard]] Facts item_facts(const Wording& words, const certificate::Item& item);

/// What † means, below facts of which one has it; nothing where none has.
void explain_marks(CertificateBuilder& builder, const Wording& words, const Facts& facts);

/// Description, manufacturer, type and numbers of all items of a certificate.
[[nodiscard]] Text items_in_one_line(const certificate::CertificateData& data, const Wording& words);

/// That the results are of what was calibrated only (ISO/IEC 17025:2017, 7.8.2.1 l).
[[nodiscard]] Text only_item_sentence(const certificate::CertificateData& data, const Wording& words);

/// Whether the item was adjusted (ISO/IEC 17025:2017, 7.8.4.1 d); of several items, whether any was.
[[nodiscard]] Text adjustment_sentence(const certificate::CertificateData& data,
                                       const certificate::Adjustment& adjustment, const Wording& words);

/// For what the uncertainty holds: not for the item, or the items, after the calibration.
[[nodiscard]] Text validity_sentence(const certificate::CertificateData& data, const Wording& words);

/// A text of the certificate data, marked with † where the customer stated it.
[[nodiscard]] Text item_text(const certificate::Item& item, const std::string& key, const Text& text);

/// "2026-11-18", or "2026-11-18 – 2026-11-19" for two different days.
[[nodiscard]] std::string from_to(const std::string& from, const std::string& to);

/// Which certificate this one amends or replaces (ISO/IEC 17025:2017, 7.8.8).
[[nodiscard]] Text amendment_sentence(const certificate::Amendment& amendment, const Wording& words);

}  // namespace gumcert::reports
