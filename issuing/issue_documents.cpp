#include "issuing/issue_documents.h"

#include <optional>
#include <utility>

#include "certificate/gates/day_of_issue.h"
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

namespace {

/// Under which number a record was issued, as a certificate or as the report of a comparison, and what it amends.
struct Issued {
    std::string number;
    std::optional<certificate::Amendment> amendment;
    std::string* superseded_by = nullptr;  ///< of the record
};

std::optional<Issued> issued_as(reports::EvaluationRecord& record) {
    if (record.certificate) {
        const certificate::CertificateData& data = record.certificate->data;
        return Issued{data.number, data.amendment, &record.certificate->superseded_by};
    }
    if (record.comparison && record.comparison->issuer && !record.comparison->issuer->number.empty()) {
        reports::ComparisonIssuer& issuer = *record.comparison->issuer;
        return Issued{issuer.number, issuer.amendment, &issuer.superseded_by};
    }
    return std::nullopt;
}

bool is_specimen(const reports::EvaluationRecord& record) {
    return record.certificate && record.certificate->data.status == "specimen";
}

/// Why a certificate or report has not been issued, as far as its record says; "" where nothing is against it.
/// \param earlier  what it supersedes: of a specimen that may be another one
std::string why_it_is_not_issued(const reports::EvaluationRecord& record, const reports::EvaluationRecord& earlier,
                                 const std::string& today) {
    certificate::Certificate judged = record.certificate.value_or(certificate::Certificate());
    if (!record.certificate) {
        judged.data.status = "not_accredited";  // reports have no status: they are no specimens
        judged.data.dates.issued = record.comparison->issuer->issued;
    }
    const std::string& day = judged.data.dates.issued;
    const bool is_ahead = certificate::block_issue_ahead_of_time(judged, today);
    return is_specimen(record) && !is_specimen(earlier) ? "a specimen"
           : day.empty()                                ? "without a date of issue"
           : is_ahead                                   ? "dated " + day + ", later than today, " + today
           : judged.blocked                             ? "a draft: critical findings block its issue"
                                                        : "";
}

const char* sort_of(const reports::EvaluationRecord& record) {
    return record.certificate ? "a certificate" : "the report of a comparison";
}

}  // namespace

void supersede(reports::EvaluationRecord& record, reports::EvaluationRecord later, const std::string& where,
               const std::string& where_later, const std::string& today) {
    const auto refuse = [](const std::string& at, std::string what, std::string rule, std::string action) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-CERT-0309",
                                              .where = at,
                                              .what = std::move(what),
                                              .rule = std::move(rule),
                                              .action = std::move(action)});
    };
    const std::optional<Issued> earlier = issued_as(record);
    if (!earlier) {
        refuse(where,
               record.kind == reports::k_comparison_kind ? "the report of a comparison, without a number"
                                                         : "a record without certificate data",
               "a certificate or report is superseded by another one of its sort", "leave --superseded-by out");
    }
    const std::string& number = earlier->number;
    const std::optional<Issued> amending = issued_as(later);
    if (!amending || !amending->amendment) {
        refuse(where_later, "not the record of an amendment", "the later one names the one that it supersedes",
               "name the record of the certificate or report that amends or replaces \"" + number + "\"");
    }
    if (!record.certificate != !later.certificate) {
        refuse(where_later, sort_of(later) + std::string(", and what is printed is ") + sort_of(record),
               "a certificate or report is superseded by another one of its sort",
               "name the record of the one that amends or replaces \"" + number + "\"");
    }
    if (const std::string& named = amending->amendment->number; named != number) {
        refuse(where_later, "amends or replaces \"" + named + "\"", "what is printed has the number \"" + number + "\"",
               "name the record of the one that amends or replaces it");
    }
    if (const std::string why = why_it_is_not_issued(later, record, today); !why.empty()) {
        refuse(where_later, why, "what was issued holds until the one that supersedes it is issued",
               "issue \"" + amending->number + "\" first, or leave --superseded-by out");
    }
    *earlier->superseded_by = amending->number;
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
