#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// Which children an element has, in which order: places that can be walked through (the automaton of Glushkov).
struct ContentModel {
    struct Place {
        std::string element, type;
        bool list = false;      ///< a list of texts of the type
        bool required = false;  ///< nothing else may stand instead of it
        std::set<std::size_t> next;
    };
    std::vector<Place> places;
    std::set<std::size_t> first, last;
    bool may_be_empty = true;
    bool any_order = false;  ///< every place at most once, in any order

    [[nodiscard]] bool knows(std::string_view element) const;
};

/// A type of elements: with children, or with a text.
struct ElementType {
    struct Attribute {
        std::string name;
        bool required = false;
    };
    std::vector<Attribute> attributes;
    std::optional<ContentModel> children;  ///< nothing: a text
    std::vector<std::string> words;        ///< a text is one of them; empty: any
};

using ElementTypes = std::map<std::string, ElementType, std::less<>>;

/// The types of one version from a text as dcc_schema_facts().
/// \param version  310 for 3.1.0
/// \throws std::invalid_argument  for a text that is not in this notation
[[nodiscard]] ElementTypes element_types(std::string_view facts, int version);

}  // namespace gumcert::reports
