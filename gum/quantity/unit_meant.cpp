#include "gum/quantity/unit_meant.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

#include "gum/quantity/unit_table.h"

namespace gumcert::gum {

namespace {

struct WordForUnit {
    std::string_view words;  ///< separated by spaces
    std::string_view write;
};

constexpr std::string_view k_scale = "1, and name the scale in the description";
constexpr std::string_view k_kind_of_value = "the unit alone, such as V, and say in the description which value it is";
constexpr std::string_view k_kind_of_pressure =
    "the unit alone, such as bar or psi, and say in the description whether the pressure is absolute or gauge";

/// What stands on displays, in data sheets and in spreadsheets.
constexpr std::array k_words{
    WordForUnit{"Nm", "N m"},
    WordForUnit{"kNm", "kN m"},
    WordForUnit{"mNm", "mN m"},
    WordForUnit{"cNm", "cN m"},
    WordForUnit{"dNm", "dN m"},
    WordForUnit{"MNm", "MN m"},
    WordForUnit{"Ncm", "N cm"},
    WordForUnit{"Nmm", "N mm"},
    WordForUnit{"mPas", "mPa s"},
    WordForUnit{"Pas", "Pa s"},
    WordForUnit{"Vs", "V s"},
    WordForUnit{"As", "A s"},
    WordForUnit{"mAs", "mA s"},
    WordForUnit{"Ws", "W s"},
    WordForUnit{"ccm", "cm3"},
    WordForUnit{"cbm", "m3"},
    WordForUnit{"NM", "N m, or nm"},
    WordForUnit{"CC Cc", "cm3"},
    WordForUnit{"kp", "kgf"},
    WordForUnit{"KP Kp", "kPa or kgf"},
    WordForUnit{"kn", "knot"},
    WordForUnit{"pct %rh %RH %rF %r.F. rh RH %FS %IACS", "percent, and say in the description of what"},
    WordForUnit{"FS FSO rdg RDG", "percent, and state the limit of the range or the reading in a specification"},
    WordForUnit{"digit digits dgt cnt", "the unit of the display, with its step as the resolution"},
    WordForUnit{"dBA dBC dBZ dBFS dBi", "dB, and name the weighting or the reference in the description"},
    WordForUnit{"HRA HRB HRC HRD HRE HRF HRG HRH HRK HRN HRT HRW HV HB HBW HBS HK HL HLD IRHD Shore", k_scale},
    WordForUnit{"NTU FNU FTU Brix PSU SG", k_scale},
    WordForUnit{
        "Vrms mVrms uVrms kVrms Arms mArms uArms Vpp mVpp uVpp Vp mVp VAC VDC mVAC mVDC kVAC kVDC AAC ADC mAAC mADC "
        "AC DC ac dc pp rms RMS",
        k_kind_of_value},
    WordForUnit{"barg bara mbarg mbara kPag kPaa kPa_a kPa_g MPag MPaa psig psia psid", k_kind_of_pressure},
    WordForUnit{"mmH2O cmH2O inH2O mmWS mmWC mmWG inWC inWG mH2O mWS",
                "Pa: its size is that of the density of water which was agreed on, such as 9.80665 Pa for 1 mm"},
    WordForUnit{"cps", "1/s"},
    WordForUnit{"cpm", "1/min"},
    WordForUnit{"mho", "S"},
    WordForUnit{"r U upm Upm", "rpm for turns a minute (r/min, U/min), or 1/min for a number of them"},
    WordForUnit{"Celsius ºC", "degC"},
    WordForUnit{"Fahrenheit ºF", "degF"},
    WordForUnit{"º", "deg"},
};

std::string small(std::string_view text) {
    std::string letters(text);
    std::transform(letters.begin(), letters.end(), letters.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return letters;
}

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        if (end > 0) {
            words.push_back(text.substr(0, end));
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

/// "(N m)" of "N m", and "(N m), or nm" of "N m, or nm": below a line a product stands in brackets.
std::string with_brackets(std::string_view write) {
    const std::string_view first = write.substr(0, write.find(','));
    const bool is_product = words_of(first).size() == 2;
    return is_product ? "(" + std::string(first) + ")" + std::string(write.substr(first.size())) : std::string(write);
}

/// Whether people write a prefix in front of a unit: "aT" and "cC" are in no data sheet.
bool is_in_use(const PrefixDefinition& prefix, std::string_view unit) {
    const int power = std::abs(prefix.exp10);
    return power < 3 ? unit == "m" || unit == "L" || unit == "l" || unit == "Pa" : power < 18;
}

/// Units that differ from a name by capital letters only, in the order of the table.
std::vector<std::string> with_other_capitals(std::string_view name) {
    const std::string wanted = small(name);
    std::vector<std::string> found;
    std::vector<std::pair<const UnitDefinition*, const PrefixDefinition*>> seen;  // "Mohm" and "MOhm" are one
    const auto see = [&](const std::string& spelling) {
        const NamedUnit named = small(spelling) == wanted ? find_unit(spelling) : NamedUnit{};
        const std::pair one(named.unit, named.prefix);
        if (named.unit != nullptr && std::find(seen.begin(), seen.end(), one) == seen.end()) {
            seen.push_back(one);
            found.push_back(spelling);
        }
    };
    for (const UnitDefinition& unit : unit_definitions()) {
        for (const std::string_view list : {unit.symbols, unit.names}) {
            for (const std::string_view word : words_of(list)) {
                if (!wanted.ends_with(small(word))) {
                    continue;
                }
                see(std::string(word));
                for (const PrefixDefinition& prefix : prefix_definitions()) {
                    if (!is_in_use(prefix, word)) {
                        continue;
                    }
                    for (const std::string_view spelling : words_of(prefix.symbols)) {
                        see(std::string(spelling) + std::string(word));
                    }
                    see(std::string(prefix.name) + std::string(word));
                }
            }
        }
    }
    return found;
}

}  // namespace

std::string unit_meant(std::string_view name, bool below_a_line) {
    for (const WordForUnit& known : k_words) {
        const std::vector<std::string_view> words = words_of(known.words);
        if (std::find(words.begin(), words.end(), name) != words.end()) {
            return "Write " + (below_a_line ? with_brackets(known.write) : std::string(known.write)) + ".";
        }
    }
    constexpr std::size_t k_most_offered = 3;  // of "MHZ" two; more are no advice
    const std::vector<std::string> found = with_other_capitals(name);
    if (found.empty() || found.size() > k_most_offered) {
        return "";
    }
    std::string list;
    for (std::size_t i = 0; i < found.size(); ++i) {
        list += (i == 0 ? "" : i + 1 == found.size() ? " or " : ", ") + found[i];
    }
    return "Write " + list + ": capital letters tell units apart.";
}

}  // namespace gumcert::gum
