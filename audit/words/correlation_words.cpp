#include "audit/words/correlation_words.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "audit/stated_number.h"
#include "audit/word_line.h"
#include "audit/words/unit_words.h"
#include "gum/quantity/unit.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    while (!text.empty() && text.back() == ' ') {
        text.remove_suffix(1);
    }
    return text;
}

template <std::size_t N>
bool has_one_of(std::string_view text, const std::string_view (&words)[N]) {
    return std::any_of(std::begin(words), std::end(words),
                       [text](std::string_view word) { return text.find(word) != std::string_view::npos; });
}

/// Whether "r" or "ρ" begins at a place as a word of its own.
std::size_t end_of_symbol(std::string_view name, std::size_t at) {
    const auto is_of_word = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               static_cast<unsigned char>(c) >= 0x80U;
    };
    for (const std::string_view symbol : {"r", "ρ"}) {
        const std::size_t end = at + symbol.size();
        if (name.substr(at).starts_with(symbol) && (at == 0 || !is_of_word(name[at - 1])) &&
            (end == name.size() || !is_of_word(name[end]))) {
            return end;
        }
    }
    return 0;
}

/// Whether what follows a number leaves it a pure one: no unit, no percentage and no further factor.
bool is_of_number_one(const std::string& rest) {
    constexpr std::string_view k_factors[] = {"/", "%", "‰", "^", "*", "·", "×", "±"};
    if (std::any_of(std::begin(k_factors), std::end(k_factors),
                    [&rest](std::string_view factor) { return rest.starts_with(factor); })) {
        return false;
    }
    const std::size_t end = rest.find_first_of(" ,;(");
    const std::string word = rest.substr(0, end);
    // With more words behind it, what is written like an inch or a year is one of them.
    constexpr std::string_view k_words[] = {"a", "am", "as", "at", "in"};
    const bool is_word = end != std::string::npos && rest[end] == ' ' &&
                         std::find(std::begin(k_words), std::end(k_words), word) != std::end(k_words);
    const std::optional<gum::Unit> unit = is_word ? std::nullopt : known_unit(word);
    return !unit || (unit->dimension().is_one() && !is_unit_of_part(word));
}

/// The number behind "r =" or "r(X; Y) =".
std::optional<double> assigned_r(std::string_view name) {
    for (std::size_t at = 0; at < name.size(); ++at) {
        std::size_t end = end_of_symbol(name, at);
        if (end == 0) {
            continue;
        }
        if (end < name.size() && name[end] == '(') {
            const std::size_t close = name.find(')', end);
            end = close == std::string_view::npos ? name.size() : close + 1;
        }
        const std::string_view behind = without_blanks(name.substr(end));
        if (!behind.starts_with('=') && !behind.starts_with(':')) {
            continue;
        }
        const std::optional<LeadingNumber> number =
            read_leading_number(without_blanks(behind.substr(1)), "", Percent::unit);
        // "r = 0.9 mm" is a radius, "ρ = 0.998 g/cm³" a density; and of "r = 1/2" the number behind is not 1.
        if (number && !number->is_open && std::abs(number->number.value) <= 1.0 && is_of_number_one(number->rest)) {
            return number->number.value;
        }
    }
    return std::nullopt;
}

/// Two symbols between brackets, "x; y" or "x, y".
std::optional<std::pair<std::string_view, std::string_view>> pair_between(std::string_view inside) {
    const std::size_t sign = inside.find_first_of(";,");
    if (sign == std::string_view::npos || inside.find_first_of(";,", sign + 1) != std::string_view::npos) {
        return std::nullopt;
    }
    return std::pair(without_blanks(inside.substr(0, sign)), without_blanks(inside.substr(sign + 1)));
}
/// Whether a name begins as "r(x; y)". A density "ρ(20 °C)" and a radius "r(1)" do not, nor does a density "ρ(20 °C; 1 bar)".
bool begins_with_r_of_pair(std::string_view name) {
    const std::size_t open = name.find('('), close = name.find(')');
    if ((!name.starts_with("r(") && !name.starts_with("ρ(")) || close == std::string_view::npos) {
        return false;
    }
    const auto pair = pair_between(name.substr(open + 1, close - open - 1));
    const auto is_symbol = [](std::string_view text) {
        return !text.empty() && (text.front() < '0' || text.front() > '9');
    };
    return pair && is_symbol(pair->first) && is_symbol(pair->second);
}

std::vector<std::pair<std::string, std::string>> pairs_in(std::string_view name) {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (std::size_t open = name.find('('); open != std::string_view::npos; open = name.find('(', open + 1)) {
        const std::size_t close = name.find(')', open);
        if (close == std::string_view::npos) {
            break;
        }
        if (const auto pair = pair_between(name.substr(open + 1, close - open - 1))) {
            pairs.emplace_back(pair->first, pair->second);
        }
    }
    for (const std::string_view between : {" and ", " und ", " et ", " y ", " with ", " mit ", "/", " - ", "-", "–"}) {
        for (std::size_t at = name.find(between); at != std::string_view::npos; at = name.find(between, at + 1)) {
            const std::string_view before = without_blanks(name.substr(0, at));
            const std::string_view behind = without_blanks(name.substr(at + between.size()));
            const std::size_t begin = before.find_last_of(" (,;:");
            const std::string_view first = before.substr(begin == std::string_view::npos ? 0 : begin + 1);
            const std::string_view second = behind.substr(0, behind.find_first_of(" ),;:="));
            if (!first.empty() && !second.empty()) {
                pairs.emplace_back(first, second);
            }
        }
    }
    return pairs;
}

}  // namespace

std::optional<double> stated_correlation(std::string_view text) {
    return assigned_r(text);
}

NotedCorrelation noted_correlation(std::string_view note) {
    const WordLine words(note);
    if (words.has_any({"together", "jointly", "in common", "correlated", "gemeinsam", "zusammen", "korreliert",
                       "parameter", "conjunt", "juntos", "juntas"}) ||
        note.find("一起") != std::string_view::npos || note.find("共同") != std::string_view::npos) {
        return NotedCorrelation::of_rows;
    }
    const bool is_of_fit = words.has_any(
        {"regres",  "*regression", "fit ",   "fits ",     "fitted",  "fitting", "line ",     "lines ", "linear",
         "curve",   "kurve",       "*kurve", "kennlinie", "gerade ", "*gerade", "ausgleich", "drift",  "trend",
         "polynom", "interpol",    "slope",  "steigung",  "ajuste",  "recta ",  "droite ",   "r2 "});
    constexpr std::string_view k_other[] = {"r²", "R²", "回歸", "迴歸", "回归", "擬合", "拟合", "漂移"};
    return is_of_fit || has_one_of(note, k_other) ? NotedCorrelation::of_fit : NotedCorrelation::open;
}

std::optional<CorrelationWords> correlation_words(std::string_view name) {
    constexpr std::size_t k_longest = 200;
    name = without_blanks(name);
    if (name.empty() || name.size() > k_longest) {
        return std::nullopt;
    }
    const std::string lower = text::in_small_letters(name);
    constexpr std::string_view k_correlation[] = {"correlation", "korrelation", "correlaci",
                                                  "corrélation", "相關",        "相关"};
    constexpr std::string_view k_covariance[] = {"covarian", "kovarian", "協方差", "共變異", "协方差"};
    constexpr std::string_view k_coefficient[] = {"coefficient", "koeffizient", "coeficiente", "係數", "系数"};
    const bool is_named = has_one_of(lower, k_correlation);
    const bool is_symbol = begins_with_r_of_pair(name);
    const std::optional<double> r =
        is_named || is_symbol || end_of_symbol(name, 0) > 0 ? assigned_r(name) : std::nullopt;
    const bool is_covariance = has_one_of(lower, k_covariance);
    if (!is_named && !is_symbol && !is_covariance) {
        return std::nullopt;
    }
    // What "r(x; y)" alone has under u may be the u of a quantity r: without words it is a coefficient where x and y are rows.
    std::size_t symbol = is_named ? name.find("r(") : std::string_view::npos;
    while (symbol != std::string_view::npos && end_of_symbol(name, symbol) == 0) {
        symbol = name.find("r(", symbol + 1);
    }
    return CorrelationWords{.is_coefficient = !is_covariance && (symbol != std::string_view::npos || r.has_value() ||
                                                                 has_one_of(lower, k_coefficient)),
                            .is_covariance = is_covariance,
                            .r = r,
                            .pairs = pairs_in(name)};
}

}  // namespace gumcert::audit
