#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "certificate/localised_text.h"

namespace gumcert::certificate {

/// Whether a text states something: it has a letter or a digit, and is not one of the texts by which forms say that
/// there is nothing to state ("n/a", "tbd"). A dash or a blank in a field is an empty field.
[[nodiscard]] bool is_stated(const std::string& text);
/// In every language in which it was given.
[[nodiscard]] bool is_stated(const LocalisedText& text);
/// At least one of a list.
template <class Text>
[[nodiscard]] bool any_stated(const std::vector<Text>& texts) {
    return std::any_of(texts.begin(), texts.end(), [](const Text& text) { return is_stated(text); });
}

}  // namespace gumcert::certificate
