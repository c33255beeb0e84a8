#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reports/dcc/xml_document.h"

namespace gumcert::reports {

// What readers and rules of digital certificates share.

/// The root element of a DCC of version 3.0 to 3.3.
/// \throws gum::InputError  as read_xml(); GC-DCC-0005 another root element, -0006 another version
[[nodiscard]] XmlElement read_dcc_root(std::string_view bytes, const std::string& file);

/// The first text of an element of type textType (a child `dcc:content`); "" without one.
[[nodiscard]] std::string first_content(const XmlElement* text);

/// The text of an element of type textType in a language, else the first.
[[nodiscard]] std::string content_in(const XmlElement* text, std::string_view language);

/// Calls `visit` with an element and everything in it, from the outside to the inside, in the order of the document.
template <typename Visit>
void for_each_element(const XmlElement& element, const Visit& visit) {
    visit(element);
    for (const XmlElement& child : element.children) {
        for_each_element(child, visit);
    }
}

}  // namespace gumcert::reports
