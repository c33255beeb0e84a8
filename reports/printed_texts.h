#pragma once

#include "reports/document_text.h"

#include <optional>
#include <string>
#include <vector>

namespace gumcert::reports {

/// The one text that all have; nothing where they differ or there are none.
[[nodiscard]] std::optional<std::string> common(const std::vector<std::string>& texts);

/// True where one of them is not empty.
[[nodiscard]] bool any_of(const std::vector<std::string>& texts);

/// "a, b, c"
[[nodiscard]] std::string joined(const std::vector<std::string>& texts);

/// Number and unit with a blank that does not break; the number alone where there is no unit.
[[nodiscard]] Text with_unit(const Text& number, const std::string& unit);

/// A probability as it was stated: "95.45 %"
[[nodiscard]] std::string percent_text(double probability);

}  // namespace gumcert::reports
