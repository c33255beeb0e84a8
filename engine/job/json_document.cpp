#include "engine/job/json_document.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/place.h"
#include "text/utf8.h"
#include "text/visible_text.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <system_error>

namespace gumcert::engine {

namespace {

using nlohmann::json;

/// Unwinds the parser after a problem that makes the rest unreadable; the problem is in the list by then.
struct Unreadable {};

void append_to_pointer(std::string& pointer, std::string_view key) {
    pointer += '/';
    for (const char c : key) {
        if (c == '~') {
            pointer += "~0";
        } else if (c == '/') {
            pointer += "~1";
        } else {
            pointer += c;
        }
    }
}

/// Recursive descent over text that is known to be UTF-8 without NUL.
///
/// Own code, and not nlohmann's, because a message needs the place of every value, and because nlohmann-json lets the
/// last of two equal keys win, reads long integers inexactly and allows block comments.
class Parser {
public:
    Parser(std::string_view text, ProblemList& problems, const JsonLimits& limits, JsonDocument& document)
        : text_(text), problems_(problems), limits_(limits), document_(document), finder_(text) {}

    void document() {
        skip_blank();
        if (at_end()) {
            problems_.refuse(k_empty_file, text::visible(problems_.file()), "the file is empty",
                             "a JSON document has one value", "check the name of the file and its content");
            throw Unreadable{};
        }
        value(document_.value, 0);
        skip_blank();
        if (!at_end()) {
            refuse_here(k_json_trailing_text, "text after the end of the document: " + text::in_quotes(rest()),
                        "a file has one JSON document", "remove the text");
            throw Unreadable{};
        }
    }

private:
    [[nodiscard]] bool at_end() const { return offset_ >= text_.size(); }
    [[nodiscard]] char here() const { return at_end() ? '\0' : text_[offset_]; }
    [[nodiscard]] std::string_view rest() const { return text_.substr(offset_, 12); }
    [[nodiscard]] bool looking_at(std::string_view word) const { return text_.substr(offset_, word.size()) == word; }
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    void refuse_at(std::size_t offset, const InputCode& code, std::string what, std::string rule, std::string action) {
        problems_.refuse(code, text::where_in_text(problems_.file(), finder_.at(offset)), std::move(what),
                         std::move(rule), std::move(action));
    }
    void refuse_here(const InputCode& code, std::string what, std::string rule, std::string action) {
        refuse_at(offset_, code, std::move(what), std::move(rule), std::move(action));
    }
    [[noreturn]] void syntax(const std::string& expected, const std::string& action) {
        refuse_here(
            k_json_syntax,
            (at_end() ? std::string{"the file ends"} : text::in_quotes(rest())) + " where " + expected + " is expected",
            "the file must be JSON (RFC 8259)", action);
        throw Unreadable{};
    }

    void skip_blank() {
        while (!at_end()) {
            const char c = here();
            if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
                ++offset_;
            } else if (looking_at("//")) {
                offset_ = std::min(text_.find('\n', offset_), text_.size());
            } else if (looking_at("/*") || c == '#') {
                refuse_here(k_json_comment,
                            "a comment that begins with " + text::in_quotes(text_.substr(offset_, c == '#' ? 1 : 2)),
                            "only // comments to the end of the line are allowed", "write it as a // comment");
                throw Unreadable{};
            } else {
                return;
            }
        }
    }

    void value(json& out, std::size_t depth) {
        if (++values_ > limits_.values) {
            refuse_here(k_json_too_many_values, "more than " + std::to_string(limits_.values) + " values",
                        "a document may have at most " + std::to_string(limits_.values) + " values",
                        "move tables of numbers to CSV files");
            throw Unreadable{};
        }
        // Long keys around many values would make the table of places far larger than the text.
        constexpr std::size_t k_pointer_bytes = std::size_t{64} << 20U;
        if (pointer_.size() <= k_pointer_bytes - pointer_bytes_) {
            pointer_bytes_ += pointer_.size();
            document_.places.emplace(pointer_, finder_.at(offset_));
        }
        const char c = here();
        if (c == '{' || c == '[') {
            if (depth >= limits_.depth) {
                refuse_here(k_json_depth,
                            "objects and arrays are nested more than " + std::to_string(limits_.depth) + " deep",
                            "the depth is at most " + std::to_string(limits_.depth), "check that the file is a job");
                throw Unreadable{};
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
                    refuse_at(offset_ - name.size(), k_json_not_finite, std::string{name} + " at " + quoted_pointer(),
                              "a number must be finite", "state the number, or leave the key out");
                    out = json(json::value_t::discarded);
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

    void object(json& out, std::size_t depth) {
        out = json::object();
        auto& members = out.get_ref<json::object_t&>();
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
            append_to_pointer(pointer_, key);
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
                const auto first = document_.places.find(pointer_);
                problems_.refuse(
                    k_json_duplicate_key,
                    text::visible(problems_.file()) + "#" + text::visible(pointer_) + " (" +
                        text::line_and_column(finder_.at(key_offset)) + ")",
                    "the key " + text::in_quotes(member->first) + " occurs twice" +
                        (first == document_.places.end() ? std::string{}
                                                         : ", first in line " + std::to_string(first->second.line)),
                    "a key occurs once in an object", "remove one of the two");
                // Read on to find further problems; what belongs to the second one has no place of its own.
                json ignored;
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

    void array(json& out, std::size_t depth) {
        out = json::array();
        auto& elements = out.get_ref<json::array_t&>();
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
            json element;
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
            if (out.size() > limits_.string_bytes) {
                refuse_at(start, k_json_string_too_long,
                          "a " + std::string{role} + " of more than " + std::to_string(limits_.string_bytes) + " bytes",
                          "a string may have at most " + std::to_string(limits_.string_bytes) + " bytes",
                          "shorten it, or put it into a file of its own");
                throw Unreadable{};
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
            ++offset_;
            if (c != '\\') {
                out += c;
                continue;
            }
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
            refuse_at(start, k_nul_character, "a NUL character (\\u0000) in a string", "a text has no NUL characters",
                      "remove it");
            throw Unreadable{};
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
            refuse_at(start, k_not_utf8, "half of a surrogate pair in a string",
                      "\\u escapes above \\uD7FF come in pairs", "write the character itself");
            throw Unreadable{};
        }
        return code;
    }

    void number(json& out) {
        const std::size_t start = offset_;
        if (here() == '-') {
            ++offset_;
            if (word("Infinity") || word("inf") || word("NaN") || word("nan")) {
                refuse_at(start, k_json_not_finite,
                          std::string{text_.substr(start, offset_ - start)} + " at " + quoted_pointer(),
                          "a number must be finite", "state the number, or leave the key out");
                out = json(json::value_t::discarded);
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
        const char* const first = token.data();
        const char* const last = first + token.size();
        double real = 0.0;
        if (std::from_chars(first, last, real).ec != std::errc{}) {
            refuse_at(start, k_json_number_range, "the number " + text::in_quotes(token) + " at " + quoted_pointer(),
                      "a number must be within the range of double precision, about 1e-307 to 1e308 in magnitude",
                      "check the exponent");
            out = json(json::value_t::discarded);
            return;
        }
        if (!is_integer) {
            out = real;
            return;
        }
        std::array<char, 400> exact{};  // the largest double has 309 digits
        const auto exact_end =
            std::to_chars(exact.data(), exact.data() + exact.size(), real, std::chars_format::fixed, 0).ptr;
        if (token != std::string_view(exact.data(), static_cast<std::size_t>(exact_end - exact.data()))) {
            refuse_at(start, k_json_inexact_integer,
                      "the integer " + text::in_quotes(token) + " at " + quoted_pointer(),
                      "an integer must have an exact value in double precision (up to 9007199254740992 every one has)",
                      "write it with a decimal point if rounding is meant, or as a string if it is a name");
            out = json(json::value_t::discarded);
            return;
        }
        std::int64_t integer = 0;
        if (std::from_chars(first, last, integer).ec == std::errc{}) {
            out = integer;
        } else {
            out = real;
        }
    }

    std::string_view text_;
    ProblemList& problems_;
    const JsonLimits& limits_;
    JsonDocument& document_;
    text::PlaceFinder finder_;
    std::size_t offset_ = 0;
    std::size_t values_ = 0;
    std::string pointer_;
    std::size_t pointer_bytes_ = 0;
};

}  // namespace

std::string JsonDocument::where(const std::string& pointer) const {
    std::string shown = text::visible(file) + "#" + text::visible(pointer);
    if (const auto place = places.find(pointer); place != places.end()) {
        shown += " (" + text::line_and_column(place->second) + ")";
    }
    return shown;
}

std::string JsonDocument::number_as_written(const std::string& pointer) const {
    const auto place = places.find(pointer);
    if (place == places.end()) {
        return "";
    }
    std::size_t line_start = 0;
    for (std::size_t line = 1; line < place->second.line; ++line) {
        line_start = text.find('\n', line_start) + 1;
    }
    std::size_t begin = line_start;
    text::PlaceFinder finder(std::string_view{text}.substr(line_start));
    while (finder.at(begin - line_start).column < place->second.column && begin < text.size()) {
        ++begin;
    }
    const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE", begin), text.size());
    return text.substr(begin, end - begin);
}

std::string child_pointer(const std::string& pointer, std::string_view key) {
    std::string child = pointer;
    append_to_pointer(child, key);
    return child;
}

std::string child_pointer(const std::string& pointer, std::size_t index) {
    return pointer + "/" + std::to_string(index);
}

std::optional<JsonDocument> read_json_document(std::string_view bytes, ProblemList& problems,
                                               const JsonLimits& limits) {
    const std::optional<std::string_view> text = check_text(bytes, problems);
    if (!text) {
        return std::nullopt;
    }
    std::optional<JsonDocument> document{JsonDocument{problems.file(), {}, {}, std::string{*text}}};
    try {
        Parser(*text, problems, limits, *document).document();
    } catch (const Unreadable&) {
        return std::nullopt;
    }
    return document;
}

JsonDocument parse_json_document(std::string_view bytes, const std::string& file, const JsonLimits& limits) {
    ProblemList problems(file);
    std::optional<JsonDocument> document = read_json_document(bytes, problems, limits);
    if (problems.refusals() > 0) {
        throw gum::InputError(problems.refused());
    }
    return std::move(*document);
}

std::string described(const nlohmann::json& value) {
    switch (value.type()) {
        case json::value_t::null:
            return "null";
        case json::value_t::boolean:
            return value.get<bool>() ? "true" : "false";
        case json::value_t::string:
            return text::in_quotes(value.get_ref<const std::string&>());
        case json::value_t::discarded:
            return "not a number";
        case json::value_t::object:
            return "an object";
        case json::value_t::array:
            return "an array";
        case json::value_t::number_integer:
            return std::to_string(value.get<std::int64_t>());
        case json::value_t::number_unsigned:
            return std::to_string(value.get<std::uint64_t>());
        default:
            return text::shortest_plain(value.get<double>());
    }
}

JsonObject::JsonObject(const JsonDocument& document, std::string pointer, std::span<const std::string_view> keys,
                       ProblemList& problems)
    : document_(&document),
      pointer_(std::move(pointer)),
      object_(&document.value.at(json::json_pointer(pointer_))),
      keys_(keys),
      problems_(&problems) {
    assert(object_->is_object());
    for (const auto& [key, value] : object_->items()) {
        if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) {
            continue;
        }
        // A key that is there already is not what a misspelt one was meant to be.
        std::vector<std::string_view> absent;
        std::copy_if(keys_.begin(), keys_.end(), std::back_inserter(absent),
                     [&](std::string_view known) { return !object_->contains(known); });
        const std::optional<std::string_view> nearest = nearest_word(key, absent);
        problems_->refuse(k_unknown_key, where(key), "the key " + text::in_quotes(key) + " is not known here",
                          "the keys here are " + text::any_of(keys_),
                          nearest ? "did you mean \"" + std::string{*nearest} + "\"?" : "remove it");
    }
}

std::optional<JsonObject> JsonObject::root(const JsonDocument& document, std::span<const std::string_view> keys,
                                           ProblemList& problems) {
    if (document.value.is_discarded()) {
        return std::nullopt;
    }
    if (!document.value.is_object()) {
        problems.refuse(k_wrong_type, document.where(""), "the document is " + described(document.value),
                        "must be an object", "write { \"key\": value, … }");
        return std::nullopt;
    }
    return JsonObject(document, "", keys, problems);
}

bool JsonObject::has(std::string_view key) const {
    return object_->contains(key);
}

const nlohmann::json* JsonObject::find(std::string_view key) const {
    // An accessor that asks for a key outside the table would contradict the refusal of unknown keys.
    assert(std::find(keys_.begin(), keys_.end(), key) != keys_.end());
    const auto found = object_->find(key);
    return found == object_->end() || found->is_discarded() ? nullptr : &*found;
}

std::string JsonObject::where(std::string_view key) const {
    return has(key) ? document_->where(pointer(key)) : where();
}

bool JsonObject::require(std::string_view key) const {
    if (has(key)) {
        return true;
    }
    problems_->refuse(k_missing_key, where(), "the key " + text::in_quotes(key) + " is missing", "the key is required",
                      "add it");
    return false;
}

void JsonObject::refuse(const InputCode& code, std::string_view key, std::string what, std::string rule,
                        std::string action) const {
    problems_->refuse(code, where(key), std::move(what), std::move(rule), std::move(action));
}

void JsonObject::refuse_type(const std::string& pointer, const json& value, std::string_view expected) const {
    problems_->refuse(k_wrong_type, document_->where(pointer), described(value), "must be " + std::string{expected},
                      value.is_string() && expected.find("number") != std::string_view::npos
                          ? "write the number without quotes"
                          : "correct the value");
}

const nlohmann::json* JsonObject::typed(std::string_view key, json::value_t type, std::string_view expected) const {
    const json* value = find(key);
    if (value != nullptr && value->type() != type) {
        refuse_type(pointer(key), *value, expected);
        return nullptr;
    }
    return value;
}

std::optional<double> JsonObject::number_at(const std::string& pointer, const json& value,
                                            const NumberRange& range) const {
    if (value.is_discarded()) {
        return std::nullopt;
    }
    if (!value.is_number()) {
        refuse_type(pointer, value, "a number");
        return std::nullopt;
    }
    const double number = value.get<double>();
    if (!range.contains(number)) {
        problems_->refuse(k_number_out_of_range, document_->where(pointer), range.with_unit(number), range.rule(),
                          range.action());
        return std::nullopt;
    }
    return number;
}

std::optional<double> JsonObject::optional_number(std::string_view key, const NumberRange& range) const {
    const json* value = find(key);
    return value == nullptr ? std::nullopt : number_at(pointer(key), *value, range);
}

std::optional<double> JsonObject::required_number(std::string_view key, const NumberRange& range) const {
    require(key);
    return optional_number(key, range);
}

std::optional<std::int64_t> JsonObject::optional_integer(std::string_view key, const NumberRange& range) const {
    const json* value = find(key);
    if (value == nullptr) {
        return std::nullopt;
    }
    if (!value->is_number()) {
        refuse_type(pointer(key), *value, "a whole number");
        return std::nullopt;
    }
    // Whole numbers may be written with a point or an exponent: "trials": 1e6. Beyond 2^53 not every one has a double.
    constexpr double k_largest = 9007199254740992.0;
    const double number = value->get<double>();
    if (!(number >= -k_largest && number <= k_largest)) {
        // A double of that size is whole: what is wrong with it is its size, unless the key allows it.
        if (number_at(pointer(key), *value, range)) {
            refuse(k_number_out_of_range, key, range.with_unit(number), "must lie within ±9007199254740992",
                   "write a smaller number");
        }
        return std::nullopt;
    }
    if (number != static_cast<double>(static_cast<std::int64_t>(number))) {
        refuse(k_not_an_integer, key, range.with_unit(number), "must be a whole number",
               "write a number without fraction");
        return std::nullopt;
    }
    if (!number_at(pointer(key), *value, range)) {
        return std::nullopt;
    }
    return static_cast<std::int64_t>(number);
}

std::optional<std::int64_t> JsonObject::required_integer(std::string_view key, const NumberRange& range) const {
    require(key);
    return optional_integer(key, range);
}

std::optional<bool> JsonObject::optional_boolean(std::string_view key) const {
    const json* value = typed(key, json::value_t::boolean, "true or false");
    return value == nullptr ? std::nullopt : std::optional<bool>{value->get<bool>()};
}

std::optional<std::string> JsonObject::optional_string(std::string_view key) const {
    const json* value = typed(key, json::value_t::string, "a string");
    return value == nullptr ? std::nullopt : std::optional<std::string>{value->get<std::string>()};
}

std::optional<std::string> JsonObject::required_string(std::string_view key) const {
    require(key);
    return optional_string(key);
}

std::optional<std::string> JsonObject::optional_name(std::string_view key, std::size_t longest) const {
    std::optional<std::string> text = optional_string(key);
    if (text) {
        if (const auto objection = name_objection(*text, longest)) {
            refuse(k_text_not_allowed, key, text::in_quotes(*text) + " " + *objection,
                   "must be one line of at most " + std::to_string(longest) +
                       " bytes, without spaces around it and without control or hidden characters",
                   "correct the text");
            return std::nullopt;
        }
    }
    return text;
}

std::optional<std::string> JsonObject::required_name(std::string_view key, std::size_t longest) const {
    require(key);
    return optional_name(key, longest);
}

std::optional<JsonObject> JsonObject::optional_object(std::string_view key,
                                                      std::span<const std::string_view> keys) const {
    if (typed(key, json::value_t::object, "an object") == nullptr) {
        return std::nullopt;
    }
    return JsonObject(*document_, pointer(key), keys, *problems_);
}

std::optional<JsonObject> JsonObject::required_object(std::string_view key,
                                                      std::span<const std::string_view> keys) const {
    require(key);
    return optional_object(key, keys);
}

const nlohmann::json* JsonObject::optional_array(std::string_view key) const {
    return typed(key, json::value_t::array, "an array");
}

const nlohmann::json* JsonObject::required_array(std::string_view key) const {
    require(key);
    return optional_array(key);
}

std::optional<std::vector<double>> JsonObject::required_numbers(std::string_view key, std::size_t size,
                                                                const NumberRange& range) const {
    const json* array = required_array(key);
    if (array == nullptr) {
        return std::nullopt;
    }
    if (array->size() != size) {
        refuse(k_wrong_size, key, "an array of " + std::to_string(array->size()) + " elements",
               "must have " + std::to_string(size) + " numbers", "correct the array");
        return std::nullopt;
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < size; ++i) {
        if (const auto number = number_at(child_pointer(pointer(key), i), (*array)[i], range)) {
            numbers.push_back(*number);
        }
    }
    return numbers.size() == size ? std::optional{std::move(numbers)} : std::nullopt;
}

std::optional<std::size_t> JsonObject::choice_index(std::string_view key,
                                                    std::span<const std::string_view> words) const {
    const std::optional<std::string> text = optional_string(key);
    if (!text) {
        return std::nullopt;
    }
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found == words.end()) {
        const std::optional<std::string_view> nearest = nearest_word(*text, words);
        refuse(k_unknown_choice, key, text::in_quotes(*text), "must be " + text::any_of(words),
               nearest ? "did you mean \"" + std::string{*nearest} + "\"?" : "choose one of them");
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - words.begin());
}

}  // namespace gumcert::engine
