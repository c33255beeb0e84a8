#include "archive/store/entry.h"

#include "encoding/sha2.h"

namespace gumcert::archive {

void append_field(std::string& bytes, std::string_view field) {
    constexpr unsigned k_length_bytes = 8;
    const std::uint64_t length = field.size();
    for (unsigned i = k_length_bytes; i-- > 0;) {
        bytes += static_cast<char>(length >> (8U * i) & 0xFFU);
    }
    bytes += field;
}

std::string canonical_bytes(const LogEntry& entry) {
    std::string bytes;
    append_field(bytes, "gumcert/archive/entry/1");
    append_field(bytes, entry.prev);
    append_field(bytes, std::to_string(entry.seq));
    append_field(bytes, entry.at);
    append_field(bytes, entry.actor);
    append_field(bytes, entry.kind);
    append_field(bytes, entry.certificate);
    append_field(bytes, entry.record);
    append_field(bytes, entry.request_key);
    append_field(bytes, entry.body);
    return bytes;
}

std::string entry_hash(const LogEntry& entry) {
    return encoding::sha256_bytes(canonical_bytes(entry));
}

}  // namespace gumcert::archive
