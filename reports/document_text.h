#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

/// A text of a document in each of the languages that it is printed in, the binding one first. A text without language
/// (a name, a formula, a sentence that the record holds in English) is the same in all.
class Text {
public:
    Text() = default;
    Text(std::string text) : texts_{std::move(text)} {}  // NOLINT: a text is a text
    Text(const char* text) : texts_{text} {}             // NOLINT
    /// \param texts  one a language, the binding one first; none is the empty text
    explicit Text(std::vector<std::string> texts) : texts_(std::move(texts)) {
        if (texts_.empty()) {
            texts_.emplace_back();
        }
    }

    /// In the language with this position; a text without language is the same for every position.
    [[nodiscard]] const std::string& in(std::size_t language) const;
    [[nodiscard]] const std::string& first() const { return in(0); }
    [[nodiscard]] bool empty() const;
    /// True where the languages differ, so that a bilingual document shows both.
    [[nodiscard]] bool differs() const;
    [[nodiscard]] std::size_t languages() const { return texts_.size(); }

    Text& operator+=(const Text& other);
    friend Text operator+(Text a, const Text& b) { return a += b; }
    friend bool operator==(const Text&, const Text&) = default;

private:
    std::vector<std::string> texts_ = {""};  ///< one: without language
};

}  // namespace gumcert::reports
