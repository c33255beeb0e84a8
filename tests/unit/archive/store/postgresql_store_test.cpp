#include "archive/store/postgresql_store.h"

#include <gtest/gtest.h>

#include "encoding/sha2.h"
#include "tests/support/archive_folder.h"
#include "tests/support/next_entry.h"
#include "tests/support/postgresql_server.h"

namespace gumcert::archive {
namespace {

using test::code_of;
using test::next_entry;
using test::PostgresqlServer;

class PostgresqlStoreTest : public testing::Test {
protected:
    void SetUp() override {
        SKIP_WITHOUT_POSTGRESQL();
        address_ = PostgresqlServer::get()->new_database();
    }
    /// Whether the store calls itself sound after somebody ran SQL on it.
    bool sound_after(const std::string& sql) {
        EXPECT_TRUE(PostgresqlServer::get()->run_sql(address_, sql)) << sql;
        return open_postgresql_store(address_, Access::read_only)->own_problems().empty();
    }

    std::string address_;
};

TEST_F(PostgresqlStoreTest, IsNotChangedByOtherPrograms) {
    const LogEntry first = next_entry();
    (void)create_postgresql_store(address_, first, [](Store& store) { store.put({encoding::sha256("a"), "a"}); });
    for (const char* const sql : {"UPDATE gumcert_archive.log SET actor = 'x'", "DELETE FROM gumcert_archive.log",
                                  "TRUNCATE gumcert_archive.log", "UPDATE gumcert_archive.content SET bytes = ''",
                                  "DELETE FROM gumcert_archive.content", "TRUNCATE gumcert_archive.content CASCADE",
                                  "INSERT INTO gumcert_archive.log SELECT seq, 'x', actor, kind, certificate, record, "
                                  "request_key, body, prev, hash "
                                  "FROM gumcert_archive.log ON CONFLICT (seq) DO UPDATE SET actor = 'x'"}) {
        EXPECT_FALSE(PostgresqlServer::get()->run_sql(address_, sql)) << sql;
    }
    EXPECT_EQ(open_postgresql_store(address_, Access::read_only)->last_entry(), first);
}

TEST_F(PostgresqlStoreTest, SeesWhatSomebodyDidToItsTables) {
    const LogEntry first = next_entry();
    const std::vector<std::string> attacks = {
        "ALTER TABLE gumcert_archive.log DISABLE TRIGGER log_is_not_changed",
        "ALTER TABLE gumcert_archive.content ENABLE REPLICA TRIGGER content_is_not_changed",
        "DROP TRIGGER log_grows_at_its_end ON gumcert_archive.log",
        "ALTER TABLE gumcert_archive.log DROP CONSTRAINT log_seq_check",
        "ALTER TABLE gumcert_archive.log DROP CONSTRAINT log_pkey",
        "ALTER TABLE gumcert_archive.log ADD COLUMN more text",
        "ALTER TABLE gumcert_archive.log ALTER COLUMN actor DROP NOT NULL",
        "ALTER TABLE gumcert_archive.log DISABLE TRIGGER ALL",
        "DROP INDEX gumcert_archive.log_by_request",
        "CREATE OR REPLACE FUNCTION gumcert_archive.refuse_change() RETURNS trigger LANGUAGE plpgsql AS 'BEGIN RETURN "
        "NULL; END'",
        "CREATE RULE quiet AS ON INSERT TO gumcert_archive.log DO INSTEAD NOTHING",
        "ALTER TABLE gumcert_archive.log ENABLE ROW LEVEL SECURITY",
        "CREATE TABLE gumcert_archive.more()"};
    for (const std::string& attack : attacks) {
        address_ = PostgresqlServer::get()->new_database();
        (void)create_postgresql_store(address_, first);
        EXPECT_TRUE(sound_after("SELECT 1"));
        EXPECT_FALSE(sound_after(attack)) << attack;
    }
}

TEST_F(PostgresqlStoreTest, RefusesWhatIsNoArchive) {
    EXPECT_EQ(code_of([&] { (void)open_postgresql_store(address_, Access::read_only); }), "GC-ARCHIVE-0001");
    EXPECT_TRUE(PostgresqlServer::get()->run_sql(address_, "CREATE SCHEMA gumcert_archive"));
    EXPECT_EQ(code_of([&] { (void)open_postgresql_store(address_, Access::read_only); }), "GC-ARCHIVE-0003");
    EXPECT_EQ(code_of([&] { (void)create_postgresql_store(address_, next_entry()); }), "GC-ARCHIVE-0002");
}

/// A password is not told, whatever is wrong.
TEST_F(PostgresqlStoreTest, TellsNoPassword) {
    for (const std::string address :
         {"postgresql://keeper:se%cret@localhost/x", "postgresql://keeper:secret@/x?host=/nowhere",
          "postgresql://keeper:secret@[/x"}) {
        try {
            (void)open_postgresql_store(address, Access::read_only);
            ADD_FAILURE() << address;
        } catch (const gum::StorageError& error) {
            const gum::Diagnostic& d = error.diagnostics().front();
            EXPECT_EQ((d.where + d.what).find("cret"), std::string::npos) << d.where << d.what;
        }
    }
}

TEST_F(PostgresqlStoreTest, RefusesSettingsThatLoseEntries) {
    (void)create_postgresql_store(address_, next_entry());
    const PostgresqlServer& server = *PostgresqlServer::get();
    ASSERT_TRUE(server.run_sql(address_, "ALTER SYSTEM SET fsync = off") &&
                server.run_sql(address_, "SELECT pg_reload_conf(), pg_sleep(1)"));
    EXPECT_EQ(code_of([&] { (void)open_postgresql_store(address_, Access::read_and_write); }), "GC-ARCHIVE-0009");
    EXPECT_EQ(code_of([&] { (void)open_postgresql_store(address_, Access::read_only); }), "");
    ASSERT_TRUE(server.run_sql(address_, "ALTER SYSTEM RESET fsync") &&
                server.run_sql(address_, "SELECT pg_reload_conf(), pg_sleep(1)"));
}

}  // namespace
}  // namespace gumcert::archive
