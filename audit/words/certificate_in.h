#pragma once

#include <string>
#include <string_view>

namespace gumcert::audit {

/// The certificate that a text names by its number: "certificate 91-E" of "U = 1.5 µV, k = 2; certificate 91-E; 39 µV/K"; ""
/// where it names none.
[[nodiscard]] std::string certificate_in(std::string_view text);

}  // namespace gumcert::audit
