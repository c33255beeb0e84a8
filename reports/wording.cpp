#include "reports/wording.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms_of_number.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace gumcert::reports {

namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& language, const std::string& pointer, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0001",
                                            .where = "wording " + language + "#" + pointer,
                                            .what = what,
                                            .rule = "every text of a document is in the wording file",
                                            .action = "take the templates of this release"});
}

std::string pointer_of(const std::vector<std::string>& path) {
    std::string pointer;
    for (const std::string& name : path) {
        pointer += "/" + name;
    }
    return pointer;
}

/// The text with this path; none where it is missing or no text.
const json* find(const json& texts, const std::vector<std::string>& path) {
    const json* at = &texts;
    for (const std::string& name : path) {
        const auto found = at->is_object() ? at->find(name) : at->end();
        if (!at->is_object() || found == at->end()) {
            return nullptr;
        }
        at = &*found;
    }
    return at->is_string() ? at : nullptr;
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

}  // namespace

std::string with_power_of_ten(const std::string& text) {
    static constexpr std::array<const char*, 10> k_raised = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t first = i + 1 < text.size() && (text[i + 1] == '-' || text[i + 1] == '+') ? i + 2 : i + 1;
        if (text[i] != 'E' || i == 0 || !is_digit(i - 1) || !is_digit(first)) {
            out += text[i];
            continue;
        }
        std::size_t end = first;
        while (is_digit(end)) {
            ++end;
        }
        std::size_t mantissa = out.size();
        while (mantissa > 0 && (out[mantissa - 1] == '.' || (out[mantissa - 1] >= '0' && out[mantissa - 1] <= '9'))) {
            --mantissa;
        }
        if (out.find_first_not_of("0.", mantissa) == std::string::npos) {
            out.replace(mantissa, std::string::npos, "0");  // whatever the power: a value of 0 beside U = 4.8 × 10²
        } else {
            out += "\u00A0×\u00A010";
            out += text[first - 1] == '-' ? "⁻" : "";
            for (std::size_t digit = first; digit < end; ++digit) {
                out += k_raised.at(static_cast<std::size_t>(text[digit] - '0'));
            }
        }
        i = end - 1;
    }
    return out;
}

std::string with_minus_of_numbers(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool begins = i == 0 || (text[i - 1] == ' ' && i + 1 < text.size() && is_digit(text[i + 1]));
        out += begins && text[i] == '-' ? std::string("\u2212") : std::string(1, text[i]);
    }
    return out;
}

void append_value(std::string& text, const std::string& value) {
    constexpr std::string_view k_equal = "= ";
    if (!text.ends_with(k_equal) || value.size() < 2 || (value[0] != '<' && value[0] != '>') || !is_digit(value[1])) {
        text += value;
        return;
    }
    text.erase(text.size() - k_equal.size());
    text += value.substr(0, 1) + " " + value.substr(1);
}

std::string with_decimal_sign(const std::string& text, const std::string& sign) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool point =
            text[i] == '.' && i > 0 && i + 1 < text.size() && is_digit(text[i - 1]) && is_digit(text[i + 1]);
        out += point ? sign : std::string(1, text[i]);
    }
    return out;
}

Wording::Wording(nlohmann::json texts) : all_(std::make_shared<const json>(std::move(texts))) {
    if (all_->is_array()) {
        for (const json& one : *all_) {
            texts_.push_back(&one);
        }
    } else {
        texts_.push_back(all_.get());
    }
    for (const json* one : texts_) {
        const json* language = find(*one, {"language"});
        languages_.push_back(language == nullptr ? "" : language->get<std::string>());
        const json* sign = find(*one, {"document", "decimal_sign"});
        signs_.push_back(sign == nullptr ? "." : sign->get<std::string>());
    }
    if (texts_.empty()) {
        refuse("", "", "no language");
    }
    if (const auto catalogue = texts_.front()->find(k_sentences_key); catalogue != texts_.front()->end()) {
        sentences_ = std::make_shared<const ProgramSentences>(*catalogue);
    }
}

Text Wording::text_of(const std::vector<std::string>& path) const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < texts_.size(); ++i) {
        const json* text = find(*texts_[i], path);
        if (text == nullptr) {
            refuse(languages_[i], pointer_of(path), "missing");
        }
        all.push_back(text->get<std::string>());
    }
    return Text(std::move(all));
}

const json& Wording::group(const std::string& name) const {
    const auto found = texts_.front()->find(name);
    if (found == texts_.front()->end() || !found->is_object()) {
        refuse(language(), pointer_of({name}), "missing");
    }
    return *found;
}

Text Wording::operator()(const std::string& group, const std::string& name) const {
    return text_of({group, name});
}

Text Wording::operator()(const std::string& group, const std::string& name, const std::string& item) const {
    return text_of({group, name, item});
}

bool Wording::has(const std::string& group, const std::string& name) const {
    return std::all_of(texts_.begin(), texts_.end(), [&](const json* texts) {
        const json* const text = find(*texts, {group, name});
        return text != nullptr && text->is_string() &&
               text->get_ref<const std::string&>().find('{') == std::string::npos;
    });
}

Text Wording::filled(const std::string& group, const std::string& name, const Values& values) const {
    const Text pattern = (*this)(group, name);
    std::vector<std::string> all;
    for (std::size_t language = 0; language < texts_.size(); ++language) {
        const auto value_of = [&](const std::string& key) -> const std::string& {
            const auto value =
                std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == key; });
            if (value == values.end()) {
                refuse(languages_[language], "/" + group + "/" + name,
                       "names a value {" + key + "} that does not exist");
            }
            return value->second.in(language);
        };
        const std::string text =
            with_forms_of(pattern.in(language), [&](const std::string& key) { return value_of(key) == "1"; });
        std::string out;
        std::size_t at = 0;
        while (at < text.size()) {
            const std::size_t open = text.find('{', at);
            const std::size_t close = open == std::string::npos ? open : text.find('}', open);
            if (close == std::string::npos) {
                out += text.substr(at);
                break;
            }
            out += text.substr(at, open - at);
            append_value(out, value_of(text.substr(open + 1, close - open - 1)));
            at = close + 1;
        }
        all.push_back(std::move(out));
    }
    return Text(std::move(all));
}

Text Wording::number(const std::string& printed) const {
    const std::string text = with_power_of_ten(with_minus_of_numbers(printed));
    std::vector<std::string> all;
    for (const std::string& sign : signs_) {
        all.push_back(with_decimal_sign(text, sign));
    }
    return Text(std::move(all));
}

Text Wording::sentence(const std::string& english) const {
    if (!sentences_ || english.empty()) {
        return english;
    }
    std::vector<std::string> all;
    for (std::size_t i = 0; i < languages_.size(); ++i) {
        all.push_back(sentences_->worded(english, languages_[i], signs_[i]));
    }
    return Text(std::move(all));
}

Text Wording::sentence(const std::string& english, const Text& otherwise) const {
    const Text worded = sentence(english);
    if (!sentences_ || sentences_->identified(english)) {
        return worded;
    }
    std::vector<std::string> all;
    for (std::size_t i = 0; i < languages_.size(); ++i) {
        all.push_back((languages_[i] == "en" ? worded : otherwise).in(i));
    }
    return Text(std::move(all));
}

std::optional<std::string> Wording::pattern(std::string_view english) const {
    const json* text = find(*texts_.front(), {k_patterns_key, std::string(english), language()});
    return text == nullptr ? std::nullopt : std::optional(text->get<std::string>());
}

Text Wording::message(const gum::Diagnostic& diagnostic) const {
    Text text;
    for (const std::string* part : {&diagnostic.where, &diagnostic.what, &diagnostic.rule, &diagnostic.action}) {
        if (!part->empty()) {
            text += (text.empty() ? Text() : Text(" — ")) + sentence(*part);
        }
    }
    return text;
}

Text Wording::localised(const certificate::LocalisedText& text) const {
    std::vector<std::string> all;
    for (const std::string& language : languages_) {
        all.push_back(text.in(language));
    }
    return Text(std::move(all));
}

}  // namespace gumcert::reports
