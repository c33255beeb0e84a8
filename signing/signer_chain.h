#pragma once

#include <string>
#include <vector>

#include "signing/certificates.h"
#include "signing/openssl_handles.h"
#include "signing/signer.h"

namespace gumcert::signing {

/// The certificates that a signature brings, sorted by what they have to do with its signer. Nothing of what a signature brings is
/// covered by it, so anybody can put a certificate in, with any text in its names: only the certificates of issuers belong there.
///
/// A name and a key are public, so a certificate can be made that seems to have issued the signer's. What tells the genuine one is
/// who has signed it: a certificate of the trust store, or a key that has signed the signer's certificate too.
class SignerChain {
public:
    /// \param brought  the signer's first; they outlive this
    /// \param trusted  DER
    SignerChain(const std::vector<CertificateHandle>& brought, const std::vector<Bytes>& trusted);

    [[nodiscard]] X509* signer() const { return signer_; }
    /// The signer's certificate, and those of issuers whose content somebody vouches for; the names in them may be told.
    [[nodiscard]] const std::vector<X509*>& proven() const { return proven_; }
    /// Those whose keys have signed one of the chain, and those that are trusted: whose lists may come along.
    [[nodiscard]] const std::vector<X509*>& issuers() const { return issuers_; }
    /// Issuers of the signer whose own issuer is not known here, because only the signer, or nobody, is trusted, and other
    /// certificates of an authority that is, by the same issuer and with the same key.
    [[nodiscard]] const std::vector<X509*>& unproven() const { return unproven_; }
    /// None that has issued another one of the signer's chain, or one that only seems to.
    [[nodiscard]] const std::vector<X509*>& foreign() const { return foreign_; }

private:
    X509* signer_;
    std::vector<CertificateHandle> trusted_;
    std::vector<X509*> proven_, issuers_, unproven_, foreign_;
};

/// Whether bytes are a list of revoked certificates in DER, and nothing more, that one of these issuers has signed.
[[nodiscard]] bool is_revocation_list_of(const Bytes& der, const std::vector<X509*>& issuers);
/// The same of the answer of a revocation service (RFC 6960), whole or its basic part, that an issuer has signed or one for whom
/// an issuer vouches.
[[nodiscard]] bool is_revocation_answer_of(const Bytes& der, const std::vector<X509*>& issuers);
[[nodiscard]] bool is_basic_revocation_answer_of(const Bytes& der, const std::vector<X509*>& issuers);
/// Whether bytes are a time stamp (RFC 3161, 2.4.2) and nothing more. Who made it is not checked.
[[nodiscard]] bool is_time_stamp(const Bytes& der);

}  // namespace gumcert::signing
