#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// A record, and the JSON value that its text is, read once: for who compares records place by place.
struct ReadRecord {
    EvaluationRecord record;
    nlohmann::json value;  ///< without the digest
};

/// \throws gum::InputError  as record_from_json()
[[nodiscard]] ReadRecord read_record(const std::string& text, const std::string& where);

/// The JSON value of the text that to_canonical_json() writes, without the digest.
/// \throws gum::NoResultError  as to_canonical_json()
[[nodiscard]] nlohmann::json to_json_value(const EvaluationRecord& record);

}  // namespace gumcert::reports
