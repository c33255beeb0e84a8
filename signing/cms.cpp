#include "signing/cms.h"
#include "encoding/sha2.h"

#include <openssl/cms.h>
#include <openssl/err.h>
#include <openssl/objects.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "signing/certificates.h"
#include "signing/checked_signature.h"
#include "signing/openssl_handles.h"
#include "signing/time_texts.h"

namespace gumcert::signing {

namespace {

void require(bool done, const char* step) {
    if (!done) {
        ERR_clear_error();
        throw std::runtime_error(std::string("OpenSSL could not build the CMS signature: ") + step);
    }
}

/// DER of a length (X.690, 8.1.3).
Bytes der_length(std::size_t size) {
    if (size < 128) {
        return {static_cast<char>(size)};
    }
    Bytes digits;
    for (std::size_t rest = size; rest != 0; rest >>= 8U) {
        digits.insert(digits.begin(), static_cast<char>(rest & 255U));
    }
    return static_cast<char>(0x80U | digits.size()) + digits;
}

/// What the signer signs: the attributes as SET OF in DER, in the order of their encodings (RFC 5652, 5.4).
Bytes signed_attributes(CMS_SignerInfo* info) {
    std::vector<Bytes> encoded;
    for (int i = 0; i < CMS_signed_get_attr_count(info); ++i) {
        unsigned char* der = nullptr;
        const int size = i2d_X509_ATTRIBUTE(CMS_signed_get_attr(info, i), &der);
        require(size > 0, "attribute");
        encoded.emplace_back(reinterpret_cast<const char*>(der), static_cast<std::size_t>(size));
        OPENSSL_free(der);
    }
    // Octets count as unsigned numbers.
    // The order is part of what is signed. A verifying program encodes the attributes again and takes the digest of
    // that, so another order would give another digest.
    std::sort(encoded.begin(), encoded.end(), [](const Bytes& a, const Bytes& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
            return static_cast<unsigned char>(x) < static_cast<unsigned char>(y);
        });
    });
    Bytes all;
    for (const Bytes& one : encoded) {
        all += one;
    }
    constexpr char k_set = 0x31;
    return k_set + der_length(all.size()) + all;
}

}  // namespace

Bytes detached_cms(const Bytes& data_digest, const Signer& signer) {
    const CertificateHandle own = certificate_from_der(signer.certificates().at(0));
    std::vector<CertificateHandle> issuers;
    const Handle<STACK_OF(X509)> others(sk_X509_new_null());
    for (std::size_t i = 1; i < signer.certificates().size(); ++i) {
        issuers.push_back(certificate_from_der(signer.certificates()[i]));
        require(issuers.back() != nullptr && sk_X509_push(others.get(), issuers.back().get()) > 0, "certificates");
    }
    constexpr unsigned k_flags = CMS_PARTIAL | CMS_DETACHED | CMS_BINARY | CMS_NOSMIMECAP;
    const Handle<CMS_ContentInfo> cms(CMS_sign(nullptr, nullptr, others.get(), nullptr, k_flags));
    require(cms != nullptr, "frame");
    // The key is with the signer, perhaps in a card. OpenSSL gets the public key, which is enough to build everything
    // but the value of the signature.
    CMS_SignerInfo* info =
        CMS_add1_signer(cms.get(), own.get(), X509_get0_pubkey(own.get()), EVP_sha256(), k_flags | CMS_CADES);
    require(info != nullptr, "signer");
    require(
        CMS_signed_add1_attr_by_NID(info, NID_pkcs9_contentType, V_ASN1_OBJECT, OBJ_nid2obj(NID_pkcs7_data), -1) == 1 &&
            CMS_signed_add1_attr_by_NID(info, NID_pkcs9_messageDigest, V_ASN1_OCTET_STRING, data_digest.data(),
                                        static_cast<int>(data_digest.size())) == 1,
        "attributes");
    // What is signed is not the digest of the document but that of the attributes, among which the digest of the
    // document stands (RFC 5652, 5.4). There is no signing-time among them: at the baseline levels of ETSI EN 319 142-1
    // the time stands in /M of the dictionary, which is within the signed bytes.
    const Bytes value = checked_signature(signer, encoding::sha256_bytes(signed_attributes(info)));
    require(
        ASN1_OCTET_STRING_set(CMS_SignerInfo_get0_signature(info), reinterpret_cast<const unsigned char*>(value.data()),
                              static_cast<int>(value.size())) == 1,
        "value");
    unsigned char* der = nullptr;
    const int size = i2d_CMS_ContentInfo(cms.get(), &der);
    require(size > 0, "encoding");
    Bytes bytes(reinterpret_cast<const char*>(der), static_cast<std::size_t>(size));
    OPENSSL_free(der);
    return bytes;
}

}  // namespace gumcert::signing
