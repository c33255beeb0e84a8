#include "text/csv_field.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "text/plus_sign.h"

namespace gumcert::text {

namespace {

bool is_number(std::string_view text) {
    text = without_plus(text);
    double v = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    return error == std::errc() && end == text.data() + text.size();
}

/// The signs that begin a formula; spreadsheets of East Asian languages know their wide forms, too.
bool begins_formula(std::string_view text) {
    static constexpr std::array<std::string_view, 8> k_signs = {"=", "+", "-", "@", "＝", "＋", "－", "＠"};
    return std::any_of(k_signs.begin(), k_signs.end(), [&](std::string_view s) { return text.starts_with(s); });
}

std::string harmless(const std::string& text) {
    static constexpr std::string_view k_separators = ",;\t\r\n";
    if (text.size() <= 1 || is_number(text)) {
        return text == "=" || text == "@" ? "'" + text : text;
    }
    std::string out;
    bool at_start = true;  // of the text, or behind what may be a separator
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool separates = k_separators.find(text[i]) != std::string_view::npos;
        if (at_start && (begins_formula(std::string_view(text).substr(i)) || (i == 0 && separates))) {
            out += '\'';
        }
        out += text[i];
        at_start = separates;
    }
    return out;
}

std::string in_quotes(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        out += c == '"' ? "\"\"" : std::string(1, c);
    }
    return out + '"';
}

}  // namespace

std::string csv_field(const std::string& text) {
    const std::string shown = harmless(text);
    return shown.find_first_of(",;\"\t\r\n") == std::string::npos ? shown : in_quotes(shown);
}

std::string quoted_csv_field(const std::string& text) {
    return in_quotes(harmless(text));
}

}  // namespace gumcert::text
