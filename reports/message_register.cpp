#include "reports/message_register.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "text/edit_distance.h"

namespace gumcert::reports {

namespace {

constexpr std::size_t k_digits = 4;  // of a code, behind its family

char capital(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_letter_or_digit(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}

MessageEntry entry_of(const nlohmann::json& stated) {
    MessageEntry entry;
    entry.retired = stated.value("retired", "");
    if (!entry.retired.empty()) {
        return entry;
    }
    entry.outcomes = stated.at("outcome").get<std::vector<std::string>>();
    entry.meaning = stated.at("meaning").get<std::string>();
    entry.cause = stated.at("cause").get<std::string>();
    entry.remedy = stated.at("remedy").get<std::string>();
    entry.rules = stated.value("rules", std::vector<std::string>());
    entry.formerly = stated.value("formerly", "");
    if (stated.contains("finding")) {
        entry.finding = stated.at("finding").at("id").get<std::string>();
        entry.finding_severity = stated.at("finding").at("severity").get<std::string>();
    }
    return entry;
}

}  // namespace

MessageRegister::MessageRegister(const std::string& text, const std::string& file) {
    const auto refuse = [&](const std::string& what) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-STORE-0011",
                            .where = file,
                            .what = what,
                            .rule = "the register of message codes is the one of this release",
                            .action = "install the program again, or name its folder with --share"});
    };
    try {
        const nlohmann::json root = nlohmann::json::parse(text);
        text_on_findings_ = root.at("finding").get<std::string>();
        for (const auto& [name, stated] : root.at("outcomes").items()) {
            outcomes_[name] = {stated.at("severity").get<std::string>(), stated.at("text").get<std::string>(),
                               stated.value("certificate", "")};
        }
        for (const auto& [name, stated] : root.at("families").items()) {
            families_[name] = {stated.at("title").get<std::string>(), stated.at("text").get<std::string>()};
        }
        for (const auto& [code, stated] : root.at("codes").items()) {
            codes_[code] = entry_of(stated);
        }
    } catch (const nlohmann::json::exception& error) {
        refuse(std::string("cannot be read: ") + error.what());
    }
    for (const auto& [code, entry] : codes_) {
        for (const std::string& outcome : entry.outcomes) {
            if (!outcomes_.contains(outcome)) {
                refuse(code + " has the outcome \"" + outcome + "\", which is not described");
            }
        }
    }
}

std::vector<std::string> MessageRegister::codes_of(std::string_view family) const {
    std::vector<std::string> found;
    for (const auto& [code, entry] : codes_) {
        if (family_of_code(code) == family && entry.retired.empty()) {
            found.push_back(code);
        }
    }
    return found;
}

std::vector<std::string> MessageRegister::codes_of_finding(std::string_view id) const {
    std::vector<std::string> found;
    for (const auto& [code, entry] : codes_) {
        if (entry.finding == id) {
            found.push_back(code);
        }
    }
    return found;
}

std::vector<std::string> MessageRegister::nearest(std::string_view word, std::size_t most) const {
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const auto& [code, entry] : codes_) {
        near.emplace_back(text::edit_distance(word, code), code);
    }
    for (const auto& [family, described] : families_) {
        near.emplace_back(text::edit_distance(word, family), family);
    }
    const std::size_t count = std::min(most, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    std::vector<std::string> found;
    for (std::size_t i = 0; i < count; ++i) {
        found.push_back(std::move(near[i].second));
    }
    return found;
}

std::string code_as_registered(std::string_view word) {
    while (!word.empty() && !is_letter_or_digit(word.front())) {
        word.remove_prefix(1);
    }
    while (!word.empty() && !is_letter_or_digit(word.back())) {
        word.remove_suffix(1);
    }
    std::string code(word);
    std::transform(code.begin(), code.end(), code.begin(), capital);
    return code.starts_with("GC") || code.empty() ? code : "GC-" + code;
}

std::string_view family_of_code(std::string_view code) {
    const std::size_t dash = code.rfind('-');
    const bool is_code = dash != std::string_view::npos && code.size() - dash - 1 == k_digits &&
                         std::all_of(code.begin() + static_cast<std::ptrdiff_t>(dash) + 1, code.end(),
                                     [](char c) { return c >= '0' && c <= '9'; });
    return is_code ? code.substr(0, dash) : std::string_view();
}

}  // namespace gumcert::reports
