#include "archive/store/sqlite_store.h"

#include <grp.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>

#include "encoding/sha2.h"
#include "tests/support/archive_folder.h"
#include "tests/support/next_entry.h"

namespace gumcert::archive {
namespace {

using test::code_of;
using test::next_entry;
using test::StoreFolder;

/// Runs SQL as another program would.
int run_elsewhere(const std::filesystem::path& file, const char* sql) {
    sqlite3* database = nullptr;
    sqlite3_open(file.c_str(), &database);
    const int result = sqlite3_exec(database, sql, nullptr, nullptr, nullptr);
    sqlite3_close(database);
    return result;
}

TEST(SqliteStore, IsNotChangedBySqlOfOthers) {
    const StoreFolder folder;
    const LogEntry first = next_entry();
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
    (void)create_sqlite_store(folder.file(), next_entry());
    ASSERT_EQ(run_elsewhere(folder.file(), "DROP TRIGGER log_is_not_updated"), SQLITE_OK);
    EXPECT_EQ(open_sqlite_store(folder.file(), Access::read_only)->own_problems(),
              std::vector<std::string>{"tables, indices or triggers are not those of an archive"});
}

/// Names that SQLite takes for a database in memory, or for an address with parameters, are files.
TEST(SqliteStore, TakesEveryNameForThatOfAFile) {
    const StoreFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.file().parent_path());
    const LogEntry first = next_entry();
    for (const char* const name : {":memory:", "file:a.archive", "file:b.archive?mode=memory&cache=shared", "c?mode=ro",
                                   "d#e", "%41", "-f", "g\nh"}) {
        (void)create_sqlite_store(name, first);
        EXPECT_TRUE(std::filesystem::exists(name)) << name;
        for (const Access access : {Access::read_only, Access::read_and_write}) {
            EXPECT_EQ(open_sqlite_store(name, access)->last_entry(), first) << name;
        }
    }
    EXPECT_FALSE(std::filesystem::exists("A")) << "an escape was read";
    std::filesystem::current_path(before);
}

TEST(SqliteStore, SaysWhatItIsNot) {
    const StoreFolder folder;
    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file(), Access::read_only); }), "GC-ARCHIVE-0001");
    (void)create_sqlite_store(folder.file(), next_entry());
    EXPECT_EQ(code_of([&] { (void)create_sqlite_store(folder.file(), next_entry()); }), "GC-ARCHIVE-0002");
    ASSERT_EQ(run_elsewhere(folder.file(), "PRAGMA user_version = 2"), SQLITE_OK);
    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file(), Access::read_only); }), "GC-ARCHIVE-0003");
    ASSERT_EQ(run_elsewhere(folder.file("b"), "CREATE TABLE t(a)"), SQLITE_OK);
    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file("b"), Access::read_only); }), "GC-ARCHIVE-0003");
    std::ofstream(folder.file("c")) << std::string(4096, 'x');
    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file("c"), Access::read_only); }), "GC-ARCHIVE-0007");
    EXPECT_EQ(code_of([&] { (void)create_sqlite_store(folder.file("no/folder"), next_entry()); }), "GC-ARCHIVE-0006");
}

/// SQLite quotes what it does not understand in a file.
TEST(SqliteStore, MessagesHoldNothingThatATerminalActsOn) {
    const StoreFolder folder;
    (void)create_sqlite_store(folder.file(), next_entry());
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

/// Runs work as somebody whom the rights of files stop: not root.
bool is_done_without_rights(const std::function<bool()>& work) {
    const pid_t child = fork();
    if (child == 0) {
        constexpr uid_t k_nobody = 65534;
        const bool dropped =
            geteuid() != 0 || (setgroups(0, nullptr) == 0 && setgid(k_nobody) == 0 && setuid(k_nobody) == 0);
        _exit(dropped && work() ? 0 : 1);
    }
    int status = 1;
    return waitpid(child, &status, 0) == child && status == 0;
}

/// SQLite takes no lock where it can write nothing: what is read while somebody writes says nothing.
TEST(SqliteStore, IsReadWhereNothingCanBeWritten) {
    const StoreFolder folder;
    const LogEntry first = next_entry();
    const std::filesystem::path file = folder.file("a #?%.archive");
    (void)create_sqlite_store(file, first);
    std::filesystem::permissions(file, std::filesystem::perms(0666));
    std::filesystem::permissions(file.parent_path(), std::filesystem::perms(0555));
    EXPECT_TRUE(is_done_without_rights([&] {
        const auto store = open_sqlite_store(file, Access::read_only);
        std::optional<LogEntry> read;
        store->read([&] { read = store->last_entry(); });
        return read == first && store->own_problems().empty() &&
               code_of([&] { store->write([] {}); }) == "GC-ARCHIVE-0006";
    }));
    EXPECT_TRUE(is_done_without_rights([&] {
        const auto store = open_sqlite_store(file, Access::read_only);
        const std::string told = code_of([&] { store->read([&] { std::ofstream(file, std::ios::app) << 'x'; }); });
        return told == "GC-ARCHIVE-0004";
    }));
    std::filesystem::permissions(file.parent_path(), std::filesystem::perms(0755));
}

std::size_t files_beside(const std::filesystem::path& file) {
    const std::filesystem::directory_iterator files(file.parent_path());
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

/// Writers by two names of one file have two logs: two requests would get one number.
TEST(SqliteStore, IsNotWrittenByOneOfSeveralNames) {
    const StoreFolder folder;
    const LogEntry first = next_entry();
    (void)create_sqlite_store(folder.file(), first);
    const auto early = open_sqlite_store(folder.file(), Access::read_and_write);
    std::filesystem::create_hard_link(folder.file(), folder.file("b.archive"));
    for (const char* const name : {"a.archive", "b.archive"}) {
        const std::filesystem::path file = folder.file(name);
        EXPECT_EQ(code_of([&] { (void)open_sqlite_store(file, Access::read_and_write); }), "GC-ARCHIVE-0014") << name;
        EXPECT_EQ(open_sqlite_store(file, Access::read_only)->last_entry(), first) << name;
    }
    // One that was opened before the other name was there.
    EXPECT_EQ(code_of([&] { early->write([&] { early->append(next_entry(&first)); }); }), "GC-ARCHIVE-0014");
    EXPECT_EQ(early->last_entry(), first);
    std::filesystem::remove(folder.file("b.archive"));
    early->write([&] { early->append(next_entry(&first)); });
}

TEST(SqliteStore, IsNotWrittenWhereItsNameLeadsElsewhereMeanwhile) {
    const StoreFolder folder;
    const LogEntry first = next_entry();
    (void)create_sqlite_store(folder.file(), first);
    const auto store = open_sqlite_store(folder.file(), Access::read_and_write);
    std::filesystem::rename(folder.file(), folder.file("moved"));
    EXPECT_EQ(code_of([&] { store->write([&] { store->append(next_entry(&first)); }); }), "GC-ARCHIVE-0014");
    (void)create_sqlite_store(folder.file("new"), next_entry());
    std::filesystem::rename(folder.file("new"), folder.file());
    EXPECT_EQ(code_of([&] { store->write([&] { store->append(next_entry(&first)); }); }), "GC-ARCHIVE-0014");
}

/// Whatever the rights and the names: who may only read leaves nothing that would stop the owner.
TEST(SqliteStore, ReadersOfEveryKindLeaveTheOwnerToWrite) {
    if (geteuid() != 0) {
        GTEST_SKIP() << "only root can be another user";
    }
    using Rights = std::filesystem::perms;
    for (const Rights of_file : {Rights(0644), Rights(0666), Rights(0444)}) {
        for (const Rights of_folder : {Rights(0755), Rights(0777), Rights(0555)}) {
            for (const bool has_link : {false, true}) {
                const StoreFolder folder;
                const LogEntry first = next_entry();
                (void)create_sqlite_store(folder.file(), first);
                if (has_link) {
                    std::filesystem::create_hard_link(folder.file(), folder.file("b.archive"));
                }
                std::filesystem::permissions(folder.file(), of_file);
                std::filesystem::permissions(folder.file().parent_path(), of_folder);
                const std::size_t before = files_beside(folder.file());
                EXPECT_TRUE(is_done_without_rights([&] {
                    const auto store = open_sqlite_store(folder.file(), Access::read_only);
                    std::optional<LogEntry> read;
                    store->read([&] { read = store->last_entry(); });
                    return read == first;
                }));
                EXPECT_EQ(files_beside(folder.file()), before)
                    << std::oct << static_cast<unsigned>(of_file) << " in " << static_cast<unsigned>(of_folder);
                if (!has_link) {
                    EXPECT_EQ(code_of([&] { (void)open_sqlite_store(folder.file(), Access::read_and_write); }), "");
                }
            }
        }
    }
}

TEST(SqliteStore, NamesTheFileThatBarsWriting) {
    const StoreFolder folder;
    (void)create_sqlite_store(folder.file(), next_entry());
    std::filesystem::permissions(folder.file(), std::filesystem::perms(0666));
    std::filesystem::permissions(folder.file().parent_path(), std::filesystem::perms(0777));
    const std::string index = folder.file().string() + "-shm";
    std::ofstream{index};
    std::filesystem::permissions(index, std::filesystem::perms(0600));
    EXPECT_TRUE(is_done_without_rights([&] {
        try {
            (void)open_sqlite_store(folder.file(), Access::read_and_write);
        } catch (const gum::StorageError& error) {
            return geteuid() == 0 || error.diagnostics().front().where == index;
        }
        return false;
    }));
}

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// SQLite would put the pages of the former archive into the backup that was copied to its place.
TEST(SqliteStore, TakesNoLogOfTheArchiveThatStoodThere) {
    const StoreFolder folder;
    const LogEntry first = next_entry();
    (void)create_sqlite_store(folder.file(), first);
    const auto former = open_sqlite_store(folder.file(), Access::read_and_write);
    const std::filesystem::path restored = folder.file("restored.archive");
    const std::filesystem::path log = folder.file("restored.archive-wal");
    former->copy_to(restored);
    former->write([&] { former->append(next_entry(&first)); });
    std::filesystem::copy_file(folder.file("a.archive-wal"), log);
    const std::string archive_before = bytes_of(restored), log_before = bytes_of(log);
    ASSERT_FALSE(log_before.empty());
    for (const Access access : {Access::read_only, Access::read_and_write}) {
        EXPECT_EQ(code_of([&] { (void)open_sqlite_store(restored, access); }), "GC-ARCHIVE-0015");
    }
    EXPECT_EQ(bytes_of(restored), archive_before);
    EXPECT_EQ(bytes_of(log), log_before);

    std::filesystem::remove(log);
    const auto store = open_sqlite_store(restored, Access::read_and_write);
    const LogEntry second = next_entry(&first);
    store->write([&] { store->append(second); });
    // Its own log, beside which others open it.
    EXPECT_EQ(open_sqlite_store(restored, Access::read_only)->last_entry(), second);
}

TEST(SqliteStore, LeavesNothingBehindWhenItWasRead) {
    const StoreFolder folder;
    (void)create_sqlite_store(folder.file(), next_entry());
    {
        const auto store = open_sqlite_store(folder.file(), Access::read_only);
        store->read([&] { (void)store->last_entry(); });
        EXPECT_EQ(code_of([&] { store->write([] {}); }), "GC-ARCHIVE-0006");
    }
    const std::filesystem::directory_iterator files(folder.file().parent_path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

// tools/verify_archive.py has the same digest: a store with another schema is one of another version.
TEST(SqliteStore, HasTheSchemaOfVersionOne) {
    EXPECT_EQ(schema_digest(), "c4e71ac6a75f6e6e4a3d3734d7c642f1d2639b180b8a2b7d31b6f7b4cc692688");
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
        const LogEntry first = next_entry();
        const auto store = create_sqlite_store(folder.file(), first);
        LogEntry last = first;
        store->write([&] {
            for (int i = 0; i < 40; ++i) {
                last = next_entry(&last, "key " + std::to_string(i));
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
