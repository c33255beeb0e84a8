#pragma once

#include <cstdint>
#include <string>

#include "reports/pdf_worker.h"
#include "reports/record/evaluation_record.h"
#include "reports/render.h"
#include "signing/signer.h"

namespace gumcert::app {

/// What the documents of a record are made with.
struct IssueOptions {
    reports::RenderAssets assets;
    const signing::Signer* signer = nullptr;  ///< none: documents are not signed
    std::int64_t signing_time = 0;            ///< seconds since 1970-01-01 UTC
    reports::PdfWorker* worker = nullptr;     ///< for many documents; none: a process for each PDF
};

enum class DocumentForm { html, pdf, dcc, text, csv };

/// Refuses to sign what is not issued: a specimen, or a certificate that critical findings block.
/// \throws gum::InputError  GC-SIGN-0001
void require_signable(const reports::EvaluationRecord& record);

/// One form of the document. The digital certificate is signed first and stands in the PDF as it was signed; then the
/// PDF is signed. HTML, text and CSV carry no signature. The report of a comparison has no digital certificate.
/// \throws gum::InputError  GC-REPORT-0041 a digital certificate of a comparison, -0040 CSV of another record
/// \throws gum::NoResultError, gum::StorageError
[[nodiscard]] std::string issue_document(const reports::EvaluationRecord& record, DocumentForm form,
                                         const IssueOptions& options);

/// The forms that `gumcert run` writes: `csv` for a comparison, else `dcc`.
struct IssuedDocuments {
    std::string html, pdf, dcc, csv = {};
};
[[nodiscard]] IssuedDocuments issue_documents(const reports::EvaluationRecord& record, const IssueOptions& options);

}  // namespace gumcert::app
