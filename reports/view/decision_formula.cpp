#include "reports/view/decision_formula.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

/// Phrases of the record and their keys in the wording; a phrase stands before those that it contains.
constexpr std::array<std::pair<std::string_view, const char*>, 16> k_phrases = {{
    {"conditional pass: up to the limit", "conditional_pass"},
    {"conditional fail: up to w beyond the limit", "conditional_fail"},
    {"pass: y ± U inside of the limits", "inside"},
    {"fail: y ± U outside", "outside"},
    {"fail: beyond r·U outside of the limits", "beyond"},
    {"else undetermined", "undetermined"},
    {"pass:", "pass"},
    {"fail:", "fail"},
    {"w as agreed", "as_agreed"},
    {"with the population as prior", "prior"},
    {"not below 0", "not_below"},
    {"w ≥ 0 the smallest with", "smallest"},
    {"conditional PFA", "conditional_pfa"},
    {"global PFA", "global_pfa"},
    {", if ", "if"},
    {" and ", "and"},
}};

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> k_symbols = {
    {{"AL", "A_L"}, {"AU", "A_U"}, {"TL", "T_L"}, {"TU", "T_U"}}};

bool is_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// A symbol at this place that is a word of its own: "TU", not the beginning of "TUR".
std::string_view symbol_at(std::string_view text, std::size_t at, std::string_view name) {
    const bool begins = at == 0 || !is_letter(text[at - 1]);
    const bool ends = at + name.size() >= text.size() || !is_letter(text[at + name.size()]);
    return begins && ends && text.substr(at, name.size()) == name ? name : std::string_view{};
}

/// "r = -0.2" with a minus sign; an exponent keeps its hyphen, which words.number() replaces.
std::string with_minus_signs(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool digit = at + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[at + 1])) != 0;
        const bool of_exponent = at > 0 && (text[at - 1] == 'E' || text[at - 1] == 'e');
        out += text[at] == '-' && digit && !of_exponent ? std::string("\u2212") : std::string(1, text[at]);
    }
    return out;
}

}  // namespace

Text decision_formula(const std::string& recorded, const Wording& words) {
    Text out;
    std::string between;
    const auto put = [&](const Text& text) {
        out += words.number(with_minus_signs(between));
        between.clear();
        out += text;
    };
    const std::string_view text = recorded;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t length = 0;
        for (const auto& [phrase, key] : k_phrases) {
            if (length == 0 && text.substr(at, phrase.size()) == phrase) {
                put(words("formula_phrase", key));
                length = phrase.size();
            }
        }
        for (const auto& [name, symbol] : k_symbols) {
            if (length == 0 && !symbol_at(text, at, name).empty()) {
                between += symbol;
                length = name.size();
            }
        }
        if (length == 0) {
            between += text[at++];
        }
        at += length;
    }
    put("");
    return out;
}

}  // namespace gumcert::reports
