#include "gum/expression/temperature_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace gumcert::gum {

namespace {

constexpr int k_highest_power = 30;

/// The two ways out, both for the same expression.
std::string cure_of(const std::string& temperature, const std::string& zero) {
    const bool single = temperature.find_first_of("+-*/^ ") == std::string::npos;
    const std::string difference = single ? temperature : "(" + temperature + ")";
    return "Write kelvin(" + temperature + ") for \"" + temperature +
           "\" where the thermodynamic temperature is meant; where the difference from 0 degC is meant, write (" +
           difference + " - " + zero + ") with the input \"" + zero +
           "\": {\"value\": 0, \"unit\": \"degC\", \"constant\": true}.";
}

/// A name for 0 degC that an equation does not use for something else.
std::string free_name(const SyntaxTree& tree) {
    std::string name = "t_0";
    while (std::find(tree.names.begin(), tree.names.end(), name) != tree.names.end()) {
        name += "C";
    }
    return name;
}

/// A constant that moves the zero of the scale: to absolute zero, or as the constants of the formulas of Magnus and
/// Antoine do (some 200 K). A correction of a reading does not, whatever it is declared as.
bool is_shift(const QuantityKind& kind) {
    constexpr double k_least = 150.0;
    constexpr double k_most = 350.0;
    return kind.constant && std::fabs(kind.celsius) < 1e-9 && std::fabs(*kind.constant) >= k_least &&
           std::fabs(*kind.constant) <= k_most;
}

/// A sub-expression without the parentheses around it.
std::string bare(std::string text) {
    const auto encloses = [&] {
        if (text.size() < 2 || text.front() != '(' || text.back() != ')') {
            return false;
        }
        int depth = 0;
        for (std::size_t i = 0; i + 1 < text.size(); ++i) {
            depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
            if (depth == 0) {
                return false;
            }
        }
        return true;
    };
    while (encloses()) {
        text = text.substr(1, text.size() - 2);
        text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
        text.erase(text.find_last_not_of(' ') + 1);
    }
    return text;
}

class TemperatureCheck {
public:
    TemperatureCheck(const SyntaxTree& tree, std::span<const QuantityKind> kinds,
                     std::span<const TemperatureContent* const> contents, std::vector<Diagnostic>& warnings)
        : tree_(tree), kinds_(kinds), named_(contents), warnings_(warnings) {}

    TemperatureContent run() {
        for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
            contents_.push_back(content_of(i));
        }
        return std::move(contents_.back());
    }

private:
    [[nodiscard]] bool is_celsius(std::size_t node) const { return std::fabs(kinds_[node].celsius) > 1e-9; }

    [[nodiscard]] bool is_zero(std::size_t node) const {
        return kinds_[node].zero || (kinds_[node].constant && *kinds_[node].constant == 0.0);
    }

    [[nodiscard]] std::string text(std::size_t node) const { return bare(tree_.excerpt(tree_.nodes[node])); }

    /// A Celsius temperature itself.
    [[nodiscard]] TemperatureContent temperature(std::size_t node) const {
        TemperatureContent content;
        content.powers = 2;
        content.where = place(tree_.where, tree_.nodes[node].column);
        content.product = content.temperature = text(node);
        content.zero = free_name(tree_);
        return content;
    }

    /// What is proportional to a power of what an operand is proportional to.
    [[nodiscard]] TemperatureContent proportional(std::size_t node, const TemperatureContent& to, int power) const {
        TemperatureContent content;
        if (power > 0) {
            content.powers = std::uint32_t{1} << static_cast<unsigned>(std::min(power, k_highest_power));
            content.where = place(tree_.where, tree_.nodes[node].column);
            content.product = text(node);
            content.temperature = to.temperature;
            content.zero = to.zero;
        }
        return content;
    }

    void warn(std::size_t node, const std::string& does, const TemperatureContent& content) {
        const bool itself = content.product == content.temperature;
        warnings_.push_back(
            {.code = "GC-MODEL-0040",
             .where = place(tree_.where, tree_.nodes[node].column),
             .what = "\"" + text(node) + "\" " + does + " \"" + content.product + "\"" +
                     (itself ? ", a Celsius temperature"
                             : ", which is proportional to the Celsius temperature \"" + content.temperature + "\""),
             .rule = "a quotient, a root, a logarithm or a power holds for the thermodynamic "
                     "temperature; the number in degC is a difference from 0 degC",
             .action = cure_of(content.temperature, content.zero),
             .severity = Severity::warning});
    }

    /// A sum: the powers of both; a temperature whose zero a constant moves is one no longer.
    [[nodiscard]] TemperatureContent of_sum(std::size_t node, std::size_t left, std::size_t right) const {
        const TemperatureContent& a = contents_[left];
        const TemperatureContent& b = contents_[right];
        if (is_celsius(node)) {
            TemperatureContent content = temperature(node);
            content.shifted = a.shifted || b.shifted || is_shift(kinds_[left]) || is_shift(kinds_[right]);
            return content;
        }
        if (is_celsius(left) && is_celsius(right)) {
            return {};  // a difference of temperatures
        }
        if (a.powers == 2 && b.powers == 2 && tree_.nodes[node].operation == Operation::subtract) {
            return {};  // a difference that is written out: heat that is exchanged
        }
        if (is_zero(left) || is_zero(right)) {
            return is_zero(left) ? b : a;
        }
        TemperatureContent content = a.lone_power() >= b.lone_power() ? a : b;
        content.shifted = false;
        content.powers = a.powers | b.powers;
        return content;
    }

    [[nodiscard]] int factor_power(std::size_t node) const {
        return contents_[node].shifted ? 0 : contents_[node].lone_power();
    }

    TemperatureContent of_power(std::size_t node, std::size_t left, std::size_t right) {
        const int power = factor_power(left);
        if (power == 0) {
            return {};
        }
        const std::optional<double>& exponent = kinds_[right].constant;
        const bool whole = exponent && *exponent == std::round(*exponent) && *exponent >= 0.0;
        if (!whole) {
            warn(node, "is a power of", contents_[left]);
            return {};
        }
        const double total = power * *exponent;
        return proportional(node, contents_[left], static_cast<int>(std::min<double>(total, k_highest_power)));
    }

    TemperatureContent content_of(std::size_t index) {
        const SyntaxNode& node = tree_.nodes[index];
        const auto left = static_cast<std::size_t>(std::max(node.left, 0));
        const auto right = static_cast<std::size_t>(std::max(node.right, 0));
        switch (node.operation) {
            case Operation::number:
            case Operation::pi:
            case Operation::kelvin:
                return {};
            case Operation::quantity:
                if (is_celsius(index)) {
                    TemperatureContent content = temperature(index);
                    content.shifted = named_[node.name] != nullptr && named_[node.name]->shifted;
                    return content;
                }
                return named_[node.name] == nullptr ? TemperatureContent{} : *named_[node.name];
            case Operation::add:
            case Operation::subtract:
                return of_sum(index, left, right);
            case Operation::multiply:
            case Operation::divide:
                if (is_celsius(index)) {  // a mean, a scaled temperature
                    TemperatureContent content = temperature(index);
                    content.shifted = contents_[left].shifted || contents_[right].shifted;
                    return content;
                }
                if (node.operation == Operation::multiply) {
                    const TemperatureContent& to = factor_power(left) > 0 ? contents_[left] : contents_[right];
                    return proportional(index, to, factor_power(left) + factor_power(right));
                }
                if (factor_power(right) > 0) {
                    warn(index, "divides by", contents_[right]);
                    return {};
                }
                // t/(c + t) is a formula for the shifted scale.
                return contents_[right].shifted ? TemperatureContent{}
                                                : proportional(index, contents_[left], factor_power(left));
            case Operation::power:
                return of_power(index, left, right);
            case Operation::sqrt:
            case Operation::ln:
            case Operation::log10:
                if (factor_power(left) > 0) {
                    warn(index, node.operation == Operation::sqrt ? "is the root of" : "is the logarithm of",
                         contents_[left]);
                }
                return {};
            case Operation::negate:
            case Operation::absolute:
                return is_celsius(index) ? temperature(index) : contents_[left];
            case Operation::minimum:
            case Operation::maximum:
                return is_celsius(index)                           ? temperature(index)
                       : factor_power(left) >= factor_power(right) ? contents_[left]
                                                                   : contents_[right];
            default:
                return is_celsius(index) ? temperature(index) : TemperatureContent{};
        }
    }

    const SyntaxTree& tree_;
    std::span<const QuantityKind> kinds_;
    std::span<const TemperatureContent* const> named_;
    std::vector<Diagnostic>& warnings_;
    std::vector<TemperatureContent> contents_;
};

}  // namespace

int TemperatureContent::lone_power() const {
    if (shifted) {
        return 0;
    }
    const auto has = [&](int power) { return (powers >> static_cast<unsigned>(power) & 1U) != 0; };
    const int terms = std::popcount(powers);
    for (int power = k_highest_power; power > 0; --power) {
        // a + b t² and a t + b t², but no a + s t⁴; a gap of one where there are three terms or more
        const bool in_polynomial = power == 1   ? terms > 1
                                   : power == 2 ? has(1) || has(0)
                                                : has(power - 1) || (has(power - 2) && terms > 2);
        if (has(power) && !in_polynomial) {
            return power;
        }
    }
    return 0;
}

TemperatureContent check_temperatures(const SyntaxTree& tree, std::span<const QuantityKind> kinds,
                                      std::span<const TemperatureContent* const> contents,
                                      std::vector<Diagnostic>& warnings) {
    return TemperatureCheck(tree, kinds, contents, warnings).run();
}

void check_result(const TemperatureContent& content, const QuantityKind& kind, std::vector<Diagnostic>& warnings) {
    const int power = content.lone_power();
    if (power == 0 || std::fabs(kind.celsius) > 1e-9) {
        return;
    }
    warnings.push_back({.code = "GC-MODEL-0041",
                        .where = content.where,
                        .what = "\"" + content.product + "\" is proportional to " +
                                (power == 1 ? "" : "power " + std::to_string(power) + " of ") +
                                "the Celsius temperature \"" + content.temperature + "\"",
                        .rule = "what is proportional to a temperature holds for the thermodynamic temperature; the "
                                "number in degC is a difference from 0 degC",
                        .action = cure_of(content.temperature, content.zero),
                        .severity = Severity::warning});
}

void check_default_unit(const std::string& name, const TemperatureContent& content, const QuantityKind& kind,
                        const std::string& where, std::vector<Diagnostic>& problems) {
    const bool enters = content.powers != 1 && !content.shifted;
    if (!enters || !kind.known || !(kind.dimension == Dimension::temperature()) || std::fabs(kind.celsius) > 1e-9) {
        return;
    }
    const std::string zero = content.zero.empty() ? "t_0" : content.zero;
    problems.push_back(
        {.code = "GC-MODEL-0036",
         .where = where,
         .what = name + " has no unit declared, and depends on the Celsius temperature \"" + content.temperature +
                 "\" with a weight that is not known",
         .rule = "a Celsius temperature is a sum of one Celsius temperature and differences",
         .action = "If it is a difference from 0 degC (a formula or a mean of t in degC), add the input \"" + zero +
                   "\": {\"value\": 0, \"unit\": \"degC\", \"constant\": true} and \" + " + zero +
                   "\" to the right side, which gives degC. If a difference is asked for, declare " + name +
                   " in K. If it is a thermodynamic temperature, write kelvin(t) for each Celsius temperature t."});
}

}  // namespace gumcert::gum
