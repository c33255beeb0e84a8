#include "archive/verification.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>

#include "archive/archive.h"
#include "archive/store/open_store.h"
#include "archive/store/sqlite_store.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

// tests/archive/tamper_test.py attacks in many more ways; here stands which code tells of which one.
class VerifiedArchive : public testing::Test {
protected:
    VerifiedArchive() {
        test::ArchiveOfChance chance(3);
        const auto store = create_sqlite_store(folder_.file(), chance.first());
        Archive archive(*store);
        chance.fill(archive, 10);
        head_ = archive.head();
    }
    /// Codes that are found after some SQL on an archive without triggers.
    std::vector<std::string> found_after(const std::string& sql, const std::vector<Head>& heads = {}) {
        sqlite3* database = nullptr;
        sqlite3_open(folder_.file().c_str(), &database);
        const std::string all =
            "DROP TRIGGER IF EXISTS log_is_not_updated; DROP TRIGGER IF EXISTS log_is_not_deleted; "
            "DROP TRIGGER IF EXISTS content_is_not_updated; DROP TRIGGER IF EXISTS content_is_not_deleted;" +
            sql;
        EXPECT_EQ(sqlite3_exec(database, all.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
            << sqlite3_errmsg(database);
        sqlite3_close(database);
        const auto store = open_sqlite_store(folder_.file(), Access::read_only);
        std::vector<std::string> codes;
        for (const gum::Diagnostic& one : verify_store(*store, heads).findings) {
            if (one.code != "GC-ARCHIVE-0046" && std::find(codes.begin(), codes.end(), one.code) == codes.end()) {
                codes.push_back(one.code);  // -0046: the triggers that are not there
            }
        }
        std::sort(codes.begin(), codes.end());
        return codes;
    }

    test::StoreFolder folder_;
    Head head_;
};

using Codes = std::vector<std::string>;

TEST_F(VerifiedArchive, IsSoundAsItWasWritten) {
    const auto store = open_sqlite_store(folder_.file(), Access::read_only);
    int reports = 0;
    const Verification verification = verify_store(*store, {head_}, [&](const std::string&) { ++reports; });
    EXPECT_TRUE(verification.sound());
    EXPECT_EQ(verification.head, head_);
    EXPECT_EQ(static_cast<std::int64_t>(verification.entries), head_.size);
    EXPECT_EQ(reports, 0) << "a small archive is done before anybody waits";
}

TEST_F(VerifiedArchive, TellsOfAnEditedEntry) {
    EXPECT_EQ(found_after("UPDATE log SET body = replace(body, 'why', 'wHy') WHERE seq = 2"), Codes{"GC-ARCHIVE-0040"});
}

TEST_F(VerifiedArchive, TellsOfAMissingEntry) {
    const Codes codes = found_after("DELETE FROM log WHERE seq = 1");
    EXPECT_EQ(codes[0], "GC-ARCHIVE-0041");
    EXPECT_EQ(codes[1], "GC-ARCHIVE-0042");
}

TEST_F(VerifiedArchive, TellsOfAnEmptyLog) {
    EXPECT_EQ(found_after("DELETE FROM content; DELETE FROM log; DELETE FROM listed"), Codes{"GC-ARCHIVE-0042"});
}

TEST_F(VerifiedArchive, TellsOfAnotherContent) {
    EXPECT_EQ(found_after("UPDATE content SET bytes = x'00' WHERE rowid = 1"), Codes{"GC-ARCHIVE-0044"});
}

TEST_F(VerifiedArchive, TellsOfAListThatSaysOtherwise) {
    EXPECT_EQ(
        found_after("UPDATE listed SET state = 'withdrawn' WHERE certificate = (SELECT min(certificate) FROM listed)"),
        Codes{"GC-ARCHIVE-0052"});
    const auto made_again =
        replay_into(*open_sqlite_store(folder_.file(), Access::read_only), folder_.file("again").string(), list_again);
    EXPECT_TRUE(verify_store(*made_again, {head_}).sound());
}

TEST_F(VerifiedArchive, TellsOfAListThatLacksACertificateOrHasOneMore) {
    EXPECT_EQ(found_after("DELETE FROM listed WHERE certificate = (SELECT min(certificate) FROM listed)"),
              Codes{"GC-ARCHIVE-0052"});
    EXPECT_EQ(found_after("DELETE FROM listed; INSERT INTO listed VALUES('X', 'issued', '', '', '')"),
              Codes{"GC-ARCHIVE-0052"});
}

TEST_F(VerifiedArchive, TellsOfAMissingContent) {
    EXPECT_EQ(found_after("PRAGMA foreign_keys = OFF; DELETE FROM content WHERE rowid = 1"), Codes{"GC-ARCHIVE-0044"});
}

TEST_F(VerifiedArchive, TellsOfAHeadThatItDoesNotReach) {
    Head longer = head_;
    ++longer.size;
    EXPECT_EQ(found_after("", {longer}), Codes{"GC-ARCHIVE-0045"});
    Head other = head_;
    other.archive[0] ^= 1;
    const auto store = open_sqlite_store(folder_.file(), Access::read_only);
    EXPECT_FALSE(verify_store(*store, {other}).sound());
    other = head_;
    other.root[0] ^= 1;
    EXPECT_FALSE(verify_store(*store, {other}).sound());
}

TEST_F(VerifiedArchive, ListsNoMoreThanTwentyFindings) {
    const auto many = found_after("UPDATE log SET body = replace(body, 'why', 'wHy')");
    EXPECT_FALSE(many.empty());
    const auto store = open_sqlite_store(folder_.file(), Access::read_only);
    EXPECT_EQ(verify_store(*store).findings.size(), k_most_findings + 1);
}

}  // namespace
}  // namespace gumcert::archive
