#pragma once

#include <optional>
#include <string_view>

#include "audit/words/column_heads.h"

namespace gumcert::audit {

/// The column that a word means by itself, in any language that is known.
[[nodiscard]] std::optional<Column> column_word(std::string_view text);
/// Whether a word names a column that budgets have beside those that an audit reads.
[[nodiscard]] bool is_unused_column_word(std::string_view text);

}  // namespace gumcert::audit
