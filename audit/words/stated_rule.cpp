#include "audit/words/stated_rule.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "audit/stated_number.h"
#include "audit/word_line.h"
#include "certificate/text_words.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

using gum::DecisionRule;

/// "03" and "3" are DR-03.
std::optional<DecisionRule> rule_of_number(std::u32string_view digits) {
    constexpr std::size_t k_most = 2;
    if (digits.empty() || digits.size() > k_most || !std::all_of(digits.begin(), digits.end(), certificate::is_digit)) {
        return std::nullopt;
    }
    std::string id = "DR-" + std::string(k_most - digits.size(), '0');
    for (const char32_t digit : digits) {
        id += static_cast<char>(digit);
    }
    return gum::decision_rule_from_id(id);
}

void add_rule(std::optional<DecisionRule> rule, std::vector<DecisionRule>& rules) {
    if (rule && std::find(rules.begin(), rules.end(), *rule) == rules.end()) {
        rules.push_back(*rule);
    }
}

std::vector<DecisionRule> rules_of_ids(std::string_view text) {
    const std::vector<std::u32string> words = certificate::words_of(text);
    std::vector<DecisionRule> rules;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == U"dr" && i + 1 < words.size()) {
            add_rule(rule_of_number(words[i + 1]), rules);
        } else if (words[i].starts_with(U"dr")) {
            add_rule(rule_of_number(std::u32string_view(words[i]).substr(2)), rules);
        }
    }
    return rules;
}

struct NamedRule {
    DecisionRule rule;
    std::string_view beginning;
};
constexpr std::array k_rules_in_words{
    NamedRule{DecisionRule::simple_acceptance, "simple acceptance"},
    NamedRule{DecisionRule::simple_acceptance, "shared risk"},
    NamedRule{DecisionRule::simple_acceptance, "no guard band"},
    NamedRule{DecisionRule::simple_acceptance, "no guardband"},
    NamedRule{DecisionRule::simple_acceptance, "without guard band"},
    NamedRule{DecisionRule::simple_acceptance, "without guardband"},
    NamedRule{DecisionRule::simple_acceptance, "without a guard band"},
    NamedRule{DecisionRule::simple_acceptance, "einfache akzeptanz"},
    NamedRule{DecisionRule::simple_acceptance, "einfachen akzeptanz"},
    NamedRule{DecisionRule::simple_acceptance, "einfache annahme"},
    NamedRule{DecisionRule::simple_acceptance, "geteiltes risiko"},
    NamedRule{DecisionRule::simple_acceptance, "geteilten risik"},
    NamedRule{DecisionRule::simple_acceptance, "ohne schutzband"},
    NamedRule{DecisionRule::simple_acceptance, "ohne schutzabstand"},
    NamedRule{DecisionRule::simple_acceptance, "ohne sicherheitsabstand"},
    NamedRule{DecisionRule::simple_acceptance, "ohne guard band"},
    NamedRule{DecisionRule::simple_acceptance, "aceptacion simple"},
    NamedRule{DecisionRule::simple_acceptance, "riesgo compartido"},
    NamedRule{DecisionRule::non_binary, "non binary"},
    NamedRule{DecisionRule::non_binary, "nicht binar"},
    NamedRule{DecisionRule::iso_14253_1, "iso 14253 1"},
    NamedRule{DecisionRule::iso_14253_1, "iso14253 1"},
    NamedRule{DecisionRule::relaxed, "relaxed acceptance"},
};
/// Clauses of ILAC-G8:09/2019.
constexpr std::array k_rules_of_ilac_g8{
    NamedRule{DecisionRule::simple_acceptance, "4 2 1 "},
    NamedRule{DecisionRule::guard_band_u, "4 2 2 "},
    NamedRule{DecisionRule::non_binary, "4 2 3 "},
};

bool is_letter_or_digit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || (c & 0x80) != 0;
}

/// r of "= 0.83 U" at the beginning of a text, 1 of "= U", −1 of "= -U"; 0 of "= 0".
std::optional<double> guard_factor_at(std::string_view text) {
    const auto skip = [&text](std::initializer_list<std::string_view> pieces) {
        for (bool found = true; found;) {
            found = false;
            for (const std::string_view piece : pieces) {
                if (text.starts_with(piece)) {
                    text.remove_prefix(piece.size());
                    found = true;
                }
            }
        }
    };
    skip({" ", "=", ":", "(", "of ", "von "});
    if (text.starts_with("w") && text.size() > 1 && !is_letter_or_digit(text[1])) {
        text.remove_prefix(1);  // "guard band w = U"
        skip({" ", "=", ":"});
    }
    double factor = 1.0;
    const bool is_negative = text.starts_with("-") || text.starts_with("\u2212");
    skip({"-", "\u2212", " "});
    const std::size_t digits = std::min(text.find_first_not_of("0123456789.,"), text.size());
    if (digits > 0) {
        const std::optional<StatedNumber> number = read_number(text.substr(0, digits), "");
        if (!number) {
            return std::nullopt;
        }
        factor = number->value;
        text.remove_prefix(digits);
        skip({" ", "*", "\u00B7", "\u00D7", "\u22C5"});
    }
    const bool is_U = text.starts_with("U") &&
                      (text.size() == 1 || text[1] == '_' || text.starts_with("U95") || !is_letter_or_digit(text[1]));
    if (!is_U) {
        const bool is_nothing = digits > 0 && factor == 0.0 && (text.empty() || !is_letter_or_digit(text[0]));
        return is_nothing ? std::optional(0.0) : std::nullopt;
    }
    return is_negative ? -factor : factor;
}

/// The guard bands that a text states as a part of U; nothing in one place for a guard band of something else.
std::vector<std::optional<double>> guard_factors_in(const std::string& text) {
    const std::string small = text::in_small_letters(text);
    std::vector<std::optional<double>> factors;
    // A character whose small letter has another length would shift the places of the two texts.
    if (small.size() != text.size()) {
        return factors;
    }
    for (const std::string_view name :
         {"w", "guard band", "guardband", "schutzband", "schutzabstand", "sicherheitsabstand", "banda de guarda"}) {
        for (std::size_t at = small.find(name); at != std::string::npos; at = small.find(name, at + 1)) {
            const std::size_t end = at + name.size();
            const bool is_word = (at == 0 || !is_letter_or_digit(small[at - 1])) &&
                                 (end == small.size() || !is_letter_or_digit(small[end]));
            const std::string_view behind = std::string_view(text).substr(end);
            const std::size_t first = std::min(behind.find_first_not_of(' '), behind.size());
            const bool is_stated = behind.substr(first).starts_with("=") || behind.substr(first).starts_with(":");
            const std::optional<double> factor = is_word ? guard_factor_at(behind) : std::nullopt;
            if (is_word && (factor || is_stated)) {
                factors.push_back(factor);
            }
        }
    }
    return factors;
}

DecisionRule rule_of_factor(double factor) {
    if (factor == 0.0) {
        return DecisionRule::simple_acceptance;
    }
    if (factor == -1.0) {
        return DecisionRule::relaxed;
    }
    return factor == 1.0 ? DecisionRule::guard_band_u : DecisionRule::guard_band_factor;
}

bool takes_factor(DecisionRule rule) {
    return rule == DecisionRule::guard_band_factor || rule == DecisionRule::non_binary ||
           rule == DecisionRule::b89_7_3_1 || rule == DecisionRule::agreed;
}

}  // namespace

std::optional<DecisionRule> rule_of_id_in(std::string_view text) {
    const std::vector<DecisionRule> rules = rules_of_ids(text);
    return rules.size() == 1 ? std::optional(rules.front()) : std::nullopt;
}

std::optional<StatedRule> stated_rule(std::string_view text) {
    const WordLine words(text);
    std::vector<DecisionRule> rules = rules_of_ids(text);
    const bool has_id = !rules.empty();
    for (const NamedRule& named : k_rules_in_words) {
        if (words.has(named.beginning)) {
            add_rule(named.rule, rules);
        }
    }
    for (const NamedRule& named : k_rules_of_ilac_g8) {
        if (words.has("ilac g8") && words.has(named.beginning)) {
            add_rule(named.rule, rules);
        }
    }
    StatedRule stated;
    for (const std::optional<double>& factor : guard_factors_in(std::string(cut(text, k_longest_text)))) {
        if (!factor) {
            return std::nullopt;  // a guard band that is no part of U
        }
        if (rules.size() == 1 && takes_factor(rules.front())) {
            stated.parameters.guard_factor = *factor;
            continue;
        }
        add_rule(rule_of_factor(*factor), rules);
        if (rules.back() == DecisionRule::guard_band_factor) {
            stated.parameters.guard_factor = *factor;
        }
    }
    // "simple acceptance" is also the beginning of DR-02, which accepts so only with a ratio.
    if (has_id && rules.size() == 2 && rules.front() == DecisionRule::simple_acceptance_with_ratio &&
        rules.back() == DecisionRule::simple_acceptance) {
        rules.pop_back();
    }
    if (rules.size() != 1) {
        return std::nullopt;
    }
    stated.rule = rules.front();
    return stated;
}

}  // namespace gumcert::audit
