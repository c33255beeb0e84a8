#include "audit/sources/table_units.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

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

double size_of_unit(const gum::Unit& unit) {
    return unit.difference_to_si(1.0);
}

/// What a number is meant to be used in, and whether it could be brought there.
class Conversions {
public:
    explicit Conversions(std::vector<Sentence>& not_read) : not_read_(not_read) {}

    void bring(std::optional<StatedNumber>& number, const std::string& from, const std::string& to) {
        if (!number) {
            return;
        }
        if (const std::optional<double> factor = factor_between(from, to)) {
            convert(*number, *factor);
            return;
        }
        not_read_.push_back(
            say("{cell}: a number in {from} beside others in {to}; it is not used, as one unit cannot "
                "be turned into the other",
                number->place, text::in_quotes(from), text::in_quotes(to)));
        number.reset();
    }

private:
    std::vector<Sentence>& not_read_;
};

bool is_one(const std::optional<StatedNumber>& c) {
    return !c || std::abs(c->value) == 1.0;
}

/// u as the row has it, or what it was divided from.
double u_of(const AuditedRow& row) {
    if (row.u) {
        return std::abs(row.u->value);
    }
    const bool divided = row.stated && row.divisor && row.divisor->value > 0.0;
    return divided ? std::abs(row.stated->value / row.divisor->value) : 0.0;
}

/// Whether a contribution is nearer to u times one factor than to u times another. Units of one kind differ by factors of ten
/// at least, and errors of a row by less.
bool is_nearer(double factor, double other, const StatedNumber& contribution, double u) {
    const double size = std::abs(contribution.value);
    const auto distance = [&](double by) { return std::abs(std::log(u * by / size)); };
    return size > 0.0 && u > 0.0 && distance(factor) < distance(other);
}

/// The unit of the contributions that state none.
std::string unit_of_contributions(const std::vector<AuditedRow>& rows, const std::vector<RowUnits>& units,
                                  const std::string& result_unit) {
    std::vector<std::pair<double, std::size_t>> counts;  // factor to the result, rows
    std::vector<std::string> names;
    std::size_t all = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::optional<double> factor = factor_between(rows[i].unit, result_unit);
        if (rows[i].unit.empty() || !factor || !is_one(rows[i].sensitivity) || !units[i].sensitivity.empty()) {
            continue;
        }
        ++all;
        const bool is_in_result = rows[i].contribution && is_nearer(*factor, 1.0, *rows[i].contribution, u_of(rows[i]));
        factor = is_in_result ? 1.0 : *factor;
        const auto known =
            std::find_if(counts.begin(), counts.end(), [&factor](const auto& count) { return count.first == *factor; });
        if (known == counts.end()) {
            counts.emplace_back(*factor, 1);
            names.push_back(is_in_result ? result_unit : rows[i].unit);
        } else {
            ++known->second;
        }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (2 * counts[i].second > all) {
            return names[i];
        }
    }
    return result_unit;
}

/// The unit that contributions state, more of them than state none; "" where no unit is stated by as many.
std::string unit_of_most(const std::vector<AuditedRow>& rows, const std::vector<RowUnits>& units) {
    std::map<std::string, std::size_t> counts;
    std::size_t bare = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!units[i].contribution.empty()) {
            ++counts[units[i].contribution];
        } else if (rows[i].contribution) {
            ++bare;
        }
    }
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() || most->second <= bare ? "" : most->first;
}

/// The unit of a contribution that states none beside others that do: theirs, unless |c| u is nearer to it in that of the others
/// without one.
const std::string& unit_beside_others(const AuditedRow& row, const RowUnits& own, const std::string& of_others,
                                      const std::string& of_bare, const std::string& result_unit) {
    const std::optional<double> in_others = factor_between(of_others, result_unit),
                                in_bare = factor_between(of_bare, result_unit),
                                of_row = factor_between(row.unit, result_unit);
    const bool is_bare = own.sensitivity.empty() && of_row && in_others && in_bare && row.contribution;
    const double c = row.sensitivity ? std::abs(row.sensitivity->value) : 1.0;
    return is_bare && is_nearer(*of_row / *in_bare, *of_row / *in_others, *row.contribution, c * u_of(row)) ? of_bare
                                                                                                            : of_others;
}

/// The factor of a coefficient whose unit is stated; nothing where the unit is of another kind, which is a matter of S01.
std::optional<double> factor_of_stated(const gum::Unit& c, const gum::Unit& row, const gum::Unit& result) {
    if (c.dimension() == result.dimension() / row.dimension()) {
        return size_of_unit(c) * size_of_unit(row) / size_of_unit(result);
    }
    return std::nullopt;
}

/// The factor of a coefficient without a unit.
/// \param of_number  where it is a number of the unit of the contribution per the unit of the row
double factor_of_bare(const AuditedRow& row, const std::string& result_unit, double of_number) {
    std::optional<double> of_quantity = factor_between(row.unit, result_unit);
    if (!of_quantity && is_unit_of_part(row.unit)) {
        of_quantity =
            size_of_unit(*known_unit(row.unit));  // 2.3 mg of a row in percent, as it is multiplied with 0.005
    }
    const double c = row.sensitivity ? std::abs(row.sensitivity->value) : 1.0;
    const double u = u_of(row);
    if (!of_quantity || row.unit.empty() || *of_quantity == of_number || !row.contribution || !(c * u > 0.0)) {
        return of_number;
    }
    return is_nearer(*of_quantity, of_number, *row.contribution, c * u) ? *of_quantity : of_number;
}

void settle_coefficient(AuditedRow& row, const std::string& own, const std::string& result_unit, double of_number,
                        std::vector<Sentence>& not_read) {
    std::optional<double> factor;
    const std::optional<gum::Unit> c = own.empty() ? std::nullopt : known_unit(own);
    if (row.sensitivity && !own.empty() && !c) {
        not_read.push_back(
            say("{cell}: the unit {unit} of the sensitivity coefficient is not read; the number is taken as "
                "it stands",
                row.sensitivity->place, text::in_quotes(own)));
    }
    const bool is_bare = own == "1" || own == "-" || own == "–";
    if (row.sensitivity && c && !is_bare) {
        const std::optional<gum::Unit> of_row = known_unit(row.unit), of_result = known_unit(result_unit);
        if (!of_row && of_result && c->dimension() == of_result->dimension()) {
            factor = size_of_unit(*c) / size_of_unit(*of_result);
        } else if ((!of_row || !of_result) && own == "%") {
            factor = 0.01;
        } else if (of_row && of_result) {
            row.sensitivity_unit = own;
            factor = factor_of_stated(*c, *of_row, *of_result);
            if (!factor && c->dimension() == of_result->dimension()) {  // "0.021 %" of a coefficient per kelvin
                row.sensitivity_unit.clear();
                factor = size_of_unit(*c) / size_of_unit(*of_result);
            } else if (!factor) {
                factor = 1.0;  // S01 tells of it
            }
        }
    }
    const double used = factor ? *factor : factor_of_bare(row, result_unit, of_number);
    if (used == 1.0) {
        return;
    }
    if (!row.sensitivity && row.contribution && u_of(row) > 0.0) {
        return;  // what the contribution is of u says it
    }
    if (!row.sensitivity) {
        row.sensitivity = exact_number(1.0, row.place);
    }
    convert(*row.sensitivity, used);
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
    // "HRC" is none that this program knows, and may be one; a sentence is none.
    return first.find(' ') == std::string::npos ? first : "";
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

bool settle_units(std::vector<AuditedRow>& rows, const std::vector<RowUnits>& units, const std::string& result_unit,
                  std::vector<Sentence>& not_read) {
    bool is_usable = true;
    const auto has_uncertainty = [](const AuditedRow& row) { return row.u || row.stated || row.contribution; };
    Conversions conversions(not_read);
    const std::string of_contributions = unit_of_contributions(rows, units, result_unit),
                      of_others = unit_of_most(rows, units);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        AuditedRow& row = rows[i];
        const RowUnits& own = units[i];
        const bool had_uncertainty = has_uncertainty(row);
        conversions.bring(row.estimate, own.estimate, row.unit);
        conversions.bring(row.stated, own.stated, row.unit);
        conversions.bring(row.u, own.u, row.unit);
        const std::string& of_contribution =
            !own.contribution.empty() ? own.contribution
            : of_others.empty()       ? of_contributions
                                      : unit_beside_others(row, own, of_others, of_contributions, result_unit);
        conversions.bring(row.contribution, of_contribution, result_unit);
        settle_coefficient(row, own.sensitivity, result_unit,
                           factor_between(of_contribution, result_unit).value_or(1.0), not_read);
        is_usable = is_usable && (has_uncertainty(row) || !had_uncertainty);
    }
    return is_usable;
}

}  // namespace gumcert::audit
