#pragma once

#include <cstddef>
#include <string_view>

namespace gumcert::text {

/// What a text in XML asks of a parser, counted in one pass before there is one. A parser that compares each attribute
/// of a tag with all before it needs the square of their number.
struct MarkupSize {
    std::size_t tags = 0;         ///< start, end and empty tags
    std::size_t attributes = 0;   ///< of all tags, declarations of namespaces among them
    std::size_t most_in_tag = 0;  ///< attributes of the tag that has most
};

/// Comments, CDATA and processing instructions are passed over. Of a text that is not well-formed the count ends where it
/// cannot go on.
/// \param bytes  in an encoding that has ASCII in single bytes
[[nodiscard]] MarkupSize markup_size(std::string_view bytes);

}  // namespace gumcert::text
