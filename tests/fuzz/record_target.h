#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports::fuzz {

/// A record that was accepted is written and read again unchanged.
/// \return whether it was accepted
inline bool record(std::string_view text) {
    try {
        const EvaluationRecord record = record_from_json(std::string(text), "fuzz");
        const std::string written = to_canonical_json(record);
        if (to_canonical_json(record_from_json(written, "written")) != written) {
            throw std::logic_error("another record comes back");
        }
    } catch (const gum::InputError&) {
        return false;
    }
    return true;
}

}  // namespace gumcert::reports::fuzz
