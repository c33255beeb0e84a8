#include "archive/store/postgresql_connection.h"

#include <array>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

namespace {

/// Object identifier of bytea in the catalogue of every server.
constexpr Oid k_bytea = 17;
constexpr Oid k_text = 25;

[[noreturn]] void refuse_server(const char* code, const std::string& name, std::string what, const char* rule,
                                const char* action) {
    throw gum::StorageError(
        gum::Diagnostic{.code = code, .where = name, .what = std::move(what), .rule = rule, .action = action});
}

/// The first line of what the server says, without its word "ERROR:".
std::string first_line(std::string_view text) {
    for (const std::string_view word : {"ERROR:", "FATAL:", "PANIC:"}) {
        if (text.starts_with(word)) {
            text.remove_prefix(word.size());
        }
    }
    text = text.substr(0, text.find('\n'));
    while (text.starts_with(' ')) {
        text.remove_prefix(1);
    }
    return std::string(text);
}

/// Turns SQLSTATE (PostgreSQL 15, appendix A) into a failure that the program explains.
[[noreturn]] void refuse_state(std::string_view state, const std::string& name, const std::string& what) {
    if (state == "55P03" || state == "57014" || state == "40001" || state == "40P01") {
        refuse_server("GC-ARCHIVE-0004", name, what, "one program writes at a time, and the others wait for up to 60 s",
                      "try again; the request was not carried out");
    }
    if (state == "53100") {
        refuse_server("GC-ARCHIVE-0005", name, what, "an entry is kept when it is on the disk",
                      "free some space on the server, and try again; the request was not carried out");
    }
    if (state == "42501" || state == "25006" || state.starts_with("28")) {
        refuse_server("GC-ARCHIVE-0006", name, what, "an archive can be read, and written by whoever adds to it",
                      "check the rights of the role on the schema gumcert_archive");
    }
    if (state.starts_with("XX0")) {
        refuse_server("GC-ARCHIVE-0007", name, what, "the database of an archive is undamaged",
                      "keep it as it is, and restore the newest backup that gumcert archive verify accepts");
    }
    if (state == "3F000" || state == "42P01" || state == "42703") {
        refuse_server("GC-ARCHIVE-0003", name, what,
                      "an archive of gumcert has its mark and a version that this "
                      "program knows",
                      "check the name of the database");
    }
    if (state.starts_with("23") || state.starts_with("22")) {
        refuse_server("GC-ARCHIVE-0034", name, what, "the log and the contents only grow, and their order is kept",
                      "nothing was changed; see docs/archive.md for what can be done instead");
    }
    refuse_server(
        "GC-ARCHIVE-0008", name, what, "the store answers without trouble",
        "look after server and network, then try again; where the answer to COMMIT was lost, the same request "
        "key tells whether it was carried out");
}

/// Shows nothing of the address: what cannot be read may be a password.
[[noreturn]] void refuse_address(const char* what) {
    refuse_server(
        "GC-ARCHIVE-0006", "postgresql://…", std::string("the address ") + what,
        "an archive on a server has an address postgresql://HOST:PORT/DATABASE",
        "correct the address; @, /, ? and % in user, password and parameters are written %40, %2F, %3F and %25");
}

/// libpq ends a password at the first @, and knows none where a / comes before: the rest of it would be a host, a port or a
/// database, and stand in messages. What libpq says of an address that it cannot read holds parts of it, too.
void require_readable(const std::string& address) {
    const std::size_t begin = address.find("//") + 2;
    const std::size_t at = address.find('@', begin);
    if (at != std::string::npos && (at > address.find('/', begin) || address.find('@', at + 1) != std::string::npos)) {
        refuse_address("has an @ that does not end user and password");
    }
    const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(
        PQconninfoParse(address.c_str(), nullptr), &PQconninfoFree);
    if (options == nullptr) {
        refuse_address("cannot be read");
    }
    for (const PQconninfoOption* option = options.get(); option->keyword != nullptr; ++option) {
        const std::string_view keyword = option->keyword;
        const std::string_view value = option->val == nullptr ? "" : option->val;
        if ((keyword == "port" && value.find_first_not_of("0123456789,") != std::string_view::npos) ||
            (keyword == "dbname" && value.find_first_of("/@") != std::string_view::npos)) {
            refuse_address("cannot be read");
        }
    }
}

std::string or_default(const char* text, const char* otherwise) {
    return text == nullptr || *text == '\0' ? otherwise : text;
}

}  // namespace

std::string PostgresqlRows::column(int row, int index) const {
    return {PQgetvalue(result_.get(), row, index), static_cast<std::size_t>(PQgetlength(result_.get(), row, index))};
}

std::int64_t PostgresqlRows::integer(int row, int index) const {
    std::uint64_t value = 0;  // the highest byte first
    for (const char c : column(row, index)) {
        value = (value << 8U) | static_cast<unsigned char>(c);
    }
    return static_cast<std::int64_t>(value);
}

PostgresqlConnection::PostgresqlConnection(const std::string& address) : name_("postgresql://") {
    require_readable(address);
    constexpr std::array<const char*, 4> names = {"dbname", "connect_timeout", "fallback_application_name", nullptr};
    const std::array<const char*, 4> values = {address.c_str(), "30", "gumcert", nullptr};
    connection_.reset(PQconnectdbParams(names.data(), values.data(), 1));
    PGconn* const connection = connection_.get();
    if (connection == nullptr) {
        throw std::bad_alloc();
    }
    if (PQhost(connection) == nullptr || PQdb(connection) == nullptr) {
        refuse_address("cannot be read");
    }
    name_ += or_default(PQhost(connection), "localhost") + ":" + or_default(PQport(connection), "5432") + "/" +
             or_default(PQdb(connection), "");
    if (PQstatus(connection) != CONNECTION_OK) {
        refuse_server("GC-ARCHIVE-0008", name_, first_line(PQerrorMessage(connection)),
                      "the store answers without trouble",
                      "check address, role and password (~/.pgpass), and that the server runs");
    }
    (void)PQsetNoticeProcessor(
        connection, [](void*, const char*) {}, nullptr);
    if (PQsetClientEncoding(connection, "UTF8") != 0) {
        refuse_server("GC-ARCHIVE-0008", name_, first_line(PQerrorMessage(connection)), "texts of an archive are UTF-8",
                      "use a database with the encoding UTF8");
    }
}

void PostgresqlConnection::check(const PGresult* result) const {
    if (result == nullptr) {
        throw std::bad_alloc();  // libpq makes a result of every other trouble
    }
    const ExecStatusType status = PQresultStatus(result);
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) {
        const char* const state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
        refuse_state(state == nullptr ? "" : state, name_, first_line(PQresultErrorMessage(result)));
    }
}

void PostgresqlConnection::execute(const char* sql) {
    const std::unique_ptr<PGresult, ClearResult> result(PQexec(connection_.get(), sql));
    check(result.get());
}

PostgresqlRows PostgresqlConnection::query(const std::string& sql, const std::vector<PostgresqlValue>& values) {
    std::vector<Oid> types;
    std::vector<const char*> data;
    std::vector<int> lengths;
    // All of them in binary form: a text is its bytes, which need no 0 behind them then.
    const std::vector<int> binary(values.size(), 1);
    for (const PostgresqlValue& value : values) {
        types.push_back(value.kind == PostgresqlValue::Kind::bytes ? k_bytea : k_text);
        data.push_back(value.kind == PostgresqlValue::Kind::null ? nullptr
                       : value.bytes.data() == nullptr           ? ""
                                                                 : value.bytes.data());
        lengths.push_back(static_cast<int>(value.bytes.size()));
    }
    PGresult* const result = PQexecParams(connection_.get(), sql.c_str(), static_cast<int>(values.size()), types.data(),
                                          data.data(), lengths.data(), binary.data(), 1);
    PostgresqlRows rows(result);
    check(result);
    return rows;
}

void PostgresqlConnection::transact(const char* begin, const std::function<void()>& work) {
    execute(begin);
    try {
        work();
        execute("COMMIT");
    } catch (...) {
        roll_back();
        throw;
    }
}

void PostgresqlConnection::roll_back() noexcept {
    PQclear(PQexec(connection_.get(), "ROLLBACK"));
}

}  // namespace gumcert::archive
