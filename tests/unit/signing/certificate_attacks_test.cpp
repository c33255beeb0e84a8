#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "signing/signer.h"
#include "signing/verify.h"
#include "tests/unit/signing/plain_pdf.h"
#include "tests/unit/signing/test_keys.h"

// Certificates that must not make a signature valid, in XML and in PDF alike.

namespace gumcert::signing {
namespace {

using testing::HasSubstr;
using namespace test;

const std::string k_dcc =
    "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" schemaVersion=\"3.3.0\">10.0023"
    "</dcc:digitalCalibrationCertificate>";

Identity root_named(const std::string& name) {
    return make_identity(ec_key(), {.name = name, .key_usage = "critical,keyCertSign,cRLSign", .authority = true});
}

/// The first errors of a digital certificate and a PDF; "valid" is what must not be.
std::vector<std::string> errors_with(const std::vector<Identity>& chain, const std::vector<Bytes>& trusted,
                                     const Identity* decoy = nullptr, std::int64_t signing_time = k_signing_time) {
    std::vector<std::string> errors;
    for (const bool pdf : {false, true}) {
        const CarelessSigner signer(chain.front().key, chain, decoy);
        const Bytes document =
            pdf ? sign_pdf(plain_pdf(), signer, signing_time) : sign_dcc(k_dcc, signer, signing_time);
        const Verification verification = verify_signatures(document, "certificate", trusted, k_now);
        EXPECT_EQ(verification.signatures.size(), 1U);
        errors.push_back(verification.valid ? "valid" : first_error(verification.signatures.at(0)));
    }
    return errors;
}

/// The first error of both formats, which must be the same.
std::string error_with(const std::vector<Identity>& chain, const std::vector<Bytes>& trusted,
                       const Identity* decoy = nullptr, std::int64_t signing_time = k_signing_time) {
    const std::vector<std::string> errors = errors_with(chain, trusted, decoy, signing_time);
    EXPECT_EQ(errors[0], errors[1]);
    return errors[0];
}

TEST(CertificateAttack, AGoodCertificateIsAccepted) {
    const Identity root = root_named("Example Root");
    const Identity own = make_identity(rsa_key(), {}, &root);
    EXPECT_EQ(error_with({own, root}, {der(root)}), "valid");
    EXPECT_EQ(error_with({own}, {der(root)}), "valid");
    EXPECT_EQ(error_with({own}, {der(own)}), "valid");
}

TEST(CertificateAttack, NotInForceAtTheTimeOfSigning) {
    const Identity root = root_named("Example Root");
    const Identity decoy = make_identity(ec_key());
    const Identity expired =
        make_identity(ec_key(), {.from = k_signing_time - 10 * k_day, .to = k_signing_time - k_day}, &root);
    EXPECT_EQ(error_with({expired, root}, {der(root)}, &decoy), "GC-SIGN-0133");
    const Identity early =
        make_identity(ec_key(), {.from = k_signing_time + k_day / 2, .to = k_signing_time + 9 * k_day}, &root);
    EXPECT_EQ(error_with({early, root}, {der(root)}, &decoy), "GC-SIGN-0133");
    // Trusted by itself, it must be in force all the same.
    EXPECT_EQ(error_with({expired}, {der(expired)}, &decoy), "GC-SIGN-0133");
    // The root was not in force.
    const Identity old_root = make_identity(ec_key(), {.name = "Old Root",
                                                       .key_usage = "critical,keyCertSign",
                                                       .authority = true,
                                                       .from = 0,
                                                       .to = k_signing_time - k_day});
    const Identity of_old_root = make_identity(ec_key(), {}, &old_root);
    EXPECT_EQ(error_with({of_old_root, old_root}, {der(old_root)}), "GC-SIGN-0133");
    EXPECT_EQ(error_with({make_identity(ec_key(), {}, &root)}, {der(root)}, nullptr, k_now + k_day), "GC-SIGN-0134");
}

TEST(CertificateAttack, NotForSigning) {
    const Identity root = root_named("Example Root");
    const auto with = [&](const CertificateOptions& options) {
        const Identity own = make_identity(ec_key(), options, &root);
        return error_with({own, root}, {der(root)});
    };
    EXPECT_EQ(with({.key_usage = "critical,keyEncipherment"}), "GC-SIGN-0132");
    EXPECT_EQ(with({.key_usage = "keyAgreement"}), "GC-SIGN-0132");
    EXPECT_EQ(with({.key_usage = "critical,nonRepudiation"}), "valid");
    EXPECT_EQ(with({.key_usage = ""}), "valid");
    // The key of an authority, with and without the usage that says so.
    EXPECT_EQ(with({.key_usage = "critical,keyCertSign,digitalSignature", .authority = true}), "GC-SIGN-0132");
    EXPECT_EQ(with({.key_usage = "", .authority = true}), "GC-SIGN-0132");
    EXPECT_EQ(with({.key_usage = "digitalSignature", .authority = true}), "valid");  // it cannot issue any
    EXPECT_EQ(error_with({root}, {der(root)}), "GC-SIGN-0132");
    // Web servers, programs and time-stamping services have certificates of the same authorities.
    EXPECT_EQ(with({.extended_key_usage = "serverAuth"}), "GC-SIGN-0132");
    EXPECT_EQ(with({.extended_key_usage = "codeSigning"}), "GC-SIGN-0132");
    EXPECT_EQ(with({.extended_key_usage = "critical,timeStamping"}), "GC-SIGN-0132");
    EXPECT_EQ(with({.extended_key_usage = "emailProtection,clientAuth"}), "valid");
    EXPECT_EQ(with({.extended_key_usage = "1.3.6.1.5.5.7.3.36"}), "valid");
    EXPECT_EQ(with({.extended_key_usage = "clientAuth"}), "valid");
    EXPECT_EQ(with({.extended_key_usage = "serverAuth,clientAuth"}), "GC-SIGN-0132");
    EXPECT_EQ(with({.extended_key_usage = "anyExtendedKeyUsage"}), "valid");
}

TEST(CertificateAttack, WeakKeys) {
    const Identity root = root_named("Example Root");
    const Identity small = make_identity(rsa_key(1024), {}, &root);
    EXPECT_EQ(error_with({small, root}, {der(root)}), "GC-SIGN-0131");
    EXPECT_EQ(error_with({small}, {der(small)}), "GC-SIGN-0131");
    // An authority with a weak key in between.
    const Identity weak_authority = make_identity(
        rsa_key(1024), {.name = "Weak Authority", .key_usage = "critical,keyCertSign", .authority = true}, &root);
    const Identity own = make_identity(ec_key(), {}, &weak_authority);
    EXPECT_EQ(error_with({own, weak_authority, root}, {der(root)}), "GC-SIGN-0130");
}

TEST(CertificateAttack, AChainOfOnesOwn) {
    const Identity root = root_named("Example Root");
    const Identity own = make_identity(ec_key(), {}, &root);
    // Everything is named like the trusted ones.
    const Identity same_name = root_named("Example Root");
    const Identity forged = make_identity(ec_key(), {}, &same_name);
    EXPECT_EQ(error_with({forged, same_name}, {der(root)}), "GC-SIGN-0130");
    EXPECT_EQ(error_with({forged, same_name, root}, {der(root)}), "GC-SIGN-0130");
    EXPECT_EQ(error_with({forged}, {der(root)}), "GC-SIGN-0130");
    EXPECT_EQ(error_with({make_identity(ec_key())}, {der(root), der(own)}), "GC-SIGN-0130");
    // The laboratory itself is no authority: what its key has signed is not trusted.
    const Identity of_the_laboratory = make_identity(ec_key(), {.name = "Somebody"}, &own);
    EXPECT_EQ(error_with({of_the_laboratory, own, root}, {der(root)}), "GC-SIGN-0130");
    EXPECT_EQ(error_with({of_the_laboratory, own}, {der(own)}), "GC-SIGN-0130");
    // The certificate that is trusted, beside a key that does not belong to it.
    EXPECT_EQ(error_with({forged, own, root}, {der(root)}), "GC-SIGN-0130");
    EXPECT_EQ(error_with({own, root}, {}), "GC-SIGN-0130");
}

TEST(CertificateAttack, ACertificateWithTheSameIssuerAndSerialNumber) {
    const Identity root = root_named("Example Root");
    const Identity own = make_identity(ec_key(), {}, &root);
    Identity forged = make_identity(ec_key(), {}, &root);
    X509_set_serialNumber(forged.certificate.get(), X509_get_serialNumber(own.certificate.get()));
    X509_sign(forged.certificate.get(), forged.key.get(), EVP_sha256());
    // A CMS keeps certificates in an order of its own, so the genuine one may be found first: it is not the one named.
    const auto refused = testing::AnyOf("GC-SIGN-0130", "GC-SIGN-0116");
    EXPECT_THAT(errors_with({forged, own, root}, {der(root)}), testing::Each(refused));
    EXPECT_THAT(errors_with({forged, own}, {der(own)}), testing::Each(refused));
}

/// Codes of the findings that a list of revoked certificates leads to, of a digital certificate.
std::vector<std::string> revocation_codes(const Identity& own, const Identity& root, const std::vector<Bytes>& lists,
                                          bool valid) {
    const CarelessSigner signer(own.key, {own, root});
    const Verification verification = verify_signatures(sign_dcc(k_dcc, signer, k_signing_time), "certificate.xml",
                                                        TrustedMaterial(std::vector<Bytes>{der(root)}, lists), k_now);
    EXPECT_EQ(verification.valid, valid);
    std::vector<std::string> codes;
    for (const gum::Diagnostic& finding : verification.signatures.at(0).findings) {
        if (finding.code >= "GC-SIGN-0136" && finding.code <= "GC-SIGN-0139") {
            codes.push_back(finding.code);
        }
    }
    return codes;
}

TEST(CertificateAttack, RevokedByItsIssuer) {
    using Codes = std::vector<std::string>;
    const Identity root = root_named("Example Root");
    const Identity own = make_identity(ec_key(), {}, &root);
    const Identity other = make_identity(ec_key(), {}, &root);
    EXPECT_EQ(revocation_codes(own, root, {}, true), Codes{"GC-SIGN-0136"});
    EXPECT_EQ(revocation_codes(own, root, {revocation_list(root, {})}, true), Codes{"GC-SIGN-0139"});
    EXPECT_EQ(revocation_codes(own, root, {revocation_list(root, {&other})}, true), Codes{"GC-SIGN-0139"});
    EXPECT_EQ(revocation_codes(own, root, {revocation_list(root, {&other, &own})}, false), Codes{"GC-SIGN-0137"});
    // A list that is out of date still says who was revoked, and not who was not.
    EXPECT_EQ(revocation_codes(own, root, {revocation_list(root, {}, k_now - k_day)}, true), Codes{"GC-SIGN-0138"});
    EXPECT_EQ(revocation_codes(own, root, {revocation_list(root, {&own}, k_now - k_day)}, false),
              (Codes{"GC-SIGN-0137", "GC-SIGN-0138"}));
    // Only the issuer says so, not somebody of the same name.
    const Identity impostor = root_named("Example Root");
    EXPECT_EQ(revocation_codes(own, root, {revocation_list(impostor, {&own})}, true), Codes{"GC-SIGN-0138"});
    const Identity stranger = root_named("Another Root");
    EXPECT_EQ(revocation_codes(own, root, {revocation_list(stranger, {&own})}, true), Codes{"GC-SIGN-0138"});
    EXPECT_EQ(revocation_codes(own, root, {revocation_list(stranger, {}), revocation_list(root, {&own})}, false),
              Codes{"GC-SIGN-0137"});
}

/// A list of revoked certificates with an extension, DER.
Bytes list_with(const Identity& issuer, const std::vector<const Identity*>& revoked, int nid, const char* value,
                const EVP_MD* digest = EVP_sha256()) {
    const Bytes plain = revocation_list(issuer, revoked);
    const auto* at = reinterpret_cast<const unsigned char*>(plain.data());
    X509_CRL* const list = d2i_X509_CRL(nullptr, &at, static_cast<long>(plain.size()));
    if (nid != NID_undef) {
        X509_EXTENSION* const extension = X509V3_EXT_conf_nid(nullptr, nullptr, nid, value);
        EXPECT_NE(extension, nullptr) << value;
        X509_CRL_add_ext(list, extension, -1);
        X509_EXTENSION_free(extension);
    }
    X509_CRL_sign(list, issuer.key.get(), digest);
    unsigned char* data = nullptr;
    const int size = i2d_X509_CRL(list, &data);
    Bytes bytes(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
    OPENSSL_free(data);
    X509_CRL_free(list);
    return bytes;
}

TEST(CertificateAttack, AListThatDoesNotSpeakOfTheSigner) {
    using Codes = std::vector<std::string>;
    const Identity root = root_named("Example Root");
    Identity own = make_identity(ec_key(), {}, &root);
    add_extension(own.certificate.get(), NID_crl_distribution_points, "URI:http://ca.example/1.crl");
    X509_sign(own.certificate.get(), root.key.get(), EVP_sha256());
    constexpr int k_scope = NID_issuing_distribution_point;
    struct Case {
        int nid;
        const char* value;
        bool speaks;
    };
    for (const Case& one : {Case{NID_undef, "", true},
                            {NID_crl_number, "DER:020107", true},
                            {k_scope, "critical,onlyuser:TRUE", true},
                            {k_scope, "critical,indirectCRL:TRUE", true},
                            {k_scope, "critical,fullname:URI:http://ca.example/1.crl", true},
                            {k_scope, "critical,fullname:URI:http://ca.example/1.crl,onlyuser:TRUE", true},
                            {k_scope, "critical,fullname:URI:http://ca.example/2.crl", false},
                            {k_scope, "critical,onlyCA:TRUE", false},
                            {k_scope, "critical,onlyAA:TRUE", false},
                            {k_scope, "critical,onlysomereasons:keyCompromise", false},
                            {NID_delta_crl, "critical,DER:020107", false},
                            {NID_inhibit_any_policy, "critical,3", false},
                            {NID_inhibit_any_policy, "3", true}}) {
        SCOPED_TRACE(one.value);
        const Codes expected{one.speaks ? "GC-SIGN-0139" : "GC-SIGN-0138"};
        EXPECT_EQ(revocation_codes(own, root, {list_with(root, {}, one.nid, one.value)}, true), expected);
        // A whole list beside it says what is to be said, and what is revoked is revoked by each.
        EXPECT_EQ(
            revocation_codes(own, root, {list_with(root, {}, one.nid, one.value), revocation_list(root, {})}, true),
            Codes{"GC-SIGN-0139"});
        EXPECT_EQ(revocation_codes(own, root, {list_with(root, {&own}, one.nid, one.value)}, false),
                  Codes{"GC-SIGN-0137"});
    }
    EXPECT_EQ(revocation_codes(own, root, {list_with(root, {}, NID_undef, "", EVP_sha1())}, true),
              Codes{"GC-SIGN-0138"});
    const Identity no_lists =
        make_identity(ec_key(), {.name = "No lists", .key_usage = "critical,keyCertSign", .authority = true});
    EXPECT_EQ(revocation_codes(make_identity(ec_key(), {}, &no_lists), no_lists, {revocation_list(no_lists, {})}, true),
              Codes{"GC-SIGN-0138"});
}

TEST(RevocationLists, ArePemOrDer) {
    const Identity root = root_named("Example Root");
    const Bytes list = revocation_list(root, {});
    const Folder folder;
    EXPECT_EQ(read_revocation_lists(folder.put("a.crl", list)), std::vector<Bytes>{list});
    const auto pem_of = [](const Bytes& der) {
        const auto* at = reinterpret_cast<const unsigned char*>(der.data());
        X509_CRL* const crl = d2i_X509_CRL(nullptr, &at, static_cast<long>(der.size()));
        const std::unique_ptr<BIO, FreeKey> out(BIO_new(BIO_s_mem()));
        PEM_write_bio_X509_CRL(out.get(), crl);
        X509_CRL_free(crl);
        return text_of(out.get());
    };
    EXPECT_EQ(read_revocation_lists(folder.put("b.pem", pem_of(list) + pem_of(list))).size(), 2U);
    for (const std::string& none : {std::string(), pem(root), std::string("nothing")}) {
        try {
            (void)read_revocation_lists(folder.put("c.pem", none));
            ADD_FAILURE() << none;
        } catch (const gum::InputError& refused) {
            EXPECT_EQ(refused.diagnostics().front().code, "GC-SIGN-0053");
        }
    }
}

TEST(CertificateAttack, NamesCannotPretendToBeLinesOfTheProgram) {
    const Identity root = root_named("Example Root");
    const Identity own = make_identity(ec_key(),
                                       {.name = "x\ncertificate.pdf: valid \x1B[2J\xE2\x80\xAE"
                                                "dilav"},
                                       &root);
    const CarelessSigner signer(own.key, {own});
    const Verification verification =
        verify_signatures(sign_dcc(k_dcc, signer, k_signing_time), "c.xml", std::vector<Bytes>{der(root)}, k_now);
    const std::string& name = verification.signatures.at(0).signer;
    EXPECT_THAT(name, HasSubstr("certificate.pdf: valid"));
    for (const char* hidden : {"\n", "\x1B", "\xE2\x80\xAE"}) {
        EXPECT_THAT(name, testing::Not(HasSubstr(hidden)));
    }
}

}  // namespace
}  // namespace gumcert::signing
