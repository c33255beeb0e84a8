#include "archive/store/sqlite_store.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>

#include "encoding/sha2.h"
#include "tests/support/archive_folder.h"

namespace gumcert::archive {
namespace {

using test::code_of;
using test::StoreFolder;

LogEntry entry_after(const LogEntry* before, const std::string& key = "") {
    LogEntry entry{.seq = before == nullptr ? 1 : before->seq + 1,
                   .at = "2026-11-24T18:52:52Z",
                   .actor = "R. Lin",
                   .kind = before == nullptr ? "created" : "numbered",
                   .certificate = before == nullptr ? "" : "EX-" + std::to_string(before->seq),
                   .record = {},
                   .request_key = key,
                   .body = "{}\n",
                   .prev = before == nullptr ? std::string(32, '\0') : before->hash,
                   .hash = {}};
    entry.hash = entry_hash(entry);
    return entry;
}

/// Runs SQL as another program would.
int run_elsewhere(const std::filesystem::path& file, const char* sql) {
    sqlite3* database = nullptr;
    sqlite3_open(file.c_str(), &database);
    const int result = sqlite3_exec(database, sql, nullptr, nullptr, nullptr);
    sqlite3_close(database);
    return result;
}

TEST(SqliteStore, KeepsEntriesAndContents) {
    const StoreFolder folder;
    const LogEntry first = entry_after(nullptr);
    LogEntry second = entry_after(&first, "key");
    const Content content{encoding::sha256(std::string("a\0b", 3)), std::string("a\0b", 3)};
    second.record = content.sha256;
    second.hash = entry_hash(second);
    {
        const auto store = create_sqlite_store(folder.file(), first);
        store->write([&] {
            store->put(content);
            store->append(second);
        });
    }
    const auto store = open_sqlite_store(folder.file(), Access::read_only);
    EXPECT_EQ(store->last_entry(), second);
    EXPECT_EQ(store->entry_of_request("key"), second);
    EXPECT_EQ(store->entry_of_request(""), std::nullopt);
    EXPECT_EQ(store->entries_of("EX-1"), std::vector{second});
    EXPECT_EQ(store->newest_entries({"numbered", "drafted"}), std::vector{second});
    EXPECT_TRUE(store->newest_entries({"drafted"}).empty());
    EXPECT_TRUE(store->has(content.sha256));
    EXPECT_EQ(store->content(content.sha256), content.bytes);
    EXPECT_EQ(store->content(std::string(64, '0')), std::nullopt);
    std::vector<LogEntry> all;
    store->each_entry([&](const LogEntry& entry) { all.push_back(entry); });
    EXPECT_EQ(all, (std::vector{first, second}));
    EXPECT_TRUE(store->own_problems().empty());
}

TEST(SqliteStore, KeepsNothingOfWorkThatFails) {
    const StoreFolder folder;
    const LogEntry first = entry_after(nullptr);
    const auto store = create_sqlite_store(folder.file(), first);
    EXPECT_THROW(store->write([&] {
        store->append(entry_after(&first));
        throw std::runtime_error("on the way");
    }),
                 std::runtime_error);
    EXPECT_EQ(store->last_entry(), first);
}

TEST(SqliteStore, RefusesAnEntryThatDoesNotFollow) {
    const StoreFolder folder;
    const LogEntry first = entry_after(nullptr);
    const auto store = create_sqlite_store(folder.file(), first);
    LogEntry gap = entry_after(&first);
    gap.seq = 3;
    LogEntry other_chain = entry_after(&first);
    other_chain.prev[0] ^= 1;
    LogEntry unknown_record = entry_after(&first);
    unknown_record.record = std::string(64, 'a');
    for (const LogEntry& wrong : {gap, other_chain, unknown_record, first}) {
        EXPECT_EQ(code_of([&] { store->write([&] { store->append(wrong); }); }), "GC-ARCHIVE-0034");
    }
    EXPECT_EQ(store->last_entry(), first);
}

TEST(SqliteStore, RefusesASecondUseOfAKey) {
    const StoreFolder folder;
    const LogEntry first = entry_after(nullptr, "key");
    const auto store = create_sqlite_store(folder.file(), first);
    EXPECT_EQ(code_of([&] { store->write([&] { store->append(entry_after(&first, "key")); }); }), "GC-ARCHIVE-0034");
}

TEST(SqliteStore, IsNotChangedBySqlOfOthers) {
    const StoreFolder folder;
    const LogEntry first = entry_after(nullptr);
    (void)create_sqlite_store(folder.file(), first);
    for (const char* const sql : {"UPDATE log SET actor = 'x'", "DELETE FROM log",
                                  "REPLACE INTO log SELECT seq, at, 'x', kind, certificate, record, request_key, body, "
                                  "prev, hash FROM log"}) {
        EXPECT_NE(run_elsewhere(folder.file(), sql), SQLITE_OK) << sql;
    }
    EXPECT_EQ(open_sqlite_store(folder.file(), Access::read_only)->last_entry(), first);
}

TEST(SqliteStore, SeesThatATriggerIsMissing) {
    const StoreFolder folder;
    (void)create_sqlite_store(folder.file(), entry_after(nullptr));
    ASSERT_EQ(run_elsewhere(folder.file(), "DROP TRIGGER log_is_not_updated"), SQLITE_OK);
    EXPECT_EQ(open_sqlite_store(folder.file(), Access::read_only)->own_problems(),
              std::vector<std::string>{"tables, indices or triggers are not those of an archive"});
}

TEST(SqliteStore, SaysWhatItIsNot) {
    const StoreFolder folder;
    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file(), Access::read_only); }), "GC-ARCHIVE-0001");
    (void)create_sqlite_store(folder.file(), entry_after(nullptr));
    EXPECT_EQ(code_of([&] { (void)create_sqlite_store(folder.file(), entry_after(nullptr)); }), "GC-ARCHIVE-0002");
    ASSERT_EQ(run_elsewhere(folder.file(), "PRAGMA user_version = 2"), SQLITE_OK);
    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file(), Access::read_only); }), "GC-ARCHIVE-0003");
    ASSERT_EQ(run_elsewhere(folder.file("b"), "CREATE TABLE t(a)"), SQLITE_OK);
    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file("b"), Access::read_only); }), "GC-ARCHIVE-0003");
    std::ofstream(folder.file("c")) << std::string(4096, 'x');
    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file("c"), Access::read_only); }), "GC-ARCHIVE-0007");
    EXPECT_EQ(code_of([&] { (void)create_sqlite_store(folder.file("no/folder"), entry_after(nullptr)); }),
              "GC-ARCHIVE-0006");
}

/// SQLite quotes what it does not understand in a file.
TEST(SqliteStore, MessagesHoldNothingThatATerminalActsOn) {
    const StoreFolder folder;
    (void)create_sqlite_store(folder.file(), entry_after(nullptr));
    ASSERT_EQ(run_elsewhere(folder.file(),
                            "PRAGMA writable_schema = ON; "
                            "UPDATE sqlite_master SET sql = sql || char(27) WHERE type = 'trigger'"),
              SQLITE_OK);
    try {
        (void)open_sqlite_store(folder.file(), Access::read_only)->last_entry();
        FAIL();
    } catch (const gum::StorageError& error) {
        EXPECT_NE(error.diagnostics().front().what.find("unrecognized token"), std::string::npos);
        EXPECT_EQ(error.diagnostics().front().what.find('\x1b'), std::string::npos);
    }
}

TEST(SqliteStore, WritesNothingWhereItIsOpenedForReading) {
    const StoreFolder folder;
    const LogEntry first = entry_after(nullptr);
    (void)create_sqlite_store(folder.file(), first);
    const auto store = open_sqlite_store(folder.file(), Access::read_only);
    EXPECT_EQ(code_of([&] { store->write([&] { store->append(entry_after(&first)); }); }), "GC-ARCHIVE-0006");
}

TEST(SqliteStore, CopiesItselfIntoOneFile) {
    const StoreFolder folder;
    const LogEntry first = entry_after(nullptr);
    const auto store = create_sqlite_store(folder.file(), first);
    store->copy_to(folder.file("copy"));
    store->write([&] { store->append(entry_after(&first)); });
    EXPECT_EQ(open_sqlite_store(folder.file("copy"), Access::read_only)->last_entry(), first);
    EXPECT_FALSE(std::filesystem::exists(folder.file("copy-wal")));
}

// tools/verify_archive.py has the same digest: a store with another schema is one of another version.
TEST(SqliteStore, HasTheSchemaOfVersionOne) {
    EXPECT_EQ(schema_digest(), "6731650982c8f934c3d33781f4ab2651259bf5ab761c843c54e87fb0d3659e9e");
}

TEST(SqliteStore, IsNotLeftHalfBegun) {
    const StoreFolder folder;
    const LogEntry first = entry_after(nullptr);
    EXPECT_THROW(
        (void)create_sqlite_store(folder.file(), first, [](Store&) { throw std::runtime_error("on the way"); }),
        std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(folder.file()));
    EXPECT_EQ(code_of([&] { (void)create_sqlite_store(folder.file(), first); }), "");
    EXPECT_EQ(code_of([&] { (void)create_sqlite_store(folder.file(), first); }), "GC-ARCHIVE-0002");
    EXPECT_TRUE(std::filesystem::exists(folder.file())) << "it is somebody else's";
}

/// Memory of SQLite that ends at a chosen allocation.
class EndOfMemory {
public:
    EndOfMemory() {
        sqlite3_shutdown();
        sqlite3_config(SQLITE_CONFIG_GETMALLOC, &usual_);
        sqlite3_mem_methods ending = usual_;
        ending.xMalloc = [](int size) { return failing() ? nullptr : usual_.xMalloc(size); };
        ending.xRealloc = [](void* old, int size) { return failing() ? nullptr : usual_.xRealloc(old, size); };
        sqlite3_config(SQLITE_CONFIG_MALLOC, &ending);
    }
    ~EndOfMemory() {
        sqlite3_shutdown();
        sqlite3_config(SQLITE_CONFIG_MALLOC, &usual_);
    }
    EndOfMemory(const EndOfMemory&) = delete;
    EndOfMemory& operator=(const EndOfMemory&) = delete;

    /// From the n-th allocation on there is no more; 0: there is always some.
    static void after(long n) {
        left_ = n;
        ended_ = false;
    }
    static bool ended() { return ended_; }

private:
    static inline sqlite3_mem_methods usual_ = {};
    static inline long left_ = 0;
    static inline bool ended_ = false;

    static bool failing() {
        if (left_ > 0 && --left_ == 0) {
            ended_ = true;
            return true;  // this one alone: what follows may go on with a wrong result
        }
        return false;
    }
};

/// Memory that runs out is never a statement about the archive.
TEST(SqliteStore, CallsNoSoundArchiveDamagedWhereMemoryEnds) {
    const StoreFolder folder;
    const EndOfMemory memory;
    {
        const LogEntry first = entry_after(nullptr);
        const auto store = create_sqlite_store(folder.file(), first);
        LogEntry last = first;
        store->write([&] {
            for (int i = 0; i < 40; ++i) {
                last = entry_after(&last, "key " + std::to_string(i));
                const std::string bytes(5000, static_cast<char>('a' + i % 26));
                store->put({encoding::sha256(bytes + std::to_string(i)), bytes});
                store->append(last);
            }
        });
    }
    int ended = 0;
    for (long n = 1;; ++n) {
        EndOfMemory::after(n);
        try {
            const auto store = open_sqlite_store(folder.file(), Access::read_only);
            EXPECT_EQ(store->own_problems(), std::vector<std::string>()) << "allocation " << n;
        } catch (const std::bad_alloc&) {
            ++ended;
        }
        if (!EndOfMemory::ended()) {
            break;
        }
    }
    EXPECT_GT(ended, 100);
    EndOfMemory::after(0);
}

}  // namespace
}  // namespace gumcert::archive
