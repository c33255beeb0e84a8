#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "workbook/workbook.h"

namespace gumcert::workbook {

/// Bytes of texts that cells may still have; each cell counts with its own copy.
class TextAllowance {
public:
    explicit TextAllowance(std::size_t bytes) : left_(bytes) {}
    /// \throws gum::InputError  GC-WORKBOOK-0018
    void take(std::size_t bytes, const std::string& where);

private:
    std::size_t left_;
};

/// What a part says that it may not say (GC-WORKBOOK-0011).
[[nodiscard]] gum::InputError bad_content(const std::string& where, const std::string& what);
/// More of something than is read (GC-WORKBOOK-0012).
[[nodiscard]] gum::InputError too_many(const std::string& where, const std::string& what);

/// An arrow from one part to another part or file.
struct Relationship {
    std::string type;  ///< last word of its address, "worksheet"
    std::string target;
    bool is_external = false;
};

/// \return by their ids
[[nodiscard]] std::map<std::string, Relationship> read_relationships(std::string_view xml, const std::string& where);

/// A sheet as the part of the workbook names it.
struct NamedSheet {
    std::string name;
    SheetState state = SheetState::visible;
    std::string relationship;
};

struct WorkbookPart {
    std::vector<NamedSheet> sheets;
    std::vector<DefinedName> defined_names;
    std::vector<std::string> external_links;  ///< ids of relationships, in the order of the numbers in formulas
    bool structure_is_protected = false, dates_from_1904 = false, precision_as_displayed = false, iterates = false;
};

[[nodiscard]] WorkbookPart read_workbook_part(std::string_view xml, const std::string& where, TextAllowance& texts);

[[nodiscard]] std::vector<std::string> read_shared_strings(std::string_view xml, const std::string& where);

/// Formats of numbers, and which of them each style of cells uses.
struct NumberFormats {
    std::vector<std::string> texts{"General"};
    std::vector<std::uint32_t> of_style;  ///< places in texts
};

[[nodiscard]] NumberFormats read_number_formats(std::string_view xml, const std::string& where, TextAllowance& texts);

/// Fills what a part of the document's properties says.
void read_properties(std::string_view xml, const std::string& where, WorkbookMetadata& metadata);

/// What an external link points to: its kind, and the id of the relationship that has the target.
struct LinkPart {
    std::string kind, relationship, target;
};

[[nodiscard]] LinkPart read_link_part(std::string_view xml, const std::string& where);

}  // namespace gumcert::workbook
