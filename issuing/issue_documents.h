#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "issuing/output_forms.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::issuing {

/// Refuses to sign what is not issued: a specimen, or a certificate that critical findings block.
/// \throws gum::InputError  GC-SIGN-0001
void require_signable(const reports::EvaluationRecord& record,
                      std::span<const evaluation::Kind> kinds = evaluation::program_kinds());

/// Says of a certificate, or of the report of a comparison, that a later one amends or replaces it: its documents are marked,
/// and not signed.
/// \param where, where_later  names of the records for messages
/// \param today  "2026-11-22", of the caller
/// \throws gum::InputError  GC-CERT-0309 where one of them has no number, they are not of one sort, or the later one
///         names another number, or cannot have been issued, by what its record says: a draft, without a date of
///         issue, dated later than today, or a specimen where the earlier one is none
void supersede(reports::EvaluationRecord& record, reports::EvaluationRecord later, const std::string& where,
               const std::string& where_later, const std::string& today);

/// One form of the document. The digital certificate is signed first and stands in the PDF as it was signed; then the
/// PDF is signed. Other forms carry no signature. The report of a comparison has no digital certificate.
/// \param form  name of a row of output_forms()
/// \throws gum::InputError  GC-REPORT-0041 a digital certificate of a comparison, -0040 CSV of another record
/// \throws gum::NoResultError, gum::StorageError
[[nodiscard]] std::string issue_document(const reports::EvaluationRecord& record, std::string_view form,
                                         const IssueOptions& options);

struct IssuedDocument {
    const OutputForm* form;
    std::string bytes;
};
/// The forms that `gumcert run` writes: those of Kind::forms, in their order.
[[nodiscard]] std::vector<IssuedDocument> issue_documents(const reports::EvaluationRecord& record,
                                                          const IssueOptions& options);

/// The names of their files, in the same order.
[[nodiscard]] std::vector<std::string> document_names(const evaluation::Kind& kind);

}  // namespace gumcert::issuing
