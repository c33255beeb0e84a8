#include "audit/words/column_heads.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "audit/stated_number.h"
#include "audit/words/bare_text.h"
#include "audit/words/column_words.h"
#include "audit/words/unit_words.h"
#include "certificate/text_words.h"
#include "gum/quantity/unit.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

/// A head before its unit, "Contribution / nm" and "Beitrag in µm"; the whole where it has none. What is divided over something is
/// no unit.
std::string_view without_unit(std::string_view head) {
    for (const std::string_view sign : {" / ", " in "}) {
        const std::size_t at = head.rfind(sign);
        if (at == std::string_view::npos || at == 0) {
            continue;
        }
        const std::string rest(trimmed(head.substr(at + sign.size())));
        const bool is_unit = known_unit(rest).has_value();
        const bool may_be =
            sign == " / " && rest.find(' ') == std::string::npos && (rest == "U" || rest == "a" || !column_word(rest));
        if (is_unit || may_be) {
            return trimmed(head.substr(0, at));
        }
    }
    return head;
}

std::optional<Column> meaning_of_head(std::string_view text) {
    if (text == "u" || text == "u_xx") {  // the latter in ISO 14253-2
        return Column::u;
    }
    if (text == "U" || text == "±" || text == "+/-") {
        return Column::stated;
    }
    return column_word(text);
}

/// "(c·u)²", "u_i²(y)", "c²u²": squares of u or of contributions, by their symbols.
bool is_square(std::string_view head) {
    std::string bare;
    bool has_power = false;
    for (std::size_t at = 0; at < head.size();) {
        std::size_t power = 0;
        for (const std::string_view sign : {"²", "^2"}) {
            power = head.substr(at).starts_with(sign) ? sign.size() : power;
        }
        has_power = has_power || power > 0;
        bare += power > 0 ? "" : std::string(head.substr(at, 1));
        at += std::max<std::size_t>(power, 1);
    }
    if (!has_power) {
        return false;
    }
    const std::optional<Column> column = meaning_of_head(trimmed(bare));
    return column == Column::u || column == Column::contribution;
}

/// A number with a unit in a head, behind a space, a bracket or "@".
struct PointOfHead {
    std::size_t at = std::string_view::npos;  ///< where it begins
    std::string text;                         ///< "10 V"
};
PointOfHead point_of(std::string_view head) {
    for (std::size_t at = head.find_first_of("0123456789"); at != std::string_view::npos && at > 0;
         at = head.find_first_of("0123456789", head.find_first_not_of("0123456789.,", at))) {
        const char before = head[at - 1];
        const std::string_view part = head.substr(at, head.find_first_of(")],;", at) - at);
        const std::optional<LeadingNumber> number = before == ' ' || before == '(' || before == '[' || before == '@'
                                                        ? read_leading_number(part, "", Percent::unit)
                                                        : std::nullopt;
        const std::string unit =
            number ? unit_in_rest(number->rest.substr(0, std::min(number->rest.find(" in "), number->rest.find(" / "))))
                   : std::string();
        if (!unit.empty() && known_unit(unit)) {
            return {.at = at, .text = number->number.text + " " + unit};
        }
    }
    return {};
}

}  // namespace

bool is_of_other_language(std::string_view head) {
    const std::u32string letters = certificate::letters_of(head);
    constexpr char32_t k_first_ideograph = U'\u3400', k_last_ideograph = U'\u9FFF';
    if (std::any_of(letters.begin(), letters.end(),
                    [](char32_t letter) { return letter >= k_first_ideograph && letter <= k_last_ideograph; })) {
        return true;
    }
    constexpr std::array<std::u32string_view, 20> k_parts{
        U"incertidumbre", U"incertitude", U"sensibilidad", U"sensibilite", U"contribucion",
        U"distribucion",  U"coeficiente", U"unidad",       U"grandeur",    U"diviseur",
        U"valeur",        U"composante",  U"estimacion",   U"semiancho",   U"semiintervalo",
        U"demietendue",   U"demilargeur", U"tolerancia",   U"degresdelib", U"gradosdelib"};
    constexpr std::array<std::u32string_view, 12> k_whole{U"magnitud", U"componente", U"fuente", U"valor",
                                                          U"unite",    U"loi",        U"origen", U"origine",
                                                          U"simbolo",  U"symbole",    U"limite", U"descripcion"};
    return std::find(k_whole.begin(), k_whole.end(), letters) != k_whole.end() ||
           std::any_of(k_parts.begin(), k_parts.end(),
                       [&letters](std::u32string_view part) { return letters.find(part) != std::u32string::npos; });
}

std::optional<LimitHead> limit_head(std::string_view head) {
    if (head.find_first_of("0123456789=") != std::string_view::npos) {
        return std::nullopt;
    }
    std::string_view bare = head.substr(0, head.find_first_of("([/,"));
    while (bare.ends_with(' ')) {
        bare.remove_suffix(1);
    }
    const std::string_view symbol = bare.substr(bare.find_last_of(' ') + 1);  // npos + 1 is 0
    constexpr std::array<std::string_view, 3> k_upper_symbols{"a+", "a₊", "a_+"};
    constexpr std::array<std::string_view, 5> k_lower_symbols{"a-", "a−", "a₋", "a_-", "a_−"};
    if (std::find(k_upper_symbols.begin(), k_upper_symbols.end(), symbol) != k_upper_symbols.end()) {
        return LimitHead::upper;
    }
    if (std::find(k_lower_symbols.begin(), k_lower_symbols.end(), symbol) != k_lower_symbols.end()) {
        return LimitHead::lower;
    }
    const std::u32string letters = certificate::letters_of(bare);
    constexpr std::array<std::u32string_view, 5> k_lower{U"lower", U"lowerlimit", U"lowerbound", U"untergrenze",
                                                         U"unteregrenze"},
        k_upper{U"upper", U"upperlimit", U"upperbound", U"obergrenze", U"oberegrenze"};
    if (std::find(k_lower.begin(), k_lower.end(), letters) != k_lower.end()) {
        return LimitHead::lower;
    }
    return std::find(k_upper.begin(), k_upper.end(), letters) != k_upper.end() ? std::optional(LimitHead::upper)
                                                                               : std::nullopt;
}

bool is_unused_column(std::string_view head) {
    head = trimmed(head);
    const auto has_letters = std::any_of(head.begin(), head.end(), is_letter);
    if (!has_letters) {
        return true;  // "%", "#"
    }
    for (const std::string_view text : {head, trimmed(without_brackets(head)), without_unit(head)}) {
        const std::size_t end = text.find_last_not_of("% ");
        const bool is_share = end + 1 < text.size() && meaning_of_head(text.substr(0, end + 1)) == Column::contribution;
        if (is_share || is_square(text) || is_unused_column_word(text)) {
            return true;
        }
    }
    return false;
}

std::string point_in_head(std::string_view head) {
    return point_of(head).text;
}

bool is_relative_symbol(std::string_view head) {
    const std::string_view symbol = trimmed(without_brackets(without_unit(trimmed(head))));
    return is_one_of(symbol, {"w", "w_i", "wi", "w(xi)", "w(x_i)"});
}

bool is_of_relative_uncertainty(std::string_view head) {
    if (is_relative_symbol(head)) {
        return true;
    }
    for (const std::string_view text :
         {trimmed(head), trimmed(without_unit(trimmed(head))), trimmed(without_brackets(head))}) {
        std::string lower = text::in_small_letters(std::string(text));
        std::erase_if(lower, [](char c) { return c == ' ' || c == '_' || c == '|' || c == ',' || c == '.'; });
        if (is_one_of(lower, {"urel", "ur", "rsu", "relu", "u(x)/x", "u(xi)/xi", "u(y)/y", "u/x", "ui/xi", "u(q)/q"})) {
            return true;
        }
    }
    const std::string whole = text::in_small_letters(std::string(head));
    for (const std::string_view share : {"contrib", "share", "beitrag", "anteil"}) {
        if (whole.find(share) != std::string::npos) {
            return false;  // "Relative contribution to uncertainty"
        }
    }
    const bool is_relative = whole.find("relativ") != std::string::npos || whole.starts_with("rel. ") ||
                             whole.starts_with("rel ") || whole.starts_with("relat. ");
    return is_relative && (whole.find("uncert") != std::string::npos || whole.find("unc.") != std::string::npos ||
                           whole.find("unsich") != std::string::npos || whole.find(" u") != std::string::npos);
}

std::optional<Column> relative_column_of(std::string_view head, std::string_view unit_of_numbers) {
    head = trimmed(head);
    const std::string of_head = unit_in_head(std::string(head));
    if (!of_head.empty() && head.ends_with(" " + of_head) && !head.ends_with("/ " + of_head)) {
        head = trimmed(head.substr(0, head.size() - of_head.size()));  // "Relative standard uncertainty %"
    }
    const std::optional<gum::Unit> unit = known_unit(of_head.empty() ? std::string(unit_of_numbers) : of_head);
    if (!unit || !unit->dimension().is_one()) {
        return std::nullopt;
    }
    for (const std::string_view word :
         {"relative ", "Relative ", "rel. ", "Rel. ", "relativer ", "Relativer ", "relat. ", "Relat. "}) {
        if (head.starts_with(word)) {
            return column_of(head.substr(word.size()));
        }
    }
    return is_relative_symbol(head) ? std::optional(Column::u) : std::nullopt;
}

std::optional<Column> column_of(std::string_view head) {
    head = trimmed(head);
    // "u_i ≡ |c_i| u(x_i) (nm)": a symbol and what it stands for (JCGM 100:2008, table H.1).
    if (const std::size_t at = head.find(" ≡ "); at != std::string_view::npos && at > 0) {
        return column_of(head.substr(0, at));
    }
    // "u bei 10 V", "Contribution 10 V": of one of several points beside each other.
    if (const std::size_t at = point_of(head).at; at != std::string_view::npos && head[at - 1] != '(') {
        std::string_view name = trimmed(head.substr(0, at));
        for (const std::string_view word : {" at", " bei", " for", " für", " @", "@", " en", " a"}) {
            if (name.ends_with(word)) {
                name = trimmed(name.substr(0, name.size() - word.size()));
                break;
            }
        }
        const std::optional<Column> column = column_of(name);
        if (column == Column::u || column == Column::contribution) {
            return column;
        }
    }
    // "Value ± kPa", "ui(P) ± kPa": the layout of M3003, where ± says that the column has uncertainties, and what follows is
    // their unit. What is headed "Value" there is divided; it is no estimate.
    constexpr std::string_view k_plus_minus = "±";
    if (const std::size_t at = head.find(k_plus_minus); at != std::string_view::npos && at > 0) {
        const std::string_view name = trimmed(head.substr(0, at));
        if (name.starts_with("ui(") || name.starts_with("u_i(")) {  // u_i(y) of any y
            return Column::contribution;
        }
        const std::optional<Column> column = column_of(name);
        return column == Column::estimate ? std::optional(Column::stated) : column;
    }
    // "ui(V)" of any V that is no input: u_i(y) of the result.
    for (const std::string_view symbol : {"ui(", "u_i("}) {
        const std::size_t close = head.find(')');
        if (head.starts_with(symbol) && close != std::string_view::npos && close > symbol.size()) {
            const std::string_view of = head.substr(symbol.size(), close - symbol.size());
            const bool is_whole = close + 1 == head.size() || without_unit(head).size() == close + 1 ||
                                  trimmed(without_brackets(head)).size() == close + 1;
            if (is_whole && !of.starts_with('x') && !of.starts_with('X') && is_symbol(of)) {
                return Column::contribution;
            }
        }
    }
    const std::string_view bare = without_unit(head);
    const std::string_view texts[] = {head, trimmed(without_brackets(head)), bare, trimmed(without_brackets(bare))};
    std::size_t length = std::string_view::npos;
    for (const std::string_view text : texts) {
        // Most heads have neither unit nor brackets, and are four times the same.
        if (text.size() != std::exchange(length, text.size())) {
            if (const std::optional<Column> column = meaning_of_head(text)) {
                return column;
            }
        }
    }
    for (const std::string_view text : texts) {  // "Half-width a or U": both are what is divided
        for (const std::string_view word : {" or ", " oder ", " bzw. "}) {
            const std::size_t at = text.find(word);
            if (at == std::string_view::npos || at == 0 || text.find(word, at + 1) != std::string_view::npos) {
                continue;
            }
            const std::optional<Column> column = column_of(text.substr(0, at));
            if (column && column == column_of(text.substr(at + word.size()))) {
                return column;
            }
        }
    }
    for (const std::string_view text : texts) {
        const std::size_t at = text.rfind(' ');
        if (at == std::string_view::npos || at == 0 || !is_symbol(text.substr(at + 1))) {
            continue;
        }
        const std::string_view symbol = text.substr(at + 1);
        std::string_view before = trimmed(text.substr(0, at));
        before = before.ends_with(',') ? trimmed(before.substr(0, before.size() - 1)) : before;  // "u, mm"
        const std::optional<Column> column = meaning_of_head(before);
        if (column == Column::stated && symbol.front() == 'u') {  // "Uncertainty u(x)"
            const std::optional<Column> of_symbol = meaning_of_head(symbol);
            return of_symbol ? of_symbol : Column::u;
        }
        // "Uncertainty component u_xx [µm]" (ISO 14253-2): what has a unit is no name.
        if (column == Column::quantity && symbol.front() == 'u' && known_unit(unit_in_head(std::string(head)))) {
            return Column::u;
        }
        if (column) {
            return column;
        }
    }
    return std::nullopt;
}

std::optional<TypedHead> typed_head(std::string_view head) {
    constexpr std::size_t k_longest = 80;
    const std::string lower = text::in_small_letters(head);
    if (head.size() > k_longest || lower.size() != head.size()) {
        return std::nullopt;
    }
    for (const bool is_a : {true, false}) {
        for (const std::string_view word : {"(type ", "(typ ", "(tipo ", "type ", "typ ", "tipo ", "("}) {
            const bool in_brackets = word.starts_with('(');
            const std::string token = std::string(word) + (is_a ? "a" : "b") + (in_brackets ? ")" : "");
            const std::size_t at = lower.find(token), end = at + token.size();
            if (at == std::string::npos ||
                (!in_brackets && end < lower.size() && (is_letter(lower[end]) || lower[end] == '/'))) {
                continue;
            }
            const std::string rest = std::string(head.substr(0, at)) + std::string(head.substr(end));
            std::string_view name = trimmed(rest);
            std::string unit = unit_in_head(rest);
            if (!name.empty() && !meaning_of_head(name) && known_unit(std::string(name))) {  // "Type A (%)"
                unit = unit.empty() ? std::string(name) : unit;
                name = {};
            }
            const std::size_t blank = name.rfind(' ');
            const std::string last(name.substr(blank == std::string_view::npos ? 0 : blank + 1));
            if (unit.empty() && !meaning_of_head(last) && known_unit(last)) {
                unit = last;
                name = trimmed(name.substr(0, name.size() - last.size()));
            }
            name = trimmed(without_brackets(without_unit(name)));
            while (name.ends_with(',') || name.ends_with('-') || name.ends_with('/')) {
                name = trimmed(name.substr(0, name.size() - 1));
            }
            const std::optional<Column> column = name.empty() ? Column::u : column_of(name);
            if (column == Column::u || column == Column::contribution) {
                return TypedHead{.is_a = is_a, .column = *column, .unit = unit};
            }
        }
    }
    return std::nullopt;
}

}  // namespace gumcert::audit
