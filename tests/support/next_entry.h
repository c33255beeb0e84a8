#pragma once

#include <string>

#include "archive/store/entry.h"

namespace gumcert::archive::test {

/// An entry that follows another one; the first one of a log where there is none.
inline LogEntry next_entry(const LogEntry* before = nullptr, const std::string& key = "") {
    LogEntry entry{.seq = before == nullptr ? 1 : before->seq + 1,
                   .at = "2026-11-24T18:52:52Z",
                   .actor = "Zoë O'Lin \"Ω\" \\",
                   .kind = before == nullptr ? "created" : "numbered",
                   .certificate = before == nullptr ? "" : "EX-" + std::to_string(before->seq),
                   .record = {},
                   .request_key = key,
                   .body = "{}\n",
                   .prev = before == nullptr ? std::string(32, '\0') : before->hash,
                   .hash = {}};
    entry.hash = entry_hash(entry);
    return entry;
}

}  // namespace gumcert::archive::test
