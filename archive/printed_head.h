#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "archive/head.h"

namespace gumcert::archive {

/// What a document says of a head of the archive: whoever holds the document holds a piece of the anchor of the log.
/// (docs/adr/0059-the-head-on-the-certificate.md)
struct PrintedHead {
    std::int64_t size = 0;  ///< entries
    std::string root;       ///< of the Merkle tree, 32 bytes

    friend bool operator==(const PrintedHead&, const PrintedHead&) = default;
};

/// As the QR code says it, and as it stands among the bytes of every document that prints it:
/// "gumcert-head:1234:5dc9da79…", size and root in hexadecimal.
[[nodiscard]] std::string mark_of(const Head& head);

/// For people: the first 64 bits of the root in groups, "5dc9 da79 4604 328a".
[[nodiscard]] std::string short_form(const Head& head);

/// All heads that a document prints, each once, in their order.
[[nodiscard]] std::vector<PrintedHead> printed_heads_in(std::string_view document);

/// What is wrong with a head that a document prints, in words; "" where nothing is.
/// \param is_of_log  whether the log had this root with so many entries
/// \param drafted    the entry that drafted the record of the document first
/// \param archived   the entry that named the document first
[[nodiscard]] std::string fault_of(const PrintedHead& head, bool is_of_log, std::int64_t drafted,
                                   std::int64_t archived);

}  // namespace gumcert::archive
