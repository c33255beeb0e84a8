#pragma once

#include <string>
#include <vector>

#include "issuing/document_identity.h"
#include "signing/verify.h"

namespace gumcert::issuing {

/// What the verification of a file found, in lines of English: whether it is valid, whose document it is, and of each
/// signature who signed, when, and what it covers.
[[nodiscard]] std::string verification_text(const std::string& file, const signing::Verification& verification,
                                            const std::vector<DocumentIdentity>& identities);

}  // namespace gumcert::issuing
