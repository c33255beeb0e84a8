#include "archive/certificates/archive_files.h"

#include <gtest/gtest.h>

#include <fstream>

#include "archive/archive.h"
#include "archive/store/open_store.h"
#include "tests/support/archive_folder.h"

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

TEST(ArchiveFiles, AnArchiveIsHeldAgainstTheHeadsThatSomebodyHas) {
    const test::StoreFolder folder;
    const Request by{.actor = "K. Keeper", .at = "2026-01-01T00:00:00Z", .request_key = "", .why = ""};
    const auto store =
        create_store(folder.file().string(), first_entry({.four_eyes = false, .numbering = ""}, "gumcert", "1", by));
    const VerifiedFile said = verified_store(*store, TrustedHeads({}, "", "2026-01-01T00:00:00Z"));
    EXPECT_TRUE(said.sound());
    EXPECT_NE(said.text.find(": sound; 1 entry, 0 contents, 0 certificates, 0 earlier heads\n  head "),
              std::string::npos)
        << said.text;
    EXPECT_NE(said.text.find("Without --head nobody can see"), std::string::npos);
    EXPECT_EQ(said.json["schema"], "gumcert/archive-verification/1");
    EXPECT_EQ(said.json["sound"], true);
    EXPECT_EQ(said.json["trusted"], false);
    EXPECT_EQ(said.json["times_to_come"].size(), 0U);

    Head head = Archive(*store).head();
    head.root = std::string(32, 'x');
    std::ofstream(folder.file("other.json")) << to_json(head);
    const VerifiedFile other =
        verified_store(*store, TrustedHeads({folder.file("other.json").string()}, "", "2025-01-01T00:00:00Z"));
    EXPECT_FALSE(other.sound());
    ASSERT_FALSE(other.findings.empty());
    EXPECT_EQ(other.findings.front().code, "GC-ARCHIVE-0045");
    EXPECT_NE(other.text.find(": NOT SOUND; "), std::string::npos) << other.text;
    EXPECT_EQ(other.json["heads"], 1);
    EXPECT_EQ(other.json["times_to_come"].size(), 2U) << "neither the last entry nor the head, by this clock";
}

}  // namespace
}  // namespace gumcert::archive
