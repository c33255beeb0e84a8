#pragma once

#include <openssl/cms.h>

#include <string>
#include <vector>

#include "signing/signer_chain.h"

namespace gumcert::signing {

/// What a CMS signature holds beside what its value covers, which are the document and the signed attributes.
struct CmsParts {
    std::string foreign;               ///< the first part that is none of a signature's, in words; "" without
    std::vector<std::string> brought;  ///< what may stand there and does, in words, each once
};

/// Looks at every part of a signature with one signer (RFC 5652, 5.1 and 5.3). There may be
/// - the digest algorithms of the allow-list, and no parameters of algorithms,
/// - certificates of X.509, which SignerChain looks at,
/// - lists of revoked certificates and answers of revocation services, by the issuers of the signer,
/// - unsigned attributes: time stamps (signature-time-stamp) and revocation-values (RFC 5126, 6.1.1 and 6.3.4).
[[nodiscard]] CmsParts cms_parts(CMS_ContentInfo* cms, const SignerChain& chain);

}  // namespace gumcert::signing
