#include "issuing/issue_documents.h"

#include <utility>

#include "gum/quantity/diagnostic.h"
#include "reports/record/record_kinds.h"

namespace gumcert::issuing {

void require_signable(const reports::EvaluationRecord& record, std::span<const evaluation::Kind> kinds) {
    const bool superseded = record.certificate && !record.certificate->superseded_by.empty();
    const bool issued = record.certificate && !record.certificate->blocked &&
                        record.certificate->data.status != "specimen" && !superseded;
    if (!is_certificate(record, kinds)) {
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
                    : superseded ? "the certificate is superseded"
                                 : "the document is a specimen",
            .rule = "a signature is put on issued certificates only",
            .action = record.certificate ? "mend what the findings say, or leave --sign out"
                                         : "state the certificate data in the job (docs/certificate_data.md), or leave "
                                           "--sign out"});
    }
}

void supersede(reports::EvaluationRecord& record, const reports::EvaluationRecord& later, const std::string& where,
               const std::string& where_later) {
    const auto refuse = [](const std::string& at, std::string what, std::string rule, std::string action) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-CERT-0309",
                                              .where = at,
                                              .what = std::move(what),
                                              .rule = std::move(rule),
                                              .action = std::move(action)});
    };
    if (!record.certificate) {
        // An amended report has certificate data in its job, and still no page that says what became of it.
        refuse(where,
               record.kind == reports::k_comparison_kind ? "the report of a comparison"
                                                         : "a record without certificate data",
               "a certificate is superseded by another one", "leave --superseded-by out");
    }
    const std::string& number = record.certificate->data.number;
    if (!later.certificate || !later.certificate->data.amendment) {
        refuse(where_later, "not the record of an amendment", "the later certificate names the one that it supersedes",
               "name the record of the certificate that amends or replaces \"" + number + "\"");
    }
    if (const std::string& named = later.certificate->data.amendment->number; named != number) {
        refuse(where_later, "amends or replaces certificate \"" + named + "\"",
               "the certificate that is printed has the number \"" + number + "\"",
               "name the record of the certificate that amends or replaces it");
    }
    record.certificate->superseded_by = later.certificate->data.number;
}

std::string issue_document(const reports::EvaluationRecord& record, std::string_view form,
                           const IssueOptions& options) {
    if (options.signer != nullptr) {
        require_signable(record, options.kinds);
    }
    Issue issue(record, options);
    return output_form(form).render(issue);
}

std::vector<IssuedDocument> issue_documents(const reports::EvaluationRecord& record, const IssueOptions& options) {
    if (options.signer != nullptr) {
        require_signable(record, options.kinds);
    }
    std::vector<IssuedDocument> documents;
    Issue issue(record, options);
    for (const std::string_view name : evaluation::kind_of(record, options.kinds).forms) {
        const OutputForm& form = output_form(name);
        documents.push_back({&form, form.render(issue)});
    }
    return documents;
}

std::vector<std::string> document_names(const evaluation::Kind& kind) {
    std::vector<std::string> names;
    for (const std::string_view form : kind.forms) {
        names.push_back(std::string(kind.document) + std::string(output_form(form).ending));
    }
    return names;
}

}  // namespace gumcert::issuing
