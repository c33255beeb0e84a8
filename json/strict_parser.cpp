#include "json/strict_parser.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <system_error>
#include <utility>

#include "json/json_pointer.h"
#include "text/numbers.h"
#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::json {

namespace {

using Value = nlohmann::json;

/// Unwinds the parser after a fault that makes the rest unreadable; the caller knows of it by then.
struct Unreadable {};

/// Recursive descent over a text of any bytes.
///
/// Own code, and not nlohmann's, because a message needs the place of every value, and because nlohmann-json lets the
/// last of two equal keys win, reads long integers inexactly and allows block comments.
class Parser {
public:
    Parser(std::string_view text, const ParserOptions& options, const std::function<void(ParsingProblem)>& report,
           Places* places)
        : text_(text), options_(options), report_(report), places_(places), finder_(text) {}

    void document(Value& out) {
        skip_blank();
        if (at_end()) {
            stop_here(Fault::empty, "the file is empty", "a JSON document has one value",
                      "check the name of the file and its content");
        }
        value(out, 0);
        skip_blank();
        if (!at_end()) {
            stop_here(Fault::trailing_text, "text after the end of the document: " + text::in_quotes(rest()),
                      "a file has one JSON document", "remove the text");
        }
    }

private:
    [[nodiscard]] bool at_end() const { return offset_ >= text_.size(); }
    [[nodiscard]] char here() const { return at_end() ? '\0' : text_[offset_]; }
    [[nodiscard]] std::string_view rest() const { return text_.substr(offset_, 12); }
    [[nodiscard]] bool looking_at(std::string_view word) const { return text_.substr(offset_, word.size()) == word; }
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    void report_at(std::size_t offset, Fault fault, std::string what, std::string rule, std::string action) {
        report_({.fault = fault,
                 .place = finder_.at(offset),
                 .offset = offset,
                 .pointer = pointer_,
                 .what = std::move(what),
                 .rule = std::move(rule),
                 .action = std::move(action)});
    }
    [[noreturn]] void stop_at(std::size_t offset, Fault fault, std::string what, std::string rule, std::string action) {
        report_at(offset, fault, std::move(what), std::move(rule), std::move(action));
        throw Unreadable{};
    }
    [[noreturn]] void stop_here(Fault fault, std::string what, std::string rule, std::string action) {
        stop_at(offset_, fault, std::move(what), std::move(rule), std::move(action));
    }
    [[noreturn]] void syntax(const std::string& expected, const std::string& action) {
        stop_here(
            Fault::syntax,
            (at_end() ? std::string{"the file ends"} : text::in_quotes(rest())) + " where " + expected + " is expected",
            "the file must be JSON (RFC 8259)", action);
    }

    void skip_blank() {
        while (!at_end()) {
            const char c = here();
            if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
                ++offset_;
            } else if (options_.comments && looking_at("//")) {
                comment();
            } else if (looking_at("//") || looking_at("/*") || c == '#') {
                stop_here(Fault::comment,
                          "a comment that begins with " + text::in_quotes(text_.substr(offset_, c == '#' ? 1 : 2)),
                          options_.comments ? "only // comments to the end of the line are allowed"
                                            : "no comments are allowed",
                          options_.comments ? "write it as a // comment" : "remove it");
            } else {
                return;
            }
        }
    }

    void comment() {
        const std::size_t end = std::min(text_.find('\n', offset_), text_.size());
        while (offset_ < end) {
            offset_ += character();
        }
    }

    /// Bytes of the character that stands here.
    std::size_t character() {
        const auto byte = static_cast<unsigned char>(here());
        if (byte == 0) {
            stop_here(Fault::nul_character, "a NUL character", "a text has no NUL characters",
                      "check that the file is not damaged");
        }
        const std::size_t bytes = byte < 0x80U ? 1 : text::decode_utf8(text_, offset_).bytes;
        if (bytes == 0) {
            stop_here(Fault::not_utf8, "byte 0x" + text::hexadecimal(byte, 2) + " is not UTF-8", "only UTF-8 is read",
                      "save the file as UTF-8 text");
        }
        return bytes;
    }

    /// How many characters from here on are of ASCII and stand for themselves in a string.
    [[nodiscard]] std::size_t plain_characters() const {
        const std::string_view from_here = text_.substr(offset_);
        const auto end = std::find_if(from_here.begin(), from_here.end(), [](char c) {
            const auto byte = static_cast<unsigned char>(c);
            return byte < 0x20U || byte >= 0x80U || c == '"' || c == '\\';
        });
        return static_cast<std::size_t>(end - from_here.begin());
    }

    void value(Value& out, std::size_t depth) {
        if (++values_ > options_.values) {
            stop_here(Fault::too_many_values, "more than " + std::to_string(options_.values) + " values",
                      "a document may have at most " + std::to_string(options_.values) + " values",
                      "write fewer values");
        }
        // Long keys around many values would make the table of places far larger than the text.
        constexpr std::size_t k_pointer_bytes = std::size_t{64} << 20U;
        if (places_ != nullptr && pointer_.size() <= k_pointer_bytes - pointer_bytes_) {
            pointer_bytes_ += pointer_.size();
            places_->emplace(pointer_, ValuePlace{finder_.at(offset_), offset_});
        }
        const char c = here();
        if (c == '{' || c == '[') {
            if (depth >= options_.depth) {
                stop_here(Fault::depth,
                          "objects and arrays are nested more than " + std::to_string(options_.depth) + " deep",
                          "the depth is at most " + std::to_string(options_.depth), "nest them less deep");
            }
            c == '{' ? object(out, depth + 1) : array(out, depth + 1);
        } else if (c == '"') {
            out = string("string");
        } else if (c == '-' || is_digit(c)) {
            number(out);
        } else if (word("true")) {
            out = true;
        } else if (word("false")) {
            out = false;
        } else if (word("null")) {
            out = nullptr;
        } else {
            for (const std::string_view name :
                 {"NaN", "nan", "NAN", "Infinity", "infinity", "+Infinity", "inf", "Inf", "INF"}) {
                if (word(name)) {
                    report_at(offset_ - name.size(), Fault::not_finite, std::string{name} + " at " + quoted_pointer(),
                              "a number must be finite", "state the number, or leave the key out");
                    out = Value(Value::value_t::discarded);
                    return;
                }
            }
            if (c == '\'') {
                syntax("a value", "write strings in double quotes");
            }
            if (c == '+' || c == '.') {
                syntax("a value", "write a number with a digit before the point and without a plus sign");
            }
            if (c == '}' || c == ']') {
                syntax("a value", "remove the comma before the bracket, or add the value");
            }
            syntax("a value", "write a string in double quotes, a number, true, false, an object or an array");
        }
    }

    [[nodiscard]] std::string quoted_pointer() const {
        return pointer_.empty() ? "the document" : text::visible(pointer_);
    }

    bool word(std::string_view name) {
        if (!looking_at(name)) {
            return false;
        }
        const std::size_t end = offset_ + name.size();
        const char next = end < text_.size() ? text_[end] : ' ';
        if ((next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z') || is_digit(next) || next == '_') {
            return false;
        }
        offset_ = end;
        return true;
    }

    [[nodiscard]] std::string line_of_first() const {
        if (places_ == nullptr) {
            return "";
        }
        const auto first = places_->find(pointer_);
        return first == places_->end() ? "" : ", first in line " + std::to_string(first->second.line);
    }

    void object(Value& out, std::size_t depth) {
        out = Value::object();
        auto& members = out.get_ref<Value::object_t&>();
        const std::size_t parent = pointer_.size();
        ++offset_;
        skip_blank();
        if (here() == '}') {
            ++offset_;
            return;
        }
        while (true) {
            skip_blank();
            if (here() != '"') {
                syntax("a key in double quotes", here() == '}' ? "remove the comma before the closing brace"
                                                 : is_digit(here())
                                                     ? "write numbers with a decimal point, not with a comma"
                                                     : "write \"key\": value");
            }
            const std::size_t key_offset = offset_;
            std::string key = string("key");
            pointer_ += '/';
            pointer_ += pointer_token(key);
            skip_blank();
            if (here() != ':') {
                syntax("a colon", "write \"key\": value");
            }
            ++offset_;
            skip_blank();
            const auto [member, is_new] = members.try_emplace(std::move(key));
            if (is_new) {
                value(member->second, depth);
            } else {
                report_at(key_offset, Fault::duplicate_key,
                          "the key " + text::in_quotes(member->first) + " occurs twice" + line_of_first(),
                          "a key occurs once in an object", "remove one of the two");
                // Read on to find further faults; what belongs to the second one has no place of its own.
                Value ignored;
                value(ignored, depth);
            }
            pointer_.resize(parent);
            skip_blank();
            if (here() == '}') {
                ++offset_;
                return;
            }
            if (here() != ',') {
                syntax("a comma or a closing brace", "put a comma between two members, and close every brace");
            }
            ++offset_;
        }
    }

    void array(Value& out, std::size_t depth) {
        out = Value::array();
        auto& elements = out.get_ref<Value::array_t&>();
        const std::size_t parent = pointer_.size();
        ++offset_;
        skip_blank();
        if (here() == ']') {
            ++offset_;
            return;
        }
        while (true) {
            skip_blank();
            pointer_ += '/';
            pointer_ += std::to_string(elements.size());
            Value element;
            value(element, depth);
            elements.push_back(std::move(element));
            pointer_.resize(parent);
            skip_blank();
            if (here() == ']') {
                ++offset_;
                return;
            }
            if (here() != ',') {
                syntax("a comma or a closing bracket", "put a comma between two elements, and close every bracket");
            }
            ++offset_;
        }
    }

    std::uint32_t four_digits() {
        std::uint32_t code = 0;
        const std::string_view digits = text_.substr(offset_, 4);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
        if (digits.size() != 4 || error != std::errc{} || end != digits.data() + digits.size()) {
            syntax("four hexadecimal digits after \\u", "write the character itself, or four digits");
        }
        offset_ += 4;
        return code;
    }

    std::string string(std::string_view role) {
        const std::size_t start = offset_;
        ++offset_;
        std::string out;
        while (true) {
            if (at_end()) {
                offset_ = start;
                syntax("a " + std::string{role} + " with a closing double quote", "close the double quote");
            }
            const char c = here();
            if (out.size() > options_.string_bytes) {
                stop_at(start, Fault::string_too_long,
                        "a " + std::string{role} + " of more than " + std::to_string(options_.string_bytes) + " bytes",
                        "a string may have at most " + std::to_string(options_.string_bytes) + " bytes",
                        "shorten it, or put it into a file of its own");
            }
            if (c == '"') {
                ++offset_;
                return out;
            }
            if (static_cast<unsigned char>(c) < 0x20U) {
                syntax("a character of a string", c == '\n' || c == '\r'
                                                      ? "close the double quote in the same line"
                                                      : "write control characters as \\t or \\u0009");
            }
            if (c != '\\') {
                const std::size_t begin = offset_;
                do {
                    // Nearly all characters are of one byte and need no second look.
                    const std::size_t plain = plain_characters();
                    offset_ += plain != 0 ? plain : character();
                } while (!at_end() && here() != '"' && here() != '\\' && static_cast<unsigned char>(here()) >= 0x20U);
                out += text_.substr(begin, offset_ - begin);
                continue;
            }
            ++offset_;
            const char escaped = here();
            ++offset_;
            switch (escaped) {
                case '"':
                case '\\':
                case '/':
                    out += escaped;
                    break;
                case 'b':
                    out += '\b';
                    break;
                case 'f':
                    out += '\f';
                    break;
                case 'n':
                    out += '\n';
                    break;
                case 'r':
                    out += '\r';
                    break;
                case 't':
                    out += '\t';
                    break;
                case 'u':
                    out += text::encode_utf8(escaped_character());
                    break;
                default:
                    offset_ -= 2;
                    syntax("an escape of JSON", "write a backslash as \\\\; in file names use /");
            }
        }
    }

    std::uint32_t escaped_character() {
        const std::size_t start = offset_ - 2;
        std::uint32_t code = four_digits();
        if (code == 0) {
            stop_at(start, Fault::nul_character, "a NUL character (\\u0000) in a string",
                    "a text has no NUL characters", "remove it");
        }
        bool lone = code >= 0xDC00U && code <= 0xDFFFU;
        if (code >= 0xD800U && code <= 0xDBFFU) {
            lone = true;
            if (looking_at("\\u")) {
                offset_ += 2;
                const std::uint32_t low = four_digits();
                if (low >= 0xDC00U && low <= 0xDFFFU) {
                    code = 0x10000U + ((code - 0xD800U) << 10U) + (low - 0xDC00U);
                    lone = false;
                }
            }
        }
        if (lone) {
            stop_at(start, Fault::not_utf8, "half of a surrogate pair in a string",
                    "\\u escapes above \\uD7FF come in pairs", "write the character itself");
        }
        return code;
    }

    void number(Value& out) {
        const std::size_t start = offset_;
        if (here() == '-') {
            ++offset_;
            if (word("Infinity") || word("inf") || word("NaN") || word("nan")) {
                report_at(start, Fault::not_finite,
                          std::string{text_.substr(start, offset_ - start)} + " at " + quoted_pointer(),
                          "a number must be finite", "state the number, or leave the key out");
                out = Value(Value::value_t::discarded);
                return;
            }
        }
        bool is_integer = true;
        const auto digits = [&](const char* expected) {
            if (!is_digit(here())) {
                syntax(expected, "write a number such as -1.5e-6");
            }
            while (is_digit(here())) {
                ++offset_;
            }
        };
        if (here() == '0' && offset_ + 1 < text_.size() && is_digit(text_[offset_ + 1])) {
            syntax("a number without leading zeros", "remove the leading zero");
        }
        digits("a digit");
        if (here() == '.') {
            is_integer = false;
            ++offset_;
            digits("a digit after the decimal point");
        }
        if (here() == 'e' || here() == 'E') {
            is_integer = false;
            ++offset_;
            if (here() == '+' || here() == '-') {
                ++offset_;
            }
            digits("a digit of the exponent");
        }
        const std::string_view token = text_.substr(start, offset_ - start);
        if (is_integer && whole_number(token, out)) {
            return;
        }
        double real = 0.0;
        if (std::from_chars(token.data(), token.data() + token.size(), real).ec != std::errc{}) {
            report_at(start, Fault::number_range, "the number " + text::in_quotes(token) + " at " + quoted_pointer(),
                      "a number must be within the range of double precision, about 1e-307 to 1e308 in magnitude",
                      "check the exponent");
            out = Value(Value::value_t::discarded);
            return;
        }
        if (is_integer && !options_.long_integers && token != text_of_whole(real)) {
            report_at(start, Fault::inexact_integer,
                      "the integer " + text::in_quotes(token) + " at " + quoted_pointer(),
                      "an integer must have an exact value in double precision (up to 9007199254740992 every one has)",
                      "write it with a decimal point if rounding is meant, or as a string if it is a name");
            out = Value(Value::value_t::discarded);
            return;
        }
        out = real;
    }

    /// Whether an integer is one of 64 bits, and may be kept as such.
    bool whole_number(std::string_view token, Value& out) const {
        const auto read = [&](auto& integer) {
            return std::from_chars(token.data(), token.data() + token.size(), integer).ec == std::errc{};
        };
        std::int64_t integer = 0;
        if (read(integer)) {
            constexpr std::int64_t k_two_to_53 = 9007199254740992;
            if (options_.long_integers || (integer >= -k_two_to_53 && integer <= k_two_to_53) ||
                token == text_of_whole(static_cast<double>(integer))) {
                out = integer;
                return true;
            }
            return false;
        }
        std::uint64_t large = 0;
        if (options_.long_integers && read(large)) {
            out = large;
            return true;
        }
        return false;
    }

    /// All digits of a double that is a whole number.
    static std::string text_of_whole(double real) {
        std::array<char, 400> digits{};  // the largest double has 309
        const auto end =
            std::to_chars(digits.data(), digits.data() + digits.size(), real, std::chars_format::fixed, 0).ptr;
        return {digits.data(), end};
    }

    std::string_view text_;
    const ParserOptions& options_;
    const std::function<void(ParsingProblem)>& report_;
    Places* places_;
    text::PlaceFinder finder_;
    std::size_t offset_ = 0;
    std::size_t values_ = 0;
    std::string pointer_;
    std::size_t pointer_bytes_ = 0;
};

}  // namespace

std::optional<nlohmann::json> parse(std::string_view text, const ParserOptions& options,
                                    const std::function<void(ParsingProblem)>& report, Places* places) {
    if (options.byte_order_mark && text.starts_with("\xEF\xBB\xBF")) {
        text.remove_prefix(3);
    }
    std::optional<Value> value(std::in_place);
    try {
        Parser(text, options, report, places).document(*value);
    } catch (const Unreadable&) {
        value.reset();
    }
    return value;
}

std::optional<nlohmann::json> parse_faultless(std::string_view text, const ParserOptions& options) {
    bool faultless = true;
    std::optional<Value> value = parse(text, options, [&](const ParsingProblem&) { faultless = false; });
    if (!faultless) {
        value.reset();
    }
    return value;
}

}  // namespace gumcert::json
