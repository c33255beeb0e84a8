#pragma once

#include <filesystem>
#include <string>

#include "signing/signer.h"

namespace gumcert::signing {

/// A signature without a certificate (RFC 8032), of heads of an archive.
struct Ed25519Signature {
    Bytes public_key;  ///< 32 bytes
    Bytes value;       ///< 64 bytes
};

/// \param key  PEM file with a private key of kind Ed25519, as `openssl genpkey -algorithm ed25519` makes it
/// \throws gum::StorageError, gum::InputError  GC-SIGN-0010, -0060
[[nodiscard]] Ed25519Signature sign_ed25519(const Bytes& message, const std::filesystem::path& key);

/// Whether a signature is of this message and key.
[[nodiscard]] bool is_signed_ed25519(const Bytes& message, const Ed25519Signature& signature);

/// The key of a PEM file with a public key of kind Ed25519, 32 bytes.
/// \throws gum::StorageError, gum::InputError  GC-SIGN-0010, -0060
[[nodiscard]] Bytes ed25519_public_key(const std::filesystem::path& file);

}  // namespace gumcert::signing
