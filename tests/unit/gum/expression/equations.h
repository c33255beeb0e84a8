#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gum/expression/equation_system.h"

namespace gumcert::gum {

inline InputSymbol input(std::string name, const std::string& unit = "1", std::optional<double> constant = {}) {
    return {.name = std::move(name), .unit = Unit::parse(unit), .constant = constant};
}

inline UnknownSymbol unknown(std::string name, double start, const std::string& unit = "1") {
    return {.name = std::move(name), .start = start, .unit = Unit::parse(unit)};
}

inline OutputSymbol output(std::string name, const std::string& unit) {
    return {.name = std::move(name), .unit = Unit::parse(unit), .where = ""};
}

/// Equations at the places "m/0", "m/1" …
inline std::vector<EquationText> equations(const std::vector<std::string>& texts) {
    std::vector<EquationText> result;
    for (const std::string& text : texts) {
        result.push_back({.text = text, .where = "m/" + std::to_string(result.size())});
    }
    return result;
}

inline EquationSystem system_of(const std::vector<std::string>& texts, const std::vector<InputSymbol>& inputs,
                                const std::vector<UnknownSymbol>& unknowns = {},
                                const std::vector<OutputSymbol>& outputs = {}) {
    return EquationSystem::compile(equations(texts), inputs, unknowns, outputs);
}

/// Inputs of unit 1, one for each name.
inline std::vector<InputSymbol> numbers(std::initializer_list<const char*> names) {
    std::vector<InputSymbol> result;
    for (const char* name : names) {
        result.push_back({.name = name, .unit = {}, .constant = {}});
    }
    return result;
}

inline std::vector<Diagnostic> problems_of(const std::vector<std::string>& texts,
                                           const std::vector<InputSymbol>& inputs,
                                           const std::vector<UnknownSymbol>& unknowns = {},
                                           const std::vector<OutputSymbol>& outputs = {},
                                           const ExpressionLimits& limits = {}) {
    try {
        (void)EquationSystem::compile(equations(texts), inputs, unknowns, outputs, limits);
    } catch (const InputError& error) {
        return error.diagnostics();
    }
    return {};
}

/// "code where; code where" of all problems.
inline std::string codes(const std::vector<Diagnostic>& problems) {
    std::string text;
    for (const Diagnostic& problem : problems) {
        text += (text.empty() ? "" : "; ") + problem.code.substr(9) + " " + problem.where;
    }
    return text;
}

inline std::string messages(const std::vector<Diagnostic>& problems) {
    std::string text;
    for (const Diagnostic& problem : problems) {
        text += message(problem) + "\n";
    }
    return text;
}

inline Eigen::VectorXd vector(std::initializer_list<double> values) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), result.data());
    return result;
}

/// The code of the NoResultError that a call throws, "" when it throws none.
template <class Call>
std::string no_result_code(const Call& call) {
    try {
        call();
    } catch (const NoResultError& error) {
        return error.diagnostics().front().code.substr(9);
    }
    return "";
}

}  // namespace gumcert::gum
