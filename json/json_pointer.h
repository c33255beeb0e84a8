#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gumcert::json {

// Places in a JSON document as RFC 6901 writes them: "/fixture/coordinates/1"; "" is the whole document.

/// A key as a token of a pointer (RFC 6901, section 3): "~" as "~0", "/" as "~1".
[[nodiscard]] std::string pointer_token(std::string_view key);

/// The pointer of a member or an element.
[[nodiscard]] std::string child_pointer(const std::string& pointer, std::string_view key);
[[nodiscard]] std::string child_pointer(const std::string& pointer, std::size_t index);

/// The pointer of the object or array around a value; "" for the document itself.
[[nodiscard]] std::string_view parent_pointer(std::string_view pointer);

}  // namespace gumcert::json
