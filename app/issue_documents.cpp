#include "app/issue_documents.h"

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/dcc_document.h"

namespace gumcert::app {

namespace {

std::string digital_certificate(const reports::EvaluationRecord& record, const IssueOptions& options) {
    std::string dcc = reports::render_dcc(record, options.assets);
    return options.signer == nullptr ? dcc : signing::sign_dcc(dcc, *options.signer, options.signing_time);
}

std::string pdf_with(const std::string& dcc, const reports::EvaluationRecord& record, const IssueOptions& options) {
    std::string pdf = reports::render_pdf(record, options.assets, dcc, options.worker);
    return options.signer == nullptr ? pdf : signing::sign_pdf(pdf, *options.signer, options.signing_time);
}

}  // namespace

void require_signable(const reports::EvaluationRecord& record) {
    const bool issued =
        record.certificate && !record.certificate->blocked && record.certificate->data.status != "specimen";
    if (!issued) {
        throw gum::InputError(gum::Diagnostic{
            .code = "GC-SIGN-0001",
            .where = "--sign",
            .what = record.certificate && record.certificate->blocked
                        ? "the certificate is a draft: critical findings block its issue"
                        : "the document is a specimen",
            .rule = "a signature is put on issued certificates only",
            .action = record.certificate ? "mend what the findings say, or leave --sign out"
                                         : "state the certificate data in the job (docs/certificate_data.md), or leave "
                                           "--sign out"});
    }
}

std::string issue_document(const reports::EvaluationRecord& record, DocumentForm form, const IssueOptions& options) {
    if (options.signer != nullptr) {
        require_signable(record);
    }
    switch (form) {
        case DocumentForm::html:
            return reports::render_html(record, options.assets);
        case DocumentForm::text:
            return reports::render_text(record, options.assets);
        case DocumentForm::dcc:
            return digital_certificate(record, options);
        case DocumentForm::pdf:
            break;
    }
    return pdf_with(digital_certificate(record, options), record, options);
}

IssuedDocuments issue_documents(const reports::EvaluationRecord& record, const IssueOptions& options) {
    if (options.signer != nullptr) {
        require_signable(record);
    }
    IssuedDocuments documents;
    documents.html = reports::render_html(record, options.assets);
    documents.dcc = digital_certificate(record, options);
    documents.pdf = pdf_with(documents.dcc, record, options);
    return documents;
}

}  // namespace gumcert::app
