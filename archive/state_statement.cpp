#include "archive/state_statement.h"

#include "archive/store/entry.h"

namespace gumcert::archive {

std::string signed_bytes(const StateStatement& statement, const Head& head, const std::string& certificate) {
    std::string bytes;
    // The tag separates it from everything else that the same key signs: a head is signed as JSON, which begins with "{".
    append_field(bytes, "gumcert/archive/states/1");
    append_field(bytes, head.archive);
    append_field(bytes, std::to_string(head.size));
    append_field(bytes, head.root);
    append_field(bytes, head.chain);
    append_field(bytes, head.at);
    append_field(bytes, certificate);
    append_field(bytes, statement.at);
    for (const StateStatement::Certificate& one : statement.certificates) {
        std::string entries;
        for (const std::int64_t seq : one.entries) {
            entries += (entries.empty() ? "" : " ") + std::to_string(seq);
        }
        append_field(bytes, one.number);
        append_field(bytes, one.state);
        append_field(bytes, one.later);
        append_field(bytes, entries);
    }
    return bytes;
}

}  // namespace gumcert::archive
