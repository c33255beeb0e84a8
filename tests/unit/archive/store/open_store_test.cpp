#include "archive/store/open_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/support/archive_folder.h"

namespace gumcert::archive {
namespace {

TEST(OpenStore, ChoosesByTheAddress) {
    EXPECT_TRUE(is_postgresql("postgresql://db/archive"));
    EXPECT_TRUE(is_postgresql("postgres://db/archive"));
    EXPECT_FALSE(is_postgresql("lab.archive"));
    EXPECT_FALSE(is_postgresql("./postgresql:/x"));
    const test::StoreFolder folder;
    EXPECT_EQ(test::code_of([&] { (void)open_store(folder.file().string(), Access::read_only); }), "GC-ARCHIVE-0001");
    EXPECT_EQ(test::code_of([&] { (void)open_store("postgresql:///x?host=/nowhere", Access::read_only); }),
              "GC-ARCHIVE-0008");
}

TEST(OpenStore, HidesPasswords) {
    const auto hidden = [](std::string word) {
        hide_passwords(word);
        return word;
    };
    EXPECT_EQ(hidden("postgresql://keeper:geheim@server:5432/archive"),
              "postgresql://keeper:xxxxxx@server:5432/archive");
    EXPECT_EQ(hidden("--store=postgres://keeper:a:b%40c@server/archive"),
              "--store=postgres://keeper:xxxxxxx@server/archive");
    EXPECT_EQ(hidden("postgresql:///archive?password=geheim&host=/run&sslpassword=auch"),
              "postgresql:///archive?password=xxxxxx&host=/run&sslpassword=xxxx");
    EXPECT_EQ(hidden("postgresql://u:S3c@retPw@server/db"), "postgresql://u:xxxxxxxxx@server/db");
    EXPECT_EQ(hidden("postgresql://u:a/b@c@server/db"), "postgresql://u:xxxxx@server/db");
    EXPECT_EQ(hidden("mysql://u:pw@server/db"), "mysql://u:xx@server/db");
    EXPECT_EQ(hidden("unexpected: --to postgres://u:pw@a/db postgres://v:pq@b/db"),
              "unexpected: --to postgres://u:xx@a/db postgres://v:xx@b/db");
    EXPECT_EQ(hidden("host=server password=S3cretPw user=u"), "host=server password=xxxxxxxx user=u");
    EXPECT_EQ(hidden("password = 'S3 cr' host=a"), "password = xxxxxx' host=a");
    EXPECT_EQ(hidden("password="), "password=");
    for (const char* const plain : {"postgresql://keeper@server:5432/archive", "postgresql://server:5432/archive",
                                    "lab.archive", "", "postgresql://", "a password of a@b:c", "password", "://"}) {
        EXPECT_EQ(hidden(plain), plain);
    }
}

/// Whatever somebody takes for an address, and wherever in it the password stands: no message holds a part of it.
TEST(OpenStore, TellsNoPartOfAPassword) {
    const std::string secret = "Zq7%Xk9";
    std::set<std::string> passwords;
    for (const char sign : std::string("@/:?#&=%,;[] '\"\\+")) {
        for (const std::size_t at : {std::size_t{0}, std::size_t{3}, secret.size()}) {
            std::string password = secret;
            password.erase(3, 1);
            password.insert(std::min(at, password.size()), 1, sign);
            passwords.insert(password);
        }
    }
    for (const std::string& password : passwords) {
        for (const std::string& address :
             {"postgresql://u:" + password + "@127.0.0.1:1/db",
              "postgres://u:" + password + "@127.0.0.1:1/db?sslmode=disable",
              "postgresql://u@127.0.0.1:1/db?password=" + password,
              // The host is forgotten; with these two signs a host stands there.
              "postgresql://u:" + (password.find_first_of("@,") == std::string::npos ? password : secret) + "/db",
              "postgresql://u:" + password + "@", "PostgreSQL://u:" + password + "@127.0.0.1/db",
              "postgresql+psycopg2://u:" + password + "@127.0.0.1/db", "postgresql:u:" + password + "@127.0.0.1/db",
              "mysql://u:" + password + "@127.0.0.1/db", "host=127.0.0.1 user=u password=" + password,
              "host=127.0.0.1 password = '" + password + "'"}) {
            for (const bool creates : {false, true}) {
                std::string told;
                try {
                    (void)(creates ? create_store(address, {}) : open_store(address, Access::read_only));
                } catch (const gum::StorageError& error) {
                    told = gum::message(error.diagnostics().front());
                }
                EXPECT_NE(told, "") << address;
                for (const char* const part : {"Zq7", "Xk9"}) {
                    EXPECT_EQ(told.find(part), std::string::npos) << address << "\n" << told;
                }
            }
        }
    }
}

TEST(OpenStore, CreatesAndReplays) {
    const test::StoreFolder folder;
    LogEntry first;
    first.seq = 1;
    first.at = "2026-11-27T18:52:52Z";
    first.kind = "created";
    first.prev = std::string(32, '\0');
    first.hash = entry_hash(first);
    const auto store = create_store(folder.file().string(), first);
    const auto copy = replay_into(*store, folder.file("b").string(), [](Store&) {});
    EXPECT_EQ(copy->last_entry(), first);
    EXPECT_EQ(open_store(folder.file("b").string(), Access::read_only)->last_entry(), first);
}

}  // namespace
}  // namespace gumcert::archive
