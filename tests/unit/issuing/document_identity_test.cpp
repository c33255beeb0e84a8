#include "issuing/document_identity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::issuing {
namespace {

using signing::SignatureReport;
using signing::Verification;
using Codes = std::vector<std::string>;

SignatureReport by(const std::string& common_name, const std::string& organisation = "",
                   const std::string& time = "2026-03-31T12:00:00Z") {
    SignatureReport report;
    report.signer = "CN=" + common_name;
    report.signer_names = {common_name};
    if (!organisation.empty()) {
        report.signer_names.push_back(organisation);
    }
    report.signing_time = time;
    report.valid = true;
    return report;
}

Verification signed_by(std::vector<SignatureReport> signatures, std::vector<SignatureReport> inside = {}) {
    Verification verification;
    verification.kind = inside.empty() ? "dcc" : "pdf";
    verification.signatures = std::move(signatures);
    verification.attachment_signatures = std::move(inside);
    verification.valid = true;
    return verification;
}

DocumentIdentity of(const std::string& laboratory) {
    return {.number = "EX-1",
            .laboratory = laboratory,
            .item = "Gauge",
            .performed_from = "2026-03-30",
            .performed_to = "2026-03-31",
            .issued = "2026-03-31",
            .state = "",
            .attached = false};
}

Codes codes(const DocumentIdentity& identity, const Verification& verification) {
    Codes all;
    for (const gum::Diagnostic& doubt : doubts_about("a.xml", {identity}, verification)) {
        EXPECT_EQ(doubt.severity, gum::Severity::warning);
        all.push_back(doubt.code);
    }
    return all;
}

TEST(DocumentIdentity, TheSignerIsTheLaboratory) {
    const DocumentIdentity identity = of("Example Calibration Laboratory");
    for (const SignatureReport& signer :
         {by("Example Calibration Laboratory"), by("EXAMPLE CALIBRATION LABORATORY Ltd."),
          by("A. Person", "Example Calibration Laboratory"), by("Example Calibration-Laboratory, seal 3")}) {
        EXPECT_EQ(codes(identity, signed_by({signer})), Codes()) << signer.signer;
    }
    for (const SignatureReport& signer :
         {by("another company"), by("A. Person"), by("Lab"), by("A. Person", "Another Laboratory"), by("Example"),
          by("Other Example Calibration Laboratory"), by("Example Calibration"), by("Calibration Laboratory")}) {
        EXPECT_EQ(codes(identity, signed_by({signer})), Codes{"GC-SIGN-0150"}) << signer.signer;
    }
    EXPECT_EQ(codes(of(""), signed_by({by("A. Person")})), Codes());  // it does not say whose it is
}

TEST(DocumentIdentity, PdfAndDigitalCertificateAreOneDocument) {
    DocumentIdentity identity = of("Example Laboratory");
    identity.attached = true;
    Verification verification = signed_by({by("Example Laboratory")}, {by("Example Laboratory")});
    verification.pdf_keywords = "EX-1";
    EXPECT_EQ(codes(identity, verification), Codes());
    verification.pdf_keywords = "EX-2";
    EXPECT_EQ(codes(identity, verification), Codes{"GC-SIGN-0152"});
    verification = signed_by({by("Example Laboratory")}, {by("Example Laboratory, seal")});
    EXPECT_EQ(codes(identity, verification), Codes{"GC-SIGN-0151"});
}

TEST(DocumentIdentity, DatesThatContradictEachOther) {
    DocumentIdentity identity = of("Example Laboratory");
    const auto at = [](const char* time) { return signed_by({by("Example Laboratory", "", time)}); };
    EXPECT_EQ(codes(identity, at("2026-03-31T00:10:00Z")), Codes());
    EXPECT_EQ(codes(identity, at("2026-03-30T23:10:00Z")), Codes());  // it is the next day already further east
    EXPECT_EQ(codes(identity, at("2026-03-29T12:00:00Z")), (Codes{"GC-SIGN-0153", "GC-SIGN-0153"}));
    identity.issued = "2099-01-01";
    EXPECT_EQ(codes(identity, at("2026-03-31T12:00:00Z")), Codes{"GC-SIGN-0153"});
    identity.issued = "2026-03-01";
    EXPECT_EQ(codes(identity, at("2026-03-31T12:00:00Z")), Codes{"GC-SIGN-0153"});
}

TEST(DocumentIdentity, ASignedDraft) {
    DocumentIdentity identity = of("Example Laboratory");
    identity.state = "draft";
    EXPECT_EQ(codes(identity, signed_by({by("Example Laboratory")})), Codes{"GC-SIGN-0154"});
    EXPECT_EQ(codes(identity, signed_by({})), Codes());
}

TEST(DocumentIdentity, IsReadFromTheFileAndFromWhatIsAttached) {
    const std::string dcc =
        "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" schemaVersion=\"3.3.0\">"
        "<dcc:administrativeData><dcc:coreData><dcc:uniqueIdentifier>EX-\u202E7</dcc:uniqueIdentifier>"
        "<dcc:issueDate>2026-03-31</dcc:issueDate></dcc:coreData><dcc:items><dcc:item><dcc:name><dcc:content>Gauge"
        "</dcc:content></dcc:name></dcc:item></dcc:items></dcc:administrativeData>"
        "</dcc:digitalCalibrationCertificate>";
    Verification verification;
    verification.kind = "dcc";
    const std::vector<DocumentIdentity> own = identities_in(dcc, "a.xml", verification);
    ASSERT_EQ(own.size(), 1U);
    EXPECT_EQ(own[0].item, "Gauge");
    EXPECT_EQ(own[0].issued, "2026-03-31");
    EXPECT_EQ(own[0].number.find("\u202E"), std::string::npos) << "what turns a line around is not shown";
    verification.kind = "pdf";
    verification.attachments = {dcc, "<other/>"};
    const std::vector<DocumentIdentity> inside = identities_in("%PDF-", "a.pdf", verification);
    ASSERT_EQ(inside.size(), 1U);
    EXPECT_TRUE(inside[0].attached);
}

}  // namespace
}  // namespace gumcert::issuing
