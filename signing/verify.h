#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "signing/signer.h"

namespace gumcert::signing {

/// What was found about one signature.
struct SignatureReport {
    std::string format;  ///< "XAdES-BASELINE-B", "XMLDSig", "PAdES-BASELINE-B", "adbe.pkcs7.detached"
    std::string signer;  ///< subject of the certificate
    std::string issuer;
    std::vector<std::string> signer_names;  ///< CN, O and OU of the subject, one by one
    std::string signing_time;               ///< as claimed in the signature, RFC 3339; "" where it claims none
    std::string algorithm;
    bool valid = false;                     ///< every check passed
    std::vector<std::string> covers;        ///< what was signed: "whole document without the signature", bytes …
    std::vector<std::string> not_covered;   ///< what was not
    std::vector<gum::Diagnostic> findings;  ///< GC-SIGN-01xx, error where it makes the signature invalid
};

/// Whom a reader trusts, and whose certificates were withdrawn.
struct TrustedMaterial {
    // Implicit: trusted certificates are all that most callers have.
    TrustedMaterial(std::vector<Bytes> trusted = {},
                    std::vector<Bytes> revoked = {})  // NOLINT(google-explicit-constructor)
        : certificates(std::move(trusted)), revocation_lists(std::move(revoked)) {}

    std::vector<Bytes> certificates;      ///< DER; trusted as roots (or by themselves)
    std::vector<Bytes> revocation_lists;  ///< DER; none: revocation is not checked, which is said
};

struct Verification {
    std::string kind;  ///< "dcc" or "pdf"
    std::vector<SignatureReport> signatures;
    std::vector<SignatureReport> attachment_signatures;  ///< of a DCC inside of a PDF
    bool valid = false;                                  ///< at least one signature, and all are valid
    std::vector<Bytes> attachments;                      ///< XML documents inside of a PDF
    std::string pdf_keywords;                            ///< of the PDF: this program puts the number there; "" without
};

/// \param now      seconds since 1970-01-01 UTC: used where a signature claims no time, and for claims in the future
/// \throws gum::InputError  if the file is neither an XML document nor a PDF
/// Example: examples/api/records.cpp
[[nodiscard]] Verification verify_signatures(const Bytes& file, const std::string& name, const TrustedMaterial& trusted,
                                             std::int64_t now);

/// Certificates of a trust store: a PEM file, or a folder of them.
/// \throws gum::StorageError, gum::InputError
[[nodiscard]] std::vector<Bytes> read_trust_store(const std::filesystem::path& store);

/// Lists of revoked certificates of a file: PEM with one or several, or DER with one.
/// \return in DER
/// \throws gum::StorageError, gum::InputError  GC-SIGN-0053 if there is none in it
[[nodiscard]] std::vector<Bytes> read_revocation_lists(const std::filesystem::path& file);

}  // namespace gumcert::signing
