#include "reports/forms/pdf_drawn_codes.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace gumcert::reports {

namespace {

bool is_white(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\0';
}

/// Characters that end a name, a number or an operator (ISO 32000-1:2008, 7.2.2).
bool is_delimiter(char c) {
    // One by one: asked of each character of each page, and a search by the library takes many times as long.
    return c == '(' || c == ')' || c == '<' || c == '>' || c == '[' || c == ']' || c == '{' || c == '}' || c == '/' ||
           c == '%';
}

/// The value of a hexadecimal digit; -1 of any other character.
int hexadecimal_value(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char small = static_cast<char>(c | 0x20);
    return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
}

/// Reads the content once, from left to right. Made for many pages: no object is kept but the strings and the last name
/// since the last operator.
class ContentReader {
public:
    explicit ContentReader(std::string_view content) : rest_(content) {}

    std::vector<DrawnCodes> read() {
        while (!rest_.empty()) {
            const char c = rest_.front();
            if (is_white(c)) {
                rest_.remove_prefix(1);
            } else if (c == '%') {
                rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
            } else if (c == '(' || (c == '<' && !rest_.starts_with("<<"))) {
                const std::size_t before = strings_.size();
                if (c == '(') {
                    read_literal_string();
                } else {
                    read_hexadecimal_string();
                }
                if (std::exchange(is_beside_, false)) {
                    beside_.push_back({replaces_, strings_.substr(before)});
                }
            } else if (c == '/') {
                rest_.remove_prefix(1);
                name_ = take_regular();
                const std::string key = without_escapes(name_);
                replaces_ = key == "ActualText";
                is_beside_ = replaces_ || key == "Alt" || key == "E";
            } else if (rest_.starts_with("<<")) {
                rest_.remove_prefix(2);  // a dictionary, whose first value may be a string
            } else if (is_delimiter(c)) {
                rest_.remove_prefix(1);  // of an array or a dictionary
            } else {
                read_number_or_operator();
            }
        }
        while (!marked_.empty()) {
            end_marked_content();  // it has no EMC
        }
        return std::move(drawn_);
    }
    [[nodiscard]] std::vector<TextBesideDrawn> take_texts_beside() { return std::move(beside_); }

private:
    /// "ActualText" of "Actual#54ext".
    static std::string without_escapes(std::string_view name) {
        std::string plain;
        for (std::size_t i = 0; i < name.size(); ++i) {
            const int high = name[i] == '#' && i + 2 < name.size() ? hexadecimal_value(name[i + 1]) : -1;
            const int low = high >= 0 ? hexadecimal_value(name[i + 2]) : -1;
            plain += low >= 0 ? static_cast<char>(16 * high + low) : name[i];
            i += low >= 0 ? 2 : 0;
        }
        return plain;
    }

    std::string_view take_regular() {
        std::size_t length = 0;
        while (length < rest_.size() && !is_white(rest_[length]) && !is_delimiter(rest_[length])) {
            ++length;
        }
        const std::string_view taken = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return taken;
    }

    void read_hexadecimal_string() {
        int high = -1;
        std::size_t at = 1;
        for (; at < rest_.size() && rest_[at] != '>'; ++at) {
            const int value = hexadecimal_value(rest_[at]);
            if (value >= 0 && high >= 0) {
                strings_ += static_cast<char>(high * 16 + value);
                high = -1;
            } else if (value >= 0) {
                high = value;
            }
        }
        if (high >= 0) {
            strings_ += static_cast<char>(high * 16);  // a digit that is missing is 0
        }
        rest_.remove_prefix(std::min(at + 1, rest_.size()));
    }

    void read_literal_string() {
        int open = 0;
        do {
            const char c = rest_.front();
            rest_.remove_prefix(1);
            if (c == '\\') {
                read_escape();
                continue;
            }
            open += c == '(' ? 1 : c == ')' ? -1 : 0;
            const bool is_frame = (c == '(' && open == 1) || open == 0;
            if (!is_frame) {
                strings_ += c;
            }
        } while (open > 0 && !rest_.empty());
    }

    /// What stands behind a backslash (ISO 32000-1:2008, table 3).
    void read_escape() {
        if (rest_.empty()) {
            return;
        }
        int code = 0;
        std::size_t digits = 0;
        while (digits < 3 && digits < rest_.size() && rest_[digits] >= '0' && rest_[digits] <= '7') {
            code = code * 8 + (rest_[digits++] - '0');
        }
        if (digits > 0) {
            strings_ += static_cast<char>(code);
            rest_.remove_prefix(digits);
            return;
        }
        constexpr std::string_view k_letters = "nrtbf";
        constexpr std::string_view k_meanings = "\n\r\t\b\f";
        const char c = rest_.front();
        rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
        if (const std::size_t letter = k_letters.find(c); letter != std::string_view::npos) {
            strings_ += k_meanings[letter];
        } else if (c != '\r' && c != '\n') {  // the end of a line is left out together with its backslash
            strings_ += c;
        }
    }

    void read_number_or_operator() {
        const std::string_view word = take_regular();
        is_beside_ = false;
        if ((word.front() >= '0' && word.front() <= '9') || word.front() == '-' || word.front() == '+' ||
            word.front() == '.') {
            return;
        }
        if (word == "BDC" || word == "BMC") {
            marked_.push_back({texts_of_operator_, beside_.size(), drawn_.size()});
        } else if (word == "EMC" && !marked_.empty()) {
            end_marked_content();
        } else if (word == "Tf") {
            font_ = name_;
        } else if (word == "Tj" || word == "TJ" || word == "'" || word == "\"") {
            drawn_.push_back({std::string(font_), strings_});
        } else if (word == "ID") {
            // The bytes of an image within the content end before EI.
            rest_.remove_prefix(std::min(rest_.find("EI"), rest_.size()));
        }
        strings_.clear();
        texts_of_operator_ = beside_.size();
    }

    void end_marked_content() {
        const MarkedContent& ended = marked_.back();
        for (std::size_t i = ended.first_text; i < ended.end_of_texts; ++i) {
            // Marked contents may stand within each other: what is too much is left out, and then nothing fits the text.
            const std::size_t count = drawn_.size() - ended.first_drawn;
            if (count <= k_most_kept - std::min(kept_, k_most_kept)) {
                beside_[i].drawn.assign(drawn_.begin() + static_cast<std::ptrdiff_t>(ended.first_drawn), drawn_.end());
                kept_ += count;
            }
        }
        marked_.pop_back();
    }

    static constexpr std::size_t k_most_kept = 1'000'000;  // strings that texts are taken in place of

    /// From BDC to EMC.
    struct MarkedContent {
        std::size_t first_text, end_of_texts;  ///< those of its properties
        std::size_t first_drawn;
    };

    std::string_view rest_;
    std::string_view name_;
    std::string_view font_;
    std::string strings_;
    std::vector<DrawnCodes> drawn_;
    bool is_beside_ = false;  ///< the next string is a text beside what is drawn
    bool replaces_ = false;
    std::vector<TextBesideDrawn> beside_;
    std::size_t texts_of_operator_ = 0;  ///< the first that stands among the operands of the next operator
    std::vector<MarkedContent> marked_;
    std::size_t kept_ = 0;
};

}  // namespace

std::vector<DrawnCodes> drawn_codes(std::string_view content) {
    return ContentReader(content).read();
}

std::vector<TextBesideDrawn> texts_beside_drawn_codes(std::string_view content) {
    ContentReader reader(content);
    (void)reader.read();
    return reader.take_texts_beside();
}

}  // namespace gumcert::reports
