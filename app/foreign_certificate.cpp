#include "app/foreign_certificate.h"

#include <algorithm>
#include <charconv>
#include <tuple>
#include <utility>

#include "reports/certificate_view.h"
#include "reports/dcc/dcc_document.h"
#include "signing/verify.h"

namespace gumcert::app {

namespace {

using gum::Diagnostic;
using gum::Severity;

Diagnostic told(const char* code, const std::string& file, std::string what, std::string rule, std::string action,
                Severity severity) {
    return {.code = code,
            .where = file,
            .what = std::move(what),
            .rule = std::move(rule),
            .action = std::move(action),
            .severity = severity};
}

constexpr const char* k_ask = "ask the laboratory for the original document";

/// What was changed after signing, or a value that does not fit: the signature is there and says that.
bool is_broken(const Diagnostic& finding) {
    return finding.severity == Severity::error && (finding.code == "GC-SIGN-0117" || finding.code == "GC-SIGN-0118");
}

/// That the certificate of the signer leads to none that is trusted.
bool is_without_trust(const Diagnostic& finding) {
    return finding.code == "GC-SIGN-0130";
}

Diagnostic worth_of(const signing::SignatureReport& signature, const std::string& file, bool trust_named) {
    const std::string signer = signature.signer.empty() ? "a signer that is not stated" : signature.signer;
    for (const Diagnostic& finding : signature.findings) {
        if (is_broken(finding)) {
            return told("GC-DCC-0041", file, "the signature by " + signer + " is broken: " + finding.what,
                        "what was signed is unchanged", k_ask, Severity::error);
        }
    }
    for (const Diagnostic& finding : signature.findings) {
        if (finding.severity == Severity::error && (trust_named || !is_without_trust(finding))) {
            return told("GC-DCC-0042", file, "the signature by " + signer + " cannot be relied on: " + finding.what,
                        finding.rule, k_ask, Severity::error);
        }
    }
    if (!trust_named) {
        return told("GC-DCC-0043", file,
                    "signed by " + signer + "; the document is as it was signed, who the signer is was not checked",
                    "a signer is known by a certificate that you trust", "name such certificates with --trust",
                    Severity::warning);
    }
    return told("GC-DCC-0044", file, "signed by " + signer + ", valid",
                "the signer's certificate leads to a trusted one", "nothing", Severity::note);
}

void add_signatures(std::string_view bytes, const std::string& file, const CertificateTrust& trust,
                    std::vector<Diagnostic>& out) {
    if (bytes.find("Signature") == std::string_view::npos) {
        return;
    }
    try {
        const signing::Verification verification = signing::verify_signatures(
            signing::Bytes(bytes), file, trust.trusted.value_or(std::vector<signing::Bytes>()), trust.now);
        for (const signing::SignatureReport& signature : verification.signatures) {
            out.push_back(worth_of(signature, file, trust.trusted.has_value()));
        }
    } catch (const gum::InputError& refused) {
        out.push_back(told("GC-DCC-0042", file,
                           "a signature that cannot be relied on: " + refused.diagnostics().front().what,
                           refused.diagnostics().front().rule, k_ask, Severity::error));
    }
}

std::optional<double> number_of(const std::string& text) {
    const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, failure] = std::from_chars(begin, text.data() + text.size(), value);
    return failure == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// A number of a statement of uncertainty that is none, or out of its range; "" where all are right.
std::string fault_of(const reports::ImportedQuantity& q) {
    for (const auto& [name, text, least] :
         {std::tuple("the expanded uncertainty", &q.U, 0.0), std::tuple("the standard uncertainty", &q.u, 0.0),
          std::tuple("the coverage factor", &q.k, 0.0)}) {
        if (text->empty()) {
            continue;
        }
        const std::optional<double> value = number_of(*text);
        if (!value || !(*value >= least)) {
            return std::string(name) + " is " + reports::printable(*text);
        }
    }
    const std::optional<double> p = number_of(q.p);
    return !q.p.empty() && !(p && *p > 0.0 && *p < 1.0) ? "the coverage probability is " + reports::printable(q.p) : "";
}

void add_state(const reports::ImportedCertificate& certificate, const std::string& file, std::vector<Diagnostic>& out) {
    if (!certificate.state.empty()) {
        out.push_back(told("GC-DCC-0040", file,
                           "the document is a " + certificate.state + ", not an issued certificate",
                           "traceability rests on certificates that a laboratory has issued",
                           "use its numbers for trials only", Severity::warning));
    }
}

}  // namespace

std::vector<Diagnostic> reservations_on(const reports::ImportedCertificate& certificate, std::string_view bytes,
                                        const std::string& file, const CertificateTrust& trust) {
    std::vector<Diagnostic> out;
    add_state(certificate, file, out);
    add_signatures(bytes, file, trust, out);
    std::vector<Diagnostic> breaches = reports::check_dcc(bytes, file);
    std::erase_if(breaches, [](const Diagnostic& d) { return d.severity != Severity::error; });
    if (!breaches.empty()) {
        out.push_back(told("GC-DCC-0045", file,
                           std::to_string(breaches.size()) + (breaches.size() == 1 ? " rule is" : " rules are") +
                               " broken, the first at " + breaches.front().where + ": " + breaches.front().what,
                           breaches.front().rule, "gumcert check dcc lists all of them", Severity::warning));
    }
    return out;
}

std::vector<Diagnostic> check_certificate(std::string_view bytes, const std::string& file,
                                          const CertificateTrust& trust) {
    const reports::ImportedCertificate certificate = reports::read_dcc(bytes, file);
    std::vector<Diagnostic> out;
    add_state(certificate, file, out);
    add_signatures(bytes, file, trust, out);
    out.insert(out.end(), certificate.remarks.begin(), certificate.remarks.end());
    for (const reports::ImportedQuantity& q : certificate.quantities) {
        const std::string fault = q.objection.empty() ? fault_of(q) : q.objection;
        if (!fault.empty()) {
            out.push_back(told("GC-DCC-0046", file + ": " + q.name, fault,
                               "a statement of uncertainty is a number, stands once, and its k belongs to its p",
                               "correct the statement", Severity::error));
        }
    }
    const std::vector<Diagnostic> missing = reports::check_dcc_structure(bytes, file);
    out.insert(out.end(), missing.begin(), missing.end());
    const std::vector<Diagnostic> breaches = reports::check_dcc(bytes, file);
    out.insert(out.end(), breaches.begin(), breaches.end());
    return out;
}

}  // namespace gumcert::app
