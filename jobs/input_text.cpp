#include "jobs/input_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "jobs/file_source.h"
#include "text/angle_text.h"
#include "text/edit_distance.h"
#include "text/numbers.h"
#include "text/place.h"
#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
    return static_cast<unsigned char>(text[i]);
}

}  // namespace

std::optional<std::string_view> check_text(std::string_view bytes, ProblemList& problems) {
    const std::string& file = problems.file();
    const std::string save_as = "save the file as UTF-8 text";
    if (bytes.size() > k_file_limit) {
        problems.refuse(k_file_too_large, text::visible(file), "the file is larger than 64 MiB",
                        "a file may have at most 67108864 bytes",
                        "split the data, or leave out what the job does not need");
        return std::nullopt;
    }
    const auto begins = [&](std::string_view mark) { return bytes.substr(0, mark.size()) == mark; };
    using namespace std::string_view_literals;
    const bool zero_in_pair = bytes.size() >= 2 && ((bytes[0] == '\0') != (bytes[1] == '\0'));
    if (begins("\xFF\xFE"sv) || begins("\xFE\xFF"sv) || begins("\0\0\xFE\xFF"sv) || zero_in_pair) {
        problems.refuse(k_utf16, text::where_in_text(file, {}), "the file is UTF-16 or UTF-32 text (byte offset 0)",
                        "only UTF-8 is read", save_as);
        return std::nullopt;
    }
    const std::size_t skipped = begins("\xEF\xBB\xBF"sv) ? 3 : 0;
    const std::string_view text = bytes.substr(skipped);
    text::PlaceFinder finder(text);
    for (std::size_t i = 0; i < text.size();) {
        const unsigned c = byte_at(text, i);
        if (c == 0) {
            problems.refuse(k_nul_character, text::where_in_text(file, finder.at(i)),
                            "a NUL character (byte offset " + std::to_string(i + skipped) + ")",
                            "a text has no NUL characters", "check that the file is not damaged, and " + save_as);
            return std::nullopt;
        }
        if (c == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) {
            problems.refuse(k_lone_carriage_return, text::where_in_text(file, finder.at(i)),
                            "a carriage return without a line feed (byte offset " + std::to_string(i + skipped) + ")",
                            "lines end in LF or CRLF", "save the file with Unix or Windows line ends");
            return std::nullopt;
        }
        const std::size_t size = text::decode_utf8(text, i).bytes;
        if (size == 0) {
            problems.refuse(k_not_utf8, text::where_in_text(file, finder.at(i)),
                            "byte 0x" + text::hexadecimal(c, 2) + " at byte offset " + std::to_string(i + skipped) +
                                " is not UTF-8",
                            "only UTF-8 is read", save_as + " (it seems to be in another encoding, or is damaged)");
            return std::nullopt;
        }
        i += size;
    }
    return text;
}

std::optional<std::string> name_objection(std::string_view name, std::size_t longest) {
    if (name.empty()) {
        return "is empty";
    }
    if (name.size() > longest) {
        return "has " + std::to_string(name.size()) + " bytes";
    }
    char32_t last = 0;
    for (std::size_t i = 0; i < name.size();) {
        const text::Character character = text::decode_utf8(name, i);
        if (character.bytes == 0) {
            return "is not UTF-8";
        }
        if (text::is_hidden(character.code) && !text::is_joiner(character.code)) {
            return "has the hidden or control character U+" + text::hexadecimal(character.code);
        }
        if (i == 0 && text::is_blank(character.code)) {
            return "begins with a space";
        }
        last = character.code;
        i += character.bytes;
    }
    if (text::is_blank(last)) {
        return "ends with a space";
    }
    return std::nullopt;
}

std::string advice_for_number(std::string_view text) {
    if (text.find(':') != std::string_view::npos) {
        return "write the number of the unit, or an angle in arcsec or arcmin as 12\u00B0 30\u2032 05.0\u2033";
    }
    if (!text::has_angle_sign(text)) {
        return "write the number without quotes";
    }
    const auto seconds = text::decimal_of_angle(text, text::AnglePart::seconds);
    return "write the number of the unit, without signs of degrees, minutes or seconds" +
           (seconds ? ": it is " + text::without_trailing_zeros(*seconds) + " in arcsec" : "");
}

std::optional<std::string_view> nearest_word(std::string_view word, std::span<const std::string_view> known) {
    if (word.size() > 64) {
        return std::nullopt;
    }
    std::optional<std::string_view> nearest;
    std::size_t least = 0;
    for (const std::string_view candidate : known) {
        const std::size_t distance = text::edit_distance(word, candidate);
        // Two letters in five may differ: a unit that was left out ("u_constant") must still find its key.
        if (5 * distance <= 2 * std::max(word.size(), candidate.size()) && (!nearest || distance < least)) {
            nearest = candidate;
            least = distance;
        }
    }
    return nearest;
}

bool NumberRange::contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string NumberRange::with_unit(double value) const {
    return unit.empty() ? text::shortest_plain(value) : text::shortest_plain(value) + " " + std::string{unit};
}

std::string NumberRange::rule() const {
    const bool has_low = low != -std::numeric_limits<double>::max();
    const bool has_high = high != std::numeric_limits<double>::max();
    std::string text = "must be finite";
    if (has_low) {
        text = (low_open ? "must be greater than " : "must be at least ") + with_unit(low);
    }
    if (has_high) {
        text += has_low ? " and " : "; must be ";
        text += (high_open ? "less than " : "at most ") + with_unit(high);
    }
    return text;
}

std::string NumberRange::action() const {
    return hint.empty() ? "correct the value, and check its unit" : std::string{hint};
}

}  // namespace gumcert::jobs
