#include "reports/dcc/dcc_text_types.h"

#include <libxml/uri.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "reports/dcc/xml_document.h"

namespace gumcert::reports {

namespace {

constexpr int k_version_3_2 = 320;  // texts must have words
constexpr int k_version_3_3 = 330;  // numbers may be NaN

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_blank_character(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Takes what is at the beginning of a text away, piece by piece.
class Cursor {
public:
    explicit Cursor(std::string_view text) : rest_(text) {}

    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    bool take(char c) {
        const bool here = !rest_.empty() && rest_.front() == c;
        rest_.remove_prefix(here ? 1 : 0);
        return here;
    }
    /// How many digits stood here.
    std::size_t digits() {
        const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_digit);
        const auto count = static_cast<std::size_t>(end - rest_.begin());
        rest_.remove_prefix(count);
        return count;
    }
    /// A number of two digits up to a largest one.
    bool two_digits(int largest) {
        if (rest_.size() < 2 || !is_digit(rest_[0]) || !is_digit(rest_[1])) {
            return false;
        }
        const int value = 10 * (rest_[0] - '0') + (rest_[1] - '0');
        rest_.remove_prefix(2);
        return value <= largest;
    }
    /// Nothing, Z, or +01:00.
    bool time_zone() {
        if (take('Z') || at_end()) {
            return true;
        }
        constexpr int k_most_hours = 14;
        return (take('+') || take('-')) && two_digits(k_most_hours) && take(':') && two_digits(59);
    }

private:
    std::string_view rest_;
};

bool is_decimal(std::string_view text, bool negative, int version) {
    if (text == "NaN") {
        return version >= k_version_3_3;
    }
    Cursor at(text);
    if (!at.take('+') && negative) {
        at.take('-');
    }
    const std::size_t whole = at.digits();
    const std::size_t fraction = at.take('.') ? at.digits() : 0;
    if (whole + fraction == 0) {
        return false;
    }
    if (at.take('e') || at.take('E')) {
        if (!at.take('+')) {
            at.take('-');
        }
        if (at.digits() == 0) {
            return false;
        }
    }
    return at.at_end();
}

/// Without an exponent, and without a zero in front: 2.0, 14.
bool is_factor(std::string_view text, int version) {
    if (text == "NaN") {
        return version >= k_version_3_3;
    }
    Cursor at(text);
    at.take('+');
    const bool zero = at.take('0');
    if (zero || at.digits() == 0) {
        return false;
    }
    if (at.take('.')) {
        at.digits();
    }
    return at.at_end();
}

bool is_probability(std::string_view text, int version) {
    if (text == "NaN") {
        return version >= k_version_3_3;
    }
    Cursor at(text);
    at.take('+');
    if (at.take('0')) {
        if (at.take('.')) {
            at.digits();
        }
        return at.at_end();
    }
    if (!at.take('1')) {
        return false;
    }
    if (at.take('.')) {
        while (at.take('0')) {
        }
    }
    return at.at_end();
}

bool is_integer(std::string_view text) {
    Cursor at(text);
    if (!at.take('+')) {
        at.take('-');
    }
    return at.digits() > 0 && at.at_end();
}

constexpr std::size_t k_day = 10;  // "2026-11-22"

/// Whether a text begins with a day from the year 1 to 9999.
bool begins_with_day(std::string_view text) {
    const auto number = [&](std::size_t at, std::size_t count) {
        int value = 0;
        const char* const end = text.data() + at + count;
        const auto [stop, failure] = std::from_chars(text.data() + at, end, value);
        return failure == std::errc() && stop == end && value > 0 ? value : 0;
    };
    if (text.size() < k_day || text[4] != '-' || text[7] != '-') {
        return false;
    }
    const std::chrono::year_month_day day{std::chrono::year{number(0, 4)},
                                          std::chrono::month{static_cast<unsigned>(number(5, 2))},
                                          std::chrono::day{static_cast<unsigned>(number(8, 2))}};
    return day.ok() && number(0, 4) > 0;
}

bool is_date(std::string_view text) {
    if (!begins_with_day(text)) {
        return false;
    }
    Cursor at(text.substr(k_day));
    return at.time_zone() && at.at_end();
}

bool is_date_time(std::string_view text) {
    if (!begins_with_day(text)) {
        return false;
    }
    Cursor at(text.substr(k_day));
    if (!at.take('T') || !at.two_digits(24) || !at.take(':') || !at.two_digits(59) || !at.take(':') ||
        !at.two_digits(59)) {
        return false;
    }
    // XML Schema allows 24:00:00 as the end of a day, and no later time of hour 24.
    const bool midnight = text.substr(k_day + 1, 2) != "24" || text.substr(k_day + 1, 8) == "24:00:00";
    const bool fraction = !at.take('.') || at.digits() > 0;
    return midnight && fraction && at.time_zone() && at.at_end();
}

/// P1Y2M3DT4H5M6.7S, every part only where it is there.
bool is_duration(std::string_view text) {
    text.remove_prefix(text.starts_with('-') ? 1 : 0);
    if (!text.starts_with('P')) {
        return false;
    }
    text.remove_prefix(1);
    const std::size_t time = text.find('T');
    const auto parts = [](std::string_view part, std::string_view letters) -> std::optional<std::size_t> {
        std::size_t count = 0;
        while (!part.empty()) {
            const std::size_t end = part.find_first_not_of("0123456789.");
            const std::size_t letter = end == std::string_view::npos ? end : letters.find(part[end]);
            const std::string_view number = part.substr(0, end);
            const bool whole = number.find('.') == std::string_view::npos;
            const bool seconds = letter != std::string_view::npos && letters[letter] == 'S';
            const bool shape = seconds ? is_decimal(number, false, 0) && number.front() != '.' && number.back() != '.'
                                       : whole && !number.empty();
            if (letter == std::string_view::npos || !shape) {
                return std::nullopt;
            }
            letters.remove_prefix(letter + 1);
            part.remove_prefix(end + 1);
            ++count;
        }
        return count;
    };
    const std::optional<std::size_t> days = parts(text.substr(0, std::min(time, text.size())), "YMD");
    if (time == std::string_view::npos) {
        return days && *days > 0;
    }
    const std::optional<std::size_t> hours = parts(text.substr(time + 1), "HMS");
    return days && hours && *hours > 0;
}

bool is_base64(std::string_view text) {
    std::string letters;
    std::copy_if(text.begin(), text.end(), std::back_inserter(letters), [](char c) { return !is_blank_character(c); });
    const std::size_t end = std::min(letters.find('='), letters.size());
    const bool alphabet = std::all_of(letters.begin(), letters.begin() + static_cast<std::ptrdiff_t>(end), [](char c) {
        return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' || c == '/';
    });
    const std::string padding = letters.substr(end);
    return alphabet && letters.size() % 4 == 0 && (padding.empty() || padding == "=" || padding == "==");
}

bool is_uri(std::string_view text) {
    std::string plain(text);
    for (char& c : plain) {  // letters of other languages stand in an address as they are
        const auto code = static_cast<unsigned char>(c);
        if (code < 32 || code >= 127 || std::string_view("<>\"{}|\\^`").find(c) != std::string_view::npos) {
            c = '_';
        }
    }
    const std::unique_ptr<xmlURI, decltype(&xmlFreeURI)> uri(xmlParseURI(plain.c_str()), &xmlFreeURI);
    return plain.empty() || uri != nullptr;
}

/// A name of XML without a colon: it begins with a letter.
bool is_name(std::string_view text) {
    const auto begins = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 128;
    };
    return !text.empty() && begins(text.front()) && std::all_of(text.begin(), text.end(), [&](char c) {
        return begins(c) || is_digit(c) || c == '-' || c == '.';
    });
}

bool is_names(std::string_view text) {
    const std::vector<std::string> words = xml_list(text);
    return !words.empty() && std::all_of(words.begin(), words.end(), is_name);
}

bool is_code(std::string_view text, char first, char last) {
    return text.size() == 2 && std::all_of(text.begin(), text.end(), [&](char c) { return c >= first && c <= last; });
}

bool is_word(std::string_view text, int version) {
    return version < k_version_3_2 ||
           (!text.empty() && !is_blank_character(text.front()) && !is_blank_character(text.back()));
}

struct TextType {
    std::string_view name;
    bool as_it_stands;  ///< blanks at the ends count
    bool (*is)(std::string_view text, int version);
    std::string_view rule;
};

constexpr std::array k_types{
    TextType{"word", true, is_word, "a text that neither is empty nor begins or ends with a blank"},
    TextType{"country", true, [](std::string_view t, int) { return is_code(t, 'A', 'Z'); },
             "a code of ISO 3166-1, two capital letters"},
    TextType{"language", true, [](std::string_view t, int) { return is_code(t, 'a', 'z'); },
             "a code of ISO 639-1, two small letters"},
    TextType{"date", false, [](std::string_view t, int) { return is_date(t); }, "a date such as 2026-11-22"},
    TextType{"dateTime", false, [](std::string_view t, int) { return is_date_time(t); },
             "a time such as 2026-11-22T12:00:00Z"},
    TextType{"duration", false, [](std::string_view t, int) { return is_duration(t); }, "a duration such as P1Y"},
    TextType{"boolean", false,
             [](std::string_view t, int) { return t == "true" || t == "false" || t == "0" || t == "1"; },
             "true or false"},
    TextType{"uri", false, [](std::string_view t, int) { return is_uri(t); }, "an address (URI)"},
    TextType{"base64", false, [](std::string_view t, int) { return is_base64(t); }, "bytes in base64"},
    TextType{"integer", false, [](std::string_view t, int) { return is_integer(t); }, "a whole number"},
    TextType{"decimal", false, [](std::string_view t, int v) { return is_decimal(t, true, v); }, "a decimal number"},
    TextType{"positive", false, [](std::string_view t, int v) { return is_decimal(t, false, v); },
             "a decimal number that is not negative"},
    TextType{"factor", false, is_factor, "a coverage factor of at least 1, without an exponent"},
    TextType{"probability", false, is_probability, "a probability from 0 to 1, without an exponent"},
    TextType{"name", false, [](std::string_view t, int) { return is_name(t); }, "a name that begins with a letter"},
    TextType{"names", false, [](std::string_view t, int) { return is_names(t); },
             "one or several names that begin with a letter"},
    TextType{"references", false, [](std::string_view t, int) { return !xml_list(t).empty(); }, "at least one word"},
};

}  // namespace

std::string text_fault(std::string_view type, std::string_view text, int version) {
    const auto found = std::find_if(k_types.begin(), k_types.end(), [&](const TextType& t) { return t.name == type; });
    if (found == k_types.end()) {
        return "";
    }
    const std::string inner = without_outer_blanks(text);
    return found->is(found->as_it_stands ? text : std::string_view(inner), version) ? "" : std::string(found->rule);
}

}  // namespace gumcert::reports
