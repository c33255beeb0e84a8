#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "certificate/text_words.h"

namespace gumcert::audit {

/// A word of a list, and what it means.
template <typename Meaning>
struct Word {
    std::u32string_view letters;  ///< as certificate::letters_of() gives them
    Meaning meaning;
};
template <typename Meaning>  // as the compiler finds it itself, but for Clang 14
Word(std::u32string_view, Meaning)->Word<Meaning>;

template <typename Meaning>
using Dictionary = std::unordered_map<std::u32string_view, Meaning>;
template <typename Meaning, std::size_t N>
Dictionary<Meaning> dictionary_of(const std::array<Word<Meaning>, N>& words) {
    Dictionary<Meaning> meanings;
    for (const Word<Meaning>& word : words) {
        meanings.emplace(word.letters, word.meaning);  // the first one of a word
    }
    return meanings;
}

/// What a word of a list means; nothing where the list does not have it.
/// \param letters  as certificate::letters_of() gives them
template <const auto& words>
auto meaning_of_letters(const std::u32string& letters) -> std::optional<decltype(words[0].meaning)> {
    static const auto meanings = dictionary_of(words);
    const auto word = meanings.find(letters);
    return word == meanings.end() ? std::nullopt : std::optional(word->second);
}
template <const auto& words>
auto meaning_of(std::string_view text) {
    return meaning_of_letters<words>(certificate::letters_of(text));
}

}  // namespace gumcert::audit
