#pragma once

#include <string>
#include <string_view>

namespace gumcert::text {

/// A text as it stands between the tags of XML and HTML, and between the double quotes of an attribute.
[[nodiscard]] std::string escaped_markup(std::string_view text);

}  // namespace gumcert::text
