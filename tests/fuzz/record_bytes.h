#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::fuzz {

/// A record from a text, with the digest that fits it; nothing where the text is none.
inline std::optional<reports::EvaluationRecord> record_from_bytes(std::string_view text) {
    const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
    if (!document.is_object()) {
        return std::nullopt;
    }
    try {
        return reports::record_from_json(reports::with_digest(document), "fuzz");
    } catch (const gum::InputError&) {
        return std::nullopt;
    }
}

}  // namespace gumcert::fuzz
