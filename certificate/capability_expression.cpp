#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/capability.h"

namespace gumcert::certificate {
namespace {

constexpr std::size_t k_longest = 4096;  // bytes: a line of a scope, not a program
constexpr std::size_t k_deepest = 20;    // brackets inside each other

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
/// Bytes of names: ASCII letters and digits, and every byte of a letter outside of ASCII.
bool is_name_byte(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '\'' ||
           (static_cast<unsigned char>(c) & 0x80U) != 0U;
}

/// Rewrites from left to right and never looks back: what it does not know it hands on to the compiler as it is, except
/// for square brackets, which only Q may have.
class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    std::string run(std::string& problem) {
        std::string out = part(0, '\0');
        if (problem_.empty() && position_ < text_.size()) {
            say(std::string("a ") + text_[position_] + " that closes nothing");
        }
        problem = problem_;
        return problem_.empty() ? out : "";
    }

private:
    /// Up to a comma or a closing bracket outside of inner brackets, or the end. `end` is the bracket that closes.
    std::string part(std::size_t depth, char end);
    std::string root_of_squares(std::size_t depth);
    bool begins_root();
    void say(const std::string& problem) {
        if (problem_.empty()) {
            problem_ = problem;
        }
    }

    std::string_view text_;
    std::size_t position_ = 0;
    std::string problem_;
};

/// Q, blanks and [ — and Q is not the end of a longer name. Moves behind the bracket.
bool Scanner::begins_root() {
    if (text_[position_] != 'Q' || (position_ > 0 && is_name_byte(text_[position_ - 1]))) {
        return false;
    }
    std::size_t next = position_ + 1;
    while (next < text_.size() && is_blank(text_[next])) {
        ++next;
    }
    if (next >= text_.size() || text_[next] != '[') {
        return false;
    }
    position_ = next + 1;
    return true;
}

std::string Scanner::part(std::size_t depth, char end) {
    std::string out;
    if (depth > k_deepest) {
        say("brackets deeper than " + std::to_string(k_deepest));
    }
    while (problem_.empty() && position_ < text_.size()) {
        const char c = text_[position_];
        if (c == ')' || c == ']' || (c == ',' && end == ']')) {
            return out;
        }
        if (begins_root()) {
            out += root_of_squares(depth + 1);
        } else if (c == '(') {
            ++position_;
            out += '(' + part(depth + 1, ')');
            if (position_ >= text_.size() || text_[position_] != ')') {
                say("a ( that is not closed");
                break;
            }
            out += ')';
            ++position_;
        } else if (c == '[') {
            say("a [ without Q before it");
        } else {
            out += c;
            ++position_;
        }
    }
    return out;
}

std::string Scanner::root_of_squares(std::size_t depth) {
    std::string out = "sqrt(";
    for (bool first = true; problem_.empty(); first = false) {
        const std::string term = part(depth, ']');
        if (term.find_first_not_of(" \t\n\r") == std::string::npos) {
            say("an empty term in Q[…]");
        }
        out += std::string(first ? "" : "+") + '(' + term + ")^2";
        if (position_ >= text_.size() || text_[position_] == ')') {
            say("a Q[ that is not closed");
        } else if (text_[position_++] == ']') {
            return out + ')';
        }
    }
    return "";
}

}  // namespace

std::string expanded_capability_expression(const std::string& expression, std::string& problem) {
    if (expression.size() > k_longest) {
        problem = "an expression of more than " + std::to_string(k_longest) + " bytes";
        return "";
    }
    return Scanner(expression).run(problem);
}

}  // namespace gumcert::certificate
