#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::workbook {

/// Attributes of a start tag, names without the prefix of their namespace.
class XmlAttributes {
public:
    void clear() { items_.clear(); }
    void add(std::string_view name, std::string value) { items_.emplace_back(name, std::move(value)); }
    /// "" where there is none.
    [[nodiscard]] const std::string& value(std::string_view name) const;
    /// Whether an attribute says "1" or "true".
    [[nodiscard]] bool is_true(std::string_view name) const;

private:
    std::vector<std::pair<std::string_view, std::string>> items_;
};

/// What is told of a document while it is read. Names are without the prefix of their namespace.
class XmlHandler {
public:
    XmlHandler() = default;
    XmlHandler(const XmlHandler&) = delete;
    XmlHandler& operator=(const XmlHandler&) = delete;
    virtual ~XmlHandler() = default;

    virtual void start(std::string_view name, const XmlAttributes& attributes) = 0;
    virtual void end(std::string_view name) = 0;
    virtual void text(std::string_view characters) = 0;

    /// Names of the open elements from the root, the one that starts or ends with them.
    std::vector<std::string_view> path;

protected:
    /// Whether the innermost element lies in an element of a name.
    [[nodiscard]] bool is_in(std::string_view parent) const {
        return path.size() >= 2 && path[path.size() - 2] == parent;
    }
};

/// Reads a part of a workbook, which may come from anywhere, and tells the handler. Nothing outside of the bytes is ever
/// read: a DOCTYPE is refused, so that there are no entities but the five of XML. Time is linear in the bytes.
/// \param where  file and part, for messages
/// \throws gum::InputError  GC-WORKBOOK-0007 not well-formed UTF-8, -0008 a DOCTYPE, -0009 elements deeper than 64 or more
///                          than 64 attributes; and whatever the handler throws
void read_xml_events(std::string_view bytes, const std::string& where, XmlHandler& handler);

}  // namespace gumcert::workbook
