#pragma once

#include <cstdint>

#include "signing/signer.h"

namespace gumcert::signing {

/// A signature of the signer that its own certificate verifies: a wrong card or key is found here, and not by the
/// customer.
/// \throws gum::StorageError  GC-SIGN-0022 if it does not fit, and what the signer throws
[[nodiscard]] Bytes checked_signature(const Signer& signer, const Bytes& digest);

/// \throws gum::InputError  GC-SIGN-0017 if the signer's certificate is not in force at the time
void require_in_force(const Signer& signer, std::int64_t signing_time);

}  // namespace gumcert::signing
