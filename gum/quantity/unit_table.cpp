#include "gum/quantity/unit_table.h"

#include <unordered_map>
#include <vector>

namespace gumcert::gum {

namespace {

using Scale = UnitDefinition::Scale;

// Columns: symbols, names, print, D-SI, multiples, {m, kg, s, A, K, mol, cd, rad, dB}, mantissa, exp10, divisor, pi.
constexpr std::array k_units{
    // SI base units, and two that count as base units here (ADR 0012).
    UnitDefinition{"m", "metre metres meter meters", "m", "metre", true, {1}},
    UnitDefinition{"g", "gram grams", "g", "gram", true, {0, 1}, 1, -3},
    UnitDefinition{"s sec", "second seconds", "s", "second", true, {0, 0, 1}},
    UnitDefinition{"A", "ampere amperes", "A", "ampere", true, {0, 0, 0, 1}},
    UnitDefinition{"K", "kelvin kelvins", "K", "kelvin", true, {0, 0, 0, 0, 1}},
    UnitDefinition{"mol", "mole moles", "mol", "mole", true, {0, 0, 0, 0, 0, 1}},
    UnitDefinition{"cd", "candela candelas", "cd", "candela", true, {0, 0, 0, 0, 0, 0, 1}},
    UnitDefinition{"rad", "radian radians", "rad", "radian", true, {0, 0, 0, 0, 0, 0, 0, 1}},
    UnitDefinition{"dB", "decibel decibels", "dB", "decibel", true, {0, 0, 0, 0, 0, 0, 0, 0, 1}},
    // SI derived units with names of their own.
    UnitDefinition{"sr", "steradian steradians", "sr", "steradian", true, {0, 0, 0, 0, 0, 0, 0, 2}},
    UnitDefinition{"Hz", "hertz", "Hz", "hertz", true, {0, 0, -1}},
    UnitDefinition{"N", "newton newtons", "N", "newton", true, {1, 1, -2}},
    UnitDefinition{"Pa", "pascal pascals", "Pa", "pascal", true, {-1, 1, -2}},
    UnitDefinition{"J", "joule joules", "J", "joule", true, {2, 1, -2}},
    UnitDefinition{"W", "watt watts", "W", "watt", true, {2, 1, -3}},
    UnitDefinition{"C", "coulomb coulombs", "C", "coulomb", true, {0, 0, 1, 1}},
    UnitDefinition{"V", "volt volts", "V", "volt", true, {2, 1, -3, -1}},
    UnitDefinition{"F", "farad farads", "F", "farad", true, {-2, -1, 4, 2}},
    UnitDefinition{"ohm Ohm Ω \u2126", "ohms", "Ω", "ohm", true, {2, 1, -3, -2}},
    UnitDefinition{"S", "siemens", "S", "siemens", true, {-2, -1, 3, 2}},
    UnitDefinition{"Wb", "weber webers", "Wb", "weber", true, {2, 1, -2, -1}},
    UnitDefinition{"T", "tesla teslas", "T", "tesla", true, {0, 1, -2, -1}},
    UnitDefinition{"H", "henry henries henrys", "H", "henry", true, {2, 1, -2, -2}},
    UnitDefinition{"lm", "lumen lumens", "lm", "lumen", true, {0, 0, 0, 0, 0, 0, 1, 2}},
    UnitDefinition{"lx", "lux", "lx", "lux", true, {-2, 0, 0, 0, 0, 0, 1, 2}},
    UnitDefinition{"Bq", "becquerel becquerels", "Bq", "becquerel", true, {0, 0, -1}},
    UnitDefinition{"Gy", "gray grays", "Gy", "gray", true, {2, 0, -2}},
    UnitDefinition{"Sv", "sievert sieverts", "Sv", "sievert", true, {2, 0, -2}},
    UnitDefinition{"kat", "katal katals", "kat", "katal", true, {0, 0, -1, 0, 0, 1}},
    // Temperatures: the scales with their origins, and differences for those who want to say so.
    UnitDefinition{"degC °C ℃ degrees_C",
                   "degree_Celsius celsius",
                   "°C",
                   "degreecelsius",
                   true,
                   {0, 0, 0, 0, 1},
                   1,
                   0,
                   1,
                   0,
                   Scale::celsius},
    UnitDefinition{
        "degF °F ℉", "degree_Fahrenheit fahrenheit", "°F", "", false, {0, 0, 0, 0, 1}, 5, 0, 9, 0, Scale::fahrenheit},
    UnitDefinition{"delta_degC", "", "K", "kelvin", false, {0, 0, 0, 0, 1}},
    UnitDefinition{"delta_degF", "", "Δ°F", "", false, {0, 0, 0, 0, 1}, 5, 0, 9},
    UnitDefinition{"degR °R", "degree_Rankine rankine", "°R", "", false, {0, 0, 0, 0, 1}, 5, 0, 9},
    // Units accepted for use with the SI.
    UnitDefinition{"min", "minute minutes", "min", "minute", false, {0, 0, 1}, 60},
    UnitDefinition{"h hr", "hour hours", "h", "hour", false, {0, 0, 1}, 3600},
    UnitDefinition{"d", "day days", "d", "day", false, {0, 0, 1}, 86400},
    UnitDefinition{"au", "astronomical_unit astronomical_units", "au", "", false, {1}, 149597870700},
    UnitDefinition{
        "deg °", "degree degrees arc_degree arcdeg", "°", "degree", true, {0, 0, 0, 0, 0, 0, 0, 1}, 1, 0, 180, 1},
    UnitDefinition{"arcmin ′",
                   "arcminute arcminutes arc_minute arc_minutes",
                   "′",
                   "arcminute",
                   false,
                   {0, 0, 0, 0, 0, 0, 0, 1},
                   1,
                   0,
                   10800,
                   1},
    UnitDefinition{"arcsec ″",
                   "arcsecond arcseconds arc_second arc_seconds",
                   "″",
                   "arcsecond",
                   true,
                   {0, 0, 0, 0, 0, 0, 0, 1},
                   1,
                   0,
                   648000,
                   1},
    UnitDefinition{"ha", "hectare hectares", "ha", "hectare", false, {2}, 1, 4},
    UnitDefinition{"L", "litre litres liter liters", "L", "litre", true, {3}, 1, -3},
    UnitDefinition{"l", "", "l", "litre", true, {3}, 1, -3},
    UnitDefinition{"t", "tonne tonnes metric_ton metric_tons", "t", "tonne", true, {0, 1}, 1000},
    UnitDefinition{"eV", "electronvolt electronvolts", "eV", "electronvolt", true, {2, 1, -2}, 1602176634, -28},
    UnitDefinition{"bar", "bars", "bar", "bar", true, {-1, 1, -2}, 1, 5},
    // Ratios and counts.
    UnitDefinition{"percent %", "", "%", "percent", false, {}, 1, -2},
    UnitDefinition{"permille ‰", "", "‰", "", false, {}, 1, -3},
    UnitDefinition{"ppm", "", "ppm", "ppm", false, {}, 1, -6},
    UnitDefinition{"ppb", "", "ppb", "", false, {}, 1, -9},
    UnitDefinition{"count counts", "", "", "", false, {}},
    // Angles and turns.
    UnitDefinition{"gon", "gons grade grades", "gon", "", true, {0, 0, 0, 0, 0, 0, 0, 1}, 1, 0, 200, 1},
    UnitDefinition{
        "turn rev cycle", "turns revolution revolutions cycles", "", "", false, {0, 0, 0, 0, 0, 0, 0, 1}, 2, 0, 1, 1},
    UnitDefinition{"rpm", "", "rpm", "", false, {0, 0, -1, 0, 0, 0, 0, 1}, 1, 0, 30, 1},
    UnitDefinition{"rps", "", "rps", "", false, {0, 0, -1, 0, 0, 0, 0, 1}, 2, 0, 1, 1},
    // Multiples of the SI with names of their own.
    UnitDefinition{"Wh", "", "Wh", "", true, {2, 1, -2}, 3600},
    UnitDefinition{"Ah", "", "Ah", "", true, {0, 0, 1, 1}, 3600},
    UnitDefinition{"VA", "voltampere voltamperes", "VA", "", true, {2, 1, -3}},
    UnitDefinition{"var", "", "var", "", true, {2, 1, -3}},
    UnitDefinition{"week weeks", "", "", "", false, {0, 0, 1}, 604800},
    UnitDefinition{"Julian_year Julian_years", "", "", "", false, {0, 0, 1}, 31557600},
    UnitDefinition{"angstrom angstroms Å \u212B", "", "Å", "", false, {1}, 1, -10},
    UnitDefinition{"micron microns", "", "", "", false, {1}, 1, -6},
    UnitDefinition{"barn", "barns", "", "", true, {2}, 1, -28},
    UnitDefinition{"cc", "", "", "", false, {3}, 1, -6},
    UnitDefinition{"dpt", "dioptre dioptres diopter diopters", "dpt", "", false, {-1}},
    UnitDefinition{"Gal", "galileo", "Gal", "", true, {1, 0, -2}, 1, -2},
    UnitDefinition{"g_n", "standard_free_fall", "g_n", "", false, {1, 0, -2}, 980665, -5},
    UnitDefinition{"dyn", "dyne dynes", "dyn", "", true, {1, 1, -2}, 1, -5},
    UnitDefinition{"erg ergs", "", "", "", false, {2, 1, -2}, 1, -7},
    UnitDefinition{"P", "poise", "P", "", true, {-1, 1, -1}, 1, -1},
    UnitDefinition{"St", "stokes", "St", "", true, {2, 0, -1}, 1, -4},
    UnitDefinition{"gauss", "", "", "", true, {0, 1, -2, -1}, 1, -4},
    UnitDefinition{"Oe", "oersted oersteds", "Oe", "", true, {-1, 0, 0, 1}, 250, 0, 1, -1},
    UnitDefinition{"Mx", "maxwell maxwells", "Mx", "", true, {2, 1, -2, -1}, 1, -8},
    UnitDefinition{"Ci", "curie curies", "Ci", "", true, {0, 0, -1}, 37, 9},
    UnitDefinition{"roentgen", "roentgens", "", "", true, {0, -1, 1, 1}, 258, -6},
    UnitDefinition{"nit", "nits", "", "", false, {-2, 0, 0, 0, 0, 0, 1}},
    UnitDefinition{"footcandle footcandles", "", "", "", false, {-2, 0, 0, 0, 0, 0, 1, 2}, 1, 8, 9290304},
    UnitDefinition{"tex", "", "", "", true, {-1, 1}, 1, -6},
    UnitDefinition{"denier", "", "", "", false, {-1, 1}, 1, -6, 9},
    // Length: the international inch, the nautical mile.
    UnitDefinition{"in", "inch inches international_inch", "", "", false, {1}, 254, -4},
    UnitDefinition{"uin µin μin", "microinch microinches", "µin", "", false, {1}, 254, -10},
    UnitDefinition{"mil mils thou", "", "", "", false, {1}, 254, -7},
    UnitDefinition{"ft", "foot feet international_foot", "", "", false, {1}, 3048, -4},
    UnitDefinition{"yd", "yard yards", "", "", false, {1}, 9144, -4},
    UnitDefinition{"mi", "mile miles", "", "", false, {1}, 1609344, -3},
    UnitDefinition{"nmi", "nautical_mile nautical_miles", "", "", false, {1}, 1852},
    UnitDefinition{"knot knots", "", "", "", false, {1, 0, -1}, 463, 0, 900},
    UnitDefinition{"mph", "", "", "", false, {1, 0, -1}, 44704, -5},
    // Mass: the international pound, the troy ounce of 480 grains.
    UnitDefinition{"lb lbs", "pound pounds", "", "", false, {0, 1}, 45359237, -8},
    UnitDefinition{"ounce ounces", "avoirdupois_ounce", "", "", false, {0, 1}, 28349523125, -12},
    UnitDefinition{"troy_ounce troy_ounces", "", "", "", false, {0, 1}, 311034768, -10},
    UnitDefinition{"gr", "grain grains", "", "", false, {0, 1}, 6479891, -11},
    UnitDefinition{"carat carats", "", "", "", false, {0, 1}, 2, -4},
    UnitDefinition{"slug slugs", "", "", "", false, {0, 1}, 44482216152605, -9, 3048},
    UnitDefinition{"short_ton short_tons", "", "", "", false, {0, 1}, 90718474, -5},
    UnitDefinition{"long_ton long_tons", "", "", "", false, {0, 1}, 10160469088, -7},
    // Volume.
    UnitDefinition{"US_liquid_gallon US_liquid_gallons", "", "", "", false, {3}, 3785411784, -12},
    UnitDefinition{"UK_liquid_gallon UK_liquid_gallons", "", "", "", false, {3}, 454609, -8},
    // Force and pressure.
    UnitDefinition{"kgf", "kilogram_force", "", "", false, {1, 1, -2}, 980665, -5},
    UnitDefinition{"gf", "gram_force", "", "", false, {1, 1, -2}, 980665, -8},
    UnitDefinition{"lbf", "pound_force", "", "", false, {1, 1, -2}, 44482216152605, -13},
    UnitDefinition{"ozf", "ounce_force", "", "", false, {1, 1, -2}, 27801385095378125, -17},
    UnitDefinition{"psi", "", "psi", "", false, {-1, 1, -2}, 44482216152605, -5, 64516},
    UnitDefinition{"ksi", "", "ksi", "", false, {-1, 1, -2}, 44482216152605, -2, 64516},
    UnitDefinition{"atm", "atmosphere atmospheres standard_atmosphere", "atm", "", false, {-1, 1, -2}, 101325},
    UnitDefinition{"technical_atmosphere", "", "", "", false, {-1, 1, -2}, 980665, -1},
    UnitDefinition{"Torr torr", "", "Torr", "", true, {-1, 1, -2}, 101325, 0, 760},
    UnitDefinition{"mmHg", "", "mmHg", "", false, {-1, 1, -2}, 133322387415, -9},
    UnitDefinition{"cmHg", "", "cmHg", "", false, {-1, 1, -2}, 133322387415, -8},
    UnitDefinition{"inHg", "", "inHg", "", false, {-1, 1, -2}, 3386388640341, -9},
    // Energy and power.
    UnitDefinition{"cal_th", "thermochemical_calorie thermochemical_calories", "", "", true, {2, 1, -2}, 4184, -3},
    UnitDefinition{"cal_IT", "IT_calorie IT_calories", "", "", true, {2, 1, -2}, 41868, -4},
    UnitDefinition{"Btu_IT", "IT_Btu", "", "", false, {2, 1, -2}, 105505585262, -8},
    UnitDefinition{"metric_horsepower", "", "", "", false, {2, 1, -3}, 73549875, -5},
    UnitDefinition{"mechanical_horsepower", "", "", "", false, {2, 1, -3}, 745699871582270220, -15},
};

constexpr std::array k_prefixes{
    PrefixDefinition{"da", "deca", "da", 1},  PrefixDefinition{"h", "hecto", "h", 2},
    PrefixDefinition{"k", "kilo", "k", 3},    PrefixDefinition{"M", "mega", "M", 6},
    PrefixDefinition{"G", "giga", "G", 9},    PrefixDefinition{"T", "tera", "T", 12},
    PrefixDefinition{"P", "peta", "P", 15},   PrefixDefinition{"E", "exa", "E", 18},
    PrefixDefinition{"Z", "zetta", "Z", 21},  PrefixDefinition{"Y", "yotta", "Y", 24},
    PrefixDefinition{"d", "deci", "d", -1},   PrefixDefinition{"c", "centi", "c", -2},
    PrefixDefinition{"m", "milli", "m", -3},  PrefixDefinition{"u µ μ", "micro", "µ", -6},
    PrefixDefinition{"n", "nano", "n", -9},   PrefixDefinition{"p", "pico", "p", -12},
    PrefixDefinition{"f", "femto", "f", -15}, PrefixDefinition{"a", "atto", "a", -18},
    PrefixDefinition{"z", "zepto", "z", -21}, PrefixDefinition{"y", "yocto", "y", -24},
};

constexpr std::array k_ambiguous{
    AmbiguousUnit{"kt", "the knot or the kilotonne: write knot, or Gg"},
    AmbiguousUnit{"kts", "the knot: write knot"},
    AmbiguousUnit{"at", "the technical atmosphere or the attotonne: write technical_atmosphere, or pg"},
    AmbiguousUnit{"pt", "the pint or the picotonne: write mL, or ug"},
    AmbiguousUnit{"a", "the are or the year: write m2, or d"},
    AmbiguousUnit{"year", "365 d, the Julian or the tropical year: write d, or Julian_year (365.25 d)"},
    AmbiguousUnit{"years", "365 d, the Julian or the tropical year: write d, or Julian_year (365.25 d)"},
    AmbiguousUnit{"yr", "365 d, the Julian or the tropical year: write d, or Julian_year (365.25 d)"},
    AmbiguousUnit{"month", "28 to 31 days: write d"},
    AmbiguousUnit{"gal", "the gallon or the galileo: write Gal, US_liquid_gallon or UK_liquid_gallon"},
    AmbiguousUnit{"gallon", "that of the US or of the UK: write US_liquid_gallon or UK_liquid_gallon"},
    AmbiguousUnit{"ton", "three different masses: write t, short_ton or long_ton"},
    AmbiguousUnit{"tons", "three different masses: write t, short_ton or long_ton"},
    AmbiguousUnit{"oz", "a mass or a volume: write ounce, troy_ounce, ozf or mL"},
    AmbiguousUnit{"cal", "the thermochemical or the international calorie: write J, cal_th or cal_IT"},
    AmbiguousUnit{"kcal", "the thermochemical or the international calorie: write kJ, kcal_th or kcal_IT"},
    AmbiguousUnit{"calorie", "the thermochemical or the international calorie: write J, cal_th or cal_IT"},
    AmbiguousUnit{"Btu", "several units of energy: write J, or Btu_IT"},
    AmbiguousUnit{"BTU", "several units of energy: write J, or Btu_IT"},
    AmbiguousUnit{"hp", "several units of power: write W, metric_horsepower or mechanical_horsepower"},
    AmbiguousUnit{"horsepower", "several units of power: write W, metric_horsepower or mechanical_horsepower"},
    AmbiguousUnit{"ppt", "parts per thousand or per trillion: write permille, or 1e-12"},
    AmbiguousUnit{"mb", "the millibar or the millibarn: write mbar, or mbarn"},
    AmbiguousUnit{"ct", "the carat or the centitonne: write carat, or kg"},
    AmbiguousUnit{"PS", "the metric horsepower or the petasiemens: write metric_horsepower"},
    AmbiguousUnit{"Gs", "the gauss or the gigasecond: write gauss, or 1e9 s"},
    AmbiguousUnit{"mGs", "the milligauss, or wrong: write mgauss"},
    AmbiguousUnit{"kGs", "the kilogauss, or wrong: write kgauss"},
    AmbiguousUnit{"G", "the gauss or the constant of gravitation: write gauss"},
    // A prefix and a symbol that laboratories write for something else.
    AmbiguousUnit{"pH", "the pH value or the picohenry: write 1, or 1e-12 H"},
    AmbiguousUnit{"PH", "the pH value or the petahenry: write 1, or 1e15 H"},
    AmbiguousUnit{"pK", "the pK value or the picokelvin: write 1, or 1e-12 K"},
    AmbiguousUnit{"dH", "the German degree of hardness or the decihenry: write mmol/L, or 0.1 H"},
    AmbiguousUnit{"fH", "the French degree of hardness or the femtohenry: write mmol/L, or 1e-15 H"},
    AmbiguousUnit{"TH", "the French degree of hardness or the terahenry: write mmol/L, or 1e12 H"},
    AmbiguousUnit{"EV", "the exposure value or the exavolt: write 1, eV or 1e18 V"},
    AmbiguousUnit{"as", "the arcsecond or the attosecond: write arcsec, or 1e-18 s"},
    AmbiguousUnit{"nt", "the nit or the nanotonne: write cd/m2, or mg"},
    AmbiguousUnit{"mt", "the metric ton or the millitonne: write t, or kg"},
    AmbiguousUnit{"MT", "the metric ton or the megatesla: write t, or 1e6 T"},
    AmbiguousUnit{"Pt", "the pint or the petatonne: write mL, or 1e15 t"},
    AmbiguousUnit{"PA", "the pascal or the petaampere: write Pa, or 1e15 A"},
};

template <class Visit>
void for_each_word(std::string_view words, const Visit& visit) {
    while (!words.empty()) {
        const std::size_t end = words.find(' ');
        if (const std::string_view word = words.substr(0, end); !word.empty()) {
            visit(word);
        }
        words = end == std::string_view::npos ? std::string_view{} : words.substr(end + 1);
    }
}

struct Entry {
    const UnitDefinition* unit = nullptr;  ///< none for a name that is refused
    bool symbol = false;
};

const std::unordered_map<std::string_view, Entry>& entries() {
    static const std::unordered_map<std::string_view, Entry> instance = [] {
        std::unordered_map<std::string_view, Entry> map;
        for (const UnitDefinition& unit : k_units) {
            for_each_word(unit.symbols, [&](std::string_view word) { map.emplace(word, Entry{&unit, true}); });
            for_each_word(unit.names, [&](std::string_view word) { map.emplace(word, Entry{&unit, false}); });
        }
        for (const AmbiguousUnit& unit : k_ambiguous) {
            map.emplace(unit.name, Entry{});
        }
        return map;
    }();
    return instance;
}

/// The unit behind a prefix, where the text is such a multiple.
NamedUnit multiple(std::string_view name, std::string_view spelling, const PrefixDefinition& prefix, bool symbol) {
    if (name.size() > spelling.size() && name.starts_with(spelling)) {
        const auto found = entries().find(name.substr(spelling.size()));
        if (found != entries().end() && found->second.unit != nullptr && found->second.unit->multiples &&
            found->second.symbol == symbol) {
            return {found->second.unit, &prefix};
        }
    }
    return {};
}

}  // namespace

std::span<const UnitDefinition> unit_definitions() {
    return k_units;
}

std::span<const PrefixDefinition> prefix_definitions() {
    return k_prefixes;
}

std::span<const AmbiguousUnit> ambiguous_units() {
    return k_ambiguous;
}

NamedUnit find_unit(std::string_view name) {
    if (const auto found = entries().find(name); found != entries().end()) {
        return {found->second.unit, nullptr};
    }
    NamedUnit result;
    for (const PrefixDefinition& prefix : k_prefixes) {
        for_each_word(prefix.symbols, [&](std::string_view spelling) {
            if (result.unit == nullptr) {
                result = multiple(name, spelling, prefix, true);
            }
        });
        if (result.unit == nullptr) {
            result = multiple(name, prefix.name, prefix, false);
        }
        if (result.unit != nullptr) {
            break;
        }
    }
    return result;
}

std::string unit_table_text() {
    std::string text;
    for (const UnitDefinition& unit : k_units) {
        text += std::string(unit.symbols) + "|" + std::string(unit.names) + "|" + (unit.multiples ? "multiples|" : "|");
        for (const std::int8_t exponent : unit.exponents) {
            text += std::to_string(exponent) + " ";
        }
        text += "|" + std::to_string(unit.mantissa) + "e" + std::to_string(unit.exp10) + "/" +
                std::to_string(unit.divisor) + " pi^" + std::to_string(unit.pi) + "|" +
                std::to_string(static_cast<int>(unit.scale)) + "\n";
    }
    for (const PrefixDefinition& prefix : k_prefixes) {
        text +=
            std::string(prefix.symbols) + "|" + std::string(prefix.name) + "|" + std::to_string(prefix.exp10) + "\n";
    }
    return text;
}

}  // namespace gumcert::gum
