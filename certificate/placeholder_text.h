#pragma once

#include <string_view>

namespace gumcert::certificate {

/// Whether a text stands in the place of a statement and states nothing: it has no letter and no digit ("-"), is one
/// letter again and again ("xxx"), a key of the keyboard after the other ("asdf"), or has words for nothing ("unknown",
/// "see above", "k. A.", "desconocido", "不明", "test") and no others than particles and names of fields ("unknown
/// customer"). Case, accents, spaces and punctuation make no difference; English, German, Spanish and Chinese. A text
/// with any other word states something.
[[nodiscard]] bool is_placeholder(std::string_view text);

/// The same for what names or identifies: "customer", "the device" and "serial number" are the names of fields, too.
[[nodiscard]] bool names_only_a_field(std::string_view text);

}  // namespace gumcert::certificate
