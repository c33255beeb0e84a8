#include "audit/words/sum_names.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "audit/word_line.h"
#include "audit/words/bare_text.h"
#include "audit/words/coverage_words.h"
#include "text/small_letters.h"

namespace gumcert::audit {

SumName sum_name(std::string_view name) {
    constexpr std::size_t k_longest = 80;
    if (name.size() > k_longest) {
        return SumName::none;
    }
    const std::string lower = text::in_small_letters(name);
    for (const std::string_view part :
         {"subtotal", "sub-total", "sub total", "subsum", "intermediate sum", "partial sum", "partial total",
          "zwischensumme", "teilsumme", "zwischenergebnis", "suma parcial", "小計", "小计"}) {
        if (lower.find(part) != std::string::npos) {
            return SumName::part;
        }
    }
    bool has_sum = false, has_type = false, has_letter = false, has_others = false, has_squares = false,
         has_root = false, has_variance = false, has_square = false, is_of_type = false;
    std::string_view last;
    for (std::size_t at = 0; at < lower.size();) {
        const std::size_t end = std::min(lower.find_first_of(" :,;()/-", at), lower.size());
        const std::string_view word = std::string_view(lower).substr(at, end - at);
        at = end + 1;
        last = word.empty() ? last : word;
        if (is_one_of(word, {"sum", "summation", "summe", "suma", "total", "gesamt", "insgesamt", "combined",
                             "kombiniert", "rss", "intermediate", "合計", "合计"})) {
            has_sum = true;
        } else if (is_one_of(word, {"u_a", "u_b", "ua", "ub"})) {
            is_of_type = true;
        } else if (is_one_of(word, {"type", "typ", "tipo"})) {
            has_type = true;
        } else if (is_one_of(word, {"a", "b"})) {
            has_letter = true;
        } else if (is_one_of(word, {"squares", "quadrate", "cuadrados"})) {
            has_squares = true;
        } else if (word == "quadratsumme") {
            has_squares = has_sum = true;
        } else if (is_one_of(word, {"root", "wurzel", "raíz"})) {
            has_root = true;
        } else if (is_one_of(word, {"variance", "variances", "varianz", "varianzen"})) {
            has_variance = true;
        } else if (is_one_of(word, {"u²", "u_c²", "uc²", "u_c^2", "uc^2", "u^2"})) {
            has_square = true;
        } else if (!word.empty() && !is_one_of(word, {"uncertainty",
                                                      "uncertainties",
                                                      "unsicherheit",
                                                      "unsicherheiten",
                                                      "standardunsicherheit",
                                                      "messunsicherheit",
                                                      "incertidumbre",
                                                      "standard",
                                                      "contribution",
                                                      "contributions",
                                                      "component",
                                                      "components",
                                                      "beiträge",
                                                      "of",
                                                      "the",
                                                      "all",
                                                      "der",
                                                      "des",
                                                      "von",
                                                      "aller",
                                                      "de",
                                                      "evaluation",
                                                      "evaluations",
                                                      "result",
                                                      "kombinierte",
                                                      "u"})) {
            has_others = true;
        }
    }
    // "Variance of the standard" may be a contribution.
    const bool is_of_one = !has_sum && is_one_of(last, {"standard", "contribution", "component"});
    if (!has_others && !has_root && ((has_sum && has_squares) || has_square || (has_variance && !is_of_one))) {
        return SumName::of_squares;
    }
    if (has_others) {
        return has_sum ? SumName::of_quantity : SumName::none;
    }
    if (is_of_type || ((has_sum || has_type) && has_letter)) {
        return SumName::of_type;
    }
    return has_sum ? SumName::whole : SumName::none;
}

bool is_called_part(std::string_view name) {
    constexpr std::size_t k_longest = 20;  // bytes of the words that say so
    const std::string lower = text::in_small_letters(cut(trimmed(name), k_longest));
    constexpr std::string_view k_words[] = {"of which ",  "of which:", "thereof ",       "thereof:", "davon ",
                                            "davon:",     "darin ",    "darunter ",      "hiervon ", "incl. ",
                                            "including ", "de ello ",  "de los cuales ", "其中"};
    return std::any_of(std::begin(k_words), std::end(k_words),
                       [&lower](std::string_view word) { return lower.starts_with(word); });
}

bool are_u_and_U(std::string_view u_c, std::string_view U) {
    u_c = trimmed(u_c);
    U = trimmed(U);
    if (!u_c.starts_with('u') || !U.starts_with('U')) {
        return false;
    }
    const std::string_view of_u = u_c.substr(1);
    std::string_view of_U = U.substr(1);
    if (of_u.empty() || std::string_view("(_ ").find(of_u.front()) == std::string_view::npos ||
        !of_U.starts_with(of_u)) {
        return false;
    }
    of_U.remove_prefix(of_u.size());
    return trimmed(of_U).empty() || begins_with_coverage(of_U);
}

}  // namespace gumcert::audit
