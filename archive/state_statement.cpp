#include "archive/state_statement.h"

#include <cstddef>
#include <string_view>

namespace gumcert::archive {

namespace {

void append_stated(std::string& bytes, std::string_view field) {
    constexpr unsigned k_length_bytes = 8;
    const std::uint64_t length = field.size();
    for (unsigned i = k_length_bytes; i-- > 0;) {
        bytes += static_cast<char>(length >> (8U * i) & 0xFFU);
    }
    bytes += field;
}

}  // namespace

std::string signed_bytes(const StateStatement& statement, const Head& head, const std::string& certificate) {
    std::string bytes;
    // The tag separates it from everything else that the same key signs: a head is signed as JSON, which begins with "{".
    append_stated(bytes, "gumcert/archive/states/1");
    append_stated(bytes, head.archive);
    append_stated(bytes, std::to_string(head.size));
    append_stated(bytes, head.root);
    append_stated(bytes, head.chain);
    append_stated(bytes, head.at);
    append_stated(bytes, certificate);
    append_stated(bytes, statement.at);
    for (const StateStatement::Certificate& one : statement.certificates) {
        std::string entries;
        for (const std::int64_t seq : one.entries) {
            entries += (entries.empty() ? "" : " ") + std::to_string(seq);
        }
        append_stated(bytes, one.number);
        append_stated(bytes, one.state);
        append_stated(bytes, one.later);
        append_stated(bytes, entries);
    }
    return bytes;
}

}  // namespace gumcert::archive
