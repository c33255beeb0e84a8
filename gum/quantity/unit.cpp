#include "gum/quantity/unit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit_exponent.h"
#include "gum/quantity/unit_expression.h"
#include "gum/quantity/unit_meant.h"
#include "gum/quantity/unit_table.h"
#include "text/numbers.h"

namespace gumcert::gum {

const std::array<std::string_view, Dimension::k_base_units> Dimension::k_symbols{"m",   "kg", "s",   "A", "K",
                                                                                 "mol", "cd", "rad", "dB"};

namespace {

constexpr std::size_t k_kelvin = 4;
constexpr std::size_t k_radian = 7;
constexpr double k_exponent_rounding = 1e-9;  // of fractional exponents, which come from roots
constexpr std::size_t k_longest_unit = 256;
constexpr double k_fahrenheit_zero = -160.0 / 9.0;  // 0 °F, [°C]

/// The unevaluated sum of two numbers, about 106 bits (T. J. Dekker, Numer. Math. 18 (1971) 224-242).
struct Pair {
    double high = 1.0;
    double low = 0.0;
};

Pair quick_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

Pair exact_product(double a, double b) {
    constexpr double k_splitter = 134217729.0;  // 2^27 + 1
    const auto split = [](double x) {
        const double scaled = k_splitter * x;
        const double upper = scaled - (scaled - x);
        return std::array<double, 2>{upper, x - upper};
    };
    const auto [a_upper, a_lower] = split(a);
    const auto [b_upper, b_lower] = split(b);
    const double product = a * b;
    return {product, ((a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper) + a_lower * b_lower};
}

Pair operator*(const Pair& a, const Pair& b) {
    const Pair product = exact_product(a.high, b.high);
    return quick_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

Pair operator/(const Pair& a, const Pair& b) {
    const double quotient = a.high / b.high;
    const Pair back = exact_product(quotient, b.high);
    const double rest = ((a.high - back.high) - back.low) + (a.low - quotient * b.low);
    return quick_sum(quotient, rest / b.high);
}

/// Exact up to 10^22.
double power_of_ten(int exponent) {
    double power = 1.0;
    for (int i = 0; i < exponent; ++i) {
        power *= 10.0;
    }
    return power;
}

/// The size of a unit: a number times powers of 2 and of 10, which neither overflow nor round on the way.
struct Magnitude {
    Pair number;
    int exp2 = 0;
    int exp10 = 0;

    void normalise() {
        int shift = 0;
        number.high = std::frexp(number.high, &shift);
        number.low = std::ldexp(number.low, -shift);
        exp2 += shift;
    }
    void multiply(const Pair& by) {
        number = number * by;
        normalise();
    }
    void divide(const Pair& by) {
        number = number / by;
        normalise();
    }
    void multiply(const Magnitude& by) {
        multiply(by.number);
        exp2 += by.exp2;
        exp10 += by.exp10;
    }
    [[nodiscard]] double value() const {
        Magnitude result = *this;
        int left = std::abs(exp10);
        for (; left > 0; left -= std::min(left, k_exact_power)) {
            const Pair power{power_of_ten(std::min(left, k_exact_power)), 0.0};
            exp10 > 0 ? result.multiply(power) : result.divide(power);
        }
        return std::ldexp(result.number.high + result.number.low, result.exp2);
    }

private:
    static constexpr int k_exact_power = 22;  // 10^22 is a double
};

Pair whole_number(std::int64_t value) {
    const auto high = static_cast<double>(value);
    return {high, static_cast<double>(value - static_cast<std::int64_t>(high))};
}

Magnitude power(const Magnitude& base, int exponent) {
    Magnitude result;
    for (int i = 0; i < std::abs(exponent); ++i) {
        if (exponent > 0) {
            result.multiply(base);
        } else {
            result.divide(base.number);
            result.exp2 -= base.exp2;
            result.exp10 -= base.exp10;
        }
    }
    return result;
}

Magnitude root(const Magnitude& of, int order) {
    const auto floor_rest = [&](int exponent) { return ((exponent % order) + order) % order; };
    const int rest2 = floor_rest(of.exp2);
    const int rest10 = floor_rest(of.exp10);
    // Powers of 2 and 10 that the order divides come out of the root exactly, the rest goes into the number.
    const double number = std::ldexp(of.number.high, rest2) * power_of_ten(rest10);
    Magnitude result;
    result.number.high = order == 2   ? std::sqrt(number)
                         : order == 3 ? std::cbrt(number)
                                      : std::pow(number, 1.0 / static_cast<double>(order));
    result.exp2 = (of.exp2 - rest2) / order;
    result.exp10 = (of.exp10 - rest10) / order;
    result.normalise();
    return result;
}

Magnitude size_of(const UnitFactor& factor) {
    constexpr Pair k_pi{3.141592653589793, 1.2246467991473532e-16};
    const UnitDefinition& unit = *factor.named.unit;
    Magnitude one;
    one.multiply(whole_number(unit.mantissa));
    one.divide(whole_number(unit.divisor));
    for (int i = 0; i < std::abs(unit.pi); ++i) {
        unit.pi > 0 ? one.multiply(k_pi) : one.divide(k_pi);
    }
    one.exp10 += unit.exp10 + (factor.named.prefix != nullptr ? factor.named.prefix->exp10 : 0);
    const Magnitude raised = power(one, factor.exponent.numerator);
    return factor.exponent.denominator == 1 ? raised : root(raised, factor.exponent.denominator);
}

/// With twice the digits, and rounded once at the end: the last digit does not depend on the order of the factors.
double factor_of(const UnitExpression& expression) {
    Magnitude size;
    for (const UnitFactor& factor : expression.factors) {
        size.multiply(size_of(factor));
    }
    for (const UnitNumber& number : expression.numbers) {
        Magnitude one;
        one.multiply(whole_number(number.mantissa));
        one.exp10 = number.exp10;
        size.multiply(power(one, number.power));
    }
    return size.value();
}

Dimension dimension_of(const UnitExpression& expression) {
    std::array<double, Dimension::k_base_units> exponents{};
    for (const UnitFactor& factor : expression.factors) {
        for (std::size_t i = 0; i < exponents.size(); ++i) {
            exponents[i] += static_cast<double>(factor.named.unit->exponents[i] * factor.exponent.numerator) /
                            static_cast<double>(factor.exponent.denominator);
        }
    }
    return Dimension(exponents);
}

/// The scale of a temperature, with or without a prefix, that stands alone; none for every other unit.
const UnitFactor* temperature_scale(const UnitExpression& expression) {
    const bool alone = expression.factors.size() == 1 && expression.factors.front().exponent == UnitExponent{};
    return alone && expression.factors.front().named.unit->scale != UnitDefinition::Scale::from_zero
               ? &expression.factors.front()
               : nullptr;
}

InputError unit_error(const char* code, std::string_view text, const std::string& what, std::string rule,
                      std::string action) {
    return InputError(Diagnostic{.code = code,
                                 .where = "unit \"" + std::string(text) + "\"",
                                 .what = what,
                                 .rule = std::move(rule),
                                 .action = std::move(action)});
}

constexpr const char* k_rule = "a unit is a product of names, each with or without a prefix and an exponent";
constexpr const char* k_action =
    "Write for example um, nm/K, J/(kg K), V/Hz^(1/2), degC, 1/K, percent, or 1 for a bare number.";

/// What people write that is no unit of the grammar: a message of its own helps more than one about syntax.
void refuse_other_scales(std::string_view text) {
    const auto has = [&](std::string_view part) { return text.find(part) != std::string_view::npos; };
    constexpr std::array<std::string_view, 7> k_levels{"dBm", "dBW", "dBV", "dBu", "dBuV", "dBc", "Np"};
    if (text.starts_with("lg(") || text.starts_with("ln(") || text.starts_with("lb(") || text.starts_with("dB(") ||
        text.starts_with("dB re ") || text == "dB (A)" || text == "dB (C)" || text == "dB (B)" || text == "dB (Z)" ||
        std::find(k_levels.begin(), k_levels.end(), text) != k_levels.end()) {
        throw unit_error("GC-UNIT-0002", text, "a logarithmic unit",
                         "levels are stated in dB, which is a unit of its own",
                         "Write dB, or state the quantity itself and use log10 in the model.");
    }
    if (has(" since ")) {
        throw unit_error("GC-UNIT-0003", text, "a point in time", "quantities are durations, not dates",
                         "Write s, min, h or d.");
    }
    if (has("@") || has(" from ")) {
        throw unit_error("GC-UNIT-0004", text, "a scale with an origin of its own",
                         "only temperatures have such scales: degC, degF", "State the quantity from zero.");
    }
}

InputError refused(std::string_view text, const UnitRefusal& refusal) {
    using Reason = UnitRefusal::Reason;
    // A digit or a full stop ends a name: "mmH2O" and "%r.F." are known as a whole only.
    const std::string own = refusal.action.empty() ? unit_meant(text) : refusal.action;
    const auto action = [&](const char* other) { return own.empty() ? other : own; };
    switch (refusal.reason) {
        case Reason::exponent:
            return unit_error("GC-UNIT-0005", text, refusal.what,
                              "exponents are whole numbers, or fractions in parentheses", action(k_action));
        case Reason::number:
            return unit_error("GC-UNIT-0006", text, refusal.what,
                              "a number in a unit stands at its beginning, apart from what follows", action(k_action));
        case Reason::quotient:
            return unit_error("GC-UNIT-0007", text, refusal.what,
                              "what is below the line is one factor, or stands in parentheses (SI Brochure, chapter 5)",
                              action(k_action));
        case Reason::not_known:
        case Reason::malformed:
            break;
    }
    return unit_error("GC-UNIT-0001", text, refusal.what, k_rule, action(k_action));
}

std::string superscript(int power) {
    constexpr std::array<std::string_view, 10> k_digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = power < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(power))) {
        text += k_digits[static_cast<std::size_t>(c - '0')];
    }
    return text;
}

std::string with_exponent(const std::string& name, const UnitExponent& exponent) {
    if (exponent == UnitExponent{1, 2}) {
        return "√" + name;
    }
    if (exponent.denominator != 1) {
        return name + "^" + exponent_text(exponent);
    }
    return exponent.numerator == 1 ? name : name + superscript(exponent.numerator);
}

/// A unit as factors with no number before them but 1; nothing for any other text.
std::optional<UnitExpression> factors_of(std::string_view text) {
    UnitReading reading = read_unit_expression(text);
    const auto is_one = [](const UnitNumber& number) { return number.mantissa == 1 && number.exp10 == 0; };
    const UnitExpression& expression = reading.expression;
    if (text.size() > k_longest_unit || reading.refusal || expression.factors.empty() ||
        !std::all_of(expression.numbers.begin(), expression.numbers.end(), is_one)) {
        return std::nullopt;
    }
    return std::move(reading.expression);
}

}  // namespace

Dimension Dimension::angle() {
    Dimension dimension;
    dimension.exponents_[k_radian] = 1.0;
    return dimension;
}

Dimension Dimension::temperature() {
    Dimension dimension;
    dimension.exponents_[k_kelvin] = 1.0;
    return dimension;
}

bool Dimension::is_one() const {
    return *this == Dimension();
}

std::string Dimension::text() const {
    std::string text;
    for (std::size_t i = 0; i < k_base_units; ++i) {
        const double exponent = exponents_[i];
        if (std::abs(exponent) < k_exponent_rounding) {
            continue;
        }
        text += (text.empty() ? "" : " ") + std::string(k_symbols[i]);
        if (const std::optional<UnitExponent> fraction = unit_exponent(exponent); !fraction) {
            text += "^" + text::shortest(exponent);
        } else if (*fraction != UnitExponent{}) {
            text += (fraction->denominator == 1 ? "" : "^") + exponent_text(*fraction);
        }
    }
    return text.empty() ? "1" : text;
}

Dimension Dimension::operator*(const Dimension& other) const {
    Dimension product;
    for (std::size_t i = 0; i < k_base_units; ++i) {
        product.exponents_[i] = exponents_[i] + other.exponents_[i];
    }
    return product;
}

Dimension Dimension::operator/(const Dimension& other) const {
    return *this * other.power(-1.0);
}

Dimension Dimension::power(double exponent) const {
    Dimension power;
    for (std::size_t i = 0; i < k_base_units; ++i) {
        power.exponents_[i] = exponents_[i] * exponent;
    }
    return power;
}

bool operator==(const Dimension& a, const Dimension& b) {
    for (std::size_t i = 0; i < Dimension::k_base_units; ++i) {
        if (!(std::abs(a.exponents_[i] - b.exponents_[i]) < k_exponent_rounding)) {
            return false;
        }
    }
    return true;
}

Unit Unit::parse(std::string_view text) {
    Unit unit;
    unit.text_ = text.empty() ? "1" : std::string(text);
    if (unit.text_ == "1") {
        return unit;
    }
    if (text.size() > k_longest_unit) {
        throw unit_error("GC-UNIT-0001", text.substr(0, 40), "a text of " + std::to_string(text.size()) + " bytes",
                         "a unit has at most 256 bytes", k_action);
    }
    if (text.find('\0') != std::string_view::npos || text.front() == ' ' || text.back() == ' ') {
        throw unit_error("GC-UNIT-0001", text, "spaces around it, or a NUL character", k_rule, k_action);
    }
    refuse_other_scales(text);
    const UnitReading reading = read_unit_expression(text);
    if (reading.refusal) {
        throw refused(text, *reading.refusal);
    }
    const UnitExpression& expression = reading.expression;
    unit.dimension_ = dimension_of(expression);
    unit.factor_ = factor_of(expression);
    constexpr int k_largest_power_of_two = 830;  // about 10^250: powers and products stay finite
    if (!(unit.factor_ > std::ldexp(1.0, -k_largest_power_of_two) &&
          unit.factor_ < std::ldexp(1.0, k_largest_power_of_two))) {
        throw unit_error("GC-UNIT-0001", text, "larger than 1e249 or smaller than 1e-249 SI units", k_rule, k_action);
    }
    if (const UnitFactor* scale = temperature_scale(expression); scale != nullptr) {
        if (!expression.numbers.empty()) {
            throw unit_error("GC-UNIT-0004", text, "a number before a scale of temperature",
                             "degC and degF have an origin of their own, which a number would move",
                             "Write degC or mdegC, or K for a difference.");
        }
        unit.celsius_ = true;
        unit.offset_ = scale->named.unit->scale == UnitDefinition::Scale::fahrenheit ? k_fahrenheit_zero : 0.0;
    }
    const double inverse = std::round(1.0 / unit.factor_);
    if (unit.factor_ < 1.0 && inverse < 9e15 && std::abs(inverse * unit.factor_ - 1.0) < 4e-16) {
        unit.divisor_ = inverse;
    }
    return unit;
}

bool of_one_kind(const Unit& a, const Unit& b) {
    return a.dimension() == b.dimension() && a.is_celsius_temperature() == b.is_celsius_temperature();
}

Unit Unit::coherent(const Dimension& dimension, bool celsius) {
    Unit unit;
    unit.dimension_ = dimension;
    unit.celsius_ = celsius && dimension == Dimension::temperature();
    unit.text_ = unit.celsius_ ? "degC" : dimension.text();
    return unit;
}

std::string unit_for_people(std::string_view text) {
    if (text == "1" || text.empty()) {
        return "";
    }
    const std::optional<UnitExpression> expression = factors_of(text);
    if (!expression) {
        return std::string(text);
    }
    // A quotient inside of another one, or of a power, is written as a product: pC/(m/s2) is pC·m⁻¹·s².
    const bool is_quotient = expression->quotient && expression->plain;
    std::vector<std::string> above;
    std::vector<std::string> below;
    for (const UnitFactor& factor : expression->factors) {
        const UnitDefinition& unit = *factor.named.unit;
        const PrefixDefinition* prefix = factor.named.prefix;
        const std::string name = unit.people.empty()
                                     ? std::string(factor.text)
                                     : std::string(prefix != nullptr ? prefix->people : "") + std::string(unit.people);
        const bool under = is_quotient && factor.exponent.numerator < 0;
        UnitExponent exponent = factor.exponent;
        exponent.numerator = under ? -exponent.numerator : exponent.numerator;
        (under ? below : above).push_back(with_exponent(name, exponent));
    }
    const auto joined = [](const std::vector<std::string>& names) {
        std::string product;
        for (const std::string& name : names) {
            product += (product.empty() ? "" : "·") + name;
        }
        return product;
    };
    std::string result = above.empty() ? "1" : joined(above);
    if (!below.empty()) {
        result += below.size() == 1 ? "/" + below.front() : "/(" + joined(below) + ")";
    }
    return result;
}

std::string unit_of_difference(std::string_view text) {
    if (!Unit::parse(text).is_celsius_temperature()) {
        return std::string(text);
    }
    const NamedUnit named = read_unit_expression(text).expression.factors.front().named;
    if (named.unit->scale == UnitDefinition::Scale::fahrenheit) {
        return "delta_degF";
    }
    return named.prefix == nullptr
               ? "K"
               : std::string(named.prefix->symbols.substr(0, named.prefix->symbols.find(' '))) + "K";
}

std::optional<std::string> unit_in_d_si(std::string_view text) {
    if (text == "1" || text.empty()) {
        return "\\one";
    }
    const std::optional<UnitExpression> expression = factors_of(text);
    if (!expression) {
        return std::nullopt;
    }
    std::string result;
    for (const UnitFactor& factor : expression->factors) {
        if (factor.named.unit->d_si.empty()) {
            return std::nullopt;
        }
        if (factor.named.prefix != nullptr) {
            result += "\\" + std::string(factor.named.prefix->name);
        }
        result += "\\" + std::string(factor.named.unit->d_si);
        if (factor.exponent != UnitExponent{}) {
            // D-SI writes exponents as decimal numbers: halves, quarters, fifths and eighths are such exactly.
            const int d = factor.exponent.denominator;
            if (d != 1 && d != 2 && d != 4 && d != 5 && d != 8) {
                return std::nullopt;
            }
            result += "\\tothe{" + text::shortest(static_cast<double>(factor.exponent.numerator) / d) + "}";
        }
    }
    return result;
}

}  // namespace gumcert::gum
