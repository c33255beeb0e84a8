#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "signing/document_limits.h"
#include "signing/openssl_handles.h"
#include "signing/verify.h"

namespace gumcert::signing {

/// What to do with a document that does not hold.
inline constexpr const char* k_ask_again = "ask the laboratory for the original document";

/// Signatures of an XML document.
/// \throws gum::InputError  as parse_xml()
[[nodiscard]] std::vector<SignatureReport> verify_xml(const Bytes& xml, const std::string& name,
                                                      const TrustedMaterial& trusted, std::int64_t now);

/// Signatures of a PDF and of the digital certificates attached to it; `kind` and `valid` are left to the caller.
/// \throws gum::InputError  GC-SIGN-0052 if it cannot be read
[[nodiscard]] Verification verify_pdf(const Bytes& pdf, const std::string& name, const TrustedMaterial& trusted,
                                      std::int64_t now);

/// The rule for certificates that come with a signature, which nothing covers.
inline constexpr const char* k_chain_alone =
    "a signature brings the certificate of the signer and those of its issuers, 16 at most, and none besides";

/// Adds a finding that makes the signature invalid.
void add_error(SignatureReport& report, const char* code, const std::string& where, const std::string& what,
               const char* rule, const char* action);

/// Checks chain and times for a signature whose value fits its certificate, and fills in signer, issuer and findings.
/// \param chain         the signer's certificate first; GC-SIGN-0124 where another one is none of its issuers
/// \param claimed_time  "" where the signature claims none
void check_signer(SignatureReport& report, const std::string& where, const std::vector<CertificateHandle>& chain,
                  const TrustedMaterial& trusted, const std::string& claimed_time, std::int64_t now);

/// Adds a finding that leaves the signature valid.
void add_warning(SignatureReport& report, const char* code, const std::string& where, const std::string& what,
                 const char* rule, const char* action);

/// A text of a document that nobody vouches for, to be shown: what is hidden, steers a terminal or is not UTF-8 is
/// written as \u{9B} or \x{80}, so that it cannot look like a line of the program; cut after 300 characters.
[[nodiscard]] std::string shown_text(std::string_view text);

/// The texts of a report, and of messages, made fit to be shown.
void show_safely(SignatureReport& report);
void show_safely(std::vector<gum::Diagnostic>& messages);

/// Sets `valid`: no finding of severity error.
void conclude(SignatureReport& report);

}  // namespace gumcert::signing
