#pragma once

#include <openssl/cms.h>
#include <openssl/ocsp.h>
#include <openssl/ts.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/unit/signing/test_keys.h"

// What may come along with a signature without being covered by it, genuine and not.

namespace gumcert::signing::test {

/// What somebody would have readers believe.
inline const std::string k_sentence =
    "This certificate was withdrawn on 28 November 2026 and the true length is 51 mm with U = 1 nm";

inline Identity authority_named(const std::string& name, const Identity* issuer = nullptr) {
    return make_identity(ec_key(), {.name = name, .key_usage = "critical,keyCertSign", .authority = true}, issuer);
}

template <class Value, class Encode>
Bytes encoded(Value* value, Encode encode) {
    unsigned char* data = nullptr;
    const int size = encode(value, &data);
    Bytes bytes(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
    OPENSSL_free(data);
    return bytes;
}

/// A time stamp by a service, of nothing in particular.
inline Bytes time_stamp(const Identity& service) {
    TS_TST_INFO* const info = TS_TST_INFO_new();
    TS_TST_INFO_set_version(info, 1);
    ASN1_OBJECT* const policy = OBJ_txt2obj("1.2.3.4", 1);
    TS_TST_INFO_set_policy_id(info, policy);
    TS_MSG_IMPRINT* const imprint = TS_MSG_IMPRINT_new();
    X509_ALGOR* const algorithm = X509_ALGOR_new();
    X509_ALGOR_set_md(algorithm, EVP_sha256());
    TS_MSG_IMPRINT_set_algo(imprint, algorithm);
    std::string digest(32, 'd');
    TS_MSG_IMPRINT_set_msg(imprint, reinterpret_cast<unsigned char*>(digest.data()), 32);
    TS_TST_INFO_set_msg_imprint(info, imprint);
    ASN1_INTEGER* const serial = ASN1_INTEGER_new();
    ASN1_INTEGER_set(serial, 7);
    TS_TST_INFO_set_serial(info, serial);
    ASN1_GENERALIZEDTIME* const time = ASN1_GENERALIZEDTIME_set(nullptr, k_signing_time);
    TS_TST_INFO_set_time(info, time);
    const Bytes content = encoded(info, i2d_TS_TST_INFO);
    BIO* const in = BIO_new_mem_buf(content.data(), static_cast<int>(content.size()));
    CMS_ContentInfo* const cms = CMS_sign(nullptr, nullptr, nullptr, nullptr, CMS_PARTIAL | CMS_BINARY);
    CMS_set1_eContentType(cms, OBJ_nid2obj(NID_id_smime_ct_TSTInfo));
    CMS_add1_signer(cms, service.certificate.get(), service.key.get(), EVP_sha256(), CMS_BINARY);
    EXPECT_EQ(CMS_final(cms, in, nullptr, CMS_BINARY), 1);
    const Bytes stamp = encoded(cms, i2d_CMS_ContentInfo);
    CMS_ContentInfo_free(cms);
    BIO_free(in);
    ASN1_GENERALIZEDTIME_free(time);
    ASN1_INTEGER_free(serial);
    X509_ALGOR_free(algorithm);
    TS_MSG_IMPRINT_free(imprint);
    ASN1_OBJECT_free(policy);
    TS_TST_INFO_free(info);
    return stamp;
}

/// What a revocation service says of a certificate, with the certificate of the service in it.
inline Bytes revocation_answer(const Identity& asked, const Identity& issuer, const Identity& service) {
    OCSP_BASICRESP* const basic = OCSP_BASICRESP_new();
    OCSP_CERTID* const id = OCSP_cert_to_id(EVP_sha256(), asked.certificate.get(), issuer.certificate.get());
    ASN1_TIME* const time = ASN1_TIME_set(nullptr, k_signing_time);
    OCSP_basic_add1_status(basic, id, V_OCSP_CERTSTATUS_GOOD, 0, nullptr, time, time);
    EXPECT_EQ(OCSP_basic_sign(basic, service.certificate.get(), service.key.get(), EVP_sha256(), nullptr, 0), 1);
    OCSP_RESPONSE* const answer = OCSP_response_create(OCSP_RESPONSE_STATUS_SUCCESSFUL, basic);
    const Bytes bytes = encoded(answer, i2d_OCSP_RESPONSE);
    OCSP_RESPONSE_free(answer);
    ASN1_TIME_free(time);
    OCSP_CERTID_free(id);
    OCSP_BASICRESP_free(basic);
    return bytes;
}

/// Certificates that are none of the signer's issuers; each with a text of its maker's choice in it.
inline std::vector<Bytes> foreign_certificates(const Laboratory& laboratory) {
    const Identity stranger = authority_named(k_sentence.substr(0, 60));
    const Identity of_stranger = make_identity(ec_key(), {.name = "U is 1 nm"}, &stranger);
    // Name and key of the genuine issuer are public. Only its own signature cannot be made.
    const Identity with_genuine_key =
        make_identity(laboratory.root.key,
                      {.name = "Example Root", .key_usage = "critical,keyCertSign", .authority = true}, &stranger);
    const Identity with_genuine_name = authority_named("Example Root");
    return {der(stranger), der(of_stranger), der(with_genuine_key), der(with_genuine_name)};
}

}  // namespace gumcert::signing::test
