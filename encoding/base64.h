#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gumcert::encoding {

/// Bytes as text, with padding and without line breaks (RFC 4648, clause 4).
[[nodiscard]] std::string base64(std::string_view bytes);

/// \return none if the text is not Base64; blanks and line breaks are passed over
[[nodiscard]] std::optional<std::string> bytes_from_base64(std::string_view text);

}  // namespace gumcert::encoding
