#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::certificate {

/// Languages of certificates (BCP 47), in the order in which texts are kept.
inline constexpr std::array<std::string_view, 4> k_languages{"en", "de", "zh-Hant", "es"};

/// A text that a person gave: once for all languages, or once in each (BCP 47 code: "en", "de", "zh-Hant", "es").
struct LocalisedText {
    std::string plain;  ///< for all languages; "" where `by_language` is used
    /// Each language once, in the order of k_languages; empty where `plain` is used
    std::vector<std::pair<std::string, std::string>> by_language;

    LocalisedText() = default;
    LocalisedText(std::string text) : plain(std::move(text)) {}  // NOLINT: a text is a text
    LocalisedText(const char* text) : plain(text) {}             // NOLINT

    [[nodiscard]] bool empty() const { return plain.empty() && by_language.empty(); }
    /// The text in a language; where it was not given in it, the plain text, else the first one.
    [[nodiscard]] const std::string& in(const std::string& language) const {
        for (const auto& [code, text] : by_language) {
            if (code == language) {
                return text;
            }
        }
        return by_language.empty() || !plain.empty() ? plain : by_language.front().second;
    }
    friend bool operator==(const LocalisedText&, const LocalisedText&) = default;
};

}  // namespace gumcert::certificate
