#include "archive/certificates/archive_files.h"

#include <gtest/gtest.h>

namespace gumcert::archive {
namespace {

TEST(ArchiveFiles, AreKnownByTheirSchema) {
    EXPECT_EQ(archive_file_of(R"({"schema":"gumcert/archive-head/1"})"), ArchiveFile::head);
    EXPECT_EQ(archive_file_of(R"({"schema":"gumcert/archive-evidence/1"})"), ArchiveFile::evidence);
    EXPECT_EQ(archive_file_of(R"({"schema":"gumcert/archive-head/2"})"), ArchiveFile::other);
    EXPECT_EQ(archive_file_of(R"(["gumcert/archive-head/1"])"), ArchiveFile::other);
    EXPECT_EQ(archive_file_of(R"({"schema":)"), ArchiveFile::other);
    EXPECT_EQ(archive_file_of(""), ArchiveFile::other);
}

TEST(ArchiveFiles, HaveNamesThatStayInTheirFolder) {
    EXPECT_EQ(file_name_of_number("EX-2026-0042/A1"), "EX-2026-0042_A1");
    EXPECT_EQ(file_name_of_number("../a b\\c:d"), ".._a_b_c_d");
    EXPECT_EQ(file_name_of_number("EX-1"), "EX-1");
}

TEST(ArchiveFiles, OfEvidenceNameTheirCertificate) {
    EXPECT_EQ(certificate_of_evidence(R"({"schema":"gumcert/archive-evidence/1","certificate":"EX-1"})"), "EX-1");
    EXPECT_EQ(certificate_of_evidence(R"({"schema":"gumcert/archive-evidence/1","certificate":1})"), "");
    EXPECT_EQ(certificate_of_evidence(R"({"schema":"gumcert/archive-head/1","certificate":"EX-1"})"), "");
    EXPECT_EQ(certificate_of_evidence("EX-1"), "");
}

TEST(ArchiveFiles, OfATimeThatHasNotComeAreTold) {
    EXPECT_EQ(time_to_come("the head", "2026-11-24T10:00:00Z", "2026-11-24T10:00:00Z"), "");
    EXPECT_EQ(time_to_come("the head", "2026-11-24T10:00:01Z", "2026-11-24T10:00:00Z"),
              "the head is of 2026-11-24T10:00:01Z, which has not come by the clock of this machine");
}

TEST(ArchiveFiles, OfWhichEvidenceSaysNothingAreFindings) {
    const std::vector<gum::Diagnostic> findings =
        findings_of({{.file = "a.pdf", .sha256 = "00", .is_told = true}, {.file = "b.pdf", .sha256 = "01"}});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings.front().code, "GC-ARCHIVE-0057");
    EXPECT_EQ(findings.front().where, "b.pdf");
}

TEST(ArchiveFiles, HeadsOfNobodyTrustNothing) {
    const TrustedHeads none({}, "", "2026-11-24T10:00:00Z");
    EXPECT_FALSE(none.has_key());
    EXPECT_TRUE(none.all().empty());
    EXPECT_TRUE(none.findings().empty());
    EXPECT_TRUE(none.times_to_come().empty());
}

}  // namespace
}  // namespace gumcert::archive
