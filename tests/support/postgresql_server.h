#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

namespace gumcert::archive::test {

/// A server of PostgreSQL for the tests of one program: on a socket in a folder of its own, without a network. It ends with
/// the program.
class PostgresqlServer {
public:
    /// \return nothing where Debian's package postgresql-15 is not there; tests are skipped then
    static const PostgresqlServer* get() {
        static const std::unique_ptr<PostgresqlServer> server = start();
        return server.get();
    }

    PostgresqlServer(const PostgresqlServer&) = delete;
    PostgresqlServer& operator=(const PostgresqlServer&) = delete;
    ~PostgresqlServer() {
        (void)run("pg_ctl -D " + folder_ + "/data -m immediate stop");
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    /// Address of a new, empty database.
    [[nodiscard]] std::string new_database() const {
        static int number = 0;
        const std::string name = "archive_" + std::to_string(++number);
        EXPECT_EQ(run("createdb -h " + folder_ + " -U keeper " + name), 0);
        return "postgresql://keeper@/" + name + "?host=" + folder_;
    }
    /// Runs SQL as another program would.
    [[nodiscard]] bool run_sql(const std::string& address, const std::string& sql) const {
        return run("psql -q -v ON_ERROR_STOP=1 -d '" + address + "' -c \"" + sql + "\"") == 0;
    }

private:
    std::string folder_;

    explicit PostgresqlServer(std::string folder) : folder_(std::move(folder)) {}

    [[nodiscard]] int run(const std::string& command) const {
        // The server refuses to run as root.
        const std::string as = geteuid() == 0 ? "setpriv --reuid=postgres --regid=postgres --clear-groups " : "";
        return std::system(
            ("cd " + folder_ + " && " + as + "/usr/lib/postgresql/15/bin/" + command + " >> " + folder_ + "/log 2>&1")
                .c_str());
    }

    static std::unique_ptr<PostgresqlServer> start() {
        if (!std::filesystem::exists("/usr/lib/postgresql/15/bin/postgres")) {
            return nullptr;
        }
        std::string folder = "/tmp/gumcert-postgresql-XXXXXX";  // the path of a socket is short
        if (mkdtemp(folder.data()) == nullptr) {
            return nullptr;
        }
        if (geteuid() == 0 && std::system(("chown postgres " + folder).c_str()) != 0) {
            return nullptr;
        }
        std::unique_ptr<PostgresqlServer> server(new PostgresqlServer(folder));
        if (server->run("initdb -D " + folder + "/data -U keeper -A trust -E UTF8 --locale=C --no-sync") != 0 ||
            server->run("pg_ctl -D " + folder + "/data -w -o \"-k " + folder + " -c listen_addresses=''\" -l " +
                        folder + "/server.log start") != 0) {
            ADD_FAILURE() << "the server of PostgreSQL does not start: see " << folder;
            return nullptr;
        }
        return server;
    }
};

#define SKIP_WITHOUT_POSTGRESQL()                                                    \
    if (::gumcert::archive::test::PostgresqlServer::get() == nullptr) {              \
        GTEST_SKIP() << "postgresql-15 is not installed: scripts/setup installs it"; \
    }                                                                                \
    static_cast<void>(0)

}  // namespace gumcert::archive::test
