#include "audit/words/coverage_words.h"

#include <algorithm>
#include <string>

#include "audit/stated_number.h"
#include "audit/word_line.h"
#include "audit/words/bare_text.h"
#include "audit/words/unit_words.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

/// The number that k is by words that begin at a place: "k = 2", "k(95 %) = 2", "coverage factor of 2".
std::string_view number_of_k(std::string_view text, std::size_t at) {
    if (at > 0 && (is_letter(text[at - 1]) || text[at - 1] == '_')) {
        return {};
    }
    constexpr std::string_view k_words[] = {"k95",
                                            "k_95",
                                            "kp",
                                            "k_p",
                                            "k",
                                            "coverage factor",
                                            "Coverage factor",
                                            "Erweiterungsfaktor",
                                            "erweiterungsfaktor",
                                            "COVERAGE FACTOR",
                                            "ERWEITERUNGSFAKTOR",
                                            "K"};
    for (const std::string_view word : k_words) {
        if (!text.substr(at).starts_with(word)) {
            continue;
        }
        std::string_view behind = text.substr(at + word.size());
        if (word == "K" && !trimmed(behind).starts_with('=')) {
            continue;  // "EXPANDED UNCERTAINTY (K = 2)"; else it is a kelvin
        }
        if (!behind.empty() && (is_letter(behind.front()) || is_of_number(behind.front()) || behind.front() == '_')) {
            continue;
        }
        for (bool any = true; any;) {
            any = false;
            for (const std::string_view filler : {" ", "=", ":", "k ", "k=", "of ", "von ", "is ", "ist "}) {
                if (behind.starts_with(filler)) {
                    behind.remove_prefix(filler == "k=" ? 1 : filler.size());
                    any = true;
                }
            }
        }
        const std::optional<LeadingNumber> number = read_leading_number(behind, "", Percent::unit);
        constexpr double k_largest = 20.0;
        if (number && number->number.value > 0.0 && number->number.value < k_largest &&
            !number->rest.starts_with('%')) {
            return behind;
        }
    }
    return {};
}

}  // namespace

CoverageText coverage_in(std::string_view text) {
    text = cut(text, k_longest_text);
    CoverageText found;
    for (std::size_t at = 0; at < text.size() && found.k.empty(); ++at) {
        found.k = number_of_k(text, at);
    }
    for (std::size_t percent = text.find('%'); percent != std::string_view::npos && !found.p;
         percent = text.find('%', percent + 1)) {
        std::size_t end = percent;
        while (end > 0 && (text[end - 1] == ' ' || text[end - 1] == '\xA0' || text[end - 1] == '\xC2')) {
            --end;
        }
        std::size_t from = end;
        while (from > 0 && is_of_number(text[from - 1])) {
            --from;
        }
        const bool is_number_alone = from == 0 || !is_letter(text[from - 1]);
        const std::optional<StatedNumber> p =
            is_number_alone ? read_number(text.substr(from, end - from), "") : std::nullopt;
        if (p && p->value > 50.0 && p->value < 100.0) {
            found.p = p->value / 100.0;
        }
    }
    if (const std::size_t at = text.find("p =");
        !found.p && at != std::string_view::npos && (at == 0 || !is_letter(text[at - 1]))) {
        const std::optional<LeadingNumber> p = read_leading_number(text.substr(at + 3), "");
        if (p && p->number.value > 0.5 && p->number.value < 1.0) {
            found.p = p->number.value;
        }
    }
    return found;
}

bool begins_with_coverage(std::string_view text) {
    while (!text.empty() &&
           (text.front() == ' ' || text.front() == ',' || text.front() == ';' || text.front() == '(')) {
        text.remove_prefix(1);
    }
    if (text.empty()) {
        return false;
    }
    for (const std::string_view word : {"with ", "mit ", "at ", "for ", "für ", "p = ", "p="}) {
        if (text.starts_with(word)) {
            return coverage_in(text).says_any();
        }
    }
    const bool is_number = text.front() >= '0' && text.front() <= '9';
    return is_number ? coverage_in(text.substr(0, text.find('%') + 1)).p.has_value() : !number_of_k(text, 0).empty();
}

bool is_of_expanded(const CoverageText& coverage) {
    constexpr double k_least_k = 1.6, k_least_p = 0.9;
    const std::optional<LeadingNumber> k =
        coverage.k.empty() ? std::nullopt : read_leading_number(coverage.k, "", Percent::unit);
    return k ? k->number.value >= k_least_k : coverage.p.has_value() && *coverage.p >= k_least_p;
}

bool says_coverage_alone(std::string_view text) {
    constexpr std::string_view k_between = " ()[],;:=\t\n";
    constexpr std::string_view k_words =
        " k p t u w u95 u_95 u_c uc ν_eff nu_eff veff v_eff normal gaussian gauß coverage "
        "factor probability level confidence approx approx. ca. with mit and und for für at bei "
        "in of the des vom value measured measurement reading rdg result measurand indication "
        "messwert messwerts messwertes ergebnis ergebnisses erweiterungsfaktor "
        "überdeckungswahrscheinlichkeit überdeckungsfaktor ";
    for (std::size_t at = text.find_first_not_of(k_between); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(k_between, at), text.size());
        const std::string token(text.substr(at, end - at));
        at = text.find_first_not_of(k_between, end);
        const bool has_letter = std::any_of(
            token.begin(), token.end(), [](char c) { return is_letter(c) || static_cast<unsigned char>(c) >= 0x80U; });
        const bool is_number = token.front() >= '0' && token.front() <= '9';
        if (has_letter && !is_number && !is_unit_of_part(token) && token != "–" && token != "—" && token != "≈" &&
            k_words.find(" " + text::in_small_letters(token) + " ") == k_words.npos) {
            return false;
        }
    }
    return true;
}

std::optional<double> k_of_distribution(std::string_view text) {
    text = cut(text, k_longest_text);
    const CoverageText coverage = coverage_in(text);
    std::string_view k = coverage.k;
    for (const std::string_view sign : {"σ", "sigma", "Sigma"}) {
        std::size_t at = k.empty() ? text.find(sign) : std::string_view::npos;
        while (at != std::string_view::npos && at > 0 && text[at - 1] == ' ') {
            --at;
        }
        if (at != std::string_view::npos && at > 0 && text[at - 1] >= '1' && text[at - 1] <= '3' &&
            (at == 1 || !is_of_number(text[at - 2]))) {
            k = text.substr(at - 1);
        }
    }
    const std::optional<LeadingNumber> number = k.empty() ? std::nullopt : read_leading_number(k, "", Percent::unit);
    return number && number->number.value > 0.0 ? std::optional(number->number.value) : std::nullopt;
}

}  // namespace gumcert::audit
