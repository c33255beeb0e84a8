#include "archive/log_times.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "json/strict_parser.h"
#include "text/lists.h"

namespace gumcert::archive {

namespace {

constexpr std::int64_t k_day = 86400;  // [s]
/// As long as an archive is young, its first entry may be of the clock that was ahead, too; and who begins one may begin it by any.
constexpr std::int64_t k_young = 31 * k_day;

int number_at(std::string_view text, std::size_t from, std::size_t digits) {
    int value = 0;
    for (const char digit : text.substr(from, digits)) {
        value = 10 * value + (digit - '0');
    }
    return value;
}

std::chrono::year_month_day date_in(std::string_view text) {
    return {std::chrono::year(number_at(text, 0, 4)), std::chrono::month(static_cast<unsigned>(number_at(text, 5, 2))),
            std::chrono::day(static_cast<unsigned>(number_at(text, 8, 2)))};
}

std::string days_in_words(std::int64_t seconds) {
    return text::count_of(seconds / k_day, "day");
}

}  // namespace

bool is_utc_time(std::string_view text) {
    constexpr std::string_view k_form = "dddd-dd-ddTdd:dd:ddZ";
    bool is = text.size() == k_form.size();
    for (std::size_t i = 0; is && i < text.size(); ++i) {
        is = k_form[i] == 'd' ? text[i] >= '0' && text[i] <= '9' : text[i] == k_form[i];
    }
    // The clocks that write here know no leap seconds (POSIX), and no year 0.
    return is && date_in(text).ok() && number_at(text, 0, 4) > 0 && number_at(text, 11, 2) < 24 &&
           number_at(text, 14, 2) < 60 && number_at(text, 17, 2) < 60;
}

std::int64_t seconds_of(std::string_view at) {
    const std::chrono::sys_seconds time =
        std::chrono::sys_days(date_in(at)) + std::chrono::hours(number_at(at, 11, 2)) +
        std::chrono::minutes(number_at(at, 14, 2)) + std::chrono::seconds(number_at(at, 17, 2));
    return time.time_since_epoch().count();
}

std::string clock_of(const LogEntry& entry) {
    // Few entries state a clock, and a log is read as a whole.
    if (entry.body.find(k_clock) == std::string::npos && entry.body.find("\\u") == std::string::npos) {
        return "";
    }
    const std::optional<nlohmann::json> body = gumcert::json::parse_faultless(entry.body, {});
    const nlohmann::json clock = body && body->is_object() ? body->value(k_clock, nlohmann::json()) : nlohmann::json();
    return clock.is_string() && is_utc_time(clock.get_ref<const std::string&>()) &&
                   clock.get_ref<const std::string&>() < entry.at
               ? clock.get<std::string>()
               : "";
}

std::string LogTimes::take(const LogEntry& entry) {
    if (!is_utc_time(entry.at)) {
        return "";  // the rules of the log tell it
    }
    const std::int64_t at = seconds_of(entry.at);
    const std::string clock = clock_of(entry);
    Taken taken{entry.seq, at, std::nullopt, entry.certificate};
    std::string fault;
    if (clock.empty()) {
        step_ = last_ ? std::max(step_, at - *last_) : 0;
    } else {
        const std::int64_t said = seconds_of(clock);
        const std::int64_t explained = offset_ + step_;
        // A day, because what is wrong by hours is wrong by a zone of time, from the first entry on.
        if (latest_clock_ && said < *latest_clock_ - k_day) {
            fault = "the clock said " + clock + ", " + days_in_words(*latest_clock_ - said) +
                    " before what an earlier entry says of its own";
        } else if (at - first_.value_or(at) > k_young && at - said > explained + k_day) {
            fault = "the clock said " + clock + ", " + days_in_words(at - said) +
                    " before the last entry, and the log has gone ahead by no more than " + days_in_words(explained) +
                    " at once";
        }
        taken.clock = said;
        latest_clock_ = std::max(latest_clock_.value_or(std::numeric_limits<std::int64_t>::min()), said);
        offset_ = std::max<std::int64_t>(at - *latest_clock_, 0);
        step_ = 0;
        if (earliest_.empty() || clock < earliest_) {
            earliest_ = clock;
            seq_of_earliest_ = entry.seq;
        }
    }
    first_ = first_.value_or(at);
    last_ = std::max(last_.value_or(at), at);
    taken_.push_back(std::move(taken));
    return fault;
}

std::set<std::int64_t> LogTimes::ahead() const {
    std::set<std::int64_t> found;
    std::int64_t earliest_behind = std::numeric_limits<std::int64_t>::max();  // clock of the entries behind
    for (auto one = taken_.rbegin(); one != taken_.rend(); ++one) {
        if (!one->clock && one->at > earliest_behind) {
            found.insert(one->seq);
        }
        earliest_behind = std::min(earliest_behind, one->clock.value_or(earliest_behind));
    }
    return found;
}

LogTimes::SetBack LogTimes::set_back() const {
    const std::set<std::int64_t> ahead = this->ahead();
    SetBack found{.ahead = ahead.size(), .earliest = earliest_, .seq = seq_of_earliest_};
    std::set<std::string> certificates;
    for (const Taken& one : taken_) {
        found.entries += one.clock ? 1U : 0U;
        if ((one.clock || ahead.contains(one.seq)) && !one.certificate.empty()) {
            certificates.insert(one.certificate);
        }
    }
    found.certificates = certificates.size();
    return found;
}

nlohmann::json to_json(const LogTimes::SetBack& set_back) {
    return {{"entries", set_back.entries},
            {"entries_ahead", set_back.ahead},
            {"certificates", set_back.certificates},
            {"earliest", set_back.earliest}};
}

std::string in_words(const LogTimes::SetBack& set_back) {
    if (set_back.entries == 0) {
        return "";
    }
    return text::count_of(static_cast<std::int64_t>(set_back.entries), "entry") +
           " of a clock that was set back after it was ahead, the earliest " + set_back.earliest + " (entry " +
           std::to_string(set_back.seq) +
           "); later times before: " + text::count_of(static_cast<std::int64_t>(set_back.ahead), "entry") +
           "; with such entries: " + text::count_of(static_cast<std::int64_t>(set_back.certificates), "certificate");
}

}  // namespace gumcert::archive
