#include "gum/quantity/unit_expression.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace gumcert::gum {

namespace {

constexpr int k_largest_exponent = 99;
constexpr int k_largest_denominator = 9;
constexpr std::size_t k_most_digits = 15;  // of a number: held exactly

constexpr std::array<std::string_view, 2> k_dots{"·", "⋅"};
constexpr std::array<std::string_view, 10> k_superscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
constexpr std::string_view k_superscript_minus = "⁻";

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::optional<UnitExponent> product(const UnitExponent& a, const UnitExponent& b) {
    const int numerator = a.numerator * b.numerator;
    const int denominator = a.denominator * b.denominator;
    const int common = std::gcd(numerator, denominator);
    const UnitExponent result{numerator / common, denominator / common};
    if (result.denominator > k_largest_denominator ||
        std::abs(result.numerator) > k_largest_exponent * result.denominator) {
        return std::nullopt;
    }
    return result;
}

struct Refused {
    UnitRefusal refusal;
};

class Reader {
public:
    explicit Reader(std::string_view text) : text_(text) {}

    UnitExpression read() {
        UnitExpression all = unit(0);
        if (at_ < text_.size()) {
            refuse(UnitRefusal::Reason::malformed, quoted_rest() + " cannot stand there");
        }
        return all;
    }

private:
    using Reason = UnitRefusal::Reason;

    static constexpr const char* k_exponent_action =
        "Write a whole number (m^2, s-1), or a fraction in parentheses: V/Hz^(1/2).";

    [[noreturn]] static void refuse(Reason reason, std::string what, std::string action = {}) {
        throw Refused{{reason, std::move(what), std::move(action)}};
    }

    [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
    [[nodiscard]] std::string quoted_rest() const { return "\"" + std::string(rest()) + "\""; }
    [[nodiscard]] bool ends() const { return at_ == text_.size(); }
    [[nodiscard]] char next() const { return ends() ? '\0' : text_[at_]; }

    bool take(std::string_view what) {
        if (!rest().starts_with(what)) {
            return false;
        }
        at_ += what.size();
        return true;
    }
    bool blanks() {
        const std::size_t from = at_;
        while (take(" ")) {
        }
        return at_ > from;
    }

    /// How many bytes of a name begin here: 0, or those of one character.
    [[nodiscard]] std::size_t name_character() const {
        const std::string_view here = rest();
        if (here.empty()) {
            return 0;
        }
        const auto c = static_cast<unsigned char>(here.front());
        if (c < 0x80U) {
            const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%';
            return plain ? 1 : 0;
        }
        const auto begins = [&](std::string_view sign) { return here.starts_with(sign); };
        for (const std::string_view sign : k_dots) {
            if (begins(sign)) {
                return 0;
            }
        }
        for (const std::string_view sign : k_superscripts) {
            if (begins(sign)) {
                return 0;
            }
        }
        return begins(k_superscript_minus) ? 0 : 1;
    }

    [[nodiscard]] bool factor_begins() const { return next() == '(' || name_character() > 0; }

    /// 1 to 99 without a leading zero; what follows must not make another number of it.
    int whole(std::string_view of) {
        std::size_t size = 0;
        int value = 0;
        while (size < rest().size() && is_digit(rest()[size])) {
            value = size < 3 ? value * 10 + (rest()[size] - '0') : 1000;
            ++size;
        }
        if (size == 0 || rest().front() == '0' || value > k_largest_exponent) {
            refuse(Reason::exponent, "the exponent of " + std::string(of) + " is not a whole number from 1 to 99",
                   k_exponent_action);
        }
        at_ += size;
        const bool decimals = (next() == '.' || next() == ',') && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]);
        if (decimals || next() == 'e' || next() == 'E') {
            refuse(Reason::exponent, "the exponent of " + std::string(of) + " is not a whole number",
                   k_exponent_action);
        }
        return value;
    }

    /// The digits of an exponent as small letters above the line, e.g. "⁻²"; 0 where there is none.
    int raised(std::string_view of) {
        const std::size_t from = at_;
        const int sign = take(k_superscript_minus) ? -1 : 1;
        int value = 0;
        bool any = false;
        bool good = true;
        for (bool more = true; more;) {
            more = false;
            for (std::size_t digit = 0; digit < k_superscripts.size(); ++digit) {
                if (take(k_superscripts[digit])) {
                    good = good && (any || digit > 0);
                    value = value > k_largest_exponent ? value : value * 10 + static_cast<int>(digit);
                    any = more = true;
                    break;
                }
            }
        }
        if (at_ == from) {
            return 0;
        }
        if (!any || !good || value > k_largest_exponent) {
            refuse(Reason::exponent, "the exponent of " + std::string(of) + " is not a whole number from 1 to 99",
                   k_exponent_action);
        }
        return sign * value;
    }

    /// Behind "^(": "2)", "-1)", "1/2)".
    UnitExponent fraction(std::string_view of) {
        const int sign = take("-") ? -1 : 1;
        UnitExponent result{sign * whole(of), 1};
        if (take("/")) {
            result.denominator = whole(of);
            const int common = std::gcd(result.numerator, result.denominator);
            result = {result.numerator / common, result.denominator / common};
        }
        if (!take(")")) {
            refuse(Reason::exponent, "the exponent of " + std::string(of) + " is not a fraction such as (1/2)",
                   k_exponent_action);
        }
        if (result.denominator > k_largest_denominator) {
            refuse(Reason::exponent, "the exponent of " + std::string(of) + " has a denominator above 9",
                   k_exponent_action);
        }
        return result;
    }

    /// The exponent that stands here; 1 where there is none.
    UnitExponent exponent(std::string_view of, bool behind_a_name) {
        if (const int above = raised(of); above != 0) {
            return {above, 1};
        }
        if (take("^") || take("**")) {
            if (take("(")) {
                return fraction(of);
            }
            const int sign = take("-") ? -1 : 1;
            return {sign * whole(of), 1};
        }
        const bool minus = next() == '-' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]);
        if (behind_a_name && (minus || is_digit(next()))) {
            const int sign = take("-") ? -1 : 1;
            return {sign * whole(of), 1};
        }
        return {};
    }

    [[nodiscard]] bool number_begins() const { return is_digit(next()) || next() == '.'; }

    UnitNumber number() {
        const std::size_t from = at_;
        UnitNumber result;
        result.mantissa = 0;
        std::size_t digits = 0;
        bool decimals = false;
        const auto malformed = [&] {
            while (!ends() && (is_digit(next()) || next() == '.' || next() == 'e' || next() == '-' || next() == '+')) {
                ++at_;
            }
            refuse(Reason::number, "\"" + std::string(text_.substr(from, at_ - from)) + "\" is not a number of a unit",
                   "Write a number of at most 15 digits above 0, such as 1e-6 or 100, and a blank or * behind it.");
        };
        while (is_digit(next()) ||
               (next() == '.' && !decimals && at_ > from && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))) {
            if (next() == '.') {
                decimals = true;
            } else {
                result.mantissa = digits < k_most_digits ? result.mantissa * 10 + (next() - '0') : 0;
                result.exp10 -= decimals ? 1 : 0;
                ++digits;
            }
            ++at_;
        }
        const bool leading_zero = digits > 1 && text_[from] == '0' && text_[from + 1] != '.';
        if (digits == 0 || digits > k_most_digits || leading_zero || result.mantissa == 0) {
            malformed();
        }
        if (next() == 'e' || next() == 'E') {
            ++at_;
            const int sign = take("-") ? -1 : (take("+"), 1);
            std::size_t size = 0;
            int value = 0;
            while (is_digit(next())) {
                value = size < 2 ? value * 10 + (next() - '0') : 100;
                ++size;
                ++at_;
            }
            if (size == 0 || value > 99) {
                malformed();
            }
            result.exp10 += sign * value;
        }
        const std::string_view written = text_.substr(from, at_ - from);
        const UnitExponent power = exponent(written, false);
        if (power.denominator != 1) {
            refuse(Reason::exponent, "the exponent of " + std::string(written) + " is not a whole number",
                   "Write the number itself, such as 0.1.");
        }
        result.power = power.numerator;
        const bool apart = ends() || next() == ' ' || next() == '/' || next() == ')' || next() == '*' ||
                           dot_follows() || (next() == '.' && at_ + 1 < text_.size() && !is_digit(text_[at_ + 1]));
        if (!apart) {
            malformed();
        }
        return result;
    }

    [[nodiscard]] bool dot_follows() const { return rest().starts_with(k_dots[0]) || rest().starts_with(k_dots[1]); }

    bool take_multiplication() { return take("*") || take(".") || take(k_dots[0]) || take(k_dots[1]); }

    static void raise(UnitExpression& inner, const UnitExponent& power, std::string_view of) {
        for (UnitFactor& factor : inner.factors) {
            const std::optional<UnitExponent> total = product(factor.exponent, power);
            if (!total) {
                refuse(Reason::exponent,
                       "the exponent of " + std::string(factor.text) + " in " + std::string(of) +
                           " is above 99, or a fraction with a denominator above 9",
                       k_exponent_action);
            }
            factor.exponent = *total;
        }
        for (UnitNumber& number : inner.numbers) {
            const std::optional<UnitExponent> total = product({number.power, 1}, power);
            if (!total || total->denominator != 1) {
                refuse(Reason::exponent, "a number to a power that is not whole, or above 99",
                       "Write the number itself, such as 0.1.");
            }
            number.power = total->numerator;
        }
    }

    static void append(UnitExpression& to, UnitExpression&& from) {
        to.factors.insert(to.factors.end(), from.factors.begin(), from.factors.end());
        to.numbers.insert(to.numbers.end(), from.numbers.begin(), from.numbers.end());
        to.plain = to.plain && from.plain;
    }

    UnitExpression factor(int depth) {
        const std::size_t from = at_;
        UnitExpression result;
        if (take("(")) {
            result = unit(depth + 1);
            if (!take(")")) {
                refuse(Reason::malformed, ends() ? "a parenthesis is open" : quoted_rest() + " cannot stand there");
            }
            const std::string_view written = text_.substr(from, at_ - from);
            result.plain = result.plain && !result.quotient && depth == 0;
            result.quotient = false;
            if (const UnitExponent power = exponent(written, false); power != UnitExponent{}) {
                raise(result, power, written);
                result.plain = false;
            }
            return result;
        }
        while (const std::size_t size = name_character()) {
            at_ += size;
        }
        const std::string_view name = text_.substr(from, at_ - from);
        const NamedUnit named = find_unit(name);
        if (named.unit == nullptr) {
            refuse_name(name);
        }
        result.factors.push_back({name, named, exponent(name, true)});
        return result;
    }

    [[noreturn]] static void refuse_name(std::string_view name) {
        for (const AmbiguousUnit& ambiguous : ambiguous_units()) {
            if (ambiguous.name == name) {
                const std::size_t colon = ambiguous.meanings.find(": write ");
                refuse(Reason::not_known,
                       "\"" + std::string(name) + "\" may be " + std::string(ambiguous.meanings.substr(0, colon)),
                       "Write " + std::string(ambiguous.meanings.substr(colon + 8)) + ".");
            }
        }
        refuse(Reason::not_known, "\"" + std::string(name) + "\" is not a unit that is known");
    }

    UnitExpression unit(int depth) {
        UnitExpression all;
        blanks();
        bool first = true;
        if (number_begins()) {
            all.numbers.push_back(number());
            first = false;
        } else if (!factor_begins()) {
            refuse(Reason::malformed, ends() ? "ends where a unit is expected" : quoted_rest() + " is not a unit");
        }
        for (;;) {
            if (first) {
                append(all, factor(depth));
                first = false;
            }
            const bool blank = blanks();
            if (ends() || next() == ')') {
                return all;
            }
            if (take("/")) {
                blanks();
                divide(all, depth);
                continue;
            }
            const bool sign = take_multiplication();
            blanks();
            if (number_begins()) {
                refuse(Reason::number, quoted_rest() + ": a number behind a unit",
                       "Write the number first (1e-6 m), or as an exponent (m^2).");
            }
            if (!(sign || blank) || !factor_begins()) {
                refuse(Reason::malformed,
                       ends() ? "ends where a unit is expected" : quoted_rest() + " cannot stand there");
            }
            if (all.quotient) {
                refuse(Reason::quotient, quoted_rest() + " behind a quotient may be above or below the line",
                       "Write parentheses or negative exponents: J/(kg K), J kg-1 K-1.");
            }
            append(all, factor(depth));
        }
    }

    void divide(UnitExpression& all, int depth) {
        if (number_begins()) {
            refuse(Reason::number, quoted_rest() + ": a number behind /",
                   "Write the number first (0.5 m), or in parentheses with a unit: L/(100 km).");
        }
        if (!factor_begins()) {
            refuse(Reason::malformed, ends() ? "ends where a unit is expected" : quoted_rest() + " is not a unit");
        }
        UnitExpression below = factor(depth);
        raise(below, {-1, 1}, "the denominator");
        append(all, std::move(below));
        all.quotient = true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

UnitReading read_unit_expression(std::string_view text) {
    try {
        return {Reader(text).read(), std::nullopt};
    } catch (Refused& refused) {
        return {{}, std::move(refused.refusal)};
    }
}

}  // namespace gumcert::gum
