// What holds for an archive on every kind of store.
#include <gtest/gtest.h>

#include "archive/archive.h"
#include "archive/store/open_store.h"
#include "archive/verification.h"
#include "tests/support/archive_folder.h"
#include "tests/support/postgresql_server.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

std::unique_ptr<Store> archive_of_chance(const std::string& address, std::uint64_t seed) {
    test::ArchiveOfChance chance(seed);
    std::unique_ptr<Store> store = create_store(address, chance.first());
    Archive archive(*store);
    chance.fill(archive, 12);
    return store;
}

/// The same requests give the same log, hash by hash; a log that is replayed into the other kind of store and back has
/// the same head, and all of them are sound.
TEST(Stores, KeepTheSameArchive) {
    SKIP_WITHOUT_POSTGRESQL();
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const test::StoreFolder folder;
        const auto file = archive_of_chance(folder.file().string(), seed);
        const auto server = archive_of_chance(test::PostgresqlServer::get()->new_database(), seed);
        EXPECT_EQ(Archive(*file).head(), Archive(*server).head()) << seed;
        EXPECT_EQ(Archive(*file).list(), Archive(*server).list()) << seed;
        const auto there = replay_into(*file, test::PostgresqlServer::get()->new_database(), list_again);
        const auto back = replay_into(*there, folder.file("back").string(), list_again);
        for (Store* store : {file.get(), server.get(), there.get(), back.get()}) {
            const Verification verification = verify_store(*store, {Archive(*file).head()});
            EXPECT_TRUE(verification.sound()) << store->name() << ": " << verification.findings.front().what;
            EXPECT_EQ(verification.head, Archive(*file).head());
            EXPECT_EQ(Archive(*store).list(), Archive(*file).list());
        }
    }
}

/// Attacks of somebody who may do everything on the server.
TEST(Stores, OnAServerShowTheirAttacks) {
    SKIP_WITHOUT_POSTGRESQL();
    const test::PostgresqlServer& server = *test::PostgresqlServer::get();
    const std::string quiet = "SET session_replication_role = replica; ";  // no trigger, no foreign key
    const std::vector<std::string> attacks = {
        "UPDATE gumcert_archive.log SET actor = 'Somebody' WHERE seq = 3",
        "UPDATE gumcert_archive.log SET body = replace(body, 'a', 'b') WHERE seq = 5",
        "DELETE FROM gumcert_archive.log WHERE seq = 4",
        "DELETE FROM gumcert_archive.log WHERE seq > 6",
        "TRUNCATE gumcert_archive.log",
        "UPDATE gumcert_archive.log SET seq = 1000004 WHERE seq = 4",
        "UPDATE gumcert_archive.log SET seq = 1000004 WHERE seq = 4; UPDATE gumcert_archive.log SET seq = 4 WHERE seq "
        "= 5; "
        "UPDATE gumcert_archive.log SET seq = 5 WHERE seq = 1000004",
        "UPDATE gumcert_archive.content SET bytes = bytes || 'x'::bytea",
        "DELETE FROM gumcert_archive.content WHERE sha256 = (SELECT min(sha256) FROM gumcert_archive.content)",
        "INSERT INTO gumcert_archive.content VALUES(repeat('0', 64), 'x')",
        "UPDATE gumcert_archive.log SET hash = prev WHERE seq = 2",
        "UPDATE gumcert_archive.listed SET state = 'withdrawn' WHERE certificate = (SELECT min(certificate) FROM "
        "gumcert_archive.listed)",
        "DELETE FROM gumcert_archive.listed",
        "INSERT INTO gumcert_archive.listed VALUES('X', 'issued', '', '', '')"};
    for (const std::string& attack : attacks) {
        const std::string address = server.new_database();
        const Head head = Archive(*archive_of_chance(address, 3)).head();
        EXPECT_TRUE(verify_store(*open_store(address, Access::read_only), {head}).sound());
        ASSERT_TRUE(server.run_sql(address, quiet + attack)) << attack;
        EXPECT_FALSE(verify_store(*open_store(address, Access::read_only), {head}).sound()) << attack;
    }
}

}  // namespace
}  // namespace gumcert::archive
