#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "archive/evidence.h"
#include "archive/head.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::archive::fuzz {

/// A text that is read as evidence, and as a head: whatever is accepted is verified without trouble, written, and read
/// again unchanged.
/// \return whether it was accepted as one of them
inline bool evidence_or_head(std::string_view text) {
    bool accepted = false;
    try {
        const Head head = head_from_json(text, "fuzz");
        accepted = true;
        if (head_from_json(to_json(head), "written") != head) {
            throw std::logic_error("another head comes back");
        }
    } catch (const gum::InputError&) {
        // No head: it may be evidence.
    }
    try {
        const Evidence evidence = evidence_from_json(text, "fuzz");
        accepted = true;
        (void)verify_evidence(evidence, {evidence.head});
        const std::string written = to_json(evidence);
        if (to_json(evidence_from_json(written, "written")) != written) {
            throw std::logic_error("other evidence comes back");
        }
    } catch (const gum::InputError&) {
        return accepted;
    }
    return true;
}

}  // namespace gumcert::archive::fuzz
