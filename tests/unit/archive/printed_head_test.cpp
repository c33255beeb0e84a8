#include "archive/printed_head.h"

#include <gtest/gtest.h>

#include "archive/archive.h"
#include "archive/evidence.h"
#include "archive/store/sqlite_store.h"
#include "archive/verification.h"
#include "encoding/sha2.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using test::code_of;

Head sample_head(std::int64_t size) {
    Head head;
    head.size = size;
    head.root = encoding::sha256_bytes("a root");
    return head;
}

TEST(PrintedHead, IsReadBackFromTheBytesOfADocument) {
    const Head head = sample_head(1234);
    EXPECT_EQ(mark_of(head), "gumcert-head:1234:" + encoding::hexadecimal(head.root));
    EXPECT_EQ(short_form(head).size(), 19U);
    EXPECT_EQ(short_form(head).substr(0, 4), encoding::hexadecimal(head.root).substr(0, 4));
    const std::string document = "%PDF /Alt (" + mark_of(head) + ") " + mark_of(head) + mark_of(sample_head(7)) + "x";
    EXPECT_EQ(printed_heads_in(document), (std::vector<PrintedHead>{{1234, head.root}, {7, head.root}}));
}

TEST(PrintedHead, IsNothingElse) {
    const std::string mark = mark_of(sample_head(12));
    for (const std::string& text :
         {std::string("gumcert-head:"), mark.substr(0, mark.size() - 1), "gumcert-head:0" + mark.substr(13),
          "gumcert-head:-1" + mark.substr(15), "gumcert-head:99999999999999999999" + mark.substr(15),
          "gumcert-head: 1" + mark.substr(15)}) {
        EXPECT_TRUE(printed_heads_in(text).empty()) << text;
    }
}

/// From 1 to 2^63 - 1 entries (docs/adr/0059-the-head-on-the-certificate.md, 2).
TEST(PrintedHead, HasASizeInItsRange) {
    const std::string root(64, '0');
    for (const auto& [size, is_head] : std::vector<std::pair<std::string, bool>>{{"1", true},
                                                                                 {"9223372036854775807", true},
                                                                                 {"9223372036854775808", false},
                                                                                 {"9999999999999999999", false},
                                                                                 {"10000000000000000000", false},
                                                                                 {"0", false},
                                                                                 {"01", false},
                                                                                 {"-1", false},
                                                                                 {"+1", false},
                                                                                 {"", false}}) {
        EXPECT_EQ(printed_heads_in("gumcert-head:" + size + ":" + root).size(), is_head ? 1U : 0U) << size;
    }
    EXPECT_TRUE(printed_heads_in("gumcert-head:1:" + std::string(64, 'A')).empty());
}

TEST(PrintedHead, HasItsPlaceBetweenTheFirstDraftAndTheDocument) {
    const PrintedHead head{5, "root"};
    EXPECT_EQ(fault_of(head, true, 5, 6), "");
    EXPECT_NE(fault_of(head, false, 5, 6), "");
    EXPECT_NE(fault_of(head, true, 6, 7), "");
    EXPECT_NE(fault_of(head, true, 5, 5), "");
}

class CertificateWithAHead : public testing::Test {
protected:
    [[nodiscard]] Request by(const std::string& who) {
        return {.actor = who, .at = clock_.next(), .request_key = "", .why = "with the head of the archive"};
    }
    [[nodiscard]] Draft draft_with(const std::string& mark) const {
        Draft draft = test::sample_draft("EX-1");
        draft.documents.push_back({"certificate.html", "text/html", "<p>" + mark + "</p>"});
        return draft;
    }

    test::StoreFolder folder_;
    test::Clock clock_;
    std::unique_ptr<Store> store_ =
        create_sqlite_store(folder_.file(), first_entry({}, "gumcert of the tests", "nonce", by("K. Keeper")));
    Archive archive_{*store_};
};

TEST_F(CertificateWithAHead, IsSoundInTheArchiveAndInItsEvidence) {
    (void)archive_.draft(test::sample_draft("EX-1"), by("A. Author"));
    const Head head = archive_.head();
    (void)archive_.draft(test::sample_draft("EX-2"), by("A. Author"));
    (void)archive_.draft(draft_with(mark_of(head)), by("A. Author"));
    for (const char* const kind : {"reviewed", "authorised", "issued"}) {
        (void)archive_.advance("EX-1", kind, by("R. Reviewer"));
    }
    EXPECT_TRUE(verify_store(*store_).sound());
    const Evidence evidence = evidence_from_json(to_json(evidence_of(*store_, "EX-1")), "evidence");
    ASSERT_EQ(evidence.printed_heads.size(), 1U);
    EXPECT_EQ(evidence.printed_heads[0].root, head.root);
    EXPECT_TRUE(verify_evidence(evidence).findings.empty());

    Evidence spoiled = evidence;
    spoiled.printed_heads.clear();
    EXPECT_EQ(verify_evidence(spoiled).findings.front().code, "GC-ARCHIVE-0053");
    spoiled = evidence;
    spoiled.printed_heads[0].proof.pop_back();
    EXPECT_EQ(verify_evidence(spoiled).findings.front().code, "GC-ARCHIVE-0053");
}

TEST_F(CertificateWithAHead, IsRefusedWhereTheHeadIsAnotherOne) {
    const Head before = archive_.head();
    EXPECT_EQ(code_of([&] { (void)archive_.draft(draft_with(mark_of(before)), by("A. Author")); }), "GC-ARCHIVE-0037")
        << "the record was never drafted";
    (void)archive_.draft(test::sample_draft("EX-1"), by("A. Author"));
    EXPECT_EQ(code_of([&] { (void)archive_.draft(draft_with(mark_of(before)), by("A. Author")); }), "GC-ARCHIVE-0037")
        << "the head does not contain the draft";
    Head other = archive_.head();
    other.root[0] ^= 1;
    EXPECT_EQ(code_of([&] { (void)archive_.draft(draft_with(mark_of(other)), by("A. Author")); }), "GC-ARCHIVE-0037");
    other = archive_.head();
    ++other.size;
    EXPECT_EQ(code_of([&] { (void)archive_.draft(draft_with(mark_of(other)), by("A. Author")); }), "GC-ARCHIVE-0037");
    EXPECT_EQ(code_of([&] { (void)archive_.draft(draft_with(mark_of(archive_.head())), by("A. Author")); }), "");
}

/// A document of 80 MB with 1 000 000 heads, each found once: to look among all that were found would be 500 000 000 000 looks,
/// and would not end in the time that a test has.
TEST(PrintedHead, IsFoundInALongDocumentWithoutLookingBack) {
    constexpr std::int64_t k_many = 1'000'000;
    std::string document;
    Head head;
    head.root = std::string(32, '\x5d');
    for (std::int64_t i = 1; i <= k_many; ++i) {
        head.size = i;
        document += mark_of(head);
    }
    document += document.substr(0, document.size() / 2);
    const std::vector<PrintedHead> found = printed_heads_in(document);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(k_many));
    EXPECT_EQ(found.front().size, 1);
    EXPECT_EQ(found.back().size, k_many);
}

/// Whoever makes the log anew, hashes and all, and keeps the documents, is seen without a head from elsewhere.
TEST_F(CertificateWithAHead, ShowsALogThatWasMadeAnew) {
    (void)archive_.draft(test::sample_draft("EX-1"), by("A. Author"));
    const Draft draft = draft_with(mark_of(archive_.head()));
    (void)archive_.draft(draft, by("A. Author"));
    std::vector<LogEntry> log;
    store_->each_entry([&](const LogEntry& entry) { log.push_back(entry); });
    log[1].actor = "Somebody";
    std::string prev = log[0].hash;
    for (std::size_t i = 1; i < log.size(); ++i) {
        log[i].prev = prev;
        log[i].hash = prev = entry_hash(log[i]);
    }
    const auto forged = create_sqlite_store(folder_.file("forged"), log[0], [&](Store& store) {
        store_->each_content([&](const Content& content) { store.put(content); });
        for (std::size_t i = 1; i < log.size(); ++i) {
            store.append(log[i]);
        }
        list_again(store);
    });
    const Verification verification = verify_store(*forged);
    ASSERT_FALSE(verification.sound());
    EXPECT_EQ(verification.findings.front().code, "GC-ARCHIVE-0053");
}

}  // namespace
}  // namespace gumcert::archive
