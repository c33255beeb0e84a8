#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::audit {

/// The words of a text in small letters without accents, to look for beginnings of words of two languages.
class WordLine {
public:
    /// \param text  UTF-8; read up to 400 bytes
    explicit WordLine(std::string_view text);

    /// Whether a word begins so: "resolut". A space at its end asks for a whole word, two words for a phrase
    /// ("dead path"), a star in front for a part of a word ("*ausdehnung").
    [[nodiscard]] bool has(std::string_view beginning) const;
    [[nodiscard]] bool has_any(std::initializer_list<std::string_view> beginnings) const;
    [[nodiscard]] bool has_any(std::span<const std::string_view> beginnings) const;
    /// Whether a whole word occurs that none of the given words follows.
    [[nodiscard]] bool has_word(std::string_view word, std::initializer_list<std::string_view> not_before) const;
    /// The whole number in front of a word that begins so: "2 calibrations". The smallest one where there are several.
    [[nodiscard]] std::optional<std::size_t> count_of(std::initializer_list<std::string_view> beginnings) const;

private:
    std::string line_ = " ";           ///< a space before and after each word
    std::vector<std::size_t> starts_;  ///< of the words in it
};

/// The longest beginning of a text of a number of bytes that does not cut a character.
[[nodiscard]] std::string_view cut(std::string_view text, std::size_t bytes);
inline constexpr std::size_t k_longest_text = 400;

}  // namespace gumcert::audit
