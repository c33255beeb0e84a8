#include "audit/words/unit_words.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>
#include <unordered_map>

#include "gum/quantity/diagnostic.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

/// Without blanks at its ends, and without brackets around all of it.
std::string_view bare_unit(std::string_view text) {
    const auto trim = [&text] {
        while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
            text.remove_prefix(1);
        }
        while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) {
            text.remove_suffix(1);
        }
    };
    trim();
    const bool square = text.starts_with('[') && text.ends_with(']');
    const bool round = text.starts_with('(') && text.find(')') == text.size() - 1;
    if (text.size() > 2 && (square || round)) {
        text.remove_prefix(1);
        text.remove_suffix(1);
        trim();
    }
    return text;
}

/// Whether a text is a number with its unit: "10 V" in a head is a point, and no unit.
bool is_value(std::string_view text) {
    const std::size_t end = text.find_first_not_of("0123456789.,");
    return end != 0 && end != std::string_view::npos && text[end] != '/' && known_unit(std::string(text.substr(end)));
}

}  // namespace

std::optional<gum::Unit> known_unit(const std::string& text) {
    const std::string_view bare = bare_unit(text);
    if (bare.empty()) {
        return std::nullopt;
    }
    // Tables have few different words, each of them many times, and a word that is no unit costs most.
    constexpr std::size_t k_most_kept = 1'000, k_longest_kept = 40;
    thread_local std::unordered_map<std::string, std::optional<gum::Unit>> known;
    const auto parsed = [](std::string_view unit) -> std::optional<gum::Unit> {
        try {
            return gum::Unit::parse(unit == "-" || unit == "–" ? "1" : unit);
        } catch (const gum::DiagnosedError&) {
            return std::nullopt;
        }
    };
    if (bare.size() > k_longest_kept) {
        return parsed(bare);
    }
    std::string key(bare);
    if (const auto found = known.find(key); found != known.end()) {
        return found->second;
    }
    if (known.size() == k_most_kept) {
        known.clear();
    }
    return known.emplace(std::move(key), parsed(bare)).first->second;
}

namespace {

/// Units that this program does not know and that stand in brackets, as scales of hardness and turbidity: "HRC", "NTU". Other words in
/// capitals are none.
bool is_named_in_capitals(std::string_view inside) {
    constexpr std::string_view k_units[] = {"HRA", "HRB", "HRC", "HRD", "HV",  "HB", "HBW", "HK",  "HL", "HLD", "IRHD",
                                            "PSI", "NTU", "FNU", "FTU", "FAU", "GU", "pH",  "mpH", "BU", "EBC"};
    return std::find(std::begin(k_units), std::end(k_units), inside) != std::end(k_units);
}

/// Whether a word that nothing sets apart is a unit and no symbol: "µm" and "mV", not "uA", "cu" or "K".
bool is_unit_of_its_own(std::string_view word) {
    constexpr std::string_view k_units[] = {
        "mm", "µm", "μm",  "um",  "nm",  "pm",  "cm",  "km",   "kg",   "mg",   "µg",    "μg",  "ng",  "mL",  "ml",
        "µL", "μL", "µl",  "μl",  "ms",  "µs",  "μs",  "ns",   "ps",   "mV",   "µV",    "μV",  "nV",  "kV",  "mA",
        "µA", "μA", "nA",  "kA",  "mK",  "µK",  "μK",  "°C",   "Pa",   "hPa",  "kPa",   "MPa", "mPa", "bar", "mbar",
        "kN", "mN", "Hz",  "kHz", "MHz", "GHz", "mHz", "mW",   "kW",   "µW",   "μW",    "mJ",  "kJ",  "mΩ",  "µΩ",
        "μΩ", "kΩ", "MΩ",  "GΩ",  "Ω",   "ohm", "pF",  "nF",   "µF",   "μF",   "mH",    "µH",  "μH",  "mT",  "µT",
        "μT", "dB", "ppm", "N·m", "Nm",  "°",   "″",   "mrad", "µrad", "μrad", "arcsec"};
    if (std::find(std::begin(k_units), std::end(k_units), word) != std::end(k_units)) {
        return true;
    }
    // "µV/V", "mg/L", "nm/K": of units both.
    const std::size_t slash = word.find('/');
    return slash != std::string_view::npos && is_unit_of_its_own(word.substr(0, slash)) &&
           word.find('/', slash + 1) == std::string_view::npos && known_unit(std::string(word.substr(slash + 1))) &&
           known_unit(std::string(word));
}

/// "u mm", "Beitrag µV": a unit behind a blank, where no number stands before it ("U at 10 mm").
std::string unit_behind_blank(std::string_view head) {
    const std::size_t blank = head.rfind(' ');
    if (blank == std::string_view::npos || blank == 0) {
        return "";
    }
    const std::string_view word = head.substr(blank + 1), before = head.substr(0, blank);
    const std::size_t begin = before.rfind(' ') + 1;
    // A percent sign alone may be that of a share.
    const bool is_part = word == "%" && text::in_small_letters(std::string(before)).find("rel") != std::string::npos;
    return (is_part || is_unit_of_its_own(word)) && before.find_first_of("0123456789", begin) == std::string_view::npos
               ? std::string(word)
               : "";
}

std::string text_of_unit_in_head(const std::string& head) {
    const std::size_t open = head.find('['), close = head.find(']');
    if (open != std::string::npos && close != std::string::npos && close > open + 1) {
        return std::string(bare_unit(std::string_view(head).substr(open + 1, close - open - 1)));
    }
    if (const std::size_t slash = head.rfind(" / "); slash != std::string::npos) {
        const std::string behind = head.substr(slash + 3), unit = behind.substr(0, behind.find_first_of(" ,;:="));
        const bool is_number = unit.find_first_not_of("0123456789.,") == std::string::npos;
        return !known_unit(behind) && !is_number && known_unit(unit) ? unit : behind;  // "U / dB, k = 2"
    }
    if (const std::size_t in = head.rfind(" in "); in != std::string::npos) {
        const std::string behind = head.substr(in + 4), unit = behind.substr(0, behind.find_first_of("( ,;:="));
        if (known_unit(behind)) {
            return behind;
        }
        // "U in mV, k = 2", "Ergebnis in g = 10,0001"; of "in % of reading" nobody knows what it is a part of.
        const std::size_t next = behind.find_first_not_of(' ', unit.size());
        if (next != std::string::npos && std::string_view("(,;:=").find(behind[next]) != std::string_view::npos &&
            known_unit(unit)) {
            return unit;
        }
    }
    constexpr std::string_view k_plus_minus = "± ";  // "Value ± kPa"
    if (const std::size_t sign = head.find(k_plus_minus); sign != std::string::npos && sign > 0) {
        std::string_view behind = std::string_view(head).substr(sign + k_plus_minus.size());
        if (behind.ends_with(')') && behind.find('(') == std::string_view::npos) {
            behind.remove_suffix(1);  // "Limits (± mm)"
        }
        const bool is_number = !behind.empty() && behind.find_first_not_of("0123456789., ") == std::string_view::npos;
        return is_number ? "" : std::string(bare_unit(behind));
    }
    const std::size_t round = head.rfind(" (");
    if (round != std::string::npos && head.ends_with(')')) {
        std::string inside = head.substr(round + 2, head.size() - round - 3);
        if (const std::string_view both = "±"; inside.starts_with(both)) {  // "Specification (±mm)"
            inside = std::string(bare_unit(std::string_view(inside).substr(both.size())));
        }
        // "(y)", "(k = 2)" and "(A)" say what the head is of.
        constexpr std::string_view k_units_of_one_letter = "mgKVNJW%";
        const bool one_letter = inside.size() == 1 && k_units_of_one_letter.find(inside) == std::string_view::npos;
        return !one_letter && (known_unit(inside) || is_named_in_capitals(inside))
                   ? inside
                   : unit_behind_blank(std::string_view(head).substr(0, round));  // "U mm (k = 2)"
    }
    return unit_behind_blank(head);
}

}  // namespace

std::string unit_in_head(const std::string& head) {
    const std::string unit = text_of_unit_in_head(head);
    // "U / k", "Half-width / U": what the column has in the language of formulas.
    const bool is_symbol = unit == "U" || unit == "u" || unit == "a" || unit == "k";
    return is_symbol || is_value(unit) ? "" : unit;
}

namespace {

/// Whether a line says that all numbers are parts of a value, and so of dimension one.
bool says_relative(const std::string& lower) {
    constexpr std::string_view k_words[] = {"relative deviation",    "relative frequency", "fractional frequency",
                                            "relative uncertaint",   "relative standard",  "dimensionless",
                                            "relative abweichung",   "relative unsicher",  "relative messunsicher",
                                            "relative standardunsi", "dimensionslos",      "relative frequenz"};
    return std::any_of(std::begin(k_words), std::end(k_words),
                       [&lower](std::string_view word) { return lower.find(word) != lower.npos; });
}

}  // namespace

std::string unit_in_words(const std::string& line) {
    constexpr std::string_view k_of_all[] = {"all ",    "all in",     "alle ",        "values",        "werte",
                                             "angaben", "uncertaint", "unsicherheit", "contributions", "beiträge",
                                             "valores", "todo",       "incertidumbre"};
    const std::string lower = text::in_small_letters(line);
    if (lower.size() != line.size() ||
        std::none_of(std::begin(k_of_all), std::end(k_of_all), [&lower](std::string_view word) {
            const std::size_t at = lower.find(word);
            const bool begins_word = at != lower.npos && (at == 0 || lower[at - 1] < 'a' || lower[at - 1] > 'z');
            return begins_word || (at != lower.npos && word == "unsicherheit");
        })) {
        return says_relative(lower) ? "1" : "";
    }
    for (const std::string_view word : {" in ", " en "}) {
        const std::size_t at = line.rfind(word);
        if (at == std::string::npos) {
            continue;
        }
        const std::size_t from = at + word.size();
        const std::string unit(bare_unit(line.substr(from, line.find_first_of(",;.()", from) - from)));
        if (known_unit(unit)) {
            return unit;
        }
    }
    return says_relative(lower) ? "1" : "";
}

std::string unit_in_rest(const std::string& rest) {
    const std::string whole(bare_unit(rest));
    if (whole.empty() || known_unit(whole)) {
        return whole;
    }
    const std::size_t end = whole.find_first_of(",;(");
    const std::string first(bare_unit(std::string_view(whole).substr(0, end)));
    if (first != whole && known_unit(first)) {
        return first;
    }
    // "HRC" is none that this program knows, and may be one; a sentence is none, nor digits and signs alone, "*", "2)".
    const bool may_be_one = std::any_of(first.begin(), first.end(), [](char c) {
        constexpr std::string_view k_signs = "%\x22\x27";  // a double or single quote stands for seconds and minutes
        const auto code = static_cast<unsigned char>(c);
        return std::isalpha(code) != 0 || code >= 0x80 || k_signs.find(c) != std::string_view::npos;
    });
    return may_be_one && first.find(' ') == std::string::npos ? first : "";
}

bool is_unit_of_part(const std::string& unit) {
    const std::optional<gum::Unit> known = known_unit(unit);
    const std::string_view bare = bare_unit(unit);
    return known && known->dimension().is_one() && bare != "1" && bare != "-" && bare != "–";
}

bool is_part_beside(const std::string& unit, const std::string& other) {
    const std::optional<gum::Unit> known = known_unit(other);
    return is_unit_of_part(unit) && known && !known->dimension().is_one();
}

std::optional<double> factor_between(const std::string& from, const std::string& to) {
    if (from == to || from.empty() || to.empty()) {
        return 1.0;
    }
    const std::optional<gum::Unit> a = known_unit(from), b = known_unit(to);
    if (!a || !b || !(a->dimension() == b->dimension())) {
        return std::nullopt;
    }
    return b->difference_from_si(a->difference_to_si(1.0));
}

std::string shared_unit(const std::string& of_difference, const std::string& of_value) {
    if (of_difference.empty()) {
        return of_value;
    }
    const std::optional<gum::Unit> difference = known_unit(of_difference), value = known_unit(of_value);
    const bool celsius = value && difference && value->is_celsius_temperature() &&
                         !difference->is_celsius_temperature() && value->dimension() == difference->dimension();
    return celsius ? of_value : of_difference;
}
}  // namespace gumcert::audit
