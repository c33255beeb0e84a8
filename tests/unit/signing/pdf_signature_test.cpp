#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/cms.h>

#include "signing/qpdf_objects.h"
#include "signing/signer.h"
#include "signing/verify.h"
#include "tests/unit/signing/plain_pdf.h"
#include "tests/unit/signing/test_keys.h"

namespace gumcert::signing {
namespace {

using testing::Contains;
using testing::HasSubstr;
using namespace test;

const std::string k_signed_pdf_dcc =
    "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" schemaVersion=\"3.3.0\">10.0023"
    "</dcc:digitalCalibrationCertificate>";

Verification verify(const Bytes& pdf, const Laboratory& laboratory) {
    return verify_signatures(pdf, "certificate.pdf", laboratory.trusted(), k_now);
}

std::string error_of(const Bytes& pdf, const Laboratory& laboratory) {
    const Verification verification = verify(pdf, laboratory);
    EXPECT_FALSE(verification.valid);
    return verification.signatures.empty() ? "no signature" : first_error(verification.signatures[0]);
}

class SignPdf : public testing::TestWithParam<const char*> {};

TEST_P(SignPdf, IsVerifiedHereByPdfsigAndByOpenssl) {
    const Laboratory laboratory(std::string(GetParam()) == "RSA" ? rsa_key() : ec_key(GetParam()));
    const Bytes pdf = sign_pdf(plain_pdf(), *laboratory.signer, k_signing_time);
    const Verification verification = verify(pdf, laboratory);
    ASSERT_EQ(verification.signatures.size(), 1U);
    const SignatureReport& report = verification.signatures[0];
    EXPECT_TRUE(verification.valid) << gum::message(report.findings.at(0));
    EXPECT_EQ(verification.kind, "pdf");
    EXPECT_EQ(report.format, "PAdES-BASELINE-B");
    EXPECT_EQ(report.signer, "CN=Example Calibration Laboratory");
    EXPECT_EQ(report.signing_time, "2026-03-31T12:00:00Z");
    EXPECT_EQ(report.algorithm, std::string(GetParam()) == "RSA" ? "RSA with SHA-256" : "ECDSA with SHA-256");
    EXPECT_TRUE(report.not_covered.empty());

    const auto file = laboratory.folder.put("signed.pdf", pdf);
    if (program_exists("qpdf")) {
        int status = 1;
        const std::string said = output_of("qpdf --check " + file.string(), &status);
        EXPECT_EQ(status, 0) << said;
    }
    if (!program_exists("pdfsig")) {
        GTEST_SKIP() << "pdfsig is missing: no second opinion";
    }
    const std::string said = output_of("pdfsig -nocert " + file.string());
    EXPECT_THAT(said, HasSubstr("Signature is Valid."));
    EXPECT_THAT(said, HasSubstr("Signature Type: ETSI.CAdES.detached"));
    EXPECT_THAT(said, HasSubstr("Total document signed"));
}

INSTANTIATE_TEST_SUITE_P(Keys, SignPdf, testing::Values("RSA", "P-256", "P-384", "P-521"));

TEST(SignPdfOnce, TheCmsHasTheAttributesOfPades) {
    const Laboratory laboratory(ec_key());
    const Bytes pdf = sign_pdf(plain_pdf(), *laboratory.signer, k_signing_time);
    QPDF document;
    document.processMemoryFile("signed", pdf.data(), pdf.size());
    auto field = document.getRoot().getKey("/AcroForm").getKey("/Fields").getArrayItem(0);
    auto signature = field.getKey("/V");
    EXPECT_EQ(signature.getKey("/SubFilter").getName(), "/ETSI.CAdES.detached");
    EXPECT_EQ(signature.getKey("/M").getStringValue(), "D:20260331120000Z");
    EXPECT_EQ(field.getKey("/F").getIntValue(), 132);
    const std::string contents = signature.getKey("/Contents").getStringValue();
    const auto* at = reinterpret_cast<const unsigned char*>(contents.data());
    CMS_ContentInfo* cms = d2i_CMS_ContentInfo(nullptr, &at, static_cast<long>(contents.size()));
    ASSERT_NE(cms, nullptr);
    EXPECT_EQ(CMS_is_detached(cms), 1);
    CMS_SignerInfo* info = sk_CMS_SignerInfo_value(CMS_get0_SignerInfos(cms), 0);
    EXPECT_EQ(CMS_signed_get_attr_count(info), 3);
    EXPECT_GE(CMS_signed_get_attr_by_NID(info, NID_pkcs9_contentType, -1), 0);
    EXPECT_GE(CMS_signed_get_attr_by_NID(info, NID_pkcs9_messageDigest, -1), 0);
    EXPECT_GE(CMS_signed_get_attr_by_NID(info, NID_id_smime_aa_signingCertificateV2, -1), 0);
    EXPECT_LT(CMS_signed_get_attr_by_NID(info, NID_pkcs9_signingTime, -1), 0);

    // OpenSSL's own check, with chain and CAdES attributes, on the bytes of the ByteRange.
    auto range = signature.getKey("/ByteRange");
    const auto position = [&](int i) { return static_cast<std::size_t>(range.getArrayItem(i).getIntValue()); };
    const std::string data = pdf.substr(0, position(1)) + pdf.substr(position(2), position(3));
    EXPECT_EQ(position(2) + position(3), pdf.size());
    X509_STORE* store = X509_STORE_new();
    X509_STORE_add_cert(store, laboratory.root.certificate.get());
    X509_VERIFY_PARAM* rules = X509_STORE_get0_param(store);
    X509_VERIFY_PARAM_set_time(rules, k_signing_time);
    X509_VERIFY_PARAM_set_purpose(rules, X509_PURPOSE_ANY);
    BIO* in = BIO_new_mem_buf(data.data(), static_cast<int>(data.size()));
    EXPECT_EQ(CMS_verify(cms, nullptr, store, in, nullptr, CMS_BINARY | CMS_CADES), 1);
    BIO_free(in);
    X509_STORE_free(store);
    CMS_ContentInfo_free(cms);
}

TEST(SignPdfOnce, TheSameInputGivesTheSameBytesWithRsa) {
    const Laboratory laboratory(rsa_key());
    const Bytes pdf = plain_pdf(k_signed_pdf_dcc);
    EXPECT_EQ(sign_pdf(pdf, *laboratory.signer, k_signing_time), sign_pdf(pdf, *laboratory.signer, k_signing_time));
}

TEST(SignPdfOnce, EveryChangeIsFound) {
    const Laboratory laboratory(ec_key());
    const Bytes good = sign_pdf(plain_pdf(), *laboratory.signer, k_signing_time);
    EXPECT_EQ(error_of(replaced(good, "D:20260331120000Z", "D:20260330120000Z"), laboratory), "GC-SIGN-0117");
    const std::size_t gap = good.find("/Contents <") + 10;
    const std::size_t gap_end = good.find('>', gap);
    // Behind the CMS there is room, which is filled with zeros and nothing else.
    EXPECT_EQ(error_of(Bytes(good).replace(gap_end - 1, 1, "1"), laboratory), "GC-SIGN-0143");
    for (std::size_t at = 5; at < good.size(); at += 7) {
        if (at > gap && at < gap_end) {
            continue;  // the certificates of issuers in there are not part of what is signed
        }
        Bytes changed = good;
        changed[at] = static_cast<char>(changed[at] ^ 1);
        bool valid = false;
        try {
            valid = verify(changed, laboratory).valid;
        } catch (const gum::InputError&) {
            continue;  // the file cannot be read any more
        }
        EXPECT_FALSE(valid) << "byte " << at;
    }
}

TEST(SignPdfOnce, LaterChangesAreReported) {
    const Laboratory laboratory(ec_key());
    const Bytes good = sign_pdf(plain_pdf(), *laboratory.signer, k_signing_time);
    const std::size_t table = good.rfind("startxref\n") + 10;
    const std::string previous = good.substr(table, good.find('\n', table) - table);
    const std::string update = "\n99 0 obj\n<< /Other true >>\nendobj\n";
    const std::size_t at = good.size() + 1;
    std::string offset = std::to_string(at);
    offset = std::string(10 - offset.size(), '0') + offset;
    const Bytes later = good + update + "xref\n99 1\n" + offset +
                        " 00000 n \ntrailer\n<< /Size 100 /Root 1 0 R /Prev " + previous + " >>\nstartxref\n" +
                        std::to_string(good.size() + update.size()) + "\n%%EOF\n";
    const Verification verification = verify(later, laboratory);
    ASSERT_EQ(verification.signatures.size(), 1U);
    EXPECT_FALSE(verification.valid);
    ASSERT_EQ(first_error(verification.signatures[0]), "GC-SIGN-0142");
    EXPECT_THAT(verification.signatures[0].findings[0].what, HasSubstr("were added"));
    EXPECT_THAT(verification.signatures[0].not_covered, Contains(HasSubstr("bytes behind what was signed")));
}

TEST(SignPdfOnce, TheRangeMustBeTheWholeFile) {
    const Laboratory laboratory(ec_key());
    const Bytes good = sign_pdf(plain_pdf(), *laboratory.signer, k_signing_time);
    const std::size_t from = good.find("/ByteRange [ 0 ") + 15;
    const std::size_t to = good.find(' ', from);
    const std::string gap = good.substr(from, to - from);
    const auto with_gap = [&](const std::string& number) {
        Bytes changed = good;
        return changed.replace(from, gap.size(), number + std::string(gap.size() - number.size(), ' '));
    };
    EXPECT_EQ(error_of(with_gap("7"), laboratory), "GC-SIGN-0141");
    EXPECT_EQ(error_of(with_gap("-1"), laboratory), "GC-SIGN-0141");
    EXPECT_EQ(error_of(replaced(good, "/ByteRange [ 0 ", "/ByteRange [ 1 "), laboratory), "GC-SIGN-0141");
    EXPECT_EQ(error_of(replaced(good, "/ETSI.CAdES.detached", "/ETSI.RFC3161       "), laboratory), "GC-SIGN-0140");
    EXPECT_EQ(error_of(replaced(good, "/ETSI.CAdES.detached", "/adbe.pkcs7.detached"), laboratory), "GC-SIGN-0117");
}

TEST(SignPdfOnce, TheKeyComesFromTheTrustStoreOnly) {
    const Laboratory laboratory(ec_key());
    const Laboratory stranger(ec_key());
    const Bytes good = sign_pdf(plain_pdf(), *laboratory.signer, k_signing_time);
    EXPECT_EQ(error_of(good, stranger), "GC-SIGN-0130");
    const Verification early = verify_signatures(good, "c.pdf", laboratory.trusted(), k_signing_time - k_day);
    EXPECT_EQ(first_error(early.signatures.at(0)), "GC-SIGN-0134");
}

TEST(SignPdfOnce, TheAttachmentStaysAndIsVerified) {
    const Laboratory laboratory(ec_key());
    const Bytes dcc = sign_dcc(k_signed_pdf_dcc, *laboratory.signer, k_signing_time);
    const Bytes pdf = sign_pdf(plain_pdf(dcc), *laboratory.signer, k_signing_time);
    QPDF document;
    document.processMemoryFile("signed", pdf.data(), pdf.size());
    auto files = QPDFEmbeddedFileDocumentHelper(document).getEmbeddedFiles();
    ASSERT_EQ(files.size(), 1U);
    const auto data = files.begin()->second->getEmbeddedFileStream().getStreamData();
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(data->getBuffer()), data->getSize()), dcc);

    const Verification good = verify(pdf, laboratory);
    EXPECT_TRUE(good.valid);
    ASSERT_EQ(good.attachment_signatures.size(), 1U);
    EXPECT_EQ(good.attachment_signatures[0].format, "XAdES-BASELINE-B");

    // A PDF that is well signed around a certificate that was changed.
    const Bytes bad = sign_pdf(plain_pdf(replaced(dcc, "10.0023", "10.0024")), *laboratory.signer, k_signing_time);
    const Verification verification = verify(bad, laboratory);
    EXPECT_TRUE(verification.signatures.at(0).valid);
    EXPECT_FALSE(verification.attachment_signatures.at(0).valid);
    EXPECT_FALSE(verification.valid);
    const Bytes hostile = sign_pdf(plain_pdf("<!DOCTYPE x><x/>"), *laboratory.signer, k_signing_time);
    EXPECT_FALSE(verify(hostile, laboratory).valid);
}

TEST(SignPdfOnce, RefusesWhatItCannotSign) {
    const Laboratory laboratory(ec_key());
    const auto refusal = [&](const Bytes& pdf) {
        try {
            static_cast<void>(sign_pdf(pdf, *laboratory.signer, k_signing_time));
        } catch (const gum::InputError& e) {
            return e.diagnostics().front().code;
        }
        return std::string("signed");
    };
    EXPECT_EQ(refusal("%PDF-1.7\nnonsense"), "GC-SIGN-0041");
    EXPECT_EQ(refusal(""), "GC-SIGN-0041");
    EXPECT_EQ(refusal(sign_pdf(plain_pdf(), *laboratory.signer, k_signing_time)), "GC-SIGN-0042");
}

TEST(VerifyPdf, WithoutSignatureIsNotValid) {
    const Verification verification = verify_signatures(plain_pdf(), "c.pdf", {}, k_now);
    EXPECT_FALSE(verification.valid);
    EXPECT_TRUE(verification.signatures.empty());
    EXPECT_THROW(static_cast<void>(verify_signatures("%PDF-1.7\n%%EOF", "c.pdf", {}, k_now)), gum::InputError);
}

}  // namespace
}  // namespace gumcert::signing
