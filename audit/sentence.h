#pragma once

#include <compare>
#include <cstddef>

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::audit {

/// How many places `{name}`, `{name:number}` or `{name:sentence}` a pattern has; nothing else stands in braces.
/// \throws const char*  where a brace has no other one; of a literal this does not compile
constexpr std::size_t places_in(std::string_view pattern) {
    std::size_t places = 0;
    bool inside = false;
    for (const char c : pattern) {
        if (c == (inside ? '{' : '}')) {
            throw "a brace without its other one";
        }
        places += c == '{' ? 1 : 0;
        inside = c == '{' || (inside && c != '}');
    }
    return inside ? throw "a brace that does not close" : places;
}

/// The English pattern of a sentence with a number of places. Always a literal: tests/lint/check_sentences.py finds all
/// of them in the sources, and holds them against the translations in templates/wording/audit_sentences.json.
template <std::size_t places>
class Pattern {
public:
    consteval Pattern(const char* literal) : text_(literal) {
        if (places_in(text_) != places) {
            throw "a pattern has one place for each argument";
        }
    }
    [[nodiscard]] std::string_view text() const { return text_; }

private:
    std::string_view text_;
};

/// What the audit says, so that each language can say it: an English pattern, and what stands in its places. A place
/// holds a sentence again, or a text that is the same in every language. ADR 0061.
class Sentence {
public:
    Sentence() = default;
    /// A text without a pattern: a name, a number as it is shown, a unit, what a person or another part of the program
    /// wrote.
    Sentence(std::string text) : english_(std::move(text)) {}
    Sentence(const char* text) : english_(text) {}
    /// \param pattern    a literal; say() makes it
    /// \param arguments  one a place, in their order
    Sentence(std::string_view pattern, std::vector<Sentence> arguments);

    [[nodiscard]] const std::string& english() const { return english_; }
    [[nodiscard]] bool empty() const { return english_.empty(); }
    /// "" of a text without one.
    [[nodiscard]] std::string_view pattern() const { return pattern_; }
    [[nodiscard]] const std::vector<Sentence>& arguments() const { return arguments_; }
    /// The same sentence with other texts in its places.
    /// \param change  makes the new text of one without a pattern
    [[nodiscard]] Sentence with_texts(const std::function<std::string(const std::string&)>& change) const;

    friend bool operator==(const Sentence& a, const Sentence& b) { return a.english_ == b.english_; }
    friend auto operator<=>(const Sentence& a, const Sentence& b) { return a.english_ <=> b.english_; }

private:
    std::string english_;
    std::string_view pattern_;
    std::vector<Sentence> arguments_;
};

/// A pattern between its places: literals are one more than places.
struct PatternPieces {
    struct Place {
        std::string_view name;
        bool is_number = false;  ///< "{U:number}": gets the decimal sign of a language
        bool is_sentence =
            false;  ///< "{reason:sentence}": one that another part of the program says, where it is a text
    };
    std::vector<std::string_view> literals;
    std::vector<Place> places;
};
/// \param pattern  must outlive the pieces
[[nodiscard]] PatternPieces pattern_pieces(std::string_view pattern);

/// say("U = {U:number} is below the capability {name}", in_words(U, unit), name)
template <typename... Arguments>
[[nodiscard]] Sentence say(Pattern<sizeof...(Arguments)> pattern, Arguments&&... arguments) {
    std::vector<Sentence> all;
    all.reserve(sizeof...(arguments));
    (all.emplace_back(std::forward<Arguments>(arguments)), ...);
    return {pattern.text(), std::move(all)};
}

/// One of two sentences with a count, as languages with one plural have them.
[[nodiscard]] Sentence say_count(std::size_t count, Pattern<1> one, Pattern<1> several);

/// A number that stands alone.
[[nodiscard]] Sentence say_number(std::string shown);
/// "u = 0.4 µm".
/// \param symbol  or a name in a sentence
[[nodiscard]] Sentence equals(Sentence symbol, Sentence shown);

/// "a, b and c".
[[nodiscard]] Sentence all_of(const std::vector<Sentence>& sentences);
/// "a, b, c".
[[nodiscard]] Sentence joined(const std::vector<Sentence>& sentences);
/// "a, b and 3 more"; all of them where they are not more than `most`.
[[nodiscard]] Sentence listed(const std::vector<Sentence>& sentences,
                              std::size_t most = std::numeric_limits<std::size_t>::max());
/// Texts as sentences without patterns.
[[nodiscard]] std::vector<Sentence> sentences_of(const std::vector<std::string>& texts);

}  // namespace gumcert::audit
