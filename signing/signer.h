#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::signing {

using Bytes = std::string;

/// Who signs: a certificate chain in public, and something that makes a signature value of a hash. Keys may sit in a
/// file, a card, a security module or a remote service; nothing else of the program sees them.
class Signer {
public:
    virtual ~Signer() = default;
    /// DER, the signer's own certificate first.
    [[nodiscard]] virtual const std::vector<Bytes>& certificates() const = 0;
    /// "RSA" (PKCS #1 v1.5) or "ECDSA".
    [[nodiscard]] virtual std::string algorithm() const = 0;
    /// \param digest  SHA-256, 32 bytes
    /// \return RSA: the signature; ECDSA: DER of r and s
    /// \throws gum::StorageError  GC-SIGN-00xx if it cannot be made
    [[nodiscard]] virtual Bytes sign_sha256(const Bytes& digest) const = 0;
};

/// Key and certificate chain in PEM files.
/// \throws gum::InputError, gum::StorageError  GC-SIGN-00xx
[[nodiscard]] std::unique_ptr<Signer> signer_from_files(const std::filesystem::path& key,
                                                        const std::filesystem::path& certificates,
                                                        const std::string& passphrase = {});

/// An external program, for cards and remote services: it is started without a shell with the words of `command`, gets
/// the digest in hexadecimal and a line feed on standard input, and answers with the signature in Base64.
[[nodiscard]] std::unique_ptr<Signer> signer_from_command(const std::vector<std::string>& command,
                                                          const std::filesystem::path& certificates,
                                                          std::chrono::seconds time_limit = std::chrono::seconds(60));

/// A signer description, JSON: {"certificates": "chain.pem", "key": "key.pem"} or {"certificates": …, "command": [..]};
/// names relative to the file.
[[nodiscard]] std::unique_ptr<Signer> signer_from_description(const std::filesystem::path& file);

/// The same with what the caller must know of it.
struct DescribedSigner {
    std::unique_ptr<Signer> signer;
    std::vector<std::filesystem::path> files;  ///< the description and every file that it names: never to be written
    std::vector<gum::Diagnostic> warnings;     ///< GC-SIGN-0029 a key or passphrase that others may read or write
};
[[nodiscard]] DescribedSigner described_signer(const std::filesystem::path& file);

/// What the receiver of a document checks, as far as it can be done without his trust store: the signer's
/// certificate leads to the last one of its own file by the rules of verification, at the time of signing, and the file
/// holds no others. Asked before a document is signed: a signature that can never verify is not made.
/// \throws gum::InputError  GC-SIGN-0023
void require_a_chain(const Signer& signer, std::int64_t signing_time);

/// Signs a DCC: XAdES-BASELINE-B, enveloped, exclusive canonicalisation, SHA-256 (ETSI EN 319 132-1).
/// \param signing_time  seconds since 1970-01-01 UTC; the caller reads the clock
/// \throws gum::InputError  if the bytes are not a DCC of 3.2 or later, or are signed already
[[nodiscard]] Bytes sign_dcc(const Bytes& dcc, const Signer& signer, std::int64_t signing_time);

/// Signs a PDF: PAdES-BASELINE-B, SubFilter ETSI.CAdES.detached, one invisible field (ETSI EN 319 142-1).
[[nodiscard]] Bytes sign_pdf(const Bytes& pdf, const Signer& signer, std::int64_t signing_time);

}  // namespace gumcert::signing
