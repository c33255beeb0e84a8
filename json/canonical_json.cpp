#include "json/canonical_json.h"

#include "gum/quantity/diagnostic.h"
#include "json/step.h"
#include "json/strict_parser.h"
#include "text/utf8.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gumcert::json {

namespace {

using Value = nlohmann::json;

/// What is written can be read again.
constexpr std::size_t k_deepest = ParserOptions{}.depth;

[[noreturn]] void refuse(std::string code, const Step& at, std::string what, std::string rule) {
    throw gum::NoResultError(gum::Diagnostic{.code = std::move(code),
                                             .where = "record#" + at.pointer(),
                                             .what = std::move(what),
                                             .rule = std::move(rule),
                                             .action = "nothing was written; check the input that leads to it"});
}

class Writer {
public:
    std::string text;

    void value(const Value& v, const Step& at, std::size_t depth) {
        if (depth > k_deepest) {
            refuse("GC-RECORD-0004", at, "nested deeper than " + std::to_string(k_deepest) + " levels",
                   "a record is at most that deep");
        }
        switch (v.type()) {
            case Value::value_t::object:
                object(v, at, depth);
                return;
            case Value::value_t::array:
                array(v, at, depth);
                return;
            case Value::value_t::string:
                string(v.get_ref<const std::string&>(), at);
                return;
            case Value::value_t::boolean:
                text += v.get<bool>() ? "true" : "false";
                return;
            case Value::value_t::number_integer:
                number(v.get<std::int64_t>());
                return;
            case Value::value_t::number_unsigned:
                number(v.get<std::uint64_t>());
                return;
            case Value::value_t::number_float:
                real(v.get<double>(), at);
                return;
            case Value::value_t::null:
                text += "null";
                return;
            case Value::value_t::binary:
            case Value::value_t::discarded:
                break;
        }
        refuse("GC-RECORD-0003", at, "a value that JSON cannot hold", "a record is JSON");
    }

private:
    template <class Number>
    void number(Number v) {
        char buffer[32];
        const auto end = std::to_chars(buffer, buffer + sizeof buffer, v).ptr;
        text.append(buffer, end);
    }

    void real(double v, const Step& at) {
        if (!std::isfinite(v)) {
            refuse("GC-RECORD-0001", at, std::isnan(v) ? "not a number (NaN)" : "infinite",
                   "every number of a record is finite");
        }
        if (v == 0.0 && std::signbit(v)) {
            text += "-0.0";  // "-0" would be read back as the integer 0 and lose its sign
            return;
        }
        constexpr double k_two_to_53 = 9007199254740992.0;
        if (std::abs(v) >= k_two_to_53) {
            // With an exponent, so that a reader never takes it for a whole number with more digits than a double
            // holds.
            char buffer[32];
            const auto end = std::to_chars(buffer, buffer + sizeof buffer, v, std::chars_format::scientific).ptr;
            text.append(buffer, end);
            return;
        }
        number(v);
    }

    void string(std::string_view s, const Step& at) {
        if (!text::is_utf8(s)) {
            refuse("GC-RECORD-0002", at, "text that is not valid UTF-8", "texts of a record are UTF-8");
        }
        text += '"';
        std::size_t written = 0;  // most texts have nothing to escape
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (is_escaped(s[i])) {
                text.append(s, written, i - written);
                escape(s[i]);
                written = i + 1;
            }
        }
        text.append(s, written, s.size() - written);
        text += '"';
    }

    static bool is_escaped(char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7F || c == '"' || c == '\\';
    }

    void escape(char c) {
        static constexpr char k_hex[] = "0123456789abcdef";
        switch (c) {
            case '"':
                text += "\\\"";
                break;
            case '\\':
                text += "\\\\";
                break;
            case '\b':
                text += "\\b";
                break;
            case '\f':
                text += "\\f";
                break;
            case '\n':
                text += "\\n";
                break;
            case '\r':
                text += "\\r";
                break;
            case '\t':
                text += "\\t";
                break;
            default:
                text += "\\u00";
                text += k_hex[static_cast<unsigned char>(c) >> 4U];
                text += k_hex[static_cast<unsigned char>(c) & 0xFU];
        }
    }

    void new_line(std::size_t depth) {
        text += '\n';
        text.append(depth, ' ');
    }

    void object(const Value& v, const Step& at, std::size_t depth) {
        if (v.empty()) {
            text += "{}";
            return;
        }
        text += '{';
        bool first = true;
        for (const auto& [key, item] : v.items()) {  // a std::map: sorted by bytes, which for UTF-8 is by code point
            if (!first) {
                text += ',';
            }
            first = false;
            new_line(depth + 1);
            string(key, at);
            text += ": ";
            value(item, at.child(key), depth + 1);
        }
        new_line(depth);
        text += '}';
    }

    void array(const Value& v, const Step& at, std::size_t depth) {
        bool plain = true;
        for (const Value& item : v) {
            plain = plain && !item.is_structured();
        }
        text += '[';
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (plain) {
                text += i == 0 ? "" : ", ";
            } else {
                text += i == 0 ? "" : ",";
                new_line(depth + 1);
            }
            value(v[i], at.child(i), depth + 1);
        }
        if (!plain) {
            new_line(depth);
        }
        text += ']';
    }
};

}  // namespace

std::string canonical_json(const nlohmann::json& value) {
    Writer writer;
    writer.value(value, {}, 0);
    writer.text += '\n';
    return std::move(writer.text);
}

}  // namespace gumcert::json
