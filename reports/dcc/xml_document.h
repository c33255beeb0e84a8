#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

/// An element of an XML document that was read. Names carry fixed prefixes whatever prefix the document uses: "dcc:",
/// "si:", "ds:"; an element of another namespace is "{namespace}name", one without a namespace has no prefix.
struct XmlElement {
    std::string name;
    std::vector<std::pair<std::string, std::string>> attributes;  ///< without namespace declarations
    std::string text;  ///< character data directly inside, in one piece, untouched
    std::vector<XmlElement> children;
    std::size_t line = 0, column = 0;  ///< behind the start tag, from 1

    /// The first child of a name; nullptr without one.
    [[nodiscard]] const XmlElement* child(std::string_view child_name) const;
    [[nodiscard]] std::vector<const XmlElement*> children_named(std::string_view child_name) const;
    /// Text of the first child of a name without blanks at its ends; "" without one.
    [[nodiscard]] std::string child_text(std::string_view child_name) const;
    /// "" without one.
    [[nodiscard]] std::string attribute(std::string_view attribute_name) const;
    [[nodiscard]] std::string trimmed() const;
};

/// A comment or a processing instruction. Programs that show a document may follow it (`<?xml-stylesheet …?>`), and no
/// element tells of it.
struct XmlNote {
    std::string what;  ///< "a comment", or "a processing instruction xml-stylesheet"
    std::size_t line = 0;
};

/// Reads an XML document that may come from anywhere. Nothing outside of the bytes is ever read: a DOCTYPE is refused,
/// so that there are no entities but the five of XML, and no network or file is asked for anything.
/// Limits: 64 MiB, depth 64, one million elements, 10 MB of text in one piece.
/// \param file   for messages
/// \param notes  where they are wanted: all of them, also before and behind the root
/// \throws gum::InputError  GC-DCC-0001 not well-formed (with line and column), -0002 a DOCTYPE, -0003 too deep, -0004
///                          too large
[[nodiscard]] XmlElement read_xml(std::string_view bytes, const std::string& file,
                                  std::vector<XmlNote>* notes = nullptr);

/// "file:line:column"
[[nodiscard]] std::string place_of(const XmlElement& element, const std::string& file);

/// Words of an XML list: what stands between blanks.
[[nodiscard]] std::vector<std::string> xml_list(std::string_view text);

/// Without blanks at both ends (blank, tab, line feed, carriage return).
[[nodiscard]] std::string without_outer_blanks(std::string_view text);

/// Writes an XML document, indented by two blanks once and for all: a signature fixes every byte.
class XmlWriter {
public:
    using Attributes = std::vector<std::pair<std::string, std::string>>;

    XmlWriter();
    /// Elements that are opened must be closed in turn; `element` does both. Attributes with an empty value are left
    /// out.
    void open(const std::string& name, const Attributes& attributes = {});
    void close();
    void element(const std::string& name, const std::string& text, const Attributes& attributes = {});
    /// The document; every element must be closed.
    [[nodiscard]] std::string take();

private:
    void start_tag(const std::string& name, const Attributes& attributes);

    std::string out_;
    std::vector<std::string> open_;
};

}  // namespace gumcert::reports
