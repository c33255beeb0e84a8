#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "signing/certificates.h"
#include "signing/signer.h"
#include "signing/verify.h"
#include "tests/unit/signing/brought_material.h"
#include "tests/unit/signing/test_keys.h"

// What somebody without the key can do to a signed digital certificate, so that a person or a program reads another
// number than the laboratory signed. Each is not valid, and the finding says why.

namespace gumcert::signing {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using namespace test;

const std::string k_attacked_dcc =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" xmlns:si=\"https://ptb.de/si\" "
    "schemaVersion=\"3.3.0\">\n  <dcc:administrativeData><dcc:name refType=\"basic_name\">Gauge</dcc:name>"
    "</dcc:administrativeData>\n"
    "  <dcc:measurementResults><si:real><si:value>10.0023</si:value></si:real></dcc:measurementResults>\n"
    "</dcc:digitalCalibrationCertificate>\n";

const std::string k_forged_results =
    "<dcc:measurementResults xmlns:dcc=\"https://ptb.de/dcc\" xmlns:si=\"https://ptb.de/si\"><si:real><si:value>"
    "99</si:value></si:real></dcc:measurementResults>";

class XmlAttack : public testing::Test {
protected:
    [[nodiscard]] Verification verify(const Bytes& xml) const {
        return verify_signatures(xml, "certificate.xml", laboratory_.trusted(), k_now);
    }
    /// The first error of any signature; "refused" where the file is not looked at; "valid" is what must not be.
    [[nodiscard]] std::string error_of(const Bytes& xml) const {
        try {
            const Verification verification = verify(xml);
            if (verification.valid) {
                return "valid";
            }
            for (const SignatureReport& report : verification.signatures) {
                if (!first_error(report).empty()) {
                    return first_error(report);
                }
            }
            return verification.signatures.empty() ? "no signature" : "not valid without a reason";
        } catch (const gum::InputError& refused) {
            return refused.diagnostics().front().code;
        }
    }
    [[nodiscard]] std::string signature() const {
        const std::size_t from = good_.find("<ds:Signature ");
        return good_.substr(from, good_.find("</ds:Signature>") + 15 - from);
    }
    [[nodiscard]] std::string in_signature(const std::string& text) const {
        return replaced(good_, "</ds:Signature>", text + "</ds:Signature>");
    }

    [[nodiscard]] std::string in_x509_data(const std::string& text) const {
        return replaced(good_, "</ds:X509Data>", text + "</ds:X509Data>");
    }
    [[nodiscard]] std::string in_key_info(const std::string& text) const {
        return replaced(good_, "<ds:KeyInfo>", "<ds:KeyInfo>" + text);
    }
    [[nodiscard]] std::string with_unsigned(const std::string& text) const {
        return replaced(good_, "</xades:QualifyingProperties>",
                        "<xades:UnsignedProperties><xades:UnsignedSignatureProperties>" + text +
                            "</xades:UnsignedSignatureProperties></xades:UnsignedProperties>"
                            "</xades:QualifyingProperties>");
    }
    /// The document with a value at each place within a signature that takes Base64.
    [[nodiscard]] std::vector<std::string> with_value(const std::string& value) const {
        const auto element = [](const std::string& name, const std::string& text) {
            return '<' + name + '>' + text + "</" + name.substr(0, name.find(' ')) + '>';
        };
        const std::string sha256 = " Algorithm=\"http://www.w3.org/2001/04/xmlenc#sha256\"";
        const std::string dsig11 = " xmlns:dsig11=\"http://www.w3.org/2009/xmldsig11#\"";
        std::vector<std::string> all;
        for (const char* const name : {"ds:X509SKI", "ds:X509Certificate", "ds:X509CRL"}) {
            all.push_back(in_x509_data(element(name, value)));
        }
        all.push_back(in_x509_data(element("dsig11:X509Digest" + dsig11 + sha256, value)));
        const auto of_rsa = [&](const std::string& modulus, const std::string& exponent) {
            return element("ds:KeyValue", element("ds:RSAKeyValue",
                                                  element("ds:Modulus", modulus) + element("ds:Exponent", exponent)));
        };
        all.push_back(in_key_info(of_rsa(value, "AQAB")));
        all.push_back(in_key_info(of_rsa("AQAB", value)));
        all.push_back(in_key_info(
            element("ds:KeyValue", element("dsig11:ECKeyValue" + dsig11, element("dsig11:PublicKey", value)))));
        for (const auto& [outer, inner] : std::vector<std::pair<std::string, std::string>>{
                 {"xades:CertificateValues", "xades:EncapsulatedX509Certificate"},
                 {"xades:CRLValues", "xades:EncapsulatedCRLValue"},
                 {"xades:OCSPValues", "xades:EncapsulatedOCSPValue"},
                 {"xades:SignatureTimeStamp", "xades:EncapsulatedTimeStamp"},
                 {"xades:SigAndRefsTimeStamp", "xades:EncapsulatedTimeStamp"},
                 {"xades:ArchiveTimeStamp", "xades:EncapsulatedTimeStamp"}}) {
            const std::string values = element(outer, element(inner, value));
            all.push_back(
                with_unsigned(inner.find("CRL") != std::string::npos || inner.find("OCSP") != std::string::npos
                                  ? element("xades:RevocationValues", values)
                                  : values));
        }
        all.push_back(replaced(good_, "</ds:SignatureValue>", value + "</ds:SignatureValue>"));
        all.push_back(replaced(good_, "</ds:X509Certificate>", value + "</ds:X509Certificate>"));
        return all;
    }

    Laboratory laboratory_{ec_key()};
    Bytes good_ = sign_dcc(k_attacked_dcc, *laboratory_.signer, k_signing_time);
};

TEST_F(XmlAttack, TheDocumentItselfIsValid) {
    EXPECT_EQ(error_of(good_), "valid");
}

TEST_F(XmlAttack, TheSignedDocumentIsMovedIntoAnother) {
    const std::string whole = good_.substr(good_.find("<dcc:digital"));
    const auto outer = [](const std::string& inside) {
        return "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" schemaVersion=\"3.3.0\">" +
               k_forged_results + inside + "</dcc:digitalCalibrationCertificate>";
    };
    EXPECT_EQ(error_of(outer(whole)), "GC-SIGN-0119");
    EXPECT_EQ(error_of(outer("<dcc:comment>" + whole + "</dcc:comment>")), "GC-SIGN-0119");
    EXPECT_EQ(error_of(outer(signature())), "GC-SIGN-0117");
    // The old root stands within the signature of the new one.
    const std::string old_root = replaced(whole, signature(), "");
    EXPECT_EQ(error_of(outer(
                  replaced(signature(), "</ds:Signature>", "<ds:Object>" + old_root + "</ds:Object></ds:Signature>"))),
              "GC-SIGN-0120");
}

TEST_F(XmlAttack, AnotherRootStandsWithinTheSignature) {
    const std::string forged_root =
        "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" schemaVersion=\"3.3.0\">" +
        k_forged_results + "</dcc:digitalCalibrationCertificate>";
    // Where the signature leaves itself out, anything could be put in. A reader who looks for elements by name would
    // find it.
    EXPECT_EQ(error_of(in_signature("<ds:Object>" + forged_root + "</ds:Object>")), "GC-SIGN-0120");
    EXPECT_EQ(error_of(in_signature(k_forged_results)), "GC-SIGN-0120");
    EXPECT_EQ(error_of(replaced(good_, "</ds:Object>", forged_root + "</ds:Object>")), "GC-SIGN-0120");
    EXPECT_EQ(error_of(replaced(good_, "<ds:Object>", "<ds:Object>" + forged_root)), "GC-SIGN-0120");
    EXPECT_EQ(error_of(replaced(good_, "</ds:KeyInfo>", forged_root + "</ds:KeyInfo>")), "GC-SIGN-0120");
    EXPECT_EQ(error_of(replaced(good_, "</xades:QualifyingProperties>",
                                "<xades:UnsignedProperties>" + k_forged_results +
                                    "</xades:UnsignedProperties></xades:QualifyingProperties>")),
              "GC-SIGN-0120");
    EXPECT_EQ(error_of(in_signature("<ds:Object><value xmlns=\"\">99</value></ds:Object>")), "GC-SIGN-0120");
    EXPECT_EQ(error_of(in_signature("<ds:Object>U = 99</ds:Object>")), "GC-SIGN-0120");
}

// Law: at no place within a signature text, an attribute, an element, a comment or a processing instruction can be added.
TEST_F(XmlAttack, NothingCanBeAddedWithinTheSignature) {
    const std::size_t from = good_.find("<ds:Signature ");
    const std::size_t end = good_.find("</ds:Signature>");
    ASSERT_NE(from, std::string::npos);
    int added = 0;
    const auto is_refused = [&](std::size_t at, const std::string& more) {
        ++added;
        EXPECT_NE(error_of(Bytes(good_).insert(at, more)), "valid")
            << more << " behind " << good_.substr(at - std::min<std::size_t>(at, 60), 60);
    };
    for (std::size_t at = good_.find('>', from); at != std::string::npos && at < end; at = good_.find('>', at + 1)) {
        for (const char* const more :
             {"U = 1 nm, PASS", "<!-- U = 1 nm -->", "<?xml-stylesheet type=\"text/css\" href=\"x\"?>",
              "<![CDATA[U = 1 nm]]>", "<ds:MgmtData>U = 1 nm</ds:MgmtData>", "<ds:KeyName>U = 1 nm</ds:KeyName>",
              "<ds:X509SubjectName>U = 1 nm</ds:X509SubjectName>", "<p xmlns=\"http://www.w3.org/1999/xhtml\">U</p>"}) {
            is_refused(at + 1, more);
        }
        if (good_[at - 1] != '/' && good_.rfind("</", at) < good_.rfind('<', at)) {
            is_refused(at, " note=\"U = 1 nm\"");
            is_refused(at, " xml:lang=\"U = 1 nm\"");
        }
    }
    EXPECT_GT(added, 100);
    EXPECT_EQ(error_of(replaced(good_, "<ds:KeyInfo>", "<ds:KeyInfo Id=\"U = 1 nm\">")), "GC-SIGN-0120");
    EXPECT_EQ(error_of(replaced(good_, "<ds:KeyInfo>", "<ds:KeyInfo Id=\"key-1\">")), "valid");
    EXPECT_EQ(error_of(replaced(good_, "<ds:KeyInfo>", "<ds:KeyInfo>U = 1 nm")), "GC-SIGN-0120");
    // Programs of others name the certificate: what it says itself may stand there, and nothing else.
    const std::string subject = verify(good_).signatures.front().signer;
    std::string spaced = subject;
    for (std::size_t at = spaced.find(','); at != std::string::npos; at = spaced.find(',', at + 2)) {
        spaced.insert(at + 1, " ");
    }
    for (const std::string& name : {subject, spaced}) {
        const std::string element = "<ds:X509SubjectName>" + name + "</ds:X509SubjectName>";
        EXPECT_EQ(error_of(replaced(good_, "<ds:X509Data>", "<ds:X509Data>" + element)), "valid") << name;
        const std::string other = "<ds:X509SubjectName>" + name + ",OU=U = 1 nm</ds:X509SubjectName>";
        EXPECT_EQ(error_of(replaced(good_, "<ds:X509Data>", "<ds:X509Data>" + other)), "GC-SIGN-0120") << name;
    }
    EXPECT_EQ(error_of(replaced(good_, "<ds:KeyInfo>", "<ds:KeyInfo><ds:KeyName>" + subject + "</ds:KeyName>")),
              "valid");
    const std::string serial = "<ds:X509IssuerSerial><ds:X509IssuerName>" + subject +
                               "</ds:X509IssuerName><ds:X509SerialNumber>123456789</ds:X509SerialNumber>"
                               "</ds:X509IssuerSerial>";
    EXPECT_EQ(error_of(replaced(good_, "<ds:X509Data>", "<ds:X509Data>" + serial)), "GC-SIGN-0120");
    EXPECT_EQ(error_of(replaced(good_, "</xades:QualifyingProperties>",
                                "<xades:UnsignedProperties><xades:UnsignedSignatureProperties><xades:CounterSignature>"
                                "U = 1 nm</xades:CounterSignature></xades:UnsignedSignatureProperties>"
                                "</xades:UnsignedProperties></xades:QualifyingProperties>")),
              "GC-SIGN-0120");
}

TEST_F(XmlAttack, UnsignedPropertiesOfXadesAreSaidNotToBeCovered) {
    const Bytes stamped = replaced(good_, "</xades:QualifyingProperties>",
                                   "<xades:UnsignedProperties><xades:UnsignedSignatureProperties>"
                                   "<xades:SignatureTimeStamp><xades:EncapsulatedTimeStamp>" +
                                       encoding::base64(time_stamp(authority_named("A time stamping service"))) +
                                       "</xades:EncapsulatedTimeStamp></xades:SignatureTimeStamp>"
                                       "</xades:UnsignedSignatureProperties></xades:UnsignedProperties>"
                                       "</xades:QualifyingProperties>");
    EXPECT_EQ(error_of(stamped), "valid");
    EXPECT_THAT(verify(stamped).signatures.at(0).not_covered,
                Contains(HasSubstr("unsigned properties within the signature: xades:SignatureTimeStamp")));
    const std::string list = "<ds:X509CRL>" + encoding::base64(revocation_list(laboratory_.root, {})) + "</ds:X509CRL>";
    EXPECT_THAT(verify(in_x509_data(list)).signatures.at(0).not_covered,
                Contains(HasSubstr("a list of revoked certificates within the signature")));
    EXPECT_THAT(verify(in_x509_data(list + list)).signatures.at(0).not_covered,
                Contains(HasSubstr("2 lists of revoked certificates within the signature")));
    EXPECT_THAT(verify(good_).signatures.at(0).not_covered, testing::IsEmpty());
}

// Law: at no place that takes Base64 a sentence can stand, whether by its letters, decoded, or in lines.
TEST_F(XmlAttack, NoSentenceIsAValue) {
    std::string letters = k_sentence;
    std::erase_if(letters, [](char c) { return c == ' ' || c == '='; });
    letters.resize(letters.size() / 4 * 4);
    std::string words = k_sentence;
    std::replace(words.begin(), words.end(), ' ', '\n');
    const std::string decoded = encoding::base64(k_sentence);
    for (const std::string& sentence : {k_sentence, letters, words, decoded, ' ' + k_sentence, '\n' + k_sentence + '\n',
                                        encoding::base64(foreign_certificates(laboratory_)[0])}) {
        const std::vector<std::string> all = with_value(sentence);
        EXPECT_EQ(all.size(), 15U);
        for (const std::string& changed : all) {
            EXPECT_NE(error_of(changed), "valid") << sentence << " in " << changed.substr(good_.find("<ds:KeyInfo>"));
        }
    }
    EXPECT_EQ(error_of(in_x509_data("<ds:X509SKI>" + k_sentence + "</ds:X509SKI>")), "GC-SIGN-0120");
    EXPECT_EQ(error_of(in_x509_data("<ds:X509Certificate>" + k_sentence + "</ds:X509Certificate>")), "GC-SIGN-0120");
}

TEST_F(XmlAttack, WhatIsOfTheSignerMayComeAlong) {
    const Identity& root = laboratory_.root;
    const auto element = [](const std::string& name, const Bytes& value) {
        return '<' + name + '>' + encoding::base64(value) + "</" + name.substr(0, name.find(' ')) + '>';
    };
    const auto is_good = [&](const std::string& changed) { EXPECT_EQ(error_of(changed), "valid") << changed; };
    is_good(in_x509_data(element("ds:X509Certificate", der(root))));
    is_good(in_x509_data(element("ds:X509CRL", revocation_list(root, {}))));
    is_good(
        in_x509_data(element("dsig11:X509Digest xmlns:dsig11=\"http://www.w3.org/2009/xmldsig11#\" "
                             "Algorithm=\"http://www.w3.org/2001/04/xmlenc#sha256\"",
                             encoding::sha256_bytes(der(laboratory_.own)))));
    const auto answered = [&](const Identity& service) {
        return with_unsigned("<xades:RevocationValues><xades:OCSPValues>" +
                             element("xades:EncapsulatedOCSPValue", revocation_answer(laboratory_.own, root, service)) +
                             "</xades:OCSPValues></xades:RevocationValues>");
    };
    is_good(answered(root));
    is_good(answered(make_identity(ec_key(), {.name = "Responder"}, &root)));
    EXPECT_EQ(error_of(answered(authority_named("Example Root"))), "GC-SIGN-0120");
    EXPECT_EQ(error_of(answered(make_identity(ec_key(), {.name = "Responder"}))), "GC-SIGN-0120");
    const auto listed = [&](const Bytes& list) {
        return with_unsigned("<xades:RevocationValues><xades:CRLValues>" + element("xades:EncapsulatedCRLValue", list) +
                             "</xades:CRLValues></xades:RevocationValues>");
    };
    is_good(listed(revocation_list(root, {})));
    EXPECT_EQ(error_of(listed(revocation_list(authority_named("Example Root"), {}))), "GC-SIGN-0120");
    EXPECT_EQ(error_of(listed(revocation_list(root, {}) + "x")), "GC-SIGN-0120");
    is_good(with_unsigned("<xades:CertificateValues>" + element("xades:EncapsulatedX509Certificate", der(root)) +
                          "</xades:CertificateValues>"));
    // Lines of one length, indented, as programs write them.
    const std::string value = encoding::base64(der(root));
    for (const std::size_t length : {std::size_t{64}, std::size_t{76}}) {
        std::string lines;
        for (std::size_t at = 0; at < value.size(); at += length) {
            lines += "\n      " + value.substr(at, length) + "&#13;";
        }
        is_good(in_x509_data("<ds:X509Certificate>" + lines + "\n   </ds:X509Certificate>"));
    }
    // The key of the signer, and no other.
    const auto key_value = [&](const Identity& identity) {
        unsigned char* point = nullptr;
        const std::size_t size = EVP_PKEY_get1_encoded_public_key(identity.key.get(), &point);
        const Bytes bytes(reinterpret_cast<const char*>(point), size);
        OPENSSL_free(point);
        return "<ds:KeyValue><dsig11:ECKeyValue xmlns:dsig11=\"http://www.w3.org/2009/xmldsig11#\"><dsig11:NamedCurve "
               "URI=\"urn:oid:1.2.840.10045.3.1.7\"/>" +
               element("dsig11:PublicKey", bytes) + "</dsig11:ECKeyValue></ds:KeyValue>";
    };
    is_good(in_key_info(key_value(laboratory_.own)));
    EXPECT_EQ(error_of(in_key_info(key_value(root))), "GC-SIGN-0120");
    EXPECT_EQ(error_of(in_key_info(replaced(key_value(laboratory_.own), "3.1.7", "3.1.1"))), "GC-SIGN-0120");
    const Laboratory rsa(rsa_key());
    const auto rsa_value = [&](const std::string& exponent, const char* prefix) {
        BIGNUM* modulus = nullptr;
        EXPECT_EQ(EVP_PKEY_get_bn_param(rsa.own.key.get(), "n", &modulus), 1);
        Bytes bytes(static_cast<std::size_t>(BN_num_bytes(modulus)), '\0');
        BN_bn2bin(modulus, reinterpret_cast<unsigned char*>(bytes.data()));
        BN_free(modulus);
        const Bytes xml = replaced(sign_dcc(k_attacked_dcc, *rsa.signer, k_signing_time), "<ds:KeyInfo>",
                                   "<ds:KeyInfo><ds:KeyValue><ds:RSAKeyValue>" +
                                       element("ds:Modulus", (*prefix == '0' ? Bytes(1, '\0') : Bytes()) + bytes) +
                                       "<ds:Exponent>" + exponent + "</ds:Exponent></ds:RSAKeyValue></ds:KeyValue>");
        return verify_signatures(xml, "certificate.xml", rsa.trusted(), k_now).valid;
    };
    EXPECT_TRUE(rsa_value("AQAB", ""));
    EXPECT_TRUE(rsa_value("AQAB", "0"));
    EXPECT_FALSE(rsa_value("AQAC", ""));
}

TEST_F(XmlAttack, CertificatesOfOthersDoNotComeAlong) {
    const auto beside = [](const Bytes& certificate) {
        return "<ds:X509Certificate>" + encoding::base64(certificate) + "</ds:X509Certificate>";
    };
    for (const Bytes& foreign : foreign_certificates(laboratory_)) {
        EXPECT_EQ(error_of(in_x509_data(beside(foreign))), "GC-SIGN-0124");
        const std::string value = "<xades:CertificateValues><xades:EncapsulatedX509Certificate>" +
                                  encoding::base64(foreign) +
                                  "</xades:EncapsulatedX509Certificate></xades:CertificateValues>";
        EXPECT_EQ(error_of(with_unsigned(value)), "GC-SIGN-0124");
    }
    const Identity stranger = authority_named(k_sentence.substr(0, 60));
    const std::string name = "<ds:KeyName>" + k_sentence.substr(0, 60) + "</ds:KeyName>";
    EXPECT_EQ(error_of(replaced(in_x509_data(beside(der(stranger))), "<ds:KeyInfo>", "<ds:KeyInfo>" + name)),
              "GC-SIGN-0120");
    std::string many;
    for (int i = 0; i < 100; ++i) {
        many += beside(der(laboratory_.root));
    }
    EXPECT_EQ(error_of(in_x509_data(many)), "GC-SIGN-0124");
    // Where the signer alone is trusted, an issuer may come along whom nobody vouches for; that is said.
    const Identity authority = authority_named("Authority", &laboratory_.root);
    const Identity own = make_identity(ec_key(), {}, &authority);
    const CarelessSigner signer(own.key, {own, authority});
    const Bytes xml = sign_dcc(k_attacked_dcc, signer, k_signing_time);
    const auto checked = [&](const Bytes& document, const std::vector<Bytes>& trusted) {
        return verify_signatures(document, "certificate.xml", trusted, k_now).signatures.at(0);
    };
    EXPECT_TRUE(checked(xml, {der(own)}).valid);
    EXPECT_THAT(checked(xml, {der(own)}).not_covered, Contains(HasSubstr("the certificate of CN=Authority")));
    EXPECT_TRUE(checked(xml, {der(laboratory_.root)}).valid);
    EXPECT_TRUE(checked(xml, {der(authority)}).valid);
    EXPECT_THAT(checked(xml, {der(authority)}).not_covered, testing::IsEmpty());
    const Identity lookalike = make_identity(
        authority.key, {.name = "Authority", .key_usage = "critical,keyCertSign", .authority = true}, &stranger);
    const Bytes with_both = replaced(xml, "</ds:X509Data>", beside(der(lookalike)) + "</ds:X509Data>");
    EXPECT_FALSE(checked(with_both, {der(laboratory_.root)}).valid);
    EXPECT_FALSE(checked(with_both, {der(authority)}).valid);
    // Above an authority that is trusted itself, the chain goes on; with or without its end.
    const Identity lower = authority_named("Lower", &authority);
    const Identity under_lower = make_identity(ec_key(), {}, &lower);
    for (const std::vector<Identity>& chain :
         {std::vector<Identity>{under_lower, lower, authority},
          std::vector<Identity>{under_lower, lower, authority, laboratory_.root}}) {
        const Bytes deep = sign_dcc(k_attacked_dcc, CarelessSigner(under_lower.key, chain), k_signing_time);
        for (const Identity& trusted : chain) {
            EXPECT_TRUE(checked(deep, {der(trusted)}).valid) << chain.size();
        }
        EXPECT_THAT(checked(deep, {der(lower)}).not_covered, Contains(HasSubstr("the certificate of CN=Authority")));
    }
}

// Of the issuers of a signer who is trusted alone, and of an authority that had its certificate renewed, nothing is known: what is
// of them is told as not covered.
TEST_F(XmlAttack, WhatIsOfIssuersThatNobodyVouchesForIsTold) {
    const Identity& root = laboratory_.root;
    const Identity authority = authority_named("Authority", &root);
    const Identity own = make_identity(ec_key(), {}, &authority);
    const Bytes xml = sign_dcc(k_attacked_dcc, CarelessSigner(own.key, {own, authority, root}), k_signing_time);
    const auto checked = [&](const Bytes& document, const Identity& trusted) {
        return verify_signatures(document, "certificate.xml", std::vector<Bytes>{der(trusted)}, k_now).signatures.at(0);
    };
    const auto listed = [&](const Identity& issuer) {
        const std::string values =
            "<xades:UnsignedProperties><xades:UnsignedSignatureProperties><xades:RevocationValues>"
            "<xades:CRLValues><xades:EncapsulatedCRLValue>" +
            encoding::base64(revocation_list(issuer, {})) +
            "</xades:EncapsulatedCRLValue></xades:CRLValues></xades:RevocationValues>"
            "</xades:UnsignedSignatureProperties></xades:UnsignedProperties>";
        return replaced(xml, "</xades:SignedProperties>", "</xades:SignedProperties>" + values);
    };
    const std::string top = subject_of(root.certificate.get());
    const Bytes named = replaced(xml, "<ds:KeyInfo>", "<ds:KeyInfo><ds:KeyName>" + top + "</ds:KeyName>");
    for (const Identity& trusted : {own, authority, root}) {
        for (const Identity& issuer : {authority, root}) {
            EXPECT_TRUE(checked(listed(issuer), trusted).valid);
            EXPECT_THAT(checked(listed(issuer), trusted).not_covered, Contains(HasSubstr("xades:RevocationValues")));
        }
        EXPECT_FALSE(checked(listed(authority_named("Authority")), trusted).valid);
        EXPECT_TRUE(checked(named, trusted).valid);
    }
    EXPECT_THAT(checked(named, own).not_covered,
                Contains("of a certificate that nothing that is trusted vouches for: " + top));
    EXPECT_FALSE(checked(replaced(named, top + "</ds:KeyName>", "U is 1 nm</ds:KeyName>"), own).valid);
    const Identity renewed = make_identity(
        authority.key, {.name = "Authority", .key_usage = "critical,keyCertSign", .authority = true}, &root);
    EXPECT_TRUE(checked(xml, renewed).valid);
    EXPECT_THAT(checked(xml, renewed).not_covered, Contains(HasSubstr("the certificate of CN=Authority")));
    EXPECT_TRUE(checked(listed(authority), renewed).valid);
    std::string objects;
    for (int i = 0; i < 100; ++i) {
        objects += "<ds:Object/>";
    }
    const SignatureReport crowded = checked(replaced(xml, "</ds:Signature>", objects + "</ds:Signature>"), root);
    EXPECT_TRUE(crowded.valid);
    EXPECT_EQ(crowded.not_covered, std::vector<std::string>{"100 objects within the signature"});
}

// Exclusive canonical XML leaves out the declarations that nothing uses: they can be put in after signing.
TEST_F(XmlAttack, NamespacesThatNothingUses) {
    const auto declared = [&](const std::string& at, const std::string& what) {
        return replaced(good_, at, at.substr(0, at.size() - 1) + ' ' + what + '>');
    };
    const std::string sentence = "xmlns:note=\"" + k_sentence + '"';
    const std::string address = "xmlns:note=\"urn:true%20length%2051%20mm\"";
    for (const char* const at : {"<dcc:administrativeData>", "<si:value>"}) {
        EXPECT_EQ(error_of(declared(at, sentence)), "GC-SIGN-0030") << at << ": no address";
        EXPECT_EQ(error_of(declared(at, address)), "valid") << at;
        EXPECT_THAT(verify(declared(at, address)).signatures.at(0).not_covered,
                    Contains("a namespace that nothing uses: " + replaced(replaced(address, "\"", ""), "\"", "")));
    }
    for (const char* const at :
         {"<ds:KeyInfo>", "<ds:SignedInfo>", "<ds:X509Data>", "<xades:SigningTime>", "<ds:Object>"}) {
        EXPECT_EQ(error_of(declared(at, sentence)), "GC-SIGN-0030") << at;
        EXPECT_EQ(error_of(declared(at, address)), "GC-SIGN-0120") << at;
        EXPECT_EQ(error_of(declared(at, "xmlns:thetruelengthis51mm=\"http://www.w3.org/2000/09/xmldsig#\"")),
                  "GC-SIGN-0120")
            << at;
    }
    const Bytes named = replaced(good_, "<ds:KeyInfo>", "<ds:KeyInfo Id=\"true-length-51mm\">");
    EXPECT_THAT(verify(named).signatures.at(0).not_covered,
                Contains("an identifier within the signature: true-length-51mm"));
}

TEST_F(XmlAttack, ReferencesToOtherThanTheWholeDocument) {
    const std::string id = replaced(good_, "<dcc:measurementResults>", "<dcc:measurementResults Id=\"r\">");
    for (const char* uri : {"#r", "#xpointer(/)", "#xpointer(id('r'))", "file:///etc/passwd", "http://example.org/",
                            "other.xml", "#", " "}) {
        EXPECT_EQ(error_of(replaced(id, "URI=\"\"", "URI=\"" + std::string(uri) + '"')), "GC-SIGN-0112") << uri;
    }
    EXPECT_EQ(error_of(replaced(good_, " URI=\"\"", "")), "GC-SIGN-0112");
    EXPECT_EQ(error_of(replaced(good_, "URI=\"\"", "Uri=\"\"")), "GC-SIGN-0112");
    // The signed properties may not stand for the document.
    EXPECT_EQ(error_of(replaced(good_, "URI=\"\"", "URI=\"#gumcert-signed-properties\"")), "GC-SIGN-0112");
    // Twice the document, and no document.
    const std::size_t from = good_.find("<ds:Reference Id=");
    const std::string reference = good_.substr(from, good_.find("</ds:Reference>") + 15 - from);
    EXPECT_EQ(error_of(replaced(good_, reference, reference + reference)), "GC-SIGN-0112");
    EXPECT_EQ(error_of(replaced(good_, reference, "")), "GC-SIGN-0112");
    // A list of references within the signature, none of which anybody checks.
    EXPECT_EQ(error_of(replaced(good_, reference,
                                reference +
                                    "<ds:Reference Type=\"http://www.w3.org/2000/09/xmldsig#Manifest\" "
                                    "URI=\"#m\"><ds:DigestMethod Algorithm=\"" +
                                    std::string("http://www.w3.org/2001/04/xmlenc#sha256") +
                                    "\"/><ds:DigestValue>AA==</ds:DigestValue></ds:Reference>")),
              "GC-SIGN-0112");
}

TEST_F(XmlAttack, TransformsThatLeaveOutParts) {
    const std::string enveloped = "<ds:Transform Algorithm=\"http://www.w3.org/2000/09/xmldsig#enveloped-signature\"/>";
    const std::string canonical = "<ds:Transform Algorithm=\"http://www.w3.org/2001/10/xml-exc-c14n#\"/>";
    const std::string xpath =
        "<ds:Transform Algorithm=\"http://www.w3.org/TR/1999/REC-xpath-19991116\"><ds:XPath "
        "xmlns:si=\"https://ptb.de/si\">not(ancestor-or-self::si:value)</ds:XPath></ds:Transform>";
    const std::string xpath2 =
        "<ds:Transform Algorithm=\"http://www.w3.org/2002/06/xmldsig-filter2\"><XPath "
        "xmlns=\"http://www.w3.org/2002/06/xmldsig-filter2\" Filter=\"subtract\">//*</XPath></ds:Transform>";
    const std::string xslt =
        "<ds:Transform Algorithm=\"http://www.w3.org/TR/1999/REC-xslt-19991116\"><xsl:stylesheet version=\"1.0\" "
        "xmlns:xsl=\"http://www.w3.org/1999/XSL/Transform\"><xsl:template match=\"/\">a"
        "</xsl:template></xsl:stylesheet></ds:Transform>";
    const std::string base64 = "<ds:Transform Algorithm=\"http://www.w3.org/2000/09/xmldsig#base64\"/>";
    const std::string comments = "<ds:Transform Algorithm=\"http://www.w3.org/2001/10/xml-exc-c14n#WithComments\"/>";
    for (const std::string& other : {xpath, xpath2, xslt, base64, comments, enveloped}) {
        EXPECT_EQ(error_of(replaced(good_, enveloped + canonical, enveloped + other)), "GC-SIGN-0113") << other;
        EXPECT_EQ(error_of(replaced(good_, enveloped + canonical, enveloped + canonical + other)), "GC-SIGN-0113");
        EXPECT_EQ(error_of(replaced(good_, enveloped + canonical, other + canonical)),
                  other == enveloped ? "valid" : "GC-SIGN-0113");
        // Of the signed properties, and in a second list, which our eye might overlook.
        EXPECT_EQ(error_of(replaced(good_, "<ds:Transforms>" + canonical, "<ds:Transforms>" + other)), "GC-SIGN-0113");
        EXPECT_EQ(error_of(replaced(good_, canonical + "</ds:Transforms>",
                                    "</ds:Transforms><ds:Transforms>" + other + "</ds:Transforms>")),
                  "GC-SIGN-0113");
    }
    // An algorithm of another namespace beside the real attribute.
    EXPECT_EQ(
        error_of(replaced(good_, enveloped + canonical,
                          enveloped + "<ds:Transform xmlns:x=\"urn:x\" x:Algorithm=\"http://www.w3.org/2000/09/"
                                      "xmldsig#base64\" Algorithm=\"http://www.w3.org/2001/10/xml-exc-c14n#\"/>")),
        "GC-SIGN-0110");
}

TEST_F(XmlAttack, SecondPartsOfTheSignature) {
    const auto part = [&](const std::string& name) {
        const std::size_t from = good_.find('<' + name + '>');
        return good_.substr(from, good_.find("</" + name + '>') + name.size() + 3 - from);
    };
    const std::string info = part("ds:SignedInfo");
    const std::string value = part("ds:SignatureValue");
    const std::string key = part("ds:KeyInfo");
    EXPECT_EQ(error_of(replaced(good_, info, info + info)), "GC-SIGN-0110");
    EXPECT_EQ(error_of(replaced(good_, value, value + value)), "GC-SIGN-0110");
    EXPECT_EQ(error_of(replaced(good_, info, "")), "GC-SIGN-0110");
    EXPECT_EQ(error_of(replaced(good_, value, "")), "GC-SIGN-0110");
    EXPECT_NE(error_of(replaced(good_, key, key + key)), "valid");
    EXPECT_EQ(error_of(replaced(good_, key, "")), "GC-SIGN-0115");
    EXPECT_NE(error_of(replaced(good_, info, value + info)), "valid");
    EXPECT_NE(error_of(replaced(good_, info, "<ds:Object>" + info + "</ds:Object>" + info)), "valid");
    EXPECT_NE(error_of(replaced(good_, signature(), signature() + signature())), "valid");
    // Another signature of ours, taken from another document.
    const Bytes other = sign_dcc(replaced(k_attacked_dcc, "10.0023", "99"), *laboratory_.signer, k_signing_time);
    const std::size_t from = other.find("<ds:Signature ");
    const std::string foreign = other.substr(from, other.find("</ds:Signature>") + 15 - from);
    EXPECT_EQ(error_of(replaced(good_, signature(), foreign)), "GC-SIGN-0117");
}

TEST_F(XmlAttack, CommentsInsideOfValues) {
    // Canonical XML leaves comments out, so the digest stays; a program that reads the first piece of text reads 10.
    for (const char* split : {"10<!-- -->.0023", "10.0<!---->023", "<!-- 99 -->10.0023", "10.0023<!-- 99 -->"}) {
        const Bytes changed = replaced(good_, "10.0023", split);
        EXPECT_EQ(error_of(changed), "GC-SIGN-0121") << split;
        EXPECT_THAT(verify(changed).signatures.at(0).findings.at(0).what, HasSubstr("si:value"));
    }
    // Between elements a comment changes nothing that anybody reads as a value; the report says it is not covered.
    const Bytes between = replaced(good_, "<si:real>", "<!-- a comment --><si:real>");
    EXPECT_EQ(error_of(between), "valid");
    EXPECT_THAT(verify(between).signatures.at(0).not_covered, Contains("comments of the XML"));
    for (const Bytes& outside : {good_ + "<!-- behind -->", replaced(good_, "?>\n<dcc:", "?><!-- before --><dcc:")}) {
        EXPECT_THAT(verify(outside).signatures.at(0).not_covered,
                    testing::AnyOf(Contains("comments of the XML"), Contains("nothing can be relied on")));
    }
}

TEST_F(XmlAttack, OtherPiecesInsideOfValues) {
    EXPECT_EQ(error_of(replaced(good_, "10.0023", "10<![CDATA[.0023]]>")), "GC-SIGN-0121");
    EXPECT_EQ(error_of(replaced(good_, "10.0023", "10<?x ?>.0023")), "GC-SIGN-0117");
    EXPECT_EQ(error_of(replaced(good_, "10.0023", "10&unknown;.0023")), "GC-SIGN-0030");
    EXPECT_EQ(error_of(replaced(good_, "?>\n<dcc:", "?>\n<!DOCTYPE x [<!ENTITY v \"10.0023\">]>\n<dcc:")),
              "GC-SIGN-0030");
    EXPECT_EQ(error_of(replaced(replaced(good_, "?>\n<dcc:", "?>\n<!DOCTYPE x [<!ENTITY v \"10.0023\">]>\n<dcc:"),
                                ">10.0023<", ">&v;<")),
              "GC-SIGN-0030");
    // The same text in another spelling is the same number for everybody.
    EXPECT_EQ(error_of(replaced(good_, "10.0023", "1&#48;.0023")), "valid");
    EXPECT_EQ(error_of(replaced(good_, "10.0023", "<![CDATA[10.0023]]>")), "valid");
    EXPECT_EQ(error_of(replaced(good_, "<si:real>", "<![CDATA[  ]]><si:real>")), "GC-SIGN-0117");
    // Invisible characters.
    EXPECT_EQ(error_of(replaced(good_, "10.0023", "10.0023\xE2\x80\x8B")), "GC-SIGN-0117");
}

TEST_F(XmlAttack, WhatIsOutsideOfTheRoot) {
    EXPECT_EQ(error_of(replaced(good_, "?>\n", "?>\n<?xml-stylesheet href=\"http://example.org/x.xsl\"?>")),
              "GC-SIGN-0117");
    EXPECT_EQ(error_of(good_ + "<?after x?>"), "GC-SIGN-0117");
    EXPECT_EQ(error_of(good_ + good_), "GC-SIGN-0030");
    EXPECT_EQ(error_of(good_ + "99"), "GC-SIGN-0030");
}

TEST_F(XmlAttack, NamespacesAreRedefined) {
    EXPECT_EQ(error_of(replaced(good_, "xmlns:si=\"https://ptb.de/si\"", "xmlns:si=\"https://example.org/si\"")),
              "GC-SIGN-0117");
    EXPECT_EQ(error_of(replaced(good_, "<si:value>", "<si:value xmlns:si=\"urn:other\">")), "GC-SIGN-0117");
    EXPECT_EQ(error_of(replaced(good_, "<si:value>", "<si:value xmlns=\"urn:other\" unit=\"m\">")), "GC-SIGN-0117");
    // A signature that is none: its prefix means something else.
    EXPECT_EQ(error_of(replaced(good_, "xmlns:ds=\"http://www.w3.org/2000/09/xmldsig#\"", "xmlns:ds=\"urn:other\"")),
              "no signature");
    EXPECT_EQ(error_of(replaced(good_, "<xades:SigningTime>", "<xades:SigningTime xmlns:xades=\"urn:other\">")),
              "GC-SIGN-0117");
}

TEST_F(XmlAttack, TheSignedPropertiesAreReplaced) {
    const std::size_t from = good_.find("<xades:SignedProperties ");
    const std::string properties = good_.substr(from, good_.find("</xades:SignedProperties>") + 25 - from);
    const std::string backdated = replaced(properties, "2026-03-31", "2026-03-01");
    EXPECT_EQ(error_of(replaced(good_, properties, backdated)), "GC-SIGN-0117");
    EXPECT_EQ(error_of(replaced(good_, properties, properties + backdated)), "GC-SIGN-0114");
    // The signed ones in another place, the forged ones where they are read.
    EXPECT_EQ(error_of(in_signature("<ds:Object xmlns:xades=\"http://uri.etsi.org/01903/v1.3.2#\">" + properties +
                                    "</ds:Object>")),
              "GC-SIGN-0114");
    const std::string moved = replaced(good_, properties, backdated);
    EXPECT_EQ(error_of(replaced(moved, "</ds:Signature>",
                                "<ds:Object xmlns:xades=\"http://uri.etsi.org/01903/v1.3.2#\">" + properties +
                                    "</ds:Object></ds:Signature>")),
              "GC-SIGN-0114");
    EXPECT_EQ(error_of(replaced(good_, "Id=\"gumcert-signed-properties\"", "Id=\"other\"")), "GC-SIGN-0114");
    EXPECT_EQ(error_of(replaced(good_, "Id=\"gumcert-signed-properties\"", "ID=\"gumcert-signed-properties\"")),
              "GC-SIGN-0114");
}

TEST_F(XmlAttack, ThePropertiesAreOfTheSignatureThatTheyStandIn) {
    EXPECT_EQ(error_of(replaced(good_, "Target=\"#gumcert-signature\"", "Target=\"#another\"")), "GC-SIGN-0123");
    EXPECT_EQ(error_of(replaced(good_, " Target=\"#gumcert-signature\"", "")), "GC-SIGN-0123");
    EXPECT_EQ(error_of(replaced(good_, " Id=\"gumcert-signature\"", " Id=\"another\"")), "GC-SIGN-0123");
    EXPECT_EQ(error_of(replaced(good_, " Id=\"gumcert-signature\"", "")), "GC-SIGN-0123");
}

TEST_F(XmlAttack, ALargeNumberOfSignaturesIsNotAWayToKeepTheCheckBusy) {
    std::string many;
    for (int i = 0; i < 5000; ++i) {
        many += signature();
    }
    const Bytes crowded = replaced(good_, signature(), many);
    EXPECT_EQ(error_of(crowded), "GC-SIGN-0122");
    EXPECT_LT(verify(crowded).signatures.size(), 20U);
    EXPECT_EQ(error_of(replaced(good_, signature(), "<x>" + many + "</x>")), "GC-SIGN-0119");
}

TEST_F(XmlAttack, TheReportCannotBeUsedToPrintOtherLines) {
    // What is not trusted must not look like what the program says.
    const Verification verification = verify(replaced(good_, "ecdsa-sha256",
                                                      "&#10;certificate.xml: valid&#x9B;2J\xE2\x80\xAE"
                                                      "dilav"));
    for (const SignatureReport& report : verification.signatures) {
        EXPECT_FALSE(report.valid);
        EXPECT_THAT(report.algorithm, Not(HasSubstr("\n")));
        EXPECT_THAT(report.algorithm, Not(HasSubstr("\xC2\x9B")));
        EXPECT_THAT(report.algorithm, Not(HasSubstr("\xE2\x80\xAE")));
        for (const gum::Diagnostic& finding : report.findings) {
            EXPECT_THAT(finding.what, Not(HasSubstr("\xC2\x9B")));
            EXPECT_THAT(finding.what, Not(HasSubstr("\xE2\x80\xAE")));
        }
    }
}

}  // namespace
}  // namespace gumcert::signing
