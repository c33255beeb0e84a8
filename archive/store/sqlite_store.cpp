#include "archive/store/sqlite_store.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include "archive/store/file_names.h"
#include "archive/store/sqlite_schema.h"
#include "archive/store/sqlite_statement.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_entry_columns = "seq, at, actor, kind, certificate, record, request_key, body, prev, hash";

[[noreturn]] void refuse_store(const char* code, const fs::path& file, std::string what, const char* rule,
                               const char* action) {
    throw gum::StorageError(
        gum::Diagnostic{.code = code, .where = file.string(), .what = std::move(what), .rule = rule, .action = action});
}

LogEntry entry_of(const Statement& row) {
    return {.seq = row.integer_column(0),
            .at = row.column(1),
            .actor = row.column(2),
            .kind = row.column(3),
            .certificate = row.column(4),
            .record = row.column(5),
            .request_key = row.column(6),
            .body = row.column(7),
            .prev = row.column(8),
            .hash = row.column(9)};
}

std::string select_entries(const char* rest) {
    return std::string("SELECT ") + k_entry_columns + " FROM log " + rest;
}

/// Whether to ask again for a lock. The waits of SQLite itself grow to 100 ms; where others write without a pause, who asks so seldom
/// waits for minutes.
int wait_for_others(void* /*context*/, int asked) {
    constexpr int k_pause_ms = 5;
    constexpr int k_patience_ms = 60'000;
    if (asked >= k_patience_ms / k_pause_ms) {
        return 0;
    }
    (void)sqlite3_sleep(k_pause_ms);
    return 1;
}

/// \param address  of the file where it is opened in another way than by its name (SQLITE_OPEN_URI)
Database open_database(const fs::path& file, int flags, const std::string& address = "") {
    sqlite3* opened = nullptr;
    // Without a folder SQLite takes ":memory:" for no file, and "file:x" for an address.
    const std::string name = file.is_absolute() ? file.string() : "./" + file.string();
    const int result = sqlite3_open_v2(address.empty() ? name.c_str() : address.c_str(), &opened,
                                       flags | SQLITE_OPEN_EXRESCODE, nullptr);
    Database database(opened);
    if (result != SQLITE_OK) {
        refuse_sqlite(database.get(), result, file.string());
    }
    (void)sqlite3_busy_handler(database.get(), wait_for_others, nullptr);
    // No statement may write the tables of SQLite itself, by which the triggers that refuse changes could be taken
    // away.
    (void)sqlite3_db_config(database.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    return database;
}

std::string pragma(sqlite3* database, const std::string& name, const std::string& store) {
    Statement statement(database, "PRAGMA " + name, store);
    return statement.next() ? statement.column(0) : "";
}

struct Setting {
    const char* name;
    const char* value;      // as it is written
    const char* read_back;  // as SQLite tells it
};

constexpr std::array<Setting, 4> k_settings_of_readers = {{{"foreign_keys", "ON", "1"},
                                                           {"recursive_triggers", "ON", "1"},
                                                           {"trusted_schema", "OFF", "0"},
                                                           {"cell_size_check", "ON", "1"}}};
constexpr std::array<Setting, 2> k_settings_of_writers = {
    {{"journal_mode", "WAL", "wal"}, {"synchronous", "FULL", "2"}}};

void set(sqlite3* database, const Setting& setting, const fs::path& file) {
    const std::string name = setting.name;
    (void)pragma(database, name + " = " + setting.value, file.string());
    // Read back: SQLite ignores a setting that it cannot keep without a word, WAL on some file systems for one.
    if (const std::string now = pragma(database, name, file.string()); now != setting.read_back) {
        refuse_store("GC-ARCHIVE-0009", file, name + " is " + now,
                     "an archive is written with settings that survive a power cut",
                     "keep the archive on a disk of this machine, and see docs/archive.md");
    }
}

void prepare(sqlite3* database, const fs::path& file, Access access) {
    for (const Setting& setting : k_settings_of_readers) {
        set(database, setting, file);
    }
    if (access == Access::read_only) {
        set(database, {"query_only", "ON", "1"}, file);
    } else {
        for (const Setting& setting : k_settings_of_writers) {
            set(database, setting, file);
        }
    }
}

/// The write-ahead log needs memory that all writers share: they run on one machine.
void refuse_network_share(const fs::path& folder) {
    constexpr std::array<unsigned long, 4> k_network = {0x6969UL, 0x517BUL, 0xFF534D42UL, 0xFE534D42UL};  // NFS, SMB
    struct statfs found {};
    if (statfs(folder.empty() ? "." : folder.c_str(), &found) != 0) {
        return;  // a folder that is not there: opening says it
    }
    const auto type = static_cast<unsigned long>(found.f_type) & 0xFFFFFFFFUL;
    if (std::find(k_network.begin(), k_network.end(), type) != k_network.end()) {
        refuse_store("GC-ARCHIVE-0010", folder, "lies on a network share",
                     "an archive lies on a disk of the machine that writes it",
                     "choose a folder of this machine, and copy backups to the share");
    }
}

/// What tells whether somebody writes a file.
struct StateOfFile {
    dev_t device = 0;
    ino_t number = 0;
    off_t size = 0;
    std::int64_t changed_s = 0, changed_ns = 0;
    bool has_log = false;  ///< SQLite keeps entries, or what it has to take back, in another file beside it

    friend bool operator==(const StateOfFile&, const StateOfFile&) = default;
};

StateOfFile state_of(const fs::path& file) {
    struct stat found {};
    std::error_code error;
    if (stat(file.c_str(), &found) != 0) {
        return {};
    }
    const auto size_of = [&](const char* ending) {
        const std::uintmax_t size = fs::file_size(file.string() + ending, error);
        return error ? 0 : size;
    };
    return {.device = found.st_dev,
            .number = found.st_ino,
            .size = found.st_size,
            .changed_s = found.st_mtim.tv_sec,
            .changed_ns = found.st_mtim.tv_nsec,
            .has_log = size_of("-wal") > 0 || size_of("-journal") > 0};
}

/// How SQLite reads a file and leaves nothing beside it.
struct Reading {
    int flags = SQLITE_OPEN_READONLY;
    std::string address = {};  ///< as open_database() takes it
    fs::path unlocked = {};    ///< file that is read without a lock; empty else
};

/// The address of a file with a parameter, as SQLITE_OPEN_URI takes it.
std::string address_of(const fs::path& real, const char* parameter) {
    constexpr std::string_view k_plain = "/-._~0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    std::string address = "file:";
    for (const char c : real.string()) {
        address += k_plain.find(c) != std::string_view::npos ? std::string(1, c)
                                                             : "%" + encoding::hexadecimal(std::string_view(&c, 1));
    }
    return address + "?" + parameter;
}

/// SQLite takes a write-ahead log by its name alone, whichever file it was written for, and replaces pages of the file by its own.
/// A file that is written with such a log says so before there is one, and no longer when there is none (SQLite, Database
/// File Format, 1.3.3); a backup never does. So a log beside a file that says it has none was left by another archive.
void refuse_log_of_another_file(const fs::path& file) {
    std::error_code error;
    const fs::path real = fs::canonical(file, error);
    const fs::path log = real.string() + "-wal";
    const auto has_entries = [&] { return fs::file_size(log, error) > 0 && !error; };
    if (error || !has_entries()) {
        return;
    }
    constexpr std::size_t k_place_of_version = 19;  // that a reader needs
    constexpr char k_without_log = 1;
    std::array<char, k_place_of_version + 1> start{};
    std::ifstream in(real, std::ios::binary);
    // Asked again: while the first writer of a file begins a log, none of it is there before the file says so.
    if (in.read(start.data(), start.size()) && start.back() == k_without_log && has_entries()) {
        refuse_store("GC-ARCHIVE-0015", log,
                     "was written for another archive than the one beside it, which has no such file",
                     "a write-ahead log belongs to the file that it was written for",
                     "move it away with the file of the former archive, whose last entries may stand in it");
    }
}

bool may_write(const fs::path& place) {
    return faccessat(AT_FDCWD, place.c_str(), W_OK, AT_EACCESS) == 0;
}

/// A reader of a file with a write-ahead log makes that log and its index, and only who may write takes them away again. So a
/// file without entries in a log is opened as one that may be written, and written it is not (query_only). Who may not write
/// the file would leave a log that its owner cannot write; where the folder cannot be written, SQLite could not make one;
/// writers by another name have another log. Such a file is read as one that does not change, and looked at again afterwards.
/// With entries in a log, reading stays reading: closing would else bring them into the file; who may not write the file
/// makes no index, either.
Reading reading_of(const fs::path& file) {
    std::error_code error;
    const fs::path real = fs::canonical(file, error);
    if (error) {
        return {};
    }
    if (state_of(real).has_log) {
        return may_write(real) ? Reading{}
                               : Reading{.flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI,
                                         .address = address_of(real, "readonly_shm=1")};
    }
    if (may_write(real) && may_write(real.parent_path()) && !may_have_another_name(real)) {
        return {.flags = SQLITE_OPEN_READWRITE};
    }
    return {
        .flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, .address = address_of(real, "immutable=1"), .unlocked = real};
}

std::vector<std::string> schema_lines(sqlite3* database, const std::string& name) {
    std::vector<std::string> lines;
    Statement rows(database, "SELECT type, name, sql FROM sqlite_schema", name);
    while (rows.next()) {
        lines.push_back(rows.column(0) + '\t' + rows.column(1) + '\t' + rows.column(2));
    }
    std::sort(lines.begin(), lines.end());
    return lines;
}

void require_memory() {
    constexpr sqlite3_uint64 k_enough = 4U << 20U;
    void* const some = sqlite3_malloc64(k_enough);
    sqlite3_free(some);
    if (some == nullptr) {
        throw std::bad_alloc();
    }
}

/// Reads a file that SQLite has open, by its own calls, from the first to the last byte.
/// \param which  SQLITE_FCNTL_FILE_POINTER, or SQLITE_FCNTL_JOURNAL_POINTER: the write-ahead log
/// \throws gum::StorageError  GC-ARCHIVE-0008 where the disk does not answer
void read_through(sqlite3* database, int which, const std::string& name) {
    sqlite3_file* file = nullptr;
    (void)sqlite3_file_control(database, "main", which, static_cast<void*>(&file));
    if (file == nullptr || file->pMethods == nullptr) {
        return;  // there is no such file
    }
    sqlite3_int64 size = 0;
    int result = file->pMethods->xFileSize(file, &size);
    std::vector<char> piece(1U << 16U);
    for (sqlite3_int64 at = 0; result == SQLITE_OK && at < size; at += static_cast<sqlite3_int64>(piece.size())) {
        const auto length = std::min<sqlite3_int64>(size - at, static_cast<sqlite3_int64>(piece.size()));
        result = file->pMethods->xRead(file, piece.data(), static_cast<int>(length), at);
    }
    if (result != SQLITE_OK) {
        refuse_sqlite(nullptr, result, name);
    }
}

/// \return whether this program has made the file
bool make_file(const fs::path& file) {
    constexpr mode_t k_rights = 0644;  // as SQLite makes it
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, k_rights);
    return descriptor >= 0 && ::close(descriptor) == 0;
}

class SqliteStore : public Store {
public:
    /// \param unlocked  as of Reading
    /// \param before    its state when it was opened
    SqliteStore(fs::path file, Database database, fs::path unlocked = {}, StateOfFile before = {})
        : file_(std::move(file)),
          opened_(identity_of(file_)),
          database_(std::move(database)),
          unlocked_(std::move(unlocked)),
          before_(before) {}

    [[nodiscard]] std::string name() const override { return file_.string(); }

    void read(const std::function<void()>& work) override { transact("BEGIN", work); }
    // IMMEDIATE takes the right to write at the beginning: writers queue. A transaction that first reads and then
    // writes could be refused in its middle.
    void write(const std::function<void()>& work) override {
        transact("BEGIN IMMEDIATE", [&] {
            work();
            require_one_name(file_, opened_);  // somebody may have given it another name since it was opened
        });
    }

    void append(const LogEntry& e) override {
        Statement insert = statement("INSERT INTO log VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)");
        insert.integer(e.seq).text(e.at).text(e.actor).text(e.kind).text(e.certificate);
        if (e.record.empty()) {
            insert.null();
        } else {
            insert.text(e.record);
        }
        insert.text(e.request_key).text(e.body).bytes(e.prev).bytes(e.hash).run();
    }

    void put(const Content& content) override {
        Statement insert = statement("INSERT INTO content VALUES(?1, ?2)");
        insert.text(content.sha256).bytes(content.bytes).run();
    }

    void list(const ListedCertificate& one) override {
        Statement insert = statement("INSERT OR REPLACE INTO listed VALUES(?1, ?2, ?3, ?4, ?5)");
        insert.text(one.number).text(one.state).text(one.since).text(one.item).text(one.record).run();
    }

    [[nodiscard]] bool has(const std::string& sha256) override {
        Statement row = statement("SELECT 1 FROM content WHERE sha256 = ?1");
        return row.text(sha256).next();
    }

    [[nodiscard]] std::optional<LogEntry> last_entry() override {
        Statement row = statement(select_entries("ORDER BY seq DESC LIMIT 1"));
        return row.next() ? std::optional(entry_of(row)) : std::nullopt;
    }

    [[nodiscard]] std::optional<LogEntry> entry_of_request(const std::string& request_key) override {
        Statement row = statement(select_entries("WHERE request_key = ?1 AND request_key <> ''"));
        return row.text(request_key).next() ? std::optional(entry_of(row)) : std::nullopt;
    }

    [[nodiscard]] std::vector<LogEntry> entries_of(const std::string& certificate) override {
        std::vector<LogEntry> entries;
        Statement rows = statement(select_entries("WHERE certificate = ?1 ORDER BY seq"));
        rows.text(certificate);
        while (rows.next()) {
            entries.push_back(entry_of(rows));
        }
        return entries;
    }

    void entries_of_kind(const std::string& kind, const std::function<bool(const LogEntry&)>& more) override {
        Statement rows = statement(select_entries("WHERE kind = ?1 ORDER BY seq DESC"));
        rows.text(kind);
        while (rows.next() && more(entry_of(rows))) {
        }
    }

    [[nodiscard]] std::vector<ListedCertificate> listed() override {
        std::vector<ListedCertificate> certificates;
        Statement rows = statement("SELECT certificate, state, since, item, record FROM listed ORDER BY certificate");
        while (rows.next()) {
            certificates.push_back({rows.column(0), rows.column(1), rows.column(2), rows.column(3), rows.column(4)});
        }
        return certificates;
    }

    void each_entry(const std::function<void(const LogEntry&)>& visit) override {
        Statement rows = statement(select_entries("NOT INDEXED ORDER BY seq"));
        while (rows.next()) {
            visit(entry_of(rows));
        }
    }

    void each_content(const std::function<void(const Content&)>& visit) override {
        Statement rows = statement("SELECT sha256, bytes FROM content NOT INDEXED");
        while (rows.next()) {
            visit({rows.column(0), rows.column(1)});
        }
    }

    [[nodiscard]] std::vector<std::string> own_problems() override;
    void copy_to(const fs::path& file) override;

private:
    fs::path file_;
    FileIdentity opened_;
    Database database_;
    fs::path unlocked_;
    StateOfFile before_;

    [[nodiscard]] std::optional<std::string> stored_bytes(const std::string& sha256) override {
        Statement row = statement("SELECT bytes FROM content WHERE sha256 = ?1");
        return row.text(sha256).next() ? std::optional(row.column(0)) : std::nullopt;
    }

    [[nodiscard]] std::vector<std::string> integrity_lines();
    [[nodiscard]] std::vector<std::string> integrity_problems();
    [[nodiscard]] Statement statement(std::string_view sql) { return {database_.get(), sql, name()}; }

    void transact(const char* begin, const std::function<void()>& work) {
        execute(database_.get(), begin, name());
        try {
            work();
            execute(database_.get(), "COMMIT", name());
        } catch (...) {
            // Some troubles have rolled back already; what counts is why, and that is thrown.
            (void)sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
            require_unchanged();
            throw;
        }
        require_unchanged();
    }

    /// What was read of a file that changed meanwhile says nothing of it.
    void require_unchanged() const {
        if (!unlocked_.empty() && state_of(unlocked_) != before_) {
            refuse_store("GC-ARCHIVE-0004", file_, "was written while it was read",
                         "an archive that cannot be written, or has several names, is read while nobody writes it",
                         "try again");
        }
    }
};

std::vector<std::string> SqliteStore::integrity_lines() {
    std::vector<std::string> problems;
    Statement integrity = statement("PRAGMA integrity_check(20)");
    while (integrity.next()) {
        if (const std::string line = integrity.column(0); line != "ok") {
            problems.push_back("SQLite finds: " + line);
        }
    }
    return problems;
}

/// Where memory runs out, or the disk does not answer, SQLite tells of a page that it could not get, as of a damaged one.
/// Damage is found again, with the same words, while there is memory and all of the file can be read.
std::vector<std::string> SqliteStore::integrity_problems() {
    constexpr int k_looks = 4;
    std::vector<std::string> problems = integrity_lines();
    for (int look = 1; look < k_looks && !problems.empty(); ++look) {
        require_memory();
        read_through(database_.get(), SQLITE_FCNTL_FILE_POINTER, name());
        read_through(database_.get(), SQLITE_FCNTL_JOURNAL_POINTER, name());
        std::vector<std::string> again = integrity_lines();
        if (again == problems) {
            return problems;
        }
        problems = std::move(again);
    }
    if (!problems.empty()) {
        refuse_store("GC-ARCHIVE-0008", file_, "is another one each time that it is read",
                     "the store answers without trouble", "look after disk and file, then try again");
    }
    return problems;
}

std::vector<std::string> SqliteStore::own_problems() {
    std::vector<std::string> problems = integrity_problems();
    Statement keys = statement("PRAGMA foreign_key_check");
    while (keys.next()) {
        problems.push_back("a row of " + keys.column(0) + " names a content that is not there");
    }
    std::string lines;
    for (const std::string& line : schema_lines(database_.get(), name())) {
        lines += (lines.empty() ? "" : "\n") + line;
    }
    if (encoding::sha256(lines) != schema_digest()) {
        problems.emplace_back("tables, indices or triggers are not those of an archive");
    }
    return problems;
}

void SqliteStore::copy_to(const fs::path& file) {
    const Database copy = open_database(file, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    // The journal of the copy is gone for good when this returns: one that a power cut brought back would have to be rolled
    // back first, and whoever reads a backup may not write it.
    (void)pragma(copy.get(), "synchronous = EXTRA", file.string());
    sqlite3_backup* const backup = sqlite3_backup_init(copy.get(), "main", database_.get(), "main");
    if (backup == nullptr) {
        refuse_sqlite(copy.get(), sqlite3_errcode(copy.get()), file.string());
    }
    // In one step: with several, every write of somebody else would begin the copy anew.
    const int stepped = sqlite3_backup_step(backup, -1);
    const int finished = sqlite3_backup_finish(backup);
    if (stepped != SQLITE_DONE || finished != SQLITE_OK) {
        refuse_sqlite(copy.get(), stepped != SQLITE_DONE ? stepped : finished, file.string());
    }
    (void)pragma(copy.get(), "journal_mode = DELETE", file.string());
}

void require_archive(sqlite3* database, const fs::path& file) {
    constexpr const char* rule = "an archive of gumcert has its mark and a version that this program knows";
    if (pragma(database, "application_id", file.string()) != std::to_string(k_application_id)) {
        if (schema_lines(database, file.string()).empty()) {
            refuse_store(
                "GC-ARCHIVE-0003", file, "is empty: nothing was ever written into it", rule,
                "check the name; where a command that began an archive was cut short, remove the file and begin "
                "again");
        }
        refuse_store("GC-ARCHIVE-0003", file, "is a SQLite file of something else", rule, "check the name");
    }
    if (const std::string version = pragma(database, "user_version", file.string());
        version != std::to_string(k_schema_version)) {
        refuse_store("GC-ARCHIVE-0003", file, "has version " + version + " of the tables", rule,
                     "use the version of gumcert that made it, or a later one");
    }
}

}  // namespace

void close_sqlite_file(const fs::path& file) {
    const Database database = open_database(file, SQLITE_OPEN_READWRITE);
    (void)pragma(database.get(), "journal_mode = DELETE", file.string());
}

void require_place_of_archive(const fs::path& file) {
    refuse_network_share(file.parent_path());
    for (const char* const ending : {"", "-wal", "-shm", "-journal"}) {
        const fs::path taken = file.string() + ending;
        struct stat found {};
        if (lstat(taken.c_str(), &found) == 0) {
            refuse_store("GC-ARCHIVE-0002", taken, "is there already", "an archive is begun in a new file",
                         *ending == '\0' ? "choose another name"
                                         : "choose another name: SQLite would take it for a part of the archive");
        }
    }
}

std::unique_ptr<Store> create_sqlite_store(const fs::path& file, const LogEntry& first, const Fill& fill) {
    require_place_of_archive(file);
    const bool made = make_file(file);
    if (!made && errno == EEXIST) {
        refuse_store("GC-ARCHIVE-0002", file, "is there already", "an archive is begun in a new file",
                     "choose another name");
    }
    try {
        Database database = open_database(file, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
        prepare(database.get(), file, Access::read_and_write);
        sqlite3* const raw = database.get();
        auto store = std::make_unique<SqliteStore>(file, std::move(database));
        store->write([&] {
            execute(raw, k_schema, file.string());
            (void)pragma(raw, "application_id = " + std::to_string(k_application_id), file.string());
            (void)pragma(raw, "user_version = " + std::to_string(k_schema_version), file.string());
            store->append(first);
            if (fill) {
                fill(*store);
            }
        });
        return store;
    } catch (...) {
        if (made) {  // and not finished
            std::error_code ignored;
            for (const char* const ending : {"", "-wal", "-shm", "-journal"}) {
                fs::remove(file.string() + ending, ignored);
            }
        }
        throw;
    }
}

std::unique_ptr<Store> open_sqlite_store(const fs::path& file, Access access) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        refuse_store("GC-ARCHIVE-0001", file,
                     fs::exists(file, error) ? "is a folder, a pipe or a device, and no file" : "there is no such file",
                     "an archive is begun before it is used", "check the name, or begin one with gumcert archive init");
    }
    refuse_network_share(file.parent_path());
    if (access == Access::read_and_write) {
        require_one_name(file, identity_of(file));
        require_rights_to_write(file);
    }
    refuse_log_of_another_file(file);
    const Reading reading = access == Access::read_only ? reading_of(file) : Reading{.flags = SQLITE_OPEN_READWRITE};
    const StateOfFile before = reading.unlocked.empty() ? StateOfFile{} : state_of(reading.unlocked);
    Database database = open_database(file, reading.flags, reading.address);
    require_archive(database.get(), file);
    prepare(database.get(), file, access);
    return std::make_unique<SqliteStore>(file, std::move(database), reading.unlocked, before);
}

std::string schema_digest() {
    const Database database = open_database("", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, ":memory:");
    execute(database.get(), k_schema, ":memory:");
    std::string lines;
    for (const std::string& line : schema_lines(database.get(), ":memory:")) {
        lines += (lines.empty() ? "" : "\n") + line;
    }
    return encoding::sha256(lines);
}

}  // namespace gumcert::archive
