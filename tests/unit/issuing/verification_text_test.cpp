#include "issuing/verification_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::issuing {
namespace {

signing::SignatureReport signature_of(const std::string& format, bool valid) {
    signing::SignatureReport signature;
    signature.format = format;
    signature.signer = "CN=Example Laboratory";
    signature.algorithm = "RSA with SHA-256";
    signature.valid = valid;
    signature.covers = {"bytes 0 to 99"};
    signature.not_covered = {"bytes behind 99"};
    return signature;
}

std::string first_line(const signing::Verification& verification) {
    const std::string text = verification_text("a\nb.pdf", verification, {});
    return text.substr(text.find(": ") + 2, text.find('\n') - text.find(": ") - 2);
}

TEST(VerificationText, SaysFirstWhetherTheFileIsValid) {
    signing::Verification verification;
    EXPECT_EQ(first_line(verification), "not signed");
    verification.attachment_signatures = {signature_of("XAdES-BASELINE-B", true)};
    EXPECT_EQ(first_line(verification), "NOT VALID: the pages are not signed, only what is attached to them");
    verification.signatures = {signature_of("PAdES-BASELINE-B", false)};
    EXPECT_EQ(first_line(verification), "NOT VALID");
    verification.valid = true;
    EXPECT_EQ(first_line(verification), "valid");
}

TEST(VerificationText, SaysWhoSignedWhat) {
    signing::Verification verification;
    verification.valid = true;
    verification.signatures = {signature_of("PAdES-BASELINE-B", true)};
    verification.signatures[0].signing_time = "2026-03-31T12:00:00Z";
    verification.attachment_signatures = {signature_of("XAdES-BASELINE-B", false)};
    EXPECT_EQ(verification_text("c.pdf", verification, {}),
              "c.pdf: valid\n"
              "  PAdES-BASELINE-B: valid\n"
              "    signer      CN=Example Laboratory\n"
              "    issued by   not stated\n"
              "    time        2026-03-31T12:00:00Z (as the signer states it)\n"
              "    algorithm   RSA with SHA-256\n"
              "    covers      bytes 0 to 99\n"
              "    not covered bytes behind 99\n"
              "  attached certificate, XAdES-BASELINE-B: NOT VALID\n"
              "    signer      CN=Example Laboratory\n"
              "    issued by   not stated\n"
              "    time        not stated\n"
              "    algorithm   RSA with SHA-256\n"
              "    covers      bytes 0 to 99\n"
              "    not covered bytes behind 99\n");
}

TEST(VerificationText, SaysWhoseDocumentItIs) {
    DocumentIdentity identity;
    identity.number = "EX-1";
    identity.laboratory = "Example Laboratory";
    identity.performed_from = "2026-11-20";
    identity.performed_to = "2026-11-21";
    identity.attached = true;
    EXPECT_THAT(verification_text("c.pdf", {}, {identity}),
                testing::EndsWith("  number      EX-1 (of the digital certificate in it)\n"
                                  "  laboratory  Example Laboratory\n"
                                  "  performed   2026-11-20 to 2026-11-21\n"));
    identity.performed_to = "2026-11-20";
    identity.state = "draft";
    EXPECT_THAT(verification_text("c.pdf", {}, {identity}),
                testing::EndsWith("  performed   2026-11-20\n  state       draft\n"));
}

}  // namespace
}  // namespace gumcert::issuing
