#include "archive/store/sqlite_statement.h"

#include <algorithm>
#include <cerrno>
#include <new>
#include <utility>

#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

namespace {

[[noreturn]] void fail(const char* code, const std::string& name, std::string what, const char* rule,
                       const char* action) {
    throw gum::StorageError(
        gum::Diagnostic{.code = code, .where = name, .what = std::move(what), .rule = rule, .action = action});
}

/// The result by its class; what the system said of files that cannot be opened or written tells more.
int class_of(sqlite3* database, int result) {
    const int found = result & 0xFF;
    if (database == nullptr || (found != SQLITE_IOERR && found != SQLITE_CANTOPEN)) {
        return found;
    }
    switch (sqlite3_system_errno(database)) {
        case ENOSPC:
        case EDQUOT:
            return SQLITE_FULL;
        case EIO:
            return SQLITE_IOERR;
        default:
            return found;
    }
}

}  // namespace

void refuse_sqlite(sqlite3* database, int result, const std::string& name) {
    std::string what = database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(result);
    // SQLite quotes what stands in the file, which may come from anywhere.
    std::replace_if(
        what.begin(), what.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; }, ' ');
    switch (class_of(database, result)) {
        case SQLITE_NOMEM:
            throw std::bad_alloc();  // says nothing about the store
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            fail("GC-ARCHIVE-0004", name, what, "one program writes at a time, and the others wait for up to 60 s",
                 "try again; the request was not carried out");
        case SQLITE_FULL:
            fail("GC-ARCHIVE-0005", name, what, "an entry is kept when it is on the disk",
                 "free some space, and try again; the request was not carried out");
        case SQLITE_READONLY:
        case SQLITE_CANTOPEN:
        case SQLITE_PERM:
        case SQLITE_AUTH:
            fail("GC-ARCHIVE-0006", name, what, "an archive can be read, and written by whoever adds to it",
                 "check the access rights of the file and of its folder");
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
        case SQLITE_FORMAT:
            fail("GC-ARCHIVE-0007", name, what, "the file of an archive is an undamaged SQLite database",
                 "keep the file as it is, and restore the newest backup that gumcert archive verify accepts");
        case SQLITE_CONSTRAINT:
        case SQLITE_MISMATCH:
            fail("GC-ARCHIVE-0034", name, what, "the log and the contents only grow, and their order is kept",
                 "nothing was changed; see docs/archive.md for what can be done instead");
        default:
            fail(
                "GC-ARCHIVE-0008", name, what, "the store answers without trouble",
                "look after disk and file, then try again; where COMMIT failed, the same request key tells whether the "
                "request was carried out");
    }
}

void execute(sqlite3* database, const char* sql, const std::string& name) {
    if (const int result = sqlite3_exec(database, sql, nullptr, nullptr, nullptr); result != SQLITE_OK) {
        refuse_sqlite(database, result, name);
    }
}

Statement::Statement(sqlite3* database, std::string_view sql, std::string name)
    : database_(database), name_(std::move(name)) {
    check(sqlite3_prepare_v2(database_, sql.data(), static_cast<int>(sql.size()), &statement_, nullptr));
}

void Statement::check(int result) const {
    if (result != SQLITE_OK) {
        refuse_sqlite(database_, result, name_);
    }
}

Statement& Statement::text(std::string_view value) {
    check(sqlite3_bind_text64(statement_, ++bound_, value.data(), value.size(), nullptr, SQLITE_UTF8));
    return *this;
}

Statement& Statement::bytes(std::string_view value) {
    check(sqlite3_bind_blob64(statement_, ++bound_, value.data(), value.size(), nullptr));
    return *this;
}

Statement& Statement::integer(std::int64_t value) {
    check(sqlite3_bind_int64(statement_, ++bound_, value));
    return *this;
}

Statement& Statement::null() {
    check(sqlite3_bind_null(statement_, ++bound_));
    return *this;
}

bool Statement::next() {
    const int result = sqlite3_step(statement_);
    if (result != SQLITE_ROW && result != SQLITE_DONE) {
        refuse_sqlite(database_, result, name_);
    }
    return result == SQLITE_ROW;
}

std::string Statement::column(int index) const {
    const void* const data = sqlite3_column_blob(statement_, index);
    const int size = sqlite3_column_bytes(statement_, index);
    if (data == nullptr && sqlite3_errcode(database_) == SQLITE_NOMEM) {
        throw std::bad_alloc();  // not the empty text that it looks like
    }
    return data == nullptr ? std::string()
                           : std::string(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace gumcert::archive
