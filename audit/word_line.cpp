#include "audit/word_line.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "certificate/text_words.h"
#include "text/utf8.h"

namespace gumcert::audit {

WordLine::WordLine(std::string_view text) {
    for (const std::u32string& word : certificate::words_of(cut(text, k_longest_text))) {
        starts_.push_back(line_.size());
        for (const char32_t letter : word) {
            if (letter < 0x80) {
                line_ += static_cast<char>(letter);
            } else {
                line_ += text::encode_utf8(letter);
            }
        }
        line_ += ' ';
    }
}

bool WordLine::has(std::string_view beginning) const {
    if (beginning.starts_with('*')) {
        return line_.find(beginning.substr(1)) != std::string::npos;
    }
    // Hundreds of beginnings are asked for of a line of few words: at those it is looked, and nowhere else.
    const std::string_view line = line_;
    return std::ranges::any_of(starts_, [&](std::size_t start) { return line.substr(start).starts_with(beginning); });
}

bool WordLine::has_any(std::initializer_list<std::string_view> beginnings) const {
    return has_any(std::span(beginnings.begin(), beginnings.size()));
}

bool WordLine::has_any(std::span<const std::string_view> beginnings) const {
    return std::any_of(beginnings.begin(), beginnings.end(), [this](std::string_view b) { return has(b); });
}

bool WordLine::has_word(std::string_view word, std::initializer_list<std::string_view> not_before) const {
    const std::string whole = ' ' + std::string(word) + ' ';
    for (std::size_t at = line_.find(whole); at != std::string::npos; at = line_.find(whole, at + 1)) {
        const std::string_view behind = std::string_view(line_).substr(at + whole.size());
        if (std::none_of(not_before.begin(), not_before.end(),
                         [&behind](std::string_view other) { return behind.starts_with(other); })) {
            return true;
        }
    }
    return false;
}

std::optional<std::size_t> WordLine::count_of(std::initializer_list<std::string_view> beginnings) const {
    std::optional<std::size_t> least;
    for (const std::string_view beginning : beginnings) {
        const std::string wanted = ' ' + std::string(beginning);
        for (std::size_t at = line_.find(wanted); at != std::string::npos && at > 0; at = line_.find(wanted, at + 1)) {
            const std::size_t start = line_.rfind(' ', at - 1) + 1;
            std::size_t count = 0;
            const auto [end, error] = std::from_chars(line_.data() + start, line_.data() + at, count);
            if (error == std::errc{} && end == line_.data() + at && (!least || count < *least)) {
                least = count;
            }
        }
    }
    return least;
}

std::string_view cut(std::string_view text, std::size_t bytes) {
    if (text.size() <= bytes) {
        return text;
    }
    while (bytes > 0 && text::is_continuation(text[bytes])) {
        --bytes;
    }
    return text.substr(0, bytes);
}

}  // namespace gumcert::audit
