#include "audit/words/uncertainty_in_words.h"

#include <algorithm>
#include <string>

#include "audit/words/bare_text.h"
#include "audit/words/coverage_words.h"
#include "text/small_letters.h"

namespace gumcert::audit {

std::optional<Statement> uncertainty_in_words(std::string_view name, std::string_view coverage, bool& is_relative) {
    constexpr std::size_t k_longest = 80;
    bool is_standard = false, is_expanded = false, is_total = false, is_noun = false;
    bool is_tail = false, has_tail = false;  // behind "of"
    if (name.size() > k_longest) {
        return std::nullopt;
    }
    for (std::size_t at = 0; at < name.size();) {
        const std::size_t end = std::min(name.find(' ', at), name.size());
        const std::string_view symbol = name.substr(at, end - at);
        const std::string word = text::in_small_letters(symbol);
        at = name.find_first_not_of(' ', end);
        at = at == std::string_view::npos ? name.size() : at;
        if (is_tail) {
            const bool names_result =
                is_one_of(word, {"result", "results", "measurement", "measurand", "output", "ergebnisses",
                                 "messergebnisses", "messung", "messgröße", "messgrösse"});
            has_tail = has_tail || names_result;
            if (!has_tail && !is_one_of(word, {"the", "a", "des", "der", "dem"})) {
                return std::nullopt;
            }
            if (has_tail && !names_result &&
                !is_one_of(symbol, {"u", "U", "u_c", "uc", "u(y)", "U(y)", "u_c(y)", "uc(y)"})) {
                return std::nullopt;
            }
        } else if (is_one_of(word, {"of", "des", "der", "von"}) && is_noun) {
            is_tail = true;
        } else if (is_one_of(word, {"expanded", "extended", "erweiterte"})) {
            is_expanded = true;
        } else if (!is_noun && is_one_of(word, {"relative", "rel.", "relat."})) {
            is_relative = true;
        } else if (is_one_of(word, {"standard", "std", "std."})) {
            is_standard = true;
        } else if (is_one_of(word, {"combined", "overall", "total", "resulting", "final", "kombinierte", "gesamte",
                                    "resultierende"})) {
            is_total = true;
        } else if (is_one_of(word, {"uncertainty", "unsicherheit", "messunsicherheit"})) {
            is_noun = true;
        } else if (is_one_of(word, {"standardunsicherheit", "standardmessunsicherheit"})) {
            is_noun = is_standard = true;
        } else if (is_one_of(word, {"gesamtunsicherheit", "gesamtmessunsicherheit"})) {
            is_noun = is_total = true;
        } else if ((is_noun || is_expanded || is_total) && is_one_of(symbol, {"U", "U(y)", "U95", "U_95", "W"})) {
            is_noun = is_expanded = true;  // "Expanded U"; that of a "Standard U" is the standard
        } else if ((is_noun || is_total) &&
                   is_one_of(symbol, {"u", "u_c", "uc", "u(y)", "u_c(y)", "uc(y)", "w", "w_c", "wc"})) {
            is_noun = is_standard = true;
        } else if (word != "measurement") {
            return std::nullopt;
        }
    }
    const CoverageText said = coverage_in(coverage);
    is_noun = is_noun || (is_total && !said.k.empty());  // "Total (k = 1)": no contribution is called so
    if (!is_noun || (is_tail && !has_tail) || (is_standard && is_expanded)) {
        return std::nullopt;
    }
    if (is_expanded || (!is_standard && is_of_expanded(said))) {
        return Statement::U;
    }
    // "Measurement uncertainty" alone may be that of a certificate, in a row.
    return is_standard || is_total || said.says_any() || has_tail ? std::optional(Statement::u_c) : std::nullopt;
}

}  // namespace gumcert::audit
