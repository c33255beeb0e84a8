#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/support/archive_folder.h"
#include "tests/support/postgresql_server.h"

namespace gumcert::archive::test {

/// An archive in a file.
class InAFile {
public:
    static bool is_there() { return true; }
    /// Address of an archive that is not there yet.
    [[nodiscard]] std::string new_place() { return folder_.file((std::to_string(++places_) + ".archive").c_str()); }
    [[nodiscard]] const StoreFolder& folder() const { return folder_; }

private:
    StoreFolder folder_;
    int places_ = 0;
};

/// An archive on a server of PostgreSQL.
class OnAServer {
public:
    static bool is_there() { return PostgresqlServer::get() != nullptr; }
    [[nodiscard]] std::string new_place() { return PostgresqlServer::get()->new_database(); }
    [[nodiscard]] const StoreFolder& folder() const { return folder_; }

private:
    StoreFolder folder_;  // for copies
};

/// What holds for an archive holds on both kinds of store, and is stated once.
using BothStores = testing::Types<InAFile, OnAServer>;

/// Skips where the server is not installed.
template <class Kind>
class OnBothStores : public testing::Test {
protected:
    Kind kind_;

    void SetUp() override {
        if (!Kind::is_there()) {
            GTEST_SKIP() << "postgresql-15 is not installed: scripts/setup installs it";
        }
        prepare();
    }
    virtual void prepare() {}
};

}  // namespace gumcert::archive::test
