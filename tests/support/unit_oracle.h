#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::test {

/// A second reader of units, written apart from the first: a scanner and a stack in place of recursion, sizes as
/// logarithms, names defined by equations among units in place of exponents of base units.
class UnitOracle {
public:
    struct Meaning {
        double log2_size = 0.0;
        std::array<double, 9> exponents{};
        bool celsius = false;
        double zero = 0.0;  ///< 0 of the scale, [°C]
    };

    UnitOracle() {
        static constexpr std::array<const char*, 9> k_base{"m", "kg", "s", "A", "K", "mol", "cd", "rad", "dB"};
        for (std::size_t i = 0; i < k_base.size(); ++i) {
            Size base;
            base.exponents[i] = 1;
            equations_[k_base[i]] = base;
        }
        std::istringstream lines{std::string(k_equations)};
        for (std::string line; std::getline(lines, line);) {
            if (!line.empty()) {
                define(line);
            }
        }
        for (const auto& [word, exponent] : k_prefixes) {
            for (const auto& [name, unit] : std::map<std::string, Named>(names_)) {
                const bool long_prefix =
                    std::string_view(word).size() > 2 && static_cast<unsigned char>(word[0]) < 0x80;
                if (unit.multiples && unit.is_name == long_prefix) {
                    Named multiple = unit;
                    multiple.size.log2 += static_cast<long double>(exponent) * std::log2(10.0L);
                    with_prefix_.emplace(word + name, multiple);
                }
            }
        }
        std::istringstream refused{std::string(k_refused)};
        for (std::string word; refused >> word;) {
            with_prefix_.erase(word);
        }
    }

    /// What a text means as a unit; nothing where it is none.
    [[nodiscard]] std::optional<Meaning> read(std::string_view text) const {
        if (text.empty() || text == "1") {
            return Meaning{};
        }
        if (text.size() > 256 || text.front() == ' ' || text.back() == ' ') {
            return std::nullopt;
        }
        std::vector<Group> stack(1);
        std::size_t i = 0;
        enum class State { begin, wanted, behind } state = State::begin;  // of a group; a factor is due; or was there
        while (i < text.size()) {
            const std::size_t before = i;
            while (i < text.size() && text[i] == ' ') {
                ++i;
            }
            const bool blank = i > before;
            Group& group = stack.back();
            if (i == text.size()) {
                break;
            }
            if (state == State::behind) {
                if (text[i] == ')') {
                    ++i;
                    if (stack.size() == 1 || !close(stack, text, i)) {
                        return std::nullopt;
                    }
                    continue;
                }
                if (text[i] == '/') {
                    ++i;
                    group.below = group.quotient = true;
                    state = State::wanted;
                    continue;
                }
                const std::size_t sign = multiplication(text, i);
                i += sign;
                if ((sign == 0 && !blank) || group.quotient) {
                    return std::nullopt;
                }
                state = State::wanted;
                continue;
            }
            if (text[i] == '(') {
                ++i;
                stack.emplace_back();
                state = State::begin;
                continue;
            }
            const bool number = text[i] >= '0' && text[i] <= '9';
            if (number && state != State::begin) {
                return std::nullopt;
            }
            const std::optional<Term> term = number ? read_number(text, i) : read_name(text, i);
            if (!term) {
                return std::nullopt;
            }
            add(group, *term);
            state = State::behind;
        }
        if (stack.size() != 1 || state != State::behind) {
            return std::nullopt;
        }
        return meaning(stack.front());
    }

private:
    struct Size {
        long double log2 = 0.0L;
        std::array<int, 9> exponents{};
    };
    struct Named {
        Size size;
        bool multiples = false, is_name = false;
        char scale = ' ';
    };
    struct Term {
        Size size;
        int numerator = 1, denominator = 1;
        bool number = false;
        char scale = ' ';
    };
    struct Group {
        std::vector<Term> terms;
        bool below = false, quotient = false;
    };

    static bool reduce(Term& term, int numerator, int denominator) {
        term.numerator *= numerator;
        term.denominator *= denominator;
        const int common = std::gcd(term.numerator, term.denominator);
        term.numerator /= common;
        term.denominator /= common;
        const bool small = std::abs(static_cast<double>(term.numerator) / term.denominator) <= 99.0;
        return small && term.denominator <= (term.number ? 1 : 9);
    }

    static void add(Group& group, Term term) {
        if (group.below) {
            term.numerator = -term.numerator;
            group.below = false;
        }
        group.terms.push_back(term);
    }

    /// Ends the innermost group behind its parenthesis.
    static bool close(std::vector<Group>& stack, std::string_view text, std::size_t& i) {
        const Group inner = stack.back();
        stack.pop_back();
        std::pair<int, int> power{1, 1};
        if (!read_exponent(text, i, false, power)) {
            return false;
        }
        const bool below = stack.back().below;
        for (Term term : inner.terms) {
            if (!reduce(term, power.first, power.second)) {
                return false;
            }
            stack.back().below = below;
            add(stack.back(), term);
        }
        stack.back().below = false;
        return true;
    }

    static std::size_t multiplication(std::string_view text, std::size_t i) {
        for (const std::string_view sign :
             {std::string_view("*"), std::string_view("."), std::string_view("·"), std::string_view("⋅")}) {
            if (text.substr(i, sign.size()) == sign) {
                return sign.size();
            }
        }
        return 0;
    }

    static char at(std::string_view text, std::size_t i) { return i < text.size() ? text[i] : '\0'; }
    static bool digit(char c) { return c >= '0' && c <= '9'; }

    static bool read_whole(std::string_view text, std::size_t& i, int& value) {
        std::size_t end = i;
        while (digit(at(text, end))) {
            ++end;
        }
        if (end == i || end - i > 2 || text[i] == '0') {
            return false;
        }
        value = std::stoi(std::string(text.substr(i, end - i)));
        i = end;
        const char next = at(text, i);
        return !((next == '.' || next == ',') && digit(at(text, i + 1))) && next != 'e' && next != 'E';
    }

    static std::optional<int> superscript(std::string_view text, std::size_t& i) {
        static const std::array<std::string, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
        for (std::size_t d = 0; d < digits.size(); ++d) {
            if (text.substr(i, digits[d].size()) == digits[d]) {
                i += digits[d].size();
                return static_cast<int>(d);
            }
        }
        return std::nullopt;
    }

    static bool read_exponent(std::string_view text, std::size_t& i, bool name, std::pair<int, int>& result) {
        const std::string_view above_minus = "⁻";
        std::size_t j = i;
        const bool raised_minus = text.substr(j, above_minus.size()) == above_minus;
        j += raised_minus ? above_minus.size() : 0;
        std::string raised;
        while (const auto d = superscript(text, j)) {
            raised += static_cast<char>('0' + *d);
        }
        if (raised_minus || !raised.empty()) {
            i = j;
            if (raised.empty() || raised.size() > 2 || raised[0] == '0') {
                return false;
            }
            result = {(raised_minus ? -1 : 1) * std::stoi(raised), 1};
            return true;
        }
        const bool caret = at(text, i) == '^';
        const bool stars = at(text, i) == '*' && at(text, i + 1) == '*';
        const bool glued = name && (digit(at(text, i)) || (at(text, i) == '-' && digit(at(text, i + 1))));
        if (!caret && !stars && !glued) {
            return true;
        }
        i += caret ? 1 : stars ? 2 : 0;
        const bool fraction = !glued && at(text, i) == '(';
        i += fraction ? 1 : 0;
        const bool minus = at(text, i) == '-';
        i += minus ? 1 : 0;
        if (!read_whole(text, i, result.first)) {
            return false;
        }
        result.first = minus ? -result.first : result.first;
        if (!fraction) {
            return true;
        }
        if (at(text, i) == '/') {
            ++i;
            if (!read_whole(text, i, result.second)) {
                return false;
            }
        }
        if (at(text, i) != ')') {
            return false;
        }
        ++i;
        const int common = std::gcd(result.first, result.second);
        result = {result.first / common, result.second / common};
        return result.second <= 9;
    }

    static std::optional<Term> read_number(std::string_view text, std::size_t& i) {
        std::string digits;
        int exponent = 0;
        const std::size_t from = i;
        while (digit(at(text, i))) {
            digits += text[i++];
        }
        if (digits.size() > 1 && digits[0] == '0') {
            return std::nullopt;
        }
        if (at(text, i) == '.' && digit(at(text, i + 1))) {
            ++i;
            while (digit(at(text, i))) {
                digits += text[i++];
                --exponent;
            }
        }
        if (digits.size() > 15 || digits.find_first_not_of('0') == std::string::npos || i == from) {
            return std::nullopt;
        }
        if (at(text, i) == 'e' || at(text, i) == 'E') {
            ++i;
            const int sign = at(text, i) == '-' ? -1 : 1;
            i += at(text, i) == '-' || at(text, i) == '+' ? 1U : 0U;
            std::string e;
            while (digit(at(text, i))) {
                e += text[i++];
            }
            if (e.empty() || e.size() > 2) {
                return std::nullopt;
            }
            exponent += sign * std::stoi(e);
        }
        std::pair<int, int> power{1, 1};
        if (!read_exponent(text, i, false, power) || power.second != 1) {
            return std::nullopt;
        }
        const bool point_of_decimals = at(text, i) == '.' && (digit(at(text, i + 1)) || i + 1 == text.size());
        if (point_of_decimals) {
            return std::nullopt;
        }
        Term term;
        term.number = true;
        term.numerator = power.first;
        term.size.log2 = std::log2(std::stold(digits)) + static_cast<long double>(exponent) * std::log2(10.0L);
        return term;
    }

    [[nodiscard]] std::optional<Term> read_name(std::string_view text, std::size_t& i) const {
        std::size_t end = i;
        while (end < text.size()) {
            const char c = text[end];
            std::size_t raised = end;
            const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%';
            const bool sign =
                multiplication(text, end) > 0 || superscript(text, raised).has_value() || text.substr(end, 3) == "⁻";
            if (!letter && (static_cast<unsigned char>(c) < 0x80 || sign)) {
                break;
            }
            ++end;
        }
        const std::string name(text.substr(i, end - i));
        i = end;
        auto found = names_.find(name);
        if (found == names_.end()) {
            found = with_prefix_.find(name);
            if (found == with_prefix_.end()) {
                return std::nullopt;
            }
        }
        std::pair<int, int> power{1, 1};
        if (!read_exponent(text, i, true, power)) {
            return std::nullopt;
        }
        return Term{found->second.size, power.first, power.second, false, found->second.scale};
    }

    static std::optional<Meaning> meaning(const Group& group) {
        Meaning result;
        long double log2 = 0.0L;
        std::array<int, 9> parts{};  // in 1/2520, the least common multiple of 1 to 9
        std::size_t numbers = 0;
        for (const Term& term : group.terms) {
            numbers += term.number ? 1 : 0;
            log2 +=
                term.size.log2 * static_cast<long double>(term.numerator) / static_cast<long double>(term.denominator);
            for (std::size_t k = 0; k < parts.size(); ++k) {
                parts[k] += term.size.exponents[k] * term.numerator * (2520 / term.denominator);
            }
        }
        for (std::size_t k = 0; k < parts.size(); ++k) {
            result.exponents[k] = parts[k] / 2520.0;
        }
        result.log2_size = static_cast<double>(log2);
        if (group.terms.size() - numbers == 1) {
            for (const Term& term : group.terms) {
                if (!term.number && term.scale != ' ' && term.numerator == 1 && term.denominator == 1) {
                    result.celsius = true;
                    result.zero = term.scale == 'F' ? -32.0 / 1.8 : 0.0;
                }
            }
        }
        if ((result.celsius && numbers > 0) || std::abs(log2) > 830.0L) {
            return std::nullopt;
        }
        return result;
    }

    /// "names… = number of other units", see below.
    void define(const std::string& line) {
        const std::size_t equals = line.find('=');
        const std::size_t bar = line.find('|');
        Size size;
        std::istringstream words(line.substr(equals + 1));
        Named named;
        for (std::string word; words >> word;) {
            if (word[0] == '@') {
                named.scale = word[1];
            } else if (digit(word[0])) {
                const std::size_t slash = word.find('/');
                size.log2 += std::log2(std::stold(word));
                size.log2 -= slash == std::string::npos ? 0.0L : std::log2(std::stold(word.substr(slash + 1)));
            } else {
                const std::size_t caret = word.find('^');
                const int power = caret == std::string::npos ? 1 : std::stoi(word.substr(caret + 1));
                const std::string of = word.substr(0, caret);
                if (of == "pi") {
                    size.log2 += power * std::log2(3.14159265358979323846L);
                    continue;
                }
                const Size& other = equations_.at(of);
                size.log2 += power * other.log2;
                for (std::size_t k = 0; k < size.exponents.size(); ++k) {
                    size.exponents[k] += power * other.exponents[k];
                }
            }
        }
        named.size = size;
        named.multiples = line[0] == '+';
        std::istringstream symbols(line.substr(1, bar - 1));
        std::istringstream long_names(line.substr(bar + 1, equals - bar - 1));
        for (std::string word; symbols >> word;) {
            equations_[word] = size;
            names_[word] = named;
        }
        named.is_name = true;
        for (std::string word; long_names >> word;) {
            equations_[word] = size;
            names_[word] = named;
        }
    }

    // "+" takes prefixes; symbols | names = definition by numbers (a fraction a/b is a number) and units above it.
    static constexpr std::string_view k_equations = R"(
+m | metre metres meter meters = m
+g | gram grams = 1/1000 kg
+s sec | second seconds = s
+A | ampere amperes = A
+K | kelvin kelvins = K
+mol | mole moles = mol
+cd | candela candelas = cd
+rad | radian radians = rad
+dB | decibel decibels = dB
+sr | steradian steradians = rad^2
+Hz | hertz = s^-1
+N | newton newtons = kg m s^-2
+Pa | pascal pascals = N m^-2
+J | joule joules = N m
+W | watt watts = J s^-1
+C | coulomb coulombs = A s
+V | volt volts = W A^-1
+F | farad farads = C V^-1
+ohm Ohm Ω )"
                                                    "\u2126"
                                                    R"( | ohms = V A^-1
+S | siemens = A V^-1
+Wb | weber webers = V s
+T | tesla teslas = Wb m^-2
+H | henry henries henrys = Wb A^-1
+lm | lumen lumens = cd sr
+lx | lux = lm m^-2
+Bq | becquerel becquerels = s^-1
+Gy | gray grays = J kg^-1
+Sv | sievert sieverts = J kg^-1
+kat | katal katals = mol s^-1
+degC °C ℃ degrees_C | degree_Celsius celsius = K @C
-degF °F ℉ | degree_Fahrenheit fahrenheit = 5/9 K @F
-delta_degC | = K
-delta_degF | = 5/9 K
-degR °R | degree_Rankine rankine = 5/9 K
-min | minute minutes = 60 s
-h hr | hour hours = 60 min
-d | day days = 24 h
-au | astronomical_unit astronomical_units = 149597870700 m
+deg ° | degree degrees arc_degree arcdeg = 1/180 pi rad
-arcmin ′ | arcminute arcminutes arc_minute arc_minutes = 1/60 deg
+arcsec ″ | arcsecond arcseconds arc_second arc_seconds = 1/60 arcmin
-ha | hectare hectares = 10000 m^2
+L l | litre litres liter liters = 1/1000 m^3
+t | tonne tonnes metric_ton metric_tons = 1000 kg
+eV | electronvolt electronvolts = 1.602176634e-19 J
+bar | bars = 100000 Pa
-percent % | = 1/100
-permille ‰ | = 1/1000
-ppm | = 1/1000000
-ppb | = 1/1000000000
-count counts | = 1
+gon | gons grade grades = 9/10 deg
-turn rev cycle | turns revolution revolutions cycles = 360 deg
-rps | = turn s^-1
-rpm | = turn min^-1
+Wh | = W h
+Ah | = A h
+VA | voltampere voltamperes = V A
+var | = V A
-week weeks | = 7 d
-Julian_year Julian_years | = 365.25 d
-angstrom angstroms Å )"
                                                    "\u212B"
                                                    R"( | = 1e-10 m
-micron microns | = 1e-6 m
+barn | barns = 1e-28 m^2
-cc | = 1e-6 m^3
-dpt | dioptre dioptres diopter diopters = m^-1
+Gal | galileo = 1/100 m s^-2
-g_n | standard_free_fall = 9.80665 m s^-2
+dyn | dyne dynes = 1e-5 N
-erg ergs | = 1e-7 J
+P | poise = 1/10 Pa s
+St | stokes = 1e-4 m^2 s^-1
+gauss | = 1e-4 T
+Oe | oersted oersteds = 1000/4 pi^-1 A m^-1
+Mx | maxwell maxwells = 1e-8 Wb
+Ci | curie curies = 3.7e10 Bq
+roentgen | roentgens = 2.58e-4 C kg^-1
-nit | nits = cd m^-2
-in | inch inches international_inch = 0.0254 m
-ft | foot feet international_foot = 12 in
-footcandle footcandles | = lm ft^-2
+tex | = 1e-6 kg m^-1
-denier | = 1/9 tex
-uin µin μin | microinch microinches = 1e-6 in
-mil mils thou | = 1/1000 in
-yd | yard yards = 3 ft
-mi | mile miles = 1760 yd
-nmi | nautical_mile nautical_miles = 1852 m
-knot knots | = nmi h^-1
-mph | = mi h^-1
-lb lbs | pound pounds = 0.45359237 kg
-ounce ounces | avoirdupois_ounce = 1/16 lb
-gr | grain grains = 1/7000 lb
-troy_ounce troy_ounces | = 480 gr
-carat carats | = 2e-4 kg
-kgf | kilogram_force = kg g_n
-gf | gram_force = 1/1000 kgf
-lbf | pound_force = lb g_n
-ozf | ounce_force = ounce g_n
-slug slugs | = lbf s^2 ft^-1
-short_ton short_tons | = 2000 lb
-long_ton long_tons | = 2240 lb
-US_liquid_gallon US_liquid_gallons | = 231 in^3
-UK_liquid_gallon UK_liquid_gallons | = 4.54609e-3 m^3
-psi | = lbf in^-2
-ksi | = 1000 psi
-atm | atmosphere atmospheres standard_atmosphere = 101325 Pa
-technical_atmosphere | = kgf 10000 m^-2
+Torr torr | = 1/760 atm
-mmHg | = 13.5951 g_n kg m^-2
-cmHg | = 10 mmHg
-inHg | = 25.4 mmHg
+cal_th | thermochemical_calorie thermochemical_calories = 4.184 J
+cal_IT | IT_calorie IT_calories = 4.1868 J
-Btu_IT | IT_Btu = 1055.05585262 J
-metric_horsepower | = 75 kgf m s^-1
-mechanical_horsepower | = 550 ft lbf s^-1
)";

    static constexpr std::string_view k_refused = "kt at pt mb PS ct";

    static inline const std::vector<std::pair<std::string, int>> k_prefixes{
        {"da", 1},     {"h", 2},     {"k", 3},      {"M", 6},       {"G", 9},      {"T", 12},      {"P", 15},
        {"E", 18},     {"Z", 21},    {"Y", 24},     {"d", -1},      {"c", -2},     {"m", -3},      {"u", -6},
        {"µ", -6},     {"μ", -6},    {"n", -9},     {"p", -12},     {"f", -15},    {"a", -18},     {"z", -21},
        {"y", -24},    {"deca", 1},  {"hecto", 2},  {"kilo", 3},    {"mega", 6},   {"giga", 9},    {"tera", 12},
        {"peta", 15},  {"exa", 18},  {"zetta", 21}, {"yotta", 24},  {"deci", -1},  {"centi", -2},  {"milli", -3},
        {"micro", -6}, {"nano", -9}, {"pico", -12}, {"femto", -15}, {"atto", -18}, {"zepto", -21}, {"yocto", -24}};

    std::map<std::string, Size> equations_;
    std::map<std::string, Named> names_;
    std::map<std::string, Named> with_prefix_;
};

}  // namespace gumcert::test
