#include "archive/store/postgresql_store.h"

#include <utility>
#include <vector>

#include "archive/store/postgresql_connection.h"
#include "archive/store/postgresql_schema.h"
#include "archive/store/replay.h"
#include "archive/store/sqlite_store.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

namespace {

using Rows = PostgresqlRows;
using Value = PostgresqlValue;

constexpr const char* k_columns =
    "SELECT seq, at, actor, kind, certificate, record, request_key, body, prev, hash FROM gumcert_archive.log ";
// Entries are small; a record with its documents has some megabytes.
constexpr int k_entries_of_a_page = 1000;
constexpr int k_contents_of_a_page = 8;

Value bytes_of(std::string_view bytes) {
    return {bytes, Value::Kind::bytes};
}

LogEntry row_as_entry(const Rows& rows, int row) {
    return {.seq = rows.integer(row, 0),
            .at = rows.column(row, 1),
            .actor = rows.column(row, 2),
            .kind = rows.column(row, 3),
            .certificate = rows.column(row, 4),
            .record = rows.column(row, 5),
            .request_key = rows.column(row, 6),
            .body = rows.column(row, 7),
            .prev = rows.column(row, 8),
            .hash = rows.column(row, 9)};
}

std::string setting(PostgresqlConnection& connection, const std::string& name) {
    return connection.query("SELECT pg_catalog.current_setting($1)", {{name}}).column(0, 0);
}

void require_setting(PostgresqlConnection& connection, const std::string& name, const std::string& value) {
    if (const std::string now = setting(connection, name); now != value) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-ARCHIVE-0009",
                                                .where = connection.name(),
                                                .what = name + " is " + now,
                                                .rule = "an archive is written with settings that survive a power cut",
                                                .action = "set " + name + " = " + value + " on the server"});
    }
}

void prepare_session(PostgresqlConnection& connection, Access access) {
    // Names without their schema could be those of somebody else.
    connection.execute("SET search_path = ''; SET lock_timeout = '60s'; SET synchronous_commit = on");
    require_setting(connection, "server_encoding", "UTF8");
    if (access == Access::read_only) {
        connection.execute("SET default_transaction_read_only = on");
        return;
    }
    for (const char* const name : {"fsync", "full_page_writes", "synchronous_commit"}) {
        require_setting(connection, name, "on");
    }
}

/// The comment of the schema, if the database has one of that name.
std::optional<std::string> mark_of(PostgresqlConnection& connection) {
    const Rows rows = connection.query(
        "SELECT coalesce(pg_catalog.obj_description(oid, 'pg_namespace'), '') FROM pg_catalog.pg_namespace WHERE "
        "nspname = 'gumcert_archive'");
    return rows.size() > 0 ? std::optional(rows.column(0, 0)) : std::nullopt;
}

class PostgresqlStore : public Store {
public:
    explicit PostgresqlStore(PostgresqlConnection connection) : connection_(std::move(connection)) {}

    [[nodiscard]] std::string name() const override { return connection_.name(); }

    void read(const std::function<void()>& work) override {
        connection_.transact("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY", work);
    }

    void write(const std::function<void()>& work) override {
        connection_.transact("BEGIN ISOLATION LEVEL READ COMMITTED", [&] {
            // Waits for the other writers; the lock ends with the transaction. What follows sees what they wrote.
            connection_.execute("SELECT pg_catalog.pg_advisory_xact_lock(1735213426)");
            work();
        });
    }

    void append(const LogEntry& e) override {
        const std::string seq = std::to_string(e.seq);
        (void)connection_.query(
            "INSERT INTO gumcert_archive.log VALUES($1::bigint, $2, $3, $4, $5, $6, $7, $8, $9, $10)",
            {{seq},
             {e.at},
             {e.actor},
             {e.kind},
             {e.certificate},
             {e.record, e.record.empty() ? Value::Kind::null : Value::Kind::text},
             {e.request_key},
             {e.body},
             bytes_of(e.prev),
             bytes_of(e.hash)});
    }

    void put(const Content& content) override {
        (void)connection_.query("INSERT INTO gumcert_archive.content VALUES($1, $2)",
                                {{content.sha256}, bytes_of(content.bytes)});
    }

    void list(const ListedCertificate& one) override {
        (void)connection_.query(
            "INSERT INTO gumcert_archive.listed VALUES($1, $2, $3, $4, $5) ON CONFLICT (certificate) DO UPDATE SET "
            "state "
            "= excluded.state, since = excluded.since, item = excluded.item, record = excluded.record",
            {{one.number}, {one.state}, {one.since}, {one.item}, {one.record}});
    }

    [[nodiscard]] bool has(const std::string& sha256) override {
        return connection_.query("SELECT 1 FROM gumcert_archive.content WHERE sha256 = $1", {{sha256}}).size() > 0;
    }

    [[nodiscard]] std::optional<LogEntry> last_entry() override { return first_of("ORDER BY seq DESC LIMIT 1", {}); }

    [[nodiscard]] std::optional<LogEntry> entry_of_request(const std::string& request_key) override {
        return first_of("WHERE request_key = $1 AND request_key <> ''", {{request_key}});
    }

    [[nodiscard]] std::vector<LogEntry> entries_of(const std::string& certificate) override {
        return all_of("WHERE certificate = $1 ORDER BY seq", {{certificate}});
    }

    void entries_of_kind(const std::string& kind, const std::function<bool(const LogEntry&)>& more) override {
        std::string before = std::to_string(std::int64_t{1} << 62U);
        while (true) {
            const std::vector<LogEntry> page = all_of(
                "WHERE kind = $1 AND seq < $2::bigint ORDER BY seq DESC LIMIT " + std::to_string(k_entries_of_a_page),
                {{kind}, {before}});
            for (const LogEntry& entry : page) {
                if (!more(entry)) {
                    return;
                }
            }
            if (page.size() < static_cast<std::size_t>(k_entries_of_a_page)) {
                return;
            }
            before = std::to_string(page.back().seq);
        }
    }

    [[nodiscard]] std::vector<ListedCertificate> listed() override {
        const Rows rows = connection_.query(
            "SELECT certificate, state, since, item, record FROM gumcert_archive.listed ORDER BY certificate");
        std::vector<ListedCertificate> certificates;
        for (int row = 0; row < rows.size(); ++row) {
            certificates.push_back({rows.column(row, 0), rows.column(row, 1), rows.column(row, 2), rows.column(row, 3),
                                    rows.column(row, 4)});
        }
        return certificates;
    }

    void each_entry(const std::function<void(const LogEntry&)>& visit) override {
        std::string after = "0";
        while (true) {
            const std::vector<LogEntry> page =
                all_of("WHERE seq > $1::bigint ORDER BY seq LIMIT " + std::to_string(k_entries_of_a_page), {{after}});
            for (const LogEntry& entry : page) {
                visit(entry);
            }
            if (page.size() < static_cast<std::size_t>(k_entries_of_a_page)) {
                return;
            }
            after = std::to_string(page.back().seq);
        }
    }

    void each_content(const std::function<void(const Content&)>& visit) override {
        std::string after;
        while (true) {
            const Rows rows = connection_.query(
                "SELECT sha256, bytes FROM gumcert_archive.content WHERE sha256 > $1 ORDER BY sha256 LIMIT " +
                    std::to_string(k_contents_of_a_page),
                {{after}});
            for (int row = 0; row < rows.size(); ++row) {
                after = rows.column(row, 0);
                visit({after, rows.column(row, 1)});
            }
            if (rows.size() < k_contents_of_a_page) {
                return;
            }
        }
    }

    [[nodiscard]] std::vector<std::string> own_problems() override {
        std::vector<std::string> problems;
        if (encoding::sha256(description()) != postgresql_schema_digest()) {
            problems.emplace_back("tables, indices, functions or triggers are not those of an archive");
        }
        const Rows orphans = connection_.query(
            "SELECT seq FROM gumcert_archive.log l WHERE record IS NOT NULL AND NOT EXISTS (SELECT 1 FROM "
            "gumcert_archive.content c WHERE c.sha256 = l.record) ORDER BY seq LIMIT 20");
        for (int row = 0; row < orphans.size(); ++row) {
            problems.push_back("entry " + std::to_string(orphans.integer(row, 0)) +
                               " names a content that is not there");
        }
        return problems;
    }

    void copy_to(const std::filesystem::path& file) override {
        {
            std::unique_ptr<Store> copy;
            replay(
                *this, [&](const LogEntry& first, const Fill& fill) { copy = create_sqlite_store(file, first, fill); },
                [&](Store& to) {
                    for (const ListedCertificate& one : listed()) {
                        to.list(one);
                    }
                });
        }
        close_sqlite_file(file);
    }

    /// Makes the schema with the first entry, and what `fill` adds.
    void begin(const LogEntry& first, const Fill& fill) {
        write([&] {
            if (mark_of(connection_)) {
                throw gum::StorageError(gum::Diagnostic{.code = "GC-ARCHIVE-0002",
                                                        .where = name(),
                                                        .what = "the database has a schema gumcert_archive already",
                                                        .rule = "a database holds one archive",
                                                        .action = "choose another database"});
            }
            connection_.execute("CREATE SCHEMA gumcert_archive");
            connection_.execute(
                (std::string("COMMENT ON SCHEMA gumcert_archive IS '") + k_postgresql_mark + "'").c_str());
            connection_.execute(k_postgresql_schema);
            append(first);
            if (fill) {
                fill(*this);
            }
        });
    }

    /// Everything that the schema has, in lines.
    [[nodiscard]] std::string description() {
        std::string lines;
        const Rows rows = connection_.query(k_postgresql_description);
        for (int row = 0; row < rows.size(); ++row) {
            lines += rows.column(row, 0) + '\n';
        }
        return lines;
    }

private:
    PostgresqlConnection connection_;

    [[nodiscard]] std::optional<std::string> stored_bytes(const std::string& sha256) override {
        const Rows rows = connection_.query("SELECT bytes FROM gumcert_archive.content WHERE sha256 = $1", {{sha256}});
        return rows.size() > 0 ? std::optional(rows.column(0, 0)) : std::nullopt;
    }

    std::vector<LogEntry> all_of(const std::string& rest, const std::vector<Value>& values) {
        const Rows rows = connection_.query(k_columns + rest, values);
        std::vector<LogEntry> entries;
        for (int row = 0; row < rows.size(); ++row) {
            entries.push_back(row_as_entry(rows, row));
        }
        return entries;
    }

    std::optional<LogEntry> first_of(const std::string& rest, const std::vector<Value>& values) {
        std::vector<LogEntry> entries = all_of(rest, values);
        return entries.empty() ? std::nullopt : std::optional(std::move(entries.front()));
    }
};

}  // namespace

std::unique_ptr<Store> create_postgresql_store(const std::string& address, const LogEntry& first, const Fill& fill) {
    PostgresqlConnection connection(address);
    prepare_session(connection, Access::read_and_write);
    auto store = std::make_unique<PostgresqlStore>(std::move(connection));
    store->begin(first, fill);
    return store;
}

std::unique_ptr<Store> open_postgresql_store(const std::string& address, Access access) {
    PostgresqlConnection connection(address);
    prepare_session(connection, access);
    const std::optional<std::string> mark = mark_of(connection);
    if (mark != k_postgresql_mark) {
        throw gum::StorageError(
            gum::Diagnostic{.code = mark ? "GC-ARCHIVE-0003" : "GC-ARCHIVE-0001",
                            .where = connection.name(),
                            .what = mark ? "has a schema gumcert_archive with the mark \"" + *mark + "\""
                                         : "the database has no archive",
                            .rule = mark ? "an archive of gumcert has its mark and a version that this program knows"
                                         : "an archive is begun before it is used",
                            .action = mark ? "use the version of gumcert that made it, or a later one"
                                           : "check the name, or begin one with gumcert archive init"});
    }
    return std::make_unique<PostgresqlStore>(std::move(connection));
}

std::string postgresql_schema_digest() {
    return "bf880ee61ceb4ab975b5b479a80cae0623f022b1b734259cd47ca015b8aea774";
}

}  // namespace gumcert::archive
