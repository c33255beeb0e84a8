#include "certificate/dates.h"

#include <cstddef>

namespace gumcert::certificate {

namespace {

// Dates are those of the Gregorian calendar; an earlier year on a certificate is a slip.
constexpr int k_first_gregorian_year = 1583;

/// The digits from one position of a text on; nothing where one is not a digit.
std::optional<int> digits(std::string_view text, std::size_t from, std::size_t count) {
    int value = 0;
    for (const char c : text.substr(from, count)) {
        if (c < '0' || c > '9') {
            return std::nullopt;
        }
        value = 10 * value + (c - '0');
    }
    return value;
}

}  // namespace

std::optional<std::chrono::year_month_day> calendar_date(std::string_view text) {
    if (text.size() != 10 || text[4] != '-' || text[7] != '-') {
        return std::nullopt;
    }
    const auto year = digits(text, 0, 4);
    const auto month = digits(text, 5, 2);
    const auto day = digits(text, 8, 2);
    if (!year || !month || !day || *year < k_first_gregorian_year) {
        return std::nullopt;
    }
    const std::chrono::year_month_day date{std::chrono::year{*year}, std::chrono::month{static_cast<unsigned>(*month)},
                                           std::chrono::day{static_cast<unsigned>(*day)}};
    return date.ok() ? std::optional{date} : std::nullopt;
}

bool is_after(std::string_view first, std::string_view second) {
    const auto a = calendar_date(first);
    const auto b = calendar_date(second);
    // A date that cannot be read is neither before nor after: its own finding says what is wrong with it.
    return a && b && *a > *b;
}

bool is_within(std::string_view date, std::string_view from, std::string_view to) {
    // A limit that is stated and cannot be read must not count as "no limit".
    const auto stated_and_wrong = [](std::string_view limit) { return !limit.empty() && !calendar_date(limit); };
    return calendar_date(date) && !stated_and_wrong(from) && !stated_and_wrong(to) && !is_after(from, date) &&
           !is_after(date, to);
}

std::optional<long> days_between(std::string_view first, std::string_view second) {
    const auto a = calendar_date(first);
    const auto b = calendar_date(second);
    if (!a || !b) {
        return std::nullopt;
    }
    return static_cast<long>((std::chrono::sys_days{*b} - std::chrono::sys_days{*a}).count());
}

}  // namespace gumcert::certificate
