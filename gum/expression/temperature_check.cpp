#include "gum/expression/temperature_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace gumcert::gum {

namespace {

constexpr int k_highest_power = 30;

const char* scale_of(const TemperatureContent& content) {
    return content.fahrenheit ? "Fahrenheit" : "Celsius";
}

const char* unit_of(const TemperatureContent& content) {
    return content.fahrenheit ? "degF" : "degC";
}

/// The two ways out, both for the same expression.
std::string cure_of(const TemperatureContent& content) {
    const std::string& temperature = content.temperature;
    const std::string& zero = content.zero;
    const std::string unit = unit_of(content);
    const bool single = temperature.find_first_of("+-*/^ ") == std::string::npos;
    const std::string difference = single ? temperature : "(" + temperature + ")";
    return "Write kelvin(" + temperature + ") for \"" + temperature +
           "\" where the thermodynamic temperature is meant; where the difference from 0 " + unit +
           " is meant, write (" + difference + " - " + zero + ") with the input \"" + zero +
           "\": {\"value\": 0, \"unit\": \"" + unit + "\", \"constant\": true}.";
}

/// That something is proportional to a temperature which holds for the thermodynamic one.
Diagnostic proportional_to(const TemperatureContent& content, int power) {
    const std::string unit = unit_of(content);
    return {.code = "GC-MODEL-0041",
            .where = content.where,
            .what = "\"" + content.product + "\" is proportional to " +
                    (power == 1 ? "" : "power " + std::to_string(power) + " of ") + "the " + scale_of(content) +
                    " temperature \"" + content.temperature + "\"",
            .rule = "what is proportional to a temperature holds for the thermodynamic temperature; the number in " +
                    unit + " is a difference from 0 " + unit,
            .action = cure_of(content),
            .severity = Severity::warning};
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
        for (const Law& law : laws_) {
            warnings_.push_back(proportional_to(law.content, 1));
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
        content.fahrenheit = kinds_[node].fahrenheit;
        return content;
    }

    /// Nodes of quantities in a sub-expression.
    void collect(std::size_t node, std::vector<std::size_t>& quantities) const {
        const SyntaxNode& at = tree_.nodes[node];
        if (at.operation == Operation::quantity) {
            quantities.push_back(node);
        }
        if (at.operation > Operation::quantity) {
            collect(static_cast<std::size_t>(at.left), quantities);
            if (is_binary(at.operation)) {
                collect(static_cast<std::size_t>(at.right), quantities);
            }
        }
    }

    [[nodiscard]] std::set<std::string> names_in(std::size_t node) const {
        std::vector<std::size_t> quantities;
        collect(node, quantities);
        std::set<std::string> names;
        for (const std::size_t quantity : quantities) {
            names.insert(tree_.names[tree_.nodes[quantity].name]);
        }
        return names;
    }

    /// Whether a product with a temperature looks like a law: see TemperatureContent::law.
    [[nodiscard]] bool is_law(std::size_t node) const {
        constexpr std::size_t k_kelvin = 4;
        std::vector<std::size_t> quantities;
        collect(node, quantities);
        int per_kelvin = 0;
        std::set<std::string> with_unit;
        for (const std::size_t quantity : quantities) {
            const Dimension& dimension = kinds_[quantity].dimension;
            if (is_celsius(quantity) || dimension.is_one()) {
                continue;
            }
            with_unit.insert(tree_.names[tree_.nodes[quantity].name]);
            // 1/K, as a coefficient of expansion has it, multiplies differences of temperatures: it makes no law.
            const bool plain = (dimension * Dimension::temperature()).is_one();
            per_kelvin += dimension.exponent(k_kelvin) == -1.0 && !plain ? 1 : 0;
        }
        return per_kelvin > 0 && with_unit.size() > 1;
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
            content.fahrenheit = to.fahrenheit;
            content.law = is_law(node);
            content.factors = names_in(node);
        }
        return content;
    }

    void warn(std::size_t node, const std::string& does, const TemperatureContent& content) {
        const bool itself = content.product == content.temperature;
        warnings_.push_back(
            {.code = "GC-MODEL-0040",
             .where = place(tree_.where, tree_.nodes[node].column),
             .what = "\"" + text(node) + "\" " + does + " \"" + content.product + "\"" +
                     (itself ? std::string(", a ") + scale_of(content) + " temperature"
                             : std::string(", which is proportional to the ") + scale_of(content) + " temperature \"" +
                                   content.temperature + "\""),
             .rule = std::string("a quotient, a root, a logarithm or a power holds for the thermodynamic "
                                 "temperature; the number in ") +
                     unit_of(content) + " is a difference from 0 " + unit_of(content),
             .action = cure_of(content),
             .severity = Severity::warning});
    }

    /// A law beside a term without a temperature that shares no name with it: no polynomial such as R_0 + R_0 A t. One
    /// with the other sign makes a difference of the two.
    void note_law(const TemperatureContent& content, std::size_t other, int sign) {
        if (content.shifted || content.powers != 2 || !content.law) {
            return;
        }
        if ((contents_[other].powers & 2U) != 0 && !laws_.empty() && laws_.back().sign != sign) {
            laws_.pop_back();
            return;
        }
        const std::set<std::string> beside = names_in(other);
        const bool shares = std::any_of(beside.begin(), beside.end(),
                                        [&](const std::string& name) { return content.factors.contains(name); });
        if (contents_[other].powers == 1 && !shares) {
            laws_.push_back({content, sign});
        }
    }

    /// A sum: the powers of both; a temperature whose zero a constant moves is one no longer.
    [[nodiscard]] TemperatureContent of_sum(std::size_t node, std::size_t left, std::size_t right) {
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
        note_law(a, right, 1);
        note_law(b, left, tree_.nodes[node].operation == Operation::subtract ? -1 : 1);
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
        // Whole powers stand in polynomials of t; a root or an inverse of a Celsius temperature in no formula that
        // holds at and below 0 °C.
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

    struct Law {
        TemperatureContent content;
        int sign;
    };

    const SyntaxTree& tree_;
    std::span<const QuantityKind> kinds_;
    std::span<const TemperatureContent* const> named_;
    std::vector<Law> laws_;  ///< in larger sums
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
    warnings.push_back(proportional_to(content, power));
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
