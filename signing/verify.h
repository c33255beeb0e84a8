#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "signing/signer.h"

namespace gumcert::signing {

/// What was found about one signature.
struct SignatureReport {
    std::string format;  ///< "XAdES-BASELINE-B", "XMLDSig", "PAdES-BASELINE-B", "adbe.pkcs7.detached"
    std::string signer;  ///< subject of the certificate
    std::string issuer;
    std::string signing_time;  ///< as claimed in the signature, RFC 3339; "" where it claims none
    std::string algorithm;
    bool valid = false;                     ///< every check passed
    std::vector<std::string> covers;        ///< what was signed: "whole document without the signature", bytes …
    std::vector<std::string> not_covered;   ///< what was not
    std::vector<gum::Diagnostic> findings;  ///< GC-SIGN-01xx, error where it makes the signature invalid
};

struct Verification {
    std::string kind;  ///< "dcc" or "pdf"
    std::vector<SignatureReport> signatures;
    std::vector<SignatureReport> attachment_signatures;  ///< of a DCC inside of a PDF
    bool valid = false;                                  ///< at least one signature, and all are valid
};

/// \param trusted  certificates in DER that are trusted as roots (or by themselves)
/// \param now      seconds since 1970-01-01 UTC: used where a signature claims no time, and for claims in the future
/// \throws gum::InputError  if the file is neither an XML document nor a PDF
[[nodiscard]] Verification verify_signatures(const Bytes& file, const std::string& name,
                                             const std::vector<Bytes>& trusted, std::int64_t now);

/// Certificates of a trust store: a PEM file, or a folder of them.
/// \throws gum::StorageError, gum::InputError
[[nodiscard]] std::vector<Bytes> read_trust_store(const std::filesystem::path& store);

}  // namespace gumcert::signing
