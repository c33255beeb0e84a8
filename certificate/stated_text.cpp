#include "certificate/stated_text.h"

#include <algorithm>
#include <cstddef>
#include <set>

#include "certificate/placeholder_text.h"
#include "certificate/text_words.h"

namespace gumcert::certificate {

namespace {

/// Letters of a text, an ideograph counted as often as a word of it would need letters.
std::size_t weight(const std::u32string& letters) {
    constexpr std::size_t k_letters_of_an_ideograph = 3;
    std::size_t sum = 0;
    for (const char32_t c : letters) {
        sum += is_digit(c) ? 0 : is_ideograph(c) ? k_letters_of_an_ideograph : 1;
    }
    return sum;
}

bool is_web_address(const std::string& text) {
    return text.find("://") != std::string::npos || text.starts_with("www.");
}

/// "123456", "987654": one digit after the other, six or more.
bool is_run_of_digits(const std::u32string& letters) {
    constexpr std::size_t k_least = 6;
    bool rising = letters.size() >= k_least;
    bool falling = rising;
    for (std::size_t i = 0; i < letters.size(); ++i) {
        const bool digit = is_digit(letters[i]);
        const bool first = i == 0;
        rising = rising && digit && (first || (letters[i] - U'0') == (letters[i - 1] - U'0' + 1U) % 10U);
        falling = falling && digit && (first || (letters[i] - U'0' + 1U) % 10U == (letters[i - 1] - U'0'));
    }
    return rising || falling;
}

/// Countries whose name has several words; of one word none needs a list.
bool is_country_of_several_words(const std::u32string& letters) {
    static const std::set<std::u32string> k_countries = {U"unitedstatesofamerica",
                                                         U"unitedstates",
                                                         U"unitedkingdom",
                                                         U"greatbritain",
                                                         U"czechrepublic",
                                                         U"southkorea",
                                                         U"northkorea",
                                                         U"newzealand",
                                                         U"saudiarabia",
                                                         U"southafrica",
                                                         U"costarica",
                                                         U"elsalvador",
                                                         U"srilanka",
                                                         U"puertorico",
                                                         U"sanmarino",
                                                         U"dominicanrepublic",
                                                         U"unitedarabemirates",
                                                         U"europeanunion",
                                                         U"peoplesrepublicofchina",
                                                         U"republicofchina",
                                                         U"republicofkorea",
                                                         U"federalrepublicofgermany",
                                                         U"vereinigtestaaten",
                                                         U"vereinigteskonigreich",
                                                         U"bundesrepublikdeutschland",
                                                         U"estadosunidos",
                                                         U"reinounido",
                                                         U"hongkong",
                                                         U"thenetherlands"};
    return k_countries.contains(letters);
}

template <bool (*Is)(const std::string&)>
bool in_every_language(const LocalisedText& text) {
    return !text.empty() && (text.plain.empty() || Is(text.plain)) &&
           std::all_of(text.by_language.begin(), text.by_language.end(),
                       [](const auto& entry) { return Is(entry.second); });
}

}  // namespace

bool is_stated(const std::string& text) {
    return !is_placeholder(text);
}

bool is_stated(const LocalisedText& text) {
    return in_every_language<is_stated>(text);
}

bool states_a_reason(const std::string& text) {
    static const std::set<std::u32string> k_nothing{
        U"na",     U"ka",      U"sd",   U"none", U"nil",    U"null",   U"nothing", U"keine", U"keiner",
        U"nichts", U"ninguno", U"nada", U"tbd",  U"tba",    U"tbc",    U"todo",    U"asdf",  U"asdfgh",
        U"qwerty", U"qwertz",  U"無",   U"无",   U"不適用", U"不适用", U"待定",    U"未定"};
    const std::u32string letters = letters_of(text);
    const bool has_letter = !std::all_of(letters.begin(), letters.end(), is_digit);
    const bool is_one_again =
        letters.find_first_not_of(letters.empty() ? U'0' : letters.front()) == std::u32string::npos;
    const bool is_ideograph_alone = letters.size() == 1 && is_ideograph(letters.front());
    return has_letter && (!is_one_again || is_ideograph_alone) && !k_nothing.contains(letters);
}

bool states_a_reason(const LocalisedText& text) {
    return in_every_language<states_a_reason>(text);
}

bool is_name(const std::string& text) {
    const std::u32string letters = letters_of(text);
    const bool long_enough = letters.size() > 1 || (!letters.empty() && is_ideograph(letters.front()));
    return !names_only_a_field(text) && !names_nobody(text) && !is_email(text) && !is_web_address(text) &&
           long_enough && weight(letters) > 0;
}

bool is_name_of_document(const std::string& text) {
    if (is_name(text)) {
        return true;
    }
    constexpr std::size_t k_least_digits = 2;
    const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
    const auto is_figure = [](char c) { return c >= '0' && c <= '9'; };
    const std::size_t letters =
        static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_capital) - text.begin());
    const std::size_t number = text.find_first_not_of(" -", letters);
    if (letters < 2 || number == std::string::npos || number == letters) {
        return false;
    }
    const auto behind = std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(number), text.end(), is_figure);
    const auto digits = static_cast<std::size_t>(behind - text.begin()) - number;
    // "NO 12" and "ID 12" name a field, "TBD 12" nothing.
    return digits >= k_least_digits && is_particle(text.substr(0, letters));
}

bool is_name(const LocalisedText& text) {
    return in_every_language<is_name>(text);
}

bool is_same_name(const std::string& a, const std::string& b) {
    return is_stated(a) && is_stated(b) && letters_of(a) == letters_of(b);
}

bool is_identification(const std::string& text) {
    constexpr std::size_t k_least_repeated = 4;
    const std::u32string letters = letters_of(text);
    const bool zeros = letters.find_first_not_of(U'0') == std::u32string::npos;
    const bool repeated =
        letters.size() >= k_least_repeated && letters.find_first_not_of(letters.front()) == std::u32string::npos;
    return !names_only_a_field(text) && !zeros && !repeated && !is_run_of_digits(letters) && !is_email(text) &&
           !is_still_to_come(text) && !has_empty_parts_only(text);
}

bool is_document_number(const std::string& text) {
    return is_identification(text) && !is_of_a_draft(text);
}

bool is_method_identification(const std::string& text) {
    return is_identification(text) && !describes_the_usual(text);
}

bool is_statement(const std::string& text) {
    constexpr std::size_t k_least_weight = 12;
    constexpr std::size_t k_least_different = 4;
    constexpr std::size_t k_least_telling = 2;
    const std::u32string letters = letters_of(text);
    const std::set<char32_t> different(letters.begin(), letters.end());
    const bool without_spaces = std::any_of(letters.begin(), letters.end(), is_ideograph);
    // Chinese and Japanese set no spaces between words.
    const bool several_words = words_of(text).size() > 1 || std::all_of(letters.begin(), letters.end(), is_ideograph);
    return is_stated(text) && several_words && !is_consent_of_nobody(text) && weight(letters) >= k_least_weight &&
           different.size() >= k_least_different &&
           (without_spaces || telling_words(text) >= k_least_telling || is_sentence_of_fields(text));
}

bool is_statement(const LocalisedText& text) {
    return in_every_language<is_statement>(text);
}

bool is_email(const std::string& text) {
    const std::size_t at = text.find('@');
    return at != std::string::npos && at > 0 && text.find('@', at + 1) == std::string::npos &&
           text.find(' ') == std::string::npos && text.find('.', at + 2) != std::string::npos && text.back() != '.';
}

bool is_postal_address(const std::vector<std::string>& lines) {
    constexpr std::size_t k_least_weight = 6;
    constexpr std::size_t k_least_weight_of_ideographs = 15;  // five of them: more than the name of a country
    constexpr std::size_t k_least_words_without_number = 5;
    std::size_t words = 0;
    std::u32string letters;
    for (const std::string& line : lines) {
        if (!names_nobody(line) && !is_email(line) && !is_web_address(line)) {
            words += words_of(line).size();
            letters += letters_of(line);
        }
    }
    const bool without_spaces = std::any_of(letters.begin(), letters.end(), is_ideograph);
    const bool numbered = std::any_of(letters.begin(), letters.end(), is_digit) ||
                          letters.find_first_of(U"路街號号巷道段村里一二三四五六七八九十") != std::u32string::npos;
    return (words > 1 || without_spaces) &&
           weight(letters) >= (without_spaces ? k_least_weight_of_ideographs : k_least_weight) &&
           (numbered || (!without_spaces && words >= k_least_words_without_number)) &&
           !is_country_of_several_words(letters);
}

}  // namespace gumcert::certificate
