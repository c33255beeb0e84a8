#pragma once

#include "reports/record/evaluation_record.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace gumcert::reports {

/// How a name in a document is drawn as a mathematical symbol: what stands upright and small below the first letters.
struct Symbol {
    std::string base;   ///< "l", "α": drawn in italics
    std::string index;  ///< "s", "eff", "α,1"; "" without
};

/// "alpha_s" is α with the index s, "T_L" is T with the index L, "theta" is ϑ as a letter: θ. A name whose first part is a
/// word ("offset_2") is no symbol: both parts are "".
[[nodiscard]] Symbol symbol_of(const std::string& name);

/// The names in the documents of a record that are symbols: those of its quantities, and those of the program. Templates
/// draw them as such, wherever they stand.
///
/// {symbols[] {text, base, index}, letters[] {text}}: names that are found in running text, and single letters, which are
/// symbols only where they stand alone in a cell.
[[nodiscard]] nlohmann::json symbols_in(const EvaluationRecord& record);

}  // namespace gumcert::reports
