#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

/// A name without what spelling adds to it: letters and digits alone, small, without accents; zeros before a number
/// count for nothing. Names that are equal in this form may be one name. Latin, Greek and Cyrillic letters are folded,
/// composed or not, and letters that look like a Latin one are that letter; all others stay as they are.
[[nodiscard]] std::string without_spelling(std::string_view name);

/// A question for every group of names that differ in nothing but capitals, blanks, hyphens and the like: sources that
/// several results share are found by their names, and taken for independent where these differ.
/// \param different  names that are known to be different sources
/// \return GC-COMPARE-0129, warnings, in the order of the names
[[nodiscard]] std::vector<gum::Diagnostic> similar_source_names(const std::set<std::string>& names,
                                                                const std::vector<std::string>& different);

}  // namespace gumcert::gum
