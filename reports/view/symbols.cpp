#include "reports/view/symbols.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace gumcert::reports {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 34> k_greek{{
    {"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"},   {"delta", "δ"},  {"epsilon", "ε"}, {"zeta", "ζ"},   {"eta", "η"},
    {"theta", "θ"}, {"iota", "ι"},  {"kappa", "κ"},   {"lambda", "λ"}, {"mu", "μ"},      {"nu", "ν"},     {"xi", "ξ"},
    {"pi", "π"},    {"rho", "ρ"},   {"sigma", "σ"},   {"tau", "τ"},    {"upsilon", "υ"}, {"phi", "φ"},    {"chi", "χ"},
    {"psi", "ψ"},   {"omega", "ω"}, {"Gamma", "Γ"},   {"Delta", "Δ"},  {"Theta", "Θ"},   {"Lambda", "Λ"}, {"Xi", "Ξ"},
    {"Pi", "Π"},    {"Sigma", "Σ"}, {"Upsilon", "Υ"}, {"Phi", "Φ"},    {"Psi", "Ψ"},     {"Omega", "Ω"},
}};

// Of the sentences of the program. Those of a quantity come from the record.
constexpr std::array<std::string_view, 26> k_of_the_program = {
    "T_L", "T_U",  "A_L", "A_U",  "p_c", "ν_eff", "ν_i", "X_i", "x_i", "c_i", "c_j",   "u_i", "u_j",
    "d_i", "d_ij", "x_j", "r_ij", "y_j", "k_p",   "k_q", "u_c", "y_i", "η_j", "U_max", "s_0", "y_0"};
// Of its sentences on comparisons.
constexpr std::array<std::string_view, 11> k_of_comparisons = {"σ_pt", "δ_E", "P_A", "D_fail",   "p_low", "p_high",
                                                               "ν_D",  "t_p", "E_n", "u_others", "U_D"};

std::string_view as_letter(std::string_view word) {
    const auto found = std::find_if(k_greek.begin(), k_greek.end(), [&](const auto& g) { return g.first == word; });
    return found == k_greek.end() ? word : found->second;
}

bool is_one_letter(std::string_view text) {
    return (text.size() == 1 && (std::isalpha(static_cast<unsigned char>(text[0])) != 0)) ||
           (text.size() == 2 && static_cast<unsigned char>(text[0]) >= 0xC2U);
}

bool is_of_a_name(char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
}

bool is_name(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return is_of_a_name(c) || static_cast<unsigned char>(c) >= 0x80U;
    });
}

}  // namespace

Symbol symbol_of(const std::string& name) {
    if (!is_name(name)) {
        return {};
    }
    const std::size_t first = std::min(name.find('_'), name.size());
    const std::string base(as_letter(name.substr(0, first)));
    const bool is_difference = base.size() == 2 && base[0] == 'd' && is_one_letter(base.substr(1));  // "dV_x"
    if (!is_one_letter(base) && !is_difference) {
        return {};
    }
    Symbol symbol{.base = base, .index = {}};
    for (std::size_t at = first; at < name.size();) {
        const std::size_t end = std::min(name.find('_', at + 1), name.size());
        const std::string part = name.substr(at + 1, end - at - 1);
        if (!part.empty()) {
            symbol.index += (symbol.index.empty() ? "" : ",") + std::string(as_letter(part));
        }
        at = end;
    }
    return symbol;
}

nlohmann::json symbols_in(const EvaluationRecord& record) {
    std::set<std::string> names(k_of_the_program.begin(), k_of_the_program.end());
    if (record.comparison) {
        names.insert(k_of_comparisons.begin(), k_of_comparisons.end());
    }
    for (const InputQuantity& input : record.inputs) {
        names.insert(input.name);
    }
    for (const Result& result : record.results) {
        names.insert(result.quantity.empty() ? result.name : result.quantity);
        for (const BudgetRow& row : result.budget) {
            names.insert(row.input);
        }
    }
    if (record.model) {
        for (const std::string& equation : record.model->equations) {
            names.insert(equation.substr(0, equation.find_first_of(" =")));
        }
        names.insert(record.model->unknowns.begin(), record.model->unknowns.end());
    }
    if (record.certificate) {
        for (const certificate::CertifiedTable& table : record.certificate->tables) {
            for (const certificate::CertifiedColumn& column : table.columns) {
                names.insert(column.result);
            }
        }
    }
    for (const FitSummary& fit : record.fits) {
        names.insert(fit.x_name);
        names.insert(fit.y_name);
        for (const FitSummary::Parameter& parameter : fit.parameters) {
            names.insert(parameter.name);
        }
    }
    // What an organiser calls a laboratory, an item or a round is a name, whatever it looks like.
    if (record.comparison) {
        for (const ParticipantSummary& participant : record.comparison->participants) {
            names.erase(participant.id);
            names.erase(participant.name);
        }
        for (const ComparisonItemEvaluation& item : record.comparison->items) {
            names.erase(item.id);
            names.erase(item.name);
            names.erase(item.round);
        }
        for (const ComparisonPoint& point : record.comparison->points) {
            names.erase(point.name);
            names.erase(point.direction);
        }
    }
    nlohmann::json symbols = nlohmann::json::array();
    nlohmann::json letters = nlohmann::json::array();
    for (const std::string& name : names) {
        const Symbol symbol = symbol_of(name);
        if (symbol.base == name) {
            letters.push_back({{"text", name}});
        } else if (!symbol.base.empty()) {
            symbols.push_back({{"text", name}, {"base", symbol.base}, {"index", symbol.index}});
        }
    }
    return {{"symbols", std::move(symbols)}, {"letters", std::move(letters)}};
}

SymbolFinder::SymbolFinder(const nlohmann::json& view) {
    for (const nlohmann::json& symbol : view.value("symbols", nlohmann::json::array())) {
        const std::string text = symbol.at("text").get<std::string>();
        symbols_[text] = {.base = symbol.at("base").get<std::string>(), .index = symbol.at("index").get<std::string>()};
        if (!text.empty() && !is_of_a_name(text[0])) {
            others_.push_back(text);
        }
    }
    for (const nlohmann::json& letter : view.value("letters", nlohmann::json::array())) {
        letters_.insert(letter.at("text").get<std::string>());
    }
}

std::vector<SymbolPiece> SymbolFinder::pieces(std::string_view text) const {
    return pieces(text, false);
}

std::vector<SymbolPiece> SymbolFinder::pieces_of_formula(std::string_view text) const {
    return pieces(text, true);
}

std::vector<SymbolPiece> SymbolFinder::pieces(std::string_view text, bool formula) const {
    std::vector<SymbolPiece> found;
    std::string between;
    const auto add = [&](std::string_view name, const Symbol& symbol) {
        if (!between.empty()) {
            found.push_back({.text = std::exchange(between, {}), .symbol = {}});
        }
        found.push_back({.text = std::string(name), .symbol = symbol});
    };
    for (std::size_t at = 0; at < text.size();) {
        const auto other = std::find_if(others_.begin(), others_.end(),
                                        [&](const std::string& s) { return text.substr(at).starts_with(s); });
        std::size_t end = at + (other == others_.end() ? 0 : other->size());
        if (other == others_.end()) {
            while (end < text.size() && is_of_a_name(text[end])) {
                ++end;
            }
        }
        if (end == at) {
            // A letter of another script in a formula: of two bytes, as Greek ones are.
            const std::string_view letter = text.substr(at, 2);
            const bool greek = formula && (letter.starts_with("\xCE") || letter.starts_with("\xCF")) &&
                               (at + 2 >= text.size() || text[at + 2] != '_');
            if (greek) {
                add(letter, {.base = std::string(letter), .index = {}});
                at += 2;
            } else {
                between += text[at++];
            }
            continue;
        }
        const std::string_view name = text.substr(at, end - at);
        const bool goes_on = other != others_.end() && end < text.size() && is_of_a_name(text[end]);
        const auto symbol = symbols_.find(name);
        if (symbol != symbols_.end() && !goes_on) {
            add(name, symbol->second);
        } else if (formula && (letters_.contains(name) || is_one_letter(name))) {
            add(name, {.base = std::string(name), .index = {}});
        } else {
            between += name;
        }
        at = end;
    }
    if (!between.empty()) {
        found.push_back({.text = std::move(between), .symbol = {}});
    }
    return found;
}

}  // namespace gumcert::reports
