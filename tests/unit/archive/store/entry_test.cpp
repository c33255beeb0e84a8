#include "archive/store/entry.h"

#include <gtest/gtest.h>

#include "encoding/sha2.h"

namespace gumcert::archive {
namespace {

LogEntry sample_entry() {
    return {.seq = 7,
            .at = "2026-11-24T18:52:52Z",
            .actor = "R. Lin",
            .kind = "drafted",
            .certificate = "EX-2026-0042",
            .record = std::string(64, 'a'),
            .request_key = "k",
            .body = "{}\n",
            .prev = std::string(32, '\1'),
            .hash = {}};
}

TEST(LogEntryHash, HasEveryFieldWithItsLengthInFront) {
    const std::string bytes = canonical_bytes(sample_entry());
    EXPECT_EQ(bytes.substr(0, 8), std::string("\0\0\0\0\0\0\0\x17", 8));
    EXPECT_EQ(bytes.substr(8, 23), "gumcert/archive/entry/1");
    EXPECT_EQ(bytes.substr(31, 8), std::string("\0\0\0\0\0\0\0\x20", 8));
    EXPECT_EQ(bytes.substr(71, 9), std::string("\0\0\0\0\0\0\0\1", 8) + "7");
    const std::size_t fields = 23 + 32 + 1 + 20 + 6 + 7 + 12 + 64 + 1 + 3;
    EXPECT_EQ(bytes.size(), 10 * 8 + fields);
    EXPECT_EQ(entry_hash(sample_entry()), encoding::sha256_bytes(bytes));
}

// By Python: hashlib over the same bytes, written by hand from the decision record.
TEST(LogEntryHash, IsTheOneThatAnotherProgramFinds) {
    EXPECT_EQ(encoding::hexadecimal(entry_hash(sample_entry())),
              "a05d5823a8105f6ef34619f27d90cf80e3c853278b49e8473339bf376907916c");
}

TEST(LogEntryHash, ChangesWithEveryField) {
    const std::string hash = entry_hash(sample_entry());
    for (std::string LogEntry::*const field :
         {&LogEntry::at, &LogEntry::actor, &LogEntry::kind, &LogEntry::certificate, &LogEntry::record,
          &LogEntry::request_key, &LogEntry::body, &LogEntry::prev}) {
        LogEntry changed = sample_entry();
        (changed.*field)[0] ^= 1;
        EXPECT_NE(entry_hash(changed), hash);
    }
    LogEntry changed = sample_entry();
    changed.seq = 8;
    EXPECT_NE(entry_hash(changed), hash);
}

TEST(LogEntryHash, ChangesWhenBytesMoveToTheNextField) {
    LogEntry moved = sample_entry();
    moved.actor = "R. Li";
    moved.kind = "ndrafted";
    EXPECT_NE(entry_hash(moved), entry_hash(sample_entry()));
}

}  // namespace
}  // namespace gumcert::archive
