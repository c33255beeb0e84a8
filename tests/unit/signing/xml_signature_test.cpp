#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signing/signer.h"
#include "signing/verify.h"
#include "tests/unit/signing/test_keys.h"

namespace gumcert::signing {
namespace {

using testing::Contains;
using testing::HasSubstr;
using namespace test;

// The frame of a DCC is enough here; the whole schema is tested with the shared example below.
const std::string k_signed_dcc =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" xmlns:si=\"https://ptb.de/si\" "
    "schemaVersion=\"3.3.0\">\n  <dcc:administrativeData><!-- a comment -->\n    "
    "<dcc:name>Größe &amp; Unsicherheit</dcc:name>\n  </dcc:administrativeData>\n"
    "  <dcc:measurementResults><si:real><si:value>10.0023</si:value></si:real></dcc:measurementResults>\n"
    "</dcc:digitalCalibrationCertificate>\n";

const std::string k_shared = std::string(GUMCERT_SHARED_DIR) + "/dcc";

Verification verified(const Bytes& xml, const Laboratory& laboratory) {
    return verify_signatures(xml, "certificate.xml", laboratory.trusted(), k_now);
}

std::string refusal(const Bytes& xml) {
    try {
        static_cast<void>(verify_signatures(xml, "certificate.xml", {}, k_now));
    } catch (const gum::InputError& e) {
        return e.what();
    }
    return "accepted";
}

class SignDcc : public testing::TestWithParam<const char*> {
protected:
    static Key key() {
        const std::string kind = GetParam();
        return kind == "RSA" ? rsa_key(2048) : ec_key(GetParam());
    }
};

TEST_P(SignDcc, IsVerifiedHereAndByXmlsec) {
    const Laboratory laboratory(key());
    const Bytes signed_dcc = sign_dcc(k_signed_dcc, *laboratory.signer, k_signing_time);
    // Every byte of the document stays; the signature is the last child of the root.
    EXPECT_TRUE(signed_dcc.starts_with(k_signed_dcc.substr(0, k_signed_dcc.find("</dcc:digital"))));
    EXPECT_TRUE(signed_dcc.ends_with("</ds:Signature></dcc:digitalCalibrationCertificate>\n"));

    const Verification verification = verified(signed_dcc, laboratory);
    ASSERT_EQ(verification.signatures.size(), 1U);
    const SignatureReport& report = verification.signatures[0];
    EXPECT_TRUE(verification.valid) << (report.findings.empty() ? "" : gum::message(report.findings[0]));
    EXPECT_EQ(verification.kind, "dcc");
    EXPECT_EQ(report.format, "XAdES-BASELINE-B");
    EXPECT_EQ(report.signer, "CN=Example Calibration Laboratory");
    EXPECT_EQ(report.issuer, "CN=Example Root");
    EXPECT_EQ(report.signing_time, "2026-03-31T12:00:00Z");
    EXPECT_EQ(report.algorithm, std::string(GetParam()) == "RSA" ? "RSA with SHA-256" : "ECDSA with SHA-256");
    EXPECT_THAT(report.covers, Contains("the whole document without this signature"));
    EXPECT_THAT(report.not_covered, Contains("comments of the XML"));

    if (!program_exists("xmlsec1")) {
        GTEST_SKIP() << "xmlsec1 is missing: no second opinion";
    }
    const auto file = laboratory.folder.put("signed.xml", signed_dcc);
    const auto root = laboratory.folder.put("root.pem", pem(laboratory.root));
    int status = 1;
    const std::string said = output_of("xmlsec1 --verify --trusted-pem " + root.string() +
                                           " --verification-time '2026-03-31 12:00:00' --id-attr:Id "
                                           "http://uri.etsi.org/01903/v1.3.2#:SignedProperties " +
                                           file.string(),
                                       &status);
    EXPECT_EQ(status, 0) << said;
    EXPECT_THAT(said, HasSubstr("SignedInfo References (ok/all): 2/2"));
}

INSTANTIATE_TEST_SUITE_P(Keys, SignDcc, testing::Values("RSA", "P-256", "P-384", "P-521"));

TEST(SignDccOnce, EveryChangeIsFound) {
    const Laboratory laboratory(ec_key());
    const Bytes good = sign_dcc(k_signed_dcc, *laboratory.signer, k_signing_time);
    const auto error_of = [&](const Bytes& xml) {
        const Verification verification = verified(xml, laboratory);
        EXPECT_FALSE(verification.valid);
        return verification.signatures.empty() ? "no signature" : first_error(verification.signatures[0]);
    };
    EXPECT_EQ(error_of(replaced(good, "10.0023", "10.0024")), "GC-SIGN-0117");
    EXPECT_EQ(error_of(replaced(good, "Größe", "Grosse")), "GC-SIGN-0117");
    EXPECT_EQ(error_of(replaced(good, "2026-03-31T12:00:00Z", "2026-03-30T12:00:00Z")), "GC-SIGN-0117");
    EXPECT_EQ(error_of(replaced(good, "</si:real>", "</si:real> ")), "GC-SIGN-0117");
    EXPECT_EQ(error_of(replaced(good, "Id=\"gumcert-signed-document\"", "Id=\"other\"")), "GC-SIGN-0118");
    // The comment is not part of what is signed, and the report says so.
    EXPECT_TRUE(verified(replaced(good, "a comment", "b comment"), laboratory).valid);
    // Without the signature there is nothing to rely on.
    const std::size_t from = good.find("<ds:Signature ");
    const std::size_t to = good.find("</ds:Signature>") + 15;
    EXPECT_EQ(error_of(good.substr(0, from) + good.substr(to)), "no signature");
}

TEST(SignDccOnce, WrappingIsRefused) {
    const Laboratory laboratory(ec_key());
    const Bytes good = sign_dcc(k_signed_dcc, *laboratory.signer, k_signing_time);
    const std::size_t root = good.find("<dcc:digital");
    const std::string original = good.substr(root);
    // The signed document inside another one, whose numbers differ.
    const std::string outer =
        "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" "
        "schemaVersion=\"3.3.0\"><value>99</value>" +
        original + "</dcc:digitalCalibrationCertificate>";
    const Verification wrapped = verified(outer, laboratory);
    ASSERT_EQ(wrapped.signatures.size(), 1U);
    EXPECT_EQ(first_error(wrapped.signatures[0]), "GC-SIGN-0119");
    EXPECT_FALSE(wrapped.valid);

    const auto error_of = [&](const Bytes& xml) {
        const Verification verification = verified(xml, laboratory);
        EXPECT_FALSE(verification.valid);
        return verification.signatures.empty() ? "" : first_error(verification.signatures[0]);
    };
    // A reference to a part instead of the whole.
    EXPECT_EQ(error_of(replaced(good, "URI=\"\"", "URI=\"#part\"")), "GC-SIGN-0112");
    // Another transform, which could drop what it likes.
    EXPECT_EQ(error_of(replaced(good, "<ds:Transform Algorithm=\"http://www.w3.org/2001/10/xml-exc-c14n#\"/>",
                                "<ds:Transform Algorithm=\"http://www.w3.org/TR/1999/REC-xslt-19991116\"/>")),
              "GC-SIGN-0113");
    EXPECT_EQ(
        error_of(replaced(good, "http://www.w3.org/2001/04/xmlenc#sha256", "http://www.w3.org/2000/09/xmldsig#sha1")),
        "GC-SIGN-0111");
    EXPECT_EQ(error_of(replaced(good, "ecdsa-sha256", "ecdsa-sha1")), "GC-SIGN-0111");
    EXPECT_EQ(error_of(replaced(good, "2001/04/xmldsig-more#ecdsa-sha256", "2000/09/xmldsig#hmac-sha1")),
              "GC-SIGN-0111");
    // A second element with the identifier of the signed properties.
    EXPECT_EQ(error_of(replaced(good, "<dcc:name>", "<dcc:name Id=\"gumcert-signed-properties\">")), "GC-SIGN-0114");
    EXPECT_EQ(error_of(replaced(good, "<dcc:name>", "<dcc:name xml:id=\"gumcert-signed-properties\">")),
              "GC-SIGN-0114");
}

TEST(SignDccOnce, TheKeyComesFromTheTrustStoreOnly) {
    const Laboratory laboratory(ec_key());
    const Laboratory stranger(ec_key());
    const Bytes good = sign_dcc(k_signed_dcc, *laboratory.signer, k_signing_time);
    const Verification untrusted = verified(good, stranger);
    EXPECT_FALSE(untrusted.valid);
    EXPECT_EQ(first_error(untrusted.signatures.at(0)), "GC-SIGN-0130");
    EXPECT_FALSE(verify_signatures(good, "c.xml", {}, k_now).valid);
    // The signer's own certificate may be trusted by itself.
    EXPECT_TRUE(verify_signatures(good, "c.xml", std::vector<Bytes>{der(laboratory.own)}, k_now).valid);
    // Signed by the stranger, with the certificate of the laboratory put in.
    const Bytes forged = sign_dcc(k_signed_dcc, *stranger.signer, k_signing_time);
    const auto certificate = [](const Bytes& xml) {
        const std::size_t from = xml.find("<ds:X509Certificate>");
        return xml.substr(from, xml.find("</ds:X509Data>") - from);
    };
    const Verification swapped = verified(replaced(forged, certificate(forged), certificate(good)), laboratory);
    EXPECT_FALSE(swapped.valid);
    EXPECT_EQ(first_error(swapped.signatures.at(0)), "GC-SIGN-0116");
}

TEST(SignDccOnce, TimesAreChecked) {
    const Laboratory laboratory(ec_key());
    const Bytes good = sign_dcc(k_signed_dcc, *laboratory.signer, k_signing_time);
    const Verification before = verify_signatures(good, "c.xml", laboratory.trusted(), k_signing_time - k_day);
    EXPECT_EQ(first_error(before.signatures.at(0)), "GC-SIGN-0134");
    // Years later: the certificate has expired since; the signature stays valid at its time, with a warning.
    const Verification late =
        verify_signatures(good, "c.xml", std::vector<Bytes>{der(laboratory.own)}, k_signing_time + 1000 * k_day);
    EXPECT_TRUE(late.valid);
    EXPECT_THAT(late.signatures.at(0).findings, Contains(testing::Field(&gum::Diagnostic::code, "GC-SIGN-0135")));
    EXPECT_THROW(static_cast<void>(sign_dcc(k_signed_dcc, *laboratory.signer, k_signing_time + 1000 * k_day)),
                 gum::InputError);
    EXPECT_THROW(static_cast<void>(sign_dcc(k_signed_dcc, *laboratory.signer, k_signing_time - 1000 * k_day)),
                 gum::InputError);
}

TEST(SignDccOnce, RefusesWhatItCannotSign) {
    const Laboratory laboratory(ec_key());
    const auto refused = [&](const Bytes& xml) {
        try {
            static_cast<void>(sign_dcc(xml, *laboratory.signer, k_signing_time));
        } catch (const gum::InputError& e) {
            return e.diagnostics().front().code;
        }
        return std::string("signed");
    };
    EXPECT_EQ(refused(replaced(k_signed_dcc, "\"3.3.0\"", "\"3.1.2\"")), "GC-SIGN-0031");
    EXPECT_EQ(refused(replaced(k_signed_dcc, "\"3.3.0\"", "\"3.2.0\"")), "signed");
    EXPECT_EQ(refused(replaced(k_signed_dcc, "https://ptb.de/dcc", "https://example.org")), "GC-SIGN-0031");
    EXPECT_EQ(refused(sign_dcc(k_signed_dcc, *laboratory.signer, k_signing_time)), "GC-SIGN-0032");
    EXPECT_EQ(refused(k_signed_dcc + "<!-- </x> -->"), "GC-SIGN-0033");
    EXPECT_EQ(refused("not XML"), "GC-SIGN-0030");
}

TEST(VerifyXml, RefusesDoctypeAndOtherFiles) {
    EXPECT_THAT(refusal("<!DOCTYPE x [<!ENTITY a \"b\">]><x>&a;</x>"), HasSubstr("DOCTYPE"));
    EXPECT_THAT(refusal("<!DOCTYPE x SYSTEM \"file:///etc/passwd\"><x/>"), HasSubstr("DOCTYPE"));
    EXPECT_THAT(refusal("<x><y></x>"), HasSubstr("not well-formed"));
    EXPECT_THAT(refusal("<x><p:y/></x>"), HasSubstr("not well-formed"));
    EXPECT_THAT(refusal("<p:x/>"), HasSubstr("not well-formed"));
    EXPECT_THAT(refusal("<!DOCTYPE html>\n<html><body></html>"), HasSubstr("HTML page"));
    EXPECT_THAT(refusal("GIF89a"), HasSubstr("neither an XML document nor a PDF"));
    EXPECT_THAT(refusal(""), HasSubstr("neither an XML document nor a PDF"));
    EXPECT_FALSE(verify_signatures("<x/>", "x", {}, k_now).valid);
}

TEST(SharedSamples, VerifyWithTheirOwnCertificateAndNotWithAnotherDigit) {
    struct Sample {
        std::string name, algorithm, format;
    };
    const std::vector<Sample> samples = {
        {"dcclib_valid_signature_3.3.0.xml", "RSA with SHA-256", "XMLDSig"},
        {"dcc_gp_temperature_typical_v12_v3.2.0_signed.xml", "ECDSA with SHA-256", "XAdES-BASELINE-B"}};
    if (!std::filesystem::exists(k_shared)) {
        GTEST_SKIP() << "the shared folder is absent";
    }
    for (const Sample& sample : samples) {
        const std::string xml = file_text(k_shared + "/examples/" + sample.name);
        const std::size_t from = xml.find("<ds:X509Certificate>") + 20;
        std::string certificate = xml.substr(from, xml.find("</ds:X509Certificate>") - from);
        std::erase_if(certificate, [](char c) { return c == '\n' || c == ' ' || c == '\r'; });
        const Folder folder;
        const auto store = folder.put(
            "store.pem", "-----BEGIN CERTIFICATE-----\n" + [&] {
                std::string lines;
                for (std::size_t i = 0; i < certificate.size(); i += 64) {
                    lines += certificate.substr(i, 64) + '\n';
                }
                return lines;
            }() + "-----END CERTIFICATE-----\n");
        const std::vector<Bytes> trusted = read_trust_store(store);
        ASSERT_EQ(trusted.size(), 1U);
        // The signature with RSA claims no time; its certificate is in force during 2026.
        const Verification good = verify_signatures(xml, sample.name, trusted, k_now);
        ASSERT_EQ(good.signatures.size(), 1U);
        EXPECT_TRUE(good.valid) << sample.name << ": " << gum::message(good.signatures[0].findings.at(0));
        EXPECT_EQ(good.signatures[0].algorithm, sample.algorithm);
        EXPECT_EQ(good.signatures[0].format, sample.format);
        std::string changed = xml;
        const std::size_t digit = changed.find_first_of("0123456789", changed.find("<si:value") + 9);
        changed[digit] = changed[digit] == '9' ? '8' : '9';
        const Verification bad = verify_signatures(changed, sample.name, trusted, k_now);
        EXPECT_FALSE(bad.valid);
        EXPECT_EQ(first_error(bad.signatures.at(0)), "GC-SIGN-0117");
    }
}

TEST(SharedSamples, TheSignedExampleKeepsToTheSchema) {
    const std::string example = k_shared + "/worked-example-3.3.0.xml";
    if (!std::filesystem::exists(example) || !program_exists("xmllint")) {
        GTEST_SKIP() << "the shared folder or xmllint is absent";
    }
    const Laboratory laboratory(rsa_key());
    const Bytes xml = sign_dcc(file_text(example), *laboratory.signer, k_signing_time);
    EXPECT_TRUE(verified(xml, laboratory).valid);
    const auto file = laboratory.folder.put("signed.xml", xml);
    int status = 1;
    const std::string said =
        output_of("XML_CATALOG_FILES=" + k_shared + "/xsd/catalog.xml xmllint --nonet --noout --schema " + k_shared +
                      "/xsd/dcc/v3.3.0/dcc.xsd " + file.string(),
                  &status);
    EXPECT_EQ(status, 0) << said;
}

}  // namespace
}  // namespace gumcert::signing
