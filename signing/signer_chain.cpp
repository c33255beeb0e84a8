#include "signing/signer_chain.h"

#include <openssl/cms.h>
#include <openssl/err.h>
#include <openssl/ocsp.h>
#include <openssl/ts.h>

#include <algorithm>
#include <iterator>
#include <memory>

namespace gumcert::signing {

namespace {

struct ValueFree {
    void operator()(OCSP_RESPONSE* p) const { OCSP_RESPONSE_free(p); }
    void operator()(OCSP_BASICRESP* p) const { OCSP_BASICRESP_free(p); }
    void operator()(TS_TST_INFO* p) const { TS_TST_INFO_free(p); }
    void operator()(X509_CRL* p) const { X509_CRL_free(p); }
    void operator()(CMS_ContentInfo* p) const { CMS_ContentInfo_free(p); }
};

/// Whether the one certificate bears a signature by the key, and the name, of the other.
bool has_issued(X509* issuer, X509* certificate) {
    if (X509_NAME_cmp(X509_get_subject_name(issuer), X509_get_issuer_name(certificate)) != 0) {
        return false;
    }
    EVP_PKEY* key = X509_get0_pubkey(issuer);
    const bool fits = key != nullptr && X509_verify(certificate, key) == 1;
    ERR_clear_error();
    return fits;
}

bool contains(const std::vector<X509*>& certificates, X509* certificate) {
    return std::any_of(certificates.begin(), certificates.end(),
                       [&](X509* one) { return X509_cmp(one, certificate) == 0; });
}

bool one_has_issued(const std::vector<X509*>& issuers, X509* certificate) {
    return std::any_of(issuers.begin(), issuers.end(), [&](X509* one) { return has_issued(one, certificate); });
}

bool has_issued_one(X509* issuer, const std::vector<X509*>& certificates) {
    return std::any_of(certificates.begin(), certificates.end(), [&](X509* one) { return has_issued(issuer, one); });
}

/// Takes over what a condition lets in, until nothing more comes.
template <class Condition>
void take_over(std::vector<X509*>& from, std::vector<X509*>& into, Condition condition) {
    for (bool again = true; again;) {
        const auto found = std::find_if(from.begin(), from.end(), condition);
        again = found != from.end();
        if (again) {
            into.push_back(*found);
            from.erase(found);
        }
    }
}

/// \return none where the bytes are not one value, or are followed by others
template <class Value>
std::unique_ptr<Value, ValueFree> whole_value(const Bytes& der, Value* (*read)(Value**, const unsigned char**, long)) {
    const auto* at = reinterpret_cast<const unsigned char*>(der.data());
    const auto* const end = at + der.size();
    std::unique_ptr<Value, ValueFree> value(read(nullptr, &at, static_cast<long>(der.size())));
    ERR_clear_error();
    return at == end ? std::move(value) : nullptr;
}

bool is_answer_of(OCSP_BASICRESP* basic, const std::vector<X509*>& issuers) {
    if (basic == nullptr) {
        return false;
    }
    const STACK_OF(X509)* brought = OCSP_resp_get0_certs(basic);
    for (int i = 0; i < sk_X509_num(brought); ++i) {
        X509* const one = sk_X509_value(brought, i);
        if (!contains(issuers, one) && !one_has_issued(issuers, one)) {
            return false;
        }
    }
    const Handle<STACK_OF(X509)> known(sk_X509_new_null());
    for (X509* const issuer : issuers) {
        sk_X509_push(known.get(), issuer);
    }
    // The one who answers is looked up among these and those that it brings, for all of whom an issuer vouches.
    const bool fits = OCSP_basic_verify(basic, known.get(), nullptr, OCSP_NOVERIFY) == 1;
    ERR_clear_error();
    return fits;
}

}  // namespace

SignerChain::SignerChain(const std::vector<CertificateHandle>& brought, const std::vector<Bytes>& trusted)
    : signer_(brought.front().get()) {
    std::vector<X509*> others;
    for (const CertificateHandle& one : brought) {
        if (X509_cmp(one.get(), signer_) != 0 && !contains(others, one.get())) {
            others.push_back(one.get());
        }
    }
    for (const Bytes& der : trusted) {
        if (CertificateHandle one = certificate_from_der(der); one != nullptr) {
            trusted_.push_back(std::move(one));
            issuers_.push_back(trusted_.back().get());
        }
    }
    // First those of whom the trust store is sure, downwards: trusted themselves, or issued by one that is.
    std::vector<X509*> sure;
    take_over(others, sure, [&](X509* one) {
        return contains(issuers_, one) || one_has_issued(issuers_, one) || one_has_issued(sure, one);
    });
    // Of these, the ones that have issued another one of the chain.
    std::vector<X509*> chain{signer_};
    take_over(sure, chain, [&](X509* one) { return has_issued_one(one, chain); });
    // What is trusted may have issued one of the chain without coming along.
    std::vector<X509*> all_trusted = issuers_;
    std::vector<X509*> vouching;
    take_over(all_trusted, vouching,
              [&](X509* one) { return has_issued_one(one, chain) || has_issued_one(one, vouching); });
    // Upwards: a root that has signed itself and one of these. Its content is genuine, for its key has signed both.
    const auto has_issued_one_here = [&](X509* one) {
        return has_issued_one(one, chain) || has_issued_one(one, vouching);
    };
    take_over(others, chain, [&](X509* one) { return has_issued(one, one) && has_issued_one_here(one); });
    proven_ = chain;
    const bool is_complete = one_has_issued(issuers_, signer_) || one_has_issued(chain, signer_);
    // Where nothing that is trusted has issued the signer, what leads upwards may be genuine; where something has, what lies
    // above it, but not another certificate of its name and key, which anybody can make.
    const auto stands_for = [](const X509* one) {
        return [one](const X509* known) {
            return X509_NAME_cmp(X509_get_subject_name(one), X509_get_subject_name(known)) == 0 &&
                   EVP_PKEY_eq(X509_get0_pubkey(one), X509_get0_pubkey(known)) == 1;
        };
    };
    take_over(others, chain, [&](X509* one) {
        return has_issued_one_here(one) &&
               (!is_complete || (std::none_of(issuers_.begin(), issuers_.end(), stands_for(one)) &&
                                 std::none_of(proven_.begin(), proven_.end(), stands_for(one))));
    });
    // An authority has its certificate renewed with the same key: the older one says of itself and its issuer what the other
    // one does. Nothing leads on from it.
    std::vector<X509*> renewed;
    take_over(others, renewed, [&](X509* one) {
        const auto is_same = [&](const X509* known) {
            return stands_for(one)(known) && X509_NAME_cmp(X509_get_issuer_name(one), X509_get_issuer_name(known)) == 0;
        };
        return has_issued_one(one, chain) && (std::any_of(vouching.begin(), vouching.end(), is_same) ||
                                              std::any_of(proven_.begin(), proven_.end(), is_same));
    });
    unproven_.assign(chain.begin() + static_cast<std::ptrdiff_t>(proven_.size()), chain.end());
    unproven_.insert(unproven_.end(), renewed.begin(), renewed.end());
    foreign_ = std::move(sure);
    foreign_.insert(foreign_.end(), others.begin(), others.end());
    // Of those for whom nobody vouches, too: what they have signed is told as not covered, as they are.
    std::copy_if(chain.begin(), chain.end(), std::back_inserter(issuers_), has_issued_one_here);
}

bool is_revocation_list_of(const Bytes& der, const std::vector<X509*>& issuers) {
    const auto list = whole_value<X509_CRL>(der, d2i_X509_CRL);
    const bool fits = list != nullptr && std::any_of(issuers.begin(), issuers.end(), [&](X509* issuer) {
                          EVP_PKEY* key = X509_get0_pubkey(issuer);
                          return key != nullptr &&
                                 X509_NAME_cmp(X509_CRL_get_issuer(list.get()), X509_get_subject_name(issuer)) == 0 &&
                                 X509_CRL_verify(list.get(), key) == 1;
                      });
    ERR_clear_error();
    return fits;
}

bool is_revocation_answer_of(const Bytes& der, const std::vector<X509*>& issuers) {
    const auto answer = whole_value<OCSP_RESPONSE>(der, d2i_OCSP_RESPONSE);
    if (answer == nullptr || OCSP_response_status(answer.get()) != OCSP_RESPONSE_STATUS_SUCCESSFUL) {
        return false;
    }
    const std::unique_ptr<OCSP_BASICRESP, ValueFree> basic(OCSP_response_get1_basic(answer.get()));
    ERR_clear_error();
    return is_answer_of(basic.get(), issuers);
}

bool is_basic_revocation_answer_of(const Bytes& der, const std::vector<X509*>& issuers) {
    return is_answer_of(whole_value<OCSP_BASICRESP>(der, d2i_OCSP_BASICRESP).get(), issuers);
}

bool is_time_stamp(const Bytes& der) {
    const auto cms = whole_value<CMS_ContentInfo>(der, d2i_CMS_ContentInfo);
    if (cms == nullptr || OBJ_obj2nid(CMS_get0_type(cms.get())) != NID_pkcs7_signed ||
        OBJ_obj2nid(CMS_get0_eContentType(cms.get())) != NID_id_smime_ct_TSTInfo) {
        return false;
    }
    ASN1_OCTET_STRING** const content = CMS_get0_content(cms.get());
    if (content == nullptr || *content == nullptr) {
        return false;
    }
    const Bytes stated(reinterpret_cast<const char*>(ASN1_STRING_get0_data(*content)),
                       static_cast<std::size_t>(ASN1_STRING_length(*content)));
    return whole_value<TS_TST_INFO>(stated, d2i_TS_TST_INFO) != nullptr;
}

}  // namespace gumcert::signing
