#include "outputs/output_set.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "encoding/sha2.h"
#include "outputs/output_files.h"

namespace gumcert::outputs {
namespace {

namespace fs = std::filesystem;

SetFile set_file(const std::string& name, const std::string& bytes = "x") {
    return {.name = name, .sha256 = encoding::sha256(bytes), .part = ""};
}

TEST(OutputSetText, RoundTrip) {
    SetManifest manifest;
    manifest = with_written(manifest, {set_file("record.json"), set_file("Prüfschein.pdf")});
    manifest = with_written(manifest, {set_file("a"), set_file("b")});
    const std::optional<SetManifest> read = set_manifest_from_json(to_json(manifest));
    ASSERT_TRUE(read);
    EXPECT_EQ(to_json(*read), to_json(manifest));
    ASSERT_EQ(read->sets.size(), 2U);
    EXPECT_EQ(read->sets[0][0].name, "Prüfschein.pdf");
    EXPECT_TRUE(lists(*read, "b"));
    EXPECT_FALSE(lists(*read, "c"));
}

TEST(OutputSetText, WhatIsNoManifestIsRefused) {
    const std::string digest(64, 'a');
    const auto with_file = [](const std::string& file) {
        return R"({"schema": "gumcert/set/1", "sets": [{"files": [)" + file + "]}]}";
    };
    const auto file = [&](const std::string& name, const std::string& more = "") {
        return R"({"name": ")" + name + R"(", "sha256": ")" + digest + "\"" + more + "}";
    };
    EXPECT_TRUE(set_manifest_from_json(with_file(file("a"))));
    EXPECT_TRUE(set_manifest_from_json(with_file(file("a", R"(, "part": ".gumcert-0123456789abcdef.part")"))));
    for (const std::string& text : {std::string(),
                                    std::string("[]"),
                                    std::string("{}"),
                                    with_file(""),
                                    with_file("1"),
                                    with_file("{}"),
                                    with_file(file("")),
                                    with_file(file(".")),
                                    with_file(file("..")),
                                    with_file(file("../a")),
                                    with_file(file("/etc/passwd")),
                                    with_file(file("a") + "," + file("a")),
                                    with_file(file("a", R"(, "part": "b")")),
                                    with_file(file("a", R"(, "part": "")")),
                                    with_file(file("a", R"(, "part": "x/.gumcert-0123456789abcdef.part")")),
                                    with_file(file("a", R"(, "more": 1)")),
                                    with_file(R"({"name": "a", "sha256": "AA"})"),
                                    std::string(R"({"schema": "gumcert/set/2", "sets": []})"),
                                    std::string(R"({"schema": "gumcert/set/1", "sets": [{"files": []}]})"),
                                    std::string(R"({"schema": "gumcert/set/1", "sets": [], "sets": []})")}) {
        EXPECT_FALSE(set_manifest_from_json(text)) << text;
    }
}

TEST(OutputSetText, ASetThatLosesAFileIsNoneAnyMore) {
    SetManifest manifest = with_written({}, {set_file("record.json"), set_file("certificate.pdf")});
    manifest = with_written(manifest, {set_file("certificate.pdf", "signed")});
    ASSERT_EQ(manifest.sets.size(), 1U) << "a file that is written alone stays a member";
    EXPECT_EQ(manifest.sets[0][0].sha256, encoding::sha256("signed"));
    manifest = with_written(manifest, {set_file("record.json"), set_file("audit.html")});
    ASSERT_EQ(manifest.sets.size(), 1U);
    EXPECT_FALSE(lists(manifest, "certificate.pdf")) << "it is of an earlier evaluation";
}

class OutputSetTest : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) / ("output_set_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    void put(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    [[nodiscard]] std::string codes() const {
        std::string all;
        for (const gum::Diagnostic& finding : check_sets(folder_)) {
            all += finding.code + " ";
        }
        return all;
    }
    fs::path folder_;
};

TEST_F(OutputSetTest, FilesAreHeldAgainstTheManifest) {
    EXPECT_EQ(codes(), "GC-STORE-0015 ") << "there is none";
    write_files({{folder_ / "record.json", "r"}, {folder_ / "certificate.pdf", "p"}});
    EXPECT_EQ(codes(), "");
    put("certificate.pdf", "q");
    EXPECT_EQ(codes(), "GC-STORE-0014 ");
    ASSERT_EQ(doubts_about_set(folder_ / "certificate.pdf", "q").size(), 1U);
    EXPECT_EQ(doubts_about_set(folder_ / "certificate.pdf", "q")[0].severity, gum::Severity::warning);
    EXPECT_TRUE(doubts_about_set(folder_ / "record.json", "r").empty());
    EXPECT_TRUE(doubts_about_set(folder_ / "notes.txt", "mine").empty());
    fs::remove(folder_ / "record.json");
    EXPECT_EQ(codes(), "GC-STORE-0014 GC-STORE-0014 ");
    write_files({{folder_ / "record.json", "r2"}, {folder_ / "certificate.pdf", "p2"}});
    EXPECT_EQ(codes(), "");
    write_files({{folder_ / "certificate.pdf", "signed"}});
    EXPECT_EQ(codes(), "") << "the manifest follows a file of its set";
    write_files({{folder_ / "alone.pdf", "x"}});
    EXPECT_EQ(codes(), "") << "and is not concerned by others";
    put(k_set_journal, "{}");
    EXPECT_EQ(codes(), "GC-STORE-0013 ");
    EXPECT_EQ(doubts_about_set(folder_ / "record.json", "r2").size(), 1U);
    fs::remove(folder_ / k_set_journal);
    put(k_set_manifest, "{}");
    EXPECT_EQ(codes(), "GC-STORE-0015 ");
    EXPECT_THROW((void)manifest_in(folder_), gum::StorageError);
    write_files({{folder_ / "record.json", "r3"}, {folder_ / "certificate.pdf", "p3"}});
    EXPECT_EQ(codes(), "") << "a damaged one is replaced";
}

}  // namespace
}  // namespace gumcert::outputs
