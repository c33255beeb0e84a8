#include "audit/row_facts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>

#include "audit/stated_number.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

constexpr std::size_t k_longest_fact = 400;
constexpr std::size_t k_nearby = 40;  ///< bytes between a word and its number

bool is_number_start(std::string_view text, std::size_t at) {
    const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    return digit(at) || ((text[at] == '-' || text[at] == '+') && digit(at + 1));
}

/// A number within a text, and where it ends.
struct NumberInText {
    double value = 0.0;
    bool percent = false;
    std::string_view behind = {};  ///< without spaces at its beginning
    std::size_t from = 0;
};

/// The first number at or after a place, no further than `within` bytes away.
std::optional<NumberInText> next_number(const AuditedRow& row, std::string_view text, std::size_t from,
                                        std::size_t within) {
    const std::size_t end = std::min(text.size(), from + std::min(within, text.size()));
    for (std::size_t at = from; at < end; ++at) {
        // The digit of "pt100" or "x_1" is part of a name.
        const bool inside_word = at > 0 && ((text[at - 1] >= 'a' && text[at - 1] <= 'z') || text[at - 1] == '_');
        if (!is_number_start(text, at) || (inside_word && text[at] >= '0' && text[at] <= '9')) {
            continue;
        }
        const std::optional<LeadingNumber> number =
            read_leading_number(text.substr(at), "", Percent::hundredth, row.decimal_sign);
        if (!number || number->is_open || !std::isfinite(number->number.value)) {
            continue;
        }
        NumberInText found{.value = number->number.value, .from = at};
        // What follows starts where the rest of the reader's answer stands in the text.
        const std::size_t rest = number->rest.empty() ? std::string_view::npos : text.find(number->rest, at);
        found.behind = rest == std::string_view::npos ? std::string_view() : text.substr(rest);
        const std::size_t length = text.size() - at - found.behind.size();
        found.percent = text.substr(at, length).find('%') != std::string_view::npos;
        return found;
    }
    return std::nullopt;
}

/// Where the first of some words ends; npos where none stands there.
std::size_t after_word(std::string_view text, std::initializer_list<std::string_view> words) {
    std::size_t first = std::string_view::npos, end = std::string_view::npos;
    for (const std::string_view word : words) {
        const std::size_t at = text.find(word);
        if (at < first) {
            first = at;
            end = at + word.size();
        }
    }
    return end;
}
bool has_word(std::string_view text, std::initializer_list<std::string_view> words) {
    return after_word(text, words) != std::string_view::npos;
}

/// Whether a number has the unit of the row, or none that one could see.
bool is_in_unit(std::string_view behind, const std::string& unit) {
    const std::string small = text::in_small_letters(unit);
    return behind.empty() || (!small.empty() && behind.starts_with(small)) ||
           std::string_view(",;).:").find(behind.front()) != std::string_view::npos || small.empty();
}

/// Signs of typesetting as the number reader hands them back, so that its rest is found in the text.
std::string plain(std::string text) {
    constexpr std::pair<std::string_view, std::string_view> k_signs[] = {
        {"\u2212", "-"}, {"\u00A0", " "},      {"\u2009", " "},      {"\u202F", " "},
        {"\t", " "},     {"\u00B7", "\u00D7"}, {"\u22C5", "\u00D7"}, {"\u2019", "'"}};
    for (const auto& [sign, instead] : k_signs) {
        for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign, at + instead.size())) {
            text.replace(at, sign.size(), instead);
        }
    }
    return text;
}

void read_relative(std::string_view text, AuditedRow& row) {
    for (std::size_t at = 0; at < text.size() && row.relative_to == RelativeTo::not_stated;) {
        const std::optional<NumberInText> number = next_number(row, text, at, text.size());
        if (!number) {
            return;
        }
        const std::string_view base = number->behind.substr(0, 16);
        if (number->percent) {
            if (has_word(base, {"full scale", "of fs", "f.s", "v.e", "v. e", "of range", "vom endwert"}) ||
                base.starts_with("fs")) {
                row.relative_to = RelativeTo::full_scale;
            } else if (has_word(base, {"reading", "rdg", "v.m", "v. m", "vom messwert", "of value"})) {
                row.relative_to = RelativeTo::reading;
            }
            if (row.relative_to != RelativeTo::not_stated) {
                row.relative_uncertainty = std::abs(number->value);
            }
        }
        at = std::max(number->from + 1, text.size() - number->behind.size());
    }
}

void read_full_scale(std::string_view text, AuditedRow& row) {
    const std::size_t end = after_word(text, {"fs =", "fs=", "full scale =", "full scale:", "full scale is",
                                              "endwert =", "endwert:", "messbereichsendwert"});
    if (end == std::string_view::npos || row.full_scale) {
        return;
    }
    const std::optional<NumberInText> number = next_number(row, text, end, 4);
    if (number && !number->percent && is_in_unit(number->behind, row.unit)) {
        row.full_scale = number->value;
    }
}

void read_certificate_points(std::string_view text, AuditedRow& row) {
    const std::size_t end = after_word(
        text, {"calibrated at ", "calibrated from ", "kalibriert bei ", "kalibriert von ", "certificate at "});
    if (end == std::string_view::npos || row.certificate_low) {
        return;
    }
    const std::optional<NumberInText> first = next_number(row, text, end, 3);
    if (!first || first->percent) {
        return;
    }
    const std::size_t to = after_word(first->behind.substr(0, 16), {"to ", "bis ", "..", "…"});
    if (to != std::string_view::npos) {
        const std::size_t at = text.size() - first->behind.size() + to;
        const std::optional<NumberInText> second = next_number(row, text, at, 4);
        if (second && !second->percent && is_in_unit(second->behind, row.unit)) {
            row.certificate_low = std::min(first->value, second->value);
            row.certificate_high = std::max(first->value, second->value);
        }
    } else if (is_in_unit(first->behind, row.unit)) {
        row.certificate_low = row.certificate_high = first->value;
    }
}

void read_asymmetric_limits(std::string_view text, AuditedRow& row) {
    for (std::size_t at = 0; at < text.size() && !row.lower_limit;) {
        const std::optional<NumberInText> first = next_number(row, text, at, text.size());
        if (!first) {
            return;
        }
        const char sign = text[first->from];
        if ((sign == '+' || sign == '-') && first->behind.starts_with('/')) {
            const std::optional<NumberInText> second =
                next_number(row, text, text.size() - first->behind.size() + 1, 2);
            // Only of two signs: "+0.3/+0.5" are two values and no limits about an estimate.
            if (second && first->value * second->value < 0.0 && is_in_unit(second->behind, row.unit)) {
                row.lower_limit = std::min(first->value, second->value);
                row.upper_limit = std::max(first->value, second->value);
            }
        }
        at = std::max(first->from + 1, text.size() - first->behind.size());
    }
}

void read_reliability(std::string_view text, AuditedRow& row) {
    const std::size_t end = after_word(text, {"reliab", "zuverl"});
    if (end == std::string_view::npos || row.reliability) {
        return;
    }
    std::optional<NumberInText> number = next_number(row, text, end, k_nearby);
    if (!number || !number->percent) {  // "auf 25 % zuverlässig"
        number = next_number(row, text, end - std::min<std::size_t>(end, 24), 24);
    }
    if (number && number->percent && number->value > 0.0 && number->value < 1.0) {
        row.reliability = number->value;
    }
}

void read_correction(std::string_view text, AuditedRow& row) {
    const std::size_t end = after_word(text, {"correction", "korrektion", "korrektur"});
    if (end == std::string_view::npos || row.unapplied_correction ||
        !has_word(text, {"not applied", "nicht angebracht", "nicht ber", "not corrected", "nicht korrigiert"})) {
        return;
    }
    const std::optional<NumberInText> number = next_number(row, text, end, k_nearby);
    if (number && !number->percent) {
        row.unapplied_correction = number->value;
    }
}

void read_averaged(std::string_view text, AuditedRow& row) {
    const std::size_t end = after_word(text, {"mean of ", "average of ", "mittel aus ", "mittelwert aus "});
    // "10 Einzelmessungen" and "s of single readings" are several.
    const bool are_several =
        has_word(text, {"single readings", "single measurements", "einzelmessungen", "einzelablesungen"});
    if (end == std::string_view::npos && !row.averaged && !are_several &&
        has_word(text, {"single reading", "single measurement", "one reading", "einzelmessung", "einzelablesung"})) {
        row.averaged = 1;
    }
    if (end == std::string_view::npos || row.averaged) {
        return;
    }
    const std::optional<NumberInText> number = next_number(row, text, end, 1);
    constexpr double k_most = 1e6;
    if (number && number->value >= 1.0 && number->value <= k_most && number->value == std::floor(number->value)) {
        row.averaged = static_cast<std::size_t>(number->value);
    }
}

std::optional<std::size_t> whole_number(const std::optional<NumberInText>& number) {
    constexpr double k_most = 1000.0;
    const bool is_whole = number && !number->percent && number->value >= 2.0 && number->value <= k_most &&
                          number->value == std::floor(number->value);
    return is_whole ? std::optional(static_cast<std::size_t>(number->value)) : std::nullopt;
}

/// Several series of n readings each: "largest s of 9 points, n = 3", "spread of the daily s 0.10, 0.12, 0.09; n = 10".
void read_series(std::string_view text, AuditedRow& row) {
    if (!row.group_sizes.empty() || !row.n || *row.n < 2) {
        return;
    }
    const std::size_t largest = after_word(
        text, {"largest s of ", "largest of ", "maximum of ", "größte s von ", "größtes s von ", "größte von "});
    if (largest != std::string_view::npos) {
        row.group_sizes.assign(whole_number(next_number(row, text, largest, 1)).value_or(0), *row.n);
        return;
    }
    const std::size_t list = after_word(text, {"daily s ", "s of the series ", "s of the days ", "tägliche s ",
                                               "täglichen s ", "s der serien ", "s der tage "});
    if (list == std::string_view::npos) {
        return;
    }
    for (std::optional<NumberInText> number = next_number(row, text, list, 1); number && number->value > 0.0;) {
        row.group_deviations.push_back(number->value);
        const std::size_t end = text.size() - number->behind.size();
        number = number->behind.starts_with(',') ? next_number(row, text, end + 1, 2) : std::nullopt;
    }
    row.group_sizes.assign(row.group_deviations.size(), *row.n);
}

/// "0.4 + 1.176E-7 L": a number, a plus sign, a number, and the letter of the length. Such a specification has a value at a
/// length only, so that no number of the text is the value itself; where u was not divided, u is it.
void read_length_dependent_limit(const std::string& text, AuditedRow& row) {
    const std::size_t plus = text.find(" + ");
    if (row.limit_constant || plus == std::string::npos) {
        return;
    }
    const std::size_t separator = text.find_last_of(" :=(", plus == 0 ? 0 : plus - 1);
    const std::size_t begin = separator == std::string::npos ? 0 : separator + 1;
    const std::optional<StatedNumber> constant = read_number(text.substr(begin, plus - begin), "", row.decimal_sign);
    const std::optional<LeadingNumber> slope =
        read_leading_number(text.substr(plus + 3), "", Percent::hundredth, row.decimal_sign);
    if (!constant || !slope || slope->is_open || slope->rest.empty()) {
        return;
    }
    std::string_view rest = slope->rest;
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == '*')) {
        rest.remove_prefix(1);
    }
    const bool is_length = !rest.empty() && rest.front() == 'l' &&
                           (rest.size() == 1 || rest[1] == ' ' || rest[1] == ',' || rest[1] == ')');
    if (!is_length || !has_word(text, {"mpe", "maximum permissible", "cmm", "kmg", "fehlergrenze"})) {
        return;
    }
    row.limit_constant = constant->value;
    row.limit_per_length = slope->number.value;
    row.origin = Origin::specification;
    const bool undivided = !row.divisor && !row.stated && row.used_u >= constant->value;
    row.origin_value = undivided ? std::optional(row.used_u) : std::nullopt;
}

}  // namespace

void note_row_facts(AuditedRow& row) {
    for (const std::string* said : {&row.comment, &row.source, &row.quantity}) {
        if (said->empty() || said->size() > k_longest_fact) {
            continue;
        }
        const std::string text = text::in_small_letters(plain(*said));
        read_relative(text, row);
        read_full_scale(text, row);
        read_certificate_points(text, row);
        read_asymmetric_limits(text, row);
        read_reliability(text, row);
        read_correction(text, row);
        read_averaged(text, row);
        read_series(text, row);
        read_length_dependent_limit(text, row);
        row.cyclic = row.cyclic || has_word(text, {"cyclic", "cycling", "sinusoidal", "zyklisch", "two-point control",
                                                   "zweipunktreg", "sinusf"});
    }
}

}  // namespace gumcert::audit
