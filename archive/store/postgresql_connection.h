#pragma once

#include <libpq-fe.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::archive {

struct ClearResult {
    void operator()(PGresult* result) const { PQclear(result); }
};

/// Rows that a statement gave.
class PostgresqlRows {
public:
    explicit PostgresqlRows(PGresult* result) : result_(result) {}

    [[nodiscard]] int size() const { return PQntuples(result_.get()); }
    [[nodiscard]] std::string column(int row, int index) const;  ///< text or bytes; "" of NULL
    [[nodiscard]] std::int64_t integer(int row, int index) const;

private:
    std::unique_ptr<PGresult, ClearResult> result_;
};

/// One value of a statement, `$1, $2 …`. Texts and bytes must outlive the call.
struct PostgresqlValue {
    enum class Kind { text, bytes, null };
    std::string_view bytes;
    Kind kind = Kind::text;
};

/// A connection to a server of PostgreSQL. What the server remarks is not printed.
class PostgresqlConnection {
public:
    /// \param address  "postgresql://…" as libpq reads it; a password in it is never told
    /// \throws gum::StorageError  GC-ARCHIVE-0006 where the address cannot be read, -0008 where nobody answers
    explicit PostgresqlConnection(const std::string& address);

    /// "postgresql://host:port/database", without user and password.
    [[nodiscard]] const std::string& name() const { return name_; }

    /// Runs statements without values and rows.
    void execute(const char* sql);
    /// \return the rows, in the binary form of the server
    PostgresqlRows query(const std::string& sql, const std::vector<PostgresqlValue>& values = {});
    /// Does work in one transaction; what it throws gives the transaction up.
    /// \param begin  "BEGIN …", with the isolation that the work needs
    void transact(const char* begin, const std::function<void()>& work);

private:
    struct Close {
        void operator()(PGconn* connection) const { PQfinish(connection); }
    };
    std::unique_ptr<PGconn, Close> connection_;
    std::string name_;

    void check(const PGresult* result) const;
    /// Gives up the transaction; an error of that counts for nothing.
    void roll_back() noexcept;
};

}  // namespace gumcert::archive
