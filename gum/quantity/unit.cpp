#include "gum/quantity/unit.h"

#include <udunits2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

const std::array<std::string_view, Dimension::k_base_units> Dimension::k_symbols{"m",   "kg", "s",   "A", "K",
                                                                                 "mol", "cd", "rad", "dB"};

namespace {

constexpr std::size_t k_kelvin = 4;
constexpr std::size_t k_radian = 7;
constexpr std::size_t k_decibel = 8;
constexpr double k_exponent_rounding = 1e-9;  // of fractional exponents, which come from roots
constexpr double k_ice_point = 273.15;        // [K], exact by definition of the degree Celsius
constexpr std::size_t k_longest_unit = 256;

std::string number_text(double value) {
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return error == std::errc{} ? std::string(buffer.data(), end) : std::string();
}

bool is_whole(double value) {
    return std::abs(value - std::round(value)) < k_exponent_rounding;
}

struct UnitFree {
    void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPointer = std::unique_ptr<ut_unit, UnitFree>;

/// UDUNITS-2 with its database and the units that gumcert adds. The library keeps global state, hence the lock.
struct Database {
    std::mutex lock;
    ut_system* system = nullptr;
    std::string failure;
    std::array<UnitPointer, Dimension::k_base_units> base_units;

    Database() {
        ut_set_error_message_handler(ut_ignore);
        system = ut_read_xml(nullptr);
        if (system == nullptr) {
            failure = "status " + std::to_string(static_cast<int>(ut_get_status()));
            return;
        }
        const std::array<const char*, Dimension::k_base_units> names{"meter", "kilogram", "second", "ampere", "kelvin",
                                                                     "mole",  "candela",  "radian", nullptr};
        for (std::size_t i = 0; i < names.size(); ++i) {
            base_units[i].reset(names[i] != nullptr ? ut_get_unit_by_name(system, names[i]) : ut_new_base_unit(system));
            if (!base_units[i]) {
                failure = "base unit " + std::to_string(i + 1) + " is missing";
                return;
            }
        }
        // A level in decibels is taken as a quantity of its own kind, not as a function of a ratio.
        ut_map_name_to_unit("dB", UT_ASCII, base_units[k_decibel].get());
        ut_map_unit_to_symbol(base_units[k_decibel].get(), "dB", UT_ASCII);
        // Names that people write and the database lacks.
        add_name("deg", "arc_degree");
        add_name("Ohm", "ohm");
        add_name("gon", "0.9 arc_degree");
        add_name("ppm", "1e-6");
        add_name("ppb", "1e-9");
        add_name("turn", "360 arc_degree");
        // Differences of temperature, for those who want to say so.
        ut_map_name_to_unit("delta_degC", UT_ASCII, base_units[k_kelvin].get());
        const UnitPointer rankine(ut_scale(5.0 / 9.0, base_units[k_kelvin].get()));
        ut_map_name_to_unit("delta_degF", UT_ASCII, rankine.get());
    }

    void add_name(const char* name, const char* same_as) const {
        if (const UnitPointer unit(ut_parse(system, same_as, UT_UTF8)); unit) {
            ut_map_name_to_unit(name, UT_ASCII, unit.get());
        }
    }
};

Database& database() {
    static Database instance;
    return instance;
}

enum class Trouble { none, logarithm, timestamp, too_deep };

/// A unit taken apart: value in SI base units = scale · x + offset.
struct Parts {
    std::array<double, Dimension::k_base_units> exponents{};
    double scale = 1.0;
    double offset = 0.0;
    Trouble trouble = Trouble::none;
};

ut_status add_basic(Parts& parts, const ut_unit* unit, int power) {
    const Database& units = database();
    for (std::size_t i = 0; i < units.base_units.size(); ++i) {
        if (ut_compare(unit, units.base_units[i].get()) == 0) {
            parts.exponents[i] += power;
            return UT_SUCCESS;
        }
    }
    return UT_VISIT_ERROR;
}

ut_status visit_basic(const ut_unit* unit, void* argument) {
    return add_basic(*static_cast<Parts*>(argument), unit, 1);
}

ut_status visit_product(const ut_unit* /*unit*/, int count, const ut_unit* const* basic_units, const int* powers,
                        void* argument) {
    for (int i = 0; i < count; ++i) {
        if (const ut_status status = add_basic(*static_cast<Parts*>(argument), basic_units[i], powers[i]);
            status != UT_SUCCESS) {
            return status;
        }
    }
    return UT_SUCCESS;
}

ut_status visit_galilean(const ut_unit* unit, double scale, const ut_unit* underlying, double origin, void* argument);

ut_status visit_timestamp(const ut_unit* /*unit*/, const ut_unit* /*time*/, double /*origin*/, void* argument) {
    static_cast<Parts*>(argument)->trouble = Trouble::timestamp;
    return UT_SUCCESS;
}

ut_status visit_logarithmic(const ut_unit* /*unit*/, double /*base*/, const ut_unit* /*reference*/, void* argument) {
    static_cast<Parts*>(argument)->trouble = Trouble::logarithm;
    return UT_SUCCESS;
}

constexpr ut_visitor k_visitor{visit_basic, visit_product, visit_galilean, visit_timestamp, visit_logarithmic};

ut_status visit_galilean(const ut_unit* /*unit*/, double scale, const ut_unit* underlying, double origin,
                         void* argument) {
    Parts& parts = *static_cast<Parts*>(argument);
    Parts inner;
    const ut_status status = ut_accept_visitor(underlying, &k_visitor, &inner);
    if (status != UT_SUCCESS) {
        return status;
    }
    parts.exponents = inner.exponents;
    parts.trouble = inner.trouble;
    parts.scale = inner.scale * scale;
    parts.offset = inner.scale * scale * origin + inner.offset;
    return UT_SUCCESS;
}

InputError unit_error(const char* code, std::string_view text, const std::string& what, std::string rule,
                      std::string action) {
    return InputError(Diagnostic{.code = code,
                                 .where = "unit \"" + std::string(text) + "\"",
                                 .what = what,
                                 .rule = std::move(rule),
                                 .action = std::move(action)});
}

/// What a name of a unit stands for in print and in D-SI.
struct UnitName {
    std::string_view udunits;
    std::string_view people;
    std::string_view d_si;  ///< "" where D-SI has none
};

constexpr std::array k_unit_names{
    UnitName{"m", "m", "metre"},
    UnitName{"g", "g", "gram"},
    UnitName{"s", "s", "second"},
    UnitName{"A", "A", "ampere"},
    UnitName{"K", "K", "kelvin"},
    UnitName{"delta_degC", "K", "kelvin"},
    UnitName{"delta_degF", "Δ°F", ""},
    UnitName{"mol", "mol", "mole"},
    UnitName{"cd", "cd", "candela"},
    UnitName{"rad", "rad", "radian"},
    UnitName{"sr", "sr", "steradian"},
    UnitName{"Hz", "Hz", "hertz"},
    UnitName{"N", "N", "newton"},
    UnitName{"Pa", "Pa", "pascal"},
    UnitName{"J", "J", "joule"},
    UnitName{"W", "W", "watt"},
    UnitName{"C", "C", "coulomb"},
    UnitName{"V", "V", "volt"},
    UnitName{"F", "F", "farad"},
    UnitName{"ohm", "Ω", "ohm"},
    UnitName{"Ohm", "Ω", "ohm"},
    UnitName{"Ω", "Ω", "ohm"},
    UnitName{"S", "S", "siemens"},
    UnitName{"Wb", "Wb", "weber"},
    UnitName{"T", "T", "tesla"},
    UnitName{"H", "H", "henry"},
    UnitName{"degC", "°C", "degreecelsius"},
    UnitName{"degrees_C", "°C", "degreecelsius"},
    UnitName{"°C", "°C", "degreecelsius"},
    UnitName{"degF", "°F", ""},
    UnitName{"lm", "lm", "lumen"},
    UnitName{"lx", "lx", "lux"},
    UnitName{"Bq", "Bq", "becquerel"},
    UnitName{"Gy", "Gy", "gray"},
    UnitName{"Sv", "Sv", "sievert"},
    UnitName{"kat", "kat", "katal"},
    UnitName{"min", "min", "minute"},
    UnitName{"h", "h", "hour"},
    UnitName{"d", "d", "day"},
    UnitName{"deg", "°", "degree"},
    UnitName{"degree", "°", "degree"},
    UnitName{"degrees", "°", "degree"},
    UnitName{"°", "°", "degree"},
    UnitName{"arcmin", "′", "arcminute"},
    UnitName{"arcsec", "″", "arcsecond"},
    UnitName{"L", "L", "litre"},
    UnitName{"l", "l", "litre"},
    UnitName{"t", "t", "tonne"},
    UnitName{"eV", "eV", "electronvolt"},
    UnitName{"bar", "bar", "bar"},
    UnitName{"percent", "%", "percent"},
    UnitName{"%", "%", "percent"},
    UnitName{"ppm", "ppm", "ppm"},
    UnitName{"dB", "dB", "decibel"},
};

struct Prefix {
    std::string_view udunits;
    std::string_view people;
    std::string_view d_si;
};

constexpr std::array k_prefixes{
    Prefix{"da", "da", "deca"}, Prefix{"Y", "Y", "yotta"}, Prefix{"Z", "Z", "zetta"}, Prefix{"E", "E", "exa"},
    Prefix{"P", "P", "peta"},   Prefix{"T", "T", "tera"},  Prefix{"G", "G", "giga"},  Prefix{"M", "M", "mega"},
    Prefix{"k", "k", "kilo"},   Prefix{"h", "h", "hecto"}, Prefix{"d", "d", "deci"},  Prefix{"c", "c", "centi"},
    Prefix{"m", "m", "milli"},  Prefix{"u", "µ", "micro"}, Prefix{"µ", "µ", "micro"}, Prefix{"μ", "µ", "micro"},
    Prefix{"n", "n", "nano"},   Prefix{"p", "p", "pico"},  Prefix{"f", "f", "femto"}, Prefix{"a", "a", "atto"},
    Prefix{"z", "z", "zepto"},  Prefix{"y", "y", "yocto"},
};

/// A factor of a product of units.
struct UnitFactor {
    std::string_view prefix, prefix_d_si;  ///< as people and as D-SI write it
    const UnitName* name = nullptr;        ///< none for a name that the table lacks
    std::string raw;                       ///< the name as it was written
    int power = 1;
};

const UnitName* find_name(std::string_view text) {
    const auto found =
        std::find_if(k_unit_names.begin(), k_unit_names.end(), [&](const UnitName& n) { return n.udunits == text; });
    return found == k_unit_names.end() ? nullptr : &*found;
}

UnitFactor resolve(std::string_view text, int power) {
    UnitFactor factor;
    factor.raw = text;
    factor.power = power;
    factor.name = find_name(text);
    if (factor.name == nullptr) {
        for (const Prefix& prefix : k_prefixes) {
            if (text.starts_with(prefix.udunits) && text.size() > prefix.udunits.size()) {
                if (const UnitName* name = find_name(text.substr(prefix.udunits.size())); name != nullptr) {
                    factor.prefix = prefix.people;
                    factor.prefix_d_si = prefix.d_si;
                    factor.name = name;
                    return factor;
                }
            }
        }
    }
    return factor;
}

bool is_name_byte(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%' ||
           static_cast<unsigned char>(c) >= 0x80U;
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// The factors of a plain product such as "nm/K", "kg m-3", "J/(kg K)"; nothing where there is a number other than 1 as
/// a factor, a second pair of parentheses or anything else that is not such a product.
std::optional<std::vector<UnitFactor>> factors_of(std::string_view text) {
    std::vector<UnitFactor> factors;
    int sign = 1;
    bool inside = false;  // of the parentheses of a denominator
    std::size_t i = 0;
    while (i < text.size()) {
        const char c = text[i];
        if (c == ' ' || c == '.' || c == '*') {
            ++i;
        } else if (text.substr(i).starts_with("·")) {
            i += std::string_view("·").size();
        } else if (c == '/') {
            if (inside) {
                return std::nullopt;
            }
            sign = -1;
            ++i;
        } else if (c == '(' && !inside) {
            inside = true;
            ++i;
        } else if (c == ')' && inside) {
            inside = false;
            sign = 1;
            ++i;
        } else if (c == '1' && (i + 1 == text.size() || !is_digit(text[i + 1])) &&
                   (i + 1 == text.size() || text[i + 1] == '/' || text[i + 1] == ' ')) {
            ++i;  // the 1 of "1/K"
        } else if (is_name_byte(c)) {
            std::size_t end = i;
            while (end < text.size() && is_name_byte(text[end]) && !text.substr(end).starts_with("·")) {
                ++end;
            }
            const std::string_view name = text.substr(i, end - i);
            int power = 1;
            std::size_t digits = end;
            if (digits < text.size() && text[digits] == '^') {
                ++digits;
            } else if (text.substr(digits).starts_with("**")) {
                digits += 2;
            }
            int direction = 1;
            if (digits < text.size() && (text[digits] == '-' || text[digits] == '+')) {
                direction = text[digits] == '-' ? -1 : 1;
                ++digits;
            }
            if (digits < text.size() && is_digit(text[digits])) {
                int exponent = 0;
                const auto [stop, error] = std::from_chars(text.data() + digits, text.data() + text.size(), exponent);
                if (error != std::errc{}) {
                    return std::nullopt;
                }
                power = direction * exponent;
                end = static_cast<std::size_t>(stop - text.data());
            } else if (digits != end) {
                return std::nullopt;
            }
            factors.push_back(resolve(name, sign * power));
            if (!inside) {
                sign = 1;  // UDUNITS-2 reads a/b c as (a/b) c
            }
            i = end;
        } else {
            return std::nullopt;
        }
    }
    if (inside) {
        return std::nullopt;
    }
    return factors;
}

std::string superscript(int power) {
    constexpr std::array<std::string_view, 10> k_digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = power < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(power))) {
        text += k_digits[static_cast<std::size_t>(c - '0')];
    }
    return text;
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
        if (is_whole(exponent)) {
            if (const int whole = static_cast<int>(std::lround(exponent)); whole != 1) {
                text += std::to_string(whole);
            }
        } else {
            text += "^" + number_text(exponent);
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
    const std::string rule = "units are written as UDUNITS-2 reads them";
    const std::string action = "Write for example um, nm/K, arcsec, degC, uohm, 1/K, percent, or 1 for a bare number.";
    Unit unit;
    unit.text_ = text.empty() ? "1" : std::string(text);
    if (unit.text_ == "1") {
        return unit;
    }
    if (text.size() > k_longest_unit) {
        throw unit_error("GC-UNIT-0001", text.substr(0, 40), "a text of " + std::to_string(text.size()) + " bytes",
                         "a unit has at most 256 bytes", action);
    }
    if (text.find('\0') != std::string_view::npos || text.front() == ' ' || text.back() == ' ') {
        throw unit_error("GC-UNIT-0001", text, "spaces around it, or a NUL character", rule, action);
    }
    Database& units = database();
    const std::lock_guard guard(units.lock);
    if (!units.failure.empty()) {
        throw StorageError(Diagnostic{.code = "GC-UNIT-0010",
                                      .where = "unit database of UDUNITS-2",
                                      .what = "cannot be read: " + units.failure,
                                      .rule = "units are read with it",
                                      .action = "Install libudunits2-0 with its data, or run scripts/setup."});
    }
    const UnitPointer parsed(ut_parse(units.system, unit.text_.c_str(), UT_UTF8));
    if (!parsed) {
        throw unit_error("GC-UNIT-0001", text, "not a unit that is known", rule, action);
    }
    Parts parts;
    const ut_status status = ut_accept_visitor(parsed.get(), &k_visitor, &parts);
    if (parts.trouble == Trouble::logarithm) {
        throw unit_error("GC-UNIT-0002", text, "a logarithmic unit",
                         "levels are stated in dB, which is a unit of its own",
                         "Write dB, or state the quantity itself and use log10 in the model.");
    }
    if (parts.trouble == Trouble::timestamp) {
        throw unit_error("GC-UNIT-0003", text, "a point in time", "quantities are durations, not dates",
                         "Write s, min, h or d.");
    }
    if (status != UT_SUCCESS || !std::isfinite(parts.scale) || !(parts.scale > 0.0)) {
        throw unit_error("GC-UNIT-0001", text, "not a unit that can be expressed in SI base units", rule, action);
    }
    unit.dimension_ = Dimension(parts.exponents);
    unit.factor_ = parts.scale;
    if (parts.offset != 0.0) {
        if (!(unit.dimension_ == Dimension::temperature())) {
            throw unit_error("GC-UNIT-0004", text, "a scale with an origin of its own",
                             "only temperatures have such scales: degC, degF", "State the quantity from zero.");
        }
        unit.celsius_ = true;
        unit.offset_ = parts.offset - k_ice_point;
        if (std::abs(unit.offset_) < 1e-12) {
            unit.offset_ = 0.0;
        }
    }
    const double inverse = std::round(1.0 / unit.factor_);
    if (unit.factor_ < 1.0 && inverse < 9e15 && std::abs(inverse * unit.factor_ - 1.0) < 4e-16) {
        unit.divisor_ = inverse;
    }
    return unit;
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
    const std::optional<std::vector<UnitFactor>> factors = factors_of(text);
    if (!factors || factors->empty()) {
        return std::string(text);
    }
    std::vector<std::string> above;
    std::vector<std::string> below;
    const bool slash = text.find('/') != std::string_view::npos;
    for (const UnitFactor& factor : *factors) {
        const std::string name =
            factor.name != nullptr ? std::string(factor.prefix) + std::string(factor.name->people) : factor.raw;
        const bool under = slash && factor.power < 0;
        const int power = under ? -factor.power : factor.power;
        (under ? below : above).push_back(power == 1 ? name : name + superscript(power));
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
    const Unit unit = Unit::parse(text);
    if (!unit.is_celsius_temperature()) {
        return std::string(text);
    }
    return unit.difference_to_si(1.0) == 1.0 ? "K" : "delta_degF";
}

std::optional<std::string> unit_in_d_si(std::string_view text) {
    if (text == "1" || text.empty()) {
        return "\\one";
    }
    const std::optional<std::vector<UnitFactor>> factors = factors_of(text);
    if (!factors || factors->empty()) {
        return std::nullopt;
    }
    std::string result;
    for (const UnitFactor& factor : *factors) {
        if (factor.name == nullptr || factor.name->d_si.empty()) {
            return std::nullopt;
        }
        if (!factor.prefix_d_si.empty()) {
            result += "\\" + std::string(factor.prefix_d_si);
        }
        result += "\\" + std::string(factor.name->d_si);
        if (factor.power != 1) {
            result += "\\tothe{" + std::to_string(factor.power) + "}";
        }
    }
    return result;
}

}  // namespace gumcert::gum
