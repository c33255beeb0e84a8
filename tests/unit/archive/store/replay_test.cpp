#include "archive/store/replay.h"

#include <gtest/gtest.h>

#include "archive/store/sqlite_store.h"
#include "encoding/sha2.h"
#include "tests/support/archive_folder.h"

namespace gumcert::archive {
namespace {

LogEntry entry(std::int64_t seq, const std::string& prev, const std::string& record = "") {
    LogEntry made{.seq = seq,
                  .at = "2026-11-27T18:52:52Z",
                  .actor = "K. Keeper",
                  .kind = "created",
                  .certificate = {},
                  .record = record,
                  .request_key = {},
                  .body = "{}\n",
                  .prev = prev,
                  .hash = {}};
    made.hash = entry_hash(made);
    return made;
}

TEST(Replay, MakesTheSameEntriesAndContents) {
    const test::StoreFolder folder;
    const std::string bytes = "a record";
    const LogEntry first = entry(1, std::string(32, '\0'));
    const LogEntry second = entry(2, first.hash, encoding::sha256(bytes));
    const auto from = create_sqlite_store(folder.file(), first, [&](Store& store) {
        store.put({encoding::sha256(bytes), bytes});
        store.append(second);
    });
    std::unique_ptr<Store> to;
    replay(
        *from,
        [&](const LogEntry& begin, const Fill& fill) { to = create_sqlite_store(folder.file("b"), begin, fill); },
        [](Store& made) {
            made.list({"EX-1", "issued", "2026-11-27T18:52:52Z", "a gauge", ""});
        });
    std::vector<LogEntry> copied;
    to->each_entry([&](const LogEntry& one) { copied.push_back(one); });
    EXPECT_EQ(copied, (std::vector{first, second}));
    EXPECT_EQ(to->listed().size(), 1U);
    EXPECT_EQ(to->content(encoding::sha256(bytes)), bytes);
}

}  // namespace
}  // namespace gumcert::archive
