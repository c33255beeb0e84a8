#pragma once

#include <string>
#include <vector>

namespace gumcert::certificate {

/// Whether a result is one of those that a scope entry, a specification or a list of external results names: "l",
/// "EXA"; "E*" names all that begin so.
[[nodiscard]] bool is_named(const std::vector<std::string>& names, const std::string& result);

/// Whether an entry of the scope covers a result. "EY0A" covers axis_y too: entries written when the axis in the frame
/// of the fixture had the names that ISO 230-7 gives location errors.
[[nodiscard]] bool is_covered(const std::vector<std::string>& names, const std::string& result);

}  // namespace gumcert::certificate
