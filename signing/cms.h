#pragma once

#include <string_view>

#include "signing/signer.h"

namespace gumcert::signing {

/// A detached CMS signature as PAdES wants it (ETSI EN 319 122-1, baseline B within PDF: attributes content-type,
/// message-digest and signing-certificate-v2, no signing-time), DER.
/// \param data_digest  SHA-256 of what is signed
/// \throws gum::StorageError  as Signer::sign_sha256()
[[nodiscard]] Bytes detached_cms(const Bytes& data_digest, const Signer& signer);

}  // namespace gumcert::signing
