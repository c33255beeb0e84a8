#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "json/canonical_json.h"
#include "json/strict_parser.h"
#include "tests/fuzz/demand.h"

namespace gumcert::json::fuzz {

using gumcert::fuzz::demand;

/// What is accepted as JSON is JSON for nlohmann-json as well, with the same value, and is written and read again
/// unchanged.
/// \return whether it was accepted
inline bool json_text(std::string_view text, const ParserOptions& options) {
    std::size_t faults = 0;
    Places places;
    const std::optional<nlohmann::json> value = parse(
        text, options,
        [&](const ParsingProblem& problem) {
            ++faults;
            demand(problem.offset <= text.size(), "a fault behind the text");
            for (const char c : problem.what + problem.rule + problem.action) {
                demand(static_cast<unsigned char>(c) >= 0x20U && c != '\x7F', "a control character in a message");
            }
        },
        &places);
    demand(value.has_value() || faults > 0, "refused without a reason");
    if (!value || faults > 0) {
        return false;
    }
    const nlohmann::json second = nlohmann::json::parse(text, nullptr, false, options.comments);
    demand(!second.is_discarded() && second == *value, "nlohmann-json reads it differently");
    for (const auto& [pointer, place] : places) {
        demand(value->contains(nlohmann::json::json_pointer(pointer)), "a place of nothing");
    }
    const std::string canonical = canonical_json(*value);
    const std::optional<nlohmann::json> again = parse_faultless(canonical, options);
    demand(again && canonical_json(*again) == canonical, "another text comes back");
    return true;
}

/// As JSON alone, as a job and as a record.
inline bool json_text(std::string_view text) {
    const bool plain = json_text(text, {});
    const bool job = json_text(text, {.comments = true});
    const bool record = json_text(text, {.byte_order_mark = true, .long_integers = true});
    demand((!plain || job) && (!plain || record), "a liberty refuses what is JSON");
    return job || record;
}

}  // namespace gumcert::json::fuzz
