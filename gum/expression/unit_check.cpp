#include "gum/expression/unit_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gum/quantity/unit_exponent.h"
#include "text/numbers.h"

namespace gumcert::gum {

namespace {

bool is_same_weight(double a, double b) {
    // Weights are sums of constants such as 1/3, which are rounded.
    return std::fabs(a - b) < 1e-9;
}

bool is_number(const QuantityKind& kind) {
    return kind.zero || kind.dimension.is_one();
}

/// What to do when two dimensions differ by radians only, which is the slip that people cannot see.
std::string angle_cure(const Dimension& a, const Dimension& b) {
    const Dimension quotient = a / b;
    for (const double exponent : {1.0, 2.0, -1.0, -2.0}) {
        if (quotient == Dimension::angle().power(exponent)) {
            const std::string factor = std::fabs(exponent) == 2.0 ? "rad^2" : "rad";
            return "They differ by the unit of angle: divide the " + std::string(exponent > 0 ? "first" : "second") +
                   " by it (\"/" + factor + "\"), or multiply the " + (exponent > 0 ? "second" : "first") + " (\"*" +
                   factor + "\").";
        }
    }
    return {};
}

/// What to do where a level in dB and a number meet; empty where they do not.
/// \param quotient  of the dimensions of both
std::string level_cure(const Dimension& quotient) {
    const std::string unit = quotient.text();
    return unit == "dB" || unit == "dB-1"
               ? "A level in dB has a unit of its own. Add the input \"dB_1\": {\"value\": 1, \"unit\": \"dB\", "
                 "\"constant\": true}, and "
                 "write a number times it (\"20*log10(v/v_0)*dB_1\") or a level divided by it (\"10^(L/(20*dB_1))\")."
               : "";
}

/// True where turns or cycles are what a quantity counts, so that 1 of it is 2 pi rad: rpm and turn, or a frequency.
bool counts_turns(const QuantityKind& a, const QuantityKind& b) {
    const auto is_turns = [](const QuantityKind& kind) {
        return kind.unit.find("rpm") != std::string::npos || kind.unit.find("turn") != std::string::npos ||
               kind.unit.find("rev") != std::string::npos;
    };
    static const Dimension rate = Unit::parse("Hz").dimension();
    return is_turns(a) || is_turns(b) || a.dimension == rate || b.dimension == rate;
}

/// angle_cure() for a sum of turns, or of cycles, and a number of them: "/rad" alone would be wrong by 2 pi.
std::string turns_cure(const QuantityKind& a, const QuantityKind& b) {
    const bool first = a.dimension / b.dimension == Dimension::angle();
    if ((!first && !(b.dimension / a.dimension == Dimension::angle())) || !counts_turns(a, b)) {
        return {};
    }
    const std::string with_angle = first ? "first" : "second";
    return "They differ by the unit of angle: divide the " + with_angle +
           " by a turn (\"/(2*pi*rad)\") where turns or cycles are counted (60 rpm are 1 Hz), or by the radian "
           "(\"/rad\") where radians are.";
}

class UnitCheck {
public:
    UnitCheck(const SyntaxTree& tree, std::span<const QuantityKind* const> quantities,
              std::vector<Diagnostic>& problems)
        : tree_(tree), quantities_(quantities), problems_(problems) {
        kinds_.reserve(tree.nodes.size());
    }

    std::vector<QuantityKind> run() {
        for (const SyntaxNode& node : tree_.nodes) {
            kinds_.push_back(kind_of(node));
        }
        return std::move(kinds_);
    }

private:
    [[nodiscard]] const SyntaxNode& operand(std::int32_t index) const {
        return tree_.nodes[static_cast<std::size_t>(index)];
    }

    /// "x*y" is in mm
    [[nodiscard]] std::string is_in(std::int32_t index) const {
        const std::string unit = kinds_[static_cast<std::size_t>(index)].unit_text();
        return "\"" + tree_.excerpt(operand(index)) + "\" is " + (unit == "1" ? "a number (unit 1)" : "in " + unit);
    }

    /// The operand as the factor of a product that a message proposes.
    [[nodiscard]] std::string factor(std::int32_t index) const {
        const Operation operation = operand(index).operation;
        const bool single = operation <= Operation::quantity;
        return single ? tree_.excerpt(operand(index)) : "(" + tree_.excerpt(operand(index)) + ")";
    }

    QuantityKind refuse(const SyntaxNode& node, std::string code, std::string what, std::string rule,
                        std::string action) {
        problems_.push_back({.code = std::move(code),
                             .where = place(tree_.where, node.column),
                             .what = std::move(what),
                             .rule = std::move(rule),
                             .action = std::move(action)});
        return QuantityKind::unknown();
    }

    QuantityKind kind_of(const SyntaxNode& node) {
        switch (node.operation) {
            case Operation::number: {
                QuantityKind kind;
                kind.zero = node.value == 0.0;
                kind.constant = node.value;
                return kind;
            }
            case Operation::pi: {
                QuantityKind kind;
                kind.constant = 3.14159265358979323846;
                return kind;
            }
            case Operation::quantity: {
                const QuantityKind* kind = quantities_[node.name];
                return kind == nullptr ? QuantityKind::unknown() : *kind;
            }
            default:
                break;
        }
        const QuantityKind& a = kinds_[static_cast<std::size_t>(node.left)];
        const QuantityKind& b = kinds_[static_cast<std::size_t>(is_binary(node.operation) ? node.right : node.left)];
        if (!a.known || !b.known) {
            return QuantityKind::unknown();
        }
        QuantityKind kind = is_binary(node.operation) ? of_two(node, a, b) : of_one(node, a);
        // Values of constants are followed as well, because an exponent and the weight of a temperature depend on them.
        if (kind.known && a.constant && b.constant) {
            const double value = apply(node.operation, *a.constant, *b.constant);
            if (std::isfinite(value)) {
                kind.constant = value;
            }
        }
        kind.unit.clear();
        return kind;
    }

    QuantityKind of_one(const SyntaxNode& node, const QuantityKind& a) {
        const std::string function(function_name(node.operation));
        QuantityKind kind;
        switch (node.operation) {
            case Operation::negate:
                kind.dimension = a.dimension;
                kind.celsius = -a.celsius;
                kind.fahrenheit = a.fahrenheit;
                kind.zero = a.zero;
                return kind;
            case Operation::absolute:
                kind.dimension = a.dimension;
                // |t| of a Celsius temperature changes at 0 °C, a place that has no meaning in nature; of a difference
                // it is well defined.
                return is_same_weight(a.celsius, 0.0) ? kind : not_a_difference(node, a);
            case Operation::sqrt:
                kind.dimension = a.dimension.power(0.5);
                return kind;
            case Operation::sin:
            case Operation::cos:
            case Operation::tan:
                // A plain number is refused as well: whether degrees or radians are meant is not seen in it, and the
                // slip is a factor of 57.
                if (a.zero || a.dimension == Dimension::angle()) {
                    return kind;
                }
                return refuse(node, "GC-MODEL-0032", is_in(node.left), function + " takes an angle",
                              a.dimension.is_one() ? "Give the input the unit rad (or deg, arcsec), or write " +
                                                         function + "(" + factor(node.left) + "*rad)."
                                                   : "Correct the expression, or the units of its inputs.");
            case Operation::celsius:
            case Operation::kelvin:
                return of_temperature_scale(node, a);
            default:
                break;
        }
        if (!is_number(a)) {
            return refuse(node, "GC-MODEL-0031", is_in(node.left), function + " takes a number (unit 1)",
                          a.dimension == Dimension::angle()
                              ? "Divide the angle by rad: " + function + "(" + factor(node.left) + "/rad)."
                              : "Divide by a quantity of the same unit.");
        }
        if (node.operation == Operation::asin || node.operation == Operation::acos ||
            node.operation == Operation::atan) {
            kind.dimension = Dimension::angle();
        }
        return kind;
    }

    QuantityKind not_a_difference(const SyntaxNode& node, const QuantityKind& a) {
        return refuse(node, "GC-MODEL-0037",
                      std::string(function_name(node.operation)) + " of " + a.unit_text() + ", a Celsius temperature",
                      "the result would depend on the zero of the scale",
                      "Take a difference of two temperatures, or kelvin(t).");
    }

    QuantityKind of_temperature_scale(const SyntaxNode& node, const QuantityKind& a) {
        const bool to_celsius = node.operation == Operation::celsius;
        if (!a.zero && !(a.dimension == Dimension::temperature())) {
            return refuse(node, "GC-MODEL-0037", is_in(node.left),
                          std::string(function_name(node.operation)) + " takes a temperature",
                          "Correct the expression, or the units of its inputs.");
        }
        if (!a.zero && !is_same_weight(a.celsius, to_celsius ? 0.0 : 1.0)) {
            return to_celsius ? refuse(node, "GC-MODEL-0037", is_in(node.left) + ", not a thermodynamic temperature",
                                       "celsius(T) takes a thermodynamic temperature in K", "Leave celsius(…) out.")
                              : refuse(node, "GC-MODEL-0037", is_in(node.left) + ", not a Celsius temperature",
                                       "kelvin(t) takes a Celsius temperature (unit degC)", "Leave kelvin(…) out.");
        }
        QuantityKind kind;
        kind.dimension = Dimension::temperature();
        kind.celsius = to_celsius ? 1.0 : 0.0;
        return kind;
    }

    QuantityKind of_two(const SyntaxNode& node, const QuantityKind& a, const QuantityKind& b) {
        QuantityKind kind;
        switch (node.operation) {
            case Operation::add:
            case Operation::subtract: {
                if (!balance(node, a, b)) {
                    return QuantityKind::unknown();
                }
                kind.dimension = a.zero ? b.dimension : a.dimension;
                // The weight of the zero of the Celsius scale is followed like a quantity: t1 − t2 has 0 and is a
                // difference in K, (t1 + t2)/2 has 1 and is a Celsius temperature, t1 + t2 has 2 and is neither.
                kind.celsius = node.operation == Operation::add ? a.celsius + b.celsius : a.celsius - b.celsius;
                kind.zero = a.zero && b.zero;
                kind.fahrenheit = (a.fahrenheit || b.fahrenheit) && !is_same_weight(kind.celsius, 0.0);
                return kind;
            }
            case Operation::multiply:
                kind.dimension = a.dimension * b.dimension;
                // Only a factor whose value is known gives a known weight: (t1 + t2)/2 is a Celsius temperature again,
                // of w t nobody can tell.
                kind.celsius = a.constant && a.dimension.is_one()   ? *a.constant * b.celsius
                               : b.constant && b.dimension.is_one() ? *b.constant * a.celsius
                                                                    : 0.0;
                return of_product(node, a, b, kind);
            case Operation::divide:
                kind.dimension = a.dimension / b.dimension;
                kind.celsius = b.constant && b.dimension.is_one() && *b.constant != 0.0 ? a.celsius / *b.constant : 0.0;
                return of_product(node, a, b, kind);
            case Operation::power:
                return of_power(node, a, b);
            default:
                break;
        }
        if (!balance(node, a, b)) {
            return QuantityKind::unknown();
        }
        kind.dimension = a.zero ? b.dimension : a.dimension;
        switch (node.operation) {
            case Operation::minimum:
            case Operation::maximum:
                if (!a.zero && !b.zero && !is_same_weight(a.celsius, b.celsius)) {
                    return refuse(
                        node, "GC-MODEL-0037", is_in(node.left) + ", " + is_in(node.right),
                        "a Celsius temperature is not compared with a thermodynamic temperature or a difference",
                        "Write kelvin(t) or celsius(T) for one of them.");
                }
                kind.celsius = a.zero ? b.celsius : a.celsius;
                kind.zero = a.zero && b.zero;
                return kind;
            case Operation::hypot:
            case Operation::atan2:
                if (!is_same_weight(a.celsius, 0.0) || !is_same_weight(b.celsius, 0.0)) {
                    return not_a_difference(node, is_same_weight(a.celsius, 0.0) ? b : a);
                }
                if (node.operation == Operation::atan2) {
                    kind.dimension = Dimension::angle();
                }
                return kind;
            default:
                return QuantityKind::unknown();
        }
    }

    /// A product, unless a Fahrenheit temperature is a factor: its number there would be counted from 0 degC.
    QuantityKind of_product(const SyntaxNode& node, const QuantityKind& a, const QuantityKind& b, QuantityKind kind) {
        kind.fahrenheit = a.fahrenheit || b.fahrenheit;
        if (!kind.fahrenheit || !is_same_weight(kind.celsius, 0.0)) {
            return kind;
        }
        const std::int32_t index = a.fahrenheit ? node.left : node.right;
        const std::string t = tree_.excerpt(operand(index));
        const std::string zero =
            std::find(tree_.names.begin(), tree_.names.end(), "t_0") == tree_.names.end() ? "t_0" : "t_0F";
        return refuse(
            node, "GC-MODEL-0043", "\"" + t + "\", a Fahrenheit temperature, is a factor of a product",
            "a formula for a number of degF means the difference from 0 degF; the number in SI is counted from "
            "0 degC",
            "Write (" + t + " - " + zero + ") for \"" + t + "\" with the input \"" + zero +
                "\": {\"value\": 0, \"unit\": \"degF\", \"constant\": true}, state the temperature in degC "
                "where the formula is for degC, or write kelvin(" +
                t + ") where the thermodynamic temperature is meant.");
    }

    bool balance(const SyntaxNode& node, const QuantityKind& a, const QuantityKind& b) {
        if (a.zero || b.zero || a.dimension == b.dimension) {
            return true;
        }
        const std::string sign = node.operation == Operation::add        ? " + "
                                 : node.operation == Operation::subtract ? " - "
                                                                         : ", ";
        const std::string function(function_name(node.operation));
        const std::string both = function.empty() ? a.unit_text() + sign + b.unit_text()
                                                  : function + "(" + a.unit_text() + sign + b.unit_text() + ")";
        std::string cure = turns_cure(a, b);
        if (cure.empty()) {
            cure = angle_cure(a.dimension, b.dimension);
        }
        if (cure.empty()) {
            cure = level_cure(a.dimension / b.dimension);
        }
        refuse(node, "GC-MODEL-0030",
               both + ": " + is_in(node.left) + " (dimension " + a.dimension.text() + "), " + is_in(node.right) +
                   " (dimension " + b.dimension.text() + ")",
               function.empty() ? "terms of a sum have the same dimension"
                                : "arguments of " + function + " have the same dimension",
               cure.empty() ? "Correct the equation, or the units of its inputs." : std::move(cure));
        return false;
    }

    QuantityKind of_power(const SyntaxNode& node, const QuantityKind& base, const QuantityKind& exponent) {
        QuantityKind kind;
        if (!is_number(exponent)) {
            std::string cure = level_cure(exponent.dimension);
            if (cure.empty()) {
                cure = exponent.dimension == Dimension::angle() ? "Divide the angle by rad."
                                                                : "Divide by a quantity of the same unit.";
            }
            return refuse(node, "GC-MODEL-0033", "the exponent " + is_in(node.right),
                          "an exponent is a number (unit 1)", std::move(cure));
        }
        // A number to any power is a number; only a base with a unit needs to know which unit results.
        if (is_number(base)) {
            return kind;
        }
        if (!exponent.constant) {
            return refuse(node, "GC-MODEL-0034",
                          "the exponent \"" + tree_.excerpt(operand(node.right)) + "\" is not a constant, and " +
                              is_in(node.left),
                          "the power of a quantity with a unit has a constant exponent",
                          "Divide the base by a quantity of the same unit, or declare the exponent as \"constant\".");
        }
        kind.dimension = base.dimension.power(*exponent.constant);
        kind.celsius = *exponent.constant == 1.0 ? base.celsius : 0.0;
        return kind;
    }

    const SyntaxTree& tree_;
    std::span<const QuantityKind* const> quantities_;
    std::vector<Diagnostic>& problems_;
    std::vector<QuantityKind> kinds_;
};

const char* scale_of(const QuantityKind& kind) {
    return kind.fahrenheit ? "Fahrenheit" : "Celsius";
}

std::string weight_text(const QuantityKind& kind) {
    return text::shortest(kind.celsius) + " times a " + scale_of(kind) + " temperature";
}

/// What to do about a sum of Celsius temperatures that is none.
std::string cure_of_weight(const QuantityKind& kind) {
    const std::string scale = scale_of(kind);
    if (kind.celsius < 0.0) {  // T - t: no mean
        return "Write kelvin(t) for each " + scale +
               " temperature t, which gives a difference in K; or celsius(T) for the thermodynamic temperature T that "
               "one is subtracted from.";
    }
    return "Divide by " + text::shortest(kind.celsius) + " where a mean of " + scale +
           " temperatures is meant, subtract " + scale +
           " temperatures until a difference is left where one is meant, or write kelvin(t) for each " + scale +
           " temperature t and state the result in K.";
}

}  // namespace

QuantityKind QuantityKind::unknown() {
    QuantityKind kind;
    kind.known = false;
    return kind;
}

QuantityKind QuantityKind::of(const Unit& unit, std::optional<double> constant) {
    QuantityKind kind;
    kind.dimension = unit.dimension();
    kind.celsius = unit.is_celsius_temperature() ? 1.0 : 0.0;
    // 1 K is 1.8 degF and 1 degC.
    kind.fahrenheit = unit.is_celsius_temperature() && unit.difference_from_si(1.0) > 1.5;
    kind.constant = constant;
    kind.unit = unit.text();
    return kind;
}

std::string QuantityKind::unit_text() const {
    if (!unit.empty()) {
        return unit;
    }
    return dimension == Dimension::temperature() && is_same_weight(celsius, 1.0) ? "degC" : dimension.text();
}

std::vector<QuantityKind> check_units(const SyntaxTree& tree, std::span<const QuantityKind* const> quantities,
                                      std::vector<Diagnostic>& problems) {
    return UnitCheck(tree, quantities, problems).run();
}

void check_balance(const SyntaxTree& tree, const QuantityKind& kind, std::vector<Diagnostic>& problems) {
    if (kind.known && !kind.zero && kind.dimension == Dimension::temperature() && !is_same_weight(kind.celsius, 0.0)) {
        problems.push_back({.code = "GC-MODEL-0036",
                            .where = place(tree.where, 1),
                            .what = "\"" + tree.excerpt(tree.nodes.back()) + "\" is " + weight_text(kind),
                            .rule = "only a difference of temperatures can be 0",
                            .action = "Write kelvin(t) or celsius(T) where the two scales meet."});
    }
}

Unit output_unit(const std::string& name, const QuantityKind& kind, const std::optional<Unit>& declared,
                 const std::string& where, std::vector<Diagnostic>& problems) {
    if (!kind.known) {
        return declared.value_or(Unit());
    }
    const auto refuse = [&](std::string code, std::string what, std::string rule, std::string action) {
        problems.push_back({.code = std::move(code),
                            .where = where,
                            .what = std::move(what),
                            .rule = std::move(rule),
                            .action = std::move(action)});
        return declared.value_or(Unit());
    };
    const bool temperature = kind.dimension == Dimension::temperature();
    if (declared) {
        if (kind.zero) {
            return *declared;
        }
        if (!(declared->dimension() == kind.dimension)) {
            std::string cure = angle_cure(kind.dimension, declared->dimension());
            if (cure.empty()) {
                cure = level_cure(kind.dimension / declared->dimension());
            } else {
                const bool has_angle_more = kind.dimension / declared->dimension() == Dimension::angle();
                cure = std::string("They differ by the unit of angle: ") +
                       (has_angle_more ? counts_turns(kind, QuantityKind::of(*declared))
                                             ? "divide the right side by a turn (\"/(2*pi*rad)\") where turns or "
                                               "cycles are counted (60 rpm are 1 Hz), or by the radian (\"/rad\") "
                                               "where radians are."
                                             : "divide the right side by it (\"/rad\")."
                                       : "write \"*rad\" or \"/rad\" where it belongs.");
            }
            return refuse("GC-MODEL-0035",
                          name + " is declared in " + declared->text() + " (dimension " + declared->dimension().text() +
                              "), its equation gives " + kind.unit_text() + " (dimension " + kind.dimension.text() +
                              ")",
                          "both sides of an equation have the same dimension",
                          cure.empty() ? "Correct the unit of the output, or the equation." : std::move(cure));
        }
        if (temperature && !is_same_weight(kind.celsius, declared->is_celsius_temperature() ? 1.0 : 0.0)) {
            if (declared->is_celsius_temperature() && is_same_weight(kind.celsius, 0.0)) {
                const bool fahrenheit = QuantityKind::of(*declared).fahrenheit;
                const std::string unit = fahrenheit ? "degF" : "degC";
                return refuse("GC-MODEL-0036",
                              name + " is declared in " + declared->text() +
                                  ", its equation gives a thermodynamic temperature or a difference",
                              "a Celsius or Fahrenheit temperature is a sum of one such temperature and differences",
                              "If it is a difference from 0 " + unit + " (a formula written for t in " + unit +
                                  "), add the input \"t_0\": {\"value\": 0, \"unit\": \"" + unit +
                                  "\", \"constant\": true} and \" + t_0\" to the right side (50 K becomes " +
                                  (fahrenheit ? "90 degF" : "50 degC") +
                                  "). If it is a thermodynamic temperature, write celsius(…) around the right side "
                                  "(50 K becomes " +
                                  (fahrenheit ? "-369.67 degF" : "-223.15 degC") +
                                  "). If a difference is asked for, declare " + name + " in " +
                                  (fahrenheit ? "K or delta_degF." : "K."));
            }
            if (is_same_weight(kind.celsius, 1.0)) {
                return refuse("GC-MODEL-0036",
                              name + " is declared in " + declared->text() + ", its equation gives a " +
                                  scale_of(kind) + " temperature",
                              std::string("a thermodynamic temperature or a difference is not a ") + scale_of(kind) +
                                  " temperature",
                              std::string("Write kelvin(t) for a ") + scale_of(kind) + " temperature t, or declare " +
                                  name + " in " + (kind.fahrenheit ? "degF." : "degC."));
            }
            return refuse("GC-MODEL-0036", name + " is " + weight_text(kind),
                          "the result is neither a Celsius temperature nor a difference of temperatures",
                          cure_of_weight(kind));
        }
        return *declared;
    }
    if (temperature && !is_same_weight(kind.celsius, 0.0) && !is_same_weight(kind.celsius, 1.0)) {
        return refuse("GC-MODEL-0038", name + " is " + weight_text(kind),
                      "the result is neither a Celsius temperature nor a difference of temperatures",
                      cure_of_weight(kind));
    }
    if (!is_of_a_unit(kind.dimension)) {
        return refuse("GC-MODEL-0039", name + " has the dimension " + kind.dimension.text(),
                      "exponents of a unit are whole numbers, or fractions with a denominator up to 9",
                      "Correct the equation, or the units of its inputs.");
    }
    return Unit::coherent(kind.dimension, temperature && is_same_weight(kind.celsius, 1.0));
}

Unit preferred_unit(const Unit& coherent, std::span<const Unit* const> used) {
    if (coherent.dimension().is_one()) {
        return coherent;
    }
    // Who states lengths in millimetres reads a result in millimetres, too.
    for (const Unit* unit : used) {
        if (unit->dimension() == coherent.dimension() &&
            unit->is_celsius_temperature() == coherent.is_celsius_temperature()) {
            return *unit;
        }
    }
    // Names of SI units (SI brochure, 9th edition, table 4) that are not names of several kinds of quantities.
    static const std::vector<Unit> k_named = [] {
        std::vector<Unit> units;
        for (const char* name : {"N", "Pa", "J", "W", "C", "V", "F", "ohm", "S", "Wb", "T", "H"}) {
            units.push_back(Unit::parse(name));
        }
        return units;
    }();
    for (const Unit& unit : k_named) {
        if (unit.dimension() == coherent.dimension()) {
            return unit;
        }
    }
    return coherent;
}

}  // namespace gumcert::gum
