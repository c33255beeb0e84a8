#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "signing/openssl_handles.h"
#include "signing/verify.h"

namespace gumcert::signing {

/// Signatures of an XML document. \throws gum::InputError  as parse_xml()
[[nodiscard]] std::vector<SignatureReport> verify_xml(const Bytes& xml, const std::string& name,
                                                      const std::vector<Bytes>& trusted, std::int64_t now);

/// Signatures of a PDF and of the digital certificates attached to it; `kind` and `valid` are left to the caller.
/// \throws gum::InputError  GC-SIGN-0052 if it cannot be read
[[nodiscard]] Verification verify_pdf(const Bytes& pdf, const std::string& name, const std::vector<Bytes>& trusted,
                                      std::int64_t now);

/// Adds a finding that makes the signature invalid.
void add_error(SignatureReport& report, const char* code, const std::string& where, const std::string& what,
               const char* rule, const char* action);

/// Checks chain and times for a signature whose value fits its certificate, and fills in signer, issuer and findings.
/// \param chain         the signer's certificate first
/// \param claimed_time  "" where the signature claims none
void check_signer(SignatureReport& report, const std::string& where, const std::vector<CertificateHandle>& chain,
                  const std::vector<Bytes>& trusted, const std::string& claimed_time, std::int64_t now);

/// Sets `valid`: no finding of severity error.
void conclude(SignatureReport& report);

}  // namespace gumcert::signing
