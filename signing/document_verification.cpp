#include "signing/document_verification.h"

#include <algorithm>

#include "signing/certificates.h"
#include "signing/signer_chain.h"
#include "signing/time_texts.h"
#include "text/visible_text.h"

namespace gumcert::signing {

std::string shown_text(std::string_view text) {
    constexpr std::size_t k_longest = 300;
    return text::visible(text, k_longest, true);
}

void show_safely(std::vector<gum::Diagnostic>& messages) {
    for (gum::Diagnostic& message : messages) {
        message.what = shown_text(message.what);
    }
}

void show_safely(SignatureReport& report) {
    for (std::string* text :
         {&report.format, &report.signer, &report.issuer, &report.signing_time, &report.algorithm}) {
        *text = shown_text(*text);
    }
    for (std::string& name : report.signer_names) {
        name = shown_text(name);
    }
    for (std::vector<std::string>* texts : {&report.covers, &report.not_covered}) {
        for (std::string& text : *texts) {
            text = shown_text(text);
        }
    }
    show_safely(report.findings);
}

void add_error(SignatureReport& report, const char* code, const std::string& where, const std::string& what,
               const char* rule, const char* action) {
    report.findings.push_back({.code = code, .where = where, .what = what, .rule = rule, .action = action});
}

void add_warning(SignatureReport& report, const char* code, const std::string& where, const std::string& what,
                 const char* rule, const char* action) {
    add_error(report, code, where, what, rule, action);
    report.findings.back().severity = gum::Severity::warning;
}

void check_signer(SignatureReport& report, const std::string& where, const std::vector<CertificateHandle>& chain,
                  const TrustedMaterial& trusted, const std::string& claimed_time, std::int64_t now) {
    X509* const signer = chain.front().get();
    report.signer = subject_of(signer);
    report.issuer = issuer_of(signer);
    report.signer_names = names_of(signer);
    std::int64_t time = now;
    if (!claimed_time.empty()) {
        const std::optional<std::int64_t> claimed = time_from_text(claimed_time);
        if (!claimed) {
            add_error(report, "GC-SIGN-0134", where, "the time of signing cannot be read: " + claimed_time,
                      "a time of signing is a date with time", "ask the laboratory for the document again");
        } else {
            time = *claimed;
            report.signing_time = time_text(time);
        }
    }
    // A signature can seem to come from the future where the clocks of two computers differ.
    constexpr std::int64_t k_clocks_may_differ = 300;  // seconds
    if (time > now + k_clocks_may_differ) {
        add_error(report, "GC-SIGN-0134", where,
                  "signed at " + time_text(time) + ", which is after the present time " + time_text(now),
                  "a signature is made before it is checked", "check the clock of this computer");
    }
    // Judged at the time of signing and not at the present: certificates of calibration are kept longer than those of
    // their signers last.
    for (gum::Diagnostic& finding : check_chain(where, chain, trusted.certificates, time)) {
        report.findings.push_back(std::move(finding));
    }
    const SignerChain issuers(chain, trusted.certificates);
    for (X509* const foreign : issuers.foreign()) {
        add_error(report, "GC-SIGN-0124", where,
                  "a certificate of " + subject_of(foreign) + " came along, which has not issued that of the signer",
                  k_chain_alone, k_ask_again);
    }
    for (X509* const unproven : issuers.unproven()) {
        report.not_covered.push_back("the certificate of " + subject_of(unproven) +
                                     " that came along: nothing that is trusted vouches for it");
    }
    const std::optional<std::int64_t> end = end_of_validity(signer);
    if (end && *end < now && time <= *end) {
        report.findings.push_back({.code = "GC-SIGN-0135",
                                   .where = where,
                                   .what = "the certificate has expired at " + time_text(*end) +
                                           "; that the signature is older is the signer's own statement",
                                   .rule = "only a time stamp of a third party proves the time of a signature",
                                   .action = "ask the laboratory if the age of the signature matters",
                                   .severity = gum::Severity::warning});
    }
    const std::vector<gum::Diagnostic> revoked = check_revocation(where, chain, trusted, now);
    report.findings.insert(report.findings.end(), revoked.begin(), revoked.end());
    if (!revoked.empty()) {
        return;
    }
    report.findings.push_back({.code = "GC-SIGN-0136",
                               .where = where,
                               .what = "it was not checked whether the certificate has been revoked",
                               .rule = "nothing is asked over the network",
                               .action = "ask the issuer's service if revocation matters",
                               .severity = gum::Severity::note});
}

void conclude(SignatureReport& report) {
    report.valid = std::none_of(report.findings.begin(), report.findings.end(), [](const gum::Diagnostic& finding) {
        return finding.severity == gum::Severity::error;
    });
}

}  // namespace gumcert::signing
