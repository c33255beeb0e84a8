#include "archive/store/open_store.h"

#include <gtest/gtest.h>

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
    for (const char* const plain : {"postgresql://keeper@server:5432/archive", "postgresql://server:5432/archive",
                                    "lab.archive", "password=a:b@c", "", "postgresql://"}) {
        EXPECT_EQ(hidden(plain), plain);
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
