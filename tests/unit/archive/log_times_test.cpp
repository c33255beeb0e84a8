#include "archive/log_times.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::archive {
namespace {

LogEntry entry_of(std::int64_t seq, const std::string& at, const std::string& certificate, const std::string& body) {
    return {.seq = seq,
            .at = at,
            .actor = "A. Author",
            .kind = "drafted",
            .certificate = certificate,
            .record = "",
            .request_key = "",
            .body = body,
            .prev = "",
            .hash = ""};
}

/// Times of a log, entry by entry.
class ToldTimes {
public:
    std::string write(const std::string& at, const std::string& certificate = "") {
        last_ = at;
        return times.take(entry_of(++seq_, at, certificate, "{}"));
    }
    std::string say(const std::string& clock, const std::string& certificate = "") {
        return times.take(entry_of(++seq_, last_, certificate, R"({"clock":")" + clock + "\"}"));
    }
    LogTimes times;

private:
    std::string last_;
    std::int64_t seq_ = 0;
};

std::string day_of(const std::string& month, int day) {
    return month + (day < 10 ? "-0" : "-") + std::to_string(day) + "T08:00:00Z";
}

/// A laboratory that writes each day from October to November.
ToldTimes two_months_of_work() {
    ToldTimes log;
    for (const char* const month : {"2026-10", "2026-11"}) {
        for (int day = 1; day <= 30; ++day) {
            EXPECT_EQ(log.write(day_of(month, day), "EX-1"), "");
        }
    }
    return log;
}

TEST(ClocksThatAreSetRight, GoBackAsFarAsTheyWereAhead) {
    ToldTimes log = two_months_of_work();
    EXPECT_EQ(log.write("2027-01-10T08:00:00Z"), "") << "41 days ahead";
    EXPECT_EQ(log.write("2027-01-12T08:00:00Z", "EX-2"), "");
    EXPECT_EQ(log.say("2026-12-02T07:00:00Z", "EX-3"), "");
    EXPECT_EQ(log.say("2026-12-02T06:59:57Z", "EX-4"), "") << "another machine";
    EXPECT_EQ(log.say("2026-12-24T06:59:57Z"), "");
    EXPECT_EQ(log.write("2027-01-12T09:00:00Z"), "") << "its time has come";
    const LogTimes::SetBack found = log.times.set_back();
    EXPECT_EQ(found.entries, 3);
    EXPECT_EQ(found.ahead, 2);
    EXPECT_EQ(found.certificates, 3);
    EXPECT_EQ(
        in_words(found),
        "3 entries of a clock that was set back after it was ahead, the earliest 2026-12-02T06:59:57Z (entry 64); "
        "later times before: 2 entries; with such entries: 3 certificates");
    EXPECT_EQ(log.times.ahead(), (std::set<std::int64_t>{61, 62}));
    EXPECT_EQ(in_words(two_months_of_work().times.set_back()), "");
}

/// By five days for three weeks: the time at which it went wrong has passed long since.
TEST(ClocksThatAreSetRight, WereAheadForLongerThanTheyWereAhead) {
    ToldTimes log = two_months_of_work();
    for (int day = 6; day <= 26; ++day) {
        EXPECT_EQ(log.write(day_of("2026-12", day)), "");
    }
    EXPECT_EQ(log.say("2026-12-21T12:00:00Z"), "");
}

/// The clock is wrong once more while entries go by one that was set right.
TEST(ClocksThatAreSetRight, MayBeWrongAgain) {
    ToldTimes log = two_months_of_work();
    EXPECT_EQ(log.write("2027-01-10T08:00:00Z"), "");
    EXPECT_EQ(log.say("2026-12-01T08:00:00Z"), "");
    EXPECT_EQ(log.write("2027-03-10T08:00:00Z"), "") << "another machine";
    EXPECT_EQ(log.say("2026-12-03T08:00:00Z"), "");
}

TEST(ClocksThatAreSetRight, AreWrongByHoursFromTheBeginning) {
    ToldTimes log = two_months_of_work();
    EXPECT_EQ(log.say("2026-11-30T00:00:00Z"), "") << "local time in place of UTC";
}

/// A keeper sets the clock ahead, writes one entry, and sets it back to last year, or last week.
TEST(ClocksThatAreSetBackOnPurpose, GoBackNoFurtherThanTheyWereAhead) {
    for (const char* const ahead : {"2026-12-02T08:00:00Z", "2027-06-01T08:00:00Z", "2036-01-01T08:00:00Z"}) {
        ToldTimes log = two_months_of_work();
        EXPECT_EQ(log.write(ahead), "");
        EXPECT_NE(log.say("2026-11-20T08:00:00Z"), "") << ahead;
        EXPECT_NE(log.say("2025-12-31T08:00:00Z"), "") << ahead;
        EXPECT_NE(log.say("2026-09-30T08:00:00Z"), "") << "before the first entry, " << ahead;
    }
    ToldTimes log = two_months_of_work();
    EXPECT_NE(log.say("2026-11-20T08:00:00Z"), "") << "and without setting it ahead";
}

TEST(ClocksThatAreSetBackOnPurpose, AreNotBehindOneThatWasSetRight) {
    ToldTimes log = two_months_of_work();
    EXPECT_EQ(log.write("2027-12-01T08:00:00Z"), "");
    EXPECT_EQ(log.say("2026-12-10T08:00:00Z"), "");
    EXPECT_NE(log.say("2026-12-08T08:00:00Z"), "");
    EXPECT_EQ(log.write("2028-12-01T08:00:00Z"), "");
    EXPECT_NE(log.say("2026-12-08T08:00:00Z"), "") << "after one more that is ahead";
    EXPECT_EQ(log.say("2026-12-11T08:00:00Z"), "");
}

/// Who begins an archive may begin it by any clock, and sees it soon.
TEST(ClocksThatAreSetRight, MayHaveBeenAheadFromTheFirstEntryOfAYoungArchive) {
    ToldTimes log;
    EXPECT_EQ(log.write("2036-01-01T08:00:00Z"), "");
    EXPECT_EQ(log.write("2036-01-20T08:00:00Z"), "");
    EXPECT_EQ(log.say("2026-12-08T08:00:00Z"), "");
}

TEST(ClockOfAnEntry, IsReadHoweverItsNameIsSpelled) {
    const auto clock = [](const std::string& body) { return clock_of(entry_of(1, "2027-01-10T12:00:00Z", "", body)); };
    EXPECT_EQ(clock(R"({"clock":"2026-11-29T20:00:00Z"})"), "2026-11-29T20:00:00Z");
    EXPECT_EQ(clock(R"({"\u0063lock":"2026-11-29T20:00:00Z"})"), "2026-11-29T20:00:00Z");
    for (const char* const none :
         {"", "[]", R"({"clock":1})", R"({"clock":"2026-02-30T20:00:00Z"})", R"({"clock":"2027-01-10T12:00:00Z"})",
          R"({"new":{"clock":"2026-11-29T20:00:00Z"}})"}) {
        EXPECT_EQ(clock(none), "") << none;
    }
    EXPECT_EQ(seconds_of("1970-01-02T00:01:01Z"), 86461);
}

}  // namespace
}  // namespace gumcert::archive
