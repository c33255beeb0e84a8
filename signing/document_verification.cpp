#include "signing/document_verification.h"

#include <algorithm>

#include "signing/certificates.h"
#include "signing/time_texts.h"

namespace gumcert::signing {

void add_error(SignatureReport& report, const char* code, const std::string& where, const std::string& what,
               const char* rule, const char* action) {
    report.findings.push_back({.code = code, .where = where, .what = what, .rule = rule, .action = action});
}

void check_signer(SignatureReport& report, const std::string& where, const std::vector<CertificateHandle>& chain,
                  const std::vector<Bytes>& trusted, const std::string& claimed_time, std::int64_t now) {
    X509* const signer = chain.front().get();
    report.signer = subject_of(signer);
    report.issuer = issuer_of(signer);
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
    constexpr std::int64_t k_clocks_may_differ = 300;  // seconds
    if (time > now + k_clocks_may_differ) {
        add_error(report, "GC-SIGN-0134", where,
                  "signed at " + time_text(time) + ", which is after the present time " + time_text(now),
                  "a signature is made before it is checked", "check the clock of this computer");
    }
    for (gum::Diagnostic& finding : check_chain(where, chain, trusted, time)) {
        report.findings.push_back(std::move(finding));
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
