#include "gum/expression/syntax_tree.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "gum/expression/name.h"
#include "text/numbers.h"
#include "text/utf8.h"

namespace gumcert::gum {

namespace {

constexpr std::size_t k_most_problems_of_one_equation = 20;
constexpr std::size_t k_deepest = 1000;  // what the stack bears for certain, whatever limits a caller sets

struct Function {
    std::string_view name;
    Operation operation;
    std::size_t arguments;
    bool more_allowed;  // f(a, b, c) is f(f(a, b), c)
};

constexpr std::array k_functions{
    Function{"sqrt", Operation::sqrt, 1, false},       Function{"exp", Operation::exp, 1, false},
    Function{"ln", Operation::ln, 1, false},           Function{"log", Operation::ln, 1, false},
    Function{"log10", Operation::log10, 1, false},     Function{"sin", Operation::sin, 1, false},
    Function{"cos", Operation::cos, 1, false},         Function{"tan", Operation::tan, 1, false},
    Function{"asin", Operation::asin, 1, false},       Function{"acos", Operation::acos, 1, false},
    Function{"atan", Operation::atan, 1, false},       Function{"atan2", Operation::atan2, 2, false},
    Function{"sinh", Operation::sinh, 1, false},       Function{"cosh", Operation::cosh, 1, false},
    Function{"tanh", Operation::tanh, 1, false},       Function{"abs", Operation::absolute, 1, false},
    Function{"min", Operation::minimum, 2, true},      Function{"max", Operation::maximum, 2, true},
    Function{"pow", Operation::power, 2, false},       Function{"hypot", Operation::hypot, 2, false},
    Function{"celsius", Operation::celsius, 1, false}, Function{"kelvin", Operation::kelvin, 1, false}};

const Function* find_function(std::string_view name) {
    const auto* found = std::find_if(k_functions.begin(), k_functions.end(),
                                     [name](const Function& function) { return function.name == name; });
    return found == k_functions.end() ? nullptr : found;
}

enum class TokenKind : std::uint8_t {
    number,
    name,
    plus,
    minus,
    times,
    divide,
    power,
    open,
    close,
    comma,
    equals,
    end
};

struct Token {
    TokenKind kind = TokenKind::end;
    std::uint32_t begin = 0, end = 0;  // bytes
    std::uint32_t column = 1;
    double value = 0.0;
};

/// Gathers the problems of one equation.
class Problems {
public:
    Problems(std::string where, std::vector<Diagnostic>& all) : where_(std::move(where)), all_(all) {}

    void add(std::string code, std::uint32_t column, std::string what, std::string rule, std::string action) {
        if (found_.size() <= k_most_problems_of_one_equation) {
            found_.push_back({column,
                              {.code = std::move(code),
                               .where = place(where_, column),
                               .what = std::move(what),
                               .rule = std::move(rule),
                               .action = std::move(action)}});
        }
    }
    [[nodiscard]] bool any() const { return !found_.empty(); }

    /// Hands the problems over, from left to right.
    void finish() {
        const bool too_many = found_.size() > k_most_problems_of_one_equation;
        if (too_many) {
            found_.pop_back();
        }
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Found& a, const Found& b) { return a.column < b.column; });
        for (Found& found : found_) {
            all_.push_back(std::move(found.diagnostic));
        }
        if (too_many) {
            all_.push_back({.code = "GC-MODEL-0018",
                            .where = where_,
                            .what = "more than " + std::to_string(k_most_problems_of_one_equation) + " problems",
                            .rule = "the others are not listed",
                            .action = "Correct the listed ones first."});
        }
    }

private:
    struct Found {
        std::uint32_t column;
        Diagnostic diagnostic;
    };
    std::string where_;
    std::vector<Diagnostic>& all_;
    std::vector<Found> found_;
};

bool is_digit(char c) {
    return '0' <= c && c <= '9';
}

/// An integer without point and exponent is meant exactly.
bool is_kept_exactly(std::string_view digits, double value) {
    if (digits.find_first_not_of("0123456789") != std::string_view::npos) {
        return true;
    }
    while (digits.size() > 1 && digits.front() == '0') {
        digits.remove_prefix(1);
    }
    // Whole numbers above 2^53 are not all doubles. The largest double has 309 digits, which 400 characters hold.
    std::array<char, 400> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 0).ptr;
    return std::string_view(text.data(), end) == digits;
}

/// Characters that people take from other places, and what the language has for them.
struct Stranger {
    char32_t code;
    std::optional<TokenKind> meant;
    std::string_view action;
};
constexpr std::array k_strangers{
    Stranger{U'−', TokenKind::minus, "Write the minus sign of the keyboard, \"-\"."},
    Stranger{U'–', TokenKind::minus, "Write the minus sign of the keyboard, \"-\"."},
    Stranger{U'—', TokenKind::minus, "Write the minus sign of the keyboard, \"-\"."},
    Stranger{U'×', TokenKind::times, "Write \"*\" for a product."},
    Stranger{U'·', TokenKind::times, "Write \"*\" for a product."},
    Stranger{U'⋅', TokenKind::times, "Write \"*\" for a product."},
    Stranger{U'∙', TokenKind::times, "Write \"*\" for a product."},
    Stranger{U'÷', TokenKind::divide, "Write \"/\" for a quotient."},
    Stranger{U'∕', TokenKind::divide, "Write \"/\" for a quotient."},
    Stranger{U'[', TokenKind::open, "Write parentheses, ( and )."},
    Stranger{U']', TokenKind::close, "Write parentheses, ( and )."},
    Stranger{U'{', TokenKind::open, "Write parentheses, ( and )."},
    Stranger{U'}', TokenKind::close, "Write parentheses, ( and )."},
    Stranger{U';', TokenKind::comma, "Separate arguments by a comma; one equation each text."},
    Stranger{U'²', std::nullopt, "Write \"^2\"."},
    Stranger{U'³', std::nullopt, "Write \"^3\"."},
    Stranger{U'¹', std::nullopt, "Write the power with \"^\"."},
    Stranger{U'⁻', std::nullopt, "Write the power with \"^\", e.g. \"^-1\"."},
    Stranger{U'√', std::nullopt, "Write \"sqrt(…)\"."},
    Stranger{U'°', std::nullopt,
             "Give the quantity its unit (\"deg\", \"degC\") in the inputs; angles are in radian here."},
    Stranger{U'%', std::nullopt, "Give the quantity the unit \"percent\" in the inputs, or write \"/100\"."},
    Stranger{U'’', std::nullopt, "Write the prime of a name as \"'\"."},
    Stranger{U'′', std::nullopt, "Write the prime of a name as \"'\"."},
    Stranger{0xA0, std::nullopt, "Replace the no-break space by an ordinary space."},
    Stranger{0x202F, std::nullopt,
             "Replace the narrow no-break space by an ordinary space, or leave it out of the number."},
    Stranger{0x2009, std::nullopt, "Replace the thin space by an ordinary space, or leave it out of the number."},
    Stranger{U'!', std::nullopt, "Write the product out; there is no factorial."},
    Stranger{U'<', std::nullopt, "Comparisons are not part of the language; use min(…) or max(…)."},
    Stranger{U'>', std::nullopt, "Comparisons are not part of the language; use min(…) or max(…)."}};

class Lexer {
public:
    Lexer(std::string_view text, Problems& problems) : text_(text), problems_(problems) {}

    /// \return false when characters had to be skipped, so that what is left may mean something else
    bool run(std::vector<Token>& tokens) {
        tokens_ = &tokens;
        while (position_ < text_.size()) {
            const char c = text_[position_];
            if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
                advance(1);
            } else if (is_digit(c) || (c == '.' && position_ + 1 < text_.size() && is_digit(text_[position_ + 1]))) {
                number();
            } else if (!sign() && !word_or_stranger()) {
                return false;
            }
        }
        push(TokenKind::end, 0);
        return whole_;
    }

private:
    void advance(std::size_t bytes) {
        for (std::size_t i = 0; i < bytes; ++i) {
            column_ += !text::is_continuation(text_[position_ + i]) ? 1U : 0U;
        }
        position_ += bytes;
    }

    void push(TokenKind kind, std::size_t bytes, double value = 0.0) {
        tokens_->push_back({.kind = kind,
                            .begin = static_cast<std::uint32_t>(position_),
                            .end = static_cast<std::uint32_t>(position_ + bytes),
                            .column = column_,
                            .value = value});
        advance(bytes);
    }

    [[nodiscard]] bool follows(std::string_view what) const { return text_.substr(position_).starts_with(what); }

    bool sign() {
        if (follows("**")) {
            problems_.add("GC-MODEL-0011", column_, "\"**\"", "powers are written with \"^\"",
                          "Write \"^\" for \"**\".");
            push(TokenKind::power, 2);
            return true;
        }
        if (follows("==") || follows(":=")) {
            problems_.add("GC-MODEL-0011", column_, "\"" + std::string(text_.substr(position_, 2)) + "\"",
                          "the two sides of an equation are joined by \"=\"", "Write \"=\".");
            push(TokenKind::equals, 2);
            return true;
        }
        constexpr std::string_view signs = "+-*/^(),=";
        constexpr std::array kinds{TokenKind::plus,   TokenKind::minus, TokenKind::times,
                                   TokenKind::divide, TokenKind::power, TokenKind::open,
                                   TokenKind::close,  TokenKind::comma, TokenKind::equals};
        const std::size_t which = signs.find(text_[position_]);
        if (which == std::string_view::npos) {
            return false;
        }
        push(kinds.at(which), 1);
        return true;
    }

    void number() {
        const std::size_t begin = position_;
        const auto at = [&](std::size_t i) { return i < text_.size() ? text_[i] : '\0'; };
        std::size_t end = begin;
        const auto digits = [&] {
            while (is_digit(at(end))) {
                ++end;
            }
        };
        digits();
        if (at(end) == '.') {
            ++end;
            digits();
        }
        if (at(end) == 'e' || at(end) == 'E') {
            const std::size_t sign_size = at(end + 1) == '+' || at(end + 1) == '-' ? 1 : 0;
            if (is_digit(at(end + 1 + sign_size))) {
                end += 1 + sign_size;
                digits();
            }
        }
        if (at(end) == '.') {
            while (is_digit(at(end)) || at(end) == '.') {
                ++end;
            }
            const std::string found(text_.substr(begin, end - begin));
            problems_.add("GC-MODEL-0008", column_, "\"" + found + "\"", "a number has one decimal point",
                          "Write the number with one point and no separators of thousands.");
            push(TokenKind::number, end - begin, 1.0);
            return;
        }
        const std::string_view text = text_.substr(begin, end - begin);
        double value = 0.0;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
        if (read.ec == std::errc::result_out_of_range || !std::isfinite(value)) {
            problems_.add("GC-MODEL-0008", column_, "\"" + std::string(text.substr(0, 40)) + "\"",
                          "a number is within ±1.8e308, and not closer to zero than 4.9e-324",
                          "Write the number that is meant, or 0.");
            value = 1.0;
        } else if (!is_kept_exactly(text, value)) {
            problems_.add("GC-MODEL-0008", column_, "\"" + std::string(text.substr(0, 40)) + "\"",
                          "this whole number has too many digits to be kept: it would become " + text::shortest(value),
                          "Write it with a decimal point when its last digits do not matter.");
        }
        push(TokenKind::number, end - begin, value);
    }

    bool word_or_stranger() {
        const text::Character first = text::decode_utf8(text_, position_);
        if (first.bytes == 0) {
            problems_.add("GC-MODEL-0007", column_, "byte " + std::to_string(position_) + " is not valid UTF-8",
                          "equations are UTF-8 text", "Save the file as UTF-8.");
            return false;
        }
        switch (character_class(first.code)) {
            case CharacterClass::name_start:
                return word();
            case CharacterClass::control:
                problems_.add(
                    "GC-MODEL-0006", column_, "the invisible character " + code_point_text(first.code),
                    "control characters, marks of text direction and characters without width are not allowed",
                    "Delete it.");
                break;
            case CharacterClass::combining_mark:
                problems_.add("GC-MODEL-0014", column_, "the combining mark " + code_point_text(first.code),
                              "a letter with its accent is one character (Unicode normalisation form C)",
                              "Write the letter as one character, or without the accent.");
                break;
            default: {
                const auto* stranger = std::find_if(k_strangers.begin(), k_strangers.end(),
                                                    [&](const Stranger& one) { return one.code == first.code; });
                const std::string shown =
                    "\"" + text::encode_utf8(first.code) + "\" (" + code_point_text(first.code) + ")";
                if (stranger != k_strangers.end()) {
                    problems_.add("GC-MODEL-0011", column_, shown, "the character is not part of the equation language",
                                  std::string(stranger->action));
                    // The meaning is clear: reading goes on with it, and the other faults of the equation are found in
                    // one go.
                    if (stranger->meant) {
                        push(*stranger->meant, first.bytes);
                        return true;
                    }
                } else {
                    problems_.add("GC-MODEL-0006", column_, shown, "the character is not part of the equation language",
                                  "Use letters, digits, _ and + - * / ^ ( ) , only.");
                }
            }
        }
        // What a skipped character meant is not known: parsing the rest would report faults that are none.
        whole_ = false;
        while (position_ < text_.size()) {  // once is enough for a row of the same
            const text::Character next = text::decode_utf8(text_, position_);
            if (next.bytes == 0 || next.code != first.code) {
                break;
            }
            advance(next.bytes);
        }
        return true;
    }

    bool word() {
        std::size_t end = position_;
        while (end < text_.size()) {
            const text::Character next = text::decode_utf8(text_, end);
            if (next.bytes == 0) {
                break;
            }
            const CharacterClass kind = character_class(next.code);
            if (kind == CharacterClass::other || kind == CharacterClass::control) {
                break;
            }
            end += next.bytes;
        }
        const std::string_view name = text_.substr(position_, end - position_);
        if (const std::optional<std::string> reason = reason_against_name(name)) {
            problems_.add("GC-MODEL-0014", column_, "the name \"" + std::string(name.substr(0, 64)) + "\" " + *reason,
                          "a name is letters, digits, _ and ', and looks like no other name",
                          "Type the name anew: letters of one script, and at most 256 bytes.");
        }
        push(TokenKind::name, end - position_);
        return true;
    }

    std::string_view text_;
    Problems& problems_;
    std::vector<Token>* tokens_ = nullptr;
    std::size_t position_ = 0;
    std::uint32_t column_ = 1;
    bool whole_ = true;
};

/// Ends the reading of an equation whose rest cannot be understood; the problem is already noted.
struct Stop {};

class Parser {
public:
    Parser(SyntaxTree& tree, const std::vector<Token>& tokens, const ExpressionLimits& limits, Problems& problems,
           const IsQuantity& is_quantity)
        : tree_(tree),
          tokens_(tokens),
          deepest_(std::min(limits.depth, k_deepest)),
          most_nodes_(limits.nodes),
          problems_(problems),
          is_quantity_(is_quantity) {}

    void run() {
        left_side();
        sum(0);
        switch (here().kind) {
            case TokenKind::end:
                return;
            case TokenKind::close:
                stop("GC-MODEL-0005", "\")\" without its \"(\"", "parentheses come in pairs",
                     "Delete it, or write the \"(\".");
            case TokenKind::equals:
                stop("GC-MODEL-0002", "a second \"=\"", "an equation has one \"=\"", "Write two equations.");
            default:
                unexpected("an operator or the end of the equation");
        }
    }

private:
    [[nodiscard]] const Token& here() const { return tokens_[position_]; }
    [[nodiscard]] std::string_view text(const Token& token) const {
        return std::string_view(tree_.text).substr(token.begin, token.end - token.begin);
    }

    [[noreturn]] void stop(std::string code, std::string what, std::string rule, std::string action) {
        problems_.add(std::move(code), here().column, std::move(what), std::move(rule), std::move(action));
        throw Stop{};
    }

    [[noreturn]] void unexpected(const std::string& expected) {
        const Token& found = here();
        if (found.kind == TokenKind::comma && position_ > 0 && tokens_[position_ - 1].kind == TokenKind::number &&
            tokens_[position_ + 1].kind == TokenKind::number && tokens_[position_ - 1].end == found.begin &&
            found.end == tokens_[position_ + 1].begin) {
            const std::string before(text(tokens_[position_ - 1]));
            const std::string after(text(tokens_[position_ + 1]));
            stop("GC-MODEL-0009", "\"" + before + "," + after + "\"", "the decimal sign is a point",
                 "Write " + before + "." + after + ".");
        }
        const std::string what =
            found.kind == TokenKind::end ? "the equation ends" : "\"" + std::string(text(found).substr(0, 64)) + "\"";
        stop("GC-MODEL-0004", what, "expected " + expected, "Complete or correct the equation here.");
    }

    void left_side() {
        const auto equals = std::find_if(tokens_.begin(), tokens_.end(),
                                         [](const Token& token) { return token.kind == TokenKind::equals; });
        if (equals == tokens_.end()) {
            stop("GC-MODEL-0002", "there is no \"=\"", "an equation is \"name = expression\" or \"0 = expression\"",
                 "Write the name of the quantity and \"=\" in front.");
        }
        const Token& first = tokens_.front();
        const bool single = equals - tokens_.begin() == 1;
        const bool zero = single && first.kind == TokenKind::number && text(first) == "0";
        if (!zero && !(single && first.kind == TokenKind::name)) {
            std::string found(tree_.text, first.begin, equals->begin - first.begin);
            found.erase(found.find_last_not_of(" \t\r\n") + 1);
            stop("GC-MODEL-0003",
                 equals == tokens_.begin() ? "nothing on the left of \"=\""
                                           : "\"" + shortened(found) + "\" on the left of \"=\"",
                 "on the left of \"=\" stands one name, or 0 in an implicit model",
                 "Solve the equation for one quantity, or write \"0 = right side - left side\" with \"solve_for\".");
        }
        if (!zero) {
            tree_.defines = canonical_name(text(first));
            tree_.defines_column = first.column;
            if (is_reserved_name(tree_.defines)) {
                problems_.add("GC-MODEL-0023", first.column, "\"" + tree_.defines + "\" on the left of \"=\"",
                              "names of functions and pi cannot be names of quantities",
                              "Give the quantity another name.");
            }
        }
        tree_.has_left_side = true;
        position_ = 2;
    }

    std::int32_t add_node(SyntaxNode node) {
        if (tree_.nodes.size() >= most_nodes_) {
            stop("GC-MODEL-0017", "too many operations",
                 "the equations may have " + std::to_string(most_nodes_) + " more numbers, names and operators here",
                 "Split the model.");
        }
        tree_.nodes.push_back(node);
        return static_cast<std::int32_t>(tree_.nodes.size() - 1);
    }

    [[nodiscard]] SyntaxNode& node(std::int32_t index) { return tree_.nodes[static_cast<std::size_t>(index)]; }

    std::int32_t add_binary(Operation operation, std::int32_t left, std::int32_t right, std::uint32_t column) {
        const std::uint32_t begin = node(left).begin;
        const std::uint32_t end = node(right).end;
        return add_node(
            {.operation = operation, .left = left, .right = right, .column = column, .begin = begin, .end = end});
    }

    void check_depth(std::size_t depth) {
        if (depth > deepest_) {
            stop("GC-MODEL-0016", "more than " + std::to_string(deepest_) + " levels inside each other",
                 "parentheses, signs, powers and functions may be nested " + std::to_string(deepest_) + " deep",
                 "Give parts of the expression names of their own.");
        }
    }

    std::int32_t sum(std::size_t depth) {
        std::int32_t left = product(depth);
        while (here().kind == TokenKind::plus || here().kind == TokenKind::minus) {
            const Token& sign = here();
            ++position_;
            const std::int32_t right = product(depth);
            left = add_binary(sign.kind == TokenKind::plus ? Operation::add : Operation::subtract, left, right,
                              sign.column);
        }
        return left;
    }

    std::int32_t product(std::size_t depth) {
        std::int32_t left = signed_power(depth);
        for (;;) {
            const Token& sign = here();
            if (sign.kind == TokenKind::times || sign.kind == TokenKind::divide) {
                ++position_;
            } else if (sign.kind == TokenKind::number || sign.kind == TokenKind::name || sign.kind == TokenKind::open) {
                forgotten_operator(left);
            } else {
                return left;
            }
            const std::int32_t right = signed_power(depth);
            left = add_binary(sign.kind == TokenKind::divide ? Operation::divide : Operation::multiply, left, right,
                              sign.column);
        }
    }

    void forgotten_operator(std::int32_t left) {
        const Token& before = tokens_[position_ - 1];
        const Token& after = here();
        const std::string a(before.kind == TokenKind::close ? tree_.excerpt(node(left)) : std::string(text(before)));
        const std::string b(text(after));
        if (before.kind == TokenKind::number && after.kind == TokenKind::number) {
            problems_.add("GC-MODEL-0010", after.column, "\"" + a + " " + b + "\": two numbers without an operator",
                          "thousands are not separated; a product is written with \"*\"",
                          "Write " + a + b + " or " + a + "*" + b + ".");
            return;
        }
        const std::string gap = before.end == after.begin ? "" : " ";
        // Reading goes on as if "*" stood there: the other faults are found in the same run.
        problems_.add("GC-MODEL-0010", after.column, "\"" + a + gap + b + "\": an operator is missing",
                      "a product is written with \"*\"", "Write " + a + "*" + b + (b == "(" ? "…)" : "") + ".");
    }

    std::int32_t signed_power(std::size_t depth) {
        const std::size_t first = position_;
        while (here().kind == TokenKind::plus || here().kind == TokenKind::minus) {
            check_depth(depth + (position_ - first) + 1);
            ++position_;
        }
        const std::size_t last = position_;
        std::int32_t operand = power(depth + (last - first));
        for (std::size_t i = last; i-- > first;) {
            const Token& sign = tokens_[i];
            node(operand).begin = std::min(node(operand).begin, sign.end);
            if (sign.kind == TokenKind::minus) {
                const std::uint32_t end = node(operand).end;
                operand = add_node({.operation = Operation::negate,
                                    .left = operand,
                                    .column = sign.column,
                                    .begin = sign.begin,
                                    .end = end});
            } else {
                node(operand).begin = sign.begin;  // +x is x
            }
        }
        return operand;
    }

    std::int32_t power(std::size_t depth) {
        const std::int32_t base = atom(depth);
        if (here().kind != TokenKind::power) {
            return base;
        }
        const std::uint32_t column = here().column;
        check_depth(depth + 1);
        ++position_;
        // From the right, with a sign of its own: a^b^c is a^(b^c), 2^-1 is allowed. A sign before the base is read
        // outside: -x^2 is -(x^2).
        const std::int32_t exponent = signed_power(depth + 1);
        return add_binary(Operation::power, base, exponent, column);
    }

    std::int32_t atom(std::size_t depth) {
        const Token& token = here();
        switch (token.kind) {
            case TokenKind::number:
                ++position_;
                return add_node({.operation = Operation::number,
                                 .value = token.value,
                                 .column = token.column,
                                 .begin = token.begin,
                                 .end = token.end});
            case TokenKind::name:
                return name_or_call(depth);
            case TokenKind::open: {
                check_depth(depth + 1);
                ++position_;
                const std::int32_t inner = sum(depth + 1);
                // The parentheses belong to the excerpt of a message, so that what is quoted stands in the text as it
                // is quoted.
                node(inner).begin = token.begin;
                node(inner).end = close(token);
                return inner;
            }
            default:
                unexpected("a number, a name or \"(\"");
        }
    }

    /// \return where the ")" ends
    std::uint32_t close(const Token& open) {
        if (here().kind == TokenKind::close) {
            return tokens_[position_++].end;
        }
        if (here().kind == TokenKind::end) {
            stop("GC-MODEL-0005", "the \"(\" in column " + std::to_string(open.column) + " is not closed",
                 "parentheses come in pairs", "Write the \")\".");
        }
        if (here().kind == TokenKind::equals) {
            stop("GC-MODEL-0002", "a second \"=\"", "an equation has one \"=\"", "Write two equations.");
        }
        unexpected("an operator or \")\"");
    }

    std::int32_t name_or_call(std::size_t depth) {
        const Token& token = here();
        const std::string_view name = text(token);
        const Function* function = find_function(name);
        ++position_;
        if (here().kind == TokenKind::open) {
            if (function != nullptr) {
                return call(*function, token, depth);
            }
            if (name != "pi" && !(is_quantity_ && is_quantity_(name))) {
                std::vector<std::string> names;
                for (const Function& known : k_functions) {
                    names.emplace_back(known.name);
                }
                const std::optional<std::string> nearest = nearest_name(name, names);
                problems_.add("GC-MODEL-0012", token.column, "\"" + std::string(name) + "(…)\" is not a function",
                              "functions are sqrt exp ln log10 sin cos tan asin acos atan atan2 sinh cosh tanh abs min "
                              "max pow hypot celsius kelvin",
                              nearest ? "Write " + *nearest + "(…), or " + std::string(name) + "*(…) for a product."
                                      : "Write " + std::string(name) + "*(…) for a product.");
                // What is between the parentheses is still read, for its own problems.
                return call({.name = name, .operation = Operation::maximum, .arguments = 0, .more_allowed = true},
                            token, depth);
            }
        } else if (function != nullptr) {
            problems_.add("GC-MODEL-0023", token.column, "the function \"" + std::string(name) + "\" without \"(\"",
                          "names of functions cannot be names of quantities",
                          "Write " + std::string(name) + "(…), or give the quantity another name.");
        }
        if (name == "pi") {
            return add_node(
                {.operation = Operation::pi, .column = token.column, .begin = token.begin, .end = token.end});
        }
        return add_node({.operation = Operation::quantity,
                         .name = name_index(name),
                         .column = token.column,
                         .begin = token.begin,
                         .end = token.end});
    }

    std::uint32_t name_index(std::string_view name) {
        const auto [entry, is_new] =
            names_.try_emplace(canonical_name(name), static_cast<std::uint32_t>(tree_.names.size()));
        if (is_new) {
            tree_.names.push_back(entry->first);
        }
        return entry->second;
    }

    std::int32_t call(const Function& function, const Token& token, std::size_t depth) {
        // a^(b + c) nests deeper than pow(a, b + c): printed again, the text must not go beyond the limit.
        const std::size_t inside = depth + (function.operation == Operation::power ? 2 : 1);
        check_depth(inside);
        const Token& open = here();
        ++position_;
        std::int32_t result = -1;
        std::size_t arguments = 0;
        if (here().kind != TokenKind::close) {
            for (;;) {
                const std::int32_t argument = sum(inside);
                ++arguments;
                if (result < 0) {
                    result = argument;
                } else {
                    result = add_binary(function.operation, result, argument, token.column);
                    node(result).begin = token.begin;
                }
                if (here().kind != TokenKind::comma) {
                    break;
                }
                ++position_;
            }
        }
        const std::uint32_t end = close(open);
        const bool fits = function.more_allowed ? arguments >= function.arguments : arguments == function.arguments;
        if (!fits) {
            const bool decimal_comma = function.arguments == 1 && arguments == 2;
            problems_.add("GC-MODEL-0013", token.column,
                          std::string(function.name) + " with " + std::to_string(arguments) +
                              (arguments == 1 ? " argument" : " arguments"),
                          std::string(function.name) + " has " + (function.more_allowed ? "at least " : "") +
                              std::to_string(function.arguments) +
                              (function.arguments == 1 ? " argument" : " arguments"),
                          decimal_comma ? "Correct the list of arguments; the decimal sign is a point, not a comma."
                                        : "Correct the list of arguments.");
        }
        if (result < 0) {
            result = add_node({.operation = Operation::number, .column = token.column, .begin = token.begin});
        } else if (function.arguments == 1) {
            result = add_node({.operation = function.operation, .left = result, .column = token.column});
        }
        node(result).begin = token.begin;
        node(result).end = end;
        return result;
    }

    static std::string shortened(const std::string& found) {
        return found.size() <= 40 ? found : found.substr(0, 18) + "…";
    }

    SyntaxTree& tree_;
    const std::vector<Token>& tokens_;
    std::size_t deepest_;
    std::size_t most_nodes_;
    Problems& problems_;
    const IsQuantity& is_quantity_;
    std::size_t position_ = 0;
    std::map<std::string, std::uint32_t> names_;
};

/// How closely an operation binds, for printing.
int binding(Operation operation) {
    switch (operation) {
        case Operation::add:
        case Operation::subtract:
            return 1;
        case Operation::multiply:
        case Operation::divide:
            return 2;
        case Operation::negate:
            return 3;
        case Operation::power:
            return 4;
        default:
            return 5;
    }
}

std::string in_parentheses(std::string text, bool needed) {
    return needed ? "(" + std::move(text) + ")" : std::move(text);
}

}  // namespace

std::string place(const std::string& where, std::uint32_t column) {
    return (where.empty() ? std::string("equation") : where) + ", column " + std::to_string(column);
}

std::string_view function_name(Operation operation) {
    const auto* found = std::find_if(k_functions.begin(), k_functions.end(),
                                     [operation](const Function& function) { return function.operation == operation; });
    return found == k_functions.end() ? std::string_view() : found->name;
}

bool is_reserved_name(std::string_view name) {
    return name == "pi" || find_function(name) != nullptr;
}

std::string SyntaxTree::excerpt(const SyntaxNode& node) const {
    constexpr std::size_t k_whole = 44;
    constexpr std::size_t k_part = 20;
    const std::string_view whole = std::string_view(text).substr(node.begin, node.end - node.begin);
    if (whole.size() <= k_whole) {
        return std::string(whole);
    }
    const auto starts_character = [&](std::size_t i) { return !text::is_continuation(whole[i]); };
    std::size_t head = k_part;
    while (!starts_character(head)) {
        --head;
    }
    std::size_t tail = whole.size() - k_part;
    while (!starts_character(tail)) {
        ++tail;
    }
    return std::string(whole.substr(0, head)) + " … " + std::string(whole.substr(tail));
}

SyntaxTree parse_equation(const EquationText& equation, const ExpressionLimits& limits, std::vector<Diagnostic>& all,
                          const IsQuantity& is_quantity) {
    SyntaxTree tree;
    tree.where = equation.where;
    Problems problems(equation.where, all);
    std::vector<Token> tokens;
    if (equation.text.size() > std::min<std::size_t>(limits.bytes, 1U << 30U)) {
        problems.add("GC-MODEL-0015", 1, std::to_string(equation.text.size()) + " bytes",
                     "an equation has at most " + std::to_string(limits.bytes) + " bytes",
                     "Split it into several equations.");
    } else {
        tree.text = equation.text;
        if (!Lexer(tree.text, problems).run(tokens)) {
            tokens.clear();
        } else if (tokens.size() == 1) {
            problems.add("GC-MODEL-0001", 1, "the equation is empty", "an equation is \"name = expression\"",
                         "Write the equation, or remove the entry.");
            tokens.clear();
        }
    }
    if (!tokens.empty()) {
        try {
            Parser(tree, tokens, limits, problems, is_quantity).run();
        } catch (const Stop&) {
            tree.nodes.clear();
        }
    }
    tree.refused = problems.any();
    problems.finish();
    return tree;
}

std::string print_equation(const SyntaxTree& tree) {
    struct Part {
        std::string text;
        Operation operation;
    };
    // Nodes come in postfix order, operands before their operation: a stack does it, without recursion.
    std::vector<Part> stack;
    for (const SyntaxNode& node : tree.nodes) {
        const Operation operation = node.operation;
        if (operation == Operation::number) {
            stack.push_back({text::shortest(node.value), operation});
        } else if (operation == Operation::pi) {
            stack.push_back({"pi", operation});
        } else if (operation == Operation::quantity) {
            stack.push_back({tree.names[node.name], operation});
        } else if (is_unary(operation)) {
            Part& operand = stack.back();
            if (operation == Operation::negate) {
                operand.text = "-" + in_parentheses(std::move(operand.text), binding(operand.operation) < 3);
            } else {
                operand.text = std::string(function_name(operation)) + "(" + std::move(operand.text) + ")";
            }
            operand.operation = operation;
        } else {
            Part right = std::move(stack.back());
            stack.pop_back();
            Part& left = stack.back();
            const int own = binding(operation);
            if (own == 5) {  // a function
                if ((operation == Operation::minimum || operation == Operation::maximum) &&
                    left.operation == operation) {
                    left.text.pop_back();  // min(min(a, b), c) is min(a, b, c)
                } else {
                    left.text = std::string(function_name(operation)) + "(" + std::move(left.text);
                }
                left.text += ", " + right.text + ")";
            } else {
                const bool to_the_right = operation == Operation::power;
                if (to_the_right ? binding(left.operation) <= own : binding(left.operation) < own) {
                    left.text = in_parentheses(std::move(left.text), true);
                }
                left.text += operation == Operation::add        ? " + "
                             : operation == Operation::subtract ? " - "
                             : operation == Operation::multiply ? "*"
                             : operation == Operation::divide   ? "/"
                                                                : "^";
                left.text += in_parentheses(std::move(right.text), to_the_right ? binding(right.operation) < 3
                                                                                : binding(right.operation) <= own);
            }
            left.operation = operation;
        }
    }
    return (tree.defines.empty() ? "0" : tree.defines) + " = " + (stack.empty() ? "" : stack.back().text);
}

EquationNames equation_names(const EquationText& equation, const ExpressionLimits& limits) {
    std::vector<Diagnostic> problems;
    SyntaxTree tree = parse_equation(equation, limits, problems);
    if (!problems.empty()) {
        throw InputError(std::move(problems));
    }
    return {.defines = std::move(tree.defines), .uses = std::move(tree.names)};
}

std::string equation_text(const EquationText& equation, const ExpressionLimits& limits) {
    std::vector<Diagnostic> problems;
    const SyntaxTree tree = parse_equation(equation, limits, problems);
    if (!problems.empty()) {
        throw InputError(std::move(problems));
    }
    return print_equation(tree);
}

}  // namespace gumcert::gum
