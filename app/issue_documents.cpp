#include "app/issue_documents.h"

#include "gum/quantity/diagnostic.h"
#include "reports/comparison_csv.h"
#include "reports/dcc/dcc_document.h"

namespace gumcert::app {

namespace {

bool is_comparison(const reports::EvaluationRecord& record) {
    return record.kind == "comparison";
}

std::string digital_certificate(const reports::EvaluationRecord& record, const IssueOptions& options) {
    if (is_comparison(record)) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-REPORT-0041",
                            .where = "record",
                            .what = "a comparison has no digital calibration certificate",
                            .rule = "it judges results, it does not calibrate",
                            .action = "use --format html, pdf, text or csv; its record (JSON) is what programs read"});
    }
    std::string dcc = reports::render_dcc(record, options.assets);
    if (options.signer == nullptr) {
        return dcc;
    }
    signing::require_a_chain(*options.signer, options.signing_time);
    return signing::sign_dcc(dcc, *options.signer, options.signing_time);
}

std::string pdf_with(const std::string& dcc, const reports::EvaluationRecord& record, const IssueOptions& options) {
    std::string pdf = reports::render_pdf(record, options.assets, dcc, options.worker);
    if (options.signer == nullptr) {
        return pdf;
    }
    signing::require_a_chain(*options.signer, options.signing_time);
    return signing::sign_pdf(pdf, *options.signer, options.signing_time);
}

}  // namespace

void require_signable(const reports::EvaluationRecord& record) {
    const bool issued =
        record.certificate && !record.certificate->blocked && record.certificate->data.status != "specimen";
    if (is_comparison(record)) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-SIGN-0001",
                                              .where = "--sign",
                                              .what = "the document is the report of a comparison",
                                              .rule = "a signature is put on issued certificates only",
                                              .action = "leave --sign out"});
    }
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
        case DocumentForm::csv:
            return reports::comparison_csv(record);
        case DocumentForm::dcc:
            return digital_certificate(record, options);
        case DocumentForm::pdf:
            break;
    }
    return pdf_with(is_comparison(record) ? std::string() : digital_certificate(record, options), record, options);
}

IssuedDocuments issue_documents(const reports::EvaluationRecord& record, const IssueOptions& options) {
    if (options.signer != nullptr) {
        require_signable(record);
    }
    IssuedDocuments documents;
    documents.html = reports::render_html(record, options.assets);
    if (is_comparison(record)) {
        documents.csv = reports::comparison_csv(record);
    } else {
        documents.dcc = digital_certificate(record, options);
    }
    documents.pdf = pdf_with(documents.dcc, record, options);
    return documents;
}

}  // namespace gumcert::app
