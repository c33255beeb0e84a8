#include "certificate/dates.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::certificate {
namespace {

TEST(Dates, AreDaysOfTheCalendar) {
    for (const char* const text : {"2026-11-21", "2024-02-29", "2000-02-29", "1583-01-01", "9999-12-31"}) {
        EXPECT_TRUE(calendar_date(text)) << text;
    }
    for (const char* const text :
         {"", "2026-02-29", "1900-02-29", "2026-13-01", "2026-00-10", "2026-04-31", "2026-01-00", "1582-12-31",
          "2026-1-01", "20261121", "2026-11-21 ", " 2026-11-21", "+026-11-21", "2026/11/21", "2026-11-21T00:00",
          "２０２６-11-21", "2026-11--1", "abcd-ef-gh", "0000-01-01"}) {
        EXPECT_FALSE(calendar_date(text)) << text;
    }
}

TEST(Dates, HaveAnOrder) {
    EXPECT_TRUE(is_after("2026-11-22", "2026-11-21"));
    EXPECT_TRUE(is_after("2027-01-01", "2026-12-31"));
    EXPECT_FALSE(is_after("2026-11-21", "2026-11-21"));
    EXPECT_FALSE(is_after("", "2026-11-21"));
    EXPECT_FALSE(is_after("2026-11-22", ""));
    EXPECT_FALSE(is_after("2026-11-31", "2026-11-21")) << "not a date";
}

TEST(Dates, LieWithinLimits) {
    EXPECT_TRUE(is_within("2026-11-21", "2026-11-21", "2026-11-21"));
    EXPECT_TRUE(is_within("2026-11-21", "", ""));
    EXPECT_TRUE(is_within("2026-11-21", "2025-01-01", ""));
    EXPECT_FALSE(is_within("2026-11-21", "2026-11-22", ""));
    EXPECT_FALSE(is_within("2026-11-21", "", "2026-11-20"));
    EXPECT_FALSE(is_within("", "", ""));
    EXPECT_FALSE(is_within("2026-11-21", "soon", "")) << "a limit that is none proves nothing";
}

// 2024 is a leap year: 366 days from one New Year to the next.
TEST(Dates, AreDaysApart) {
    EXPECT_EQ(days_between("2024-01-01", "2025-01-01"), 366);
    EXPECT_EQ(days_between("2026-11-21", "2026-11-16"), -5);
    EXPECT_FALSE(days_between("2026-11-21", "").has_value());
}

}  // namespace
}  // namespace gumcert::certificate
