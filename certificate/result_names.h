#pragma once

#include <string>
#include <vector>

namespace gumcert::certificate {

/// Whether a result is one of those that a scope entry, a specification or a list of external results names: "l",
/// "EXA"; "E*" names all that begin so.
[[nodiscard]] bool is_named(const std::vector<std::string>& names, const std::string& result);

}  // namespace gumcert::certificate
