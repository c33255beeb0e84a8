#include "archive/store/postgresql_store.h"

#include <gtest/gtest.h>

#include <thread>

#include "archive/store/sqlite_store.h"
#include "encoding/sha2.h"
#include "tests/support/archive_folder.h"
#include "tests/support/postgresql_server.h"

namespace gumcert::archive {
namespace {

using test::code_of;
using test::PostgresqlServer;

LogEntry next_entry(const std::optional<LogEntry>& before, const std::string& key = "") {
    LogEntry entry{.seq = before ? before->seq + 1 : 1,
                   .at = "2026-11-27T18:52:52Z",
                   .actor = "Zoë O'Lin \"Ω\" \\",
                   .kind = before ? "numbered" : "created",
                   .certificate = before ? "EX-" + std::to_string(before->seq) : "",
                   .record = {},
                   .request_key = key,
                   .body = "{}\n",
                   .prev = before ? before->hash : std::string(32, '\0'),
                   .hash = {}};
    entry.hash = entry_hash(entry);
    return entry;
}

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

TEST_F(PostgresqlStoreTest, KeepsEntriesAndContents) {
    const LogEntry first = next_entry(std::nullopt);
    LogEntry second = next_entry(first, "key");
    const std::string bytes("a\0b\xFF", 4);
    const Content content{encoding::sha256(bytes), bytes};
    second.record = content.sha256;
    second.hash = entry_hash(second);
    {
        const auto store = create_postgresql_store(address_, first);
        store->write([&] {
            store->put(content);
            store->append(second);
            store->list({"EX-2", "numbered", "", "", ""});
            store->list({"EX-1", "numbered", "2026-11-24T18:52:52Z", "", ""});
            store->list({"EX-1", "drafted", "2026-11-24T18:52:52Z", "a gauge", content.sha256});
        });
    }
    const auto store = open_postgresql_store(address_, Access::read_only);
    EXPECT_EQ(store->last_entry(), second);
    EXPECT_EQ(store->entry_of_request("key"), second);
    EXPECT_EQ(store->entry_of_request(""), std::nullopt);
    EXPECT_EQ(store->entries_of("EX-1"), std::vector{second});
    EXPECT_EQ(store->listed(),
              (std::vector<ListedCertificate>{{"EX-1", "drafted", "2026-11-24T18:52:52Z", "a gauge", content.sha256},
                                              {"EX-2", "numbered", "", "", ""}}));
    EXPECT_EQ(store->content(content.sha256), bytes);
    EXPECT_TRUE(store->has(content.sha256));
    EXPECT_FALSE(store->has(std::string(64, '0')));
    EXPECT_TRUE(store->own_problems().empty());
    EXPECT_EQ(code_of([&] { store->write([&] { store->append(next_entry(second)); }); }), "GC-ARCHIVE-0006");
}

TEST_F(PostgresqlStoreTest, ReadsMoreThanAPage) {
    std::optional<LogEntry> last = next_entry(std::nullopt);
    std::vector<LogEntry> all{*last};
    const auto store = create_postgresql_store(address_, *last);
    store->write([&] {
        for (int i = 0; i < 2500; ++i) {
            last = next_entry(last);
            all.push_back(*last);
            store->append(*last);
        }
        for (int i = 0; i < 20; ++i) {
            const std::string bytes = std::to_string(i);
            store->put({encoding::sha256(bytes), bytes});
        }
    });
    std::vector<LogEntry> read;
    store->each_entry([&](const LogEntry& entry) { read.push_back(entry); });
    EXPECT_EQ(read, all);
    read.clear();
    store->entries_of_kind("numbered", [&](const LogEntry& entry) {
        read.push_back(entry);
        return true;
    });
    EXPECT_EQ(read.size(), 2500U);
    EXPECT_TRUE(std::is_sorted(read.begin(), read.end(), [](auto& a, auto& b) { return a.seq > b.seq; }));
    std::size_t contents = 0;
    store->each_content([&](const Content& content) {
        EXPECT_EQ(encoding::sha256(content.bytes), content.sha256);
        ++contents;
    });
    EXPECT_EQ(contents, 20U);
}

TEST_F(PostgresqlStoreTest, WritesAllOrNothing) {
    const LogEntry first = next_entry(std::nullopt);
    const auto store = create_postgresql_store(address_, first);
    EXPECT_THROW(store->write([&] {
        store->append(next_entry(first));
        throw std::runtime_error("on the way");
    }),
                 std::runtime_error);
    EXPECT_EQ(store->last_entry(), first);
    EXPECT_EQ(code_of([&] { (void)create_postgresql_store(address_, first); }), "GC-ARCHIVE-0002");
    const std::string other = PostgresqlServer::get()->new_database();
    EXPECT_THROW((void)create_postgresql_store(other, first, [](Store&) { throw std::runtime_error("on the way"); }),
                 std::runtime_error);
    EXPECT_EQ(code_of([&] { (void)open_postgresql_store(other, Access::read_only); }), "GC-ARCHIVE-0001");
}

TEST_F(PostgresqlStoreTest, RefusesEntriesThatDoNotFollow) {
    const LogEntry first = next_entry(std::nullopt);
    const auto store = create_postgresql_store(address_, first);
    const auto code = [&](const LogEntry& entry) {
        return code_of([&] { store->write([&] { store->append(entry); }); });
    };
    LogEntry gap = next_entry(first);
    gap.seq = 3;
    EXPECT_EQ(code(gap), "GC-ARCHIVE-0034");
    LogEntry loose = next_entry(first);
    loose.prev = std::string(32, 'x');
    EXPECT_EQ(code(loose), "GC-ARCHIVE-0034");
    LogEntry orphan = next_entry(first);
    orphan.record = std::string(64, '0');
    EXPECT_EQ(code(orphan), "GC-ARCHIVE-0034");
    const LogEntry second = next_entry(first, "key");
    EXPECT_EQ(code(second), "");
    EXPECT_EQ(code(next_entry(second, "key")), "GC-ARCHIVE-0034");
    const Content content{encoding::sha256("a"), "a"};
    EXPECT_EQ(code_of([&] { store->write([&] { store->put(content); }); }), "");
    EXPECT_EQ(code_of([&] { store->write([&] { store->put(content); }); }), "GC-ARCHIVE-0034");
}

TEST_F(PostgresqlStoreTest, IsNotChangedByOtherPrograms) {
    const LogEntry first = next_entry(std::nullopt);
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
    const LogEntry first = next_entry(std::nullopt);
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

/// Several writers queue, and each sees what the ones before it wrote.
TEST_F(PostgresqlStoreTest, LetsWritersQueue) {
    (void)create_postgresql_store(address_, next_entry(std::nullopt));
    std::vector<std::thread> writers;
    for (int writer = 0; writer < 8; ++writer) {
        writers.emplace_back([&] {
            const auto store = open_postgresql_store(address_, Access::read_and_write);
            for (int i = 0; i < 20; ++i) {
                store->write([&] { store->append(next_entry(store->last_entry())); });
            }
        });
    }
    for (std::thread& writer : writers) {
        writer.join();
    }
    EXPECT_EQ(open_postgresql_store(address_, Access::read_only)->last_entry()->seq, 161);
}

TEST_F(PostgresqlStoreTest, IsCopiedToAFile) {
    const LogEntry first = next_entry(std::nullopt);
    const LogEntry second = next_entry(first);
    const auto store = create_postgresql_store(address_, first, [&](Store& made) {
        made.append(second);
        made.list({"EX-1", "numbered", second.at, "", ""});
    });
    const test::StoreFolder folder;
    store->copy_to(folder.file());
    EXPECT_EQ(open_sqlite_store(folder.file(), Access::read_only)->listed(), store->listed());
    EXPECT_EQ(open_sqlite_store(folder.file(), Access::read_only)->last_entry(), second);
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.archive-wal")));
}

TEST_F(PostgresqlStoreTest, RefusesWhatIsNoArchive) {
    EXPECT_EQ(code_of([&] { (void)open_postgresql_store(address_, Access::read_only); }), "GC-ARCHIVE-0001");
    EXPECT_TRUE(PostgresqlServer::get()->run_sql(address_, "CREATE SCHEMA gumcert_archive"));
    EXPECT_EQ(code_of([&] { (void)open_postgresql_store(address_, Access::read_only); }), "GC-ARCHIVE-0003");
    EXPECT_EQ(code_of([&] { (void)create_postgresql_store(address_, next_entry(std::nullopt)); }), "GC-ARCHIVE-0002");
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
    (void)create_postgresql_store(address_, next_entry(std::nullopt));
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
