#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gumcert::archive {

/// One entry of the log of an archive. Every field but the last is hashed.
struct LogEntry {
    std::int64_t seq = 0;     ///< 1, 2, 3 … without gaps
    std::string at;           ///< UTC, "2026-11-24T18:52:52Z"; never before that of the entry before
    std::string actor;        ///< who
    std::string kind;         ///< what: "drafted", "issued" … (archive/log_rules.h)
    std::string certificate;  ///< number of the certificate; "" where the entry concerns the archive
    std::string record;       ///< SHA-256 of the record that the entry is about, hexadecimal; "" without one
    std::string request_key;  ///< idempotency key of whoever asked; "" without one
    std::string body;         ///< canonical JSON: old, new, why
    std::string prev;         ///< hash of the entry before, 32 bytes; of the first one 32 zero bytes
    std::string hash;         ///< 32 bytes

    friend bool operator==(const LogEntry&, const LogEntry&) = default;
};

/// Appends a field of what is hashed or signed, with its length in front (8 bytes, the highest first): moving bytes from one
/// field to the next changes them.
void append_field(std::string& bytes, std::string_view field);

/// The bytes that are hashed: the tag "gumcert/archive/entry/1", then prev, seq as decimal digits, at, actor, kind,
/// certificate, record, request_key and body, each by append_field(). (docs/adr/0053-the-archive.md)
[[nodiscard]] std::string canonical_bytes(const LogEntry& entry);

/// SHA-256 of canonical_bytes(), 32 bytes.
[[nodiscard]] std::string entry_hash(const LogEntry& entry);

}  // namespace gumcert::archive
