#include "reports/dcc/d_si_unit.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::reports {

namespace {

using Name = std::pair<std::string_view, std::string_view>;  // D-SI, ours

constexpr std::array k_prefixes{
    Name{"deca", "da"}, Name{"hecto", "h"}, Name{"kilo", "k"},  Name{"mega", "M"},  Name{"giga", "G"},
    Name{"tera", "T"},  Name{"peta", "P"},  Name{"exa", "E"},   Name{"zetta", "Z"}, Name{"yotta", "Y"},
    Name{"deci", "d"},  Name{"centi", "c"}, Name{"milli", "m"}, Name{"micro", "u"}, Name{"nano", "n"},
    Name{"pico", "p"},  Name{"femto", "f"}, Name{"atto", "a"},  Name{"zepto", "z"}, Name{"yocto", "y"},
};

constexpr std::array k_units{
    Name{"metre", "m"},         Name{"kilogram", "kg"},  Name{"gram", "g"},           Name{"second", "s"},
    Name{"ampere", "A"},        Name{"kelvin", "K"},     Name{"mole", "mol"},         Name{"candela", "cd"},
    Name{"radian", "rad"},      Name{"steradian", "sr"}, Name{"hertz", "Hz"},         Name{"newton", "N"},
    Name{"pascal", "Pa"},       Name{"joule", "J"},      Name{"watt", "W"},           Name{"coulomb", "C"},
    Name{"volt", "V"},          Name{"farad", "F"},      Name{"ohm", "ohm"},          Name{"siemens", "S"},
    Name{"weber", "Wb"},        Name{"tesla", "T"},      Name{"henry", "H"},          Name{"degreecelsius", "degC"},
    Name{"lumen", "lm"},        Name{"lux", "lx"},       Name{"becquerel", "Bq"},     Name{"gray", "Gy"},
    Name{"sievert", "Sv"},      Name{"katal", "kat"},    Name{"minute", "min"},       Name{"hour", "h"},
    Name{"day", "d"},           Name{"degree", "deg"},   Name{"arcminute", "arcmin"}, Name{"arcsecond", "arcsec"},
    Name{"litre", "L"},         Name{"tonne", "t"},      Name{"electronvolt", "eV"},  Name{"bar", "bar"},
    Name{"percent", "percent"}, Name{"ppm", "ppm"},      Name{"decibel", "dB"},       Name{"hectare", "hectare"},
    Name{"one", "1"},
};

// Units and prefixes of D-SI that this program has no counterpart for.
constexpr std::array<std::string_view, 36> k_other_words{"deka",
                                                         "kibi",
                                                         "mebi",
                                                         "gibi",
                                                         "tebi",
                                                         "pebi",
                                                         "exbi",
                                                         "zebi",
                                                         "yobi",
                                                         "ronna",
                                                         "quetta",
                                                         "ronto",
                                                         "quecto",
                                                         "bit",
                                                         "byte",
                                                         "neper",
                                                         "bel",
                                                         "dalton",
                                                         "atomicmassunit",
                                                         "astronomicalunit",
                                                         "electronmass",
                                                         "planckbar",
                                                         "clight",
                                                         "hartree",
                                                         "bohr",
                                                         "elementarycharge",
                                                         "naturalunitoftime",
                                                         "atomicunitoftime",
                                                         "angstrom",
                                                         "barn",
                                                         "knot",
                                                         "nauticalmile",
                                                         "mmhg",
                                                         "gal",
                                                         "erg",
                                                         "dyne"};

template <std::size_t size>
std::optional<std::string_view> look_up(const std::array<Name, size>& names, std::string_view name) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const Name& n) { return n.first == name; });
    return found == names.end() ? std::nullopt : std::optional(found->second);
}

struct Power {
    int numerator = 1, denominator = 1;
};

/// Walks over "\kilo\gram\per\metre\tothe{3}".
class Tokens {
public:
    explicit Tokens(std::string_view text) : rest_(text) {}

    [[nodiscard]] bool empty() const { return rest_.empty(); }
    /// The word behind the next backslash; nothing where there is none.
    std::optional<std::string_view> word() {
        if (rest_.empty() || rest_.front() != '\\') {
            return std::nullopt;
        }
        std::size_t end = 1;
        while (end < rest_.size() && rest_[end] >= 'a' && rest_[end] <= 'z') {
            ++end;
        }
        const std::string_view found = rest_.substr(1, end - 1);
        rest_.remove_prefix(end);
        return found.empty() ? std::nullopt : std::optional(found);
    }
    [[nodiscard]] bool at_power() const { return rest_.starts_with(k_power); }
    /// The exponent in braces, a decimal number.
    std::optional<double> decimal_power() {
        rest_.remove_prefix(k_power.size());
        const std::size_t end = rest_.find('}');
        if (end == std::string_view::npos) {
            return std::nullopt;
        }
        double value = 0.0;
        const char* const last = rest_.data() + end;
        const auto [stop, failure] = std::from_chars(rest_.data(), last, value, std::chars_format::fixed);
        rest_.remove_prefix(end + 1);
        return failure == std::errc() && stop == last ? std::optional(value) : std::nullopt;
    }
    /// The exponent; nothing for one that no unit of ours has, such as 0.333333.
    std::optional<Power> power() {
        const std::optional<double> value = decimal_power();
        constexpr double k_largest = 99.0;
        if (!value || !(std::abs(*value) <= k_largest) || *value == 0.0) {
            return std::nullopt;
        }
        // Halves, quarters, eighths and fifths are decimal numbers.
        // A unit here has an exact fraction as exponent, so that units can be compared and cancelled without rounding.
        // A third has no finite decimal form, so 0.333333 could be another number as well as a third: it is refused and
        // not guessed.
        for (const int denominator : {1, 2, 4, 5, 8}) {
            const double numerator = std::round(*value * denominator);
            constexpr double k_noise = 1e-12;  // of a product with a fifth
            if (std::abs(*value * denominator - numerator) < k_noise) {
                return Power{static_cast<int>(numerator), denominator};
            }
        }
        return std::nullopt;
    }

private:
    static constexpr std::string_view k_power = "\\tothe{";
    std::string_view rest_;
};

bool is_unit(const std::string& text) {
    try {
        (void)gum::Unit::parse(text);
        return true;
    } catch (const gum::InputError&) {
        return false;
    }
}

bool is_other_word(std::string_view word) {
    return std::find(k_other_words.begin(), k_other_words.end(), word) != k_other_words.end();
}

/// Whether a symbol with a prefix is that multiple of the unit for us too: "ft" is a foot and no femtotonne, "kt" the
/// knot of some, "m1" a metre and no thousandth.
bool is_multiple(std::string_view prefix, std::string_view unit) {
    if (unit == "1") {
        return false;
    }
    static constexpr std::array<std::pair<std::string_view, int>, 20> k_exponents{
        {{"da", 1}, {"h", 2},   {"k", 3},   {"M", 6},   {"G", 9},   {"T", 12}, {"P", 15},
         {"E", 18}, {"Z", 21},  {"Y", 24},  {"d", -1},  {"c", -2},  {"m", -3}, {"u", -6},
         {"n", -9}, {"p", -12}, {"f", -15}, {"a", -18}, {"z", -21}, {"y", -24}}};
    const auto exponent =
        std::find_if(k_exponents.begin(), k_exponents.end(), [&](const auto& e) { return e.first == prefix; });
    try {
        // Asked of the parser itself: a list of the symbols that collide would have to follow every new unit.
        const gum::Unit multiple = gum::Unit::parse(std::string(prefix) + std::string(unit));
        const gum::Unit one = gum::Unit::parse(unit);
        const double expected = one.difference_to_si(std::pow(10.0, exponent->second));
        constexpr double k_noise = 1e-12;  // of the division, relative
        return multiple.dimension() == one.dimension() &&
               std::abs(multiple.difference_to_si(1.0) - expected) <= k_noise * std::abs(expected);
    } catch (const gum::InputError&) {
        return false;
    }
}

/// One factor such as "\\milli\\metre\\tothe{2}" behind its first word; `sign` is -1 in the denominator. Nothing for
/// one that is not known. One itself is "".
std::optional<std::string> factor_of(std::optional<std::string_view> word, Tokens& tokens, int sign) {
    const auto prefix = word ? look_up(k_prefixes, *word) : std::nullopt;
    if (prefix) {
        word = tokens.word();
    }
    const auto unit = word ? look_up(k_units, *word) : std::nullopt;
    if (!unit || (prefix && !is_multiple(*prefix, *unit))) {
        return std::nullopt;
    }
    Power power;
    if (tokens.at_power()) {
        const std::optional<Power> stated = tokens.power();
        if (!stated) {
            return std::nullopt;
        }
        power = *stated;
    }
    if (*unit == "1") {
        return "";  // a factor of one says nothing
    }
    power.numerator *= sign;
    const std::string numerator = std::to_string(power.numerator);
    return std::string(prefix.value_or("")) + std::string(*unit) +
           (power.denominator != 1 ? "^(" + numerator + "/" + std::to_string(power.denominator) + ")"
            : power.numerator == 1 ? ""
                                   : numerator);
}

/// A unit behind "|" by the names of our table: one that D-SI has is not called so there, and the name may mean another thing.
/// The writer sets "_" for the blanks between factors, which would split a list, and names have some of their own: each factor
/// is the longest unit that the text goes on with.
std::optional<std::string> unit_outside_of_d_si(std::string_view text) {
    constexpr std::size_t k_longest = 100;  // [byte]: of no unit that a certificate has
    std::string unit;
    while (!text.empty() && text.size() <= k_longest) {
        std::size_t end = text.size();
        while (end != std::string_view::npos && end > 0 && !is_unit(std::string(text.substr(0, end)))) {
            end = text.rfind('_', end - 1);
        }
        if (end == std::string_view::npos || end == 0) {
            return std::nullopt;
        }
        unit += (unit.empty() ? "" : " ") + std::string(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return text.empty() && is_unit(unit) && !gum::unit_in_d_si(unit) ? std::optional(unit) : std::nullopt;
}

}  // namespace

bool is_d_si(std::string_view text) {
    if (text.starts_with('|')) {
        return text.size() > 1;
    }
    Tokens tokens(text);
    bool complete = false;  // a unit stands at the end, or an exponent behind one
    bool divided = false;
    while (!tokens.empty()) {
        const auto word = tokens.word();
        const bool prefix = word && look_up(k_prefixes, *word);
        if (!word || (*word == "per" && (divided || !complete)) ||
            (*word != "per" && !prefix && !look_up(k_units, *word) && !is_other_word(*word))) {
            return false;
        }
        divided = divided || *word == "per";
        complete = !prefix && *word != "per";
        if (tokens.at_power() && (!complete || !tokens.decimal_power())) {
            return false;
        }
    }
    return complete;
}

std::optional<std::string> unit_from_d_si(std::string_view text) {
    if (text.starts_with('|')) {
        return unit_outside_of_d_si(std::string(text.substr(1)));
    }
    Tokens tokens(text);
    std::string result;
    int sign = 1;
    bool complete = false;  // a unit stands behind the last \per, or there is a unit at all
    while (!tokens.empty()) {
        const auto word = tokens.word();
        if (word == "per") {
            if (sign == -1) {
                return std::nullopt;  // D-SI has one \per at most: a second one may mean either
            }
            sign = -1;
            complete = false;
            continue;
        }
        const std::optional<std::string> factor = factor_of(word, tokens, sign);
        if (!factor) {
            return std::nullopt;
        }
        complete = true;
        if (!factor->empty()) {
            result += (result.empty() ? "" : " ") + *factor;
        }
    }
    // \per without a unit behind it, or a text without any unit.
    if (!complete) {
        return std::nullopt;
    }
    if (result.empty()) {
        return "1";
    }
    return is_unit(result) ? std::optional(result) : std::nullopt;
}

}  // namespace gumcert::reports
