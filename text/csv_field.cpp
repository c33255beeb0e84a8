#include "text/csv_field.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "text/plus_sign.h"
#include "text/small_letters.h"

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

std::optional<SeparatorLine> separator_line(std::string_view text) {
    std::string_view line = text.substr(0, std::min(text.find_first_of("\r\n"), text.size()));
    const std::size_t length = line.size();
    // A spreadsheet that stores what it has read with it as a row writes "sep=;", in quotes, or one separator for each column.
    const bool is_quoted = line.size() > 2 && line.front() == '"' && line.back() == '"';
    if (is_quoted) {
        line = line.substr(1, line.size() - 2);
    }
    constexpr std::string_view k_name = "sep=";
    constexpr std::string_view k_separators = ",;\t|";
    if (line.size() <= k_name.size() || in_small_letters(line.substr(0, k_name.size())) != k_name) {
        return std::nullopt;
    }
    const char separator = line[k_name.size()];
    if (k_separators.find(separator) == std::string_view::npos ||
        line.find_first_not_of(separator, k_name.size()) != std::string_view::npos) {
        return std::nullopt;
    }
    return SeparatorLine{separator, length};
}

}  // namespace gumcert::text
