#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace gumcert::archive {

struct CloseDatabase {
    void operator()(sqlite3* database) const { (void)sqlite3_close_v2(database); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;

/// Turns what SQLite says into a failure that the program explains: busy, full, read-only, damaged, refused, other.
/// \param name  of the store
[[noreturn]] void refuse_sqlite(sqlite3* database, int result, const std::string& name);

/// Runs statements without results.
void execute(sqlite3* database, const char* sql, const std::string& name);

/// One prepared statement. Parameters are bound in the order of `?1, ?2 …`; texts and bytes must outlive it.
class Statement {
public:
    Statement(sqlite3* database, std::string_view sql, std::string name);
    ~Statement() { (void)sqlite3_finalize(statement_); }
    Statement(const Statement&) = delete;
    Statement& operator=(const Statement&) = delete;

    Statement& text(std::string_view value);
    Statement& bytes(std::string_view value);
    Statement& integer(std::int64_t value);
    Statement& null();

    /// \return true where there is a row
    [[nodiscard]] bool next();
    /// Runs one that gives no rows.
    void run() { (void)next(); }

    [[nodiscard]] std::string column(int index) const;  ///< text or bytes; "" of NULL
    [[nodiscard]] std::int64_t integer_column(int index) const { return sqlite3_column_int64(statement_, index); }

private:
    sqlite3* database_;
    std::string name_;
    sqlite3_stmt* statement_ = nullptr;
    int bound_ = 0;

    void check(int result) const;
};

}  // namespace gumcert::archive
