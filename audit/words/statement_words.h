#pragma once

#include <optional>
#include <string_view>

#include "audit/words/named_statement.h"

namespace gumcert::audit {

/// What a name by itself states, in any language that is known.
[[nodiscard]] std::optional<Statement> statement_word(std::string_view text);
/// Whether a name is one of the value of a result that is a deviation. An input quantity may be called so as well.
[[nodiscard]] bool is_deviation_word(std::string_view text);
/// Whether a name is one of the value of a result that no input quantity has: a reading may be called "measured value".
[[nodiscard]] bool is_result_word(std::string_view text);

}  // namespace gumcert::audit
