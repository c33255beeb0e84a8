#include "gum/quantity/unit_expression.h"
#include "gum/quantity/unit_exponent.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "gum/quantity/unit_meant.h"

namespace gumcert::gum {

namespace {

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

constexpr int k_most_cures = 4;  // of one text, each for one flaw

UnitReading read_with_cures(std::string_view text, int cures);

class Reader {
public:
    /// \param cures  how many flaws of the text may still be mended for the advice
    Reader(std::string_view text, int cures) : text_(text), cures_(cures) {}

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

    [[noreturn]] static void refuse(Reason reason, std::string what, std::string action = {}, std::string cure = {}) {
        throw Refused{{reason, std::move(what), std::move(action), std::move(cure)}};
    }

    /// The text with other letters in a place, where that is a unit or becomes one by cures of its own; else "".
    [[nodiscard]] std::string mended(std::size_t from, std::size_t to, const std::string& by) const {
        if (cures_ == 0) {
            return "";
        }
        std::string text = std::string(text_.substr(0, from)) + by + std::string(text_.substr(to));
        UnitReading again = read_with_cures(text, cures_ - 1);
        return again.refusal ? std::move(again.refusal->cure) : text;
    }

    /// An exponent that is no whole number; the advice is the fraction that it is, if it is one.
    [[noreturn]] void refuse_exponent(std::string_view of, const std::string& what) {
        std::size_t end = exponent_from_;
        while (end < text_.size() && std::string_view("^*(-").find(text_[end]) != std::string_view::npos) {
            ++end;
        }
        const std::string_view signs = text_.substr(exponent_from_, end - exponent_from_);
        std::string decimal;
        while (end < text_.size() && (is_digit(text_[end]) || text_[end] == '.' || text_[end] == ',')) {
            decimal += text_[end] == ',' ? '.' : text_[end];
            ++end;
        }
        if (decimal.empty() && text_.substr(end).starts_with("½")) {
            decimal = "0.5";
            end += std::string_view("½").size();
        }
        end += signs.find('(') != std::string_view::npos && text_.substr(end).starts_with(')') ? 1U : 0U;
        double value = 0.0;
        const auto [stop, failure] = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
        const bool read = failure == std::errc() && stop == decimal.data() + decimal.size() && value > 0.0;
        const std::optional<UnitExponent> exponent =
            read ? unit_exponent(signs.find('-') == std::string_view::npos ? value : -value) : std::nullopt;
        const std::string cure = exponent ? mended(exponent_from_, end, "^" + exponent_text(*exponent)) : "";
        refuse(Reason::exponent, "the exponent of " + std::string(of) + what,
               cure.empty() ? k_exponent_action : "Write " + cure + ".", cure);
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
            refuse_exponent(of, " is not a whole number from 1 to 99");
        }
        at_ += size;
        const bool decimals = (next() == '.' || next() == ',') && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]);
        if (decimals || next() == 'e' || next() == 'E') {
            refuse_exponent(of, " is not a whole number");
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
        exponent_from_ = at_;
        const UnitExponent found = exponent_here(of, behind_a_name);
        exponent_to_ = at_;
        exponent_ = found;
        return found;
    }

    UnitExponent exponent_here(std::string_view of, bool behind_a_name) {
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
            refuse_name(from, name);
        }
        result.factors.push_back({name, named, exponent(name, true)});
        return result;
    }

    /// What stands under a root sign, or in sqrt(…), which begins here: "Hz", "(V A)"; "" for another name.
    [[nodiscard]] std::string_view under_a_root(std::size_t from, std::string_view name) const {
        constexpr std::string_view k_root = "√";
        if (name.starts_with(k_root) && name.size() > k_root.size()) {
            return name.substr(k_root.size());
        }
        if ((name != "sqrt" && name != k_root) || next() != '(') {
            return {};
        }
        const std::size_t begin = from + name.size();
        const std::size_t end = text_.find(')', begin);  // parentheses inside of it are rare
        return end == std::string_view::npos ? std::string_view() : text_.substr(begin, end + 1 - begin);
    }

    [[noreturn]] void refuse_name(std::size_t from, std::string_view name) const {
        if (const std::string_view inner = under_a_root(from, name); !inner.empty()) {
            const auto end = static_cast<std::size_t>(inner.data() - text_.data()) + inner.size();
            const std::string_view bare = inner.substr(1, inner.size() - 2);
            const bool one = inner.starts_with('(') && find_unit(bare).unit != nullptr;
            const std::string cure = mended(from, end, std::string(one ? bare : inner) + "^(1/2)");
            refuse(Reason::not_known, "a root of " + std::string(inner), cure.empty() ? "" : "Write " + cure + ".",
                   cure);
        }
        for (const AmbiguousUnit& ambiguous : ambiguous_units()) {
            if (ambiguous.name == name) {
                const std::size_t colon = ambiguous.meanings.find(": write ");
                refuse(Reason::not_known,
                       "\"" + std::string(name) + "\" may be " + std::string(ambiguous.meanings.substr(0, colon)),
                       "Write " + std::string(ambiguous.meanings.substr(colon + 8)) + ".");
            }
        }
        const std::size_t before = from == 0 ? std::string_view::npos : text_.find_last_not_of(' ', from - 1);
        const bool below_a_line = before != std::string_view::npos && text_[before] == '/';
        refuse(Reason::not_known, "\"" + std::string(name) + "\" is not a unit that is known",
               unit_meant(name, below_a_line));
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
            const std::size_t unit_to = at_;
            const bool blank = blanks();
            if (ends() || next() == ')') {
                return all;
            }
            if (take("/")) {
                slash_at_ = at_ - 1;
                blanks();
                divide(all, depth);
                continue;
            }
            const bool sign = take_multiplication();
            blanks();
            if (number_begins()) {
                refuse_number_behind(unit_to);
            }
            if (!(sign || blank) || !factor_begins()) {
                refuse(Reason::malformed,
                       ends() ? "ends where a unit is expected" : quoted_rest() + " cannot stand there");
            }
            refuse_split_degree(all, unit_to);
            if (all.quotient) {
                refuse(Reason::quotient, quoted_rest() + " behind a quotient may be above or below the line",
                       "Write parentheses or negative exponents: J/(kg K), J kg-1 K-1.");
            }
            append(all, factor(depth));
        }
    }

    /// "m 3/2": most probably an exponent.
    /// \param unit_to  where the unit before it ends
    [[noreturn]] void refuse_number_behind(std::size_t unit_to) {
        std::size_t end = at_;
        while (end < text_.size() && (is_digit(text_[end]) || text_[end] == '/')) {
            ++end;
        }
        const std::string number(text_.substr(at_, end - at_));
        const bool fraction = number.find('/') != std::string::npos;
        const std::string cure = exponent_from_ == unit_to && exponent_ == UnitExponent{}
                                     ? mended(unit_to, end, fraction ? "^(" + number + ")" : "^" + number)
                                     : "";
        refuse(Reason::number, quoted_rest() + ": a number behind a unit",
               cure.empty() ? "Write the number first (1e-6 m), or as an exponent (m^2)."
                            : "Write " + cure + " where it is an exponent; a number of the unit stands first (1e-6 m).",
               cure);
    }

    /// "° C", "deg C" are no products of an angle and the coulomb.
    /// \param unit_to  where the unit before ends
    void refuse_split_degree(const UnitExpression& all, std::size_t unit_to) {
        static constexpr std::array<std::string_view, 4> k_degrees{"°", "deg", "degree", "degrees"};
        static constexpr std::array<std::string_view, 4> k_scales{"C", "F", "K", "R"};
        const std::string_view before = all.factors.empty() ? std::string_view() : all.factors.back().text;
        const bool degree = std::find(k_degrees.begin(), k_degrees.end(), before) != k_degrees.end() &&
                            before.data() + before.size() == text_.data() + unit_to;
        std::size_t size = 0;
        while (at_ + size < text_.size() && ((text_[at_ + size] >= 'A' && text_[at_ + size] <= 'Z') ||
                                             (text_[at_ + size] >= 'a' && text_[at_ + size] <= 'z'))) {
            ++size;
        }
        const std::string_view scale = text_.substr(at_, size);
        const bool blanks_only = text_.substr(unit_to, at_ - unit_to).find_first_not_of(' ') == std::string_view::npos;
        if (!degree || !blanks_only || std::find(k_scales.begin(), k_scales.end(), scale) == k_scales.end()) {
            return;
        }
        const std::size_t from = unit_to - before.size();
        const std::string cure = mended(from, at_ + size, scale == "K" ? "K" : "deg" + std::string(scale));
        const std::string both = std::string(before) + "*" + std::string(scale);
        const std::string product = mended(from, at_ + size, all.quotient ? "(" + both + ")" : both);
        refuse(Reason::not_known,
               "\"" + std::string(before) + " " + std::string(scale) +
                   "\" may be a temperature or a product with an angle",
               cure.empty()      ? ""
               : product.empty() ? "Write " + cure + "."
                                 : "Write " + cure + " for a temperature, or " + product + " for the product.",
               cure);
    }

    /// "m^5/2": most probably an exponent without its parentheses.
    [[noreturn]] void refuse_number_below(bool below) {
        std::size_t end = at_;
        while (end < text_.size() && is_digit(text_[end])) {
            ++end;
        }
        const bool follows = exponent_to_ == slash_at_ && exponent_from_ < exponent_to_ && exponent_.denominator == 1 &&
                             at_ == slash_at_ + 1;
        const std::string denominator(text_.substr(at_, end - at_));
        const auto with = [&](int numerator) {
            return follows ? mended(exponent_from_, end, "^(" + std::to_string(numerator) + "/" + denominator + ")")
                           : "";
        };
        const bool twice_below = below && exponent_.numerator < 0;
        const std::string cure = with(twice_below ? -exponent_.numerator : exponent_.numerator);
        refuse(Reason::number, quoted_rest() + ": a number behind /",
               cure.empty()  ? "Write the number first (0.5 m), or in parentheses with a unit: L/(100 km)."
               : twice_below ? "Write " + cure + " where the power is below the line, " + with(exponent_.numerator) +
                                   " where it is above."
                             : "Write " + cure +
                                   " where the exponent is a fraction; a number of the unit stands first "
                                   "(0.5 m).",
               cure);
    }

    void divide(UnitExpression& all, int depth) {
        if (number_begins()) {
            refuse_number_below(all.quotient);
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
    int cures_;
    std::size_t exponent_from_ = 0, exponent_to_ = 0;  ///< the last exponent, or where one could stand
    UnitExponent exponent_;
    std::size_t slash_at_ = 0;  ///< the last one
};

UnitReading read_with_cures(std::string_view text, int cures) {
    try {
        return {Reader(text, cures).read(), std::nullopt};
    } catch (Refused& refused) {
        return {{}, std::move(refused.refusal)};
    }
}

}  // namespace

UnitReading read_unit_expression(std::string_view text) {
    return read_with_cures(text, k_most_cures);
}

}  // namespace gumcert::gum
