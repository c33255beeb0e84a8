#pragma once

#include <string>
#include <string_view>

namespace gumcert::jobs {

/// What speaks against an SVG drawing as a picture of a document; "" where nothing does. The words of a message.
///
/// Accepted are shapes, groups, gradients, clip paths and styles, UTF-8, with a viewBox. Refused is everything by which a
/// drawing could do something, look different elsewhere, or grow: scripts and event attributes, references to anything
/// outside of the file, embedded pictures and pages, document types and entities, texts (their font is not in the file),
/// animations, filters, elements that repeat others, more than 20000 elements, and more than 32 of them within each other.
/// Elements and attributes of editors have a prefix, and are refused, too: a drawing is exported as plain SVG.
/// Only the syntax is looked at: what the numbers of a path mean is the matter of what draws it.
[[nodiscard]] std::string svg_objection(std::string_view bytes);

/// Whether the bytes begin as those of an SVG drawing: with a byte order mark, a declaration or a comment before it.
[[nodiscard]] bool looks_like_svg(std::string_view bytes);

}  // namespace gumcert::jobs
