#pragma once

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "signing/verify.h"

namespace gumcert::issuing {

/// Whose document it is, as the digital certificate says: the file itself, or what is attached to a PDF. "" where it
/// does not say.
struct DocumentIdentity {
    std::string number, laboratory, item, performed_from, performed_to, issued;
    std::string state;      ///< "draft", "specimen", "superseded document", ""
    bool attached = false;  ///< it is the one inside of a PDF
};

/// The digital certificates in a file; those that cannot be read are left out.
[[nodiscard]] std::vector<DocumentIdentity> identities_in(const signing::Bytes& file, const std::string& name,
                                                          const signing::Verification& verification);

/// What a person should look at although the signatures fit: GC-SIGN-0150 the signer is not the laboratory, -0151 the
/// PDF was signed by another than the digital certificate in it, -0152 the two have different numbers, -0153 dates that
/// contradict each other or the time of signing, -0154 a signed draft or specimen. All are warnings: a name is not
/// compared by the letter, and a laboratory may have good reasons.
[[nodiscard]] std::vector<gum::Diagnostic> doubts_about(const std::string& name,
                                                        const std::vector<DocumentIdentity>& identities,
                                                        const signing::Verification& verification);

}  // namespace gumcert::issuing
