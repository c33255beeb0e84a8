#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "signing/openssl_handles.h"
#include "signing/signer.h"
#include "signing/verify.h"

namespace gumcert::signing {

/// \return none if the bytes are not one certificate in DER
[[nodiscard]] CertificateHandle certificate_from_der(const Bytes& der);

/// All certificates of a PEM text, in DER. Other blocks are passed over.
[[nodiscard]] std::vector<Bytes> certificates_from_pem(const std::string& pem);

/// Names as RFC 2253 writes them: "CN=…,O=…".
[[nodiscard]] std::string subject_of(X509* certificate);
[[nodiscard]] std::string issuer_of(X509* certificate);
/// Its serial number as XML signatures write it, decimal.
[[nodiscard]] std::string serial_of(X509* certificate);

/// CN, O and OU of the subject as UTF-8, each by itself.
[[nodiscard]] std::vector<std::string> names_of(X509* certificate);

/// Why a key is too weak or of a kind that is not accepted; "" where it is accepted: RSA from 2048 bits, ECDSA with
/// P-256, P-384 or P-521.
[[nodiscard]] std::string weakness_of_key(X509* certificate);

/// "RSA" or "ECDSA"; "" for another kind of key.
[[nodiscard]] std::string kind_of_key(X509* certificate);

/// Why a certificate is not one that signs documents; "" where it is. Such a one
/// - may not issue certificates: no CA:TRUE, or a key usage without keyCertSign (RFC 5280, 4.2.1.9),
/// - has digitalSignature or nonRepudiation where it states its key usage (RFC 5280, 4.2.1.3),
/// - is for documents (RFC 9336), e-mail, anything, or for the log-in of a client that is no web server, where it
/// states
///   its extended key usage (RFC 5280, 4.2.1.12).
[[nodiscard]] std::string unfitness_for_documents(X509* certificate);

/// Bytes of one coordinate of the curve: 32, 48 or 66; 0 for a key of another kind.
[[nodiscard]] std::size_t ecdsa_part_size(X509* certificate);

/// Whether the key of the certificate verifies the signature of a digest.
/// \param digest_name  as for digest()
/// \param signature  ECDSA: DER of r and s
[[nodiscard]] bool verifies(X509* certificate, const char* digest_name, const Bytes& digest, const Bytes& signature);

/// Whether a certificate leads to a trusted one, was in force at `time`, and may sign documents.
///
/// Chain by X509_verify_cert of OpenSSL at security level 2 (RFC 5280, clause 6, without revocation: no list or service
/// is asked). A trusted certificate need not be a root: it is trusted by itself.
/// \param chain    the signer's certificate first, then what came with the signature
/// \param trusted  DER
/// \param time     of signing, seconds since 1970-01-01 UTC
/// \return findings GC-SIGN-0130 to 0133; none: accepted
[[nodiscard]] std::vector<gum::Diagnostic> check_chain(const std::string& where,
                                                       const std::vector<CertificateHandle>& chain,
                                                       const std::vector<Bytes>& trusted, std::int64_t time);

/// Why the signature that a certificate bears cannot be relied on: "SHA-1", "MD5" …; "" where it can, or where the
/// certificate is signed by itself and so a matter of trust alone.
[[nodiscard]] std::string weakness_of_issue(X509* certificate);

/// Lists of revoked certificates in PEM or DER, as DER.
[[nodiscard]] std::vector<Bytes> revocation_lists_from(const Bytes& file);

/// What lists of revoked certificates say of the certificates of a chain (RFC 5280, clause 5). A list counts where the
/// issuer of the certificate has signed it. A signature by a revoked certificate is not valid whatever time it claims,
/// for that is the signer's own statement.
/// \return GC-SIGN-0137 revoked (error), -0138 a list that is out of date (warning), -0139 checked, and not revoked
///         (note); none where no list is of the issuer
[[nodiscard]] std::vector<gum::Diagnostic> check_revocation(const std::string& where,
                                                            const std::vector<CertificateHandle>& chain,
                                                            const TrustedMaterial& trusted, std::int64_t now);

/// End of validity, seconds since 1970-01-01 UTC; none if it cannot be read.
[[nodiscard]] std::optional<std::int64_t> end_of_validity(X509* certificate);
[[nodiscard]] std::optional<std::int64_t> start_of_validity(X509* certificate);

}  // namespace gumcert::signing
