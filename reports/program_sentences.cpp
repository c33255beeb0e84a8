#include "reports/program_sentences.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms_of_number.h"
#include "reports/wording.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace gumcert::reports {

namespace {

using nlohmann::json;

constexpr int k_most_steps = 2000;        // of matching one text with one pattern
constexpr std::size_t k_longest = 20000;  // of a text that is looked up; a longer one stays as it is

/// `count`: a number that a form of number stands beside, "{points} {points?point|points}".
enum class Kind { text, number, count, sentence, list };

struct Placeholder {
    std::string name;
    Kind kind = Kind::text;
};

/// "a {x} b" as its literals, one more than its placeholders.
struct Pieces {
    std::vector<std::string> literals;
    std::vector<Placeholder> placeholders;
};

[[noreturn]] void refuse(const std::string& id, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0001",
                                            .where = "wording/sentences.json#/" + id,
                                            .what = what,
                                            .rule = "every sentence of the program has a text in each language",
                                            .action = "take the templates of this release"});
}

Pieces pieces_of(const std::string& id, const std::string& pattern) {
    Pieces pieces;
    std::string literal;
    std::size_t at = 0;
    while (true) {
        // find_first_of() takes five times as long where it looks for two bytes.
        const auto brace = std::find_if(pattern.begin() + static_cast<std::ptrdiff_t>(at), pattern.end(),
                                        [](char c) { return c == '{' || c == '}'; });
        const std::size_t open =
            brace == pattern.end() ? std::string::npos : static_cast<std::size_t>(brace - pattern.begin());
        literal += pattern.substr(at, open == std::string::npos ? open : open - at);
        if (open == std::string::npos) {
            pieces.literals.push_back(literal);
            return pieces;
        }
        if (open + 1 < pattern.size() && pattern[open + 1] == pattern[open]) {  // "{{" is a brace
            literal += pattern[open];
            at = open + 2;
            continue;
        }
        const std::size_t close = pattern.find('}', open);
        if (pattern[open] == '}' || close == std::string::npos) {
            refuse(id, "a brace that does not close");
        }
        const std::string inside = pattern.substr(open + 1, close - open - 1);
        const std::size_t colon = inside.find(':');
        const std::string kind = colon == std::string::npos ? "" : inside.substr(colon + 1);
        if (!kind.empty() && kind != "number" && kind != "sentence" && kind != "list") {
            refuse(id, "the kind \"" + kind + "\" of a placeholder");
        }
        pieces.literals.push_back(std::exchange(literal, {}));
        pieces.placeholders.push_back({.name = inside.substr(0, colon),
                                       .kind = kind.empty()       ? Kind::text
                                               : kind == "number" ? Kind::number
                                               : kind == "list"   ? Kind::list
                                                                  : Kind::sentence});
        at = close + 1;
    }
}

/// For each pattern that forms of number make of one, the names of the values that are 1 in it.
/// \param counted  the names that its English text has forms of
std::vector<std::set<std::string>> which_are_one(const std::vector<std::string>& counted) {
    std::vector<std::set<std::string>> all(1);
    for (const std::string& name : counted) {
        for (std::size_t i = all.size(); i-- > 0;) {
            std::set<std::string> with_it = all[i];
            with_it.insert(name);
            all.push_back(std::move(with_it));
        }
    }
    return all;
}

/// Whether a text begins as numbers do. "−" and "∞" are no single bytes.
bool may_be_number(std::string_view text) {
    for (const std::string_view sign : {"-", "\u2212", "+", "<", ">", "±", "≤", "≥"}) {
        if (text.starts_with(sign)) {
            text.remove_prefix(sign.size());
        }
    }
    while (text.starts_with(' ')) {
        text.remove_prefix(1);
    }
    return !text.empty() && ((text.front() >= '0' && text.front() <= '9') || text.starts_with("∞"));
}

/// Whether a text is a number alone: of "36 points; 1.03 for 108" nothing counts points.
bool may_be_count(std::string_view text) {
    return may_be_number(text) && std::none_of(text.begin(), text.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == ';';
           });
}

/// The text of every placeholder, each as short as it can be; false where the pattern does not fit.
/// \param steps  what is left to try: a text that somebody made to keep the program busy is given up
bool match(const Pieces& pieces, std::string_view text, std::size_t i, std::vector<std::string>& values, int& steps) {
    if (--steps < 0 || !text.starts_with(pieces.literals[i])) {
        return false;
    }
    text.remove_prefix(pieces.literals[i].size());
    if (i == pieces.placeholders.size()) {
        return text.empty();
    }
    const std::string& next = pieces.literals[i + 1];
    const bool last = i + 1 == pieces.placeholders.size();
    const auto take = [&](std::size_t length) {
        const std::string_view value = text.substr(0, length);
        const bool is_number = pieces.placeholders[i].kind == Kind::number;
        const bool is_count = pieces.placeholders[i].kind == Kind::count;
        if (value.empty() || (is_number && (!may_be_number(value) || value.find("; ") != std::string_view::npos)) ||
            (is_count && !may_be_count(value))) {
            return false;
        }
        values.emplace_back(value);
        if (match(pieces, text.substr(length), i + 1, values, steps)) {
            return true;
        }
        values.pop_back();
        return false;
    };
    if (last) {  // all that is left, before the closing literal
        return text.size() >= next.size() && text.ends_with(next) && take(text.size() - next.size());
    }
    for (std::size_t at = text.find(next); at != std::string_view::npos; at = text.find(next, at + 1)) {
        if (take(at)) {
            return true;
        }
    }
    return false;
}

/// Ends of sentences inside of a text: place behind the sentence, and length of what joins it to the next.
std::vector<std::pair<std::size_t, std::size_t>> joints(const std::string& text) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t i = 0; i + 2 < text.size(); ++i) {
        if (text[i] == '.' && text[i + 1] == ' ') {
            found.emplace_back(i + 1, 1);  // the full stop is part of the sentence
        } else if (text[i] == ';' && text[i + 1] == ' ') {
            found.emplace_back(i, 2);
        }
    }
    return found;
}

/// "… end. Begin …"
bool holds_end_of_sentence(const std::string& value) {
    for (std::size_t at = value.find(". "); at != std::string::npos; at = value.find(". ", at + 1)) {
        if (at + 2 < value.size() && value[at + 2] >= 'A' && value[at + 2] <= 'Z') {
            return true;
        }
    }
    return false;
}

}  // namespace

struct ProgramSentences::Pattern {
    std::string id;
    Pieces english;
    std::size_t letters = 0;                     ///< of the literals
    std::map<std::string, Pieces> translations;  ///< by language
};

struct ProgramSentences::Found {
    const Pattern* pattern = nullptr;
    std::vector<std::string> values;
};

ProgramSentences::ProgramSentences(ProgramSentences&&) noexcept = default;
ProgramSentences& ProgramSentences::operator=(ProgramSentences&&) noexcept = default;
ProgramSentences::~ProgramSentences() = default;

ProgramSentences::ProgramSentences(const json& catalogue) {
    std::vector<Pattern> patterns;
    for (const auto& [id, texts] : catalogue.items()) {
        if (!texts.is_object() || !texts.contains("en")) {
            refuse(id, "no English text");
        }
        const json& in_english = texts.at("en");
        const std::vector<std::string> counted =
            in_english.is_string() ? names_with_forms(in_english.get<std::string>()) : std::vector<std::string>();
        for (const std::set<std::string>& ones : which_are_one(counted)) {
            Pattern pattern{.id = id, .english = {}, .translations = {}};
            for (const auto& [language, text] : texts.items()) {
                if (!text.is_string()) {
                    refuse(id + "/" + language, "no text");
                }
                Pieces pieces = pieces_of(id, with_forms_of(text.get<std::string>(), [&](const std::string& name) {
                                              return ones.contains(name);
                                          }));
                if (language == "en") {
                    for (Placeholder& placeholder : pieces.placeholders) {
                        const bool counts =
                            std::find(counted.begin(), counted.end(), placeholder.name) != counted.end();
                        placeholder.kind = counts && placeholder.kind == Kind::text ? Kind::count : placeholder.kind;
                    }
                    pattern.english = std::move(pieces);
                } else {
                    pattern.translations.emplace(language, std::move(pieces));
                }
            }
            for (const std::string& literal : pattern.english.literals) {
                pattern.letters += literal.size();
            }
            for (std::size_t i = 0; i + 1 < pattern.english.placeholders.size(); ++i) {
                if (pattern.english.literals[i + 1].empty()) {
                    refuse(id, "two placeholders beside each other");
                }
            }
            patterns.push_back(std::move(pattern));
        }
    }
    std::stable_sort(patterns.begin(), patterns.end(),
                     [](const Pattern& a, const Pattern& b) { return a.letters > b.letters; });
    patterns_ = std::make_unique<const std::vector<Pattern>>(std::move(patterns));
}

/// Whether a value reaches into the next sentence: "36 points of the direction z; 1.03 for 108 points", where the direction is z.
bool ProgramSentences::holds_another(const Found& found) const {
    for (std::size_t i = 0; i < found.values.size(); ++i) {
        const std::string& value = found.values[i];
        if (holds_end_of_sentence(value)) {
            return true;
        }
        const Kind kind = found.pattern->english.placeholders[i].kind;
        if (kind == Kind::sentence || kind == Kind::list) {
            continue;
        }
        // A value that somebody made of hundreds of such signs is taken as it is behind the first of them.
        constexpr int k_most_looked_at = 16;
        int looked_at = 0;
        for (std::size_t at = value.find("; "); at != std::string::npos && looked_at < k_most_looked_at;
             at = value.find("; ", at + 1), ++looked_at) {
            const std::string_view behind = std::string_view(value).substr(at + 2);
            const bool may_begin_with_number = may_be_number(behind);
            const bool is_sentence = std::any_of(patterns_->begin(), patterns_->end(), [&](const Pattern& pattern) {
                const Pieces& pieces = pattern.english;
                if (pieces.literals.front().empty() &&
                    (pieces.placeholders.empty() || pieces.placeholders.front().kind == Kind::text ||
                     !may_begin_with_number)) {
                    return false;  // what begins with a name may be anything
                }
                std::vector<std::string> values;
                int steps = k_most_steps;
                return pattern.letters <= behind.size() && match(pieces, behind, 0, values, steps);
            });
            if (is_sentence) {
                return true;
            }
        }
    }
    return false;
}

std::optional<ProgramSentences::Found> ProgramSentences::find(const std::string& text) const {
    const auto first_match = [this](const std::string& sentence, bool within_one) {
        std::optional<Found> result;
        for (const Pattern& pattern : *patterns_) {
            Found found{.pattern = &pattern, .values = {}};
            int steps = k_most_steps;
            if (pattern.letters <= sentence.size() && match(pattern.english, sentence, 0, found.values, steps) &&
                (!within_one || !holds_another(found))) {
                result = std::move(found);
                break;
            }
        }
        return result;
    };
    if (std::optional<Found> found = first_match(text, true)) {
        return found;
    }
    // A value may hold a full stop ("A. Miller"), but not where the text is several sentences.
    for (const auto& [length, joint] : joints(text)) {
        if (first_match(text.substr(0, length), true)) {
            return std::nullopt;
        }
    }
    return first_match(text, false);
}

/// The text as sentences of the catalogue, with what joins them and what is not in it between.
std::vector<std::pair<std::string, std::optional<ProgramSentences::Found>>> ProgramSentences::parts(
    const std::string& text) const {
    using Part = std::pair<std::string, std::optional<Found>>;
    if (text.empty() || text.size() > k_longest) {
        return {Part(text, std::nullopt)};
    }
    std::vector<Part> all;
    std::string rest = text;
    while (!rest.empty()) {
        if (std::optional<Found> whole = find(rest)) {
            all.emplace_back(rest, std::move(whole));
            break;
        }
        const auto ends = joints(rest);
        bool any = false;
        for (auto end = ends.rbegin(); end != ends.rend() && !any; ++end) {  // the longest sentence first
            const auto& [length, joint] = *end;
            if (std::optional<Found> sentence = find(rest.substr(0, length))) {
                all.emplace_back(rest.substr(0, length), std::move(sentence));
                all.emplace_back(rest.substr(length, joint), std::nullopt);
                rest.erase(0, length + joint);
                any = true;
            }
        }
        if (!any) {
            const std::size_t length = ends.empty() ? rest.size() : ends.front().first + ends.front().second;
            all.emplace_back(rest.substr(0, length), std::nullopt);
            rest.erase(0, length);
        }
    }
    return all;
}

std::optional<std::vector<IdentifiedSentence>> ProgramSentences::identified(const std::string& english) const {
    std::vector<IdentifiedSentence> sentences;
    for (const auto& [text, found] : parts(english)) {
        if (!found) {
            if (text == " " || text == "; ") {
                continue;
            }
            return std::nullopt;
        }
        IdentifiedSentence sentence{.id = found->pattern->id, .arguments = {}, .text = text};
        for (std::size_t i = 0; i < found->values.size(); ++i) {
            sentence.arguments.push_back(
                {.name = found->pattern->english.placeholders[i].name, .value = found->values[i]});
        }
        sentences.push_back(std::move(sentence));
    }
    return sentences;
}

std::string ProgramSentences::worded_list(const std::string& english, const std::string& language,
                                          const std::string& sign) const {
    // Between semicolons a comma is part of a name, such as that of the point "1 V, 50 Hz".
    const bool between_semicolons = english.find("; ") != std::string::npos;
    const std::string_view separator = between_semicolons ? "; " : ", ";
    std::string out;
    for (std::size_t at = 0; at <= english.size();) {
        const std::size_t end = std::min(english.find(separator, at), english.size());
        const std::string item = english.substr(at, end - at);
        const bool known = find(item).has_value();
        out += (at == 0                 ? ""
                : language == "en"      ? std::string(separator)
                : language == "zh-Hant" ? (between_semicolons ? "；" : "、")
                                        : "; ") +
               (known                 ? worded(item, language, sign)
                : may_be_number(item) ? with_decimal_sign(with_minus_of_numbers(item), sign)
                                      : item);
        at = end + separator.size();
    }
    return out;
}

std::string ProgramSentences::worded(const std::string& english, const std::string& language,
                                     const std::string& sign) const {
    const bool as_it_is = language == "en";
    if (as_it_is && with_minus_of_numbers(english) == english && english.find("= <") == std::string::npos) {
        return english;
    }
    std::string out;
    for (const auto& [text, found] : parts(english)) {
        if (!found) {
            // Chinese sentences are not set apart by blanks.
            const bool after_full_stop = text == " " && out.ends_with("。");
            out += after_full_stop ? "" : text == "; " && language == "zh-Hant" ? "；" : text;
            continue;
        }
        const auto wording = found->pattern->translations.find(language);
        if (!as_it_is && wording == found->pattern->translations.end()) {
            out += text;
            continue;
        }
        const std::vector<Placeholder>& names = found->pattern->english.placeholders;
        const Pieces& pieces = as_it_is ? found->pattern->english : wording->second;
        for (std::size_t i = 0; i < pieces.literals.size(); ++i) {
            out += pieces.literals[i];
            if (i == pieces.placeholders.size()) {
                break;
            }
            const auto name = std::find_if(names.begin(), names.end(),
                                           [&](const Placeholder& p) { return p.name == pieces.placeholders[i].name; });
            if (name == names.end()) {
                refuse(found->pattern->id + "/" + language,
                       "names a value {" + pieces.placeholders[i].name + "} that does not exist");
            }
            const std::string& value = found->values[static_cast<std::size_t>(name - names.begin())];
            const bool is_numeric = name->kind == Kind::number || name->kind == Kind::count;
            append_value(out, is_numeric                     ? with_decimal_sign(with_minus_of_numbers(value), sign)
                              : name->kind == Kind::sentence ? worded(value, language, sign)
                              : name->kind == Kind::list     ? worded_list(value, language, sign)
                                                             : value);
        }
    }
    return out;
}

}  // namespace gumcert::reports
