#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "audit/stated_number.h"
#include "audit/words/named_statement.h"

namespace gumcert::audit {

/// A number that a statement gives.
struct StatedResult {
    StatedNumber number;
    std::string unit;          ///< "" where none stands beside it
    std::uint32_t column = 0;  ///< where the number stands
    bool is_relative = false;  ///< its name calls it so: a part of the value
};

/// Statements on a result, from the lines above and below its table.
struct Statements {
    std::map<Statement, StatedResult> numbers;
    std::map<Statement, StatedResult>
        parts;  ///< of the value, beside numbers in its unit: "U | 0.4 | mV" and "U | 0.004 | %"
    std::map<Statement, std::string> words;
    std::string unit_of_parts;  ///< "%": that of all rows, which are parts of the value; "" where they are not
    std::string coverage;       ///< what stands beside U of it: "k = 2, 95 %"
    std::string coverage_place;
    std::string other_k;  ///< of "U = k·u_c = 2.65·2": what may be k as well as the number that `coverage` begins with
};

/// Whether a statement is a number with the dimension of the result.
[[nodiscard]] bool is_of_result(Statement statement);
/// Whether a statement is made in words: "100 mm gauge block" is a name, and no number.
[[nodiscard]] bool is_in_words(Statement statement);
/// Whether a statement is one of value, uncertainty and coverage, which a line of the table may state under its heads.
[[nodiscard]] bool is_of_coverage(Statement statement);
/// Whether an uncertainty is stated: of these a unit may be a part of the value.
[[nodiscard]] bool may_be_part(Statement statement);

}  // namespace gumcert::audit
