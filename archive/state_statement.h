#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "archive/head.h"

namespace gumcert::archive {

/// What a laboratory says of certificates in an evidence: all of their entries, and the state that these lead to. Proofs of
/// entries show that they are there, never that no other one is; for that somebody who has the whole log must stand, and
/// signs. (docs/adr/0062-the-statement-of-states.md)
struct StateStatement {
    struct Certificate {
        std::string number;
        std::string state;
        std::string later;                  ///< number of the certificate that amends or replaces it; "" else
        std::vector<std::int64_t> entries;  ///< sequence numbers of all that the log has of it, ascending
        friend bool operator==(const Certificate&, const Certificate&) = default;
    };
    std::string at;                         ///< when it was made, by the clock of the laboratory
    std::vector<Certificate> certificates;  ///< by number, each once
    Head::Signature signature = {};         ///< over signed_bytes()
};

/// What its signature is over: tag, head and certificate of the evidence, then the statement, each field with its length in
/// front, as the fields of an entry have it.
/// \param certificate  for which the evidence was made
[[nodiscard]] std::string signed_bytes(const StateStatement& statement, const Head& head,
                                       const std::string& certificate);

}  // namespace gumcert::archive
