#include "archive/log_texts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "archive/store/open_store.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<ListedCertificate> two_certificates() {
    return {{.number = "EX-2026-0001",
             .state = "issued",
             .since = "2026-01-01T00:00:00Z",
             .item = "End gauge",
             .record = "a"},
            {.number = "EX-2026-0002",
             .state = "drafted",
             .since = "2026-02-01T00:00:00Z",
             .item = "Ring\ngauge",
             .record = ""}};
}

TEST(LogTexts, HaveALineForEachCertificate) {
    EXPECT_EQ(list_text({}), "No certificates.\n");
    EXPECT_EQ(list_text({two_certificates().front()}),
              "EX-2026-0001              issued      2026-01-01T00:00:00Z  End gauge\n");
    const std::string both = list_text(two_certificates());
    EXPECT_EQ(std::count(both.begin(), both.end(), '\n'), 2) << "no item brings a line of its own";
}

TEST(LogTexts, HaveCertificatesForPrograms) {
    const nlohmann::json list = list_json(two_certificates());
    EXPECT_EQ(list["schema"], "gumcert/archive-list/1");
    ASSERT_EQ(list["certificates"].size(), 2U);
    EXPECT_EQ(list["certificates"][1], (nlohmann::json{{"number", "EX-2026-0002"},
                                                       {"state", "drafted"},
                                                       {"since", "2026-02-01T00:00:00Z"},
                                                       {"item", "Ring\ngauge"},
                                                       {"record", ""}}));
    EXPECT_TRUE(list_json({})["certificates"].is_array());
}

TEST(LogTexts, FindCertificatesByEachOfSomeWords) {
    const auto found = [](const std::vector<std::string>& words) {
        std::vector<std::string> numbers;
        for (const ListedCertificate& one : with_words(two_certificates(), words)) {
            numbers.push_back(one.number);
        }
        return numbers;
    };
    EXPECT_THAT(found({}), ElementsAre("EX-2026-0001", "EX-2026-0002"));
    EXPECT_THAT(found({"GAUGE"}), ElementsAre("EX-2026-0001", "EX-2026-0002"));
    EXPECT_THAT(found({"gauge", "issued"}), ElementsAre("EX-2026-0001"));
    EXPECT_THAT(found({"-0002"}), ElementsAre("EX-2026-0002"));
    EXPECT_THAT(found({"issuedEX"}), ElementsAre()) << "a word lies in one of the four";
}

TEST(LogTexts, TellWhatBecameOfACertificate) {
    const test::StoreFolder folder;
    test::Clock clock;
    const auto by = [&](const std::string& who, const std::string& why = "") {
        return Request{.actor = who, .at = clock.next(), .request_key = "", .why = why};
    };
    const auto store = create_store(
        folder.file().string(), first_entry({.four_eyes = false, .numbering = ""}, "gumcert", "1", by("K. Keeper")));
    Archive archive(*store);
    (void)archive.draft(test::sample_draft("N-1"), by("A. Author"));
    (void)archive.advance("N-1", "withdrawn", by("R. Reviewer", "a wrong\nserial number"));

    const std::string text = history_text(archive, "N-1");
    EXPECT_THAT(text, testing::StartsWith("N-1: withdrawn since 2026-01-01T00:02:00Z\n"));
    EXPECT_THAT(text, HasSubstr("  2026-01-01T00:01:00Z  drafted     A. Author\n        record "));
    EXPECT_THAT(text, HasSubstr("        certificate.pdf "));
    EXPECT_THAT(text, HasSubstr("withdrawn   R. Reviewer: a wrong"));
    EXPECT_EQ(text.find("\nserial number"), std::string::npos) << "no reason brings a line of its own";

    const nlohmann::json history = history_json(archive, "N-1");
    EXPECT_EQ(history["schema"], "gumcert/archive-certificate/1");
    EXPECT_EQ(history["state"], "withdrawn");
    ASSERT_EQ(history["entries"].size(), 2U);
    EXPECT_EQ(history["entries"][1]["by"], "R. Reviewer");
    EXPECT_EQ(history["entries"][1]["body"]["why"], "a wrong\nserial number");
    EXPECT_EQ(test::code_of([&] { (void)history_text(archive, "N-2"); }), "GC-ARCHIVE-0026");
}

/// Of each entry: whether its clock was set right after it was ahead, or was ahead, as a later entry says, also of others.
TEST(LogTexts, TellOfClocksThatWereAhead) {
    const test::StoreFolder folder;
    const auto by = [](const std::string& at) {
        return Request{.actor = "R. Lin", .at = at, .request_key = "", .why = "w", .confirmed_day = at.substr(0, 10)};
    };
    const auto store = create_store(folder.file().string(), first_entry({.four_eyes = false, .numbering = ""},
                                                                        "gumcert", "1", by("2026-01-01T00:00:00Z")));
    Archive archive(*store);
    (void)archive.draft(test::sample_draft("N-1"), by("2026-01-02T00:00:00Z"));
    (void)archive.advance("N-1", "reviewed", by("2026-02-01T00:00:00Z"));
    EXPECT_EQ(history_text(archive, "N-1").find("clock"), std::string::npos);
    (void)archive.draft(test::sample_draft("N-2"), by("2026-01-03T00:00:00Z"));
    EXPECT_THAT(history_text(archive, "N-1"),
                HasSubstr("  2026-02-01T00:00:00Z (a later entry says that this clock was ahead)  reviewed "));
    EXPECT_THAT(history_text(archive, "N-1"), HasSubstr("  2026-01-02T00:00:00Z  drafted "));
    EXPECT_THAT(history_text(archive, "N-2"),
                HasSubstr("  2026-02-01T00:00:00Z (the clock said 2026-01-03T00:00:00Z)  drafted "));
    EXPECT_EQ(history_json(archive, "N-1")["entries"][0]["clock_was_ahead"], false);
    EXPECT_EQ(history_json(archive, "N-1")["entries"][1]["clock_was_ahead"], true);
}

}  // namespace
}  // namespace gumcert::archive
