#include "signing/time_texts.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <stdexcept>

namespace gumcert::signing {

namespace {

std::string digits(std::int64_t number, std::size_t width) {
    std::string text = std::to_string(number);
    return text.size() < width ? std::string(width - text.size(), '0') + text : text;
}

struct CivilTime {
    std::chrono::year_month_day date;
    std::chrono::hh_mm_ss<std::chrono::seconds> time;
};

CivilTime civil(std::int64_t time) {
    const std::chrono::sys_seconds instant{std::chrono::seconds(time)};
    const std::chrono::sys_days day = std::chrono::floor<std::chrono::days>(instant);
    return {.date = day, .time = std::chrono::hh_mm_ss<std::chrono::seconds>(instant - day)};
}

/// Takes `count` digits from the front.
std::optional<int> take_number(std::string_view& text, std::size_t count) {
    int number = 0;
    if (text.size() < count) {
        return std::nullopt;
    }
    const auto [end, failure] = std::from_chars(text.data(), text.data() + count, number);
    if (failure != std::errc() || end != text.data() + count || number < 0 || text[0] == '-') {
        return std::nullopt;
    }
    text.remove_prefix(count);
    return number;
}

void take(std::string_view& text, char expected) {
    if (!text.empty() && text.front() == expected) {
        text.remove_prefix(1);
    }
}

/// "", "Z", "+02:00", "+02'00'", "-05'00": seconds to subtract, none if it is something else.
std::optional<std::int64_t> zone_offset(std::string_view text) {
    if (text.empty() || text == "Z") {
        return 0;
    }
    const char sign = text.front();
    if (sign == 'Z') {  // PDF writes Z00'00' now and then
        return 0;
    }
    if (sign != '+' && sign != '-') {
        return std::nullopt;
    }
    text.remove_prefix(1);
    const std::optional<int> hours = take_number(text, 2);
    take(text, ':');
    take(text, '\'');
    const std::optional<int> minutes = text.empty() ? 0 : take_number(text, 2);
    take(text, '\'');
    if (!hours || !minutes || *hours > 14 || *minutes > 59 || !text.empty()) {
        return std::nullopt;
    }
    const std::int64_t seconds = *hours * std::int64_t{3600} + *minutes * std::int64_t{60};
    return sign == '+' ? seconds : -seconds;
}

}  // namespace

std::string time_text(std::int64_t time) {
    const CivilTime c = civil(time);
    return digits(static_cast<int>(c.date.year()), 4) + '-' + digits(static_cast<unsigned>(c.date.month()), 2) + '-' +
           digits(static_cast<unsigned>(c.date.day()), 2) + 'T' + digits(c.time.hours().count(), 2) + ':' +
           digits(c.time.minutes().count(), 2) + ':' + digits(c.time.seconds().count(), 2) + 'Z';
}

std::string pdf_time_text(std::int64_t time) {
    std::string out = "D:";
    for (const char c : time_text(time)) {
        if (c != '-' && c != ':' && c != 'T') {
            out += c;
        }
    }
    return out;
}

std::optional<std::int64_t> time_from_text(std::string_view text) {
    if (text.starts_with("D:")) {
        text.remove_prefix(2);
    }
    const std::optional<int> year = take_number(text, 4);
    take(text, '-');
    const std::optional<int> month = take_number(text, 2);
    take(text, '-');
    const std::optional<int> day = take_number(text, 2);
    take(text, 'T');
    const std::optional<int> hour = take_number(text, 2);
    take(text, ':');
    const std::optional<int> minute = take_number(text, 2);
    take(text, ':');
    const std::optional<int> second = take_number(text, 2);
    if (!year || !month || !day || !hour || !minute || !second || *year < 1950 || *hour > 23 || *minute > 59 ||
        *second > 60) {
        return std::nullopt;
    }
    if (!text.empty() && text.front() == '.') {  // a part of a second does not matter here
        text.remove_prefix(1);
        while (!text.empty() && text.front() >= '0' && text.front() <= '9') {
            text.remove_prefix(1);
        }
    }
    const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    const std::optional<std::int64_t> offset = zone_offset(text);
    if (!date.ok() || !offset) {
        return std::nullopt;
    }
    const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
    return days * 86400 + *hour * std::int64_t{3600} + *minute * std::int64_t{60} + *second - *offset;
}

}  // namespace gumcert::signing
